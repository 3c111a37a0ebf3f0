//! From commands to G-code, in any flavor.
//!
//! What the parser reads of a line that was written here is the command it was written from, as far as the flavor can
//! say it; lengths are rounded to the decimals of the flavor. What it cannot say becomes a remark and a
//! [`Problem::Unsayable`]: a move stays a move, so that the machine is where it was meant to be.

mod number;
mod row;

pub use row::Row;

use crate::command::{By, Centre, Command, Plane, Span, Spin, Step, Target, Turn};
use crate::diagnostic::{Diagnostic, Diagnostics, Problem, Tenths};
use crate::flavor::{ArcTurns, DwellUnit, Extruder, Flavor};
use crate::given::Given;
use crate::parameters::{LengthUnit, Parameters};
use crate::token::{Token, Tokens};
use number::write_number;
use std::borrow::Cow;
use std::io::Write;

/// Writes commands, one line or more for each. A machine takes whichever it is given.
pub trait Exporter {
    /// Appends the lines of a command to `out`, each with its line end.
    fn line(&mut self, step: &Step<'_>, out: &mut Vec<u8>);
}

/// Decimals of E, of feeds, and of speeds and times.
const E_DECIMALS: u8 = 5;
const FEED_DECIMALS: u8 = 4;
const FINE_DECIMALS: u8 = 6;

/// Writes commands as G-code.
///
/// ```
/// use gcode::{Exporter, Flavor, GcodeExporter, Parser};
///
/// let (from, to) = (Flavor::named("marlin").unwrap(), Flavor::named("grbl").unwrap());
/// let mut exporter = GcodeExporter::new(to).from_flavor(from);
/// let mut out = Vec::new();
/// Parser::new(from).read(b"G0 X1.50000 F6000\nG4 P500\n; done", |step| exporter.line(&step, &mut out));
/// assert_eq!(String::from_utf8_lossy(&out), "G0 X1.5 F6000\nG4 P0.5\n; done\n");
/// assert!(exporter.diagnostics().is_empty());
/// ```
#[derive(Clone, Debug)]
pub struct GcodeExporter<'f> {
    flavor: &'f Flavor,
    /// Where the commands come from, if that is another flavor.
    source: Option<&'f Flavor>,
    diagnostics: Diagnostics,
    line: u32,
    /// What was written so far makes of the machine.
    unit: LengthUnit,
    /// Whether feeds are per minute and have a length in them.
    per_minute: bool,
    has_length: bool,
    plane: Plane,
    absolute_centres: bool,
    rate: f64,
    speed: f64,
}

impl<'f> GcodeExporter<'f> {
    /// Writes in `flavor`.
    pub fn new(flavor: &'f Flavor) -> Self {
        Self {
            flavor,
            source: None,
            diagnostics: Diagnostics::default(),
            line: 0,
            unit: flavor.unit,
            per_minute: true,
            has_length: true,
            plane: Plane::default(),
            absolute_centres: false,
            rate: 0.0,
            speed: 0.0,
        }
    }

    /// The same for commands that were read in `flavor`: what only that one knows is not written.
    pub fn from_flavor(mut self, flavor: &'f Flavor) -> Self {
        self.source = (flavor != self.flavor).then_some(flavor);
        self
    }

    /// What could not be said.
    pub fn diagnostics(&self) -> &Diagnostics {
        &self.diagnostics
    }

    fn unsayable(&mut self, what: impl Into<Cow<'static, str>>, out: &mut Vec<u8>) {
        let what = what.into();
        self.remark(format!(" not said: {what}").as_bytes(), out);
        let kind = Problem::Unsayable(what);
        self.diagnostics.push(Diagnostic { line: self.line, column: 0, kind });
    }

    fn remark(&mut self, text: &[u8], out: &mut Vec<u8>) {
        if self.flavor.semicolon {
            out.push(b';');
            out.extend_from_slice(text);
        } else {
            out.push(b'(');
            // What would end the remark.
            out.extend(text.iter().map(|&byte| match byte {
                b'(' => b'[',
                b')' => b']',
                byte => byte,
            }));
            out.push(b')');
        }
        out.push(b'\n');
    }

