//! The geometry of one corner.

use skein::{Move, Point3, along};

/// A corner with the arc that touches both its sides.
pub(crate) struct Corner {
    /// Where the rounding begins.
    pub(crate) before: Point3,
    /// Where it ends.
    pub(crate) after: Point3,
    /// From `before` to the centre of the arc, in microns.
    pub(crate) center: (i32, i32),
    /// The radius of the arc, in microns.
    pub(crate) radius: f64,
    /// Which way it turns.
    pub(crate) clockwise: bool,
    /// How far it turns, in radians.
    turn: f64,
}

/// What turns less than this is a straight line: a rounding of it would be shorter than a micron is wide.
const STRAIGHT: f64 = 0.01;

/// What turns more than this goes back on itself, and no arc touches both sides.
const BACK: f64 = 3.1;

impl Corner {
    /// The corner at `at` on the way from `from` to `to`, with `cut` microns taken from each side.
    pub(crate) fn new(from: Point3, at: Point3, to: Point3, cut: f64) -> Option<Self> {
        let (a, b) = (side(from, at), side(at, to));
        let cross = a.0 * b.1 - a.1 * b.0;
        let turn = libm::atan2(cross, a.0 * b.0 + a.1 * b.1);
        if !(STRAIGHT..BACK).contains(&turn.abs()) || cut < 1.0 {
            return None;
        }
        let radius = cut / libm::tan(turn.abs() / 2.0);
        let length = libm::hypot(a.0, a.1);
        // The centre lies square to the first side, on the side to which the corner turns.
        let out = radius * turn.signum() / length;
        Some(Self {
            before: along(at, from, cut),
            after: along(at, to, cut),
            center: ((-a.1 * out).round() as i32, (a.0 * out).round() as i32),
            radius,
            clockwise: turn < 0.0,
            turn: turn.abs(),
        })
    }

    /// How many chords make a smooth arc: none longer than 0.7 bead widths, and none that turns more than 38°
    /// (stages.md §6.21).
    pub(crate) fn segments(&self, width: f64) -> u32 {
        (1.5 * self.turn).min(self.turn * self.radius / (0.7 * width)).ceil().max(1.0) as u32
    }

    /// The ends of so many chords, the last at the end of the arc.
    pub(crate) fn chords(&self, count: u32) -> impl Iterator<Item = Point3> + '_ {
        let (i, j) = (f64::from(self.center.0), f64::from(self.center.1));
        let sign = if self.clockwise { -1.0 } else { 1.0 };
        (1..=count).map(move |index| {
            if index == count {
                return self.after;
            }
            let share = f64::from(index) / f64::from(count);
            let (sin, cos) = libm::sincos(sign * self.turn * share);
            let rise = f64::from(self.after.z - self.before.z) * share;
            Point3 {
                x: self.before.x + (i - i * cos + j * sin).round() as i32,
                y: self.before.y + (j - i * sin - j * cos).round() as i32,
                z: self.before.z + rise.round() as i32,
            }
        })
    }
}

/// Whether a way turns back on itself at a place, with both sides at least so long.
pub(crate) fn turns_back(from: Point3, at: Point3, to: Point3, least: f64) -> bool {
    let sides = [Move::to(at).length(from), Move::to(to).length(at)];
    let (a, b) = (side(at, from), side(at, to));
    let straight = libm::hypot(a.0, a.1) * libm::hypot(b.0, b.1);
    sides.iter().all(|side| *side >= least) && straight > 0.0 && a.0 * b.0 + a.1 * b.1 > 0.95 * straight
}

fn side(from: Point3, to: Point3) -> (f64, f64) {
    (f64::from(to.x) - f64::from(from.x), f64::from(to.y) - f64::from(from.y))
}
