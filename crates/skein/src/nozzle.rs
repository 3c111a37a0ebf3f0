//! Views: where the nozzle is, and which lines belong together.

use crate::{Feature, Line, Mark, Side, Skein, Tag};
use rayon::prelude::*;
use shape::{Point, Point3, Ring};
use unit::{Feed, Ratio};

/// What the nozzle is doing. Fed every line in order, it knows where it is, whether clay flows, and what for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Nozzle {
    /// Where it stands; unknown before the first move.
    pub at: Option<Point3>,
    /// Whether clay flows.
    pub on: bool,
    /// The share of the nominal section that flows.
    pub flow: Ratio,
    /// The last feed said.
    pub feed: Option<Feed>,
    /// What the present bead is for.
    pub feature: Feature,
}

impl Default for Nozzle {
    fn default() -> Self {
        Self { at: None, on: false, flow: Ratio::ONE, feed: None, feature: Feature::Middle }
    }
}

impl Nozzle {
    /// Takes note of one line.
    #[inline]
    pub fn follow(&mut self, line: &Line) {
        if let Some(step) = line.as_move() {
            self.at = Some(step.to);
            self.feed = step.feed.or(self.feed);
            return;
        }
        match line {
            Line::On => self.on = true,
            Line::Off => self.on = false,
            Line::Flow(flow) => self.flow = *flow,
            Line::Wall(Tag::Edge, side) => self.feature = Feature::Edge(*side),
            Line::Wall(Tag::Loop, side) => self.feature = Feature::Loop(*side),
            Line::Open(Tag::Infill) => self.feature = Feature::Infill,
            Line::Open(Tag::Skirt) => self.feature = Feature::Skirt,
            Line::Open(Tag::Support) => self.feature = Feature::Support,
            Line::Open(Tag::Raft) => self.feature = Feature::Raft,
            Line::Close(Tag::Edge | Tag::Loop | Tag::Infill | Tag::Skirt | Tag::Support | Tag::Raft) => {
                self.feature = Feature::Middle;
            }
            _ => {}
        }
    }

    /// Keeps the speed of lines that other lines have come before: the first move, if it says none, says the one that
    /// held here.
    pub fn restate(&self, lines: &mut [Line]) {
        if let Some(step) = lines.iter_mut().find_map(Line::as_move_mut) {
            step.feed = step.feed.or(self.feed);
        }
    }

    fn change(&mut self, change: &Change) {
        self.at = change.at.or(self.at);
        self.on = change.on.unwrap_or(self.on);
        self.flow = change.flow.unwrap_or(self.flow);
        self.feed = change.feed.or(self.feed);
    }
}

impl Skein {
    /// The highest place that the nozzle has reached in front of each layer, and at last of all; nothing before the first
    /// move.
    pub fn highest(&self) -> Vec<Option<i32>> {
        let top = |lines: &[Line]| lines.iter().filter_map(Line::as_move).map(|step| step.to.z).max();
        let tops: Vec<Option<i32>> = self.layers.par_iter().map(|layer| top(&layer.lines)).collect();
        let mut highest = vec![top(&self.head)];
        highest.extend(tops.iter().scan(top(&self.head), |so_far, top| {
            *so_far = (*so_far).max(*top);
            Some(*so_far)
        }));
        highest
    }
}

/// What some lines change of a nozzle, whatever stood before them.
struct Change {
    at: Option<Point3>,
    on: Option<bool>,
    flow: Option<Ratio>,
    feed: Option<Feed>,
}

impl Change {
    /// Looked for from the end, where nearly everything stands.
    fn of(lines: &[Line]) -> Self {
        let moves = || lines.iter().rev().filter_map(Line::as_move);
        Self {
            at: moves().next().map(|step| step.to),
            on: lines.iter().rev().find_map(|line| match line {
                Line::On => Some(true),
                Line::Off => Some(false),
                _ => None,
            }),
            flow: lines.iter().rev().find_map(|line| match line {
                Line::Flow(flow) => Some(*flow),
                _ => None,
            }),
            feed: moves().find_map(|step| step.feed),
        }
    }
}

