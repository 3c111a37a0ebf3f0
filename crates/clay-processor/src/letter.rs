//! The letter model: what the words say.

use gcode::{Code, Kind, Line};

use crate::habits::Count;
use crate::report::{Diagonal, Horizontal, Model, Run, Vertical};

/// Reads a file by the letter.
#[derive(Clone, Debug, Default)]
pub(crate) struct Letter {
    pub(crate) model: Model,
    /// Layers by how they sit on what is printed; for the notes.
    pub(crate) led: Count,
    pub(crate) trailed: Count,
    pub(crate) idle: Count,
    block: Option<Block>,
    spiral: Option<Climb>,
    last_z: Option<f64>,
    max_z: Option<f64>,
}

/// What the words of a `G0` or `G1` without E say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Movement {
    Horizontal,
    Vertical,
    Diagonal,
}

/// The `G1` lines without Z that follow one with Z.
#[derive(Clone, Copy, Debug)]
struct Block {
    height: f64,
    first: usize,
    last: usize,
    lines: usize,
    first_prints: bool,
    last_prints: bool,
    prints: bool,
}

/// Spiral lines in a row.
#[derive(Clone, Copy, Debug)]
struct Climb {
    height: f64,
    first: usize,
    last: usize,
    lines: usize,
}

impl Letter {
    /// Takes the line at `index`. Whether it `prints` is the machine's knowledge and only for the notes.
    #[inline]
    pub(crate) fn feed(&mut self, index: usize, line: &Line, prints: bool) -> Option<Movement> {
        if line.kind != Kind::Code {
            return None;
        }
        match line.command {
            Some(Code { letter: b'M', .. }) => None,
            Some(G0) => {
                self.end_spiral();
                self.movement(index, line)
            }
            Some(G1) => {
                self.linear(index, line, prints);
                self.movement(index, line)
            }
            Some(G2 | G3) => {
                self.end_spiral();
                self.raise(line.words.get(b'Z'));
                None
            }
            _ => {
                self.end_spiral();
                None
            }
        }
    }

    /// Does as [`feed`](Self::feed) with a `G1` that has E and no Z, or knows its movement.
    #[inline(always)]
    pub(crate) fn feed_stroke(&mut self, index: usize, prints: bool) {
        if self.spiral.is_some() {
            self.end_spiral();
        }
        if let Some(block) = &mut self.block {
            if block.lines == 0 {
                block.first = index;
                block.first_prints = prints;
            }
            block.last = index;
            block.last_prints = prints;
            block.prints |= prints;
            block.lines += 1;
        }
    }

    pub(crate) fn finish(&mut self) {
        self.end_block();
        self.end_spiral();
        self.model.max_height = self.max_z.unwrap_or(0.0);
    }

    /// Layers and spirals, which are made of `G1` alone.
    #[inline]
    fn linear(&mut self, index: usize, line: &Line, prints: bool) {
        let Some(height) = line.words.get(b'Z') else {
            return self.feed_stroke(index, prints);
        };
        self.end_block();
        self.block = Some(Block {
            height,
            first: index,
            last: index,
            lines: 0,
            first_prints: false,
            last_prints: false,
            prints: false,
        });
        if line.words.has(b'E') && line.words.has_any(b"XY") {
            let climb = self.spiral.get_or_insert(Climb { height, first: index, last: index, lines: 0 });
            climb.last = index;
            climb.lines += 1;
        } else {
            self.end_spiral();
        }
    }

    #[inline]
    fn movement(&mut self, index: usize, line: &Line) -> Option<Movement> {
        let words = &line.words;
        let z = words.get(b'Z');
        let from = self.last_z;
        if z.is_some() {
            self.raise(z);
            self.last_z = z;
        }
        if words.has(b'E') {
            return None;
        }
        match (words.has_any(b"XY"), z) {
            (true, None) => {
                self.model.horizontal_movement_without_extrusion.push(Horizontal { index, height: from });
                Some(Movement::Horizontal)
            }
            (false, Some(_)) => {
                self.model.vertical_movement_without_extrusion.push(Vertical { index, from, to: z });
                Some(Movement::Vertical)
            }
            (true, Some(_)) => {
                self.model.diagonal_movement_without_extrusion.push(Diagonal { index });
                Some(Movement::Diagonal)
            }
            (false, None) => None,
        }
    }

    fn raise(&mut self, z: Option<f64>) {
        if let Some(z) = z {
            self.max_z = Some(self.max_z.map_or(z, |highest| highest.max(z)));
        }
    }

    fn end_block(&mut self) {
        let Some(block) = self.block.take().filter(|block| block.lines >= 2) else { return };
        if !block.prints {
            self.idle.add(block.first);
        } else if !block.first_prints {
            self.led.add(block.first);
        } else if !block.last_prints {
            self.trailed.add(block.last);
        }
        let layer = Run { start_index: block.first, end_index: block.last, height: Some(block.height) };
        self.model.layers.push(layer);
    }

    #[inline(never)]
    fn end_spiral(&mut self) {
        if let Some(climb) = self.spiral.take().filter(|climb| climb.lines >= 2) {
            let spiral = Run { start_index: climb.first, end_index: climb.last, height: Some(climb.height) };
            self.model.spirals.push(spiral);
        }
    }
}

const G0: Code = Code::g(0);
const G1: Code = Code::g(1);
const G2: Code = Code::g(2);
const G3: Code = Code::g(3);
