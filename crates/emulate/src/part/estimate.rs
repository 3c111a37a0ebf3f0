//! The bead of a file that nobody described.

use crate::bead::{Bead, Shape};
use crate::operation::AdditiveOperation;
use crate::process::{Action, ProcessData};
use std::f64::consts::TAU;

/// Heights in a file are rounded to this, mm.
const GRAIN: f64 = 0.01;
/// Less than this is rounding and no climb, mm.
const LEAST: f64 = 0.02;

impl Bead {
    /// The bead that an operation lays, from above: its height is the usual step from layer to layer, or what a spiral
    /// climbs in a turn, and its width what the extruded volume then asks for. Where the file does not tell, it is
    /// that of `otherwise`.
    pub fn estimated(operation: &AdditiveOperation<'_>, otherwise: Self) -> Self {
        let process = operation.process_data();
        let length: f64 = deposits(process).map(|index| process.step_distance[index]).sum();
        let height = layer_step(process).or_else(|| turn_rise(process)).unwrap_or(otherwise.height);
        let width = operation.volume() / length / height;
        let width = if width > 0.0 && width.is_finite() { width } else { otherwise.width };
        Self { width, height, shape: Shape::Rectangle, density: otherwise.density }
    }
}

fn deposits(process: &ProcessData) -> impl Iterator<Item = usize> {
    (0..process.len()).filter(|&index| process.action[index] == Action::Deposit)
}

fn rounded(height: f64) -> f64 {
    (height / GRAIN).round() * GRAIN
}

/// The median step between the heights at which something flat is laid.
fn layer_step(process: &ProcessData) -> Option<f64> {
    let mut heights: Vec<f64> = deposits(process)
        .filter(|&index| process.start(index)[2] == process.at[2][index])
        .map(|index| process.at[2][index])
        .collect();
    // Most deposits have the height of the one before.
    heights.dedup();
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|above, below| *above - *below < LEAST);
    let mut steps: Vec<f64> = heights.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied().map(rounded)
}

/// What the first turn that climbs rises: from its start to where it comes nearest to being above it.
fn turn_rise(process: &ProcessData) -> Option<f64> {
    let mut turned = 0.0;
    let mut before: Option<[f64; 3]> = None;
    let mut first: Option<[f64; 3]> = None;
    let mut nearest: Option<(f64, f64)> = None;
    for index in deposits(process) {
        let (from, to) = (process.start(index), process.end(index));
        let by = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        if by[2] <= 0.0 && first.is_none() {
            continue;
        }
        let start = *first.get_or_insert(from);
        turned += match (process.arc(index), before) {
            (Some(arc), _) => arc.sweep,
            (None, Some(last)) => {
                libm::atan2(last[0] * by[1] - last[1] * by[0], last[0] * by[0] + last[1] * by[1])
            }
            (None, None) => 0.0,
        };
        // A wall with waves turns back and forth; it is round again about when it has turned once.
        if turned.abs() > 1.25 * TAU {
            break;
        }
        let apart = libm::hypot(to[0] - start[0], to[1] - start[1]);
        if turned.abs() > 0.75 * TAU && nearest.is_none_or(|(least, _)| apart < least) {
            nearest = Some((apart, to[2] - start[2]));
        }
        before = (by[0] != 0.0 || by[1] != 0.0).then_some(by);
    }
    nearest.map(|(_, rise)| rounded(rise)).filter(|&rise| rise >= LEAST)
}
