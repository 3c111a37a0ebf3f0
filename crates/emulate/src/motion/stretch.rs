//! Moves in a row, as far as planning must know them.

use super::passes::passes;
use super::smooth::Smoother;
use super::{MotionError, MotionProfile, Move, Moves, ProfileType, Step, Task, least};

/// What the passes know of a move.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    /// Its length, mm.
    pub(super) length: f64,
    /// The speed it is told to have, mm/s.
    pub(super) target: f64,
    /// What it may accelerate with, mm/s².
    pub(super) acceleration: f64,
    /// The acceleration with which its highest speed is found, mm/s².
    pub(super) smooth_acceleration: f64,
    /// Square of the highest speed at its end.
    pub(super) cap: f64,
}

/// Moves that wait for their speeds, and the working arrays for it.
#[derive(Default)]
pub(crate) struct Stretch {
    legs: Vec<Leg>,
    /// The move that came last, for the corner to the next one. Nothing at the start of a run.
    last: Option<Move>,
    /// Square of the speed at the start of the first leg.
    entry: f64,
    /// The moves themselves, which only rules of a machine want to see.
    moves: Moves,
    /// The legs as rules and smoothing leave them, where there are any.
    ruled: Vec<Leg>,
    smoother: Smoother,
    /// Squares of the speeds at the ends of the moves.
    exits: Vec<f64>,
}

impl Stretch {
    /// How many moves wait.
    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.legs.len()
    }

    /// One more move.
    ///
    /// # Errors
    /// When one of its numbers makes no sense.
    #[inline]
    pub(crate) fn push(&mut self, profile: &MotionProfile, step: &Move) -> Result<(), MotionError> {
        check(step, self.legs.len())?;
        match (&self.last, self.legs.last_mut()) {
            (Some(before), Some(leg)) => {
                let lower = least(before.target, step.target);
                leg.cap = least(profile.junction.speed_squared(before, step), lower * lower);
            }
            _ => self.entry = profile.junction.rest_squared(step),
        }
        self.last = Some(*step);
        if profile.constraints.is_some() {
            self.moves.push(step);
        }
        self.smoother.is_needed |= step.smooth_acceleration < step.acceleration;
        let Move { length, target, acceleration, smooth_acceleration, .. } = *step;
        self.legs.push(Leg { length, target, acceleration, smooth_acceleration, cap: 0.0 });
        Ok(())
    }

    /// Finds the speeds of as many moves from the front as are settled, whatever comes; returns how many.
    ///
    /// # Errors
    /// When a rule of the machine asks for an impossible speed.
    pub(crate) fn look(&mut self, profile: &MotionProfile) -> Result<usize, MotionError> {
        self.plan(profile, false)
    }

    /// Finds the speeds of all moves. The machine comes to rest after the last one.
    ///
    /// # Errors
    /// When a rule of the machine asks for an impossible speed.
    pub(crate) fn end(&mut self, profile: &MotionProfile) -> Result<(), MotionError> {
        if let (Some(last), Some(leg)) = (&self.last, self.legs.last_mut()) {
            leg.cap = profile.junction.rest_squared(last);
        }
        self.plan(profile, true).map(drop)
    }

    /// Finds the speeds of all moves, as if the machine had to stop behind them.
    ///
    /// # Errors
    /// When a rule of the machine asks for an impossible speed.
    pub(crate) fn stop_here(&mut self, profile: &MotionProfile) -> Result<(), MotionError> {
        self.plan(profile, true).map(drop)
    }

    fn plan(&mut self, profile: &MotionProfile, ends: bool) -> Result<usize, MotionError> {
        if profile.constraints.is_none() && !self.smoother.is_needed {
            return Ok(passes(profile.profile, &self.legs, self.entry, &mut self.exits));
        }
        self.ruled.clear();
        self.ruled.extend_from_slice(&self.legs);
        obey(profile, &self.moves, &mut self.ruled)?;
        let known = self.smoother.smooth(&mut self.ruled, self.entry, ends);
        if known < self.ruled.len() {
            // Behind these, smoothing has not had its last word: nothing may rest on it.
            self.ruled.truncate(known);
            if let Some(last) = self.ruled.last_mut() {
                last.cap = 0.0;
            }
        }
        Ok(passes(profile.profile, &self.ruled, self.entry, &mut self.exits))
    }

    /// Hands out the first moves with what becomes of them, and forgets them.
    #[inline]
    pub(crate) fn hand_out(
        &mut self,
        profile: &MotionProfile,
        count: usize,
        mut done: impl FnMut(usize, &Step, f64),
    ) {
        let legs = if self.ruled.is_empty() { &self.legs } else { &self.ruled };
        let mut entry = self.entry.sqrt();
        for (index, (leg, square)) in legs.iter().zip(&self.exits).take(count).enumerate() {
            let exit = square.sqrt();
            done(index, &leg.step(profile.profile, entry, exit), leg.acceleration);
            entry = exit;
        }
        if let Some(last) = count.checked_sub(1) {
            self.entry = self.exits.get(last).copied().unwrap_or(0.0);
            self.smoother.forget(last);
            self.legs.drain(..count);
            if !self.moves.is_empty() {
                self.moves = self.moves.tail(count);
            }
        }
        self.ruled.clear();
    }

    /// Forgets all; the next move begins a run.
    pub(crate) fn clear(&mut self) {
        self.legs.clear();
        self.moves.clear();
        self.last = None;
        self.smoother.clear();
    }

    /// Squares of the speeds at the ends of the moves.
    #[cfg(test)]
    pub(crate) fn exits(&self) -> &[f64] {
        &self.exits
    }

    /// Squares of the highest speeds at the ends of the moves.
    #[cfg(test)]
    pub(crate) fn caps(&self) -> Vec<f64> {
        self.legs.iter().map(|leg| leg.cap).collect()
    }

    /// Sets them.
    #[cfg(test)]
    pub(crate) fn set_caps(&mut self, caps: &[f64]) {
        self.legs.iter_mut().zip(caps).for_each(|(leg, &cap)| leg.cap = cap);
    }
}

