//! The printer's state: units, modes, origin and position; turns lines into moves.

use gcode::{Code, Line, Words};

use crate::arc::Arc;

/// Below this a length is rounding of the sums, mm.
pub(crate) const EPSILON: f64 = 1e-6;
/// Half of the last decimal that slicers write: below this Z stays, mm.
pub(crate) const EPSILON_Z: f64 = 0.0005;
const MM_PER_INCH: f64 = 25.4;

/// What a line does to the printer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Action {
    /// Nothing that counts here.
    Nothing,
    /// The nozzle or the ram moves.
    Move(Move),
    /// The printer seeks its end stops.
    Home,
    /// Coordinates are set without a move.
    Reset {
        /// The height is called otherwise from now on.
        height: bool,
    },
}

/// One move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Move {
    pub(crate) class: Class,
    /// The way in XY as far as it is known, squared, mm²: most moves are never asked for their length, and a root is
    /// slow.
    flat_squared: f64,
    /// The change of X and Y as far as it is known, mm.
    pub(crate) by: (f64, f64),
    /// How it goes round, if it does.
    pub(crate) arc: Option<Arc>,
    /// What E pushes, in its unit; negative if it draws.
    pub(crate) clay: f64,
    /// The change of Z as far as it is known, mm.
    pub(crate) rise: f64,
    /// What the change of Z adds up to since it last counted, mm; 0 while Z stays.
    pub(crate) climb: f64,
    /// Z before; nothing if unknown.
    pub(crate) from: Option<f64>,
    /// Z after; nothing if unknown.
    pub(crate) to: Option<f64>,
}

impl Move {
    /// A move for the tests of those who take moves.
    #[cfg(test)]
    pub(crate) fn made_up(x: f64, rise: f64, to: Option<f64>) -> Self {
        let class = if rise == 0.0 { Class::Flat } else { Class::Slope };
        let from = to.map(|to| to - rise);
        Self { class, flat_squared: x * x, by: (x, 0.0), arc: None, clay: 1.0, rise, climb: rise, from, to }
    }

    /// The way in XY as far as it is known, mm.
    pub(crate) fn flat_length(&self) -> f64 {
        self.flat_squared.sqrt()
    }

    /// The way in XYZ as far as it is known, mm.
    pub(crate) fn length(&self) -> f64 {
        self.squared().sqrt()
    }

    /// The way in XYZ as far as it is known, squared, mm².
    pub(crate) fn squared(&self) -> f64 {
        self.flat_squared + self.rise * self.rise
    }
}

/// What a move is to the clay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    /// Prints at one height.
    Flat,
    /// Prints while Z changes or becomes known.
    Slope,
    /// Moves in XY without clay, at one height.
    Travel,
    /// Moves in XY without clay while Z changes or becomes known.
    DiagonalTravel,
    /// Moves in Z alone, without clay.
    Vertical,
    /// Presses or draws clay in one place, at rest or rising.
    Prime,
    /// Changes nothing.
    Still,
}

/// Units, modes and position.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    x: Axis,
    y: Axis,
    z: Axis,
    /// Z when it last changed by enough to count: a fine spiral rises by less in a line.
    level: f64,
    e: f64,
    scale: f64,
    relative: bool,
    relative_e: bool,
    e_follows: bool,
}

#[derive(Clone, Copy, Debug, Default)]
struct Axis {
    at: f64,
    known: bool,
    /// How far the end stop's zero lies below the one that `G92` has set.
    shift: f64,
}

/// How an axis moved.
#[derive(Clone, Copy, Debug, Default)]
struct Step {
    by: f64,
    becomes_known: bool,
}

impl Motion {
    /// A printer that was just switched on: absolute millimetres, the position unknown. If `e_follows`, `G90` and `G91`
    /// hold for E too.
    pub(crate) fn new(e_follows: bool) -> Self {
        let unknown = Axis::default();
        Self {
            x: unknown,
            y: unknown,
            z: unknown,
            level: 0.0,
            e: 0.0,
            scale: 1.0,
            relative: false,
            relative_e: false,
            e_follows,
        }
    }

    /// Does what `line` says.
    #[inline]
    pub(crate) fn obey(&mut self, line: &Line) -> Action {
        let Some(command) = line.command else { return Action::Nothing };
        match command {
            G0 | G1 => Action::Move(self.go_straight(&line.words)),
            G2 => Action::Move(self.go_round(&line.words, Turn::Clockwise)),
            G3 => Action::Move(self.go_round(&line.words, Turn::Counter)),
            other => self.set(other, &line.words),
        }
    }

    /// Z is relative.
    pub(crate) fn is_relative(&self) -> bool {
        self.relative
    }

    /// Lengths are in inches.
    pub(crate) fn is_inches(&self) -> bool {
        self.scale != 1.0
    }

    fn set(&mut self, command: Code, words: &Words) -> Action {
        match command {
            G20 => self.scale = MM_PER_INCH,
            G21 => self.scale = 1.0,
            G28 => {
                self.home(words);
                return Action::Home;
            }
            G90 | G91 => {
                self.relative = command == G91;
                if self.e_follows {
                    self.relative_e = self.relative;
                }
            }
            G92 => {
                let before = self.height();
                let drift = self.z.at - self.level;
                for (letter, axis) in [(b'X', &mut self.x), (b'Y', &mut self.y), (b'Z', &mut self.z)] {
                    if let Some(value) = words.get(letter) {
                        axis.set(value * self.scale);
                    }
                }
                self.e = words.get(b'E').map_or(self.e, |value| value * self.scale);
                self.level = self.z.at - drift;
                return Action::Reset { height: self.height() != before };
            }
            M82 => self.relative_e = false,
            M83 => self.relative_e = true,
            _ => {}
        }
        Action::Nothing
    }

