//! The machine model: what the printer does.

use gcode::{Line, Words};

use crate::habits::Count;
use crate::motion::{Action, Class, Motion, Move};
use crate::report::{Diagonal, Horizontal, Model, Vertical};
use crate::spirals::Spirals;
use crate::verdict::Judge;

/// Follows the printer through a file.
#[derive(Clone, Debug)]
pub(crate) struct Machine {
    pub(crate) model: Model,
    pub(crate) motion: Motion,
    pub(crate) spirals: Spirals,
    pub(crate) judge: Judge,
    pub(crate) extruding_lines: usize,
    /// Layers that the nozzle left upward and came back to; for the notes.
    pub(crate) hops: Count,
    max_printed: Option<f64>,
    lifted: bool,
}

impl Machine {
    /// A machine that lays beads of this width, mm.
    pub(crate) fn new(motion: Motion, judge: Judge, bead_width: Option<f64>) -> Self {
        Self {
            model: Model::default(),
            motion,
            spirals: Spirals::new(bead_width),
            judge,
            extruding_lines: 0,
            hops: Count::default(),
            max_printed: None,
            lifted: false,
        }
    }

    /// Takes the line at `index`. Returns what kind of move it is.
    #[inline]
    pub(crate) fn feed(&mut self, index: usize, line: &Line) -> Option<Class> {
        let action = self.motion.obey(line);
        if let Action::Move(step) = action {
            self.take(index, &step, &line.words);
            return Some(step.class);
        }
        match action {
            Action::Home => self.spirals.interrupt(),
            Action::Reset { height: false } => self.spirals.reset(index),
            Action::Reset { height: true } => {
                self.spirals.rename();
                self.judge.rename();
            }
            _ => {}
        }
        self.judge.command(index, line, &self.motion);
        None
    }

    /// Does as [`feed`](Self::feed) with a straight move.
    #[inline(always)]
    pub(crate) fn feed_straight(&mut self, index: usize, words: &Words) -> Class {
        let step = self.motion.go_straight(words);
        self.take(index, &step, words);
        step.class
    }

    pub(crate) fn finish(&mut self) {
        self.spirals.finish();
        self.model.layers = std::mem::take(&mut self.spirals.layers.found);
        self.model.spirals = std::mem::take(&mut self.spirals.found);
        self.model.max_height = self.max_printed.unwrap_or(0.0);
    }

    #[inline(always)]
    fn take(&mut self, index: usize, step: &Move, words: &Words) {
        self.judge.take(index, step, &self.motion, words);
        match step.class {
            Class::Flat => {
                self.print(step);
                let goes_on = self.spirals.flat(index, step);
                if goes_on && self.lifted {
                    self.hops.add(index);
                }
                self.lifted = false;
            }
            Class::Slope => {
                self.print(step);
                if let Some(rise) = self.spirals.slope(index, step) {
                    self.judge.turn(rise);
                }
                self.lifted = false;
            }
            Class::Travel => {
                self.spirals.interrupt();
                let travel = Horizontal { index, height: step.to };
                self.model.horizontal_movement_without_extrusion.push(travel);
            }
            Class::DiagonalTravel => {
                self.spirals.interrupt();
                self.lifted = true;
                self.model.diagonal_movement_without_extrusion.push(Diagonal { index });
            }
            Class::Vertical => {
                self.spirals.interrupt();
                self.lifted = true;
                let lift = Vertical { index, from: step.from, to: step.to };
                self.model.vertical_movement_without_extrusion.push(lift);
            }
            Class::Prime => self.spirals.interrupt(),
            Class::Still => {}
        }
    }

    #[inline]
    fn print(&mut self, step: &Move) {
        self.extruding_lines += 1;
        if let Some(height) = step.to
            && self.max_printed.is_none_or(|highest| height > highest)
        {
            self.max_printed = Some(height);
        }
    }
}
