//! How speed runs within one move.

use super::phases::{Phase, Phases};
use super::scurve;
use super::{greatest, least};

/// The law of speed within a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProfileType {
    /// One speed from end to end; speed changes at once.
    ConstantVelocity,
    /// One even change from the entry to the exit speed. A move from rest to rest, which no such change can make, goes
    /// as a [`Trapezoid`](Self::Trapezoid).
    LinearRamp,
    /// Accelerate, cruise, decelerate.
    Trapezoid(Ramps),
    /// Seven phases of limited jerk, mm/s³. The planner takes ramps of constant acceleration for granted; where the
    /// change of speed does not fit into a move it is made in time all the same, and [`Timing::limit_exceeded`] says so.
    SCurve {
        /// The limit of jerk, mm/s³.
        jerk: f64,
    },
    /// Seven phases of limited jerk, mm/s³, which the planner knows of: no limit is ever exceeded.
    SCurveStrict {
        /// The limit of jerk, mm/s³.
        jerk: f64,
    },
}

impl Default for ProfileType {
    fn default() -> Self {
        Self::Trapezoid(Ramps::AccelerationLimited)
    }
}

/// What the ramps of a trapezoid obey.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ramps {
    /// The acceleration of the machine; short moves are triangles.
    AccelerationLimited,
    /// Fixed fractions of the length. Acceleration is then a result, and may be any.
    DistanceLimited {
        /// The part of the length in which speed rises, 0..1.
        accelerate: f64,
        /// The part in which it falls; both together at most 1.
        decelerate: f64,
    },
}

impl Ramps {
    /// A quarter of the length at each end.
    pub const QUARTERS: Self = Self::DistanceLimited { accelerate: 0.25, decelerate: 0.25 };
}

/// How a move goes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// How long it takes, s.
    pub time: f64,
    /// Its highest speed, mm/s.
    pub peak: f64,
    /// The change of speed needs more acceleration or jerk than is allowed.
    pub limit_exceeded: bool,
}

/// What a move has to do: its length, its speeds, and what is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// Length, mm.
    pub length: f64,
    /// Speed at the start, mm/s.
    pub entry: f64,
    /// Speed at the end, mm/s.
    pub exit: f64,
    /// The highest speed that is wanted, mm/s.
    pub target: f64,
    /// The acceleration that is allowed, mm/s².
    pub acceleration: f64,
}

impl ProfileType {
    /// How long the move takes and how fast it gets.
    #[inline(always)]
    pub fn timing(self, task: &Task) -> Timing {
        let one = |peak: f64, time: f64| Timing { time, peak, limit_exceeded: false };
        if task.acceleration == f64::INFINITY
            && !matches!(self, Self::Trapezoid(Ramps::DistanceLimited { .. }))
        {
            return one(task.target, task.length / task.target);
        }
        match self {
            Self::ConstantVelocity => one(task.target, task.length / task.target),
            Self::LinearRamp if task.entry + task.exit > 0.0 => {
                one(task.entry.max(task.exit), 2.0 * task.length / (task.entry + task.exit))
            }
            Self::LinearRamp | Self::Trapezoid(Ramps::AccelerationLimited) => trapezoid(task),
            Self::Trapezoid(Ramps::DistanceLimited { accelerate, decelerate }) => {
                let cruise = 1.0 - accelerate - decelerate;
                let peak = task.target;
                let time = task.length
                    * (2.0 * accelerate / (task.entry + peak)
                        + cruise / peak
                        + 2.0 * decelerate / (peak + task.exit));
                one(peak, time)
            }
            Self::SCurve { jerk } | Self::SCurveStrict { jerk } => scurve::timing(task, jerk),
        }
    }

    /// The phases of the move, given the peak that [`timing`](Self::timing) found.
    pub fn phases(self, task: &Task, peak: f64) -> Phases {
        let mut phases = Phases::new(task.entry);
        if task.acceleration == f64::INFINITY
            && !matches!(self, Self::Trapezoid(Ramps::DistanceLimited { .. }))
        {
            return Phases::constant(peak, task.length);
        }
        match self {
            Self::ConstantVelocity => return Phases::constant(peak, task.length),
            Self::LinearRamp if task.entry + task.exit > 0.0 => {
                phases.push(even(task.entry, task.exit, task.length));
            }
            Self::LinearRamp | Self::Trapezoid(Ramps::AccelerationLimited) => {
                let rise = ramp_length(task.entry, peak, task.acceleration);
                let fall = ramp_length(peak, task.exit, task.acceleration);
                phases.push(even(task.entry, peak, rise));
                phases.push(even(peak, peak, (task.length - rise - fall).max(0.0)));
                phases.push(even(peak, task.exit, fall));
            }
            Self::Trapezoid(Ramps::DistanceLimited { accelerate, decelerate }) => {
                phases.push(even(task.entry, peak, accelerate * task.length));
                phases.push(even(peak, peak, (1.0 - accelerate - decelerate) * task.length));
                phases.push(even(peak, task.exit, decelerate * task.length));
            }
            Self::SCurve { jerk } | Self::SCurveStrict { jerk } => {
                scurve::push_phases(&mut phases, task, peak, jerk);
            }
        }
        phases
    }

    /// Why these numbers are no profile, if so.
    pub(crate) fn fault(self) -> Option<String> {
        match self {
            Self::SCurve { jerk } | Self::SCurveStrict { jerk } if !(jerk > 0.0 && jerk.is_finite()) => {
                Some(format!("the jerk of an S-curve must be more than 0 mm/s³, not {jerk}"))
            }
            Self::Trapezoid(Ramps::DistanceLimited { accelerate, decelerate })
                if !(accelerate >= 0.0 && decelerate >= 0.0 && accelerate + decelerate <= 1.0) =>
            {
                Some(format!(
                    "the ramps of a trapezoid must be parts of its length, together at most 1, not {accelerate} and \
                     {decelerate}"
                ))
            }
            _ => None,
        }
    }
}

/// The length of a ramp of constant acceleration, mm.
fn ramp_length(from: f64, to: f64, acceleration: f64) -> f64 {
    (to * to - from * from).abs() / (2.0 * acceleration)
}

/// A phase of constant acceleration over a length.
fn even(from: f64, to: f64, length: f64) -> Phase {
    if length <= 0.0 || from + to <= 0.0 {
        return Phase::default();
    }
    let time = 2.0 * length / (from + to);
    Phase { time, acceleration: (to - from) / time, jerk: 0.0 }
}

/// T = (vp − v0)/a + (vp − v1)/a + dc/vp with vp² = min(vmax², a·d + (v0² + v1²)/2).
#[inline(always)]
fn trapezoid(task: &Task) -> Timing {
    let Task { length, entry, exit, target, acceleration } = *task;
    let (entry2, exit2) = (entry * entry, exit * exit);
    let peak2 = least(target * target, acceleration * length + 0.5 * (entry2 + exit2));
    // Rounding must not put the peak below the ends.
    let peak = greatest(greatest(peak2.sqrt(), entry), exit);
    let twice = 2.0 * acceleration;
    let ramps = (2.0 * peak * peak - entry2 - exit2) / twice;
    let cruise = length - ramps;
    let time = (2.0 * peak - entry - exit) / acceleration + if cruise > 0.0 { cruise / peak } else { 0.0 };
    Timing { time, peak, limit_exceeded: false }
}
