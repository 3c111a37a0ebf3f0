//! A layer of the base: one thread from the rim to the middle, or from the middle to the rim.

use crate::track::{Spot, Track};
use shape::plane::{offset, simplified};
use skein::Ring;

/// The rings of a base layer, the outermost first, evenly spread so that the last one closes the middle.
#[derive(Clone, Debug)]
pub struct Rings {
    tracks: Vec<Track>,
    /// How far apart they lie, in microns.
    pub pitch: f64,
}

impl Rings {
    /// The rings inside the outermost, about so far apart; `None` when they do not lie one inside the other down to one
    /// middle.
    pub fn inside(outermost: &Ring, wanted: f64) -> Option<Self> {
        let tolerance = wanted / FINENESS;
        let coarse = nested(&simplified(outermost, tolerance)?, wanted, usize::MAX, tolerance)?;
        let innermost = coarse.last().unwrap_or(outermost);
        let depth = wanted * (coarse.len() as f64 - 1.0) + depth(innermost, wanted, tolerance);
        let count = (depth / wanted + 0.5).round().max(1.0);
        // The innermost ring lies half a pitch around the middle, so it closes it.
        let pitch = depth / (count - 0.5);
        let rings = nested(outermost, pitch, count as usize, tolerance)?;
        let tracks = rings.iter().filter_map(Track::new).collect::<Vec<_>>();
        (tracks.len() == count as usize).then_some(Self { tracks, pitch })
    }

    /// The thread that ends next to a place: on the outermost ring when it runs outwards, else in the middle.
    ///
    /// It goes along each ring until it is one pitch short of where it came onto it, and there straight to the next, so
    /// that neither rings nor links lie nearer to each other than a pitch. It is made from its end to its start.
    pub fn thread(&self, end: Spot, outwards: bool) -> Vec<Spot> {
        let mut way: Vec<Spot> = Vec::new();
        let inwards = self.tracks.iter();
        let order: Vec<&Track> = if outwards { inwards.collect() } else { inwards.rev().collect() };
        for track in order {
            let at = track.nearest(way.last().copied().unwrap_or(end));
            let length = (track.length() - self.pitch).max(track.length() / 2.0);
            way.extend(track.way(at, -length));
        }
        way.reverse();
        way
    }
}

/// Rings of the base keep no corner nearer to a straight line than this share of their distance: each is made from the
/// one around it, and what they need not follow costs no work.
const FINENESS: f64 = 100.0;

/// Rings one inside the other, so far apart, the given one first, until there is room for none or there are as many as
/// wanted; `None` where one falls apart.
fn nested(outermost: &Ring, pitch: f64, most: usize, tolerance: f64) -> Option<Vec<Ring>> {
    let mut rings = vec![outermost.clone()];
    while rings.len() < most {
        let mut inner = offset(&rings[rings.len() - 1..], -pitch);
        match (inner.pop(), inner.pop()) {
            (None, _) => break,
            (Some(ring), None) => rings.push(simplified(&ring, tolerance).unwrap_or(ring)),
            _ => return None,
        }
    }
    Some(rings)
}

/// How deep the middle of a ring lies inside it, at most so deep, to a precision: where what is left of it vanishes.
fn depth(ring: &Ring, most: f64, precision: f64) -> f64 {
    let (mut low, mut high) = (0.0, most);
    while high - low > precision {
        let middle = f64::midpoint(low, high);
        if offset(std::slice::from_ref(ring), -middle).is_empty() { high = middle } else { low = middle }
    }
    low
}
