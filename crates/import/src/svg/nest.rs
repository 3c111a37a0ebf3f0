//! The shapes of a layer become its loops.

use shape::plane::boolean::{difference, even_odd, positive};
use shape::plane::crossing;
use shape::{Point, Ring};

/// What of the bed a shape covers.
pub(super) struct Shape {
    pub(super) rings: Vec<Ring>,
    /// The drawing says that it is cut out.
    pub(super) hole: bool,
}

/// Comparing every shape with every other must end some time.
const MOST: usize = 4_000;

/// Whether there are more shapes than are compared with each other.
pub(super) fn too_many(shapes: &[Shape]) -> bool {
    shapes.len() > MOST && !shapes.iter().any(|shape| shape.hole)
}

/// The loops of a layer: counter-clockwise around clay, clockwise around holes.
///
/// Where the drawing says which shapes are holes, they are cut out of the others. Where it does not, shapes that cross
/// each other are one, and one that lies within another is a hole in it, in which a third is an island again: drawings
/// have their holes painted over as often as left open.
pub(super) fn loops(shapes: Vec<Shape>) -> Vec<Ring> {
    let rings_of =
        |shapes: &[&Shape]| shapes.iter().flat_map(|shape| shape.rings.clone()).collect::<Vec<_>>();
    let (holes, others): (Vec<&Shape>, Vec<&Shape>) = shapes.iter().partition(|shape| shape.hole);
    if !holes.is_empty() {
        return difference(&rings_of(&others), &rings_of(&holes));
    }
    if too_many(&shapes) {
        return positive(&rings_of(&others));
    }
    let mut regions: Vec<Vec<Ring>> =
        shapes.into_iter().map(|shape| shape.rings).filter(|rings| !rings.is_empty()).collect();
    // What is drawn twice in the same place is there once.
    regions.sort_unstable_by(|one, other| compared(one).cmp(compared(other)));
    regions.dedup();
    let groups = united(&regions);
    if groups.len() < 2 {
        return groups.into_iter().flatten().collect();
    }
    even_odd(&groups.concat())
}

fn compared(rings: &[Ring]) -> impl Iterator<Item = &Vec<Point>> {
    rings.iter().map(|ring| &ring.0)
}

/// Shapes that cross each other, directly or by others, made one.
fn united(regions: &[Vec<Ring>]) -> Vec<Vec<Ring>> {
    let boxes: Vec<(Point, Point)> = regions.iter().map(|rings| bounds(rings)).collect();
    let mut group: Vec<usize> = (0..regions.len()).collect();
    for (later, region) in regions.iter().enumerate() {
        for earlier in 0..later {
            let (one, other) = (root(&mut group, earlier), root(&mut group, later));
            if one != other && meet(boxes[earlier], boxes[later]) {
                let both: Vec<Ring> = regions[earlier].iter().chain(region).cloned().collect();
                if crossing(&both) {
                    group[one.max(other)] = one.min(other);
                }
            }
        }
    }
    let mut groups: Vec<Vec<Ring>> = vec![Vec::new(); regions.len()];
    for (index, region) in regions.iter().enumerate() {
        let root = root(&mut group, index);
        groups[root].extend(region.iter().cloned());
    }
    groups.retain(|rings| !rings.is_empty());
    groups.into_iter().map(|rings| positive(&rings)).collect()
}

/// The least shape of a group; the way there is made shorter.
fn root(group: &mut [usize], mut index: usize) -> usize {
    while group[index] != index {
        group[index] = group[group[index]];
        index = group[index];
    }
    index
}

fn bounds(rings: &[Ring]) -> (Point, Point) {
    let boxes = rings.iter().filter_map(Ring::bounds);
    boxes
        .reduce(|(low, high), (other_low, other_high)| {
            (
                Point::new(low.x.min(other_low.x), low.y.min(other_low.y)),
                Point::new(high.x.max(other_high.x), high.y.max(other_high.y)),
            )
        })
        .unwrap_or_default()
}

fn meet((low, high): (Point, Point), (other_low, other_high): (Point, Point)) -> bool {
    low.x <= other_high.x && other_low.x <= high.x && low.y <= other_high.y && other_low.y <= high.y
}