    fn word(&self, letter: u8, value: f64, decimals: u8, out: &mut Vec<u8>) {
        out.extend_from_slice(&[b' ', letter]);
        write_number(value, decimals, out);
    }

    fn length(&self, letter: u8, value: f64, out: &mut Vec<u8>) {
        self.word(letter, value / self.unit.mm(), self.flavor.decimals, out);
    }

    fn target(&self, to: &Target, out: &mut Vec<u8>) {
        for (letter, value) in [(b'X', to.x), (b'Y', to.y), (b'Z', to.z)] {
            if let Some(value) = value.get() {
                self.length(letter, value, out);
            }
        }
    }

    /// The words of other axes.
    fn also(&self, also: Option<Parameters<'_>>, out: &mut Vec<u8>) {
        let Some(words) = also else { return };
        for (letter, value) in words.iter() {
            match (letter, value) {
                (b'U' | b'V' | b'W', Some(value)) => self.length(letter, value * words.unit.mm(), out),
                (b'A' | b'B' | b'C', Some(value)) => self.word(letter, value, FINE_DECIMALS, out),
                _ => {}
            }
        }
    }

    fn feed(&self, feed: Given, out: &mut Vec<u8>) {
        let Some(feed) = feed.get() else { return };
        let minutes = if self.per_minute { 60.0 } else { 1.0 };
        let length = if self.has_length { self.unit.mm() } else { 1.0 };
        self.word(b'F', feed * minutes / length, FEED_DECIMALS, out);
    }

    /// Writes a straight move.
    fn straight(&mut self, motion: &Straight<'_>, out: &mut Vec<u8>) {
        self.prepare(motion.work, out);
        out.extend_from_slice(if motion.machine { b"G53 G" } else { b"G" });
        out.push(if motion.rapid { b'0' } else { b'1' });
        self.target(&motion.to, out);
        self.also(motion.also, out);
        self.work(motion.work, out);
        self.feed(motion.feed, out);
        out.push(b'\n');
    }

    /// Says beforehand what cannot be said along with a move.
    fn prepare(&mut self, work: Work, out: &mut Vec<u8>) {
        let what = match (work, self.flavor.extruder) {
            (Work::Clay(_, By::Amount), Extruder::Amount)
            | (Work::Clay(_, By::Area), Extruder::Area)
            | (Work::None, _)
            | (Work::Mill(_), Extruder::Amount | Extruder::None) => return,
            (Work::Clay(rate, By::Speed), Extruder::Screw) => {
                if rate < 0.0 && rate != self.rate {
                    self.screw(rate, out);
                }
                return;
            }
            (Work::Clay(_, By::Amount), _) => "how much to extrude",
            (Work::Clay(_, By::Speed), _) => "how fast to turn the screw",
            (Work::Clay(_, By::Area), _) => "how large a bead to lay",
            (Work::Mill(_), _) => "how fast to mill",
        };
        self.unsayable(what, out);
    }

    /// Writes what a move does besides moving.
    fn work(&mut self, work: Work, out: &mut Vec<u8>) {
        match (work, self.flavor.extruder) {
            (Work::Clay(amount, By::Amount), Extruder::Amount) => {
                self.word(b'E', amount / self.unit.mm(), E_DECIMALS, out);
            }
            (Work::Clay(rate, By::Speed), Extruder::Screw) if rate != self.rate => {
                self.word(b'S', rate * 60.0, FINE_DECIMALS, out);
                self.rate = rate;
            }
            (Work::Clay(area, By::Area), Extruder::Area) if area != self.rate => {
                self.bead(area, out);
            }
            (Work::Mill(speed), Extruder::Amount | Extruder::None) if speed != self.speed => {
                self.word(b'S', speed * 60.0, FINE_DECIMALS, out);
                self.speed = speed;
            }
            _ => {}
        }
    }

    fn bead(&mut self, area: f64, out: &mut Vec<u8>) {
        out.push(b' ');
        out.extend_from_slice(self.flavor.bead_on.as_bytes());
        out.push(b'=');
        write_number(area, FINE_DECIMALS, out);
        self.rate = area;
    }

