//! Points and vectors that are not rounded yet.

use super::Point;

/// A point or vector in floats of microns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct V {
    pub(super) x: f64,
    pub(super) y: f64,
}

impl V {
    pub(super) fn of(point: Point) -> Self {
        Self { x: f64::from(point.x), y: f64::from(point.y) }
    }

    /// The nearest point, halves away from zero. (`f64::round` is a call into a library on plain x86-64.)
    pub(super) fn rounded(self) -> Point {
        let nearest = |value: f64| (value + 0.5f64.copysign(value)) as i32;
        Point::new(nearest(self.x), nearest(self.y))
    }

    pub(super) fn plus(self, other: Self, times: f64) -> Self {
        Self { x: self.x + other.x * times, y: self.y + other.y * times }
    }

    pub(super) fn to(self, other: Self) -> Self {
        Self { x: other.x - self.x, y: other.y - self.y }
    }

    pub(super) fn cross(self, other: Self) -> f64 {
        self.x * other.y - self.y * other.x
    }

    pub(super) fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }

    pub(super) fn left(self) -> Self {
        Self { x: -self.y, y: self.x }
    }
}
