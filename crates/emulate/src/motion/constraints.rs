//! Rules of a machine beyond corners: the hook of the planner, and the BAAM that uses it.

use super::Moves;
use super::moves::{SHORTEST, dot};

/// Ends that lie nearer to each other than this part of the length are those of an arc.
const STRAIGHT: f64 = 1.0 - 1e-9;

/// Rules that a machine adds to its planner, without a change of the planner.
///
/// Called immediately before the passes, so that whatever it lowers is felt by the moves before and after.
///
/// ```
/// use emulate::motion::{MachineConstraints, Moves};
///
/// /// A full stop before and after every move straight up or down.
/// struct StopsForLayers;
///
/// impl MachineConstraints for StopsForLayers {
///     fn apply(&self, moves: &Moves, _target: &mut [f64], junction: &mut [f64]) {
///         for index in 0..moves.len() {
///             let by = |axis: usize| (moves.to[index][axis] - moves.from[index][axis]).abs();
///             if moves.is_path(index) && by(0) < 1e-9 && by(1) < 1e-9 {
///                 if index > 0 {
///                     junction[index - 1] = 0.0; // slow down into the move
///                 }
///                 junction[index] = 0.0; // stop at its end
///             }
///         }
///     }
/// }
/// ```
pub trait MachineConstraints: Send + Sync {
    /// Lowers the target speeds of moves and the speeds at their ends, mm/s. `junction[i]` is the speed at the *end* of
    /// move i, and so the entry of move i + 1; the last one is a stop. A speed that is negative or no number is an error
    /// of the plan.
    ///
    /// While a file streams by, `moves` is a part of a run, and its last moves come again at the front of the next part
    /// with speeds as if they had never been here. What a rule says of a move may therefore rest on that move and its
    /// neighbours only.
    fn apply(&self, moves: &Moves, target: &mut [f64], junction: &mut [f64]);
}

/// The rules of the Cincinnati BAAM: a stop at every change of layer, and a highest speed for each axis.
///
/// The figures of the real machine are not public; these are to be set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaamConstraints {
    /// The highest speeds of X, Y, Z and the table W, mm/s; infinite where there is none.
    pub axis_speed: [f64; 4],
    /// Whether the machine stops before and after a move of Z or of the table alone.
    pub stop_on_vertical: bool,
}

impl Default for BaamConstraints {
    fn default() -> Self {
        Self { axis_speed: [f64::INFINITY; 4], stop_on_vertical: true }
    }
}

impl MachineConstraints for BaamConstraints {
    fn apply(&self, moves: &Moves, target: &mut [f64], junction: &mut [f64]) {
        for index in 0..moves.len() {
            if !moves.is_path(index) {
                continue;
            }
            let cap = self.highest(moves, index);
            target[index] = target[index].min(cap);
            // Corners were capped with the targets as they were.
            junction[index] = junction[index].min(cap);
            if index > 0 {
                junction[index - 1] = junction[index - 1].min(cap);
            }
            if self.stop_on_vertical && is_vertical(moves, index) {
                junction[index] = 0.0;
                if index > 0 {
                    junction[index - 1] = 0.0;
                }
            }
        }
    }
}

impl BaamConstraints {
    /// The speed along the path at which the first axis is at its limit. Of an arc X and Y are looked at in full, since
    /// it may point anywhere between its ends.
    fn highest(&self, moves: &Moves, index: usize) -> f64 {
        let start = moves.tangent_in[index];
        let by = [0, 1, 2].map(|axis| moves.to[index][axis] - moves.from[index][axis]);
        // A whole circle ends as it began; only its length tells it from a straight move.
        let is_arc = dot(by, by) < (moves.length[index] * STRAIGHT).powi(2);
        let flat = if is_arc { Some(libm::hypot(start[0], start[1])) } else { None };
        let shares = [
            flat.unwrap_or(start[0].abs()),
            flat.unwrap_or(start[1].abs()),
            start[2].abs(),
            moves.table[index].abs(),
        ];
        let caps = self.axis_speed.iter().zip(shares);
        caps.filter(|(_, share)| *share > 0.0)
            .map(|(speed, share)| speed / share)
            .fold(f64::INFINITY, f64::min)
    }
}

/// Whether a move goes straight up or down.
fn is_vertical(moves: &Moves, index: usize) -> bool {
    let by = |axis: usize| (moves.to[index][axis] - moves.from[index][axis]).abs();
    let [x, y, _] = moves.tangent_in[index];
    by(0) < SHORTEST && by(1) < SHORTEST && x.abs() < SHORTEST && y.abs() < SHORTEST
}
