//! A command as a row of a table.

use crate::command::{By, Command, Step};
use crate::given::Given;

/// The values of a command in the columns that all commands share.
///
/// ```
/// use gcode::{Flavor, Parser, Row};
///
/// let mut rows = Vec::new();
/// Parser::new(&Flavor::default()).read(b"G1 X5 E2 F600\nM104 S200", |step| rows.push(Row::of(&step)));
/// assert_eq!((rows[0].kind, rows[0].x.get(), rows[0].feed.get()), ("MoveExtrude", Some(5.0), Some(10.0)));
/// assert_eq!((rows[1].kind, rows[1].number, rows[1].text), ("M", Some(104.0), &b"S200"[..]));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Row<'a> {
    /// The line of the file.
    pub line: u32,
    /// The name of the kind.
    pub kind: &'static str,
    /// X, mm.
    pub x: Given,
    /// Y, mm.
    pub y: Given,
    /// Z, mm.
    pub z: Given,
    /// The feed, mm/s.
    pub feed: Given,
    /// What is deposited.
    pub deposit: Given,
    /// What `deposit` means.
    pub by: Option<By>,
    /// The first number of an arc: centre or radius, mm.
    pub first: Given,
    /// The second number of an arc, mm.
    pub second: Given,
    /// The spindle, revolutions per second.
    pub speed: Given,
    /// How long it takes, seconds or revolutions.
    pub time: Given,
    /// The number of a code or of a system of coordinates.
    pub number: Option<f64>,
    /// What is text.
    pub text: &'a [u8],
}

impl<'a> Row<'a> {
    /// The row of a command.
    pub fn of(step: &Step<'a>) -> Self {
        let mut row = Self { line: step.line, kind: step.command.kind().name(), ..Self::default() };
        let given = Given::new;
        match step.command {
            Command::Move { to, feed: f, .. }
            | Command::MachineCoordinates { to, feed: f, .. }
            | Command::MoveExtrude { to, feed: f, .. }
            | Command::MoveMill { to, feed: f, .. }
            | Command::Arc { to, feed: f, .. }
            | Command::ArcExtrude { to, feed: f, .. }
            | Command::ArcMill { to, feed: f, .. } => {
                (row.x, row.y, row.z, row.feed) = (to.x, to.y, to.z, f);
            }
            Command::Extrude { feed, .. } => row.feed = feed,
            Command::FeedRate { feed } => row.feed = given(feed),
            Command::Mill { speed, .. } => row.speed = speed,
            Command::Dwell { time, .. } | Command::Purge { time, .. } => row.time = given(time),
            Command::Config { text } | Command::Comment { text } => row.text = text,
            Command::G { tenths, words } | Command::M { tenths, words } => {
                row.number = Some(f64::from(tenths) / 10.0);
                row.text = words.text;
            }
            Command::WorkCoordinates { system } => row.number = Some(f64::from(system)),
            Command::AbsolutePosition | Command::IncrementalPosition => {}
        }
        match step.command {
            Command::Extrude { deposit, by, .. }
            | Command::MoveExtrude { deposit, by, .. }
            | Command::ArcExtrude { deposit, by, .. }
            | Command::Purge { deposit, by, .. } => (row.deposit, row.by) = (given(deposit), Some(by)),
            Command::MoveMill { speed, .. } | Command::ArcMill { speed, .. } => row.speed = given(speed),
            _ => {}
        }
        if let Command::Arc { around, .. }
        | Command::ArcExtrude { around, .. }
        | Command::ArcMill { around, .. } = step.command
        {
            (row.first, row.second) = (given(around[0]), given(around[1]));
        }
        row
    }
}
