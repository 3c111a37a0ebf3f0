//! From a way in the plane to the lines of a thread.

use crate::source::share;
use crate::track::{Spot, distance, point};
use crate::turn::divided;
use skein::{Bead, Line, Move, Point3, Ratio};

/// How a way is laid.
#[derive(Clone, Copy, Debug)]
pub struct Course {
    /// How high the nozzle stands where it begins and where it ends.
    pub heights: (i32, i32),
    /// The room below the nozzle where it begins and where it ends, in microns.
    pub gaps: (f64, f64),
    /// How wide the room for the bead is, in microns.
    pub width: f64,
    /// A bead that fills the layer.
    pub bead: Bead,
}

/// Pieces of a turn along which the gap changes: so many that neighbours differ by less than anybody sees.
const PIECES: f64 = 64.0;

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

    /// Lays clay along a way. It rises and the gap changes evenly with its length.
    pub fn lay(&mut self, way: &[Spot], course: Course) {
        let length: f64 = way.windows(2).map(|side| distance(side[0], side[1])).sum();
        let even = (course.gaps.0 - course.gaps.1).abs() < 1.0;
        let fine = if even { way.to_vec() } else { divided(way, length / PIECES) };
        let (low, high) = (f64::from(course.heights.0), f64::from(course.heights.1));
        let mut so_far = 0.0;
        for side in fine.windows(2) {
            let before = so_far / length;
            so_far += distance(side[0], side[1]);
            let behind = (so_far / length).min(1.0);
            let gap = course.gaps.0 + (course.gaps.1 - course.gaps.0) * f64::midpoint(before, behind);
            let height = unit::round_within(low + (high - low) * behind, f64::from(i32::MAX));
            let mut to = place(side[1], height.map_or(course.heights.1, |height| height as i32));
            if let Some(at) = self.at.filter(|at| course.heights.0 < course.heights.1 && at.z >= to.z) {
                // A spiral rises with every line: who reads the letters only takes one that does not for its end.
                to.z = (at.z + 1).min(course.heights.1);
            }
            if self.at.is_none_or(|at| (at.x, at.y) != (to.x, to.y)) {
                self.flow(share(&course.bead, gap, course.width));
                self.go(to);
            }
        }
    }

    /// What follows is of the nominal section.
    pub fn finish(mut self) -> Vec<Line> {
        self.flow(Ratio::ONE);
        self.lines
    }

    fn flow(&mut self, flow: Ratio) {
        if self.flow.unwrap_or(Ratio::ONE) != flow {
            self.lines.push(Line::Flow(flow));
            self.flow = Some(flow);
        }
    }

    fn go(&mut self, to: Point3) {
        self.lines.push(Line::Move(Move::to(to)));
        self.at = Some(to);
    }
}

fn place(at: Spot, z: i32) -> Point3 {
    let at = point(at);
    Point3 { x: at.x, y: at.y, z }
}