impl Skein {
    /// The nozzle as each layer finds it, and behind the last layer as the tail finds it: what a stage needs that works
    /// on layers side by side.
    pub fn nozzles(&self) -> Vec<Nozzle> {
        let changes: Vec<Change> = self.layers.par_iter().map(|layer| Change::of(&layer.lines)).collect();
        let mut nozzle = Nozzle::default();
        nozzle.change(&Change::of(&self.head));
        let mut nozzles = Vec::with_capacity(changes.len() + 1);
        for change in &changes {
            nozzles.push(nozzle);
            nozzle.change(change);
        }
        nozzles.push(nozzle);
        nozzles
    }
}

/// Lines that belong together. End to end the spans of a layer are all its lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Span<'a> {
    /// From where clay begins to flow to where it stops.
    Thread(&'a [Line]),
    /// Moves without clay, one after the other.
    Travel(&'a [Line]),
    /// Any other line.
    Other(&'a Line),
}

impl<'a> Span<'a> {
    /// Its lines.
    pub fn lines(&self) -> &'a [Line] {
        match self {
            Self::Thread(lines) | Self::Travel(lines) => lines,
            Self::Other(line) => std::slice::from_ref(line),
        }
    }
}

/// Cuts lines into threads, travels and the rest.
pub fn spans(lines: &[Line]) -> impl Iterator<Item = Span<'_>> {
    let mut rest = lines;
    std::iter::from_fn(move || {
        let (first, _) = rest.split_first()?;
        let length = match first {
            Line::On => {
                rest.iter().position(|line| matches!(line, Line::Off)).map_or(rest.len(), |end| end + 1)
            }
            line if line.as_move().is_some() => {
                rest.iter().position(|line| line.as_move().is_none()).unwrap_or(rest.len())
            }
            _ => 1,
        };
        let (span, after) = rest.split_at(length);
        rest = after;
        Some(match first {
            Line::On => Span::Thread(span),
            line if line.as_move().is_some() => Span::Travel(span),
            line => Span::Other(line),
        })
    })
}

/// The outlines of a layer: one ring for each boundary block.
pub fn boundary(lines: &[Line]) -> Vec<Ring> {
    let mut rings = Vec::new();
    let mut points = Vec::new();
    for line in lines {
        match line {
            Line::Point(Mark::Boundary, at) => points.push(Point::new(at.x, at.y)),
            Line::Close(Tag::BoundaryPerimeter) => rings.push(Ring(std::mem::take(&mut points))),
            _ => {}
        }
    }
    rings
}

impl Feature {
    /// Whether it is a wall.
    pub fn is_wall(self) -> bool {
        matches!(self, Self::Edge(_) | Self::Loop(_))
    }

    /// The lines that open and close the block of a bead of this kind.
    pub fn tags(self) -> (Line, Line) {
        match self {
            Self::Edge(side) => (Line::Wall(Tag::Edge, side), Line::Close(Tag::Edge)),
            Self::Loop(side) => (Line::Wall(Tag::Loop, side), Line::Close(Tag::Loop)),
            Self::Infill => (Line::Open(Tag::Infill), Line::Close(Tag::Infill)),
            Self::Middle => (Line::Open(Tag::Middle), Line::Close(Tag::Middle)),
            Self::Skirt => (Line::Open(Tag::Skirt), Line::Close(Tag::Skirt)),
            Self::Support => (Line::Open(Tag::Support), Line::Close(Tag::Support)),
            Self::Raft => (Line::Open(Tag::Raft), Line::Close(Tag::Raft)),
        }
    }
}

impl Side {
    /// The side a ring of this turning sense is on: counter-clockwise is outside.
    pub fn of(ring: &Ring) -> Self {
        if ring.area2() >= 0 { Self::Outer } else { Self::Inner }
    }
}
