//! Inner walls, the gaps between walls, and walls that face each other too closely.

use crate::Fill;
use crate::source::Source;
use crate::strand::{Strand, share, spacing};
use shape::plane::{facing, offset, thin_parts};
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
        let room = offset(&wall, -step / 2.0);
        let next = offset(&room, -step / 2.0);
        let flows = relief(&wall, &room, step, source);
        let feature = if level == 0 { Feature::Edge } else { Feature::Loop };
        for (ring, flows) in wall.into_iter().zip(flows) {
            strands.push(Strand { flows, ..Strand::wall(feature, ring) });
        }
        level += 1;
        let last = level == fill.walls;
        let mut filled = 0.0;
        if !last || solid {
            filled = fill_gaps(&room, &next, step, source, strands);
        }
        if last || next.is_empty() {
            let inside = if overlap > 0.0 { offset(&room, overlap - step / 2.0) } else { next };
            return Walls { room, filled, inside };
        }
        wall = next;
    }
}

/// The flow of walls whose neighbours across are nearer than a bead: the two share the room between them.
fn relief(wall: &[Ring], room: &[Ring], step: f64, source: &Source) -> Vec<Vec<Ratio>> {
    let area = |rings: &[Ring]| rings.iter().map(Ring::area).sum::<f64>();
    let missing = area(wall) - area(&offset(room, step / 2.0));
    // Less than a tenth of a bead's square is a blunted corner.
    if missing < (step / 1000.0).powi(2) / 10.0 {
        return vec![Vec::new(); wall.len()];
    }
    let gaps = facing(wall, step);
    gaps.into_iter()
        .map(|ring| {
            ring.into_iter()
                // Half of the room between the middles, and the other half of the bead on its far side.
                .map(|gap| gap.map_or(Ratio::ONE, |gap| share(&source.bead, (gap + step) / 2.0)))
                .collect()
        })
        .collect()
}

/// Lays beads on the middle of what is too narrow for the next wall; gives their area in mm².
fn fill_gaps(room: &[Ring], next: &[Ring], step: f64, source: &Source, strands: &mut Vec<Strand>) -> f64 {
    let (lines, _) = thin_parts(room, next, step);
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
