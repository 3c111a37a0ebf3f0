//! Klipper's smoothed look-ahead: short moves to and fro do not get as fast as they could.

use super::passes::sweep;
use super::stretch::Leg;
use super::{greatest, least};

/// How much of a move is to be cruised through, so that a machine does not rattle on short moves to and fro.
///
/// The highest speed of a move is the one it would have under a lower, *virtual* acceleration. Only that speed is
/// lowered: the ramps below it keep the acceleration of the machine, and what that saves of the way is cruised. From
/// Klipper's documentation: `Kinematics.md`, "Smoothed look-ahead", says how; `Config_Reference.md`,
/// `minimum_cruise_ratio`, says that a ratio of 0.5 leaves 0.75 mm of a move of 1.5 mm, from rest to rest, at one
/// speed. A ratio r does that with the virtual acceleration a·(1 − r): then v² = a·(1 − r)·d, the two ramps are
/// v²/a = (1 − r)·d long, and r·d is left.
///
/// Moves in which a machine does nothing but speed up, or nothing but slow down, count as one as far as the corners
/// between them let it pass, so that a long move does not take another time when it is written in pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Smoothing {
    /// `minimum_cruise_ratio`: the virtual acceleration is a·(1 − ratio). 0 is no smoothing; Klipper's default is 0.5.
    CruiseRatio(f64),
    /// `max_accel_to_decel` of older configurations: the virtual acceleration itself, mm/s², where that is lower.
    AccelToDecel(f64),
}

impl Default for Smoothing {
    fn default() -> Self {
        Self::CruiseRatio(0.0)
    }
}

impl Smoothing {
    /// The virtual acceleration of a machine that accelerates with `acceleration`, mm/s².
    #[inline]
    pub fn acceleration(self, acceleration: f64) -> f64 {
        match self {
            Self::CruiseRatio(ratio) => acceleration * (1.0 - ratio),
            // Where speed changes at once there is nothing to smooth.
            Self::AccelToDecel(_) if acceleration == f64::INFINITY => acceleration,
            Self::AccelToDecel(most) => least(acceleration, most),
        }
    }

    /// Why it is none, if so.
    pub(crate) fn fault(self) -> Option<String> {
        match self {
            Self::CruiseRatio(ratio) if !(0.0..1.0).contains(&ratio) => {
                Some(format!("the cruise ratio must be 0 or more and less than 1, not {ratio}"))
            }
            Self::AccelToDecel(most) if !(most > 0.0 && most.is_finite()) => {
                Some(format!("the acceleration to deceleration must be more than 0, not {most}"))
            }
            _ => None,
        }
    }
}

/// Lowers the speeds of legs. All speeds here are virtual ones, squared.
#[derive(Default)]
pub(super) struct Smoother {
    /// Whether any move of the run is to be smoothed.
    pub(super) is_needed: bool,
    /// At the start of the first leg, where that differs from the real one.
    entry: Option<f64>,
    /// What of the top of the leg before the first goes through the corner between them.
    before: f64,
    /// At the ends of the legs.
    exits: Vec<f64>,
    tops: Vec<Top>,
}

/// The highest speed of a leg, squared.
struct Top {
    /// Its own, or, of a leg that is a part of a rise or a fall, that of the whole as far as corners let it through.
    speed: f64,
    /// What of it goes through the corner at its end.
    through: f64,
}

impl Smoother {
    /// Lowers targets and caps. `entry` is the square of the real speed at the start. Returns how many legs from the
    /// front have what they keep, whatever comes; if the last leg ends the run, all of them.
    pub(super) fn smooth(&mut self, legs: &mut [Leg], entry: f64, ends: bool) -> usize {
        if !self.is_needed {
            return legs.len();
        }
        let entry = *self.entry.get_or_insert(entry);
        let settled = sweep(legs, entry, &mut self.exits, virtual_reach);
        self.find_tops(legs, entry);
        let rising = self.hand_back_tops(legs, entry, settled);
        lower(legs, &self.tops);
        if ends { legs.len() } else { rising }
    }

    /// The top of each leg, or of the fall it is a part of.
    fn find_tops(&mut self, legs: &[Leg], entry: f64) {
        let (mut start, mut before) = (entry, self.before);
        self.tops.clear();
        self.tops.extend(legs.iter().zip(&self.exits).map(|(leg, &end)| {
            let own =
                least(leg.target * leg.target, leg.smooth_acceleration * leg.length + 0.5 * (start + end));
            // What does nothing but slow down had its top speed before.
            let falls = start >= virtual_reach(leg, end);
            let speed = if falls { greatest(own, before) } else { own };
            before = least(speed, leg.cap);
            start = end;
            Top { speed, through: before }
        }));
    }

