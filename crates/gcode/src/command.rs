//! What a machine is told: the 19 kinds of command.
//!
//! Values are what the line says, in one system of units: lengths in mm, times in seconds, angles in degrees, whatever
//! the unit in the file. What a value means is for the machine to say: whether a target is absolute or relative, where
//! the origin lies, what an E word is in clay. A value that the line leaves out is [`Given::NONE`].
//!
//! A print is mostly commands, so one takes 64 bytes and owns nothing: texts are borrowed from the file.

use crate::given::Given;
use crate::parameters::{LengthUnit, Parameters};

/// Where a move ends: X, Y and Z as the line gives them, mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Target {
    /// X, mm.
    pub x: Given,
    /// Y, mm.
    pub y: Given,
    /// Z, mm.
    pub z: Given,
}

impl Target {
    /// Whether X, Y or Z is given.
    #[inline]
    pub fn is_some(&self) -> bool {
        self.x.is_some() || self.y.is_some() || self.z.is_some()
    }
}

/// What the number of a deposit means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum By {
    /// An E word: length of filament or ram, or volume; mm or mm³, as the machine has it. A total in absolute
    /// extrusion, a difference in relative.
    #[default]
    Amount,
    /// The speed of an extruder screw: revolutions per second, backwards if negative, 0 is off.
    Speed,
    /// The section of the bead: mm², 0 is off.
    Area,
}

/// The plane of an arc.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Plane {
    /// `G17`.
    #[default]
    Xy,
    /// `G18`. Its first axis is Z.
    Zx,
    /// `G19`.
    Yz,
}

/// What the two numbers of an arc are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Centre {
    /// From the start to the centre (`G91.1`).
    #[default]
    Offset,
    /// The place of the centre (`G90.1`).
    Absolute,
    /// The first number is the radius, negative for more than half a turn; the second is 0.
    Radius,
}

/// How an arc turns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Turn {
    /// The plane it turns in.
    pub plane: Plane,
    /// Clockwise (`G2`), seen against the axis that is not in the plane.
    pub clockwise: bool,
    /// What says where its centre is.
    pub centre: Centre,
    /// Whole turns that come on top.
    pub more: u8,
}

/// Which way a spindle turns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spin {
    /// `M5`.
    #[default]
    Off,
    /// `M3`.
    Clockwise,
    /// `M4`.
    CounterClockwise,
}

/// What the number of a dwell counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Span {
    /// Seconds.
    #[default]
    Seconds,
    /// Turns of the spindle.
    Revolutions,
}

