//! What the nozzle does, line by line and layer by layer.

use crate::{Feature, Line, Side, Skein, Tag};
use rayon::prelude::*;
use shape::{Point3, Ring};
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
    /// The block of beads that is open.
    pub block: Option<Feature>,
}

impl Default for Nozzle {
    fn default() -> Self {
        Self { at: None, on: false, flow: Ratio::ONE, feed: None, block: None }
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
            line => {
                if let Some(block) = line.block() {
                    self.block = block;
                }
            }
        }
    }

    /// What the present bead is for. One outside of every block lies alone, as one on the middle of a thin part does.
    pub fn feature(&self) -> Feature {
        self.block.unwrap_or(Feature::Middle)
    }

    /// How long the way of these lines is from here, in microns.
    pub fn way(&self, lines: &[Line]) -> f64 {
        let mut nozzle = *self;
        let mut way = 0.0;
        for line in lines {
            way += nozzle.at.map_or(0.0, |from| line.length(from));
            nozzle.follow(line);
        }
        way
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

impl Line {
    /// The block of beads that is open behind this line, if it opens or closes one.
    pub(crate) fn block(&self) -> Option<Option<Feature>> {
        Some(match self {
            Self::Wall(Tag::Edge, side) => Some(Feature::Edge(*side)),
            Self::Wall(Tag::Loop, side) => Some(Feature::Loop(*side)),
            Self::Open(tag) => Some(tag.feature()?),
            Self::Close(Tag::Edge | Tag::Loop) => None,
            Self::Close(tag) => {
                tag.feature()?;
                None
            }
            _ => return None,
        })
    }
}

impl Tag {
    /// What the beads of a block of this name are for; nothing for walls, whose side is not in the name, and for what has
    /// no beads of its own.
    fn feature(self) -> Option<Feature> {
        match self {
            Self::Infill => Some(Feature::Infill),
            Self::Middle => Some(Feature::Middle),
            Self::Skirt => Some(Feature::Skirt),
            Self::Support => Some(Feature::Support),
            Self::Raft => Some(Feature::Raft),
            _ => None,
        }
    }
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
