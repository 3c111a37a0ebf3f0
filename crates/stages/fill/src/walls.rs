//! Inner walls, the gaps between walls, and walls that face each other too closely.

use crate::Fill;
use crate::source::Source;
use crate::strand::{Strand, share, spacing};
use shape::plane::{Offset, all_simplified, dab, facing, offset, offset_with_loss, thin_parts};
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
        strands.extend(laid(wall, &room, feature, step, source));
        if last {
            return if overlap > 0.0 { offset(&room.rings, overlap - step / 2.0) } else { next.rings };
        }
        wall = all_simplified(&next.rings, step / FINENESS);
    }
}

/// Walls with as much clay on each stretch as there is room. `inside` is what they enclose, half a bead from their middles.
pub fn laid(
    wall: Vec<Ring>,
    inside: &Offset,
    feature: fn(Side) -> Feature,
    step: f64,
    source: &Source,
) -> Vec<Strand> {
    if inside.lost < step && !has_small(&wall, step) {
        wall.into_iter().map(|ring| Strand::wall(feature, ring)).collect()
    } else {
        relieved(wall, inside, feature, step, source)
    }
}

/// Whether a ring is so small that nothing of it need turn inside out for it to be too narrow.
fn has_small(rings: &[Ring], step: f64) -> bool {
    rings.iter().any(|ring| ring.length() < 4.0 * step)
}

/// Walls of which some have a neighbour across that is nearer than a bead: the two share the room between them.
fn relieved(
    wall: Vec<Ring>,
    room: &Offset,
    feature: fn(Side) -> Feature,
    step: f64,
    source: &Source,
) -> Vec<Strand> {
    let gaps = facing(&wall, step);
    let holds = |ring: &Ring, other: &Ring| other.0.first().is_some_and(|point| ring.contains(*point));
    let mut strands = Vec::with_capacity(wall.len());
    for (index, gaps) in gaps.into_iter().enumerate() {
        let ring = &wall[index];
        // Half of the room between the middles, and the other half of the bead on its far side.
        let mut widths: Vec<f64> =
            gaps.iter().map(|gap| gap.map_or(step, |gap| (gap + step) / 2.0)).collect();
        let others = wall.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, other)| other);
        let alone =
            Side::of(ring) == Side::Outer && !others.chain(&room.rings).any(|other| holds(ring, other));
        if alone {
            // Nothing fits inside this wall: what it encloses and half a bead around is all its own.
            let part = offset(std::slice::from_ref(ring), step / 2.0);
            if ring.length() < step {
                strands.extend(dab(&part).map(|line| Strand::middle(line, &source.bead)));
                continue;
            }
            let covered: f64 =
                ring.segments().zip(&widths).map(|((from, to), width)| from.distance(to) * width).sum();
            let share = part.iter().map(Ring::area).sum::<f64>() * 1e6 / covered;
            widths.iter_mut().for_each(|width| *width *= share.clamp(0.7, 3.0));
        }
        let flows = widths.into_iter().map(|width| share(&source.bead, width)).collect();
        strands.push(Strand { flows, ..Strand::wall(feature, ring.clone()) });
    }
    strands
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
