//! A layer taken apart into its islands and the lines around them.

use crate::footprint::Footprint;
use skein::{Error, Facts, Layer, Line, Nozzle, Point, Tag, boundary};
use std::ops::Range;

/// What a line of a layer belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The lines that open and close the layer and what holds islands; every piece of the layer has them.
    Frame,
    /// What stands before the first island.
    Opening,
    /// An island, with what stands between it and the one before.
    Island(usize),
    /// What stands behind the last island.
    Ending,
}

/// Lines that stay together, and the nozzle in front of them.
#[derive(Clone, Debug)]
pub struct Piece {
    pub part: Part,
    pub lines: Range<usize>,
    pub was: Nozzle,
}

/// An island of a layer.
#[derive(Debug)]
pub struct Island {
    /// Where it lies.
    pub footprint: Footprint,
    /// Where its first bead begins and its last one ends; nothing when it has none.
    pub ends: Option<(Point, Point)>,
}

/// A layer in pieces.
#[derive(Debug)]
pub struct Pieces {
    /// All of it in order.
    pub pieces: Vec<Piece>,
    /// The islands.
    pub islands: Vec<Island>,
    /// Whether there are beads that belong to no island.
    pub has_more: bool,
    /// How high the nozzle stands.
    pub z: i32,
}

impl Pieces {
    /// Takes a layer apart.
    ///
    /// # Errors
    /// When the header does not say how high a layer is.
    pub fn read(layer: &Layer, entering: &Nozzle, facts: &Facts) -> Result<Self, Error> {
        let parts = parts(&layer.lines);
        let mut read =
            Self { pieces: Vec::new(), islands: Vec::new(), has_more: false, z: layer.nozzle_z(facts)?.0 };
        let mut was = *entering;
        let mut from = 0;
        for run in parts.chunk_by(|one, other| one == other) {
            let lines = from..from + run.len();
            from = lines.end;
            let piece = Piece { part: run[0], lines: lines.clone(), was };
            let ends = follow(&mut was, &layer.lines[lines.clone()]);
            match piece.part {
                Part::Island(_) => {
                    let footprint = Footprint::new(boundary(&layer.lines[lines]));
                    read.islands.push(Island { footprint, ends });
                }
                _ => read.has_more |= ends.is_some(),
            }
            read.pieces.push(piece);
        }
        Ok(read)
    }
}

/// Follows some lines and says where the first bead begins and the last one ends.
fn follow(nozzle: &mut Nozzle, lines: &[Line]) -> Option<(Point, Point)> {
    let mut ends: Option<(Point, Point)> = None;
    for line in lines {
        let before = nozzle.at;
        nozzle.follow(line);
        if let (true, Some(from), Some(step)) = (nozzle.on, before, line.as_move()) {
            let end = Point::new(step.to.x, step.to.y);
            ends = Some((ends.map_or(Point::new(from.x, from.y), |(start, _)| start), end));
        }
    }
    ends
}

/// What each line belongs to.
fn parts(lines: &[Line]) -> Vec<Part> {
    let mut parts = Vec::with_capacity(lines.len());
    // Where the blocks begin that are open, outside the islands.
    let mut open: Vec<usize> = Vec::new();
    let mut islands = 0;
    // How many blocks are open inside an island.
    let mut depth = 0_usize;
    let mut behind = 0;
    for (index, line) in lines.iter().enumerate() {
        let opens = matches!(line, Line::Open(_) | Line::Wall(..) | Line::Rotation(..) | Line::Layer(_));
        if depth > 0 {
            parts.push(Part::Island(islands - 1));
            depth = if opens { depth + 1 } else { depth - usize::from(matches!(line, Line::Close(_))) };
            behind = index + 1;
            continue;
        }
        match line {
            Line::Open(Tag::NestedRing) => {
                // What holds an island is needed by every piece; what stands between two belongs to the second.
                open.iter().for_each(|block| parts[*block] = Part::Frame);
                for part in parts[behind..].iter_mut().filter(|part| **part == Part::Ending) {
                    *part = Part::Island(islands);
                }
                parts.push(Part::Island(islands));
                islands += 1;
                depth = 1;
            }
            Line::Thickness(_) => parts.push(Part::Frame),
            Line::Layer(_) => {
                open.push(index);
                parts.push(Part::Frame);
            }
            _ => {
                let part = if islands == 0 { Part::Opening } else { Part::Ending };
                let closed = if matches!(line, Line::Close(_)) { open.pop() } else { None };
                if opens {
                    open.push(index);
                }
                parts.push(closed.map_or(part, |begin| parts[begin]));
            }
        }
    }
    parts
}
