//! From programmed moves to speeds and times, in two passes, as firmware of the GRBL kind does it.
//!
//! 1. Every corner has a highest speed ([`JunctionModel`]).
//! 2. Forward, from rest: v² at the end of a move is at most v² at its start plus 2·a·d.
//! 3. Backward, from the stop at the end: the same the other way round.
//!
//! Then every move has an entry and an exit speed that the machine can reach, and its own [`ProfileType`] says how it
//! goes between. Everything is linear in the number of moves and looks at the whole way ahead; firmware sees only a
//! few moves and can be slower.
//!
//! ```
//! use emulate::motion::{MotionProfile, Move, Moves, ProfileType};
//!
//! let mut planner = MotionProfile {
//!     max_acceleration: Some(500.0), // mm/s²; without it there are no corners
//!     max_velocity: Some(100.0),     // mm/s, for all moves
//!     junction_deviation: 0.05,      // mm; less is slower round corners
//!     ..MotionProfile::default()
//! };
//! let square = [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0], [0.0, 0.0]];
//! let moves: Moves = square
//!     .windows(2)
//!     .map(|ends| planner.limit(Move::line([ends[0][0], ends[0][1], 0.0], [ends[1][0], ends[1][1], 0.0], 50.0)))
//!     .collect();
//! let plan = planner.plan(&moves)?;
//! assert!((plan.exit[0] - 7.768870).abs() < 1e-6);
//!
//! planner.profile = ProfileType::SCurve { jerk: 5000.0 };
//! assert!(planner.plan(&moves)?.total_time() > plan.total_time());
//! # Ok::<(), emulate::motion::MotionError>(())
//! ```

mod constraints;
mod junction;
mod moves;
mod passes;
mod phases;
mod planner;
mod profile;
mod scurve;
mod smooth;
mod stretch;
#[cfg(test)]
mod tests;

pub use constraints::{BaamConstraints, MachineConstraints};
pub use junction::JunctionModel;
pub use moves::{Move, Moves, SHORTEST};
pub use phases::{MotionState, Phase, Phases};
pub(crate) use planner::Planner;
pub use profile::{ProfileType, Ramps, Task, Timing};
pub use smooth::Smoothing;

use std::fmt;
use std::sync::Arc;
use stretch::Stretch;

/// The planner of a machine and its limits.
#[derive(Clone)]
pub struct MotionProfile {
    /// What the machine may accelerate with, mm/s². Without it speed changes at once and corners cost nothing.
    pub max_acceleration: Option<f64>,
    /// The highest speed of all moves, mm/s.
    pub max_velocity: Option<f64>,
    /// How far a corner may be cut, mm. Less is slower.
    pub junction_deviation: f64,
    /// The law of speed within a move.
    pub profile: ProfileType,
    /// How much of short moves is cruised through.
    pub smoothing: Smoothing,
    /// The rule for the speed at corners.
    pub junction: JunctionModel,
    /// Rules of the machine.
    pub constraints: Option<Arc<dyn MachineConstraints>>,
}

impl Default for MotionProfile {
    /// Speed that changes at once. Where a file brings an acceleration, corners may be cut by 0.05 mm.
    fn default() -> Self {
        Self {
            max_acceleration: None,
            max_velocity: None,
            junction_deviation: 0.05,
            profile: ProfileType::default(),
            smoothing: Smoothing::default(),
            junction: JunctionModel::default(),
            constraints: None,
        }
    }
}

impl MotionProfile {
    /// The planner of the Cincinnati BAAM.
    pub fn baam(max_acceleration: Option<f64>, junction_deviation: f64, rules: BaamConstraints) -> Self {
        Self { max_acceleration, junction_deviation, constraints: Some(Arc::new(rules)), ..Self::default() }
    }

