//! Planning while the moves come: as soon as no later move can change it, a move is done.

use super::{MotionError, MotionProfile, Move, Moves, Step, Task, passes::passes};

/// So many moves are planned at once, at least: few enough to stay in the cache.
const WINDOW: usize = 4096;
/// The working arrays of a stretch of moves.
#[derive(Default)]
pub(crate) struct Stretch {
    /// Target speeds, mm/s.
    target: Vec<f64>,
    /// Squares of the speeds at the ends of the moves.
    junction: Vec<f64>,
    /// Square of the speed at the start of the first.
    entry: f64,
}

impl Stretch {
    /// Caps of the corners. `entry` is the square of the speed in which the stretch is entered; nothing is rest. `ends`
    /// says that the last move ends the run.
    pub(crate) fn prepare(
        &mut self,
        profile: &MotionProfile,
        moves: &Moves,
        entry: Option<f64>,
        ends: bool,
    ) -> Result<(), MotionError> {
        let count = moves.len();
        self.target.clear();
        self.target.extend_from_slice(&moves.target);
        self.junction.clear();
        for index in 0..count {
            check(moves, index)?;
            let cap = if index + 1 == count {
                if ends { profile.junction.rest_squared(moves, index) } else { 0.0 }
            } else {
                let lower = self.target[index].min(self.target[index + 1]);
                profile.junction.speed_squared(moves, index).min(lower * lower)
            };
            self.junction.push(cap);
        }
        self.entry = entry.unwrap_or_else(|| profile.junction.rest_squared(moves, 0));
        let Some(rules) = &profile.constraints else { return Ok(()) };
        self.junction.iter_mut().for_each(|square| *square = square.sqrt());
        rules.apply(moves, &mut self.target, &mut self.junction);
        for index in 0..count {
            let sound = |speed: f64| speed.is_finite() && speed >= 0.0;
            if !(sound(self.junction[index]) && sound(self.target[index]) && self.target[index] > 0.0) {
                return Err(MotionError {
                    index: Some(index),
                    message: format!(
                        "the rules of the machine ask for a speed of {} mm/s and {} mm/s at its end",
                        self.target[index], self.junction[index]
                    ),
                });
            }
        }
        // What the rules slowed down is slow from end to end.
        for index in 0..count {
            let next = self.target.get(index + 1).copied().unwrap_or(f64::INFINITY);
            let speed = self.junction[index].min(self.target[index]).min(next);
            self.junction[index] = speed * speed;
        }
        Ok(())
    }

    /// Squares of the speeds at the ends of the moves.
    #[cfg(test)]
    pub(crate) fn junction_squares(&self) -> &[f64] {
        &self.junction
    }

    /// The passes; how many moves from the front are settled.
    pub(crate) fn pass(&mut self, profile: &MotionProfile, moves: &Moves) -> usize {
        passes(profile.profile, moves, self.entry, &mut self.junction)
    }

    /// What becomes of a move.
    #[inline]
    pub(crate) fn step(&self, profile: &MotionProfile, moves: &Moves, index: usize) -> Step {
        let entry = if index == 0 { self.entry } else { self.junction[index - 1] };
        let target = self.target[index];
        let acceleration = moves.acceleration[index];
        let (entry, exit) = if is_sudden(profile, acceleration) {
            (target, target)
        } else {
            (entry.sqrt(), self.junction[index].sqrt())
        };
        let task = Task { length: moves.length[index], entry, exit, target, acceleration };
        Step { entry, exit, timing: profile.profile.timing(&task) }
    }
}

/// Whether speed changes at once, so that a move has one speed from end to end.
fn is_sudden(profile: &MotionProfile, acceleration: f64) -> bool {
    acceleration == f64::INFINITY || profile.profile == super::ProfileType::ConstantVelocity
}

fn check(moves: &Moves, index: usize) -> Result<(), MotionError> {
    let positive = |value: f64| value > 0.0 && value.is_finite();
    let (length, target) = (moves.length[index], moves.target[index]);
    let acceleration = moves.acceleration[index];
    if positive(length) && positive(target) && acceleration > 0.0 {
        return Ok(());
    }
    Err(MotionError {
        index: Some(index),
        message: format!(
            "length, speed and acceleration must be more than 0, not {length} mm, {target} mm/s and \
             {acceleration} mm/s²"
        ),
    })
}

/// Plans the moves of one run after the other, holding no more of them than the machine needs to look ahead.
#[derive(Default)]
pub(crate) struct Planner<T> {
    moves: Moves,
    /// What the caller wants back with each move.
    tags: Vec<T>,
    stretch: Stretch,
    /// The square of the speed at which the first waiting move begins; nothing at the start of a run.
    entry: Option<f64>,
    /// So many moves wait before the next look.
    patience: usize,
    /// More moves than this are not kept in mind: those that wait then are planned as if the machine had to stop, which
    /// every limit allows. Nothing is no limit.
    longest: Option<usize>,
    pub(crate) limits_exceeded: u64,
}

impl<T: Copy> Planner<T> {
    /// A planner that never keeps more than `longest` moves in mind.
    pub(crate) fn bounded(longest: usize) -> Self
    where
        T: Default,
    {
        Self { longest: Some(longest), ..Self::default() }
    }

    /// One more move. Hands those that are settled to `done`.
    #[inline]
    pub(crate) fn push(
        &mut self,
        profile: &MotionProfile,
        step: &Move,
        tag: T,
        done: &mut impl FnMut(T, &Step, f64),
    ) -> Result<(), MotionError> {
        self.moves.push(step);
        self.tags.push(tag);
        if self.moves.len() < self.patience.max(WINDOW) {
            return Ok(());
        }
        self.stretch.prepare(profile, &self.moves, self.entry, false)?;
        let mut settled = self.stretch.pass(profile, &self.moves);
        if self.longest.is_some_and(|longest| self.moves.len() >= longest) {
            settled = settled.max(self.moves.len() / 2);
        }
        self.hand_out(profile, settled, done);
        if settled > 0 {
            self.entry = Some(self.stretch.junction[settled - 1]);
            self.moves = self.moves.tail(settled);
            self.tags.drain(..settled);
        }
        // What waits is planned again; twice as much must come first, or the work would grow with its square.
        self.patience = (2 * self.moves.len()).min(self.longest.unwrap_or(usize::MAX));
        Ok(())
    }

    /// The run ends in a stop: hands out all that wait.
    pub(crate) fn stop(
        &mut self,
        profile: &MotionProfile,
        done: &mut impl FnMut(T, &Step, f64),
    ) -> Result<(), MotionError> {
        if !self.moves.is_empty() {
            self.stretch.prepare(profile, &self.moves, self.entry, true)?;
            self.stretch.pass(profile, &self.moves);
            self.hand_out(profile, self.moves.len(), done);
            self.moves.clear();
            self.tags.clear();
        }
        self.entry = None;
        self.patience = 0;
        Ok(())
    }

    /// What came with a move that waits.
    pub(crate) fn tag(&self, index: usize) -> Option<T> {
        self.tags.get(index).copied()
    }

    fn hand_out(&mut self, profile: &MotionProfile, count: usize, done: &mut impl FnMut(T, &Step, f64)) {
        for index in 0..count {
            let step = self.stretch.step(profile, &self.moves, index);
            self.limits_exceeded += u64::from(step.timing.limit_exceeded);
            done(self.tags[index], &step, self.moves.acceleration[index]);
        }
    }
}
