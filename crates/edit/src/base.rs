//! Another base under a spiral.

use clay_processor::process;
use gcode::{Code, Line};
use skein::{Error, Place};

use crate::follow::{Zone, Zones, clear, is_curve, refuse_curve};
use crate::foot::Foot;
use crate::machine::{Act, EPSILON_Z, Machine, Move};
use crate::survey::{Extent, Survey};
use crate::tape::{Raw, line_end, raw_lines, split_bom};
use crate::turn::{Leg, beads_between, first_turn};
use crate::writer::{Aim, Writer};
use crate::{Edited, amount, factor, said};

/// Puts the base of another file under the spiral of this one.
///
/// What is printed before the spiral goes, and what the other file prints up to a height, or else before its own spiral
/// (all of it, if it has none), comes in its place: with its middle under the first turn, in its own units and modes. The spiral and all that
/// follows stands as high on the new base as on the old one. Machine commands of the other file stay behind.
#[derive(Clone, Debug, PartialEq)]
pub struct Base {
    /// The text of the other file.
    pub other: Vec<u8>,
    /// Up to where it is a base, mm; up to its spiral, or all of it, if nothing is said.
    pub height: Option<f64>,
    /// What its E is multiplied by; without it, both files must be of one unit.
    pub e_factor: Option<f64>,
    /// How high the nozzle goes over the new base on its way to the spiral, mm.
    pub lift: f64,
}

/// Beads of the same height differ in width and flow, but not so much; units of E differ by more.
const UNLIKE: f64 = 2.0;
/// So much of its width a spiral may stand out over its base.
const MOST_OVERHANG: f64 = 0.1;
/// So near to its start the spiral goes on without a lift, mm.
const AT_HAND: f64 = 1.0;

/// The file whose base goes.
struct Pot {
    survey: Survey,
    /// The first line of the spiral.
    start: usize,
    /// The extents of its first turn.
    turn: Extent,
    /// The highest bead of the old base, 0 if it has none; and the lowest place from the spiral on, mm.
    base_top: f64,
    lowest: f64,
    /// E for each mm of path and mm of height.
    density: f64,
}

/// From where to where the pieces go.
struct Shift {
    /// The other base, mm.
    base: [f64; 2],
    /// The spiral, mm.
    rise: f64,
    e_factor: f64,
}

impl Base {
    pub(crate) fn apply(&self, text: &[u8]) -> Result<Edited, Error> {
        amount("the lift over the base", self.lift, 1000.0)?;
        let e_factor = factor("the factor of E", self.e_factor.unwrap_or(1.0))?;
        let foot = Foot::of(&self.other, self.height).map_err(in_base)?;
        let pot = Pot::of(text)?;
        if self.e_factor.is_none() {
            refuse_units(foot.density / pot.density)?;
        }
        let stands_out = refuse_narrow(&foot, &pot)?;
        let ([foot_x, foot_y], [pot_x, pot_y]) = (foot.top_layer.middle(), pot.turn.middle());
        let shift = Shift {
            base: [rounded(pot_x - foot_x), rounded(pot_y - foot_y)],
            rise: foot.top - pot.base_top.min(pot.lowest),
            e_factor,
        };
        let out = self.graft(text, &pot, &foot, &shift)?;
        let mut sentences = vec![format!(
            "a base up to Z{:.3} instead of Z{:.3}, moved by X{:.3} Y{:.3}; the spiral is raised by {:.3} mm",
            foot.top, pot.base_top, shift.base[0], shift.base[1], shift.rise
        )];
        if e_factor != 1.0 {
            sentences.push(format!("E of the base times {e_factor}"));
        }
        if stands_out > 0.0 {
            sentences.push(format!("the spiral stands out over the base by {stands_out:.3} mm"));
        }
        Ok(said(out, &sentences))
    }

