//! Views of a layer's lines: which belong together.

use crate::{Line, Mark, Tag};
use shape::{Point, Ring};

/// Lines that belong together. End to end the spans of a layer are all its lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Span<'a> {
    /// From where clay begins to flow to where it stops, with the blocks of beads that begin and end meanwhile. Where any
    /// other line stands in between, or clay flows into the layer or out of it, it is a part of a thread.
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

/// Cuts lines into threads, travels and the rest; `flowing` is whether clay flows in front of them.
pub fn spans(lines: &[Line], flowing: bool) -> impl Iterator<Item = Span<'_>> {
    let (mut rest, mut flowing) = (lines, flowing);
    std::iter::from_fn(move || {
        let (first, after) = rest.split_first()?;
        flowing |= matches!(first, Line::On);
        let thread = if flowing { thread(rest) } else { 0 };
        let moves = || rest.iter().position(|line| line.as_move().is_none()).unwrap_or(rest.len());
        let length = if thread > 0 { thread } else { moves() };
        if length == 0 {
            rest = after;
            return Some(Span::Other(first));
        }
        let span;
        (span, rest) = rest.split_at(length);
        flowing &= !matches!(span.last(), Some(Line::Off));
        Some(if thread > 0 { Span::Thread(span) } else { Span::Travel(span) })
    })
}

/// How many of these lines are one thread, when clay flows from the first on; none when they lay nothing.
fn thread(lines: &[Line]) -> usize {
    let mut lays = false;
    for (index, line) in lines.iter().enumerate() {
        match line {
            Line::Off => return index + 1,
            Line::On => lays = true,
            Line::Flow(_) => {}
            line if line.as_move().is_some() => lays = true,
            line if line.block().is_some() => {}
            _ => return if lays { index } else { 0 },
        }
    }
    if lays { lines.len() } else { 0 }
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
