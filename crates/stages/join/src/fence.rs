//! The outlines that no way may cross.

use crate::grid::{Grid, Side, cross};
use skein::{Point, Ring};
use std::cell::{Cell, OnceCell};

/// Most islands are asked for a few ways only; sorting the sides costs as much as so many looks at all of them.
const LOOKS: u32 = 6;

/// The outlines of an island.
pub struct Fence<'a> {
    outlines: &'a [Ring],
    cell: f64,
    looks: Cell<u32>,
    grid: OnceCell<Grid>,
}

impl<'a> Fence<'a> {
    /// A fence; `cell` is about how long the ways are, in microns.
    pub fn new(outlines: &'a [Ring], cell: f64) -> Self {
        Self { outlines, cell, looks: Cell::new(0), grid: OnceCell::new() }
    }

    /// Whether a straight way crosses an outline.
    pub fn is_crossed(&self, from: Point, to: Point) -> bool {
        let mut sides = self.outlines.iter().flat_map(Ring::segments);
        if self.looks.get() < LOOKS {
            self.looks.set(self.looks.get() + 1);
            return sides.any(|(one, other)| cross(from, to, one, other));
        }
        let sorted = || Grid::new(sides.map(|(from, to)| Side { owner: 0, start: 0.0, from, to }), self.cell);
        self.grid.get_or_init(sorted).is_crossed(from, to)
    }
}