    fn screw(&mut self, rate: f64, out: &mut Vec<u8>) {
        if rate == 0.0 {
            out.extend_from_slice(b"M5");
        } else {
            out.extend_from_slice(if rate < 0.0 { b"M4" } else { b"M3" });
            self.word(b'S', rate.abs() * 60.0, FINE_DECIMALS, out);
        }
        out.push(b'\n');
        self.rate = rate;
    }

    fn arc(&mut self, arc: &Arc, out: &mut Vec<u8>) {
        let turn = arc.turn;
        let radius = turn.centre == Centre::Radius;
        let why = if !self.flavor.arcs {
            Some("an arc")
        } else if radius && self.flavor.arc_radius.is_empty() {
            Some("an arc by its radius")
        } else if turn.plane != self.plane {
            Some("an arc in this plane")
        } else if !radius && self.absolute_centres != (turn.centre == Centre::Absolute) {
            Some("the centre of an arc")
        } else if turn.more > 0 && self.flavor.arc_turns == ArcTurns::None {
            Some("an arc of several turns")
        } else {
            None
        };
        if let Some(why) = why {
            self.unsayable(why, out);
            let straight = Straight {
                to: arc.to,
                feed: arc.feed,
                work: arc.work,
                rapid: false,
                machine: false,
                also: None,
            };
            return self.straight(&straight, out);
        }
        self.prepare(arc.work, out);
        out.extend_from_slice(if turn.clockwise { b"G2" } else { b"G3" });
        self.target(&arc.to, out);
        let [first, second] = arc.around;
        if radius {
            out.push(b' ');
            out.extend_from_slice(self.flavor.arc_radius.as_bytes());
            if self.flavor.arc_radius.len() > 1 {
                out.push(b'=');
            }
            write_number(first / self.unit.mm(), self.flavor.decimals, out);
        } else {
            let letters = match turn.plane {
                Plane::Xy => [b'I', b'J'],
                Plane::Zx => [b'K', b'I'],
                Plane::Yz => [b'J', b'K'],
            };
            self.length(letters[0], first, out);
            self.length(letters[1], second, out);
        }
        if turn.more > 0 {
            let begun = u8::from(self.flavor.arc_turns == ArcTurns::Total);
            self.word(b'P', f64::from(turn.more) + f64::from(begun), 0, out);
        }
        self.work(arc.work, out);
        self.feed(arc.feed, out);
        out.push(b'\n');
    }

    fn extrude(&mut self, deposit: f64, by: By, feed: Given, out: &mut Vec<u8>) {
        match (by, self.flavor.extruder) {
            (By::Amount, Extruder::Amount) => {
                out.extend_from_slice(b"G1");
                self.word(b'E', deposit / self.unit.mm(), E_DECIMALS, out);
                self.feed(feed, out);
                out.push(b'\n');
            }
            (By::Speed, Extruder::Screw) => self.screw(deposit, out),
            (By::Area, Extruder::Area) if deposit == 0.0 => {
                out.extend_from_slice(self.flavor.bead_off.as_bytes());
                out.push(b'\n');
                self.rate = 0.0;
            }
            (By::Area, Extruder::Area) => {
                let start = out.len();
                self.bead(deposit, out);
                // A line begins without a blank.
                out.remove(start);
                out.push(b'\n');
            }
            (By::Amount, _) => self.unsayable("how much to extrude", out),
            (By::Speed, _) => self.unsayable("how fast to turn the screw", out),
            (By::Area, _) => self.unsayable("how large a bead to lay", out),
        }
    }

    fn mill(&mut self, speed: Given, spin: Spin, out: &mut Vec<u8>) {
        if self.flavor.extruder == Extruder::Screw {
            return self.unsayable("how fast to mill", out);
        }
        out.extend_from_slice(match spin {
            Spin::Off => b"M5",
            Spin::Clockwise => b"M3",
            Spin::CounterClockwise => b"M4",
        });
        if let Some(speed) = speed.get() {
            self.word(b'S', speed * 60.0, FINE_DECIMALS, out);
            self.speed = speed;
        }
        out.push(b'\n');
    }

