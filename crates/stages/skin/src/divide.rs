//! One bead as several finer ones with the same clay.

use shape::plane::offset;
use skein::{Move, Point, Point3, Ratio, Ring, Stretch, Thread};

/// Into how many beads.
#[derive(Clone, Copy)]
pub(crate) struct Division {
    /// One upon the other.
    pub(crate) vertical: u32,
    /// Side by side.
    pub(crate) horizontal: u32,
    /// What is left out at each end of a closed one, in microns.
    pub(crate) clip: f64,
}

/// No more of a bead than this share is left out at either end.
const MOST: f64 = 0.3;

/// The finer beads of a level thread: for each height, from the lowest up, those side by side; and whether it was divided
/// as was asked. Height and width of the whole bead are in microns.
pub(crate) fn divided(
    thread: &Thread,
    division: Division,
    height: i32,
    width: f64,
) -> (Vec<Vec<Thread>>, bool) {
    let side_by_side =
        if division.horizontal > 1 { beside(thread, division.horizontal, width) } else { None };
    let as_asked = division.horizontal == 1 || side_by_side.is_some();
    let mut beads = side_by_side.unwrap_or_else(|| vec![thread.clone()]);
    for bead in &mut beads {
        let length = bead.length();
        let cut = division.clip.min(MOST * length);
        if cut > 0.0 && bead.is_closed() {
            *bead = bead.clone().split(length - cut).0.split(cut).1;
        }
    }
    let count = division.vertical;
    let at = |number: u32| {
        let below = i64::from(height) * i64::from(count - number) / i64::from(count);
        let z = thread.start.z.saturating_sub(i32::try_from(below).unwrap_or(0));
        beads.iter().map(|bead| flat(bead, z, 1.0 / f64::from(count))).collect()
    };
    ((1..=count).map(at).collect(), as_asked)
}

/// A thread at another height with a share of its flow.
fn flat(thread: &Thread, z: i32, share: f64) -> Thread {
    let mut thread = thread.clone();
    thread.start.z = z;
    for piece in &mut thread.stretches {
        piece.step.to.z = z;
        piece.flow = times(piece.flow, share);
    }
    thread
}

fn times(flow: Ratio, share: f64) -> Ratio {
    Ratio::from_f64(flow.f64() * share).unwrap_or(flow)
}

/// A closed thread as several side by side, which together have its clay: a loop outside is longer than one inside.
/// Nothing when it is open, or too narrow for one of them.
fn beside(thread: &Thread, count: u32, width: f64) -> Option<Vec<Thread>> {
    if !thread.is_closed() {
        return None;
    }
    let first = thread.stretches.first()?;
    let corner = |at: Point3| Point::new(at.x, at.y);
    let ring = Ring(thread.stretches.iter().map(|piece| corner(piece.step.to)).collect());
    let turned = ring.area2() < 0;
    let region = [if turned { ring.reversed() } else { ring }];
    let mut loops = Vec::new();
    for number in 0..count {
        let share = (f64::from(number) + 0.5) / f64::from(count) - 0.5;
        let rings = offset(&region, share * width);
        if rings.is_empty() {
            return None;
        }
        loops.extend(rings.into_iter().map(|ring| if turned { ring.reversed() } else { ring }));
    }
    let clay: f64 = thread.pieces().map(|(from, piece)| piece.step.length(from) * piece.flow.f64()).sum();
    let flow = Ratio::from_f64(clay / loops.iter().map(Ring::length).sum::<f64>())?;
    let laid = |ring: Ring| {
        // The seam stays where it was.
        let near = (0..ring.0.len()).min_by_key(|index| ring.0[*index].distance2(corner(thread.start)));
        let mut points = ring.0;
        points.rotate_left(near.unwrap_or(0));
        let place = |at: &Point| Point3 { x: at.x, y: at.y, z: thread.start.z };
        let start = points.first().map_or(thread.start, place);
        let ends = points.iter().skip(1).chain(points.first());
        let step = |at| Stretch { step: Move { feed: first.step.feed, ..Move::to(place(at)) }, flow };
        Thread { start, stretches: ends.map(step).collect() }
    };
    Some(loops.into_iter().map(laid).collect())
}
