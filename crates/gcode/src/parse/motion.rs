//! The command that a motion and its words make.

use super::block::{bit, bits};
use super::scan::not_in_flavor;
use super::{FeedMode, Parser};
use crate::command::{By, Centre, Command, Plane, Spin, Target, Turn};
use crate::diagnostic::Problem;
use crate::flavor::{ArcTurns, Extruder};
use crate::given::Given;
use crate::word::Words;

/// The modal motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    /// `G0`.
    Rapid,
    /// `G1`.
    Linear,
    /// `G2`.
    Clockwise,
    /// `G3`.
    CounterClockwise,
}

impl Motion {
    pub fn of(tenths: u16) -> Option<Self> {
        Some(match tenths {
            0 => Self::Rapid,
            10 => Self::Linear,
            20 => Self::Clockwise,
            30 => Self::CounterClockwise,
            _ => return None,
        })
    }

    pub const fn tenths(self) -> u16 {
        self as u16 * 10
    }

    fn is_arc(self) -> bool {
        matches!(self, Self::Clockwise | Self::CounterClockwise)
    }
}

/// What a line says of its motion besides its words.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Manner<'a> {
    /// The line, for columns.
    pub line: &'a [u8],
    /// The words as text, for other axes.
    pub code: &'a [u8],
    /// The radius, where that is a name.
    pub radius: Option<f64>,
    /// In the coordinates of the machine.
    pub machine: bool,
}

/// Axes besides X, Y and Z.
pub(super) const OTHER_AXES: u32 = bits(b"ABCUVW");
pub(super) const AXES: u32 = bits(b"XYZ") | OTHER_AXES;
const CENTRES: u32 = bits(b"IJKR");
/// The words that nearly every move is made of.
pub(super) const PLAIN: u32 = bits(b"XYZEFIJ");

/// The largest length that is no mistake, mm.
const LARGEST: f64 = 1e7;
/// The largest E: the clay of a house in mm³.
const LARGEST_E: f64 = 1e12;