    /// Start code, the other base, the way to the spiral, the spiral and the end code.
    fn graft(&self, text: &[u8], pot: &Pot, foot: &Foot, shift: &Shift) -> Result<Vec<u8>, Error> {
        let (bom, body) = split_bom(text);
        let mut writer = Writer::new(text.len().saturating_add(self.other.len()), line_end(text));
        writer.out.extend_from_slice(bom);
        let mut machine = Machine::new();
        let mut zones = Zones::of(&pot.survey);
        let mut line = Line::default();
        let old_top = pot.survey.top;
        for (index, raw) in raw_lines(body).enumerate() {
            line.read(raw.text);
            if index == pot.survey.lead {
                self.put_base(&mut writer, foot, shift, line_end(text)).map_err(in_base)?;
            }
            if index == pot.start {
                self.go_to_spiral(&mut writer, &machine, foot.top, shift.rise, pot)?;
            }
            let act = machine.obey(&line);
            let zone = zones.feed(index, &line, &act);
            match &act {
                _ if index >= pot.survey.lead && index < pot.start => {
                    if is_machine_command(&line) {
                        writer.keep(raw, &line)
                    } else {
                        writer.leave_out(raw)
                    }
                }
                Act::Move(step) if zone == Zone::Part => {
                    writer.go(raw, &line, step, &moved(step, [0.0, 0.0, shift.rise], 1.0));
                }
                Act::Move(step) if zone == Zone::End => {
                    let height = clear(step, &writer.machine, old_top, old_top + shift.rise);
                    writer.go(raw, &line, step, &Aim { to: [None, None, height], ..Aim::same(step) });
                }
                _ => writer.keep(raw, &line),
            }
        }
        Ok(writer.out)
    }

    /// Writes the lines of the other base.
    fn put_base(&self, writer: &mut Writer, foot: &Foot, shift: &Shift, end: &[u8]) -> Result<(), Error> {
        let mut machine = Machine::new();
        let mut line = Line::default();
        for (index, raw) in raw_lines(split_bom(&self.other).1).enumerate().take(foot.last + 1) {
            line.read(raw.text);
            if index == foot.survey.lead {
                writer.insert("; edit base: begin");
                switch(writer, &machine);
                writer.draw([None; 3], 0.0, machine.feed());
                writer.call_e(machine.e_word() * machine.scale());
            }
            let act = machine.obey(&line);
            if index < foot.survey.lead {
                continue;
            }
            let raw = Raw { end, ..raw };
            match &act {
                Act::Move(step) => {
                    if !step.known.iter().all(|&known| known) {
                        return Err(Error::line(index, "the base begins at a place that is not known")
                            .hint("the file must name X, Y and Z once before, with G90"));
                    }
                    let [x, y] = shift.base;
                    writer.go(raw, &line, step, &moved(step, [x, y, 0.0], shift.e_factor));
                }
                Act::Home => {
                    return Err(Error::line(index, "the printer homes in the middle of the base")
                        .hint("take a file that prints its base without a break"));
                }
                Act::Other if line.command.is_some_and(is_curve) => return Err(refuse_curve(index)),
                Act::Other if is_machine_command(&line) => {}
                Act::Other => writer.keep(raw, &line),
            }
        }
        writer.insert("; edit base: end");
        Ok(())
    }

    /// Goes from the end of the base to where the spiral starts, over the base and never through it. `machine` is
    /// where the file was without the edit.
    fn go_to_spiral(
        &self,
        writer: &mut Writer,
        machine: &Machine,
        top: f64,
        rise: f64,
        pot: &Pot,
    ) -> Result<(), Error> {
        let ([Some(x), Some(y), Some(z)], [Some(here_x), Some(here_y), Some(here_z)]) =
            (machine.place(), writer.machine.place())
        else {
            return Err(Error::line(pot.start, "it is not known where the spiral starts")
                .hint("the file must name X, Y and Z once before, with G90"));
        };
        switch(writer, machine);
        let start = (z + rise).max(top);
        let feed = pot.survey.travel_feed;
        if (x - here_x).hypot(y - here_y) > AT_HAND {
            let over = start.max(here_z).max(top) + self.lift;
            writer.draw([None, None, Some(over)], 0.0, feed);
            writer.draw([Some(x), Some(y), None], 0.0, feed);
        }
        writer.draw([None, None, Some(start)], 0.0, feed);
        writer.draw([Some(x), Some(y), None], 0.0, feed);
        writer.draw([None; 3], 0.0, machine.feed());
        writer.call_e(machine.e_word() * machine.scale());
        Ok(())
    }
}

/// To the hundredth of a mm: finer than clay, and the base of the same pot stays where it is to the byte.
fn rounded(shift: f64) -> f64 {
    (shift * 100.0).round() / 100.0
}

/// Brings the printer into the modes of `machine`.
fn switch(writer: &mut Writer, machine: &Machine) {
    let (old, new) = (writer.machine.modes(), machine.modes());
    // On some firmware G90 and G91 take E along, so what E is comes last and is said with them.
    let coordinates_change = old[2] != new[2];
    for (number, (from, to)) in old.into_iter().zip(new).enumerate() {
        if from != to || number == 3 && coordinates_change {
            writer.insert(to);
        }
    }
}

