//! What a skirt goes around.

use crate::hull::hull;
use shape::plane::boolean::positive;
use skein::{Error, Facts, Feature, Layer, Nozzle, Point, Point3, Ring, boundary};

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
            let built = nozzle.on && matches!(nozzle.feature(), Feature::Raft | Feature::Support);
            if let (true, Some(from), Some(step)) = (built, from, line.as_move()) {
                let width = bead.section.width(bead.area() * nozzle.flow.f64(), bead.height.mm()) * 1000.0;
                let flat = |at: Point3| Point::new(at.x, at.y);
                rings.extend(Ring::around(flat(from), flat(step.to), width / 2.0));
            }
        }
    }
    Ok(rings)
}

/// What the lines of the skirt keep their distance from.
pub(crate) fn base(obstacles: Vec<Ring>, convex: bool) -> Vec<Ring> {
    if convex {
        hull(obstacles.into_iter().flat_map(|ring| ring.0).collect()).into_iter().collect()
    } else {
        outsides(positive(&obstacles))
    }
}
