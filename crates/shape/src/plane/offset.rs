//! Regions grown and shrunk.
//!
//! The raw offset of a ring crosses itself wherever the ring is too narrow for the distance; what it covers a positive
//! number of times is the result (see [`curves`](super::curves)).

use super::Offset;
use super::curves::{Curves, V};
use super::{Point, Ring};

/// Grows (`distance` > 0) or shrinks (`distance` < 0) a region by a distance in microns.
///
/// The rings of the region do not cross: counter-clockwise around clay, clockwise around holes. So do the rings of
/// the result. Corners stay sharp; one that turns by more than a right angle is rounded outside the region's reach,
/// never closer than the distance.
pub fn offset(region: &[Ring], distance: f64) -> Vec<Ring> {
    offset_with_loss(region, distance).rings
}

/// The same, with how much was lost where the region is too narrow.
pub fn offset_with_loss(region: &[Ring], distance: f64) -> Offset {
    let mut curves = Curves::default();
    for ring in region {
        curves.push_offset(&ring.0, -distance);
    }
    curves.covered()
}

/// The region that loops cover, each counted by its sense: what lies inside more counter-clockwise loops than
/// clockwise ones. Overlapping parts are united.
pub fn united(loops: &[Ring]) -> Vec<Ring> {
    let mut curves = Curves::default();
    for ring in loops {
        curves.push(ring.0.iter().map(|point| V::of(*point)));
    }
    curves.covered().rings
}

/// Whether any two sides of the loops cross.
pub fn crossing(loops: &[Ring]) -> bool {
    let mut curves = Curves::default();
    for ring in loops {
        curves.push(ring.0.iter().map(|point| V::of(*point)));
    }
    !curves.crossings().is_empty()
}

/// The raw curve in whole microns, for comparing kernels.
#[cfg(test)]
pub(super) fn raw_for_test(region: &[Ring], distance: f64) -> Vec<Ring> {
    let mut curves = Curves::default();
    region.iter().for_each(|ring| curves.push_offset(&ring.0, -distance));
    curves.raw()
}

impl Curves {
    /// Adds the curve at a distance to the left of a ring.
    ///
    /// A corner whose neighbours' offset sides overlap becomes their intersection when both sides are long enough;
    /// otherwise the curve goes to the end of one offset side, through the corner itself and on to the start of the
    /// next, which gives what is too narrow a winding number of zero or less.
    fn push_offset(&mut self, ring: &[Point], distance: f64) {
        // Doubled points have no direction.
        let mut corners: Vec<V> = Vec::with_capacity(ring.len());
        for point in ring {
            let corner = V::of(*point);
            if corners.last() != Some(&corner) {
                corners.push(corner);
            }
        }
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        let count = corners.len();
        if count < 3 {
            return;
        }
        // Length and direction of the side that starts at each corner.
        let mut sides: Vec<(f64, V)> = Vec::with_capacity(count);
        for index in 0..count {
            let vector = corners[index].to(corners[if index + 1 == count { 0 } else { index + 1 }]);
            let length = vector.dot(vector).sqrt();
            sides.push((length, V { x: vector.x / length, y: vector.y / length }));
        }
        // How much of its sides each corner eats; infinite where the curve turns back.
        let mut eaten: Vec<f64> = Vec::with_capacity(count);
        let mut before = sides[count - 1].1;
        for &(_, after) in &sides {
            let (turn, straight) = (before.cross(after), before.dot(after));
            eaten.push(match turn * distance > 0.0 {
                true if straight > -0.999 => distance.abs() * turn.abs() / (1.0 + straight),
                true => f64::INFINITY,
                false => 0.0,
            });
            before = after;
        }
        let mut points = Vec::with_capacity(count + count / 4);
        let mut last = count - 1;
        for index in 0..count {
            let next = if index + 1 == count { 0 } else { index + 1 };
            let (corner, before, after) = (corners[index], sides[last].1, sides[index].1);
            let inner = eaten[index] > 0.0;
            let through = inner
                && (eaten[last] + eaten[index] > sides[last].0
                    || eaten[index] + eaten[next] > sides[index].0);
            let (turn, straight) = (before.cross(after), before.dot(after));
            if through {
                points.push(corner.plus(before.left(), distance));
                points.push(corner);
                points.push(corner.plus(after.left(), distance));
            } else if inner || straight >= 0.0 {
                let middle = V { x: before.left().x + after.left().x, y: before.left().y + after.left().y };
                points.push(corner.plus(middle, distance / (1.0 + straight)));
            } else {
                // Corners of a polygon around the arc: no point is nearer than the distance.
                let angle = libm::atan2(turn.abs(), straight);
                let steps = (angle / std::f64::consts::FRAC_PI_4).ceil();
                let half = angle / steps / 2.0;
                let reach = distance / libm::cos(half);
                let sense = if distance > 0.0 { -1.0 } else { 1.0 };
                for step in 0..steps as usize {
                    let turned = sense * half * (2.0 * step as f64 + 1.0);
                    let (sine, cosine) = (libm::sin(turned), libm::cos(turned));
                    let normal = before.left();
                    let spoke =
                        V { x: normal.x * cosine - normal.y * sine, y: normal.x * sine + normal.y * cosine };
                    points.push(corner.plus(spoke, reach));
                }
            }
            last = index;
        }
        self.push(points);
    }
}

/// The parts of some loops that lie outside a region, each as the vector from its start to its end in microns.
pub fn outside(loops: &[Ring], region: &[Ring]) -> Vec<(f64, f64)> {
    let mut curves = Curves::default();
    let push = |curves: &mut Curves, ring: &Ring| curves.push(ring.0.iter().map(|point| V::of(*point)));
    let loops: Vec<&Ring> = loops.iter().filter(|ring| ring.0.len() > 2).collect();
    loops.iter().for_each(|ring| push(&mut curves, ring));
    region.iter().for_each(|ring| push(&mut curves, ring));
    curves.outside(loops.len()).into_iter().map(|part| (part.x, part.y)).collect()
}

/// For every side of the rings of a region, how far across the region the next ring faces it, in microns; `None` where
/// it is `reach` or more. Measured at the middle of the side, at right angles to it.
pub fn facing(region: &[Ring], reach: f64) -> Vec<Vec<Option<f64>>> {
    let mut curves = Curves::default();
    for ring in region {
        curves.push(ring.0.iter().map(|point| V::of(*point)));
    }
    let look = |(from, to): (Point, Point)| {
        let (from, side) = (V::of(from), V::of(from).to(V::of(to)));
        let length = side.dot(side).sqrt();
        if length == 0.0 {
            return None;
        }
        let middle = from.plus(side, 0.5);
        // A micron inwards, so that the ray does not meet the side it starts from.
        let start = middle.plus(side.left(), 1.0 / length);
        curves.first_hit(start, side.left(), reach / length).map(|share| share * length + 1.0)
    };
    region.iter().map(|ring| ring.segments().map(look).collect()).collect()
}
