//! What the program in the printer does with commands: heats, refuses E, changes what E means.

use gcode::{Code, Line};

use super::findings::Findings;
use super::limits::{Firmware, Limits};
use super::rule::Rule;
use crate::motion::{Class, EPSILON, Motion, Move};

/// Commands that heat when S or R is above 0: nozzle, bed and chamber, setting and waiting, and tuning.
const HEATERS: [Code; 7] =
    [Code::m(104), Code::m(109), Code::m(140), Code::m(190), Code::m(141), Code::m(191), Code::m(303)];

/// What Marlin and Klipper refuse when nobody has told them otherwise, in units of E.
const MARLIN_LONGEST: f64 = 200.0;
const KLIPPER_LONGEST: f64 = 50.0;

/// The state of the program.
#[derive(Clone, Debug)]
pub(crate) struct Control {
    heated: bool,
    /// E is refused while it is cold.
    guards_cold: bool,
    /// The longest way of E in a move that prints, and in one that pushes only.
    longest: [f64; 2],
    /// `G90` and `G91` are about E too, and the reader takes them so no more than the file's author did.
    takes_e_along: bool,
    /// `G90` has come after `M83`, and E not yet.
    relative_e_lost: bool,
}

impl Control {
    /// Nothing known of the program is as good as Marlin, which most clay printers run.
    pub(crate) fn new(limits: &Limits, e_follows_g90: bool) -> Self {
        let firmware = limits.firmware.unwrap_or(Firmware::Marlin);
        let known = match firmware {
            Firmware::Marlin => [MARLIN_LONGEST; 2],
            Firmware::Klipper => [f64::INFINITY, KLIPPER_LONGEST],
            Firmware::RepRap | Firmware::Plain => [f64::INFINITY; 2],
        };
        Self {
            heated: limits.heated == Some(true),
            guards_cold: matches!(firmware, Firmware::Marlin | Firmware::RepRap),
            longest: limits.longest_e.map_or(known, |longest| [longest; 2]),
            takes_e_along: firmware == Firmware::Marlin && !e_follows_g90,
            relative_e_lost: false,
        }
    }

    /// A line that moves nothing.
    pub(crate) fn command(&mut self, findings: &mut Findings, index: usize, line: &Line, motion: &Motion) {
        let Some(command) = line.command else { return };
        let words = &line.words;
        let value = |letter| words.get(letter);
        if !self.heated {
            let target = value(b'S').unwrap_or(0.0).max(value(b'R').unwrap_or(0.0));
            // RepRapFirmware heats tools with `G10 P0 S200` as well.
            let heats = HEATERS.contains(&command) || command == Code::g(10) && words.has(b'P');
            if heats && target > 0.0 {
                findings.add(Rule::Heats, index, None, target);
            }
        }
        if command == Code::m(302) {
            let allows = value(b'P').map(|p| p > 0.0).or_else(|| value(b'S').map(|s| s <= 0.0));
            // Bare, it only asks.
            self.guards_cold = allows.map_or(self.guards_cold, |allows| self.guards_cold && !allows);
        } else if command == Code::g(90) {
            self.relative_e_lost = self.takes_e_along && motion.is_relative_e();
        } else if command == Code::m(82) || command == Code::m(83) {
            self.relative_e_lost = false;
        }
    }

    /// E moves.
    #[inline(always)]
    pub(crate) fn push(&mut self, findings: &mut Findings, index: usize, step: &Move) {
        let alone = usize::from(step.class == Class::Prime);
        if self.guards_cold || self.relative_e_lost || step.clay.abs() > self.longest[alone] {
            self.refuse(findings, index, step);
        }
    }

    #[cold]
    fn refuse(&mut self, findings: &mut Findings, index: usize, step: &Move) {
        if step.clay.abs() <= EPSILON {
            return;
        }
        if step.clay.abs() > self.longest[usize::from(step.class == Class::Prime)] {
            findings.add(Rule::LongPrime, index, step.to, step.clay.abs());
        }
        // Once is enough: it is so from here to the end.
        if std::mem::take(&mut self.guards_cold) {
            findings.add(Rule::ColdExtrusion, index, step.to, 0.0);
        }
        if std::mem::take(&mut self.relative_e_lost) {
            findings.add(Rule::LostRelativeE, index, step.to, 0.0);
        }
    }
}