impl Leg {
    /// What becomes of it between two speeds.
    #[inline(always)]
    fn step(&self, profile: ProfileType, entry: f64, exit: f64) -> Step {
        let Self { length, target, acceleration, .. } = *self;
        let is_sudden = acceleration == f64::INFINITY || profile == ProfileType::ConstantVelocity;
        let (entry, exit) = if is_sudden { (target, target) } else { (entry, exit) };
        Step { entry, exit, timing: profile.timing(&Task { length, entry, exit, target, acceleration }) }
    }
}

/// Lowers speeds by the rules of the machine.
fn obey(profile: &MotionProfile, moves: &Moves, legs: &mut [Leg]) -> Result<(), MotionError> {
    let Some(rules) = &profile.constraints else { return Ok(()) };
    let mut target: Vec<f64> = legs.iter().map(|leg| leg.target).collect();
    let mut junction: Vec<f64> = legs.iter().map(|leg| leg.cap.sqrt()).collect();
    rules.apply(moves, &mut target, &mut junction);
    let sound = |speed: f64| speed.is_finite() && speed >= 0.0;
    for (index, (&target, &junction)) in target.iter().zip(&junction).enumerate() {
        if !(sound(junction) && sound(target) && target > 0.0) {
            let message = format!(
                "the rules of the machine ask for a speed of {target} mm/s and {junction} mm/s at its end"
            );
            return Err(MotionError { index: Some(index), message });
        }
    }
    // What the rules slowed down is slow from end to end.
    for (index, (leg, junction)) in legs.iter_mut().zip(junction).enumerate() {
        let next = target.get(index + 1).copied().unwrap_or(f64::INFINITY);
        let speed = junction.min(target[index]).min(next);
        (leg.target, leg.cap) = (target[index], speed * speed);
    }
    Ok(())
}

#[inline]
fn check(step: &Move, index: usize) -> Result<(), MotionError> {
    let positive = step.length > 0.0 && step.target > 0.0 && step.acceleration > 0.0;
    if positive && step.length + step.target < f64::INFINITY { Ok(()) } else { Err(refused(step, index)) }
}

#[cold]
fn refused(step: &Move, index: usize) -> MotionError {
    let Move { length, target, acceleration, .. } = step;
    MotionError {
        index: Some(index),
        message: format!(
            "length, speed and acceleration must be more than 0, not {length} mm, {target} mm/s and \
             {acceleration} mm/s²"
        ),
    }
}
