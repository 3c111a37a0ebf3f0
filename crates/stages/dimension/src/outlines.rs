//! Where the clay of a layer ends, for travels that leave it.

use shape::plane::cross;
use skein::{Line, Point, Ring, boundary};

/// The outlines of a layer, each with the box around it: what is far away is left out at once.
pub(crate) struct Outlines(Vec<(Ring, Point, Point)>);

impl Outlines {
    pub(crate) fn of(lines: &[Line]) -> Self {
        let boxed = |ring: Ring| ring.bounds().map(|(low, high)| (ring, low, high));
        Self(boundary(lines).into_iter().filter_map(boxed).collect())
    }

    /// Whether a place lies in the clay: inside more outlines than holes.
    pub(crate) fn hold(&self, at: Point) -> bool {
        let within =
            |low: &Point, high: &Point| (low.x..=high.x).contains(&at.x) && (low.y..=high.y).contains(&at.y);
        let around = self.0.iter().filter(|(ring, low, high)| within(low, high) && ring.contains(at));
        around.count() % 2 == 1
    }

    /// Whether a straight way crosses any of them.
    pub(crate) fn crossed(&self, from: Point, to: Point) -> bool {
        let near = |low: &Point, high: &Point| {
            from.x.max(to.x) >= low.x
                && from.x.min(to.x) <= high.x
                && from.y.max(to.y) >= low.y
                && from.y.min(to.y) <= high.y
        };
        self.0
            .iter()
            .filter(|(_, low, high)| near(low, high))
            .any(|(ring, ..)| ring.segments().any(|(a, b)| cross_each_other(from, to, a, b)))
    }
}

/// Whether two lines cross; exact in whole microns.
fn cross_each_other(a: Point, b: Point, c: Point, d: Point) -> bool {
    let left = |a: Point, b: Point, c: Point| cross(a, b, c) > 0;
    left(a, b, c) != left(a, b, d) && left(c, d, a) != left(c, d, b)
}
