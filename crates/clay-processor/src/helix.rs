//! How often a climb goes round, and how much it rises in a turn.
//!
//! A closed outline turns by 360° in all, whatever its form and wherever its middle is. So the turns of a spiral are
//! the sum of its changes of direction, and no axis has to be found.

use std::f64::consts::TAU;

use crate::motion::Move;
use crate::report::Pitch;

/// A turn is complete so much early: sums round.
const ROUNDING: f64 = 1e-6;

/// A bend of more than this goes back, rad; to which side is chance then.
const BACK: f64 = TAU * (170.0 / 360.0);

/// A climb that goes on.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Helix {
    heading: Option<(f64, f64)>,
    /// Counter-clockwise, rad.
    turned: f64,
    risen: f64,
    /// Whole turns, and how far it had risen behind the last of them.
    whole: u32,
    risen_by_whole: f64,
    steepest: Option<f64>,
    top: Option<f64>,
}

impl Helix {
    /// The climb goes on with a move.
    #[inline]
    pub(crate) fn go_on(&mut self, step: &Move) {
        let heading = step.heading();
        if heading != (0.0, 0.0) {
            if let Some(before) = self.heading {
                self.turned += self.bend(before, heading);
                self.complete_turns();
            }
            let sweep = step.arc.map_or(0.0, |arc| arc.sweep);
            self.turned += sweep;
            self.heading = Some(rotated(heading, sweep));
        }
        self.risen += step.rise;
        if step.arc.is_some() {
            self.complete_turns();
        }
        self.top = step.to;
    }

    /// The change of direction. Where the way goes back on itself, as around the tip of a thin part, it turns as all
    /// of it does.
    fn bend(&self, before: (f64, f64), heading: (f64, f64)) -> f64 {
        let bend = angle(before, heading);
        let is_back = bend.abs() > BACK && bend * self.turned < 0.0;
        if is_back { bend + TAU * self.turned.signum() } else { bend }
    }

    /// What is known of it at its end.
    pub(crate) fn pitch(&self) -> Pitch {
        let mut end = *self;
        // The last turn ends where the nozzle comes back to, which no move behind it shows.
        end.complete_turns();
        let rise = (end.whole > 0).then(|| end.risen_by_whole / f64::from(end.whole));
        Pitch { turns: self.turned.abs() / TAU, rise, steepest: end.steepest, top: self.top }
    }

    #[inline]
    fn complete_turns(&mut self) {
        if self.turned.abs() + ROUNDING >= f64::from(self.whole.saturating_add(1)) * TAU {
            let rise = self.risen - self.risen_by_whole;
            self.steepest = Some(self.steepest.map_or(rise, |most| most.max(rise)));
            self.risen_by_whole = self.risen;
            self.whole = self.whole.saturating_add(1);
        }
    }
}

/// The angle from one direction to another, counter-clockwise, within a half turn.
fn angle(a: (f64, f64), b: (f64, f64)) -> f64 {
    (a.0 * b.1 - a.1 * b.0).atan2(a.0 * b.0 + a.1 * b.1)
}

fn rotated((x, y): (f64, f64), by: f64) -> (f64, f64) {
    if by == 0.0 {
        return (x, y);
    }
    let (sin, cos) = by.sin_cos();
    (x * cos - y * sin, x * sin + y * cos)
}
