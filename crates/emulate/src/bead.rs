//! The strand that a nozzle lays: its section and its density.

use std::f64::consts::FRAC_PI_4;

/// The form of a bead cut across.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shape {
    /// Width × height.
    #[default]
    Rectangle,
    /// A rectangle with half circles at its sides.
    Stadium,
    /// An ellipse of that width and height.
    Ellipse,
    /// A circle of that width.
    Circle,
}

/// A bead of the same section everywhere.
///
/// ```
/// use emulate::{Bead, Shape};
///
/// let bead = Bead { width: 6.0, height: 2.0, shape: Shape::Rectangle, density: 1.9 };
/// assert_eq!(bead.area(), 12.0);
/// assert!((bead.mass(bead.area() * 1200.0) - 27.36).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bead {
    /// Width, mm.
    pub width: f64,
    /// Height, mm.
    pub height: f64,
    /// Form.
    pub shape: Shape,
    /// Density, g/cm³.
    pub density: f64,
}

impl Default for Bead {
    /// The bead of clayforge's profile `clay`: 3.2 × 1.5 mm of clay of 1.9 g/cm³.
    fn default() -> Self {
        Self { width: 3.2, height: 1.5, shape: Shape::Rectangle, density: 1.9 }
    }
}

impl Bead {
    /// The area of the section, mm². A stadium that is higher than wide has no straight part; it counts as an ellipse.
    pub fn area(&self) -> f64 {
        let Self { width, height, .. } = *self;
        match self.shape {
            Shape::Rectangle => width * height,
            Shape::Stadium if width >= height => (width - height) * height + FRAC_PI_4 * height * height,
            Shape::Stadium | Shape::Ellipse => FRAC_PI_4 * width * height,
            Shape::Circle => FRAC_PI_4 * width * width,
        }
    }

    /// The mass of so many mm³, g.
    pub fn mass(&self, volume: f64) -> f64 {
        volume / 1000.0 * self.density
    }

    /// What is odd about it, if anything.
    pub fn warning(&self) -> Option<String> {
        (self.shape == Shape::Stadium && self.width < self.height).then(|| {
            format!(
                "a stadium must be at least as wide as high, and this one is {} × {} mm; it counts as an ellipse",
                self.width, self.height
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_have_the_areas_of_their_forms() {
        let area = |width: f64, height: f64, shape| Bead { width, height, shape, density: 1.0 }.area();
        let near =
            |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        near(area(6.0, 2.0, Shape::Rectangle), 12.0);
        near(area(6.0, 2.0, Shape::Stadium), 8.0 + std::f64::consts::PI);
        near(area(6.0, 2.0, Shape::Ellipse), std::f64::consts::PI * 3.0);
        near(area(6.0, 2.0, Shape::Circle), std::f64::consts::PI * 9.0);
        near(area(2.0, 2.0, Shape::Stadium), area(2.0, 2.0, Shape::Circle));
    }

    #[test]
    fn a_stadium_on_its_edge_is_an_ellipse_and_says_so() {
        let bead = Bead { width: 1.0, height: 2.0, shape: Shape::Stadium, density: 1.0 };
        assert_eq!(bead.area(), Bead { shape: Shape::Ellipse, ..bead }.area());
        assert!(bead.warning().is_some());
        assert!(Bead::default().warning().is_none());
    }
}
