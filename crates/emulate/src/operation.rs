//! Commands and what became of them, one to one.

use crate::arc::Arc;
use crate::extruder::Extruder;
use crate::machine::record::{Material, Milling};
use crate::motion::ProfileType;
use crate::process::{Moment, ProcessData};
use crate::statistics::{Bounds, Statistics};
use gcode::{Diagnostics, Step};
use std::ops::Deref;

/// A program and, once a machine has processed it, what the machine did at each of its commands: `commands()[i]` and
/// entry i of `process_data()` are the same step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Operation<'a> {
    commands: Vec<Step<'a>>,
    process: ProcessData,
    diagnostics: Diagnostics,
}

impl<'a> Operation<'a> {
    /// A program that no machine has processed yet.
    pub fn unprocessed(commands: Vec<Step<'a>>) -> Self {
        Self { commands, ..Self::default() }
    }

    pub(crate) fn new(commands: Vec<Step<'a>>, process: ProcessData, diagnostics: Diagnostics) -> Self {
        debug_assert_eq!(commands.len(), process.len());
        Self { commands, process, diagnostics }
    }

    /// The commands with their lines.
    pub fn commands(&self) -> &[Step<'a>] {
        &self.commands
    }

    /// What the machine did; empty before a machine has processed the operation.
    pub fn process_data(&self) -> &ProcessData {
        &self.process
    }

    /// What the machine found wrong with the program.
    pub fn diagnostics(&self) -> &Diagnostics {
        &self.diagnostics
    }

    /// Whether a machine has processed it.
    pub fn is_processed(&self) -> bool {
        self.commands.len() == self.process.len()
    }

    /// The time of the whole, s.
    pub fn total_time(&self) -> f64 {
        self.process.elapsed_time.last().copied().unwrap_or(0.0)
    }

    /// The room that the nozzle takes, arcs in full; nothing before a machine has processed the operation, or if
    /// nothing moves.
    pub fn bounds(&self) -> Option<Bounds> {
        Bounds::of(&self.process, |action| action.is_path())
    }

    /// The room that the deposits take.
    pub fn deposition_bounds(&self) -> Option<Bounds> {
        Bounds::of(&self.process, |action| action == crate::Action::Deposit)
    }

    /// Lengths, times, speeds and counts; nothing before a machine has processed the operation.
    pub fn statistics(&self) -> Option<Statistics> {
        self.is_processed().then(|| Statistics::of(self))
    }

    /// Place and speed at a time, s; found by halving, not by searching.
    pub fn at_time(&self, time: f64) -> Option<Moment> {
        self.process.at_time(time)
    }

    /// The law of speed within the moves.
    pub fn profile(&self) -> ProfileType {
        self.process.profile
    }

    /// The arc of a step that is one.
    pub fn arc(&self, index: usize) -> Option<&Arc> {
        self.process.arc(index)
    }
}

/// An operation that deposits material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AdditiveOperation<'a> {
    operation: Operation<'a>,
    material: Material,
    extruder: Extruder,
}

impl<'a> AdditiveOperation<'a> {
    pub(crate) fn new(operation: Operation<'a>, material: Material, extruder: Extruder) -> Self {
        Self { operation, material, extruder }
    }

    /// What each step deposits, mm³; negative when material is drawn back.
    pub fn delta_volume(&self) -> &[f64] {
        &self.material.delta_volume
    }

    /// What is deposited since the beginning, mm³. Material that was drawn back and comes out again counts once.
    pub fn deposited_volume(&self) -> &[f64] {
        &self.material.deposited_volume
    }

    /// The section of the bead that a step lays, mm²; 0 where nothing moves or nothing comes out.
    pub fn bead_area(&self, index: usize) -> f64 {
        let process = self.process_data();
        if process.action[index] == crate::Action::Deposit {
            self.material.delta_volume[index] / process.step_distance[index]
        } else {
            0.0
        }
    }

    /// How the machine counts what it extrudes.
    pub fn extruder(&self) -> Extruder {
        self.extruder
    }

    /// The whole deposit, mm³.
    pub fn volume(&self) -> f64 {
        self.material.deposited_volume.last().copied().unwrap_or(0.0)
    }
}

impl<'a> Deref for AdditiveOperation<'a> {
    type Target = Operation<'a>;
    fn deref(&self) -> &Operation<'a> {
        &self.operation
    }
}

/// An operation that cuts material away.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SubtractiveOperation<'a> {
    operation: Operation<'a>,
    milling: Milling,
}

impl<'a> SubtractiveOperation<'a> {
    pub(crate) fn new(operation: Operation<'a>, milling: Milling) -> Self {
        Self { operation, milling }
    }

    /// The speed of the spindle at each step, revolutions per minute.
    pub fn spindle_rpm(&self) -> impl Iterator<Item = f64> {
        self.milling.spindle.iter().map(|revolutions| revolutions * 60.0)
    }

    /// What is cut away since the beginning, mm³: diameter of the cutter × depth below z = 0 × way. Nothing if the
    /// machine does not know its cutter.
    pub fn removed_volume(&self) -> Option<&[f64]> {
        self.milling.removed_volume.as_deref()
    }
}

impl<'a> Deref for SubtractiveOperation<'a> {
    type Target = Operation<'a>;
    fn deref(&self) -> &Operation<'a> {
        &self.operation
    }
}
