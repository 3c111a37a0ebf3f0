//! From a way in the plane to the lines of a thread.

use crate::source::share;
use crate::track::{Spot, between, distance, point};
use skein::{Bead, Line, Move, Point3, Ratio};

/// A corner of a way that is laid.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Where it is.
    pub at: Spot,
    /// How high the nozzle stands there, in microns.
    pub height: f64,
    /// The room below it down to what is laid already, in microns.
    pub gap: f64,
    /// How wide the room is for the bead that ends there, in microns.
    pub width: f64,
}

impl Step {
    /// A level way.
    pub fn level(way: &[Spot], height: f64, gap: f64, width: f64) -> Vec<Self> {
        way.iter().map(|at| Self { at: *at, height, gap, width }).collect()
    }

    fn between(&self, to: &Self, share: f64) -> Self {
        Self {
            at: between(self.at, to.at, share),
            height: self.height + (to.height - self.height) * share,
            gap: self.gap + (to.gap - self.gap) * share,
            width: to.width,
        }
    }
}

/// The gap changes by this share of a layer from one piece to the next at most: less than anybody sees.
const PIECES: f64 = 64.0;

/// Flows that differ by less than this are one: it is a fifth of a percent, and every change is a line.
const SAME_FLOW: i32 = 2_000;

/// A piece shorter than so many microns is left to the next: its direction is that of the rounding.
const SHORTEST: f64 = 5.0;

/// The lines of a thread, or of a part of one.
#[derive(Debug, Default)]
pub struct Thread {
    /// The lines.
    pub lines: Vec<Line>,
    flow: Option<Ratio>,
    at: Option<Point3>,
}

impl Thread {
    /// Goes to a place without clay.
    pub fn travel(&mut self, to: Spot, height: i32) {
        self.go(place(to, height));
    }

    /// Clay flows from here.
    pub fn start(&mut self) {
        self.lines.push(Line::On);
    }

    /// Clay stops.
    pub fn stop(&mut self) {
        self.lines.push(Line::Off);
    }

    /// Lays clay along a way, as much as fills the gap below it.
    pub fn lay(&mut self, way: &[Step], bead: &Bead) {
        let finest = bead.height.um() / PIECES;
        // What comes from the layer below begins where that has ended.
        if let (None, Some(first)) = (self.at, way.first()) {
            self.at = Some(place(first.at, whole(first.height)));
        }
        for side in way.windows(2) {
            let (from, to) = (&side[0], &side[1]);
            // A little less, so that rounding does not add a piece.
            let parts = ((to.gap - from.gap).abs() / finest - 1e-6).ceil().max(1.0);
            let mut before = *from;
            for part in 1..=parts as usize {
                let behind = from.between(to, part as f64 / parts);
                self.piece(&before, &behind, bead);
                before = behind;
            }
        }
    }

    /// A straight piece of bead. A spiral rises with every line, for who reads the letters only takes one that does not for
    /// its end: a corner to which it would rise by less than a micron goes to the next, or is left out.
    fn piece(&mut self, from: &Step, to: &Step, bead: &Bead) {
        let mut place = place(to.at, whole(to.height));
        if let Some(at) = self.at.filter(|at| from.height < to.height && at.z >= place.z) {
            if f64::from(at.z) >= to.height {
                return;
            }
            place.z = at.z + 1;
        }
        let far = |at: Point3| distance([f64::from(at.x), f64::from(at.y)], to.at) >= SHORTEST;
        if self.at.is_none_or(far) {
            self.flow(share(bead, f64::midpoint(from.gap, to.gap), to.width));
            self.go(place);
        }
    }

    /// What follows is of the nominal section.
    pub fn finish(mut self) -> Vec<Line> {
        if self.flow.is_some_and(|flow| flow != Ratio::ONE) {
            self.lines.push(Line::Flow(Ratio::ONE));
        }
        self.lines
    }

    fn flow(&mut self, flow: Ratio) {
        let now = self.flow.unwrap_or(Ratio::ONE);
        if (now.0 - flow.0).abs() > SAME_FLOW {
            self.lines.push(Line::Flow(flow));
            self.flow = Some(flow);
        }
    }

    fn go(&mut self, to: Point3) {
        self.lines.push(Line::Move(Move::to(to)));
        self.at = Some(to);
    }
}

fn whole(height: f64) -> i32 {
    unit::round_within(height, f64::from(i32::MAX)).unwrap_or(0) as i32
}

fn place(at: Spot, z: i32) -> Point3 {
    let at = point(at);
    Point3 { x: at.x, y: at.y, z }
}
