//! What is kept of a walk: all columns, or sums alone.

use super::Machine;
use super::state::Deposit;
use crate::extruder::Extruder;
use crate::motion;
use crate::process::{Action, ProcessData, Row};
use gcode::{By, Diagnostics};

/// Takes what the machine does at each command. Rows come in the order of the program; what becomes of them in time
/// comes later, in the same order.
pub(crate) trait Record {
    /// What the planner gives back with a move.
    type Tag: Copy + Default;
    /// One command.
    fn row(&mut self, row: &Row<'_>, more: &More) -> Self::Tag;
    /// The plan of a move.
    fn moved(&mut self, tag: Self::Tag, step: &motion::Step, acceleration: f64);
    /// A time without a move, s.
    fn waited(&mut self, tag: Self::Tag, seconds: f64);
    /// The line of the program.
    fn line(&self, tag: Self::Tag) -> u32;
}

/// What only some records want to know.
pub(crate) struct More {
    pub(crate) deposit: Option<Deposit>,
    pub(crate) mm3_per_unit: f64,
    pub(crate) flow: f64,
    pub(crate) spindle: f64,
    pub(crate) from: [f64; 3],
    pub(crate) axis: [f64; 3],
}

/// Clay that a move lays: at once known, or so much a second.
#[derive(Clone, Copy, Debug, Default)]
struct Clay {
    mm3: f64,
    per_second: bool,
}

impl Clay {
    fn of(row: &Row<'_>, more: &More, extruder: Extruder) -> Self {
        let Some(deposit) = more.deposit else { return Self::default() };
        let (mm3, per_second) = match deposit.by {
            By::Amount => (deposit.amount * more.mm3_per_unit, false),
            By::Speed => (extruder.mm3_per_second(deposit.amount), true),
            By::Area => (deposit.amount * row.length, false),
        };
        Self { mm3: mm3 * more.flow, per_second }
    }

    fn after(self, seconds: f64) -> f64 {
        if self.per_second { self.mm3 * seconds } else { self.mm3 }
    }
}

/// Clay that was drawn back comes out again before new clay does.
#[derive(Clone, Copy, Debug, Default)]
struct Debt(f64);

impl Debt {
    /// How much of it is new, mm³.
    fn deposited(&mut self, mm3: f64) -> f64 {
        let new = (mm3 - self.0).max(0.0);
        self.0 = (self.0 - mm3).max(0.0);
        new
    }
}

/// Columns that only one kind of process has.
pub(crate) trait Extra: Default {
    fn reserve(&mut self, count: usize);
    fn push(&mut self, row: &Row<'_>, more: &More, machine: &Machine);
    fn add_up(&mut self, process: &ProcessData);
}

impl Extra for () {
    fn reserve(&mut self, _: usize) {}
    fn push(&mut self, _: &Row<'_>, _: &More, _: &Machine) {}
    fn add_up(&mut self, _: &ProcessData) {}
}

/// What an additive machine lays at each command.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Material {
    /// mm³; negative when it is drawn back.
    pub(crate) delta_volume: Vec<f64>,
    /// mm³ since the beginning.
    pub(crate) deposited_volume: Vec<f64>,
    /// Entries that hold a rate until their time is known.
    rates: Vec<usize>,
}

impl Extra for Material {
    fn reserve(&mut self, count: usize) {
        self.delta_volume.reserve_exact(count);
        self.deposited_volume.reserve_exact(count);
    }

    #[inline]
    fn push(&mut self, row: &Row<'_>, more: &More, machine: &Machine) {
        let clay = Clay::of(row, more, machine.extruder);
        if clay.per_second {
            self.rates.push(self.delta_volume.len());
        }
        self.delta_volume.push(clay.mm3);
    }

    fn add_up(&mut self, process: &ProcessData) {
        for index in std::mem::take(&mut self.rates) {
            self.delta_volume[index] *= process.duration(index);
        }
        let (mut debt, mut sum) = (Debt::default(), 0.0);
        self.deposited_volume.extend(self.delta_volume.iter().map(|&mm3| {
            sum += debt.deposited(mm3);
            sum
        }));
    }
}

/// What a mill does at each command.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Milling {
    /// Revolutions per second.
    pub(crate) spindle: Vec<f64>,
    /// mm³ since the beginning, if the cutter is known.
    pub(crate) removed_volume: Option<Vec<f64>>,
    cutter: f64,
}

impl Extra for Milling {
    fn reserve(&mut self, count: usize) {
        self.spindle.reserve_exact(count);
    }

    fn push(&mut self, _: &Row<'_>, more: &More, machine: &Machine) {
        self.spindle.push(more.spindle);
        if let Some(cutter) = machine.cutter {
            self.cutter = cutter;
            self.removed_volume.get_or_insert_default();
        }
    }

    /// Diameter × depth × length, the depth being that of the tip below z = 0, the top of the stock. What one move cuts
    /// a second time is counted twice.
    fn add_up(&mut self, process: &ProcessData) {
        let Some(removed) = &mut self.removed_volume else { return };
        let mut sum = 0.0;
        for index in 0..process.len() {
            if process.action[index].is_path() && self.spindle[index] > 0.0 {
                let depth = |z: f64| (-z).max(0.0);
                let mean = 0.5 * (depth(process.start(index)[2]) + depth(process.at[2][index]));
                let flat = process.flat_length(index);
                sum += self.cutter * mean * flat;
            }
            removed.push(sum);
        }
    }
}

/// All columns.
pub(crate) struct Columns<'m, X> {
    machine: &'m Machine,
    process: ProcessData,
    extra: X,
}

