//! In which order a layer's strands are laid, and where each begins.

use crate::source::Source;
use crate::strand::{Island, Strand};
use crate::{Fill, Start, ThreadSequence};
use shape::plane::Boxes;
use skein::{Feature, Point, Ring};

/// Puts every layer in order, each starting from where the one before ended.
pub fn layers(layers: Vec<Vec<Island>>, sources: &[Source], fill: &Fill) -> Vec<Vec<Island>> {
    let mut here = fill.seam;
    let sequence = |index| if index == 0 { fill.first_layer_sequence } else { fill.thread_sequence };
    layers
        .into_iter()
        .zip(sources)
        .enumerate()
        .map(|(index, (islands, source))| {
            if fill.start == Start::LowerLeft {
                here = lower_left(&source.outlines).unwrap_or(here);
            }
            layer(islands, fill, sequence(index), &mut here)
        })
        .collect()
}

/// The corner with the least x + y; of several the lowest.
fn lower_left(outlines: &[Ring]) -> Option<Point> {
    let corners = outlines.iter().flat_map(|outline| outline.0.iter().copied());
    corners.min_by_key(|corner| (i64::from(corner.x) + i64::from(corner.y), corner.y))
}

/// Nearest islands first; those on which nothing is laid last, for their outlines are part of the layer all the same.
fn layer(islands: Vec<Island>, fill: &Fill, sequence: ThreadSequence, here: &mut Point) -> Vec<Island> {
    let mut ordered = Vec::with_capacity(islands.len());
    let (islands, bare): (Vec<Island>, Vec<Island>) =
        islands.into_iter().partition(|island| !island.strands.is_empty());
    let bounds = |island: &Island| bounds(island.strands.iter().flat_map(|strand| &strand.points));
    let mut left = Boxes::new(islands.iter().map(bounds).collect());
    let mut islands: Vec<Option<Island>> = islands.into_iter().map(Some).collect();
    while let Some(nearest) = left.nearest((*here, *here)) {
        left.take(nearest);
        ordered.extend(islands[nearest].take().map(|island| order_island(island, fill, sequence, here)));
    }
    ordered.extend(bare.into_iter().filter(|island| !island.outlines.is_empty()));
    ordered
}

fn distance2_to_box(from: Point, (low, high): (Point, Point)) -> i64 {
    let nearest = Point::new(from.x.clamp(low.x, high.x), from.y.clamp(low.y, high.y));
    from.distance2(nearest)
}

/// The kinds of strand in the order of a thread sequence. Beads on the middle of gaps between walls go with the inner
/// walls.
fn turns(sequence: ThreadSequence) -> [Turn; 3] {
    use Turn::{Infill, Loops, Perimeter};
    match sequence {
        ThreadSequence::LoopsPerimeterInfill => [Loops, Perimeter, Infill],
        ThreadSequence::LoopsInfillPerimeter => [Loops, Infill, Perimeter],
        ThreadSequence::InfillLoopsPerimeter => [Infill, Loops, Perimeter],
        ThreadSequence::InfillPerimeterLoops => [Infill, Perimeter, Loops],
        ThreadSequence::PerimeterLoopsInfill => [Perimeter, Loops, Infill],
        ThreadSequence::PerimeterInfillLoops => [Perimeter, Infill, Loops],
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Turn {
    Loops,
    Perimeter,
    Infill,
}

impl Turn {
    fn of(feature: Feature) -> Self {
        match feature {
            Feature::Edge(_) => Self::Perimeter,
            Feature::Loop(_) | Feature::Middle => Self::Loops,
            Feature::Infill | Feature::Skirt | Feature::Support | Feature::Raft => Self::Infill,
        }
    }
}

fn order_island(island: Island, fill: &Fill, sequence: ThreadSequence, here: &mut Point) -> Island {
    let mut left: Vec<(Strand, (Point, Point))> = island
        .strands
        .into_iter()
        .map(|strand| {
            let bounds = bounds(&strand.points);
            (strand, bounds)
        })
        .collect();
    let mut strands = Vec::with_capacity(left.len());
    for turn in turns(sequence) {
        loop {
            // The nearest place where a strand of this turn may begin. Of most strands the box is too far away already.
            let mut best: Option<(i64, usize, usize)> = None;
            for (index, (strand, bounds)) in left.iter().enumerate() {
                let far = best.is_some_and(|(least, ..)| distance2_to_box(*here, *bounds) >= least);
                if far || Turn::of(strand.feature) != turn {
                    continue;
                }
                let (gap, at) = nearest_start(strand, *here);
                if best.is_none_or(|(least, ..)| gap < least) {
                    best = Some((gap, index, at));
                }
            }
            let Some((_, index, at)) = best else { break };
            let (mut strand, _) = left.swap_remove(index);
            if strand.closed {
                let at = if fill.start == Start::Seam { nearest_start(&strand, fill.seam).1 } else { at };
                begin_at(&mut strand, at);
            } else if at > 0 {
                strand.reverse();
            }
            let end = if strand.closed { strand.points.first() } else { strand.points.last() };
            *here = end.copied().unwrap_or(*here);
            strands.push(strand);
        }
    }
    Island { strands, ..island }
}

/// The box around points.
fn bounds<'a>(points: impl IntoIterator<Item = &'a Point>) -> (Point, Point) {
    let nothing = (Point::new(i32::MAX, i32::MAX), Point::new(i32::MIN, i32::MIN));
    points.into_iter().fold(nothing, |(low, high), point| {
        (
            Point::new(low.x.min(point.x), low.y.min(point.y)),
            Point::new(high.x.max(point.x), high.y.max(point.y)),
        )
    })
}

/// How far it is to where a strand can begin, squared, and the index of that point: any corner of a closed strand,
/// either end of an open one.
fn nearest_start(strand: &Strand, from: Point) -> (i64, usize) {
    let last = strand.points.len() - 1;
    let starts: &mut dyn Iterator<Item = usize> =
        if strand.closed { &mut (0..=last) } else { &mut [0, last].into_iter() };
    starts.map(|index| (from.distance2(strand.points[index]), index)).min().unwrap_or((i64::MAX, 0))
}

/// Turns a closed strand so that it begins at one of its corners.
fn begin_at(strand: &mut Strand, corner: usize) {
    strand.points.rotate_left(corner);
    if strand.flows.len() == strand.points.len() {
        strand.flows.rotate_left(corner);
    }
}
