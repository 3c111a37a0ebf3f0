//! Rings that follow the walls inwards, joined to threads from the inside out.

use crate::source::Source;
use crate::strand::{Strand, spacing};
use crate::walls::{self, FINENESS};
use shape::plane::{all_simplified, offset, offset_with_loss};
use skein::{Feature, Point, Ratio, Ring};

/// The longest joint from a ring to the next one out, in distances between rings: in a corner they are farther apart.
const REACH: f64 = 1.5;

/// Lays rings `apart` microns apart. The first lies as far from the wall, or from a surface's last bead, as from the next
/// ring.
pub fn lay(room: &[Ring], apart: f64, source: &Source, strands: &mut Vec<Strand>) {
    let step = spacing(&source.bead);
    let mut levels = Vec::new();
    let mut rings = offset(room, step - apart);
    while !rings.is_empty() {
        rings = all_simplified(&rings, step / FINENESS);
        let next = offset(&rings, -apart);
        let inside = offset_with_loss(&rings, -step / 2.0);
        let mut level = if inside.lost < step && !walls::has_small(&rings, step) {
            rings.into_iter().map(|ring| Strand::wall(|_| Feature::Infill, ring)).collect()
        } else {
            walls::laid(rings, &inside.rings, |_| Feature::Infill, 0.0, step, source)
        };
        level.iter_mut().for_each(|ring| ring.feature = Feature::Infill);
        level
            .retain(|ring| ring.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>() >= step);
        levels.push(level);
        rings = next;
    }
    // What lies between a ring and its nearest point on the next ring out is nearer to that than any place inside the ring:
    // the way there crosses nothing. From the outside in that is not so.
    let mut threads: Vec<Strand> = Vec::new();
    for mut level in levels.into_iter().rev() {
        let mut joined = vec![false; level.len()];
        for thread in threads {
            let end = if thread.closed { thread.points.first() } else { thread.points.last() };
            match end.and_then(|end| nearest(&level, *end)) {
                Some((distance, ring, place)) if distance <= REACH * apart && !joined[ring] => {
                    joined[ring] = true;
                    level[ring] = with_ring(thread, &level[ring], place);
                }
                _ => strands.push(thread),
            }
        }
        // A dab has no ring to go on from.
        let (rings, dabs): (Vec<_>, Vec<_>) =
            level.into_iter().zip(joined).partition(|(strand, joined)| strand.closed || *joined);
        strands.extend(dabs.into_iter().map(|(dab, _)| dab));
        threads = rings.into_iter().map(|(thread, _)| thread).collect();
    }
    strands.append(&mut threads);
}

/// A place on a ring: the side, and the point on it.
type Place = (usize, Point);

/// The closed strand that is nearest to a point: how far it is, which one, and where.
fn nearest(level: &[Strand], from: Point) -> Option<(f64, usize, Place)> {
    let mut best: Option<(f64, usize, Place)> = None;
    for (index, strand) in level.iter().enumerate().filter(|(_, strand)| strand.closed) {
        let ends = strand.points.iter().skip(1).chain(strand.points.first());
        for (side, (a, b)) in strand.points.iter().zip(ends).enumerate() {
            let ((x, y), (u, v)) = (a.delta(*b), a.delta(from));
            let length2 = (x * x + y * y) as f64;
            let share = if length2 > 0.0 { ((x * u + y * v) as f64 / length2).clamp(0.0, 1.0) } else { 0.0 };
            let along = |from: i32, way: i64| (f64::from(from) + share * way as f64).round() as i32;
            let place = Point::new(along(a.x, x), along(a.y, y));
            let distance = from.distance(place);
            if best.is_none_or(|(least, ..)| distance < least) {
                best = Some((distance, index, (side, place)));
            }
        }
    }
    best
}

/// A thread that goes on to a ring and once round it.
fn with_ring(thread: Strand, ring: &Strand, (side, place): Place) -> Strand {
    let flow = |strand: &Strand, stretch: usize| strand.flows.get(stretch).copied().unwrap_or(Ratio::ONE);
    let closing = thread.points.first().copied().filter(|_| thread.closed);
    let mut long = Strand { feature: thread.feature, points: Vec::new(), flows: Vec::new(), closed: false };
    let mut reach = |point: Point, flow: Ratio| {
        match long.points.last() {
            Some(last) if *last == point => return,
            Some(_) => long.flows.push(flow),
            None => {}
        }
        long.points.push(point);
    };
    for (index, point) in thread.points.iter().copied().chain(closing).enumerate() {
        reach(point, flow(&thread, index.saturating_sub(1)));
    }
    reach(place, Ratio::ONE);
    let count = ring.points.len();
    for step in 0..count {
        reach(ring.points[(side + 1 + step) % count], flow(ring, (side + step) % count));
    }
    reach(place, flow(ring, side));
    long
}
