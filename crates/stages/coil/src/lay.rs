//! From a way in the plane to the lines of a thread.

use crate::source::share;
use crate::track::{Spot, between, point, spot, square};
use skein::{Bead, Line, Move, Point, Point3, Ratio};

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

/// Where corners crowd, the nozzle may be off its height by one part in so many of a layer.
const SLACK: i32 = 100;

/// A piece shorter than so many microns is left to the next: its direction is that of the rounding.
const SHORTEST: f64 = 5.0;

/// What is as near to the end of the way, or nearer by what rounding moves both, is left to that.
const NEAR_END: f64 = 7.0;

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
        // A little less, so that rounding does not add a piece.
        let parts = |side: &[Step]| ((side[1].gap - side[0].gap).abs() / finest - 1e-6).ceil().max(1.0);
        let parts: Vec<f64> = way.windows(2).map(parts).collect();
        let Some(end) = way.last() else { return };
        let rising = way.windows(2).zip(&parts).filter(|(side, _)| rises(side));
        let mut ladder = Ladder {
            end: whole(end.height),
            left: rising.map(|(_, parts)| *parts as usize).sum(),
            slack: (bead.height.0 / SLACK).max(1),
        };
        for (index, (side, parts)) in way.windows(2).zip(&parts).enumerate() {
            let (from, to) = (&side[0], &side[1]);
            let (last_side, rises) = (index + 2 == way.len(), usize::from(rises(side)));
            let mut before = *from;
            for part in 1..=*parts as usize {
                let share = part as f64 / parts;
                let behind = from.between(to, share);
                ladder.left -= rises;
                if share == 1.0 && last_side || square(behind.at, end.at) >= NEAR_END * NEAR_END {
                    self.piece(&before, &behind, &ladder, bead);
                }
                before = behind;
            }
        }
    }

    /// A straight piece of bead.
    fn piece(&mut self, from: &Step, to: &Step, ladder: &Ladder, bead: &Bead) {
        let mut place = place(to.at, whole(to.height));
        if let (Some(at), true) = (self.at, from.height < to.height) {
            let Some(height) = ladder.above(at.z, place.z) else { return };
            place.z = height;
        }
        let far = |at: Point3| square(spot(Point::new(at.x, at.y)), to.at) >= SHORTEST * SHORTEST;
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

/// The heights of a way that rises. It rises with every line, by a micron at least, for who reads the letters only takes one
/// that does not for its end.
struct Ladder {
    /// How high the way ends.
    end: i32,
    /// How many pieces that rise are to come behind this one.
    left: usize,
    /// How many microns a corner may be off its height, so that all have one of their own where they crowd.
    slack: i32,
}

impl Ladder {
    /// A height above one, for a corner that should have another; `None` when there is none left and the corner goes to the
    /// next. The end always has its own.
    fn above(&self, at: i32, wanted: i32) -> Option<i32> {
        let left = i32::try_from(self.left).unwrap_or(i32::MAX);
        let most = self.end.saturating_sub(left).max(wanted - self.slack).min(self.end - left.min(1));
        let height = wanted.max(at + 1).min(most);
        (height > at && height <= wanted + self.slack).then_some(height)
    }
}

/// Whether a side of a way rises.
fn rises(side: &[Step]) -> bool {
    side[0].height < side[1].height
}

fn whole(height: f64) -> i32 {
    unit::round_within(height, f64::from(i32::MAX)).unwrap_or(0) as i32
}

fn place(at: Spot, z: i32) -> Point3 {
    let at = point(at);
    Point3 { x: at.x, y: at.y, z }
}
