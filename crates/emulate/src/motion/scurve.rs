//! Motion of limited jerk: seven phases, +j 0 −j, cruise, −j 0 +j.

use super::phases::{Phase, Phases};
use super::profile::{Task, Timing};

/// More halvings than an f64 has bits.
const STEPS: usize = 60;
/// The length of a ramp rests on the root of a difference of speeds, which has lost half of its digits.
const ROUNDING: f64 = 1e-7;

/// A change of speed that begins and ends without acceleration.
#[derive(Clone, Copy)]
struct Ramp {
    /// How long jerk works at each end, s.
    jerk_time: f64,
    /// How long acceleration stays at its limit between, s.
    even_time: f64,
}

impl Ramp {
    #[inline]
    fn between(from: f64, to: f64, acceleration: f64, jerk: f64) -> Self {
        let change = (to - from).abs();
        if change * jerk <= acceleration * acceleration {
            Self { jerk_time: (change / jerk).sqrt(), even_time: 0.0 }
        } else {
            let jerk_time = acceleration / jerk;
            Self { jerk_time, even_time: change / acceleration - jerk_time }
        }
    }

    #[inline]
    fn time(self) -> f64 {
        2.0 * self.jerk_time + self.even_time
    }
}

/// The length of a ramp, mm; its mean speed is the middle of both, by symmetry.
#[inline]
fn length(from: f64, to: f64, acceleration: f64, jerk: f64) -> f64 {
    0.5 * (from + to) * Ramp::between(from, to, acceleration, jerk).time()
}

/// How long a move takes and how fast it gets. Where the change from entry to exit does not fit into the length, it is
/// squeezed into the time of an even ramp.
pub(crate) fn timing(task: &Task, jerk: f64) -> Timing {
    let Task { length: way, entry, exit, acceleration, .. } = *task;
    if is_squeezed(task, jerk) {
        let time = 2.0 * way / (entry + exit);
        return Timing { time, peak: entry.max(exit), limit_exceeded: true };
    }
    let peak = peak(task, jerk);
    let rise = Ramp::between(entry, peak, acceleration, jerk).time();
    let fall = Ramp::between(peak, exit, acceleration, jerk).time();
    let cruise = way - 0.5 * (entry + peak) * rise - 0.5 * (peak + exit) * fall;
    let time = rise + fall + if cruise > 0.0 && peak > 0.0 { cruise / peak } else { 0.0 };
    Timing { time, peak, limit_exceeded: false }
}

/// Whether the change from entry to exit is longer than the move, by more than rounding.
fn is_squeezed(task: &Task, jerk: f64) -> bool {
    let ramp = length(task.entry, task.exit, task.acceleration, jerk);
    ramp > task.length * (1.0 + ROUNDING) + 1e-12
}

/// The highest speed of a move that its change of speed fits into.
fn peak(task: &Task, jerk: f64) -> f64 {
    let Task { length: way, entry, exit, target, acceleration } = *task;
    let needed = |peak: f64| length(entry, peak, acceleration, jerk) + length(peak, exit, acceleration, jerk);
    let low = entry.max(exit);
    if needed(target) <= way {
        return target.max(low);
    }
    let both = both_reach_acceleration(task, jerk);
    if let Some(peak) = both.filter(|&peak| peak <= target) {
        return peak;
    }
    if entry == 0.0 && exit == 0.0 {
        // Acceleration never reaches its limit: d = 2·j·t³ with vp = j·t².
        let peak = libm::cbrt(way * jerk.sqrt() / 2.0);
        return (peak * peak).min(target);
    }
    // The needed length grows with the peak.
    let (mut low, mut high) = (low, target);
    for _ in 0..STEPS {
        let middle = 0.5 * (low + high);
        if needed(middle) <= way { low = middle } else { high = middle }
    }
    low
}

/// The peak when both ramps reach the limit of acceleration, from a quadratic in the peak.
fn both_reach_acceleration(task: &Task, jerk: f64) -> Option<f64> {
    let Task { length: way, entry, exit, acceleration, .. } = *task;
    let step = acceleration * acceleration / jerk;
    let root = step * step - 2.0 * (entry + exit) * step
        + 2.0 * (entry * entry + exit * exit)
        + 4.0 * acceleration * way;
    if root < 0.0 {
        return None;
    }
    let peak = (root.sqrt() - step) / 2.0;
    (peak - entry >= step && peak - exit >= step).then_some(peak)
}

/// The highest speed that can be reached from `from` over `way`, with a ramp that begins and ends without acceleration.
pub(crate) fn reach(from: f64, way: f64, acceleration: f64, jerk: f64) -> f64 {
    if acceleration == f64::INFINITY {
        return f64::INFINITY;
    }
    // With x² the change of speed, x³ + 2·v0·x = d·√j while acceleration stays below its limit. The curve is convex, so
    // Newton's steps come down to the root from the nearer of two bounds above it.
    let wanted = way * jerk.sqrt();
    let mut root = libm::cbrt(wanted);
    if from > 0.0 {
        root = root.min(wanted / (2.0 * from));
    }
    for _ in 0..STEPS {
        let slope = 3.0 * root * root + 2.0 * from;
        if slope <= 0.0 {
            break;
        }
        let next = root - (root * root * root + 2.0 * from * root - wanted) / slope;
        if next >= root {
            break;
        }
        root = next;
    }
    let change = root.max(0.0) * root.max(0.0);
    if change * jerk <= acceleration * acceleration {
        return from + change;
    }
    let step = acceleration * acceleration / jerk;
    (step * step / 4.0 + from * from - step * from + 2.0 * acceleration * way).sqrt() - step / 2.0
}

/// The phases of the move.
pub(crate) fn push_phases(phases: &mut Phases, task: &Task, peak: f64, jerk: f64) {
    let Task { length: way, entry, exit, acceleration, .. } = *task;
    if is_squeezed(task, jerk) {
        let half = way / (entry + exit);
        let steep = (exit - entry) / half;
        phases.push(Phase { time: half, acceleration: 0.0, jerk: steep / half });
        phases.push(Phase { time: half, acceleration: steep, jerk: -steep / half });
        return;
    }
    let rise = Ramp::between(entry, peak, acceleration, jerk);
    let fall = Ramp::between(peak, exit, acceleration, jerk);
    let cruise = way - 0.5 * (entry + peak) * rise.time() - 0.5 * (peak + exit) * fall.time();
    push_ramp(phases, rise, jerk);
    if cruise > 0.0 && peak > 0.0 {
        phases.push(Phase { time: cruise / peak, ..Phase::default() });
    }
    push_ramp(phases, fall, -jerk);
}

fn push_ramp(phases: &mut Phases, ramp: Ramp, jerk: f64) {
    let top = jerk * ramp.jerk_time;
    phases.push(Phase { time: ramp.jerk_time, acceleration: 0.0, jerk });
    phases.push(Phase { time: ramp.even_time, acceleration: top, jerk: 0.0 });
    phases.push(Phase { time: ramp.jerk_time, acceleration: top, jerk: -jerk });
}
