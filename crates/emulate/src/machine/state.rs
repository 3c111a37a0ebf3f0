//! What a machine keeps in mind from one command to the next.

use super::feed::{Feed, FeedMode};
use crate::arc::{Arc, ArcFault};
use gcode::{AffectsE, By, Command, Given, Parameters, Spin, Target, Turn};
use std::borrow::Cow;

/// What `G92` without an axis does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BareG92 {
    /// All axes read 0 (Prusa, Klipper).
    #[default]
    Zero,
    /// Nothing, and it is said (LinuxCNC).
    Nothing,
}

/// Modal state: position, origins, modes.
#[derive(Clone, Debug)]
pub(crate) struct State {
    /// Where the nozzle is, in machine coordinates, mm.
    pub(crate) at: [f64; 3],
    /// What the extruder counts.
    e: f64,
    /// Where the table of a BAAM is, mm.
    table: f64,
    /// Origins of `G54` and its kin; the first is the machine's own.
    origins: [[f64; 3]; 10],
    system: usize,
    /// What `G92` adds.
    shift: [f64; 3],
    suspended: [f64; 3],
    relative: bool,
    relative_e: bool,
    g90_for_e: AffectsE,
    bare_g92: BareG92,
    pub(crate) feed: Feed,
    pub(crate) tool: u16,
    /// Where the tool points away from.
    pub(crate) axis: [f64; 3],
    /// `M221`.
    pub(crate) flow: f64,
    /// The first places are taken without a move.
    pub(crate) unknown: [bool; 3],
}

/// What a command does.
pub(crate) enum Effect {
    /// Nothing that takes time.
    Nothing,
    /// The nozzle or the extruder moves.
    Way(Way),
    /// It waits so long, s, extruding or not.
    Wait(f64, Option<Deposit>),
    /// It stops, for it does not know how long.
    Stop,
    /// It seeks its end stops.
    Home,
}

/// A move.
pub(crate) struct Way {
    pub(crate) from: [f64; 3],
    pub(crate) to: [f64; 3],
    pub(crate) arc: Option<Arc>,
    pub(crate) deposit: Option<Deposit>,
    pub(crate) feed: Given,
    pub(crate) rapid: bool,
    /// How far the table moves, mm.
    pub(crate) table: f64,
}

/// What comes out, and how that is counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Deposit {
    pub(crate) amount: f64,
    pub(crate) by: By,
}

