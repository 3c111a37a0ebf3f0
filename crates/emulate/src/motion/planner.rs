//! Planning while the moves come: as soon as no later move can change it, a move is done.

use super::stretch::Stretch;
use super::{MotionError, MotionProfile, Move, Step};

/// So many moves are planned at once, at least: few enough to stay in the cache.
const WINDOW: usize = 1024;

/// Plans the moves of one run after the other, holding no more of them than the machine needs to look ahead.
#[derive(Default)]
pub(crate) struct Planner<T> {
    stretch: Stretch,
    /// What the caller wants back with each move.
    tags: Vec<T>,
    /// So many moves wait before the next look.
    patience: usize,
    /// More moves than this are not kept in mind: those that wait then are planned as if the machine had to stop, which
    /// every limit allows. Nothing is no limit.
    longest: Option<usize>,
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
        self.tags.push(tag);
        self.stretch.push(profile, step)?;
        if self.stretch.len() < self.patience.max(WINDOW) { Ok(()) } else { self.look(profile, done) }
    }

    #[inline(never)]
    fn look(
        &mut self,
        profile: &MotionProfile,
        done: &mut impl FnMut(T, &Step, f64),
    ) -> Result<(), MotionError> {
        let mut settled = self.stretch.look(profile)?;
        let half = self.stretch.len() / 2;
        if settled < half && self.longest.is_some_and(|longest| self.stretch.len() >= longest) {
            self.stretch.stop_here(profile)?;
            settled = half;
        }
        self.hand_out(profile, settled, done);
        // What waits is planned again; twice as much must come first, or the work would grow with its square.
        self.patience = (2 * self.stretch.len()).min(self.longest.unwrap_or(usize::MAX));
        Ok(())
    }

    /// The run ends in a stop: hands out all that wait.
    pub(crate) fn stop(
        &mut self,
        profile: &MotionProfile,
        done: &mut impl FnMut(T, &Step, f64),
    ) -> Result<(), MotionError> {
        self.stretch.end(profile)?;
        self.hand_out(profile, self.stretch.len(), done);
        self.stretch.clear();
        self.patience = 0;
        Ok(())
    }

    /// What came with a move that waits.
    pub(crate) fn tag(&self, index: usize) -> Option<T> {
        self.tags.get(index).copied()
    }

    #[inline]
    fn hand_out(&mut self, profile: &MotionProfile, count: usize, done: &mut impl FnMut(T, &Step, f64)) {
        let tags = &self.tags;
        self.stretch.hand_out(profile, count, |index, step, acceleration| {
            if let Some(&tag) = tags.get(index) {
                done(tag, step, acceleration);
            }
        });
        self.tags.drain(..count);
    }
}
