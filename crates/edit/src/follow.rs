//! Goes through a file and lets an edit say what each move shall do.

use gcode::{Code, Line};
use skein::Error;

use crate::machine::{Act, EPSILON_Z, Machine, Move};
use crate::survey::Survey;
use crate::tape::{line_end, raw_lines, split_bom};
use crate::writer::{Aim, Writer};

/// To what a line belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Zone {
    /// Start code, with its purge lines.
    Start,
    /// The part, with the way to it and what is wiped behind it.
    Part,
    /// End code: from the first lift, home, mode or machine command behind the last bead.
    End,
}

/// Follows a file from zone to zone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Zones {
    lead: usize,
    last: usize,
    ended: bool,
}

impl Zones {
    pub(crate) fn of(survey: &Survey) -> Self {
        Self { lead: survey.lead, last: survey.last, ended: false }
    }

    /// The zone of the line at `index`, which does `act`.
    pub(crate) fn feed(&mut self, index: usize, line: &Line, act: &Act) -> Zone {
        if index < self.lead {
            return Zone::Start;
        }
        if index > self.last {
            self.ended |= match act {
                Act::Move(step) => step.rise() > EPSILON_Z,
                Act::Home => true,
                Act::Other => line.command.is_some_and(|command| command != G92),
            };
        }
        if self.ended { Zone::End } else { Zone::Part }
    }
}

/// Writes `text` with every move doing what `aim` says of it.
///
/// # Errors
/// Those of `aim`, with the line.
pub(crate) fn follow(
    text: &[u8],
    survey: &Survey,
    mut aim: impl FnMut(Zone, &Line, &Move, &Machine) -> Result<Aim, Error>,
) -> Result<Vec<u8>, Error> {
    let (bom, body) = split_bom(text);
    let mut writer = Writer::new(text.len(), line_end(text));
    writer.out.extend_from_slice(bom);
    let mut machine = Machine::new();
    let mut zones = Zones::of(survey);
    let mut line = Line::default();
    for (index, raw) in raw_lines(body).enumerate() {
        line.read(raw.text);
        let act = machine.obey(&line);
        let zone = zones.feed(index, &line, &act);
        match &act {
            Act::Move(step) => {
                let aim = aim(zone, &line, step, &writer.machine)
                    .map_err(|error| error.at(skein::Place::Line(index + 1)))?;
                writer.go(raw, &line, step, &aim);
            }
            Act::Home | Act::Other => {
                if zone == Zone::Part && line.command.is_some_and(is_curve) {
                    return Err(refuse_curve(index));
                }
                writer.keep(raw, &line);
            }
        }
    }
    Ok(writer.out)
}

/// Refuses a curve that no machine here follows.
pub(crate) fn refuse_curve(index: usize) -> Error {
    Error::line(index, "the part has a curve that cannot be followed (G5, G6)")
        .hint("let the slicer write lines or arcs (G1, G2, G3)")
}

/// Splines and direct steps: where they lead is not known here.
pub(crate) fn is_curve(command: Code) -> bool {
    command.letter == b'G' && (5000..7000).contains(&command.thousandths)
}

/// The height for a move of the end code when the part ends at `top` instead of `old_top`: as it is, but never nearer to
/// the clay than it was. Nothing for a move that does not change Z or that goes below the top.
pub(crate) fn clear(was: &Move, now: &Machine, old_top: f64, top: f64) -> Option<f64> {
    let above = was.to[2] - old_top;
    let applies = was.climbs && was.known[2] && above >= -EPSILON_Z && !now.is_relative();
    applies.then(|| was.to[2].max(top + above))
}

const G92: Code = Code::g(92);
