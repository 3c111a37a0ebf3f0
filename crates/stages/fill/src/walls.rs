//! Inner walls, the gaps between walls, and walls that face each other too closely.

use crate::Fill;
use crate::source::Source;
use crate::strand::{Strand, share, spacing};
use shape::plane::{Offset, all_simplified, facing, offset, offset_with_loss, thin_parts};
use skein::{Feature, Ratio, Ring};

/// A wall keeps no corner nearer to a straight line than half a hundredth of a bead.
const FINENESS: f64 = 200.0;

/// Lays the walls of a layer and gives the region in which the middles of infill beads may go.
pub fn lay(source: &Source, fill: &Fill, solid: bool, strands: &mut Vec<Strand>) -> Vec<Ring> {
    let step = spacing(&source.bead);
    let overlap = fill.overlap.f64() * step;
    if fill.walls == 0 {
        // Infill up to the outline; the flank of an infill bead ends there like that of a wall would.
        return if overlap > 0.0 { offset(&source.edges, overlap) } else { source.edges.clone() };
    }
    let mut wall = source.edges.clone();
    let mut level = 0;
    loop {
        let next = offset_with_loss(&wall, -step);
        level += 1;
        let last = level == fill.walls || next.rings.is_empty();
        // Where the next wall fits everywhere, nothing is too narrow for this one.
        let narrow = next.lost >= step;
        let room = if last || narrow { offset_with_loss(&wall, -step / 2.0) } else { Offset::default() };
        if narrow && (!last || solid) {
            fill_gaps(&room.rings, &next, step, source, strands);
        }
        let flows =
            if room.lost >= step { relief(&wall, step, source) } else { vec![Vec::new(); wall.len()] };
        let feature = if level == 1 { Feature::Edge } else { Feature::Loop };
        for (ring, flows) in wall.into_iter().zip(flows) {
            strands.push(Strand { flows, ..Strand::wall(feature, ring) });
        }
        if last {
            return if overlap > 0.0 { offset(&room.rings, overlap - step / 2.0) } else { next.rings };
        }
        wall = all_simplified(&next.rings, step / FINENESS);
    }
}

/// The flow of walls whose neighbours across are nearer than a bead: the two share the room between them.
fn relief(wall: &[Ring], step: f64, source: &Source) -> Vec<Vec<Ratio>> {
    facing(wall, step)
        .into_iter()
        .map(|ring| {
            ring.into_iter()
                // Half of the room between the middles, and the other half of the bead on its far side.
                .map(|gap| gap.map_or(Ratio::ONE, |gap| share(&source.bead, (gap + step) / 2.0)))
                .collect()
        })
        .collect()
}

/// Lays beads on the middle of what is too narrow for the next wall.
fn fill_gaps(room: &[Ring], next: &Offset, step: f64, source: &Source, strands: &mut Vec<Strand>) {
    for line in thin_parts(room, next, step) {
        // A gap narrower than a quarter of a bead closes by itself when the clay is pressed.
        if line.widths.iter().any(|width| *width >= step / 4.0) {
            strands.push(Strand::middle(line, &source.bead));
        }
    }
}
