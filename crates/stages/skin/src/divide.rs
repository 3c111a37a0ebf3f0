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
    let side_by_side = match division.horizontal {
        1 => None,
        count if thread.is_closed() => beside(thread, count, width),
        count => around(thread, count, width),
    };
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

/// No bead is laid with more than this many times the share of the clay that is its own: it would bulge.
const FULLEST: f64 = 1.34;

/// A closed thread as several side by side, which together have its clay: a loop outside is longer than one inside.
/// Nothing when it is too narrow for one of them.
fn beside(thread: &Thread, count: u32, width: f64) -> Option<Vec<Thread>> {
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
    let flow = flow_of(thread, loops.iter().map(Ring::length).sum())?;
    Some(loops.into_iter().map(|ring| laid(ring, thread, flow)).collect())
}

/// An open thread as several side by side: two lie on either side of where it lay, as one that goes there and back, and
/// of three the third lies where it lay. Nothing when it is too short or turns too sharply for that.
fn around(thread: &Thread, count: u32, width: f64) -> Option<Vec<Thread>> {
    let mut loops = Vec::new();
    for number in count.div_ceil(2)..count {
        let reach = ((f64::from(number) + 0.5) / f64::from(count) - 0.5) * width;
        // The end of a bead goes no further than the bead did.
        let (head, _) = thread.clone().split(thread.length() - reach);
        let (_, inner) = head.split(reach);
        if inner.stretches.is_empty() {
            return None;
        }
        let there: Vec<Point> = std::iter::once(inner.start)
            .chain(inner.stretches.iter().map(|piece| piece.step.to))
            .map(corner)
            .collect();
        let back = there.iter().rev().skip(1).take(there.len().saturating_sub(2));
        let both = Ring(there.iter().chain(back).copied().collect());
        loops.extend(offset(&[both], reach));
    }
    let middle = (count % 2 == 1).then(|| thread.length());
    let length = loops.iter().map(Ring::length).sum::<f64>() + middle.unwrap_or(0.0);
    if length * FULLEST < f64::from(count) * thread.length() {
        return None;
    }
    let flow = flow_of(thread, length)?;
    let mut beads: Vec<Thread> = loops.into_iter().map(|ring| laid(ring, thread, flow)).collect();
    if middle.is_some() {
        let mut whole = thread.clone();
        whole.stretches.iter_mut().for_each(|piece| piece.flow = flow);
        beads.push(whole);
    }
    Some(beads)
}

fn corner(at: Point3) -> Point {
    Point::new(at.x, at.y)
}

/// The flow with which beads of a length together, in microns, have the clay of a thread.
fn flow_of(thread: &Thread, length: f64) -> Option<Ratio> {
    let clay: f64 = thread.pieces().map(|(from, piece)| piece.step.length(from) * piece.flow.f64()).sum();
    Ratio::from_f64(clay / length)
}

/// A ring laid in place of a thread: the seam stays where it was.
fn laid(ring: Ring, thread: &Thread, flow: Ratio) -> Thread {
    let near = (0..ring.0.len()).min_by_key(|index| ring.0[*index].distance2(corner(thread.start)));
    let mut points = ring.0;
    points.rotate_left(near.unwrap_or(0));
    let place = |at: &Point| Point3 { x: at.x, y: at.y, z: thread.start.z };
    let start = points.first().map_or(thread.start, place);
    let ends = points.iter().skip(1).chain(points.first());
    let feed = thread.stretches.first().and_then(|first| first.step.feed);
    let block = thread.stretches.first().and_then(|first| first.block);
    let step = |at| Stretch { step: Move { feed, ..Move::to(place(at)) }, flow, block };
    Thread { start, stretches: ends.map(step).collect() }
}
