//! The machine model: what the printer does.

use gcode::{Line, Words};

use crate::habits::Count;
use crate::motion::{Action, Class, Motion, Move};
use crate::report::{Diagonal, Horizontal, Interruptions, Model, Vertical};
use crate::spirals::Spirals;

/// Follows the printer through a file.
#[derive(Clone, Debug)]
pub(crate) struct Machine {
    pub(crate) model: Model,
    pub(crate) motion: Motion,
    pub(crate) spirals: Spirals,
    pub(crate) interruptions: Interruptions,
    pub(crate) extruding_lines: usize,
    /// Layers that the nozzle left upward and came back to; for the notes.
    pub(crate) hops: Count,
    max_printed: Option<f64>,
    lifted: bool,
    /// The way since the last printing, if there was any way.
    gap: Option<f64>,
}

impl Machine {
    pub(crate) fn new(motion: Motion) -> Self {
        Self {
            model: Model::default(),
            motion,
            spirals: Spirals::default(),
            interruptions: Interruptions::default(),
            extruding_lines: 0,
            hops: Count::default(),
            max_printed: None,
            lifted: false,
            gap: None,
        }
    }

    /// Takes the line at `index`. Returns what kind of move it is.
    #[inline]
    pub(crate) fn feed(&mut self, index: usize, line: &Line) -> Option<Class> {
        match self.motion.obey(line) {
            Action::Nothing => None,
            Action::Move(step) => {
                self.take(index, &step);
                Some(step.class)
            }
            Action::Home => {
                self.spirals.interrupt();
                None
            }
            Action::Reset => {
                self.spirals.reset(index);
                None
            }
        }
    }

    /// Does as [`feed`](Self::feed) with a straight move.
    #[inline(always)]
    pub(crate) fn feed_straight(&mut self, index: usize, words: &Words) -> Class {
        let step = self.motion.go_straight(words);
        self.take(index, &step);
        step.class
    }

    pub(crate) fn finish(&mut self) {
        self.spirals.finish();
        self.model.layers = std::mem::take(&mut self.spirals.layers.found);
        self.model.spirals = std::mem::take(&mut self.spirals.found);
        self.model.max_height = self.max_printed.unwrap_or(0.0);
    }

    #[inline(always)]
    fn take(&mut self, index: usize, step: &Move) {
        match step.class {
            Class::Flat => {
                self.print(step);
                let goes_on = self.spirals.flat(index, step.to, || step.flat_length());
                if goes_on && self.lifted {
                    self.hops.add(index);
                }
                self.lifted = false;
            }
            Class::Slope => {
                self.print(step);
                self.spirals.slope(index, step.to, step.rise);
                self.lifted = false;
            }
            Class::Travel => {
                self.go(step);
                let travel = Horizontal { index, height: step.to };
                self.model.horizontal_movement_without_extrusion.push(travel);
            }
            Class::DiagonalTravel => {
                self.go(step);
                self.lifted = true;
                self.model.diagonal_movement_without_extrusion.push(Diagonal { index });
            }
            Class::Vertical => {
                self.go(step);
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
        if let Some(gap) = self.gap {
            self.close_gap(gap);
        }
    }

    #[cold]
    fn close_gap(&mut self, gap: f64) {
        self.gap = None;
        self.interruptions.count += 1;
        self.interruptions.length += gap;
        self.interruptions.longest = self.interruptions.longest.max(gap);
    }

    #[inline(never)]
    fn go(&mut self, step: &Move) {
        self.spirals.interrupt();
        if self.extruding_lines > 0 {
            *self.gap.get_or_insert(0.0) += step.length();
        }
    }
}
