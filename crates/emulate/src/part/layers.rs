//! Which deposit belongs to which layer.

use super::{Segment, SegmentKind};
use crate::process::{Action, ProcessData};

/// Two heights this near are one, mm.
const SAME_HEIGHT: f64 = 1e-3;
/// Or this part of the height of a bead.
const SAME_PART: f64 = 0.25;
/// What rounding may take from a whole number of layers.
const ROUNDING: f64 = 1e-9;

/// The layer of every step.
///
/// If every deposit keeps its height, heights that lie near to each other are one layer. If one climbs, as a spiral
/// does, a layer is one height of a bead, counted from the lowest deposit.
pub(super) struct Partition {
    /// Layers of the steps; what deposits nothing has that of the next deposit.
    pub(super) layers: Vec<u32>,
    pub(super) count: usize,
}

impl Partition {
    pub(super) fn new(process: &ProcessData, normal: [f64; 3], bead_height: f64) -> Self {
        let tolerance = SAME_HEIGHT.max(SAME_PART * bead_height);
        let height = |index: usize| {
            let (from, to) = (process.start(index), process.end(index));
            (0..3).map(|axis| normal[axis] * 0.5 * (from[axis] + to[axis])).sum::<f64>()
        };
        let runs = runs(process, height);
        let lowest = runs.iter().map(|run| run.low).fold(f64::INFINITY, f64::min);
        let mut partition = if runs.iter().all(|run| run.high - run.low < tolerance) {
            Self::of_flat_runs(process.len(), &runs, tolerance)
        } else {
            let layer = |index: usize| ((height(index) - lowest) / bead_height + ROUNDING).floor() as u32;
            let mut layers = vec![NONE; process.len()];
            for index in (0..process.len()).filter(|&index| process.action[index] == Action::Deposit) {
                layers[index] = layer(index);
            }
            let mut partition = Self { layers, count: 0 };
            partition.close_gaps();
            partition
        };
        partition.hand_to_travels();
        partition
    }

    fn of_flat_runs(steps: usize, runs: &[Run], tolerance: f64) -> Self {
        let mut order: Vec<usize> = (0..runs.len()).collect();
        order.sort_by(|&a, &b| runs[a].low.total_cmp(&runs[b].low));
        let mut layers = vec![NONE; steps];
        let mut layer = 0;
        for (rank, &run) in order.iter().enumerate() {
            if rank > 0 && runs[run].low - runs[order[rank - 1]].low > tolerance {
                layer += 1;
            }
            layers[runs[run].start..runs[run].end].fill(layer);
        }
        Self { layers, count: if runs.is_empty() { 0 } else { layer as usize + 1 } }
    }

    /// Layers without a deposit are left out of the count.
    fn close_gaps(&mut self) {
        let mut used: Vec<u32> = self.layers.iter().copied().filter(|&layer| layer != NONE).collect();
        used.sort_unstable();
        used.dedup();
        self.count = used.len();
        for layer in self.layers.iter_mut().filter(|layer| **layer != NONE) {
            *layer = used.partition_point(|&below| below < *layer) as u32;
        }
    }

    /// What lies between two deposits belongs to the second.
    fn hand_to_travels(&mut self) {
        let mut next = self.layers.iter().rev().copied().find(|&layer| layer != NONE).unwrap_or(0);
        for layer in self.layers.iter_mut().rev() {
            if *layer == NONE {
                *layer = next;
            }
            next = *layer;
        }
    }

    pub(super) fn layer(&self, index: usize) -> usize {
        self.layers[index] as usize
    }
}

const NONE: u32 = u32::MAX;

/// Deposits with nothing between.
struct Run {
    start: usize,
    end: usize,
    low: f64,
    high: f64,
}

fn runs(process: &ProcessData, height: impl Fn(usize) -> f64) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let mut open = false;
    for index in 0..process.len() {
        match SegmentKind::of(process.action[index]) {
            Some(SegmentKind::Deposition) => {
                let at = height(index);
                match runs.last_mut() {
                    Some(run) if open => {
                        run.end = index + 1;
                        run.low = run.low.min(at);
                        run.high = run.high.max(at);
                    }
                    _ => runs.push(Run { start: index, end: index + 1, low: at, high: at }),
                }
                open = true;
            }
            Some(_) => open = false,
            None => {}
        }
    }
    runs
}

/// What a layer is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Layer {
    /// When its first deposit begins, s.
    pub start_time: f64,
    /// How long it takes, s: from its first deposit to the first of another layer; the last until the end.
    pub time: f64,
    /// The way of its deposits, mm.
    pub deposition_length: f64,
    /// The way between, mm.
    pub travel_length: f64,
    /// How long its deposits take, s.
    pub deposition_time: f64,
    /// What it deposits by the machine's own count, mm³.
    pub volume: f64,
}

impl Layer {
    /// The mean speed of its deposits, mm/s.
    pub fn mean_speed(&self) -> f64 {
        if self.deposition_time > 0.0 { self.deposition_length / self.deposition_time } else { 0.0 }
    }
}

/// The layers of the rows of a summary.
pub(super) fn layers(process: &ProcessData, segments: &[Segment], count: usize) -> Vec<Layer> {
    let mut layers = vec![Layer::default(); count];
    let mut seen = vec![false; count];
    let mut current: Option<(usize, f64)> = None;
    for segment in segments {
        let Some(layer) = layers.get_mut(segment.layer) else { continue };
        match segment.kind {
            SegmentKind::Travel => layer.travel_length += segment.length,
            SegmentKind::Pause => {}
            SegmentKind::Deposition => {
                layer.deposition_length += segment.length;
                layer.deposition_time += segment.duration();
                layer.volume += segment.volume;
                if !std::mem::replace(&mut seen[segment.layer], true) {
                    layer.start_time = segment.start_time;
                }
                match current {
                    Some((same, _)) if same == segment.layer => {}
                    Some((before, since)) => {
                        layers[before].time += segment.start_time - since;
                        current = Some((segment.layer, segment.start_time));
                    }
                    None => current = Some((segment.layer, segment.start_time)),
                }
            }
        }
    }
    if let Some((last, since)) = current {
        layers[last].time += process.elapsed_time.last().copied().unwrap_or(since) - since;
    }
    layers
}

/// The rows of the summary, layer by layer, each in the order in which it is made.
pub(super) fn by_layer(segments: &[Segment], count: usize) -> Vec<usize> {
    let mut rows: Vec<usize> = if count == 0 { Vec::new() } else { (0..segments.len()).collect() };
    rows.sort_by_key(|&row| segments[row].layer);
    rows
}
