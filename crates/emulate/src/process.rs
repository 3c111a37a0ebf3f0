//! What the machine did at each command, in columns.

use crate::arc::Arc;
use crate::motion::{MotionState, Phases, ProfileType, Task};

/// What a command made the machine do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum Action {
    /// Nothing that takes time.
    #[default]
    Nothing,
    /// Moves without clay.
    Travel,
    /// Moves while clay comes out.
    Deposit,
    /// Moves the extruder alone: primes or retracts.
    Extrude,
    /// Waits.
    Dwell,
    /// Waits while clay comes out.
    Purge,
    /// Seeks its end stops; nobody knows how long.
    Home,
}

impl Action {
    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::Travel => "travel",
            Self::Deposit => "deposit",
            Self::Extrude => "extrude",
            Self::Dwell => "dwell",
            Self::Purge => "purge",
            Self::Home => "home",
        }
    }

    /// Whether the nozzle moves.
    pub const fn is_path(self) -> bool {
        matches!(self, Self::Travel | Self::Deposit)
    }
}

/// No arc.
const STRAIGHT: u32 = u32::MAX;

/// What the machine did at each command: one entry a command in every column, 99 bytes in all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProcessData {
    pub(crate) at: [Vec<f64>; 3],
    pub(crate) feed_rate: Vec<f64>,
    pub(crate) speed_entry: Vec<f64>,
    pub(crate) speed_peak: Vec<f64>,
    pub(crate) speed_exit: Vec<f64>,
    pub(crate) acceleration: Vec<f64>,
    pub(crate) elapsed_time: Vec<f64>,
    pub(crate) distance: Vec<f64>,
    pub(crate) step_distance: Vec<f64>,
    pub(crate) line: Vec<u32>,
    pub(crate) arc: Vec<u32>,
    pub(crate) tool: Vec<u16>,
    pub(crate) action: Vec<Action>,
    pub(crate) arcs: Vec<Arc>,
    /// From which entry on the tool points where; it seldom turns.
    pub(crate) axes: Vec<(usize, [f64; 3])>,
    pub(crate) start: [f64; 3],
    pub(crate) profile: ProfileType,
}

/// One entry of [`ProcessData`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProcessRow {
    /// The line of the file, counted from one.
    pub line: u32,
    /// What was done.
    pub action: Action,
    /// Where the nozzle is then, in the coordinates of the machine, mm.
    pub at: [f64; 3],
    /// Where the tool points away from, a unit vector.
    pub tool_axis: [f64; 3],
    /// The speed that was asked for, mm/s.
    pub feed_rate: f64,
    /// The speed at its start, mm/s.
    pub speed_entry: f64,
    /// Its highest speed, mm/s.
    pub speed_peak: f64,
    /// The speed at its end, mm/s.
    pub speed_exit: f64,
    /// When it began, s.
    pub start_time: f64,
    /// When it ended, s.
    pub elapsed_time: f64,
    /// How long it took, s.
    pub duration: f64,
    /// The way of the nozzle since the beginning, mm.
    pub distance: f64,
    /// The way of the nozzle in this step, mm; of the extruder when only that moved.
    pub step_distance: f64,
    /// The toolhead.
    pub tool: u16,
}

impl ProcessData {
    /// How many entries there are.
    #[inline]
    pub fn len(&self) -> usize {
        self.line.len()
    }

    /// Whether there are none: nothing was emulated yet, or the program is empty.
    pub fn is_empty(&self) -> bool {
        self.line.is_empty()
    }

    /// An entry, if there is one.
    pub fn get(&self, index: usize) -> Option<ProcessRow> {
        if index >= self.len() {
            return None;
        }
        Some(ProcessRow {
            line: self.line[index],
            action: self.action[index],
            at: self.end(index),
            tool_axis: self.tool_axis(index),
            feed_rate: self.feed_rate[index],
            speed_entry: self.speed_entry[index],
            speed_peak: self.speed_peak[index],
            speed_exit: self.speed_exit[index],
            start_time: self.start_time(index),
            elapsed_time: self.elapsed_time[index],
            duration: self.duration(index),
            distance: self.distance[index],
            step_distance: self.step_distance[index],
            tool: self.tool[index],
        })
    }

