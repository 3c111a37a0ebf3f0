//! The two passes: from caps at the corners to speeds that the machine can reach, all in squared speed.

use super::scurve;
use super::stretch::Leg;
use super::{ProfileType, least};

/// Finds the squares of the speeds at the ends of the moves, so that every move can change from its entry to its exit
/// speed within its length. `entry` is the square of the speed at the start of the first.
///
/// The result is the largest sequence below the caps that the machine can follow; a second round changes nothing, and it
/// does not matter which pass runs first.
///
/// Returns how many moves from the front no later move can slow down any more.
pub(super) fn passes(profile: ProfileType, legs: &[Leg], entry: f64, exits: &mut Vec<f64>) -> usize {
    match profile {
        ProfileType::SCurveStrict { jerk } => sweep(legs, entry, exits, |leg, start| {
            let speed = scurve::reach(start.sqrt(), leg.length, leg.acceleration, jerk);
            speed * speed
        }),
        _ => sweep(legs, entry, exits, |leg, start| start + 2.0 * leg.acceleration * leg.length),
    }
}

/// `reach(leg, v²)` is the largest square of a speed at one end of a move when it is v² at the other.
#[inline]
pub(super) fn sweep(
    legs: &[Leg],
    entry: f64,
    exits: &mut Vec<f64>,
    reach: impl Fn(&Leg, f64) -> f64,
) -> usize {
    let mut speed = entry;
    exits.clear();
    exits.extend(legs.iter().map(|leg| {
        speed = least(leg.cap, reach(leg, speed));
        speed
    }));
    let mut settled = 0;
    let behind_first = legs.get(1..).unwrap_or_default();
    for (index, (leg, before)) in behind_first.iter().zip(exits.iter_mut()).enumerate().rev() {
        let brakes_from = reach(leg, speed);
        if brakes_from < *before {
            *before = brakes_from;
        } else if settled == 0 {
            settled = index + 1;
        }
        speed = *before;
    }
    settled
}
