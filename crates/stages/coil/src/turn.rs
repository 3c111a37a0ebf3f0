//! One turn of the spiral: from the outline below, blended into the one above as it goes round.

use crate::lane::Lane;
use crate::track::{Spot, between, distance};

/// The way of one turn.
#[derive(Clone, Debug)]
pub struct Turn {
    /// Its corners; it begins on the lane below and ends on the one above, at the seam.
    pub way: Vec<Spot>,
    /// How far the lane above lies from the one below at most, and where.
    pub reach: (f64, Spot),
}

impl Turn {
    /// A turn that stays on one lane.
    pub fn flat(lane: &Lane) -> Self {
        Self { way: lane.whole(), reach: (0.0, lane.start()) }
    }

    /// A turn from one lane to the next; no piece of either is matched in steps longer than this.
    pub fn blended(below: &Lane, above: &Lane, step: f64) -> Self {
        let mut pairs: Vec<(Spot, Spot)> = Vec::new();
        for (below, above) in below.arcs.iter().zip(&above.arcs) {
            matched(&divided(below, step), &divided(above, step), &mut pairs);
        }
        pairs.push((below.start(), above.start()));
        let mut so_far = 0.0;
        let mut lengths = vec![0.0];
        lengths.extend(pairs.windows(2).map(|pair| {
            so_far += distance(pair[0].0, pair[1].0) + distance(pair[0].1, pair[1].1);
            so_far
        }));
        let mut reach = (0.0, above.start());
        for (below, above) in &pairs {
            let far = distance(*below, *above);
            if far > reach.0 {
                reach = (far, *above);
            }
        }
        let way = pairs.iter().zip(&lengths).map(|(pair, at)| between(pair.0, pair.1, at / so_far)).collect();
        Self { way, reach }
    }

    /// The same turn without the corners that a straight side passes near enough.
    pub fn thinned(mut self, tolerance: f64) -> Self {
        self.way = thinned(&self.way, tolerance);
        self
    }
}

/// Places of two ways that belong together, in the order of both: of the two next steps, always the one that leaves the
/// two places nearer to each other (Christiansen and Sederberg 1978 for the surface between two outlines).
///
/// Corners find corners, lobes find lobes, and a place never finds one that lies before that of an earlier place.
fn matched(below: &[Spot], above: &[Spot], pairs: &mut Vec<(Spot, Spot)>) {
    let (mut low, mut high) = (0, 0);
    loop {
        let (Some(a), Some(b)) = (below.get(low), above.get(high)) else { return };
        pairs.push((*a, *b));
        match (below.get(low + 1), above.get(high + 1)) {
            (Some(next_a), Some(next_b)) => {
                let both = distance(*next_a, *next_b);
                let (one, other) = (distance(*next_a, *b), distance(*a, *next_b));
                if both <= one && both <= other {
                    low += 1;
                    high += 1;
                } else if one <= other {
                    low += 1;
                } else {
                    high += 1;
                }
            }
            (Some(_), None) => low += 1,
            (None, Some(_)) => high += 1,
            (None, None) => return,
        }
    }
}

/// The way with more corners, so that no side is longer than a step.
pub fn divided(way: &[Spot], step: f64) -> Vec<Spot> {
    let mut fine = Vec::with_capacity(way.len() * 2);
    fine.extend(way.first());
    for side in way.windows(2) {
        let parts = (distance(side[0], side[1]) / step).ceil().max(1.0);
        fine.extend((1..parts as usize).map(|part| between(side[0], side[1], part as f64 / parts)));
        fine.push(side[1]);
    }
    fine
}

/// The most corners that one straight side stands for; it bounds the work.
const MOST: usize = 24;

/// The way without corners that a straight side passes within a tolerance; both ends stay.
fn thinned(way: &[Spot], tolerance: f64) -> Vec<Spot> {
    let Some(first) = way.first() else { return Vec::new() };
    let mut kept = vec![*first];
    let mut anchor = 0;
    for next in 2..way.len() {
        let passes = |corner: &Spot| gap(way[anchor], way[next], *corner) <= tolerance;
        if next - anchor > MOST || !way[anchor + 1..next].iter().all(passes) {
            anchor = next - 1;
            kept.push(way[anchor]);
        }
    }
    if way.len() > 1 {
        kept.extend(way.last());
    }
    kept
}

/// How far a place is from a straight side.
fn gap(from: Spot, to: Spot, place: Spot) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    if square == 0.0 {
        return distance(from, place);
    }
    let dot = (place[0] - from[0]) * along[0] + (place[1] - from[1]) * along[1];
    distance(between(from, to, (dot / square).clamp(0.0, 1.0)), place)
}
