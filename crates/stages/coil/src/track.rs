//! A closed way in the plane, measured by its length.

use skein::{Point, Ring};

/// A place in microns.
pub type Spot = [f64; 2];

/// How far apart two places are.
pub fn distance(a: Spot, b: Spot) -> f64 {
    square(a, b).sqrt()
}

/// The square of their distance.
pub fn square(a: Spot, b: Spot) -> f64 {
    (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])
}

/// The place at a share of the way from one to another.
pub fn between(a: Spot, b: Spot, share: f64) -> Spot {
    [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share]
}

/// The share of a straight side at which it is nearest to a place: between 0 and 1, and 1 where the side has no length.
pub fn foot(from: Spot, to: Spot, place: Spot) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    if square == 0.0 {
        return 1.0;
    }
    let dot = (place[0] - from[0]) * along[0] + (place[1] - from[1]) * along[1];
    (dot / square).clamp(0.0, 1.0)
}

/// The way with more corners, so that no side is longer than a step.
pub fn divided(way: &[Spot], step: f64) -> Vec<Spot> {
    let mut fine = Vec::with_capacity(way.len() * 2);
    fine.extend(way.first());
    for side in way.windows(2) {
        let parts = (distance(side[0], side[1]) / step).ceil().max(1.0);
        fine.extend((1..parts as usize).map(|part| between(side[0], side[1], part as f64 / parts)));
        fine.push(side[1]);
    }
    fine
}

/// What is left of a way behind a length from its start.
pub fn behind(way: &[Spot], at: f64) -> Vec<Spot> {
    let mut left = at;
    for (index, side) in way.windows(2).enumerate() {
        let length = distance(side[0], side[1]);
        if length > left {
            let mut rest = vec![between(side[0], side[1], left / length)];
            rest.extend_from_slice(&way[index + 1..]);
            return rest;
        }
        left -= length;
    }
    way.last().copied().into_iter().collect()
}

/// The place of a point.
pub fn spot(point: Point) -> Spot {
    [f64::from(point.x), f64::from(point.y)]
}

/// The nearest point in whole microns.
pub fn point(at: Spot) -> Point {
    let whole = |value: f64| unit::round_within(value, f64::from(i32::MAX)).unwrap_or(0) as i32;
    Point::new(whole(at[0]), whole(at[1]))
}

/// A closed way, counter-clockwise.
#[derive(Clone, Debug)]
pub struct Track {
    /// Its corners, the first again at the end.
    corners: Vec<Spot>,
    /// The length up to each corner.
    lengths: Vec<f64>,
}

impl Track {
    /// The way along a ring; nothing for less than a triangle.
    pub fn new(ring: &Ring) -> Option<Self> {
        let mut corners: Vec<Spot> = ring.0.iter().copied().map(spot).collect();
        corners.dedup();
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if corners.len() < 3 {
            return None;
        }
        if ring.area2() < 0 {
            corners.reverse();
        }
        corners.push(corners[0]);
        let mut length = 0.0;
        let mut lengths = vec![0.0];
        lengths.extend(corners.windows(2).map(|side| {
            length += distance(side[0], side[1]);
            length
        }));
        Some(Self { corners, lengths })
    }

    /// How long it is once round.
    pub fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// The place at a length from the first corner.
    pub fn at(&self, length: f64) -> Spot {
        let length = length.rem_euclid(self.length());
        let side = self.lengths.partition_point(|end| *end <= length).clamp(1, self.corners.len() - 1);
        let (from, to) = (self.lengths[side - 1], self.lengths[side]);
        between(self.corners[side - 1], self.corners[side], (length - from) / (to - from))
    }

    /// The length from the first corner to the place that is nearest to another.
    pub fn nearest(&self, to: Spot) -> f64 {
        let mut best = (f64::INFINITY, 0.0);
        for (index, side) in self.corners.windows(2).enumerate() {
            let share = foot(side[0], side[1], to);
            let gap = square(between(side[0], side[1], share), to);
            if gap < best.0 {
                let (start, end) = (self.lengths[index], self.lengths[index + 1]);
                best = (gap, start + share * (end - start));
            }
        }
        best.1
    }

    /// The way from a place for so long, backwards when that is negative: at most once round.
    pub fn way(&self, from: f64, length: f64) -> Vec<Spot> {
        if length < 0.0 {
            let mut way = self.way(from + length, -length);
            way.reverse();
            return way;
        }
        let round = self.length();
        let from = from.rem_euclid(round);
        let to = from + length.min(round);
        // A corner that lies nearer than a micron to an end is that end.
        let passed = |at: f64| at > from + 1.0 && at < to - 1.0;
        let corners = self.corners.iter().zip(&self.lengths).skip(1);
        let again = corners.clone().map(|(corner, at)| (*corner, at + round));
        let mut way = vec![self.at(from)];
        way.extend(
            corners
                .map(|(corner, at)| (*corner, *at))
                .chain(again)
                .filter(|(_, at)| passed(*at))
                .map(|it| it.0),
        );
        way.push(if length >= round { way[0] } else { self.at(to) });
        way
    }
}
