//! A rim: the last turn once more.

use gcode::Line;
use skein::Error;

use crate::follow::{Zone, Zones, clear};
use crate::machine::{Act, EPSILON_Z, Machine};
use crate::survey::Survey;
use crate::tape::{line_end, raw_lines, split_bom};
use crate::turn::{Leg, bead_before, last_turn};
use crate::writer::{Aim, Writer};
use crate::{Edited, amount, said};

/// Repeats the last turn at the height where the bead ends, each time higher by `rise`.
///
/// Under the first repetition of a spiral the last turn still climbs, so there is less and less room: its clay follows
/// the gap, and the rim becomes level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rim {
    /// How often.
    pub turns: u32,
    /// How much higher each turn lies than the one before, mm.
    pub rise: f64,
    /// The clay of a turn against that of the last one; 0 smooths the rim without clay.
    pub flow: f64,
}

/// More turns than a pot has.
const MOST_TURNS: u32 = 1000;

impl Rim {
    pub(crate) fn apply(&self, text: &[u8]) -> Result<Edited, Error> {
        if self.turns == 0 || self.turns > MOST_TURNS {
            return Err(Error::new(format!("{} turns are asked for", self.turns))
                .hint(format!("give a number between 1 and {MOST_TURNS}")));
        }
        amount("the rise of a turn", self.rise, 100.0)?;
        amount("the flow", self.flow, 100.0)?;
        let survey = Survey::of(text)?;
        let turn = last_turn(&bead_before(text, survey.last)).ok_or_else(|| {
            Error::new("the last bead does not come round, so there is no turn to repeat")
                .hint("the file must end with a closed wall or a spiral")
                .at(skein::Place::Line(survey.last + 1))
        })?;
        refuse_waves(&turn)?;

        let (bom, body) = split_bom(text);
        let mut writer = Writer::new(text.len(), line_end(text));
        writer.out.extend_from_slice(bom);
        let mut machine = Machine::new();
        let mut zones = Zones::of(&survey);
        let mut line = Line::default();
        let raised = f64::from(self.turns) * self.rise;
        for (index, raw) in raw_lines(body).enumerate() {
            line.read(raw.text);
            let act = machine.obey(&line);
            let zone = zones.feed(index, &line, &act);
            match act {
                Act::Move(step) if index > survey.last => {
                    let height = match zone {
                        Zone::End => clear(&step, &writer.machine, survey.top, survey.top + raised),
                        _ => step.known[2].then_some(step.to[2] + raised),
                    };
                    writer.go(raw, &line, &step, &Aim { to: [None, None, height], ..Aim::same(&step) });
                }
                Act::Move(step) => writer.go(raw, &line, &step, &Aim::same(&step)),
                Act::Home | Act::Other => writer.keep(raw, &line),
            }
            if index == survey.last {
                writer.end_line();
                self.draw(&mut writer, &turn, &machine);
            }
        }
        let what = if self.flow == 0.0 { "without clay".to_owned() } else { format!("flow {}", self.flow) };
        let sentence = format!(
            "the last turn {} times more from Z{:.3}, each {} mm higher, {what}",
            self.turns, survey.top, self.rise
        );
        Ok(said(writer.out, &[sentence]))
    }

    /// Prints the turns.
    fn draw(&self, writer: &mut Writer, turn: &[Leg], machine: &Machine) {
        let (Some(first), Some(last)) = (turn.first(), turn.last()) else { return };
        let top = last.to[2];
        let pitch = top - first.from[2];
        let is_spiral = pitch > EPSILON_Z;
        for number in 1..=self.turns {
            writer.insert(&format!("; edit rim: turn {number}"));
            let height = top + f64::from(number) * self.rise;
            for leg in turn {
                let room = if is_spiral && number == 1 {
                    (height - f64::midpoint(leg.from[2], leg.to[2])) / pitch
                } else {
                    1.0
                };
                let to = [Some(leg.to[0]), Some(leg.to[1]), Some(height)];
                writer.draw(to, leg.clay * self.flow * room, leg.feed);
            }
        }
        if machine.feed() != writer.machine.feed() {
            writer.draw([None; 3], 0.0, machine.feed());
        }
        writer.call_e(machine.e_word() * machine.scale());
    }
}

/// A turn that falls somewhere would lie in the air at one height, and in the clay at another.
fn refuse_waves(turn: &[Leg]) -> Result<(), Error> {
    if turn.iter().any(|leg| leg.to[2] < leg.from[2] - EPSILON_Z) {
        return Err(Error::new("the last turn rises and falls, so no level rim fits on it")
            .hint("a wavy rim cannot be repeated"));
    }
    Ok(())
}