    fn dwell(&mut self, time: f64, by: Span, out: &mut Vec<u8>) {
        let fits = |unit: DwellUnit| match by {
            Span::Seconds => matches!(unit, DwellUnit::Seconds | DwellUnit::Milliseconds),
            Span::Revolutions => unit == DwellUnit::Revolutions,
        };
        let Some(&(letter, unit)) = self.flavor.dwell.iter().find(|(_, unit)| fits(*unit)) else {
            return self.unsayable("how long to wait", out);
        };
        out.extend_from_slice(b"G4");
        let factor = if unit == DwellUnit::Milliseconds { 1000.0 } else { 1.0 };
        self.word(letter, time * factor, FINE_DECIMALS, out);
        out.push(b'\n');
    }

    fn purge(&mut self, time: f64, deposit: f64, by: By, out: &mut Vec<u8>) {
        let runs = match self.flavor.extruder {
            Extruder::Screw => by == By::Speed,
            Extruder::Area => by == By::Area,
            Extruder::Amount | Extruder::None => false,
        };
        if runs && self.rate == deposit {
            return self.dwell(time, Span::Seconds, out);
        }
        if self.flavor.purge_code == 0 || by != By::Speed {
            return self.unsayable("a pause with the extruder running", out);
        }
        self.code(b'M', self.flavor.purge_code, out);
        self.word(b'F', deposit * 60.0, FINE_DECIMALS, out);
        self.word(b'P', time, FINE_DECIMALS, out);
        out.push(b'\n');
    }

    fn code(&self, letter: u8, tenths: u16, out: &mut Vec<u8>) {
        // Writing to a vector does not fail.
        let _ = write!(out, "{}{}", char::from(letter), Tenths(tenths));
    }

    /// A G code with its words; the modes it sets are kept.
    fn g(&mut self, tenths: u16, words: Parameters<'_>, out: &mut Vec<u8>) {
        let unit = match tenths {
            200 | 700 => Some(LengthUnit::Inch),
            210 | 710 => Some(LengthUnit::Millimetre),
            _ => None,
        };
        if let Some(unit) = unit {
            match self.flavor.unit_codes {
                Some((inch, millimetre)) => {
                    let code = if unit == LengthUnit::Inch { inch } else { millimetre };
                    self.unit = unit;
                    self.code(b'G', code, out);
                    out.push(b'\n');
                }
                None if unit == LengthUnit::Millimetre => out.extend_from_slice(b"G21\n"),
                None => self.unsayable("lengths in inches; they follow in millimetres", out),
            }
            return;
        }
        match tenths {
            170 => self.plane = Plane::Xy,
            180 => self.plane = Plane::Zx,
            190 => self.plane = Plane::Yz,
            901 => self.absolute_centres = true,
            911 => self.absolute_centres = false,
            930 | 950 if !self.flavor.feed_modes => return self.unsayable("another unit of the feed", out),
            930 | 940 | 950 => {
                self.per_minute = tenths != 950;
                self.has_length = tenths != 930;
            }
            _ => {}
        }
        self.code(b'G', tenths, out);
        self.words(words, true, out);
        out.push(b'\n');
    }

    fn words(&mut self, words: Parameters<'_>, lengths: bool, out: &mut Vec<u8>) {
        let is_code = |token: Token| matches!(token, Token::Word { letter: b'G' | b'M', .. });
        let rescaled = lengths && words.unit != self.unit;
        if words.text.is_empty() {
            return;
        }
        // As it was written, unless its lengths have another unit or the codes of other commands stand in it.
        if !(rescaled || lengths && Tokens::new(words.text).any(is_code)) {
            out.push(b' ');
            return out.extend_from_slice(words.text);
        }
        for (letter, value) in words.iter() {
            match value {
                Some(value) if rescaled && b"XYZUVWIJKRE".contains(&letter) => {
                    self.length(letter, value * words.unit.mm(), out);
                }
                Some(value) => self.word(letter, value, FINE_DECIMALS, out),
                None => out.extend_from_slice(&[b' ', letter]),
            }
        }
    }

