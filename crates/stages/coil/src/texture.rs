//! Waves in the wall.

use crate::track::{Track, point};
use skein::Ring;
use std::f64::consts::TAU;

/// Waves around one turn.
#[derive(Clone, Copy, Debug)]
pub struct Waves {
    /// How far the wall swings to either side, in microns.
    pub height: f64,
    /// How many there are.
    pub count: u32,
    /// How far they are turned, as a share of a wave.
    pub phase: f64,
}

/// Places on each wave; enough that nobody sees the corners.
const PLACES: u32 = 16;

impl Waves {
    /// The ring with waves across it, counted from a length along it; its own corners stay corners.
    pub fn across(self, track: &Track, from: f64) -> Ring {
        let round = track.length();
        let step = round / f64::from(self.count * PLACES);
        let places = crate::track::divided(&track.way(from, round), step);
        let mut at = 0.0;
        let mut points = Vec::with_capacity(places.len());
        for pair in places.windows(2) {
            let swing = self.height * libm::sin(TAU * (at / round * f64::from(self.count) + self.phase));
            // The way around the place, not the side it is on, says what is across: so corners swing, too.
            let (before, behind) = (track.at(from + at - step), track.at(from + at + step));
            let along = [behind[0] - before[0], behind[1] - before[1]];
            let length = libm::hypot(along[0], along[1]).max(1.0);
            points.push(point([
                pair[0][0] + along[1] / length * swing,
                pair[0][1] - along[0] / length * swing,
            ]));
            at += crate::track::distance(pair[0], pair[1]);
        }
        points.dedup();
        Ring(points)
    }
}
