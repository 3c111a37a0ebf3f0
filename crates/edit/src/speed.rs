//! A faster or slower print.

use gcode::Line;
use skein::Error;

use crate::follow::{Zone, follow};
use crate::machine::{EPSILON_Z, Machine, Move};
use crate::survey::Survey;
use crate::writer::Aim;
use crate::{Edited, factor, said};

/// Changes the speed of the beads: by one factor, or from one at the bottom to another at the top.
///
/// F holds until the next F, so it is written on every move where another feed would hold otherwise; travels keep
/// theirs unless they are meant too. Start and end code keep their speeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// The factor at the lowest bead.
    pub bottom: f64,
    /// The factor at the highest bead.
    pub top: f64,
    /// Travels change as beads do.
    pub travels: bool,
}

/// A ramp goes in steps of a thousandth, or a spiral would have an F on every line.
const STEPS: f64 = 1000.0;

impl Speed {
    pub(crate) fn apply(&self, text: &[u8]) -> Result<Edited, Error> {
        let bottom = factor("the factor", self.bottom)?;
        let top = factor("the factor", self.top)?;
        let survey = Survey::of(text)?;
        let height = survey.top - survey.bottom;
        let is_ramp = bottom != top;
        if is_ramp && height <= EPSILON_Z {
            return Err(Error::new("everything is printed at one height: there is nothing to ramp over")
                .hint("give one factor"));
        }
        let at = |z: f64| {
            if !is_ramp {
                return bottom;
            }
            let share = ((z - survey.bottom) / height).clamp(0.0, 1.0);
            let exact = bottom + (top - bottom) * share;
            let stepped = (exact * STEPS).round() / STEPS;
            // A factor below half a step is no reason to stand still.
            if stepped > 0.0 { stepped } else { exact }
        };
        let aim = |zone: Zone, _: &Line, was: &Move, _: &Machine| {
            let meant = zone == Zone::Part && (was.prints() || self.travels && was.travels());
            let feed = match was.feed {
                Some(feed) if meant => Some(feed * at(was.to[2])),
                None if meant && was.prints() => {
                    return Err(Error::new("this bead has no speed: no F comes before it")
                        .hint("put a line such as `G1 F1200` before it"));
                }
                other => other,
            };
            Ok(Aim { feed, ..Aim::same(was) })
        };
        let out = follow(text, &survey, aim)?;
        let what = if self.travels { "beads and travels" } else { "beads" };
        let how = if is_ramp {
            format!("{bottom} at Z{:.3} to {top} at Z{:.3}", survey.bottom, survey.top)
        } else {
            bottom.to_string()
        };
        Ok(said(out, &[format!("the speed of {what} times {how}")]))
    }
}
