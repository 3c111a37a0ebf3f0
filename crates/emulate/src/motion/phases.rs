//! A move in phases of constant jerk: where it is at any time.

/// A stretch of constant jerk.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phase {
    /// How long it lasts, s.
    pub time: f64,
    /// Acceleration at its start, mm/s².
    pub acceleration: f64,
    /// Jerk, mm/s³.
    pub jerk: f64,
}

/// Where a move is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionState {
    /// Way from the start, mm.
    pub distance: f64,
    /// Speed, mm/s.
    pub speed: f64,
    /// Acceleration, mm/s².
    pub acceleration: f64,
}

/// At most seven phases, one after the other; phases without time are left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phases {
    entry: f64,
    phases: [Phase; 7],
    count: usize,
}

impl Phases {
    pub(crate) fn new(entry: f64) -> Self {
        Self { entry, phases: [Phase::default(); 7], count: 0 }
    }

    pub(crate) fn constant(speed: f64, length: f64) -> Self {
        let mut one = Self::new(speed);
        one.push(Phase { time: length / speed, ..Phase::default() });
        one
    }

    /// One more phase; the eighth would be lost, and no profile has one.
    pub(crate) fn push(&mut self, phase: Phase) {
        if phase.time > 0.0
            && let Some(place) = self.phases.get_mut(self.count)
        {
            *place = phase;
            self.count += 1;
        }
    }

    /// The phases.
    pub fn iter(&self) -> impl Iterator<Item = &Phase> {
        self.phases[..self.count].iter()
    }

    /// The time of all, s.
    pub fn time(&self) -> f64 {
        self.iter().map(|phase| phase.time).sum()
    }

    /// Way, speed and acceleration at a time after the start, s; before it those of the start, after the end those of
    /// the end.
    pub fn at(&self, time: f64) -> MotionState {
        let mut state = MotionState { speed: self.entry, ..MotionState::default() };
        let mut left = time.max(0.0);
        for phase in self.iter() {
            let spent = left.min(phase.time);
            state = after(state, phase, spent);
            left -= spent;
            if left <= 0.0 {
                break;
            }
        }
        state
    }

    /// The states at the ends of the phases, with their times after the start.
    pub fn ends(&self) -> impl Iterator<Item = (f64, MotionState)> {
        let mut time = 0.0;
        let mut state = MotionState { speed: self.entry, ..MotionState::default() };
        self.iter().map(move |phase| {
            time += phase.time;
            state = after(state, phase, phase.time);
            (time, state)
        })
    }
}

fn after(before: MotionState, phase: &Phase, time: f64) -> MotionState {
    let Phase { acceleration, jerk, .. } = *phase;
    let distance = before.distance + time * (before.speed + time * (acceleration / 2.0 + time * jerk / 6.0));
    let speed = before.speed + time * (acceleration + time * jerk / 2.0);
    // Rounding must not turn a stop into a step back.
    MotionState { distance, speed: speed.max(0.0), acceleration: acceleration + jerk * time }
}