    /// All entries in order.
    pub fn iter(&self) -> impl Iterator<Item = ProcessRow> {
        (0..self.len()).filter_map(|index| self.get(index))
    }

    /// The coordinates of the ends along X (0), Y (1) or Z (2), mm.
    pub fn coordinate(&self, axis: usize) -> &[f64] {
        &self.at[axis]
    }

    /// The lines of the file.
    pub fn line(&self) -> &[u32] {
        &self.line
    }

    /// What was done.
    pub fn action(&self) -> &[Action] {
        &self.action
    }

    /// The toolheads.
    pub fn tool(&self) -> &[u16] {
        &self.tool
    }

    /// The speeds that were asked for, mm/s.
    pub fn feed_rate(&self) -> &[f64] {
        &self.feed_rate
    }

    /// The speeds at the starts, mm/s.
    pub fn speed_entry(&self) -> &[f64] {
        &self.speed_entry
    }

    /// The highest speeds, mm/s.
    pub fn speed_peak(&self) -> &[f64] {
        &self.speed_peak
    }

    /// The speeds at the ends, mm/s.
    pub fn speed_exit(&self) -> &[f64] {
        &self.speed_exit
    }

    /// When each ended, s.
    pub fn elapsed_time(&self) -> &[f64] {
        &self.elapsed_time
    }

    /// The ways since the beginning, mm.
    pub fn distance(&self) -> &[f64] {
        &self.distance
    }

    /// The ways of the steps, mm.
    pub fn step_distance(&self) -> &[f64] {
        &self.step_distance
    }

    /// When an entry began, s.
    #[inline]
    pub fn start_time(&self, index: usize) -> f64 {
        if index == 0 { 0.0 } else { self.elapsed_time[index - 1] }
    }

    /// How long an entry took, s.
    #[inline]
    pub fn duration(&self, index: usize) -> f64 {
        self.elapsed_time[index] - self.start_time(index)
    }

    /// Where an entry began, mm.
    #[inline]
    pub fn start(&self, index: usize) -> [f64; 3] {
        if index == 0 { self.start } else { self.end(index - 1) }
    }

    /// Where an entry ended, mm.
    #[inline]
    pub fn end(&self, index: usize) -> [f64; 3] {
        [self.at[0][index], self.at[1][index], self.at[2][index]]
    }

    /// The arc of an entry that is one.
    pub fn arc(&self, index: usize) -> Option<&Arc> {
        self.arcs.get(self.arc[index] as usize)
    }

    /// Where the tool points away from, a unit vector.
    pub fn tool_axis(&self, index: usize) -> [f64; 3] {
        let turned = self.axes.partition_point(|(from, _)| *from <= index);
        if turned == 0 { [0.0, 0.0, 1.0] } else { self.axes[turned - 1].1 }
    }

    /// The way of an entry across, mm: without its rise.
    pub(crate) fn flat_length(&self, index: usize) -> f64 {
        let rise = self.at[2][index] - self.start(index)[2];
        let length = self.step_distance[index];
        (length * length - rise * rise).max(0.0).sqrt()
    }

    /// How an entry goes, in phases.
    pub fn phases(&self, index: usize) -> Phases {
        let task = Task {
            length: self.step_distance[index],
            entry: self.speed_entry[index],
            exit: self.speed_exit[index],
            target: self.speed_peak[index],
            acceleration: self.acceleration[index],
        };
        self.profile.phases(&task, task.target)
    }