fn moved(step: &Move, by: [f64; 3], e_factor: f64) -> Aim {
    Aim {
        to: std::array::from_fn(|axis| step.known[axis].then(|| step.to[axis] + by[axis])),
        clay: step.clay * e_factor,
        feed: None,
        arc: 1.0,
    }
}

/// Whether the line orders something that is neither a move nor a mode: fans, accelerations, tools.
fn is_machine_command(line: &Line) -> bool {
    const E_MODES: [Code; 2] = [Code::m(82), Code::m(83)];
    line.command.is_some_and(|command| command.letter != b'G' && !E_MODES.contains(&command))
}

fn in_base(mut error: Error) -> Error {
    let place = std::mem::replace(&mut error.place, Place::Whole);
    match place {
        Place::Line(line) => error.at(Place::At(format!("the other file, line {line}"))),
        _ => error.at(Place::At("the other file".to_owned())),
    }
}

fn refuse_units(ratio: f64) -> Result<(), Error> {
    if (1.0 / UNLIKE..=UNLIKE).contains(&ratio) {
        return Ok(());
    }
    let message =
        format!("the other base lays {ratio:.3} times the E of this spiral on a millimetre of bead");
    Err(Error::new(message).hint(format!(
        "its E seems to be of another unit; if so, multiply it: --e-factor {:.4}",
        1.0 / ratio
    )))
}

/// How far the spiral stands out over the base, mm.
fn refuse_narrow(foot: &Foot, pot: &Pot) -> Result<f64, Error> {
    let mut out: f64 = 0.0;
    for axis in 0..2 {
        let width = |extent: &Extent| extent.high[axis] - extent.low[axis];
        let over = (width(&pot.turn) - width(&foot.top_layer)) / 2.0;
        if over > width(&pot.turn) * MOST_OVERHANG {
            let message = format!(
                "the spiral is {:.1} mm wide where it starts and the other base {:.1} mm",
                width(&pot.turn),
                width(&foot.top_layer)
            );
            return Err(Error::new(message).hint("scale one of the two files first"));
        }
        out = out.max(over);
    }
    Ok(out)
}

impl Pot {
    fn of(text: &[u8]) -> Result<Self, Error> {
        let survey = Survey::of(text)?;
        let spirals = process(text).machine.spirals;
        let spiral = spirals.first().ok_or_else(|| {
            Error::new("the file has no spiral, so there is no base to replace").hint(
                "the base is what is printed before the first spiral; print the pot in spiral (vase) mode",
            )
        })?;
        let start = spiral.start_index;
        let beads = beads_between(text, start, spiral.end_index);
        let turn = first_turn(&beads).ok_or_else(|| {
            Error::line(start, "the spiral makes no whole turn").hint("its middle cannot be found")
        })?;
        let mut extent = Extent::NONE;
        for leg in &turn {
            extent.add(leg.from);
            extent.add(leg.to);
        }
        // Of the whole spiral: its first turn is often thin.
        let clay: f64 = beads.iter().map(|leg| leg.clay).sum();
        let length: f64 = beads.iter().map(Leg::length).sum();
        let pitch = extent.high[2] - extent.low[2];
        if pitch <= EPSILON_Z || length <= 0.0 {
            return Err(Error::line(start, "the first turn of the spiral does not climb")
                .hint("print the pot in spiral (vase) mode"));
        }
        let (base_top, lowest) = heights(text, &survey, start);
        Ok(Self { survey, start, turn: extent, base_top, lowest, density: clay / length / pitch })
    }
}

/// The highest bead before the line `start`, 0 if there is none, and the lowest place of the beads from there on.
fn heights(text: &[u8], survey: &Survey, start: usize) -> (f64, f64) {
    let mut machine = Machine::new();
    let mut line = Line::default();
    let (mut top, mut lowest) = (0.0_f64, f64::INFINITY);
    for (index, raw) in raw_lines(split_bom(text).1).enumerate().take(survey.last + 1) {
        line.read(raw.text);
        if let Act::Move(step) = machine.obey(&line)
            && index >= survey.lead
            && step.prints()
        {
            if index < start {
                top = top.max(step.to[2]);
            } else {
                lowest = lowest.min(step.from[2]).min(step.to[2]);
            }
        }
    }
    (top, lowest)
}