impl Parser<'_> {
    /// The command of `motion` with `words`; nothing if there is nothing to do.
    #[inline]
    pub(super) fn motion_command<'a>(
        &mut self,
        motion: Motion,
        words: &Words,
        manner: Manner<'a>,
    ) -> Option<Command<'a>> {
        let letters = words.letters();
        let used = bits(b"XYZF") | OTHER_AXES | self.deposit_letter();
        if letters & !used != 0 {
            self.report_unused(motion, letters & !used, &manner);
        }
        let feed = self.feed(words, manner.line);
        let to = Target {
            x: self.length(words, b'X', manner.line),
            y: self.length(words, b'Y', manner.line),
            z: self.length(words, b'Z', manner.line),
        };
        if motion.is_arc() && (letters & (AXES | CENTRES) != 0 || manner.radius.is_some()) {
            return Some(self.arc_command(motion, words, to, feed, manner));
        }
        let amount = if self.flavor.extruder == Extruder::Amount {
            self.ranged(words, b'E', self.unit.mm(), LARGEST_E, manner.line)
        } else {
            Given::NONE
        };
        if letters & AXES == 0 {
            return match (amount.get(), feed.get()) {
                (Some(deposit), _) => {
                    Some(Command::Extrude { deposit, by: By::Amount, feed, tool: self.tool })
                }
                (None, Some(feed)) => Some(Command::FeedRate { feed }),
                (None, None) => None,
            };
        }
        let rapid = motion == Motion::Rapid;
        let (also, unit) =
            if letters & OTHER_AXES != 0 { (manner.code, self.unit) } else { (&b""[..], Default::default()) };
        if manner.machine {
            if amount.is_some() {
                self.report_word(manner.line, b'E', Problem::Unused(b'E'));
            }
            return Some(Command::MachineCoordinates { to, feed, rapid, also, unit });
        }
        Some(match self.deposit(rapid, amount) {
            Deposit::Clay(deposit, by) => Command::MoveExtrude { to, feed, deposit, by, rapid, also, unit },
            Deposit::Mill(speed, spin) => Command::MoveMill { to, feed, speed, spin, also, unit },
            Deposit::None => Command::Move { to, feed, rapid, also, unit },
        })
    }

    fn arc_command<'a>(
        &mut self,
        motion: Motion,
        words: &Words,
        to: Target,
        feed: Given,
        manner: Manner<'a>,
    ) -> Command<'a> {
        let line = manner.line;
        if manner.machine || words.letters() & OTHER_AXES != 0 {
            self.report(0, Problem::TooMuch);
        }
        let amount = if self.flavor.extruder == Extruder::Amount {
            self.ranged(words, b'E', self.unit.mm(), LARGEST_E, line)
        } else {
            Given::NONE
        };
        let radius = match manner.radius {
            Some(radius) => Some(radius),
            None if words.has(b'R') => {
                if self.flavor.arc_radius.as_ref() != "R" {
                    self.report_word(line, b'R', not_in_flavor("an arc by its radius"));
                }
                words.get(b'R')
            }
            None => None,
        };
        let (first, second) = match self.plane {
            Plane::Xy => (b'I', b'J'),
            Plane::Zx => (b'K', b'I'),
            Plane::Yz => (b'J', b'K'),
        };
        let (centre, around) = if words.has(first) || words.has(second) {
            let centre = if self.absolute_centres { Centre::Absolute } else { Centre::Offset };
            let around = [self.length(words, first, line).or(0.0), self.length(words, second, line).or(0.0)];
            (centre, around)
        } else if let Some(radius) =
            radius.map(|radius| radius * self.unit.mm()).filter(|radius| radius.abs() <= LARGEST)
        {
            (Centre::Radius, [radius, 0.0])
        } else {
            // The machine is to arrive where the program wants it, if not on its way.
            self.report(0, Problem::NoCentre);
            return Command::Move { to, feed, rapid: false, also: b"", unit: Default::default() };
        };
        let turn = Turn {
            plane: self.plane,
            clockwise: motion == Motion::Clockwise,
            centre,
            more: self.more_turns(words, line),
        };
        match self.deposit(false, amount) {
            Deposit::Clay(deposit, by) => Command::ArcExtrude { to, feed, around, turn, deposit, by },
            Deposit::Mill(speed, spin) => Command::ArcMill { to, feed, around, turn, speed, spin },
            Deposit::None => Command::Arc { to, feed, around, turn },
        }
    }

    /// The whole turns on top of an arc.
    fn more_turns(&mut self, words: &Words, line: &[u8]) -> u8 {
        let Some(turns) = words.get(b'P').filter(|_| self.flavor.arc_turns != ArcTurns::None) else {
            return 0;
        };
        let more = if self.flavor.arc_turns == ArcTurns::Total { turns - 1.0 } else { turns };
        if !(0.0..=255.0).contains(&more) || more.fract() != 0.0 {
            self.report_word(line, b'P', Problem::OutOfRange(b'P'));
            return 0;
        }
        more as u8
    }

    /// What a motion does besides moving.
    #[inline]
    fn deposit(&self, rapid: bool, amount: Given) -> Deposit {
        if let Some(amount) = amount.get() {
            return Deposit::Clay(amount, By::Amount);
        }
        if rapid {
            return Deposit::None;
        }
        match self.flavor.extruder {
            Extruder::Screw if self.rate != 0.0 => Deposit::Clay(self.rate, By::Speed),
            Extruder::Area if self.rate != 0.0 => Deposit::Clay(self.rate, By::Area),
            Extruder::Amount | Extruder::None if self.spin != Spin::Off => {
                Deposit::Mill(self.speed, self.spin)
            }
            _ => Deposit::None,
        }
    }

    /// The letter, as a bit, that says how much a motion deposits.
    #[inline]
    fn deposit_letter(&self) -> u32 {
        if self.flavor.extruder == Extruder::Amount { bit(b'E') } else { 0 }
    }

    /// Tells of words that `motion` has no use for.
    #[cold]
    fn report_unused(&mut self, motion: Motion, letters: u32, manner: &Manner<'_>) {
        let mut used = 0;
        if motion.is_arc() {
            used |= match self.plane {
                Plane::Xy => bits(b"IJ"),
                Plane::Zx => bits(b"IK"),
                Plane::Yz => bits(b"JK"),
            };
            if letters & used == 0 {
                used |= bit(b'R');
            }
            if self.flavor.arc_turns != ArcTurns::None {
                used |= bit(b'P');
            }
        }
        // Told by whoever reads speeds.
        used |= bits(b"ST");
        for letter in (b'A'..=b'Z').filter(|&letter| letters & !used & bit(letter) != 0) {
            self.report_word(manner.line, letter, Problem::Unused(letter));
        }
    }

    /// The feed of the words; nothing if there is none or it is none.
    #[inline]
    pub(super) fn feed(&mut self, words: &Words, line: &[u8]) -> Given {
        let Some(feed) = words.get(b'F') else { return Given::NONE };
        if feed <= 0.0 {
            self.report_word(line, b'F', Problem::NoFeed);
            return Given::NONE;
        }
        let feed = match self.feed_mode {
            FeedMode::PerMinute => feed * self.unit.mm() / 60.0,
            FeedMode::Inverse => feed / 60.0,
            FeedMode::PerTurn => feed * self.unit.mm(),
        };
        if feed > LARGEST {
            self.report_word(line, b'F', Problem::OutOfRange(b'F'));
            return Given::NONE;
        }
        Given::new(feed)
    }

    #[inline(always)]
    fn length(&mut self, words: &Words, letter: u8, line: &[u8]) -> Given {
        self.ranged(words, letter, self.unit.mm(), LARGEST, line)
    }

    #[inline(always)]
    fn ranged(&mut self, words: &Words, letter: u8, factor: f64, largest: f64, line: &[u8]) -> Given {
        let Some(value) = words.get(letter) else { return Given::NONE };
        let value = value * factor;
        if value.abs() > largest {
            self.report_word(line, letter, Problem::OutOfRange(letter));
            return Given::NONE;
        }
        Given::new(value)
    }
}

/// What a motion does besides moving.
enum Deposit {
    None,
    Clay(f64, By),
    Mill(f64, Spin),
}
