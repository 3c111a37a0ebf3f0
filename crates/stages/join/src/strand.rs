//! One bead as it comes from the stages before, measured along its length.

use skein::{Feature, Point, Ratio};

/// One unbroken bead.
#[derive(Clone, Debug, PartialEq)]
pub struct Strand {
    /// What it is for.
    pub feature: Feature,
    /// Its corners; a closed one does not repeat its first.
    points: Vec<Point>,
    /// The share of a nominal bead's section on each side, as many as there are sides.
    flows: Vec<f64>,
    /// How far along each side begins, and at last how long it is, in microns.
    starts: Vec<f64>,
    /// Whether it ends where it starts.
    pub closed: bool,
}

impl Strand {
    /// A bead through points, with the flow of each side; nothing when it has no length.
    pub fn new(feature: Feature, mut points: Vec<Point>, flows: &[Ratio]) -> Option<Self> {
        let closed = points.len() > 3 && points.first() == points.last();
        let mut starts = vec![0.0];
        let mut length = 0.0;
        for pair in points.windows(2) {
            length += pair[0].distance(pair[1]);
            starts.push(length);
        }
        if closed {
            points.pop();
        }
        let flows = flows.iter().map(|flow| flow.f64()).collect();
        (length > 0.0).then_some(Self { feature, points, flows, starts, closed })
    }

    /// A bead through points, with a flow for each side; a closed one does not repeat its first point. Nothing when it has
    /// no length.
    pub fn measured(feature: Feature, points: Vec<Point>, flows: Vec<f64>, closed: bool) -> Option<Self> {
        let ends = points.iter().skip(1).chain(points.first().filter(|_| closed));
        let mut length = 0.0;
        let lengths = points.iter().zip(ends).map(|(from, to)| {
            length += from.distance(*to);
            length
        });
        let starts: Vec<f64> = std::iter::once(0.0).chain(lengths).collect();
        (length > 0.0).then_some(Self { feature, points, flows, starts, closed })
    }

    /// Its length in microns.
    pub fn length(&self) -> f64 {
        self.starts.last().copied().unwrap_or(0.0)
    }

    /// Its corners.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The share of a nominal section on each side.
    pub fn flows(&self) -> impl Iterator<Item = f64> {
        self.flows.iter().copied()
    }

    /// The sides, each with the length at which it begins.
    pub fn sides(&self) -> impl Iterator<Item = (f64, Point, Point)> {
        (0..self.flows.len()).map(|side| (self.starts[side], self.points[side], self.corner(side + 1)))
    }

    /// The mean share of a nominal section.
    pub fn mean_flow(&self) -> f64 {
        self.laid(0.0, self.length()) / self.length()
    }

    /// Length times flow between two places, `from` before `to`; of a closed one the places may lie rounds apart.
    pub fn laid(&self, from: f64, to: f64) -> f64 {
        let mut sum = 0.0;
        self.walk(from, to, |piece| sum += (piece.to - piece.from) * piece.flow);
        sum
    }

    /// The place at a length.
    pub fn at(&self, length: f64) -> Point {
        let length = self.wrapped(length);
        let side = self.side(length);
        let (from, to) = (self.points[side], self.corner(side + 1));
        let whole = self.starts[side + 1] - self.starts[side];
        let share = if whole > 0.0 { ((length - self.starts[side]) / whole).clamp(0.0, 1.0) } else { 0.0 };
        let between =
            |from: i32, to: i32| (f64::from(from) + (f64::from(to) - f64::from(from)) * share).round() as i32;
        Point::new(between(from.x, to.x), between(from.y, to.y))
    }

    /// Goes through the sides between two places in the direction of the strand.
    pub fn walk(&self, from: f64, to: f64, mut piece: impl FnMut(Piece)) {
        let mut here = from;
        // A side that is passed takes at least the next one, so that rounding cannot hold the walk.
        let mut side = self.side(self.wrapped(from));
        let whole = self.length();
        let mut round = if self.closed { (from / whole).floor() * whole } else { 0.0 };
        while here < to {
            let end = (round + self.starts[side + 1]).max(here).min(to);
            let whole_side = end == round + self.starts[side + 1];
            let place = if whole_side { self.corner(side + 1) } else { self.at(end) };
            piece(Piece { from: here, to: end, end: place, flow: self.flows[side] });
            here = end;
            side += 1;
            if side == self.flows.len() {
                if !self.closed {
                    break;
                }
                side = 0;
                round += whole;
            }
        }
    }

    /// A length within the first round.
    pub fn wrapped(&self, length: f64) -> f64 {
        if self.closed { length.rem_euclid(self.length()) } else { length.clamp(0.0, self.length()) }
    }

    fn side(&self, length: f64) -> usize {
        let after = self.starts.partition_point(|start| *start <= length);
        after.saturating_sub(1).min(self.flows.len() - 1)
    }

    fn corner(&self, index: usize) -> Point {
        if index == self.points.len() { self.points[0] } else { self.points[index] }
    }
}

/// A part of a side.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// Where along the strand it begins.
    pub from: f64,
    /// Where along the strand it ends.
    pub to: f64,
    /// The place where it ends.
    pub end: Point,
    /// The share of a nominal section.
    pub flow: f64,
}