impl<'m, X: Extra> Columns<'m, X> {
    pub(crate) fn new(machine: &'m Machine, count: usize) -> Self {
        let mut process = ProcessData { profile: machine.motion.profile, ..ProcessData::default() };
        process.reserve(count);
        let mut extra = X::default();
        extra.reserve(count);
        Self { machine, process, extra }
    }

    pub(crate) fn finish(mut self) -> (ProcessData, X) {
        self.process.add_up();
        self.extra.add_up(&self.process);
        (self.process, self.extra)
    }
}

impl<X: Extra> Record for Columns<'_, X> {
    type Tag = usize;

    #[inline(always)]
    fn row(&mut self, row: &Row<'_>, more: &More) -> usize {
        let index = self.process.len();
        if index == 0 {
            self.process.start = more.from;
        }
        if self.process.axes.last().map_or([0.0, 0.0, 1.0], |(_, axis)| *axis) != more.axis {
            self.process.axes.push((index, more.axis));
        }
        self.process.push(row);
        self.extra.push(row, more, self.machine);
        index
    }

    #[inline]
    fn moved(&mut self, index: usize, step: &motion::Step, acceleration: f64) {
        self.process.speed_entry[index] = step.entry;
        self.process.speed_peak[index] = step.timing.peak;
        self.process.speed_exit[index] = step.exit;
        self.process.acceleration[index] = acceleration;
        // Durations, until all are there.
        self.process.elapsed_time[index] = step.timing.time;
    }

    fn waited(&mut self, index: usize, seconds: f64) {
        self.process.elapsed_time[index] = seconds;
    }

    fn line(&self, index: usize) -> u32 {
        self.process.line[index]
    }
}

/// A move is slow below this share of its speed.
const SLOW: f64 = 0.5;

/// Sums of an emulation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Totals {
    /// How many commands there were.
    pub commands: u64,
    /// All of the time, s.
    pub total_time: f64,
    /// The time in which something moves, s.
    pub moving_time: f64,
    /// The time of dwells and purges, s.
    pub dwell_time: f64,
    /// The way of the nozzle, mm.
    pub path_length: f64,
    /// The way while clay comes out, mm.
    pub deposition_length: f64,
    /// The way without clay, mm.
    pub travel_length: f64,
    /// The way that clay comes out on at less than half the speed that was asked for, mm.
    pub slow_length: f64,
    /// The line with the first of it.
    pub first_slow: Option<u32>,
    /// What was deposited, mm³.
    pub volume: f64,
    /// What is wrong with the program.
    pub diagnostics: Diagnostics,
}

/// Adds up.
pub(crate) struct Sum {
    extruder: Extruder,
    totals: Totals,
    debt: Debt,
}

/// What [`Sum`] must know of a move when its time comes.
#[derive(Clone, Copy, Default)]
pub(crate) struct Waiting {
    line: u32,
    clay: Clay,
    /// The way of a deposit, mm, and how long it may take before it is slow, s.
    length: f64,
    patience: f64,
}

impl Sum {
    pub(crate) fn new(machine: &Machine) -> Self {
        Self { extruder: machine.extruder, totals: Totals::default(), debt: Debt::default() }
    }

    pub(crate) fn finish(self, diagnostics: Diagnostics) -> Totals {
        let Totals { moving_time, dwell_time, deposition_length, travel_length, .. } = self.totals;
        Totals {
            total_time: moving_time + dwell_time,
            path_length: deposition_length + travel_length,
            diagnostics,
            ..self.totals
        }
    }
}

impl Record for Sum {
    type Tag = Waiting;

    #[inline]
    fn row(&mut self, row: &Row<'_>, more: &More) -> Waiting {
        self.totals.commands += 1;
        let (mut length, mut patience) = (0.0, f64::INFINITY);
        match row.action {
            Action::Deposit => {
                self.totals.deposition_length += row.length;
                (length, patience) = (row.length, row.length / (row.feed_rate * SLOW));
            }
            Action::Travel => self.totals.travel_length += row.length,
            _ => {}
        }
        Waiting { line: row.line, clay: Clay::of(row, more, self.extruder), length, patience }
    }

    #[inline]
    fn moved(&mut self, tag: Waiting, step: &motion::Step, _: f64) {
        self.totals.moving_time += step.timing.time;
        if step.timing.time > tag.patience {
            self.totals.slow_length += tag.length;
            self.totals.first_slow.get_or_insert(tag.line);
        }
        self.totals.volume += self.debt.deposited(tag.clay.after(step.timing.time));
    }

    fn waited(&mut self, tag: Waiting, seconds: f64) {
        self.totals.dwell_time += seconds;
        self.totals.volume += self.debt.deposited(tag.clay.after(seconds));
    }

    fn line(&self, tag: Waiting) -> u32 {
        tag.line
    }
}
