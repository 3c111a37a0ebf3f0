//! The closed way of one turn: the beads of the wall, cut open at the seam and linked there, so that they are one loop.
//!
//! ```text
//! one bead       two beads            three beads
//!
//! ────┬────      ──┐ ┌──              ──┐ ┌───    outermost
//!                ──┘ └──              ──┘ │ ┌─
//!                                     ────┘ └─    innermost
//! ```
//!
//! The ends at a seam lie one bead apart and the links between them, too, so the plane is covered once: nothing is left
//! open at the seam, nothing lies double, and no bead crosses another.

use crate::source::MOST_BEADS;
use crate::track::{Spot, Track, between, distance, foot};

/// In the corner of a square a link is 1.8 times as long as along a straight wall, ...
const LONGEST_LINK: f64 = 2.0;

/// ... and the beads lie 0.69 beads from it at least: that much is allowed, and no tip that is much sharper.
const LEAST_ROOM: f64 = 0.6;

/// The closed way of one turn.
#[derive(Clone, Debug)]
pub struct Lane {
    /// A part for each bead of the wall, the outermost first, each behind the other. Straight links join them, and the
    /// last with the first.
    pub arcs: Vec<Vec<Spot>>,
}

impl Lane {
    /// The way along the beads of a wall, the outermost first, that lie so far apart; the seam is a length along the
    /// outermost. `None` when a bead is too short to be cut open.
    pub fn new(beads: &[Track], seam: f64, pitch: f64) -> Option<Self> {
        if beads.len() > 1 && beads.iter().any(|bead| bead.length() < 6.0 * pitch) {
            return None;
        }
        // Every bead is opened by as much, wherever the seam lies: in a corner the inner ones have less room beside it.
        let arcs = match beads {
            [only] => vec![only.way(seam, only.length())],
            [outer, inner] => {
                let middle = inner.nearest(outer.at(seam - pitch / 2.0));
                vec![
                    outer.way(seam, outer.length() - pitch),
                    inner.way(middle - pitch / 2.0, pitch - inner.length()),
                ]
            }
            [outer, middle, inner] => {
                let start = outer.at(seam);
                let (there, home) = (middle.nearest(start), inner.nearest(start));
                vec![
                    outer.way(seam, outer.length() - pitch),
                    middle.way(there - pitch, 2.0 * pitch - middle.length()),
                    inner.way(home + pitch, inner.length() - pitch),
                ]
            }
            _ => return None,
        };
        Some(Self { arcs })
    }

    /// The links that join its parts, and the last part with the first.
    pub fn links(&self) -> Links {
        let mut links = Links::default();
        let next = self.arcs.iter().cycle().skip(1);
        for (link, (arc, next)) in links.0.iter_mut().zip(self.arcs.iter().zip(next)) {
            *link = arc.last().copied().zip(next.first().copied());
        }
        links
    }

    /// Where it begins and ends.
    pub fn start(&self) -> Spot {
        self.arcs.first().and_then(|arc| arc.first()).copied().unwrap_or_default()
    }

    /// How many corners it has.
    pub fn corners(&self) -> usize {
        self.arcs.iter().map(Vec::len).sum()
    }

    /// The whole way, back to where it begins.
    pub fn whole(&self) -> Vec<Spot> {
        let mut way = self.arcs.concat();
        if way.last() != way.first() {
            way.push(self.start());
        }
        way
    }
}

/// The links of a lane at its seam, each from the end of a part to the start of the next.
#[derive(Clone, Copy, Debug, Default)]
pub struct Links([Option<(Spot, Spot)>; MOST_BEADS]);

impl Links {
    fn all(&self) -> impl DoubleEndedIterator<Item = (Spot, Spot)> + '_ {
        self.0.iter().copied().flatten()
    }

    /// Whether there is room for them where the beads lie so far apart: none is twice as long as between beads that run
    /// beside each other, and what another one joins lies no nearer to it than 0.6 beads.
    pub fn have_room(&self, pitch: f64) -> bool {
        let count = self.all().count();
        self.all().enumerate().all(|(index, link)| {
            let beads = if index + 1 == count { count - 1 } else { 1 };
            let others = self.all().enumerate().filter(|(other, _)| *other != index);
            distance(link.0, link.1) <= LONGEST_LINK * beads as f64 * pitch
                && others.flat_map(|(_, (from, to))| [from, to]).all(|at| off(at, link) >= LEAST_ROOM * pitch)
        })
    }

    /// How far the ends of these lie from the others at most: link from link.
    pub fn furthest_from(&self, others: &Self) -> f64 {
        let ends =
            self.all().zip(others.all()).flat_map(|(link, other)| [off(link.0, other), off(link.1, other)]);
        ends.fold(0.0, f64::max)
    }
}

/// How far a place lies from a link.
fn off(at: Spot, (from, to): (Spot, Spot)) -> f64 {
    distance(at, between(from, to, foot(from, to, at)))
}