    /// A move with the limits of this planner.
    pub fn limit(&self, step: Move) -> Move {
        let target = step.target.min(self.max_velocity.unwrap_or(f64::INFINITY));
        let acceleration = self.max_acceleration.unwrap_or(f64::INFINITY);
        let limited = step.limited(acceleration, self.junction_deviation);
        let smooth_acceleration =
            if step.is_path() { self.smoothing.acceleration(acceleration) } else { acceleration };
        Move { target, smooth_acceleration, ..limited }
    }

    /// Plans moves that begin and end at rest.
    ///
    /// # Errors
    /// When a move has a length, speed or limit that is no positive number, or when a rule of the machine makes one.
    pub fn plan(&self, moves: &Moves) -> Result<Plan, MotionError> {
        self.check()?;
        let mut plan = Plan::default();
        let mut stretch = Stretch::default();
        for index in 0..moves.len() {
            stretch.push(self, &moves.get(index))?;
        }
        stretch.end(self)?;
        stretch.hand_out(self, moves.len(), |_, step, _| plan.push(step));
        Ok(plan)
    }

    /// Whether the numbers of the planner make sense.
    ///
    /// # Errors
    /// When one does not.
    pub fn check(&self) -> Result<(), MotionError> {
        let positive = [("acceleration", self.max_acceleration), ("highest speed", self.max_velocity)];
        for (name, value) in positive {
            if value.is_some_and(|value| !(value > 0.0 && value.is_finite())) {
                let value = value.unwrap_or_default();
                return Err(MotionError::limit(format!("the {name} must be more than 0, not {value}")));
            }
        }
        if !(self.junction_deviation >= 0.0 && self.junction_deviation.is_finite()) {
            let value = self.junction_deviation;
            return Err(MotionError::limit(format!(
                "the junction deviation must be 0 mm or more, not {value}"
            )));
        }
        match self.profile.fault().or(self.smoothing.fault()) {
            Some(fault) => Err(MotionError::limit(fault)),
            None => Ok(()),
        }
    }
}

impl fmt::Debug for MotionProfile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MotionProfile")
            .field("max_acceleration", &self.max_acceleration)
            .field("max_velocity", &self.max_velocity)
            .field("junction_deviation", &self.junction_deviation)
            .field("profile", &self.profile)
            .field("smoothing", &self.smoothing)
            .field("junction", &self.junction)
            .field("constraints", &self.constraints.is_some())
            .finish()
    }
}

/// What becomes of the moves, one entry a move.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// Speeds at the starts, mm/s.
    pub entry: Vec<f64>,
    /// Highest speeds, mm/s.
    pub peak: Vec<f64>,
    /// Speeds at the ends, mm/s.
    pub exit: Vec<f64>,
    /// Durations, s.
    pub time: Vec<f64>,
    /// Moves whose change of speed needs more acceleration or jerk than is allowed.
    pub limits_exceeded: usize,
}

impl Plan {
    /// The time of all moves, s.
    pub fn total_time(&self) -> f64 {
        self.time.iter().sum()
    }

    fn push(&mut self, step: &Step) {
        self.entry.push(step.entry);
        self.peak.push(step.timing.peak);
        self.exit.push(step.exit);
        self.time.push(step.timing.time);
        self.limits_exceeded += usize::from(step.timing.limit_exceeded);
    }
}

/// What becomes of one move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    pub(crate) entry: f64,
    pub(crate) exit: f64,
    pub(crate) timing: Timing,
}

/// Why moves cannot be planned.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MotionError {
    /// The move it is about, counted from zero.
    pub index: Option<usize>,
    /// What is so.
    pub message: String,
}

impl MotionError {
    fn limit(message: String) -> Self {
        Self { index: None, message }
    }
}

impl fmt::Display for MotionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(index) = self.index {
            write!(f, "move {index}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for MotionError {}

/// The lesser of two numbers, neither of which is NaN: one instruction, unlike [`f64::min`].
#[inline(always)]
pub(crate) fn least(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The greater of two numbers, neither of which is NaN.
#[inline(always)]
pub(crate) fn greatest(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}
