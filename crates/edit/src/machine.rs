//! The printer: modes, position, feed and clay, with what each line does to them.
//!
//! The machine model of [`clay_processor`] judges a file by classes of moves; to change one, all of the state is
//! needed, in one frame of coordinates for the whole file: `G92` renames places, and a move is where it is.

use gcode::{Code, Line, Words};

use crate::arc::{Arc, Plane};

/// Below this a length is rounding of the sums, mm.
pub(crate) const EPSILON: f64 = 1e-6;
/// Half of the last decimal that slicers write: below this Z stays, mm.
pub(crate) const EPSILON_Z: f64 = 0.0005;
const MM_PER_INCH: f64 = 25.4;

/// The letters of the axes.
pub(crate) const AXES: [u8; 3] = *b"XYZ";

/// A place, mm, in the coordinates that hold before the first `G92`.
pub(crate) type Point = [f64; 3];

/// What a line does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Act {
    /// No move: a remark, a mode, a command of another kind.
    Other,
    /// The nozzle or the ram moves, or the feed is set.
    Move(Move),
    /// The printer seeks its end stops.
    Home,
}

/// One `G0`, `G1`, `G2` or `G3`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Move {
    /// An axis whose place was unknown is taken to come from where it goes to.
    pub(crate) from: Point,
    pub(crate) to: Point,
    /// Whether the place is known afterwards, for each axis.
    pub(crate) known: [bool; 3],
    /// E, in mm of the machine's unit.
    pub(crate) clay: f64,
    /// mm/min; nothing before the first F.
    pub(crate) feed: Option<f64>,
    pub(crate) arc: Option<Arc>,
    /// Whether X or Y changes or becomes known.
    pub(crate) goes: bool,
    /// Whether Z changes or becomes known.
    pub(crate) climbs: bool,
}

impl Move {
    /// Whether it lays a bead, as the machine model sees it.
    pub(crate) fn prints(&self) -> bool {
        self.goes && self.clay > EPSILON
    }

    /// Whether the nozzle goes somewhere without laying a bead.
    pub(crate) fn travels(&self) -> bool {
        (self.goes || self.climbs) && !self.prints()
    }

    /// The change of Z, mm.
    pub(crate) fn rise(&self) -> f64 {
        self.to[2] - self.from[2]
    }

    /// The way with each axis stretched, mm. Arcs keep their form only if the axes of their plane are stretched alike.
    pub(crate) fn length(&self, stretch: Point) -> f64 {
        let step: Point = std::array::from_fn(|axis| (self.to[axis] - self.from[axis]) * stretch[axis]);
        match &self.arc {
            None => (step[0] * step[0] + step[1] * step[1] + step[2] * step[2]).sqrt(),
            Some(arc) => {
                let [a, b] = arc.plane.axes();
                (arc.length() * stretch[a]).hypot(step[3 - a - b])
            }
        }
    }

    /// The place after `share` of the way.
    pub(crate) fn at(&self, share: f64) -> Point {
        let mut point =
            std::array::from_fn(|axis| self.from[axis] + (self.to[axis] - self.from[axis]) * share);
        if let Some(arc) = &self.arc {
            let [a, b] = arc.plane.axes();
            let [on_a, on_b] = arc.at(share);
            (point[a], point[b]) = (on_a, on_b);
        }
        point
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Axis {
    /// As the file names it.
    at: f64,
    /// What the file has renamed so far.
    shift: f64,
    known: bool,
}

/// Modes, position, feed and clay.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Machine {
    axes: [Axis; 3],
    /// As the file names it, mm.
    e: f64,
    feed: Option<f64>,
    scale: f64,
    relative: bool,
    relative_e: bool,
    plane: Plane,
}

impl Machine {
    /// A printer that was just switched on: absolute millimetres, the position unknown.
    pub(crate) fn new() -> Self {
        Self {
            axes: [Axis::default(); 3],
            e: 0.0,
            feed: None,
            scale: 1.0,
            relative: false,
            relative_e: false,
            plane: Plane::Xy,
        }
    }

    /// Does what `line` says.
    #[inline]
    pub(crate) fn obey(&mut self, line: &Line) -> Act {
        let Some(command) = line.command else { return Act::Other };
        match command {
            G0 | G1 => Act::Move(self.go(&line.words, None)),
            G2 => Act::Move(self.go(&line.words, Some(false))),
            G3 => Act::Move(self.go(&line.words, Some(true))),
            G28 => {
                self.home(&line.words);
                Act::Home
            }
            other => {
                self.set(other, &line.words);
                Act::Other
            }
        }
    }

    /// Where it is, for the axes that are known.
    pub(crate) fn place(&self) -> [Option<f64>; 3] {
        self.axes.map(|axis| axis.known.then_some(axis.at + axis.shift))
    }

    /// Where an axis is, counted from an unknown place if it is unknown.
    pub(crate) fn at(&self, axis: usize) -> f64 {
        self.axes.get(axis).map_or(0.0, |axis| axis.at + axis.shift)
    }

    /// The number that sends an axis to a place: of the file's unit, frame and mode.
    pub(crate) fn word_to(&self, axis: usize, place: f64) -> f64 {
        let Some(axis) = self.axes.get(axis) else { return place };
        let at = if self.relative { place - axis.at - axis.shift } else { place - axis.shift };
        at / self.scale
    }