/// One instruction.
///
/// `feed` is mm/s. Under `G93` it is moves per second instead, and under `G95` mm per revolution of the spindle.
///
/// `also` are the words of the line if it moves other axes than X, Y and Z, and empty otherwise; `unit` is the unit of
/// the lengths in it. [`Command::also`] reads them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command<'a> {
    /// Moves straight to a place.
    Move {
        /// Where to, mm.
        to: Target,
        /// How fast, mm/s.
        feed: Given,
        /// As fast as the machine can (`G0`), where it knows the difference.
        rapid: bool,
        /// The words of other axes.
        also: &'a [u8],
        /// The unit of `also`.
        unit: LengthUnit,
    },
    /// Moves about a centre.
    Arc {
        /// Where to, mm.
        to: Target,
        /// How fast, mm/s.
        feed: Given,
        /// Centre or radius, mm; [`Turn::centre`] says which. The two axes are those of the plane in their order.
        around: [f64; 2],
        /// How it turns.
        turn: Turn,
    },
    /// Deposits without a move, or switches an extruder that keeps running.
    Extrude {
        /// How much or how fast.
        deposit: f64,
        /// What `deposit` means.
        by: By,
        /// How fast, mm/s of what is extruded.
        feed: Given,
        /// The toolhead that was chosen last.
        tool: u16,
    },
    /// Moves straight and deposits.
    MoveExtrude {
        /// Where to, mm.
        to: Target,
        /// How fast, mm/s.
        feed: Given,
        /// How much or how fast.
        deposit: f64,
        /// What `deposit` means.
        by: By,
        /// Written as `G0`.
        rapid: bool,
        /// The words of other axes.
        also: &'a [u8],
        /// The unit of `also`.
        unit: LengthUnit,
    },
    /// Moves about a centre and deposits.
    ArcExtrude {
        /// Where to, mm.
        to: Target,
        /// How fast, mm/s.
        feed: Given,
        /// Centre or radius, mm.
        around: [f64; 2],
        /// How it turns.
        turn: Turn,
        /// How much or how fast.
        deposit: f64,
        /// What `deposit` means.
        by: By,
    },
    /// Switches a milling spindle.
    Mill {
        /// Revolutions per second.
        speed: Given,
        /// Which way.
        spin: Spin,
    },
    /// Moves straight while the spindle turns.
    MoveMill {
        /// Where to, mm.
        to: Target,
        /// How fast, mm/s.
        feed: Given,
        /// Revolutions per second.
        speed: f64,
        /// Which way.
        spin: Spin,
        /// The words of other axes.
        also: &'a [u8],
        /// The unit of `also`.
        unit: LengthUnit,
    },
    /// Moves about a centre while the spindle turns.
    ArcMill {
        /// Where to, mm.
        to: Target,
        /// How fast, mm/s.
        feed: Given,
        /// Centre or radius, mm.
        around: [f64; 2],
        /// How it turns.
        turn: Turn,
        /// Revolutions per second.
        speed: f64,
        /// Which way.
        spin: Spin,
    },
    /// Waits.
    Dwell {
        /// How long.
        time: f64,
        /// What `time` counts.
        by: Span,
    },
    /// Waits while the extruder runs.
    Purge {
        /// How long, seconds.
        time: f64,
        /// Revolutions of the screw per second, or the bead's section in mm².
        deposit: f64,
        /// What `deposit` means.
        by: By,
    },
    /// Sets the feed and nothing else.
    FeedRate {
        /// mm/s.
        feed: f64,
    },
    /// Anything else that a machine may know: a tool word, a command of Klipper, an assignment.
    Config {
        /// The text, without line number, remarks and checksum.
        text: &'a [u8],
    },
    /// A G code that is none of the other kinds.
    G {
        /// In tenths: `G92.1` is 921.
        tenths: u16,
        /// What stands behind it.
        words: Parameters<'a>,
    },
    /// An M code that is none of the other kinds.
    M {
        /// In tenths.
        tenths: u16,
        /// What stands behind it.
        words: Parameters<'a>,
    },
    /// Targets are places from here on (`G90`).
    AbsolutePosition,
    /// Targets are distances from here on (`G91`).
    IncrementalPosition,
    /// Targets count from the origin of a system from here on.
    WorkCoordinates {
        /// 1 for `G54` to 9 for `G59.3`; 0 for none (Siemens `G500`).
        system: u16,
    },
    /// Moves straight to a place in the coordinates of the machine (`G53`).
    MachineCoordinates {
        /// Where to, mm.
        to: Target,
        /// How fast, mm/s.
        feed: Given,
        /// As fast as the machine can (`G0`).
        rapid: bool,
        /// The words of other axes.
        also: &'a [u8],
        /// The unit of `also`.
        unit: LengthUnit,
    },
    /// A remark with no instruction.
    Comment {
        /// Its text, without the marks around it.
        text: &'a [u8],
    },
}

/// The kinds of [`Command`], by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
#[expect(missing_docs, reason = "they are those of `Command`")]
pub enum CommandKind {
    Move,
    Arc,
    Extrude,
    MoveExtrude,
    ArcExtrude,
    Mill,
    MoveMill,
    ArcMill,
    Dwell,
    Purge,
    FeedRate,
    Config,
    G,
    M,
    AbsolutePosition,
    IncrementalPosition,
    WorkCoordinates,
    MachineCoordinates,
    Comment,
}

