//! Which island of a layer a line lies on.

use skein::{Point, Ring};
use std::cmp::Reverse;
use std::ops::Range;

/// Where the islands of a layer lie.
pub struct Map<'a> {
    outlines: &'a [Ring],
    /// The outside of every island, as an index into the outlines.
    outsides: &'a [usize],
    bounds: Vec<Bounds>,
    /// Twice the area of every outside: islands may lie in holes of others.
    areas: Vec<i128>,
    /// The islands, from left to right.
    order: Vec<usize>,
    /// How far to the right the islands of each half of `order`, half of a half and so on reach, kept at its middle.
    right: Vec<i32>,
}

/// The least and the greatest coordinates of something.
type Bounds = (Point, Point);

/// How many points of a line are asked for the island they lie on. A bead on the middle of a thin part may stick out at
/// its ends, hardly at most of these.
const ASKED: usize = 5;

impl<'a> Map<'a> {
    /// The islands with these outsides.
    pub fn new(outlines: &'a [Ring], outsides: &'a [usize]) -> Self {
        let outside = |index: &usize| &outlines[*index];
        let bounds: Vec<Bounds> =
            outsides.iter().map(|index| outside(index).bounds().unwrap_or_default()).collect();
        let areas = outsides.iter().map(|index| outside(index).area2()).collect();
        let mut order: Vec<usize> = (0..outsides.len()).collect();
        order.sort_by_key(|island| (bounds[*island].0.x, *island));
        let right = vec![i32::MIN; order.len()];
        let mut map = Self { outlines, outsides, bounds, areas, order, right };
        map.measure(0..map.order.len());
        map
    }

    fn measure(&mut self, part: Range<usize>) -> i32 {
        if part.is_empty() {
            return i32::MIN;
        }
        let middle = part.start.midpoint(part.end);
        let sides = self.measure(part.start..middle).max(self.measure(middle + 1..part.end));
        self.right[middle] = sides.max(self.bounds[self.order[middle]].1.x);
        self.right[middle]
    }

    /// The island that most points of a line lie on; the nearest where they lie on none.
    pub fn home(&self, points: &[Point]) -> usize {
        let Some(bounds) = bounds(points) else { return 0 };
        let mut near = Vec::new();
        self.find(0..self.order.len(), bounds, &mut near);
        match near[..] {
            [] => return self.nearest(|island| self.to_bounds(island, bounds.0)),
            [only] => return only,
            _ => near.sort_unstable_by_key(|island| (self.areas[*island], *island)),
        }
        let mut votes = vec![0; near.len()];
        for point in points.iter().step_by(points.len().div_ceil(ASKED)) {
            // Smaller first, so the first that holds it is the innermost.
            if let Some(index) = near.iter().position(|island| self.outside(*island).contains(*point)) {
                votes[index] += 1;
            }
        }
        let most = (0..near.len()).max_by_key(|index| (votes[*index], Reverse(*index)));
        match most.filter(|index| votes[*index] > 0) {
            Some(index) => near[index],
            None => self.nearest(|island| self.to_outline(island, points[points.len() / 2])),
        }
    }

    /// The islands in a part of the order whose bounds meet others.
    fn find(&self, part: Range<usize>, (low, high): Bounds, found: &mut Vec<usize>) {
        let middle = part.start.midpoint(part.end);
        if part.is_empty() || self.right[middle] < low.x {
            return;
        }
        self.find(part.start..middle, (low, high), found);
        let (least, most) = self.bounds[self.order[middle]];
        if least.x <= high.x {
            if low.x <= most.x && least.y <= high.y && low.y <= most.y {
                found.push(self.order[middle]);
            }
            self.find(middle + 1..part.end, (low, high), found);
        }
    }

    fn outside(&self, island: usize) -> &Ring {
        &self.outlines[self.outsides[island]]
    }

    /// The island to which something is the least.
    fn nearest(&self, gap: impl Fn(usize) -> f64) -> usize {
        (0..self.order.len()).min_by(|one, other| gap(*one).total_cmp(&gap(*other))).unwrap_or(0)
    }

    /// How far a point is from the bounds of an island.
    fn to_bounds(&self, island: usize, point: Point) -> f64 {
        let (low, high) = self.bounds[island];
        point.distance(Point::new(point.x.clamp(low.x, high.x), point.y.clamp(low.y, high.y)))
    }

    /// How far a point is from the outside of an island.
    fn to_outline(&self, island: usize, point: Point) -> f64 {
        let gap = |(from, to): (Point, Point)| {
            let float = |(x, y): (i64, i64)| (x as f64, y as f64);
            let (side, reach) = (float(from.delta(to)), float(from.delta(point)));
            let length2 = side.0 * side.0 + side.1 * side.1;
            let along = side.0 * reach.0 + side.1 * reach.1;
            let share = if length2 > 0.0 { (along / length2).clamp(0.0, 1.0) } else { 0.0 };
            let (x, y) = (reach.0 - share * side.0, reach.1 - share * side.1);
            x * x + y * y
        };
        self.outside(island).segments().map(gap).fold(f64::INFINITY, f64::min)
    }
}

/// The least and the greatest coordinates; `None` for no points.
fn bounds(points: &[Point]) -> Option<Bounds> {
    let first = *points.first()?;
    Some(points.iter().fold((first, first), |(low, high), point| {
        (
            Point::new(low.x.min(point.x), low.y.min(point.y)),
            Point::new(high.x.max(point.x), high.y.max(point.y)),
        )
    }))
}