    /// The axes named, or all, go where only the printer knows.
    fn home(&mut self, words: &Words) {
        let named = |letter| words.has(letter) || words.is_bare(letter);
        let all = !b"XYZ".iter().any(|&letter| named(letter));
        for (letter, axis) in [(b'X', &mut self.x), (b'Y', &mut self.y), (b'Z', &mut self.z)] {
            if all || named(letter) {
                *axis = Axis { at: axis.at, ..Axis::default() };
            }
        }
    }

    /// Moves as `G0` and `G1` do.
    #[inline(always)]
    pub(crate) fn go_straight(&mut self, words: &Words) -> Move {
        self.go(words, |x, y| (x * x + y * y, None))
    }

    #[inline(never)]
    fn go_round(&mut self, words: &Words, turn: Turn) -> Move {
        let scale = self.scale;
        self.go(words, |x, y| match Arc::of((x, y), words, scale, turn) {
            Some(arc) => (arc.length * arc.length, Some(arc)),
            None => (x * x + y * y, None),
        })
    }

    /// Moves by a way that is as long, squared, and as round as `way` says of the steps in X and Y.
    #[inline(always)]
    fn go(&mut self, words: &Words, way: impl FnOnce(f64, f64) -> (f64, Option<Arc>)) -> Move {
        let (scale, relative) = (self.scale, self.relative);
        let from = self.height();
        let x = self.x.step(words.get(b'X'), scale, relative);
        let y = self.y.step(words.get(b'Y'), scale, relative);
        let z = self.z.step(words.get(b'Z'), scale, relative);
        let clay = match words.get(b'E') {
            None => 0.0,
            Some(value) if self.relative_e => {
                self.e += value * scale;
                value * scale
            }
            Some(value) => {
                let clay = value * scale - self.e;
                self.e = value * scale;
                clay
            }
        };
        let (flat_squared, arc) = way(x.by, y.by);
        let goes = flat_squared > EPSILON * EPSILON || x.becomes_known || y.becomes_known;
        let drift = self.z.at - self.level;
        let climbs = drift.abs() > EPSILON_Z || z.becomes_known;
        let climb = if climbs && !z.becomes_known { drift } else { 0.0 };
        if climbs {
            self.level = self.z.at;
        }
        let class = match (goes, climbs, clay > EPSILON) {
            (true, false, true) => Class::Flat,
            (true, true, true) => Class::Slope,
            (true, false, false) => Class::Travel,
            (true, true, false) => Class::DiagonalTravel,
            (false, true, false) => Class::Vertical,
            (false, _, true) => Class::Prime,
            (false, false, false) if clay < -EPSILON => Class::Prime,
            (false, false, false) => Class::Still,
        };
        let by = (x.by, y.by);
        Move { class, flat_squared, by, arc, clay, rise: z.by, climb, from, to: self.height() }
    }

    /// X and Y from the end stops, whatever `G92` has set; nothing if one of them is unknown.
    #[inline]
    pub(crate) fn place(&self) -> Option<(f64, f64)> {
        (self.x.known && self.y.known).then_some((self.x.at + self.x.shift, self.y.at + self.y.shift))
    }

    /// Z from the end stop, whatever `G92` has set; nothing if it is unknown.
    #[inline]
    pub(crate) fn altitude(&self) -> Option<f64> {
        self.z.known.then_some(self.z.at + self.z.shift)
    }

    /// What lengths and E are to be multiplied with: 1, or the millimetres of an inch.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// E words are what flows, not where E goes.
    pub(crate) fn is_relative_e(&self) -> bool {
        self.relative_e
    }

    #[inline]
    fn height(&self) -> Option<f64> {
        self.z.known.then_some(self.z.at)
    }
}

impl Axis {
    /// The same place is called `at` from now on. A place that nobody knew is taken by its new name.
    fn set(&mut self, at: f64) {
        let shift = if self.known { self.shift + self.at - at } else { 0.0 };
        *self = Self { at, known: true, shift };
    }

    #[inline(always)]
    fn step(&mut self, word: Option<f64>, scale: f64, relative: bool) -> Step {
        let Some(value) = word else { return Step::default() };
        let value = value * scale;
        if relative {
            self.at += value;
            return Step { by: value, becomes_known: false };
        }
        let before = *self;
        *self = Self { at: value, known: true, ..before };
        if before.known {
            Step { by: value - before.at, becomes_known: false }
        } else {
            Step { by: 0.0, becomes_known: true }
        }
    }
}

impl Turn {
    /// 1 counter-clockwise, −1 clockwise.
    pub(crate) fn sign(self) -> f64 {
        if self == Self::Counter { 1.0 } else { -1.0 }
    }
}

/// Which way an arc turns, seen from above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turn {
    /// `G2`.
    Clockwise,
    /// `G3`.
    Counter,
}

const G0: Code = Code::g(0);
const G1: Code = Code::g(1);
const G2: Code = Code::g(2);
const G3: Code = Code::g(3);
const G20: Code = Code::g(20);
const G21: Code = Code::g(21);
const G28: Code = Code::g(28);
const G90: Code = Code::g(90);
const G91: Code = Code::g(91);
const G92: Code = Code::g(92);
const M82: Code = Code::m(82);
const M83: Code = Code::m(83);
