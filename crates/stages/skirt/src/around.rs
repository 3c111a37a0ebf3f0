//! What a skirt goes around.

use crate::hull::hull;
use shape::plane::boolean::positive;
use skein::{Error, Facts, Feature, Layer, Micron, Nozzle, Point, Point3, Ring, boundary};

/// The outer outlines of the part on a layer.
pub(crate) fn outers(layer: &Layer) -> Vec<Ring> {
    outsides(boundary(&layer.lines))
}

/// The rings around clay, without those around holes.
pub(crate) fn outsides(mut rings: Vec<Ring>) -> Vec<Ring> {
    rings.retain(|ring| ring.area2() > 0);
    rings
}

/// Everything that lies on some layers: the part, and the beads of its raft and its support, which have no outlines.
pub(crate) fn obstacles(layers: &[Layer], facts: &Facts) -> Result<Vec<Ring>, Error> {
    let mut rings = Vec::new();
    for layer in layers {
        rings.extend(outers(layer));
        let bead = facts.bead()?.of_height(layer.height(facts)?);
        let mut nozzle = Nozzle::default();
        for line in &layer.lines {
            let from = nozzle.at;
            nozzle.follow(line);
            let built = nozzle.on && matches!(nozzle.feature, Feature::Raft | Feature::Support);
            if let (true, Some(from), Some(step)) = (built, from, line.as_move()) {
                let width = bead.section.width(bead.area() * nozzle.flow.f64(), bead.height.mm());
                rings.extend(around(from, step.to, Micron::from_mm(width).unwrap_or(bead.width)));
            }
        }
    }
    Ok(rings)
}

/// The rectangle that a bead covers.
fn around(from: Point3, to: Point3, width: Micron) -> Option<Ring> {
    let (x, y) = (f64::from(to.x) - f64::from(from.x), f64::from(to.y) - f64::from(from.y));
    let length = (x * x + y * y).sqrt();
    if length == 0.0 {
        return None;
    }
    let half = width.um() / 2.0 / length;
    let (along, across) = ((x * half, y * half), (-y * half, x * half));
    let corner = |at: Point3, ahead: f64, aside: f64| {
        let nearest = |value: f64| (value + 0.5f64.copysign(value)) as i32;
        Point::new(
            nearest(f64::from(at.x) + along.0 * ahead + across.0 * aside),
            nearest(f64::from(at.y) + along.1 * ahead + across.1 * aside),
        )
    };
    Some(Ring(vec![
        corner(from, -1.0, -1.0),
        corner(to, 1.0, -1.0),
        corner(to, 1.0, 1.0),
        corner(from, -1.0, 1.0),
    ]))
}

/// What the lines of the skirt keep their distance from.
pub(crate) fn base(obstacles: Vec<Ring>, convex: bool) -> Vec<Ring> {
    if convex {
        hull(obstacles.into_iter().flat_map(|ring| ring.0).collect()).into_iter().collect()
    } else {
        outsides(positive(&obstacles))
    }
}
