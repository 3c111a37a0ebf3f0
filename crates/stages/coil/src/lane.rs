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

use crate::track::{Spot, Track};

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
