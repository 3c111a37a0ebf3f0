//! Chains of a section become closed, oriented loops.

use crate::gaps::{Joined, joined};
use shape::plane::boolean::{nonzero, positive};
use shape::plane::{all_simplified, crossing, offset, simplified, united};
use shape::solid::Chain;
use shape::{Point, Ring};
use skein::Notes;
use std::cmp::Reverse;

/// How chains become loops.
#[derive(Clone, Copy, Debug)]
pub struct How {
    /// The widest gap that is closed with a straight line, in microns.
    pub close_gaps: f64,
    /// How near to a straight side a corner must be to be dropped, in microns.
    pub tolerance: f64,
    /// How thick the wall is that is laid along the chains, in microns; none when they are the outline of a solid.
    pub wall: Option<f64>,
}

/// The loops of a layer.
#[derive(Default)]
pub struct Layer {
    /// Counter-clockwise around clay, larger first.
    pub loops: Vec<Ring>,
    /// Whether the outlines of shells cross.
    pub crossed: bool,
    /// The length in microns of the chains that could not be closed.
    pub lost: f64,
    /// What is to be said.
    pub notes: Notes,
}

/// Closes, simplifies and orients the chains of a layer.
///
/// What is clay is said by the sense of the loops: inside as many counter-clockwise loops as clockwise ones there is
/// none, anywhere else there is. The outermost loop of an island is an outline whatever its sense, so a part that is
/// inside out slices the same. Where loops cross, shells overlap, and their union is taken.
pub fn of_chains(chains: Vec<Chain>, how: How, layer: usize) -> Layer {
    let mut done = Layer::default();
    if let Some(width) = how.wall {
        done.loops = ordered(walls(&chains, width, how.tolerance));
        return done;
    }
    let (closed, open): (Vec<Chain>, Vec<Chain>) = chains.into_iter().partition(|chain| chain.closed);
    let mut rings: Vec<Ring> = closed.into_iter().map(|chain| Ring(chain.points)).collect();
    let was_open = !open.is_empty();
    if was_open {
        let Joined { rings: joined, lost } = joined(open, how.close_gaps, layer, &mut done.notes);
        rings.extend(joined);
        done.lost = lost;
    }
    let rings: Vec<Ring> = rings.into_iter().filter_map(|ring| smooth(ring, how.tolerance)).collect();
    done.crossed = crossing(&rings);
    if done.crossed {
        done.notes.layer(layer, "shells of the part overlap or touch; they are printed as one");
    }
    let meet = done.crossed || was_open && rings.len() > 1;
    done.loops = if meet { ordered(nonzero(&rings)) } else { nested(rings) };
    done
}

/// The loops of a drawn layer: counter-clockwise around clay already.
pub fn of_rings(rings: &[Ring], tolerance: f64) -> Vec<Ring> {
    let rings = all_simplified(rings, tolerance);
    ordered(if crossing(&rings) { positive(&rings) } else { rings })
}

/// The ring simplified. One that encloses nothing is none, unless it crosses itself so that its sides cancel.
fn smooth(ring: Ring, tolerance: f64) -> Option<Ring> {
    simplified(&ring, tolerance)
        .or_else(|| (ring.0.len() > 3 && crossing(std::slice::from_ref(&ring))).then_some(ring))
}

/// The room that walls take which have the chains in their middle.
fn walls(chains: &[Chain], width: f64, tolerance: f64) -> Vec<Ring> {
    let mut bands = Vec::new();
    for chain in chains {
        if chain.closed {
            let Some(ring) = simplified(&Ring(chain.points.clone()), tolerance) else { continue };
            let ring = [if ring.area2() < 0 { ring.reversed() } else { ring }];
            bands.extend(offset(&ring, width / 2.0));
            bands.extend(offset(&ring, -width / 2.0).into_iter().map(Ring::reversed));
        } else {
            // There and back again is an outline around nothing; set out by half the width it is the wall.
            let back = chain.points.iter().rev().skip(1).take(chain.points.len().saturating_sub(2));
            let both: Vec<Point> = chain.points.iter().chain(back).copied().collect();
            bands.extend(offset(&[Ring(both)], width / 2.0));
        }
    }
    if crossing(&bands) { united(&bands) } else { bands }
}

fn from_least(mut ring: Ring) -> Ring {
    if let Some(least) = (0..ring.0.len()).min_by_key(|index| ring.0[*index]) {
        ring.0.rotate_left(least);
    }
    ring
}

/// Larger first, each from its least point, those of one size sorted by it: so the order of the triangles in the file
/// does not matter.
fn ordered(rings: Vec<Ring>) -> Vec<Ring> {
    let mut rings: Vec<Ring> = rings.into_iter().filter(|ring| ring.area2() != 0).map(from_least).collect();
    rings.sort_by_cached_key(|ring| (Reverse(ring.area2().unsigned_abs()), ring.0.first().copied()));
    rings
}

/// [`ordered`], and only those with clay on one side, each turned so that it is on the left. They do not touch.
fn nested(rings: Vec<Ring>) -> Vec<Ring> {
    let rings = ordered(rings);
    let boxes: Vec<(Point, Point)> = rings.iter().map(|ring| ring.bounds().unwrap_or_default()).collect();
    let senses: Vec<i32> = rings.iter().map(|ring| if ring.area2() > 0 { 1 } else { -1 }).collect();
    // For each loop whether there is clay outside and inside.
    let sides: Vec<(bool, bool)> = (0..rings.len())
        .map(|index| {
            let Some(leftmost) = rings[index].0.iter().min() else { return (false, false) };
            // Only a larger loop can hold it.
            let around = (0..index).filter(|other| {
                let (low, high) = boxes[*other];
                (low.x..=high.x).contains(&leftmost.x)
                    && (low.y..=high.y).contains(&leftmost.y)
                    && rings[*other].contains(*leftmost)
            });
            let outside: i32 = around.map(|other| senses[other]).sum();
            (outside != 0, outside + senses[index] != 0)
        })
        .collect();
    let kept = rings.into_iter().zip(sides).filter(|(_, (outside, inside))| outside != inside);
    kept.map(|(ring, (_, inside))| if (ring.area2() > 0) == inside { ring } else { ring.reversed() })
        .collect()
}
