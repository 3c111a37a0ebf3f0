//! A layer of the base: one thread from the rim to the middle, or from the middle to the rim.

use crate::track::{Spot, Track};
use shape::plane::offset;
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
        let region = std::slice::from_ref(outermost);
        let depth = depth(region, wanted / 50.0);
        let count = (depth / wanted + 0.5).round().max(1.0);
        // The innermost ring lies half a pitch around the middle, so it closes it.
        let pitch = depth / (count - 0.5);
        let mut tracks = vec![Track::new(outermost)?];
        for ring in 1..count as usize {
            match offset(region, -pitch * ring as f64).as_slice() {
                [inner] => tracks.push(Track::new(inner)?),
                _ => return None,
            }
        }
        Some(Self { tracks, pitch })
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

/// How deep the middle of a region lies inside, to a precision: where what is left of it vanishes.
fn depth(region: &[Ring], precision: f64) -> f64 {
    let area: f64 = region.iter().map(|ring| ring.area() * 1e6).sum();
    // No circle inside is larger than the region.
    let (mut low, mut high) = (0.0, (area.max(0.0) / std::f64::consts::PI).sqrt() + precision);
    while high - low > precision {
        let middle = f64::midpoint(low, high);
        if offset(region, -middle).is_empty() { high = middle } else { low = middle }
    }
    low
}
