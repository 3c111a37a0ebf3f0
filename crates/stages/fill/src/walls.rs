//! Inner walls, the gaps between walls, and walls that face each other too closely.

use crate::Fill;
use crate::source::Source;
use crate::strand::{Strand, share, spacing};
use shape::plane::{Offset, all_simplified, facing, offset, offset_with_loss, thin_parts};
use skein::{Feature, Ratio, Ring};

/// What the walls leave for the infill.
pub struct Walls {
    /// The room inside the innermost wall, up to its flank.
    pub room: Vec<Ring>,
    /// The area in mm² of the beads that fill gaps in that room where no infill fits.
    pub filled: f64,
    /// Where the middles of infill beads may go.
    pub inside: Vec<Ring>,
}

/// A wall keeps no corner nearer to a straight line than half a hundredth of a bead.
const FINENESS: f64 = 200.0;

/// Lays the walls of a layer.
pub fn of(source: &Source, fill: &Fill, solid: bool, strands: &mut Vec<Strand>) -> Walls {
    let step = spacing(&source.bead);
    let overlap = fill.overlap.f64() * step;
    if fill.walls == 0 {
        // Infill up to the outline; the flank of an infill bead ends there like that of a wall would.
        let inside = if overlap > 0.0 { offset(&source.edges, overlap) } else { source.edges.clone() };
        return Walls { room: source.outlines.clone(), filled: 0.0, inside };
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
        let mut filled = 0.0;
        if narrow && (!last || solid) {
            filled = fill_gaps(&room.rings, &next, step, source, strands);
        }
        let flows =
            if room.lost >= step { relief(&wall, step, source) } else { vec![Vec::new(); wall.len()] };
        let feature = if level == 1 { Feature::Edge } else { Feature::Loop };
        for (ring, flows) in wall.into_iter().zip(flows) {
            strands.push(Strand { flows, ..Strand::wall(feature, ring) });
        }
        if last {
            let inside = if overlap > 0.0 { offset(&room.rings, overlap - step / 2.0) } else { next.rings };
            return Walls { room: room.rings, filled, inside };
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

/// Lays beads on the middle of what is too narrow for the next wall; gives their area in mm².
fn fill_gaps(room: &[Ring], next: &Offset, step: f64, source: &Source, strands: &mut Vec<Strand>) -> f64 {
    let lines = thin_parts(room, next, step);
    let mut filled = 0.0;
    for line in lines {
        // A gap narrower than a quarter of a bead closes by itself when the clay is pressed.
        if line.widths.iter().all(|width| *width < step / 4.0) {
            continue;
        }
        let strand = Strand::middle(line, &source.bead);
        let stretches = strand.points.windows(2).zip(&strand.flows);
        filled +=
            stretches.map(|(pair, flow)| pair[0].distance(pair[1]) * flow.f64()).sum::<f64>() * step / 1e6;
        strands.push(strand);
    }
    filled
}
