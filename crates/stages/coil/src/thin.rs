//! A way with no more corners than it needs.

use crate::lay::Step;
use crate::track::{Spot, square};

/// The way without the corners that a straight side passes within a tolerance; both ends stay.
///
/// From each kept corner the directions that pass all later ones near enough form a cone, which narrows until a corner
/// lies outside; the one before it is kept (Williams 1978). One look at each corner.
pub fn thinned(way: &[Step], tolerance: f64) -> Vec<Step> {
    let (Some(first), Some(last)) = (way.first(), way.last()) else { return Vec::new() };
    let mut kept = Vec::with_capacity(way.len());
    kept.push(*first);
    let mut before = *first;
    let mut cone = Cone::from(first.at);
    for step in &way[1..] {
        if !cone.admits(step.at) {
            kept.push(before);
            cone = Cone::from(before.at);
        }
        cone.narrow(step.at, tolerance);
        before = *step;
    }
    if way.len() > 1 {
        kept.push(*last);
    }
    kept
}

/// The directions from a corner that pass all corners since then near enough.
struct Cone {
    tip: Spot,
    /// Its right and left side; none while every direction will do.
    sides: Option<(Spot, Spot)>,
    /// How far from the tip the last corner was, squared: a way that turns back is not straight.
    reach: f64,
}

impl Cone {
    fn from(tip: Spot) -> Self {
        Self { tip, sides: None, reach: 0.0 }
    }

    fn admits(&self, corner: Spot) -> bool {
        let along = [corner[0] - self.tip[0], corner[1] - self.tip[1]];
        self.sides.is_none_or(|(right, left)| cross(right, along) >= 0.0 && cross(along, left) >= 0.0)
            && square(self.tip, corner) >= self.reach
    }

    fn narrow(&mut self, corner: Spot, tolerance: f64) {
        let along = [corner[0] - self.tip[0], corner[1] - self.tip[1]];
        let far = along[0] * along[0] + along[1] * along[1];
        self.reach = far;
        if far <= tolerance * tolerance {
            return;
        }
        // The tangents from the tip to the circle around the corner.
        let ahead = (far - tolerance * tolerance).sqrt();
        let right = [along[0] * ahead + along[1] * tolerance, along[1] * ahead - along[0] * tolerance];
        let left = [along[0] * ahead - along[1] * tolerance, along[1] * ahead + along[0] * tolerance];
        self.sides = Some(match self.sides {
            None => (right, left),
            Some((old_right, old_left)) => (
                if cross(old_right, right) > 0.0 { right } else { old_right },
                if cross(left, old_left) > 0.0 { left } else { old_left },
            ),
        });
    }
}

fn cross(a: Spot, b: Spot) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