impl CommandKind {
    /// All of them, in the order of their declaration.
    pub const ALL: [Self; 19] = [
        Self::Move,
        Self::Arc,
        Self::Extrude,
        Self::MoveExtrude,
        Self::ArcExtrude,
        Self::Mill,
        Self::MoveMill,
        Self::ArcMill,
        Self::Dwell,
        Self::Purge,
        Self::FeedRate,
        Self::Config,
        Self::G,
        Self::M,
        Self::AbsolutePosition,
        Self::IncrementalPosition,
        Self::WorkCoordinates,
        Self::MachineCoordinates,
        Self::Comment,
    ];

    /// The name of the seed's class.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Move => "Move",
            Self::Arc => "Arc",
            Self::Extrude => "Extrude",
            Self::MoveExtrude => "MoveExtrude",
            Self::ArcExtrude => "ArcExtrude",
            Self::Mill => "Mill",
            Self::MoveMill => "MoveMill",
            Self::ArcMill => "ArcMill",
            Self::Dwell => "Dwell",
            Self::Purge => "Purge",
            Self::FeedRate => "FeedRate",
            Self::Config => "Config",
            Self::G => "G",
            Self::M => "M",
            Self::AbsolutePosition => "AbsolutePosition",
            Self::IncrementalPosition => "IncrementalPosition",
            Self::WorkCoordinates => "WorkCoordinates",
            Self::MachineCoordinates => "MachineCoordinates",
            Self::Comment => "Comment",
        }
    }
}

impl<'a> Command<'a> {
    /// Which of the 19 it is.
    pub const fn kind(&self) -> CommandKind {
        match self {
            Self::Move { .. } => CommandKind::Move,
            Self::Arc { .. } => CommandKind::Arc,
            Self::Extrude { .. } => CommandKind::Extrude,
            Self::MoveExtrude { .. } => CommandKind::MoveExtrude,
            Self::ArcExtrude { .. } => CommandKind::ArcExtrude,
            Self::Mill { .. } => CommandKind::Mill,
            Self::MoveMill { .. } => CommandKind::MoveMill,
            Self::ArcMill { .. } => CommandKind::ArcMill,
            Self::Dwell { .. } => CommandKind::Dwell,
            Self::Purge { .. } => CommandKind::Purge,
            Self::FeedRate { .. } => CommandKind::FeedRate,
            Self::Config { .. } => CommandKind::Config,
            Self::G { .. } => CommandKind::G,
            Self::M { .. } => CommandKind::M,
            Self::AbsolutePosition => CommandKind::AbsolutePosition,
            Self::IncrementalPosition => CommandKind::IncrementalPosition,
            Self::WorkCoordinates { .. } => CommandKind::WorkCoordinates,
            Self::MachineCoordinates { .. } => CommandKind::MachineCoordinates,
            Self::Comment { .. } => CommandKind::Comment,
        }
    }

    /// The words of a straight move whose line moves other axes than X, Y and Z: ask them for U, V, W (lengths) and
    /// A, B, C (degrees, as written).
    pub const fn also(&self) -> Option<Parameters<'a>> {
        match *self {
            Self::Move { also, unit, .. }
            | Self::MoveExtrude { also, unit, .. }
            | Self::MoveMill { also, unit, .. }
            | Self::MachineCoordinates { also, unit, .. }
                if !also.is_empty() =>
            {
                Some(Parameters::new(also, unit))
            }
            _ => None,
        }
    }

    /// The number of the tool that a `T` word chooses.
    pub fn tool(&self) -> Option<u16> {
        let Self::Config { text } = *self else { return None };
        let number = text.strip_prefix(b"T").or_else(|| text.strip_prefix(b"t"))?;
        str::from_utf8(number).ok()?.trim().parse().ok()
    }
}

/// A command and where it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<'a> {
    /// The line of the file, counted from one.
    pub line: u32,
    /// What it says.
    pub command: Command<'a>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_takes_64_bytes() {
        assert_eq!(size_of::<Command<'_>>(), 64);
    }

    #[test]
    fn every_kind_has_a_name_of_its_own() {
        for (index, kind) in CommandKind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, index);
            assert!(CommandKind::ALL[..index].iter().all(|other| other.name() != kind.name()));
        }
    }
}
