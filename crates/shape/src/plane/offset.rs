//! Regions grown and shrunk.
//!
//! The raw offset of a ring crosses itself wherever the ring is too narrow for the distance; what it covers a positive
//! number of times is the result (see [`curves`](super::curves)).

use super::Offset;
use super::curves::Curves;
use super::vector::V;
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

/// The raw curve in whole microns, with every side, for comparing kernels.
#[cfg(test)]
pub(super) fn raw_for_test(region: &[Ring], distance: f64) -> Vec<Ring> {
    let mut curves = Curves::default();
    for ring in region {
        if let Some(sides) = sides(&ring.0, -distance) {
            curves.push_sides(&sides, 0, -distance);
        }
    }
    curves.raw()
}

impl Curves {
    /// Adds the curve at a distance to the left of a ring.
    ///
    /// A corner whose neighbours' offset sides overlap becomes their intersection when both sides are long enough;
    /// otherwise the curve goes to the end of one offset side, through the corner itself and on to the start of the
    /// next, which gives what is too narrow a winding number of zero or less.
    fn push_offset(&mut self, ring: &[Point], distance: f64) {
        if let Some(mut sides) = sides(ring, distance) {
            let first = leave_out_swallowed(&mut sides, distance);
            self.push_sides(&sides, first, distance);
        }
    }

    fn push_sides(&mut self, sides: &[Side], first: usize, distance: f64) {
        let mut points = Vec::with_capacity(sides.len() + sides.len() / 4);
        let mut spokes = Vec::new();
        let mut here = first;
        loop {
            let side = &sides[here];
            let before = &sides[side.before];
            let (corner, turn, straight) =
                (side.corner, before.along.cross(side.along), before.along.dot(side.along));
            let through = side.eaten > 0.0
                && (before.eaten + side.eaten > before.length
                    || side.eaten + sides[side.after].eaten > side.length);
            if through {
                // What was left out before a corner that finds no room must be there after all.
                let mut index = side.before;
                while index != here {
                    let along = sides[index].along;
                    index = if index + 1 == sides.len() { 0 } else { index + 1 };
                    let corner = sides[index].start;
                    spokes.extend([points.len(), points.len() + 1]);
                    points.push(corner.plus(along.left(), distance));
                    points.push(corner);
                    points.push(corner.plus(sides[index].along.left(), distance));
                }
            } else if side.eaten > 0.0 || straight >= 0.0 {
                let (one, other) = (before.along.left(), side.along.left());
                let middle = V { x: one.x + other.x, y: one.y + other.y };
                points.push(corner.plus(middle, distance / (1.0 + straight)));
            } else {
                push_arc(&mut points, corner, before.along.left(), turn, straight, distance);
            }
            here = side.after;
            if here == first {
                break;
            }
        }
        self.push_with_spokes(points, &spokes);
    }
}

/// Corners of a polygon around the arc that rounds a corner: no point is nearer than the distance.
fn push_arc(points: &mut Vec<V>, corner: V, normal: V, turn: f64, straight: f64, distance: f64) {
    let angle = libm::atan2(turn.abs(), straight);
    let steps = (angle / std::f64::consts::FRAC_PI_4).ceil();
    let half = angle / steps / 2.0;
    let reach = distance / libm::cos(half);
    let sense = if distance > 0.0 { -1.0 } else { 1.0 };
    for step in 0..steps as usize {
        let turned = sense * half * (2.0 * step as f64 + 1.0);
        let (sine, cosine) = (libm::sin(turned), libm::cos(turned));
        let spoke = V { x: normal.x * cosine - normal.y * sine, y: normal.x * sine + normal.y * cosine };
        points.push(corner.plus(spoke, reach));
    }
}

/// A side of a ring on its way to be offset.
struct Side {
    /// Where it starts in the ring.
    start: V,
    /// Where it starts once the sides before it are left out.
    corner: V,
    /// Its direction, of length one.
    along: V,
    length: f64,
    /// How much of this side and of the one before their common corner eats, where it turns towards the offset;
    /// infinite where the curve turns back.
    eaten: f64,
    before: usize,
    after: usize,
}

/// The sides of a ring, chained; `None` for less than a triangle.
fn sides(ring: &[Point], distance: f64) -> Option<Vec<Side>> {
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
        return None;
    }
    let mut sides: Vec<Side> = Vec::with_capacity(count);
    for (index, &corner) in corners.iter().enumerate() {
        let after = if index + 1 == count { 0 } else { index + 1 };
        let before = if index == 0 { count - 1 } else { index - 1 };
        let vector = corner.to(corners[after]);
        let length = vector.dot(vector).sqrt();
        let along = V { x: vector.x / length, y: vector.y / length };
        sides.push(Side { start: corner, corner, along, length, eaten: 0.0, before, after });
    }
    for index in 0..count {
        sides[index].eaten = eaten(&sides, index, distance);
    }
    Some(sides)
}

/// Unchains the sides that vanish and gives one that is left.
///
/// Between two corners that turn towards the offset, a side that both eat up is left out and its neighbours are
/// prolonged until they meet: the offset of the three is the same as that of the two. That takes the small change out
/// of rounded tips, where every lost side would otherwise cost a crossing.
fn leave_out_swallowed(sides: &mut [Side], distance: f64) -> usize {
    let mut left = sides.len();
    let mut first = 0;
    let mut suspects: Vec<usize> = (0..left).filter(|index| is_swallowed(sides, *index)).collect();
    while let Some(index) = suspects.pop() {
        if left == 3 || sides[index].length.is_nan() || !is_swallowed(sides, index) {
            continue;
        }
        let (before, after) = (sides[index].before, sides[index].after);
        let (turn, straight) =
            (sides[before].along.cross(sides[after].along), sides[before].along.dot(sides[after].along));
        // Neighbours that turn by nearly half a circle do not meet within reason.
        if turn * distance <= 0.0 || straight < -0.9 {
            continue;
        }
        let gap = sides[index].corner.to(sides[after].corner);
        let ahead = gap.cross(sides[after].along) / turn;
        let behind = sides[before].along.cross(gap) / turn;
        sides[after].corner = sides[index].corner.plus(sides[before].along, ahead);
        sides[before].length += ahead;
        sides[after].length += behind;
        sides[before].after = after;
        sides[after].before = before;
        // A mark that it is gone, should it still be among the suspects.
        sides[index].length = f64::NAN;
        first = after;
        left -= 1;
        sides[after].eaten = eaten(sides, after, distance);
        suspects.extend([before, after].into_iter().filter(|index| is_swallowed(sides, *index)));
    }
    first
}

/// How much the corner at the start of a side eats of both its sides.
fn eaten(sides: &[Side], index: usize, distance: f64) -> f64 {
    let (before, after) = (sides[sides[index].before].along, sides[index].along);
    let (turn, straight) = (before.cross(after), before.dot(after));
    match turn * distance > 0.0 {
        true if straight > -0.999 => distance.abs() * turn.abs() / (1.0 + straight),
        true => f64::INFINITY,
        false => 0.0,
    }
}

/// Whether the corners at both ends turn towards the offset and eat more than the whole side.
fn is_swallowed(sides: &[Side], index: usize) -> bool {
    let side = &sides[index];
    let end = sides[side.after].eaten;
    side.eaten > 0.0 && end > 0.0 && side.eaten + end > side.length
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
