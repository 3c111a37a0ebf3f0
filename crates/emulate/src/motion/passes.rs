//! The two passes: from caps at the corners to speeds that the machine can reach, all in squared speed.

use super::scurve;
use super::{Moves, ProfileType};

/// Lowers `junction` until every move can change from its entry to its exit speed within its length.
///
/// `junction[i]` is the square of the speed at the end of move i. `entry` is that at the start of the first move and is
/// not changed. The result is the largest sequence below the caps that the machine can follow; a second round changes
/// nothing, and it does not matter which pass runs first.
///
/// Returns how many moves from the front no later move can slow down any more.
pub(crate) fn passes(profile: ProfileType, moves: &Moves, entry: f64, junction: &mut [f64]) -> usize {
    match profile {
        ProfileType::SCurveStrict { jerk } => sweep(entry, junction, |index, start| {
            let speed = scurve::reach(start.sqrt(), moves.length[index], moves.acceleration[index], jerk);
            speed * speed
        }),
        _ => sweep(entry, junction, |index, start| {
            start + 2.0 * moves.acceleration[index] * moves.length[index]
        }),
    }
}

/// `reach(i, v²)` is the largest square of a speed at one end of move i when it is v² at the other.
#[inline]
fn sweep(entry: f64, junction: &mut [f64], reach: impl Fn(usize, f64) -> f64) -> usize {
    let mut speed = entry;
    for (index, end) in junction.iter_mut().enumerate() {
        speed = end.min(reach(index, speed));
        *end = speed;
    }
    let mut settled = 0;
    for index in (1..junction.len()).rev() {
        let brakes_from = reach(index, junction[index]);
        if brakes_from < junction[index - 1] {
            junction[index - 1] = brakes_from;
        } else if settled == 0 {
            settled = index;
        }
    }
    settled
}
