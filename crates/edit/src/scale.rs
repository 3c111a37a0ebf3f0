//! A larger or smaller part.

use gcode::Line;
use skein::Error;

use crate::follow::{Zone, clear, follow};
use crate::machine::{Machine, Move, Point};
use crate::survey::Survey;
use crate::writer::Aim;
use crate::{Edited, factor, said};

/// Scales the part about its middle and the bed.
///
/// The path grows with the factor and so does the height of a layer; the width of a bead is the nozzle's and does not.
/// E is a bead's section times its path, so it goes with the square of the factor, with the cube if the nozzle is
/// scaled too, and with the factor alone when only Z is scaled. Primes and retractions belong to the nozzle and stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// How large.
    pub size: Size,
    /// What is scaled.
    pub axes: Axes,
    /// The bead becomes wider too: another nozzle, scaled like the part.
    pub bead: bool,
}

/// How large the part becomes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Size {
    /// So many times as large.
    Factor(f64),
    /// So high, mm.
    Height(f64),
}

/// Which axes are scaled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// All alike.
    Xyz,
    /// The height alone.
    Z,
}

impl Scale {
    pub(crate) fn apply(&self, text: &[u8]) -> Result<Edited, Error> {
        let survey = Survey::of(text)?;
        let by = self.factor(&survey)?;
        let stretch: Point = match self.axes {
            Axes::Xyz => [by; 3],
            Axes::Z => [1.0, 1.0, by],
        };
        let section = if self.bead { by * stretch[0] } else { by };
        let new_top = survey.top * by;
        let centre = [survey.centre[0], survey.centre[1], 0.0];
        let aim = |zone: Zone, _: &Line, was: &Move, now: &Machine| {
            Ok(match zone {
                Zone::Start => Aim::same(was),
                Zone::End => Aim { to: [None, None, clear(was, now, survey.top, new_top)], ..Aim::same(was) },
                Zone::Part => Aim {
                    to: targets(was, now, stretch, centre, survey.top),
                    clay: clay(was, section, stretch)?,
                    feed: None,
                    arc: arc_factor(was, stretch)?,
                },
            })
        };
        let out = follow(text, &survey, aim)?;
        let axes = if self.axes == Axes::Z { "Z" } else { "X, Y and Z" };
        let [x, y] = survey.centre;
        let about = match self.axes {
            Axes::Xyz => format!("about X{x:.3} Y{y:.3} on the bed"),
            Axes::Z => "from the bed".to_owned(),
        };
        let law = match (self.axes, self.bead) {
            (Axes::Z, _) => "E goes with the section of the bead",
            (Axes::Xyz, false) => "E goes with the square: the bead keeps its width",
            (Axes::Xyz, true) => "E goes with the cube: the bead is scaled too",
        };
        Ok(said(
            out,
            &[
                format!("{axes} times {by:.6}, {about}; height {:.3} instead of {:.3}", new_top, survey.top),
                law.to_owned(),
            ],
        ))
    }

    fn factor(&self, survey: &Survey) -> Result<f64, Error> {
        match self.size {
            Size::Factor(by) => factor("the factor", by),
            Size::Height(height) => {
                factor("the height", height)?;
                if survey.top <= 0.0 {
                    return Err(Error::new("the part has no height above the bed")
                        .hint("give a factor instead of a height"));
                }
                factor("the factor for this height", height / survey.top)
            }
        }
    }
}

/// Where the axes of a move shall go. An axis that was never told anything is left alone; of an unknown place the way
/// is stretched. What lies above the part keeps its distance to it.
fn targets(was: &Move, now: &Machine, stretch: Point, centre: Point, top: f64) -> [Option<f64>; 3] {
    std::array::from_fn(|axis| {
        let (from, to, by) = (was.from[axis], was.to[axis], stretch[axis]);
        let moves = was.known[axis] || to != from;
        (moves && by != 1.0).then(|| match was.known[axis] {
            true if axis == 2 && to > top => top * by + (to - top),
            true => centre[axis] + (to - centre[axis]) * by,
            false => now.at(axis) + (to - from) * by,
        })
    })
}

/// The clay of a bead goes with its section and its path; that of a prime or a retraction is not of the part.
fn clay(was: &Move, section: f64, stretch: Point) -> Result<f64, Error> {
    if !was.prints() {
        return Ok(was.clay);
    }
    arc_factor(was, stretch)?;
    let before = was.length([1.0; 3]);
    let longer = if before > 0.0 { was.length(stretch) / before } else { stretch[0] };
    Ok(was.clay * section * longer)
}

/// How much larger the circle is. A circle that is stretched in one direction is none.
fn arc_factor(was: &Move, stretch: Point) -> Result<f64, Error> {
    let Some(arc) = &was.arc else { return Ok(1.0) };
    let [a, b] = arc.plane.axes();
    if stretch[a] == stretch[b] {
        Ok(stretch[a])
    } else {
        Err(Error::new("an arc that stands upright cannot be scaled in Z alone: it would be no arc")
            .hint("scale all axes, or let the slicer write lines"))
    }
}
