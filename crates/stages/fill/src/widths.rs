//! How wide the beads of a wall are: walls that face each other share the room between them.
//!
//! The flank of a wall that looks away from that room lies where it lies, however wide the bead is. So the middle of a
//! narrower bead runs nearer to that flank and that of a wider one farther from it.

use crate::strand::share;
use shape::plane::facing;
use skein::{Bead, Point, Ratio, Ring};

/// The widest gap between two walls, in beads, that both take up by half of it each. A wider one has room for a bead of its
/// own.
pub const TAKEN_UP: f64 = 0.5;

/// How long a stretch of one width may be, in beads, where the width changes.
const STRETCH: f64 = 0.5;

/// How much the width may differ within a stretch, in beads: less than clay shows.
const ALIKE: f64 = 0.02;

/// A closed bead with a width for each stretch of it.
pub struct Fitted {
    /// Its corners; the first is not repeated.
    points: Vec<Point>,
    /// How wide each stretch is, in microns.
    widths: Vec<f64>,
}

/// The walls of a layer as wide as there is room, one for each ring; none for a ring that nothing faces. Two walls whose
/// middles are nearer to each other than `reach` microns share what lies between their outer flanks.
pub fn fitted(walls: &[Ring], reach: f64, step: f64) -> Vec<Option<Fitted>> {
    let cut: Vec<Ring> = walls.iter().map(|wall| in_stretches(wall, STRETCH * step)).collect();
    let gaps = facing(&cut, reach);
    let fit = |(ring, gaps): (Ring, Vec<Option<f64>>)| {
        if gaps.iter().all(Option::is_none) {
            return None;
        }
        // Half of the room between the middles, and the other half of the bead on its far side.
        let widths: Vec<f64> =
            gaps.into_iter().map(|gap| gap.map_or(step, |gap| f64::midpoint(gap, step))).collect();
        let points = towards_flank(&ring, &widths, step);
        Some(Fitted { points, widths })
    };
    cut.into_iter().zip(gaps).map(fit).collect()
}

impl Fitted {
    /// What it covers, in square microns.
    pub fn area(&self) -> f64 {
        self.stretches().map(|(from, to, width)| from.distance(to) * width).sum()
    }

    /// Every width so many times as great.
    pub fn scale(&mut self, times: f64) {
        self.widths.iter_mut().for_each(|width| *width *= times);
    }

    fn stretches(&self) -> impl Iterator<Item = (Point, Point, f64)> {
        let ends = self.points.iter().skip(1).chain(self.points.first());
        self.points.iter().zip(ends).zip(&self.widths).map(|((from, to), width)| (*from, *to, *width))
    }

    /// The corners and the flow of each stretch. Stretches that are alike and lie within `tolerance` microns of a straight
    /// line are one.
    pub fn into_stretches(self, bead: &Bead, tolerance: f64) -> (Vec<Point>, Vec<Ratio>) {
        let alike = ALIKE * bead.spacing().um();
        let (mut points, mut flows) = (Vec::new(), Vec::new());
        let stretches: Vec<(Point, Point, f64)> = self.stretches().collect();
        let mut rest = &stretches[..];
        while let Some((first, _, width)) = rest.first().copied() {
            let fits = |count: usize| {
                let (_, end, last) = rest[count - 1];
                (last - width).abs() <= alike
                    && rest[..count - 1].iter().all(|(_, corner, _)| gap(*corner, first, end) <= tolerance)
            };
            let count = (2..=rest.len().min(LONGEST)).take_while(|count| fits(*count)).last().unwrap_or(1);
            let (run, others) = rest.split_at(count);
            let length: f64 = run.iter().map(|(from, to, _)| from.distance(*to)).sum();
            let area: f64 = run.iter().map(|(from, to, width)| from.distance(*to) * width).sum();
            points.push(first);
            flows.push(share(bead, if length > 0.0 { area / length } else { width }));
            rest = others;
        }
        (points, flows)
    }
}

/// So many stretches at most become one, which keeps the search linear.
const LONGEST: usize = 32;

/// The ring with corners on its sides so that no side is longer than `most` microns.
fn in_stretches(ring: &Ring, most: f64) -> Ring {
    let mut points = Vec::with_capacity(ring.0.len() * 2);
    for (from, to) in ring.segments() {
        let (x, y) = from.delta(to);
        let count = (from.distance(to) / most).ceil().max(1.0) as i64;
        // A micron more or less is no matter; whole numbers keep it the same everywhere.
        let at = |from: i32, way: i64, index: i64| from + (way * index / count) as i32;
        points.extend((0..count).map(|index| Point::new(at(from.x, x, index), at(from.y, y, index))));
    }
    Ring(points)
}

/// The corners of a ring, each moved so that the far flank of the bead stays where that of a bead of nominal width is.
fn towards_flank(ring: &Ring, widths: &[f64], step: f64) -> Vec<Point> {
    let count = ring.0.len();
    // To the right of the way lies the far flank.
    let right = |from: Point, to: Point| {
        let (x, y) = from.delta(to);
        let length = from.distance(to).max(1.0);
        (y as f64 / length, -(x as f64) / length)
    };
    let moved = |index: usize| {
        let before = if index == 0 { count - 1 } else { index - 1 };
        let after = if index + 1 == count { 0 } else { index + 1 };
        let here = ring.0[index];
        let by = (step - f64::midpoint(widths[before], widths[index])) / 2.0;
        if by == 0.0 {
            return here;
        }
        let (one, other) = (right(ring.0[before], here), right(here, ring.0[after]));
        // A corner that turns back goes no farther than twice as far.
        let scale = by / (1.0 + one.0 * other.0 + one.1 * other.1).max(0.5);
        let along = |at: i32, way: f64| (f64::from(at) + way * scale).round() as i32;
        Point::new(along(here.x, one.0 + other.0), along(here.y, one.1 + other.1))
    };
    (0..count).map(moved).collect()
}

/// How far a point is from the straight line through two others, in microns.
fn gap(point: Point, from: Point, to: Point) -> f64 {
    let ((x, y), (u, v)) = (from.delta(to), from.delta(point));
    let length = from.distance(to);
    if length == 0.0 { from.distance(point) } else { ((x * v - y * u) as f64 / length).abs() }
}