    /// Gives legs that are a part of a rise its top. Returns how many legs of the first `settled` have one that no later
    /// leg can change.
    fn hand_back_tops(&mut self, legs: &[Leg], entry: f64, mut settled: usize) -> usize {
        let mut starts = self.exits.iter().rev().skip(1).copied().chain([entry]);
        let mut behind = 0.0;
        for (index, ((leg, &end), top)) in legs.iter().zip(&self.exits).zip(&mut self.tops).enumerate().rev()
        {
            if end >= virtual_reach(leg, starts.next().unwrap_or(entry)) {
                // It does nothing but speed up, and goes on to do so in the next.
                top.speed = greatest(top.speed, least(behind, leg.cap));
                if settled == index + 1 {
                    settled = index;
                }
            }
            behind = top.speed;
        }
        settled
    }

    /// Forgets the legs up to this one.
    pub(super) fn forget(&mut self, last: usize) {
        if self.is_needed {
            self.entry = self.exits.get(last).copied();
            self.before = self.tops.get(last).map_or(0.0, |top| top.through);
        }
    }

    /// Forgets the run.
    pub(super) fn clear(&mut self) {
        (self.is_needed, self.entry, self.before) = (false, None, 0.0);
    }
}

/// v² at one end of a leg when it is `start` at the other, under the virtual acceleration.
#[inline]
fn virtual_reach(leg: &Leg, start: f64) -> f64 {
    start + 2.0 * leg.smooth_acceleration * leg.length
}

fn lower(legs: &mut [Leg], tops: &[Top]) {
    for (leg, top) in legs.iter_mut().zip(tops) {
        if leg.smooth_acceleration < leg.acceleration {
            leg.target = least(leg.target, top.speed.sqrt());
        }
    }
    let mut next = f64::INFINITY;
    for leg in legs.iter_mut().rev() {
        let speed = least(leg.target, next);
        leg.cap = least(leg.cap, speed * speed);
        next = leg.target;
    }
}

#[cfg(test)]
mod tests {
    use super::Smoothing;
    use crate::motion::{MotionProfile, Move, Moves, Phase, Plan, ProfileType, Task};
    use proptest::prelude::*;

    fn planner(smoothing: Smoothing) -> MotionProfile {
        MotionProfile {
            max_acceleration: Some(500.0),
            junction_deviation: 0.05,
            smoothing,
            ..MotionProfile::default()
        }
    }

    /// The moves through points, each with a speed, in so many pieces each.
    fn through(planner: &MotionProfile, points: &[([f64; 3], f64)], pieces: usize) -> Moves {
        let mut from = [0.0; 3];
        let mut moves = Moves::default();
        for &(to, speed) in points {
            let at = |piece: usize| {
                [0, 1, 2].map(|axis| from[axis] + (to[axis] - from[axis]) * piece as f64 / pieces as f64)
            };
            (0..pieces)
                .for_each(|piece| moves.push(&planner.limit(Move::line(at(piece), at(piece + 1), speed))));
            from = to;
        }
        moves
    }

    fn plan(smoothing: Smoothing, points: &[([f64; 3], f64)], pieces: usize) -> Plan {
        let planner = planner(smoothing);
        planner.plan(&through(&planner, points, pieces)).expect("sound")
    }

    #[test]
    fn a_ratio_of_a_half_leaves_half_of_a_short_move_at_one_speed() {
        for (smoothing, cruised) in [
            (Smoothing::CruiseRatio(0.5), 0.75),
            (Smoothing::AccelToDecel(250.0), 0.75),
            (Smoothing::CruiseRatio(0.2), 0.3),
            (Smoothing::AccelToDecel(125.0), 1.125),
            (Smoothing::AccelToDecel(900.0), 0.0),
            (Smoothing::CruiseRatio(0.0), 0.0),
        ] {
            let plan = plan(smoothing, &[([1.5, 0.0, 0.0], 100.0)], 1);
            let task = Task { length: 1.5, entry: 0.0, exit: 0.0, target: plan.peak[0], acceleration: 500.0 };
            let phases = ProfileType::default().phases(&task, plan.peak[0]);
            let even = |phase: &&Phase| phase.acceleration == 0.0;
            let way: f64 = phases.iter().filter(even).map(|phase| phase.time * plan.peak[0]).sum();
            assert!((way - cruised).abs() < 1e-9, "{smoothing:?}: {way}");
        }
        // A long move has room enough for its speed and for cruising.
        let long = |smoothing| plan(smoothing, &[([100.0, 0.0, 0.0], 50.0)], 1);
        assert_eq!(long(Smoothing::CruiseRatio(0.5)), long(Smoothing::CruiseRatio(0.0)));
    }