    /// Whether only the flavor that the command comes from knows what it means.
    fn is_foreign(&self, command: &Command<'_>) -> bool {
        let Some(source) = self.source else { return false };
        if let Command::Config { text } = command {
            return command.tool().is_none() && *text != b"%";
        }
        let sets = |flavor: &Flavor| {
            let found = flavor.limits.iter().find(|limit| limit.of(command).is_some());
            found.map(|limit| (limit.quantity, limit.value))
        };
        let meant = sets(source);
        meant.is_some() && meant != sets(self.flavor)
    }

    fn work_coordinates(&mut self, system: u16, out: &mut Vec<u8>) {
        let tenths = match (system, self.flavor.named_words) {
            (1..=4, _) | (5..=6, false) => 530 + system * 10,
            (7..=9, false) => 584 + system,
            (0 | 5..=99, true) => 5000 + system * 10,
            _ => return self.unsayable("a system of coordinates", out),
        };
        self.code(b'G', tenths, out);
        out.push(b'\n');
    }
}

impl Exporter for GcodeExporter<'_> {
    fn line(&mut self, step: &Step<'_>, out: &mut Vec<u8>) {
        self.line = step.line;
        let command = &step.command;
        if self.is_foreign(command) {
            return self.unsayable("what only the other machine knows", out);
        }
        let also = command.also();
        let straight = |to, feed, rapid, work| Straight { to, feed, work, rapid, machine: false, also };
        match *command {
            Command::Move { to, feed, rapid, .. } => {
                self.straight(&straight(to, feed, rapid, Work::None), out)
            }
            Command::MoveExtrude { to, feed, deposit, by, rapid, .. } => {
                self.straight(&straight(to, feed, rapid, Work::Clay(deposit, by)), out);
            }
            Command::MoveMill { to, feed, speed, .. } => {
                self.straight(&straight(to, feed, false, Work::Mill(speed)), out);
            }
            Command::MachineCoordinates { to, feed, rapid, .. } => {
                self.straight(&Straight { machine: true, ..straight(to, feed, rapid, Work::None) }, out);
            }
            Command::Arc { to, feed, around, turn } => {
                self.arc(&Arc { to, feed, around, turn, work: Work::None }, out);
            }
            Command::ArcExtrude { to, feed, around, turn, deposit, by } => {
                self.arc(&Arc { to, feed, around, turn, work: Work::Clay(deposit, by) }, out);
            }
            Command::ArcMill { to, feed, around, turn, speed, .. } => {
                self.arc(&Arc { to, feed, around, turn, work: Work::Mill(speed) }, out);
            }
            Command::Extrude { deposit, by, feed, .. } => self.extrude(deposit, by, feed, out),
            Command::Mill { speed, spin } => self.mill(speed, spin, out),
            Command::Dwell { time, by } => self.dwell(time, by, out),
            Command::Purge { time, deposit, by } => self.purge(time, deposit, by, out),
            Command::FeedRate { feed } => {
                out.extend_from_slice(b"G1");
                self.feed(Given::new(feed), out);
                out.push(b'\n');
            }
            Command::Config { text } => {
                out.extend_from_slice(text);
                out.push(b'\n');
            }
            Command::G { tenths, words } => self.g(tenths, words, out),
            Command::M { tenths, words } => {
                self.code(b'M', tenths, out);
                self.words(words, !self.flavor.text_codes.contains(&tenths), out);
                out.push(b'\n');
            }
            Command::AbsolutePosition => out.extend_from_slice(b"G90\n"),
            Command::IncrementalPosition => out.extend_from_slice(b"G91\n"),
            Command::WorkCoordinates { system } => self.work_coordinates(system, out),
            Command::Comment { text } => self.remark(text, out),
        }
    }
}

/// What a move does besides moving.
#[derive(Clone, Copy, Debug)]
enum Work {
    None,
    Clay(f64, By),
    Mill(f64),
}

/// A straight move.
struct Straight<'a> {
    to: Target,
    feed: Given,
    work: Work,
    rapid: bool,
    machine: bool,
    also: Option<Parameters<'a>>,
}

/// A move about a centre.
struct Arc {
    to: Target,
    feed: Given,
    around: [f64; 2],
    turn: Turn,
    work: Work,
}

#[cfg(test)]
mod tests;