    /// The number that gives so much clay.
    pub(crate) fn word_of_clay(&self, clay: f64) -> f64 {
        (if self.is_relative_e() { clay } else { self.e + clay }) / self.scale
    }

    /// The E that an absolute word would name now.
    pub(crate) fn e_word(&self) -> f64 {
        self.e / self.scale
    }

    /// mm of one unit of the file.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// mm/min; nothing before the first F.
    pub(crate) fn feed(&self) -> Option<f64> {
        self.feed
    }

    /// Whether X, Y and Z are relative.
    pub(crate) fn is_relative(&self) -> bool {
        self.relative
    }

    /// Whether E is relative: by `M83`, or while `G91` holds. Firmware differs in the second, but who writes `G91` and
    /// an E means what Marlin and Klipper do with it.
    pub(crate) fn is_relative_e(&self) -> bool {
        self.relative_e || self.relative
    }

    /// The lines that bring another machine into the modes of this one: plane, units, then coordinates, then E, which `G90`
    /// takes along on some firmware.
    pub(crate) fn modes(&self) -> [&'static str; 4] {
        [
            match self.plane {
                Plane::Xy => "G17",
                Plane::Zx => "G18",
                Plane::Yz => "G19",
            },
            if self.scale == 1.0 { "G21" } else { "G20" },
            if self.relative { "G91" } else { "G90" },
            if self.relative_e { "M83" } else { "M82" },
        ]
    }

    fn set(&mut self, command: Code, words: &Words) {
        match command {
            G17 => self.plane = Plane::Xy,
            G18 => self.plane = Plane::Zx,
            G19 => self.plane = Plane::Yz,
            G20 => self.scale = MM_PER_INCH,
            G21 => self.scale = 1.0,
            G90 => self.relative = false,
            G91 => self.relative = true,
            G92 => {
                for (axis, letter) in self.axes.iter_mut().zip(AXES) {
                    if let Some(value) = words.get(letter) {
                        let named = value * self.scale;
                        let shift = if axis.known { axis.shift + axis.at - named } else { axis.shift };
                        *axis = Axis { at: named, shift, known: true };
                    }
                }
                self.e = words.get(b'E').map_or(self.e, |value| value * self.scale);
            }
            M82 => self.relative_e = false,
            M83 => self.relative_e = true,
            _ => {}
        }
    }

    /// The axes named, or all, go where only the printer knows; what `G92` renamed is forgotten.
    fn home(&mut self, words: &Words) {
        let named = |letter| words.has(letter) || words.is_bare(letter);
        let all = !AXES.iter().any(|&letter| named(letter));
        for (axis, letter) in self.axes.iter_mut().zip(AXES) {
            if all || named(letter) {
                *axis = Axis::default();
            }
        }
    }

    #[inline]
    fn go(&mut self, words: &Words, turn: Option<bool>) -> Move {
        let (scale, relative) = (self.scale, self.relative);
        let mut from = [0.0; 3];
        let mut to = [0.0; 3];
        let mut becomes_known = [false; 3];
        for (index, (axis, letter)) in self.axes.iter_mut().zip(AXES).enumerate() {
            from[index] = axis.at + axis.shift;
            if let Some(value) = words.get(letter) {
                let value = value * scale;
                if relative {
                    axis.at += value;
                } else {
                    becomes_known[index] = !axis.known;
                    axis.at = value;
                    axis.known = true;
                }
            }
            to[index] = axis.at + axis.shift;
            if becomes_known[index] {
                from[index] = to[index];
            }
        }
        let clay = match words.get(b'E') {
            None => 0.0,
            Some(value) if self.is_relative_e() => {
                self.e += value * scale;
                value * scale
            }
            Some(value) => {
                let clay = value * scale - self.e;
                self.e = value * scale;
                clay
            }
        };
        if let Some(feed) = words.get(b'F').filter(|&feed| feed > 0.0) {
            self.feed = Some(feed * scale);
        }
        let arc = turn.and_then(|counter| Arc::new(self.plane, from, to, words, scale, counter));
        let flat = (to[0] - from[0]).abs() + (to[1] - from[1]).abs();
        Move {
            from,
            to,
            known: self.axes.map(|axis| axis.known),
            clay,
            feed: self.feed,
            arc,
            goes: flat > EPSILON || arc.is_some() || becomes_known[0] || becomes_known[1],
            climbs: (to[2] - from[2]).abs() > EPSILON_Z || becomes_known[2],
        }
    }
}

const G0: Code = Code::g(0);
const G1: Code = Code::g(1);
const G2: Code = Code::g(2);
const G3: Code = Code::g(3);
const G17: Code = Code::g(17);
const G18: Code = Code::g(18);
const G19: Code = Code::g(19);
const G20: Code = Code::g(20);
const G21: Code = Code::g(21);
const G28: Code = Code::g(28);
const G90: Code = Code::g(90);
const G91: Code = Code::g(91);
const G92: Code = Code::g(92);
const M82: Code = Code::m(82);
const M83: Code = Code::m(83);