/// Takes what the machine has to say about a command.
pub(crate) type Say<'a> = &'a mut dyn FnMut(Cow<'static, str>);

impl State {
    pub(crate) fn new(start: Option<[f64; 3]>, g90_for_e: AffectsE, bare_g92: BareG92, feed: Feed) -> Self {
        Self {
            at: start.unwrap_or_default(),
            e: 0.0,
            table: 0.0,
            origins: [[0.0; 3]; 10],
            system: 1,
            shift: [0.0; 3],
            suspended: [0.0; 3],
            relative: false,
            relative_e: false,
            g90_for_e,
            bare_g92,
            feed,
            tool: 0,
            axis: [0.0, 0.0, 1.0],
            flow: 1.0,
            unknown: [start.is_none(); 3],
        }
    }

    /// Does what a command says.
    #[inline(always)]
    pub(crate) fn obey(&mut self, command: &Command<'_>, say: Say<'_>) -> Effect {
        match *command {
            Command::Move { to, feed, rapid, .. } => self.straight(command, to, feed, rapid, None, say),
            Command::MoveExtrude { to, feed, deposit, by, rapid, .. } => {
                let deposit = self.deposit(deposit, by);
                self.straight(command, to, feed, rapid, Some(deposit), say)
            }
            Command::Arc { to, feed, around, turn } => self.round(to, feed, around, turn, None, say),
            Command::ArcExtrude { to, feed, around, turn, deposit, by } => {
                let deposit = self.deposit(deposit, by);
                self.round(to, feed, around, turn, Some(deposit), say)
            }
            _ => self.obey_seldom(command, say),
        }
    }

    #[inline(never)]
    fn obey_seldom(&mut self, command: &Command<'_>, say: Say<'_>) -> Effect {
        match *command {
            Command::Extrude { deposit, by: By::Amount, feed, tool } => {
                self.tool = tool;
                let deposit = Some(self.deposit(deposit, By::Amount));
                let at = self.at;
                return Effect::Way(Way {
                    from: at,
                    to: at,
                    arc: None,
                    deposit,
                    feed,
                    rapid: false,
                    table: 0.0,
                });
            }
            Command::Extrude { deposit, by, tool, .. } => {
                self.tool = tool;
                if by == By::Speed {
                    self.feed.spindle = deposit.abs();
                }
            }
            Command::Mill { spin: Spin::Off, .. } => self.feed.spindle = 0.0,
            Command::Mill { speed, .. } => self.feed.spindle = speed.or(self.feed.spindle),
            Command::MoveMill { to, feed, speed, .. } => {
                self.feed.spindle = speed;
                return self.straight(command, to, feed, false, None, say);
            }
            Command::ArcMill { to, feed, around, turn, speed, .. } => {
                self.feed.spindle = speed;
                return self.round(to, feed, around, turn, None, say);
            }
            Command::Dwell { time, by } => return Effect::Wait(self.feed.seconds(time, by, say), None),
            Command::Purge { time, deposit, by } => {
                return Effect::Wait(time, Some(Deposit { amount: deposit, by }));
            }
            Command::FeedRate { feed } => self.feed.set(feed, say),
            Command::AbsolutePosition => self.set_relative(false),
            Command::IncrementalPosition => self.set_relative(true),
            Command::WorkCoordinates { system } => match self.origins.get(usize::from(system)) {
                Some(_) => self.system = usize::from(system),
                None => say(Cow::Owned(format!("the origin of coordinate system {system} is not known"))),
            },
            Command::MachineCoordinates { to, feed, rapid, .. } => {
                if self.relative {
                    say(Cow::Borrowed("G53 under G91; its words are taken as places of the machine"));
                }
                let from = self.at;
                for (axis, value) in [to.x, to.y, to.z].into_iter().enumerate() {
                    self.at[axis] = value.or(self.at[axis]);
                }
                let table = self.other_axes(command, false, say);
                return Effect::Way(Way { from, to: self.at, arc: None, deposit: None, feed, rapid, table });
            }
            Command::G { tenths, words } => return self.obey_g(tenths, &words, say),
            Command::M { tenths, words } => return self.obey_m(tenths, &words),
            Command::Config { .. } => {
                if let Some(tool) = command.tool() {
                    let changes = tool != self.tool;
                    self.tool = tool;
                    return if changes { Effect::Stop } else { Effect::Nothing };
                }
            }
            _ => {}
        }
        Effect::Nothing
    }

    fn obey_g(&mut self, tenths: u16, words: &Parameters<'_>, say: Say<'_>) -> Effect {
        match tenths {
            100 => self.set_origin(words, say),
            280 => {
                let all = !b"XYZ".iter().any(|&letter| words.has(letter));
                for (axis, letter) in b"XYZ".iter().enumerate() {
                    if all || words.has(*letter) {
                        // The end stops know where they are, whatever the file had said.
                        self.at[axis] = 0.0;
                        self.shift[axis] = 0.0;
                        self.unknown[axis] = false;
                    }
                }
                return Effect::Home;
            }
            920 => self.rename(words, say),
            921 => self.shift = [0.0; 3],
            922 => {
                self.suspended = self.shift;
                self.shift = [0.0; 3];
            }
            923 => self.shift = self.suspended,
            930 => self.feed.mode = FeedMode::InverseTime,
            940 => self.feed.mode = FeedMode::PerMinute,
            950 => self.feed.mode = FeedMode::PerRevolution,
            _ => {}
        }
        Effect::Nothing
    }

    fn obey_m(&mut self, tenths: u16, words: &Parameters<'_>) -> Effect {
        match tenths {
            // Stops of the program; waiting for heat and for the end of all moves.
            0 | 10 | 20 | 300 | 1090 | 1160 | 1900 | 4000 => return Effect::Stop,
            820 => self.relative_e = false,
            830 => self.relative_e = true,
            2200 => self.feed.percent(words.get(b'S')),
            2210 => {
                let percent = words.get(b'S').filter(|&percent| percent > 0.0 && percent < 1e6);
                self.flow = percent.map_or(self.flow, |percent| percent / 100.0);
            }
            _ => {}
        }
        Effect::Nothing
    }

    /// `G90` and `G91`.
    fn set_relative(&mut self, relative: bool) {
        self.relative = relative;
        if self.g90_for_e == AffectsE::Override {
            self.relative_e = relative;
        }
    }

    /// `G92`: the point where the nozzle is reads as given.
    fn rename(&mut self, words: &Parameters<'_>, say: Say<'_>) {
        let bare = !b"XYZE".iter().any(|&letter| words.has(letter));
        if bare && self.bare_g92 == BareG92::Nothing {
            return say(Cow::Borrowed("G92 without an axis"));
        }
        for (axis, letter) in b"XYZ".iter().enumerate() {
            let value = if bare { Some(0.0) } else { words.length(*letter) };
            if let Some(value) = value {
                self.shift[axis] = self.at[axis] - self.origins[self.system][axis] - value;
            }
        }
        let value = if bare { Some(0.0) } else { words.get(b'E') };
        self.e = value.unwrap_or(self.e);
    }

    /// `G10 L2` and `L20`: where the origin of a coordinate system lies.
    fn set_origin(&mut self, words: &Parameters<'_>, say: Say<'_>) {
        let Some(kind) = words.get(b'L').filter(|&kind| kind == 2.0 || kind == 20.0) else { return };
        let system = match words.get(b'P') {
            Some(system) if (1.0..=9.0).contains(&system) && system.fract() == 0.0 => system as usize,
            None | Some(0.0) => self.system.max(1),
            Some(system) => return say(Cow::Owned(format!("G10 for coordinate system {system}"))),
        };
        for (axis, letter) in b"XYZ".iter().enumerate() {
            if let Some(value) = words.length(*letter) {
                let here = self.at[axis] - self.shift[axis];
                self.origins[system][axis] = if kind == 2.0 { value } else { here - value };
            }
        }
    }

    /// What an E word, or a running extruder, gives.
    #[inline]
    fn deposit(&mut self, value: f64, by: By) -> Deposit {
        if by != By::Amount {
            return Deposit { amount: value, by };
        }
        let relative = self.relative_e || (self.relative && self.g90_for_e == AffectsE::Or);
        let amount = if relative { value } else { value - self.e };
        self.e = if relative { self.e + value } else { value };
        Deposit { amount, by }
    }

    #[inline(always)]
    fn straight(
        &mut self,
        command: &Command<'_>,
        to: Target,
        feed: Given,
        rapid: bool,
        deposit: Option<Deposit>,
        say: Say<'_>,
    ) -> Effect {
        let to = self.target(to);
        let from = self.at;
        self.at = to;
        let table = self.other_axes(command, self.relative, say);
        Effect::Way(Way { from, to: self.at, arc: None, deposit, feed, rapid, table })
    }

    /// A target in the coordinates of the machine.
    #[inline]
    fn target(&mut self, to: Target) -> [f64; 3] {
        let mut place = self.at;
        for (axis, value) in [to.x, to.y, to.z].into_iter().enumerate() {
            let Some(value) = value.get() else { continue };
            if self.relative {
                place[axis] += value;
            } else {
                place[axis] = value + self.origins[self.system][axis] + self.shift[axis];
                if self.unknown[axis] {
                    self.unknown[axis] = false;
                    // The first place is where the nozzle was.
                    self.at[axis] = place[axis];
                }
            }
        }
        place
    }

    /// Takes the words of the table and of the axes that turn the tool. How far the table moves; that counts as height,
    /// for the part is as high as Z and the way of the table together.
    #[inline]
    fn other_axes(&mut self, command: &Command<'_>, relative: bool, say: Say<'_>) -> f64 {
        match command.also() {
            Some(words) => self.other_axes_of(&words, relative, say),
            None => 0.0,
        }
    }

    #[cold]
    fn other_axes_of(&mut self, words: &Parameters<'_>, relative: bool, say: Say<'_>) -> f64 {
        for letter in *b"UV" {
            if words.has(letter) {
                say(Cow::Owned(format!("the axis {} is not emulated", char::from(letter))));
            }
        }
        let turned = [b'A', b'B', b'C'].map(|letter| words.get(letter).map(f64::to_radians));
        if turned.iter().any(Option::is_some) {
            self.axis = tool_axis(turned.map(Option::unwrap_or_default));
        }
        let Some(value) = words.length(b'W') else { return 0.0 };
        let before = self.table;
        self.table = if relative { before + value } else { value };
        let by = self.table.abs() - before.abs();
        self.at[2] += by;
        by
    }

    fn round(
        &mut self,
        to: Target,
        feed: Given,
        around: [f64; 2],
        turn: Turn,
        deposit: Option<Deposit>,
        say: Say<'_>,
    ) -> Effect {
        let place = self.target(to);
        let mut around = around;
        if turn.centre == gcode::Centre::Absolute {
            let axes = match turn.plane {
                gcode::Plane::Xy => [0, 1],
                gcode::Plane::Zx => [2, 0],
                gcode::Plane::Yz => [1, 2],
            };
            for (value, axis) in around.iter_mut().zip(axes) {
                *value += self.origins[self.system][axis] + self.shift[axis];
            }
        }
        let arc = match Arc::new(self.at, place, around, turn) {
            Ok((arc, odd)) => {
                if let Some(fault) = odd {
                    say(described(fault, false));
                }
                Some(arc)
            }
            Err(fault) => {
                say(described(fault, true));
                None
            }
        };
        let from = self.at;
        self.at = place;
        Effect::Way(Way { from, to: place, arc, deposit, feed, rapid: false, table: 0.0 })
    }
}

/// Z turned about X by the first angle, then about Y by the second and Z by the third, rad.
fn tool_axis([a, b, c]: [f64; 3]) -> [f64; 3] {
    let ((sin_a, cos_a), (sin_b, cos_b), (sin_c, cos_c)) =
        (libm::sincos(a), libm::sincos(b), libm::sincos(c));
    let (x, y, z) = (cos_a * sin_b, -sin_a, cos_a * cos_b);
    [x * cos_c - y * sin_c, x * sin_c + y * cos_c, z]
}

fn described(fault: ArcFault, fatal: bool) -> Cow<'static, str> {
    let what = match fault {
        ArcFault::NoRadius => "an arc without a radius".to_owned(),
        ArcFault::ClosedByRadius => "a full circle by its radius could lie anywhere".to_owned(),
        ArcFault::OffCircle(off) => format!("the end of an arc lies {off:.4} mm off its circle"),
        ArcFault::TooShort(off) => {
            format!("the ends of an arc are {:.4} mm too far apart for its radius", 2.0 * off)
        }
    };
    Cow::Owned(if fatal { what + "; it is taken as a straight move" } else { what })
}
