//! Bounds and sums of an operation.

use crate::operation::Operation;
use crate::process::{Action, ProcessData};
use gcode::CommandKind;

/// A box with sides along the axes, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least X, Y and Z.
    pub min: [f64; 3],
    /// The greatest.
    pub max: [f64; 3],
}

impl Bounds {
    /// The box of one point.
    pub const fn point(at: [f64; 3]) -> Self {
        Self { min: at, max: at }
    }

    /// Grows until it holds the point.
    #[inline]
    pub fn include(&mut self, at: [f64; 3]) {
        for (axis, value) in at.into_iter().enumerate() {
            self.min[axis] = self.min[axis].min(value);
            self.max[axis] = self.max[axis].max(value);
        }
    }

    /// Grows until it holds the other.
    pub fn merge(&mut self, other: &Self) {
        self.include(other.min);
        self.include(other.max);
    }

    /// Whether the two have a point in common.
    pub fn touches(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.min[axis] <= other.max[axis] && other.min[axis] <= self.max[axis])
    }

    /// The steps of these kinds, with all of their arcs. Nothing if there are none.
    pub(crate) fn of(process: &ProcessData, wanted: impl Fn(Action) -> bool) -> Option<Self> {
        let mut all: Option<Self> = None;
        for index in 0..process.len() {
            if wanted(process.action[index]) {
                let step = Self::of_step(process, index);
                match &mut all {
                    Some(all) => all.merge(&step),
                    None => all = Some(step),
                }
            }
        }
        all
    }

    /// One step, with all of its arc.
    pub(crate) fn of_step(process: &ProcessData, index: usize) -> Self {
        let mut bounds = Self::point(process.start(index));
        bounds.include(process.end(index));
        for point in process.arc(index).into_iter().flat_map(|arc| arc.extremes()) {
            bounds.include(point);
        }
        bounds
    }
}

/// What an operation comes to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistics {
    /// How many commands there are of each kind, in the order of [`CommandKind::ALL`].
    pub kinds: [usize; 19],
    /// All of the time, s.
    pub total_time: f64,
    /// The time in which something moves, s.
    pub moving_time: f64,
    /// The time of dwells and purges, s.
    pub dwell_time: f64,
    /// What the moves take longer than at the speeds that were asked for, s.
    pub time_lost: f64,
    /// The way of the nozzle, mm.
    pub path_length: f64,
    /// The way while clay comes out, mm.
    pub deposition_length: f64,
    /// The way without clay, mm.
    pub travel_length: f64,
    /// The speed asked for, each millimetre counting the same, mm/s.
    pub mean_feed: f64,
    /// The speed reached, each second of moving counting the same, mm/s.
    pub mean_speed: f64,
    /// The highest speed reached, mm/s.
    pub max_speed: f64,
    /// Moves of the extruder alone: primes and retractions.
    pub extruder_moves: usize,
}

impl Statistics {
    pub(crate) fn of(operation: &Operation<'_>) -> Self {
        let process = operation.process_data();
        let mut all = Self { total_time: operation.total_time(), ..Self::default() };
        for step in operation.commands() {
            all.kinds[step.command.kind() as usize] += 1;
        }
        let (mut weighted, mut path_time) = (0.0, 0.0);
        for index in 0..process.len() {
            let (duration, way) = (process.duration(index), process.step_distance[index]);
            match process.action[index] {
                Action::Dwell | Action::Purge => all.dwell_time += duration,
                Action::Extrude => {
                    all.extruder_moves += 1;
                    all.time_lost += duration - way / process.feed_rate[index];
                }
                Action::Travel => all.travel_length += way,
                Action::Deposit => all.deposition_length += way,
                Action::Nothing | Action::Home => {}
            }
            if process.action[index].is_path() {
                weighted += way * process.feed_rate[index];
                path_time += duration;
                all.time_lost += duration - way / process.feed_rate[index];
                all.max_speed = all.max_speed.max(process.speed_peak[index]);
            }
        }
        all.path_length = all.travel_length + all.deposition_length;
        all.moving_time = all.total_time - all.dwell_time;
        let mean = |sum: f64, of: f64| if of > 0.0 { sum / of } else { 0.0 };
        all.mean_feed = mean(weighted, all.path_length);
        all.mean_speed = mean(all.path_length, path_time);
        all
    }

    /// How many commands of a kind there are.
    pub fn count(&self, kind: CommandKind) -> usize {
        self.kinds[kind as usize]
    }
}
