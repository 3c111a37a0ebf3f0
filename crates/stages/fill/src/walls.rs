//! Inner walls, the gaps between walls, and walls that face each other too closely.

use crate::Fill;
use crate::source::Source;
use crate::strand::{Strand, spacing};
use crate::widths::{self, TAKEN_UP};
use shape::plane::{Offset, all_simplified, dab, offset, offset_with_loss, thin_parts};
use skein::{Feature, Ring, Side};

/// A wall keeps no corner nearer to a straight line than half a hundredth of a bead.
pub const FINENESS: f64 = 200.0;

/// Lays the walls of a layer and gives the region in which the middles of infill beads may go.
pub fn lay(source: &Source, fill: &Fill, walls: u32, solid: bool, strands: &mut Vec<Strand>) -> Vec<Ring> {
    let step = spacing(&source.bead);
    let overlap = fill.overlap.f64() * step;
    if walls == 0 {
        // Infill up to the outline; the flank of an infill bead ends there like that of a wall would.
        return if overlap > 0.0 { offset(&source.edges, overlap) } else { source.edges.clone() };
    }
    let mut wall = source.edges.clone();
    let mut level = 0;
    loop {
        let next = offset_with_loss(&wall, -step);
        level += 1;
        let last = level == walls || next.rings.is_empty();
        // Where the next wall fits everywhere, nothing is too narrow for this one.
        let narrow = next.lost >= step || has_small(&wall, step);
        let wanted = narrow || (last && overlap > 0.0);
        let room = if wanted { offset_with_loss(&wall, -step / 2.0) } else { Offset::default() };
        if narrow && (!last || solid) {
            fill_gaps(&room.rings, &next, step, source, strands);
        }
        let feature = if level == 1 { Feature::Edge } else { Feature::Loop };
        if narrow {
            strands.extend(laid(wall, &room.rings, feature, TAKEN_UP, step, source));
        } else {
            strands.extend(wall.into_iter().map(|ring| Strand::wall(feature, ring)));
        }
        if last {
            return if overlap > 0.0 { offset(&room.rings, overlap - step / 2.0) } else { next.rings };
        }
        wall = all_simplified(&next.rings, step / FINENESS);
    }
}

/// Walls with as much clay on each stretch as there is room. `inside` is what they enclose, half a bead from their middles;
/// `taken_up` is the widest gap between two of them, in beads, that they take up themselves.
pub fn laid(
    wall: Vec<Ring>,
    inside: &[Ring],
    feature: fn(Side) -> Feature,
    taken_up: f64,
    step: f64,
    source: &Source,
) -> Vec<Strand> {
    let fitted = widths::fitted(&wall, (1.0 + taken_up) * step - ROUNDING, step);
    let holds = |ring: &Ring, other: &Ring| other.0.first().is_some_and(|point| ring.contains(*point));
    let mut strands = Vec::with_capacity(wall.len());
    for (index, fitted) in fitted.into_iter().enumerate() {
        let ring = &wall[index];
        let Some(mut fitted) = fitted else {
            strands.push(Strand::wall(feature, ring.clone()));
            continue;
        };
        let others = wall.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, other)| other);
        let alone = Side::of(ring) == Side::Outer && !others.chain(inside).any(|other| holds(ring, other));
        if alone {
            // Nothing fits inside this wall: what it encloses and half a bead around is all its own.
            let part = offset(std::slice::from_ref(ring), step / 2.0);
            if ring.length() < step {
                strands.extend(dab(&part, step).map(|line| Strand::middle(line, &source.bead)));
                continue;
            }
            let area = part.iter().map(Ring::area).sum::<f64>() * 1e6;
            fitted.scale((area / fitted.area()).clamp(LEAST, MOST));
        }
        let (points, flows) = fitted.into_stretches(&source.bead, step / FINENESS);
        strands.push(Strand { feature: feature(Side::of(ring)), points, flows, closed: true });
    }
    strands
}

/// What is as wide as the widest gap that walls take up must get a bead, whatever is lost in whole microns.
const ROUNDING: f64 = 2.0;

/// How much more or less clay than its width a wall that has a room for itself takes to fill it.
const LEAST: f64 = 0.7;
const MOST: f64 = 3.0;

/// Whether a ring is so small that nothing of it need turn inside out for it to be too narrow.
pub fn has_small(rings: &[Ring], step: f64) -> bool {
    rings.iter().any(|ring| ring.length() < 4.0 * step)
}

/// Lays beads on the middle of what is too narrow for the next wall and too wide for the walls beside it to take up.
fn fill_gaps(room: &[Ring], next: &Offset, step: f64, source: &Source, strands: &mut Vec<Strand>) {
    for line in thin_parts(room, next, step) {
        let wide = line.wider_than(TAKEN_UP * step - ROUNDING);
        strands.extend(wide.into_iter().map(|line| Strand::middle(line, &source.bead)));
    }
}
