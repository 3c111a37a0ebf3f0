//! What the machine has room for.

use shape::plane::boolean::common;
use skein::{BedArea, BedShape, Error, Facts, Point, Ring};

/// Where the middles of beads may go, if the header says how large the bed is.
pub(crate) struct Bed {
    area: Option<BedArea>,
    margin: f64,
}

impl Bed {
    pub(crate) fn new(facts: &Facts) -> Result<Self, Error> {
        Ok(Self { area: facts.bed, margin: facts.bead_width()?.um() / 2.0 })
    }

    /// The part of a region that lies on the bed, and whether that is less than all of it.
    pub(crate) fn part_of(&self, region: Vec<Ring>) -> (Vec<Ring>, bool) {
        let Some(area) = self.area else { return (region, false) };
        if region.iter().flat_map(|ring| &ring.0).all(|point| area.holds(*point, self.margin)) {
            return (region, false);
        }
        (common(&region, &[outline(area, self.margin)]), true)
    }
}

/// Sides of the polygon that stands for a round bed: it lies 0.1 % of the radius inside at most.
const SIDES: u32 = 64;

/// The outline of the bed, moved inwards.
fn outline(area: BedArea, margin: f64) -> Ring {
    let middle = |low: i32, high: i32| f64::midpoint(f64::from(low), f64::from(high));
    let half = |low: i32, high: i32| ((f64::from(high) - f64::from(low)) / 2.0 - margin).max(1.0);
    let (x, y) = (middle(area.low.x, area.high.x), middle(area.low.y, area.high.y));
    let (half_x, half_y) = (half(area.low.x, area.high.x), half(area.low.y, area.high.y));
    // Towards the middle, so that rounding never leaves the bed.
    let at = |sine: f64, cosine: f64| Point::new((x + half_x * cosine) as i32, (y + half_y * sine) as i32);
    let corners = match area.shape {
        BedShape::Rectangle => vec![at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0), at(1.0, -1.0)],
        BedShape::Ellipse => (0..SIDES)
            .map(|side| f64::from(side) * std::f64::consts::TAU / f64::from(SIDES))
            .map(|angle| at(libm::sin(angle), libm::cos(angle)))
            .collect(),
    };
    Ring(corners)
}
