//! How the layers and spirals of a whole file stand on each other.

use super::findings::Findings;
use super::limits::{LayerHeights, Limits};
use super::rule::Rule;
use crate::motion::EPSILON_Z;
use crate::report::{Model, Pitch, Run};

/// A height is as it should be within this share of a layer: files and machines round.
const TOLERANCE: f64 = 0.02;
/// A step of more than so many layers is a gap.
const GAP: f64 = 1.5;

/// After so many turns a spiral's pitch is known well, if it could be measured in such a share of them.
const FEWEST_TURNS: f64 = 2.0;
const SURE: f64 = 0.75;

/// A layer or a spiral.
struct Storey {
    index: usize,
    bottom: f64,
    top: f64,
    spiral: Option<Pitch>,
}

/// Judges the steps from each layer or spiral to the next. Returns how high a step usually is.
pub(crate) fn judge(
    machine: &Model,
    pitches: &[Pitch],
    limits: &Limits,
    findings: &mut Findings,
) -> Option<f64> {
    let storeys = storeys(machine, pitches);
    let usual = limits.layers.map(|layers| layers.rest).or_else(|| usual_step(&storeys));
    if let (Some(layers), Some(first)) = (limits.layers, storeys.first())
        && first.spiral.is_none()
        && (first.bottom - layers.first).abs() > TOLERANCE * layers.first + EPSILON_Z
    {
        findings.add(Rule::FirstLayer, first.index, Some(first.bottom), first.bottom);
    }
    for pair in storeys.windows(2) {
        if let [below, above] = pair {
            step(below, above, limits, usual, findings);
        }
    }
    for storey in &storeys {
        if let Some(pitch) = storey.spiral {
            climb(storey, &pitch, limits, findings);
        }
    }
    usual
}

/// Layers and spirals whose height is known, in the order of the file.
fn storeys(machine: &Model, pitches: &[Pitch]) -> Vec<Storey> {
    let layer = |run: &Run| {
        let height = run.height?;
        Some(Storey { index: run.start_index, bottom: height, top: height, spiral: None })
    };
    let spiral = |(run, pitch): (&Run, &Pitch)| {
        let bottom = run.height?;
        Some(Storey { index: run.start_index, bottom, top: pitch.top?, spiral: Some(*pitch) })
    };
    let spirals = machine.spirals.iter().zip(pitches).filter_map(spiral);
    let mut storeys: Vec<Storey> = machine.layers.iter().filter_map(layer).chain(spirals).collect();
    // Two sorted lists one behind the other: the sort only merges them.
    storeys.sort_by_key(|storey| storey.index);
    storeys
}

/// The middle one of all steps from layer to layer.
fn usual_step(storeys: &[Storey]) -> Option<f64> {
    let is_layer = |storey: &Storey| storey.spiral.is_none();
    let pairs = storeys.windows(2).filter(|pair| pair.iter().all(is_layer));
    let mut steps: Vec<f64> = pairs
        .filter_map(|pair| Some(pair.last()?.bottom - pair.first()?.top))
        .filter(|step| *step > EPSILON_Z)
        .collect();
    let middle = steps.len() / 2;
    (!steps.is_empty()).then(|| *steps.select_nth_unstable_by(middle, f64::total_cmp).1)
}

fn step(below: &Storey, above: &Storey, limits: &Limits, usual: Option<f64>, findings: &mut Findings) {
    let step = above.bottom - below.top;
    let at = Some(above.bottom);
    if step < -EPSILON_Z {
        findings.add(Rule::Descends, above.index, at, -step);
    }
    let Some(usual) = usual.filter(|_| step > EPSILON_Z) else { return };
    let is_off = (step - usual).abs() > TOLERANCE * usual + EPSILON_Z;
    if step > GAP * usual {
        findings.add(Rule::LayerGap, above.index, at, step);
    } else if limits.layers.is_some() && is_off && below.spiral.is_none() && above.spiral.is_none() {
        findings.add(Rule::LayerHeight, above.index, at, step);
    }
}

/// A spiral that rises as much as a layer in every turn is as it should be. In its first turns it may still come up from
/// the base.
fn climb(storey: &Storey, pitch: &Pitch, limits: &Limits, findings: &mut Findings) {
    let Some(rise) = pitch.rise else { return };
    let is_known = pitch.turns > FEWEST_TURNS && pitch.measured as f64 > SURE * pitch.turns;
    let is_off = |layers: LayerHeights| (rise - layers.rest).abs() > 0.1 * layers.rest;
    if let Some(steep) = pitch.steepest.filter(|steep| steep.rise > GAP * rise) {
        findings.add(Rule::SpiralPitch, steep.index, steep.height, steep.rise);
    } else if is_known && limits.layers.is_some_and(is_off) {
        findings.add(Rule::SpiralPitch, storey.index, Some(storey.bottom), rise);
    }
}