    /// The point of an entry after so many of its millimetres.
    pub fn point(&self, index: usize, way: f64) -> [f64; 3] {
        let length = self.step_distance[index];
        let part = if length > 0.0 { (way / length).clamp(0.0, 1.0) } else { 1.0 };
        let (from, to) = (self.start(index), self.end(index));
        match self.arc(index) {
            Some(arc) if part > 0.0 && part < 1.0 => arc.point(part),
            _ if part >= 1.0 => to,
            _ => [0, 1, 2].map(|axis| from[axis] + (to[axis] - from[axis]) * part),
        }
    }

    /// Place and speed at a time, s; before the beginning those of the beginning, after the end those of the end.
    /// Nothing if nothing was emulated.
    pub fn at_time(&self, time: f64) -> Option<Moment> {
        let time = if time.is_nan() { 0.0 } else { time.max(0.0) };
        let index = self.elapsed_time.partition_point(|&end| end <= time).min(self.len().checked_sub(1)?);
        let since = time - self.start_time(index);
        if !self.action[index].is_path() || since >= self.duration(index) {
            let state = MotionState::default();
            return Some(Moment { index, at: self.end(index), state, distance: self.distance[index] });
        }
        let state = self.phases(index).at(since);
        let before = self.distance[index] - self.step_distance[index];
        let way = state.distance.min(self.step_distance[index]);
        Some(Moment { index, at: self.point(index, way), state, distance: before + way })
    }

    /// Makes room for so many entries. What the planner says of them is nothing until it says it.
    pub(crate) fn reserve(&mut self, count: usize) {
        for planned in [
            &mut self.speed_entry,
            &mut self.speed_peak,
            &mut self.speed_exit,
            &mut self.acceleration,
            &mut self.elapsed_time,
            &mut self.distance,
        ] {
            // Memory that comes zeroed costs nothing until it is touched.
            *planned = vec![0.0; count];
        }
        self.at.iter_mut().for_each(|column| column.reserve_exact(count));
        self.feed_rate.reserve_exact(count);
        self.step_distance.reserve_exact(count);
        self.line.reserve_exact(count);
        self.arc.reserve_exact(count);
        self.tool.reserve_exact(count);
        self.action.reserve_exact(count);
    }

    /// Adds an entry that takes no time yet; there is [room](Self::reserve) for it.
    #[inline(always)]
    pub(crate) fn push(&mut self, row: &Row<'_>) {
        for (column, value) in self.at.iter_mut().zip(row.at) {
            column.push(value);
        }
        self.feed_rate.push(row.feed_rate);
        self.step_distance.push(row.length);
        self.line.push(row.line);
        self.tool.push(row.tool);
        self.action.push(row.action);
        self.arc.push(match row.arc {
            Some(arc) => {
                self.arcs.push(*arc);
                u32::try_from(self.arcs.len() - 1).unwrap_or(STRAIGHT)
            }
            None => STRAIGHT,
        });
    }

    /// Turns the durations that stand in the column of times, and the ways of the steps, into sums.
    pub(crate) fn add_up(&mut self) {
        debug_assert_eq!(self.elapsed_time.len(), self.len());
        let mut time = 0.0;
        for elapsed in &mut self.elapsed_time {
            time += *elapsed;
            *elapsed = time;
        }
        let mut way = 0.0;
        let steps = self.action.iter().zip(&self.step_distance);
        for (distance, (action, step)) in self.distance.iter_mut().zip(steps) {
            if action.is_path() {
                way += step;
            }
            *distance = way;
        }
    }
}

/// An entry as the machine walks over it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Row<'a> {
    pub(crate) line: u32,
    pub(crate) action: Action,
    pub(crate) at: [f64; 3],
    pub(crate) feed_rate: f64,
    pub(crate) length: f64,
    pub(crate) tool: u16,
    pub(crate) arc: Option<&'a Arc>,
}

/// Where the machine is at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// The entry that is being done.
    pub index: usize,
    /// Where the nozzle is, mm.
    pub at: [f64; 3],
    /// How far and how fast it is within its move.
    pub state: MotionState,
    /// The way since the beginning, mm.
    pub distance: f64,
}
