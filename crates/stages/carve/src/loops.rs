//! Chains of a section become closed, oriented loops.

use shape::plane::{crossing, simplified, united};
use shape::solid::Chain;
use shape::{Point, Ring};
use skein::Notes;
use std::cmp::Reverse;

/// Closes, simplifies and orients the chains of a layer: counter-clockwise around clay, larger loops first.
///
/// Loops that do not cross are oriented by how many others they lie in, whatever the triangles say, so a part that is
/// inside out slices the same. Where loops cross, shells overlap, and their union by the triangles' own sense is
/// taken.
pub fn of_chains(
    chains: Vec<Chain>,
    close_gaps: f64,
    tolerance: f64,
    layer: usize,
    notes: &mut Notes,
) -> Vec<Ring> {
    let (closed, open): (Vec<Chain>, Vec<Chain>) = chains.into_iter().partition(|chain| chain.closed);
    let mut rings: Vec<Ring> = closed.into_iter().map(|chain| Ring(chain.points)).collect();
    if !open.is_empty() {
        rings.extend(joined(open, close_gaps, layer, notes));
    }
    let rings: Vec<Ring> = rings.iter().filter_map(|ring| simplified(ring, tolerance)).collect();
    if crossing(&rings) {
        let sum: i128 = rings.iter().map(Ring::area2).sum();
        let outwards: Vec<Ring> =
            if sum < 0 { rings.into_iter().map(Ring::reversed).collect() } else { rings };
        notes.layer(layer, "shells of the part overlap; they are printed as one");
        return nested(united(&outwards));
    }
    nested(rings)
}

/// Joins open chains end to start, the narrowest gap first, and closes each with a straight line.
///
/// A chain that would have to be closed across more than `limit` microns and more than a third of its own length is
/// no outline of a solid; it is reported and left out.
fn joined(mut chains: Vec<Chain>, limit: f64, layer: usize, notes: &mut Notes) -> Vec<Ring> {
    let mut rings = Vec::new();
    let ends = |chain: &Chain| Some((*chain.points.first()?, *chain.points.last()?));
    chains.retain(|chain| chain.points.len() > 1);
    chains.sort_by(|one, other| one.points.cmp(&other.points));
    while !chains.is_empty() {
        let mut best = (f64::INFINITY, 0, 0);
        for (from, one) in chains.iter().enumerate() {
            for (to, other) in chains.iter().enumerate() {
                if let (Some((_, end)), Some((start, _))) = (ends(one), ends(other)) {
                    let gap = end.distance(start);
                    // Joining two is worth as much as closing one, so equal gaps are closed.
                    if gap < best.0 || (gap == best.0 && from == to) {
                        best = (gap, from, to);
                    }
                }
            }
        }
        let (gap, from, to) = best;
        let spot = chains[from].points.last().copied().unwrap_or_default();
        let length: f64 =
            [from, to].iter().map(|index| length_of(&chains[*index])).fold(f64::INFINITY, f64::min);
        if gap > limit.max(length / 3.0) {
            notes.spot(
                layer,
                spot,
                "the mesh is open and the gap too wide to close; that part of the outline is left out",
            );
            chains.remove(from);
            continue;
        }
        if from == to {
            notes.spot(
                layer,
                spot,
                "the mesh is open; the gap in the outline is closed with a straight line",
            );
            rings.push(Ring(chains.remove(from).points));
        } else {
            let tail = chains[to].points.clone();
            chains[from].points.extend(tail);
            chains.remove(to);
        }
    }
    rings
}

fn from_least(mut ring: Ring) -> Ring {
    if let Some(least) = (0..ring.0.len()).min_by_key(|index| ring.0[*index]) {
        ring.0.rotate_left(least);
    }
    ring
}

fn length_of(chain: &Chain) -> f64 {
    chain.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// Larger first, each turned by how many others it lies in.
///
/// Each begins at its least point and loops of one size are sorted by it, so that the order of the triangles in the
/// file does not matter.
fn nested(rings: Vec<Ring>) -> Vec<Ring> {
    let mut rings: Vec<Ring> = rings.into_iter().filter(|ring| ring.area2() != 0).map(from_least).collect();
    rings.sort_by_cached_key(|ring| (Reverse(ring.area2().unsigned_abs()), ring.0.first().copied()));
    let boxes: Vec<(Point, Point)> = rings.iter().map(|ring| ring.bounds().unwrap_or_default()).collect();
    let holes: Vec<bool> = (0..rings.len())
        .map(|index| {
            let Some(leftmost) = rings[index].0.iter().min() else { return false };
            // Only a larger loop can hold it.
            let around = (0..index).filter(|other| {
                let (low, high) = boxes[*other];
                (low.x..=high.x).contains(&leftmost.x)
                    && (low.y..=high.y).contains(&leftmost.y)
                    && rings[*other].contains(*leftmost)
            });
            around.count() % 2 == 1
        })
        .collect();
    let turned = |(ring, hole): (Ring, bool)| if (ring.area2() < 0) == hole { ring } else { ring.reversed() };
    rings.into_iter().zip(holes).map(turned).collect()
}