    #[test]
    fn moves_to_and_fro_have_the_speed_of_the_formula() {
        let side = 0.2;
        let at = |index: usize| [index as f64 * side, if index.is_multiple_of(2) { 0.0 } else { side }, 0.0];
        let points: Vec<_> = (1..200).map(|index| (at(index), 100.0)).collect();
        let plain = plan(Smoothing::CruiseRatio(0.0), &points, 1);
        let smooth = plan(Smoothing::CruiseRatio(0.5), &points, 1);
        // In the middle of the way all corners are passed with the speed of a right angle.
        let (length, corner2) = (side * 2.0f64.sqrt(), 500.0 * 0.05 * (1.0 + 2.0f64.sqrt()));
        let peak = |acceleration: f64| (acceleration * length + corner2).sqrt();
        assert!((plain.peak[100] - peak(500.0)).abs() < 1e-9);
        assert!((smooth.peak[100] - peak(250.0)).abs() < 1e-9);
        assert!((smooth.exit[100] - corner2.sqrt()).abs() < 1e-9);
        let ramps = peak(250.0) - corner2.sqrt();
        let cruise = length - (peak(250.0).powi(2) - corner2) / 500.0;
        assert!((smooth.time[100] - (2.0 * ramps / 500.0 + cruise / peak(250.0))).abs() < 1e-9);
    }

    #[test]
    fn numbers_that_smooth_nothing_are_refused() {
        for smoothing in [
            Smoothing::CruiseRatio(1.0),
            Smoothing::CruiseRatio(-0.1),
            Smoothing::CruiseRatio(f64::NAN),
            Smoothing::AccelToDecel(0.0),
            Smoothing::AccelToDecel(f64::INFINITY),
        ] {
            assert!(planner(smoothing).check().is_err(), "{smoothing:?}");
        }
        // Where speed changes at once there is nothing to smooth.
        let sudden = MotionProfile {
            max_acceleration: None,
            smoothing: Smoothing::AccelToDecel(10.0),
            ..MotionProfile::default()
        };
        let moves = through(&sudden, &[([1.5, 0.0, 0.0], 100.0)], 1);
        assert_eq!(sudden.plan(&moves).expect("sound").time, [0.015]);
    }

    fn points() -> impl Strategy<Value = Vec<([f64; 3], f64)>> {
        let point = (-5.0..5.0f64, -5.0..5.0f64, 1.0..100.0f64);
        prop::collection::vec(point, 1..30).prop_map(|steps| {
            let mut at = [0.0; 3];
            let far = steps.into_iter().filter(|(x, y, _)| x.abs() + y.abs() > 1e-2);
            far.map(|(x, y, speed)| {
                at = [at[0] + x, at[1] + y, 0.0];
                (at, speed)
            })
            .collect()
        })
    }

    proptest! {
        #[test]
        fn a_move_in_pieces_takes_as_long(points in points(), ratio in 0.0..0.95f64, pieces in 1..20usize) {
            let time = |pieces: usize| plan(Smoothing::CruiseRatio(ratio), &points, pieces).total_time();
            prop_assert!((time(pieces) - time(1)).abs() < 1e-7, "{} {}", time(pieces), time(1));
        }

        #[test]
        fn more_cruising_is_never_faster(points in points(), ratio in 0.0..0.9f64, more in 0.0..0.09f64) {
            let speeds = |ratio: f64| plan(Smoothing::CruiseRatio(ratio), &points, 1);
            let (less, more) = (speeds(ratio), speeds(ratio + more));
            for index in 0..less.exit.len() {
                prop_assert!(more.exit[index] <= less.exit[index] + 1e-9);
                prop_assert!(more.peak[index] <= less.peak[index] + 1e-9);
            }
        }
    }
}
