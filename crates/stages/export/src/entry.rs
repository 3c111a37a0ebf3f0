//! What a layer takes over from the lines before it, so that layers can be written side by side.

use skein::command::command;
use skein::{Extrusion, Feed, Line, Point3, Ratio};

/// What is known when a layer begins, from the lines before it.
#[derive(Clone, Copy, Default)]
pub(crate) struct Entry {
    /// Where the nozzle is, if anybody knows.
    pub(crate) at: Option<Point3>,
    /// The last feed that the skein has said.
    pub(crate) feed: Option<Feed>,
    /// The share of the nominal section that flows.
    pub(crate) flow: Option<Ratio>,
    /// Whether clay flows already: a spiral goes on from layer to layer.
    pub(crate) on: bool,
    /// The last E word, for files that count from the start.
    pub(crate) e: Option<Extrusion>,
}

/// What some lines change of it.
#[derive(Clone, Copy, Default)]
pub(crate) struct Change {
    /// The new place, or that nobody knows it any more.
    at: Option<Option<Point3>>,
    feed: Option<Feed>,
    flow: Option<Ratio>,
    on: Option<bool>,
    e: Option<Extrusion>,
}

impl Change {
    /// Everything is looked for from the end, where it nearly always stands.
    pub(crate) fn of(lines: &[Line]) -> Self {
        let moves = || lines.iter().rev().filter_map(Line::as_move);
        Self {
            at: lines.iter().rev().find_map(|line| match line {
                line if is_foreign(line) => Some(None),
                line => line.as_move().map(|step| Some(step.to)),
            }),
            feed: moves().find_map(|step| step.feed),
            flow: lines.iter().rev().find_map(|line| match line {
                Line::Flow(flow) => Some(*flow),
                _ => None,
            }),
            on: lines.iter().rev().find_map(|line| match line {
                Line::On => Some(true),
                Line::Off => Some(false),
                _ => None,
            }),
            e: moves().find_map(|step| step.extrusion),
        }
    }
}

impl Entry {
    /// After a change.
    pub(crate) fn after(self, change: Change) -> Self {
        Self {
            at: change.at.unwrap_or(self.at),
            feed: change.feed.or(self.feed),
            flow: change.flow.or(self.flow),
            on: change.on.unwrap_or(self.on),
            e: change.e.or(self.e),
        }
    }
}

/// Whether a line may move the nozzle or change what its words mean. Remarks and M-commands do not.
pub(crate) fn is_foreign(line: &Line) -> bool {
    match line {
        // Waiting and saying what has been said is no change.
        Line::Verbatim(text) | Line::Pasted(text) => {
            matches!(command(text), Some((b'G', number, _)) if ![4, 21, 90].contains(&number))
        }
        _ => false,
    }
}
