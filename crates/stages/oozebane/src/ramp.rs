//! Speed in steps, behind the start of a bead and before its end (stages.md §6.17).

use skein::{Feed, Move, Pen, Stretch, Thread};

/// Steps of a way, each with the length at which it ends, in microns, and its share of the speed.
pub(crate) struct Ramp(Vec<(f64, f64)>);

impl Ramp {
    /// No steps.
    pub(crate) fn none() -> Self {
        Self(Vec::new())
    }

    /// Up to full speed in so many steps over a length; at least two, or none at all.
    pub(crate) fn up(steps: u32, length: f64) -> Self {
        if steps == 0 || length <= 0.0 {
            return Self::none();
        }
        let count = steps.max(2);
        let n = f64::from(count);
        Self(
            (1..=count)
                .map(|step| {
                    let share = if step == count { 1.0 } else { (0.5 / n + f64::from(step) / n).min(1.0) };
                    (length * f64::from(step) / n, share)
                })
                .collect(),
        )
    }

    /// Down from where the clay has been stopped, over a length.
    pub(crate) fn down(steps: u32, length: f64) -> Self {
        if steps < 2 || length <= 0.0 {
            return Self::none();
        }
        let n = f64::from(steps);
        let step = |step: u32| (length * f64::from(step) / (n - 1.0), 1.0 - 0.5 / n - f64::from(step) / n);
        Self((1..steps).map(step).collect())
    }

    /// Lays a thread whose beginning has these speeds.
    pub(crate) fn lay(&self, pen: &mut Pen, thread: Thread) {
        self.each(thread, |piece| {
            pen.start(&piece);
            pen.step(piece.step);
        });
    }

    /// Goes the way of a thread without clay, with these speeds.
    pub(crate) fn run(&self, pen: &mut Pen, thread: Thread) {
        self.each(thread, |piece| pen.step(Move { extrusion: None, ..piece.step }));
    }

    fn each(&self, thread: Thread, mut take: impl FnMut(Stretch)) {
        let mut rest = thread;
        let mut begin = 0.0;
        for (end, share) in &self.0 {
            let (part, after) = rest.split(end - begin);
            for piece in part.stretches {
                let slow = piece.step.feed.and_then(|feed| Feed::from_mm_per_s(feed.mm_per_s() * share));
                take(Stretch { step: Move { feed: slow.or(piece.step.feed), ..piece.step }, ..piece });
            }
            rest = after;
            begin = *end;
        }
        rest.stretches.into_iter().for_each(take);
    }
}
