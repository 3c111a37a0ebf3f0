#![doc = include_str!("../README.md")]

use shape::plane::{crossing, islands, offset, united};
use skein::{
    Error, Facts, Layer, Line, Mark, Micron, Notes, Point3, Ratio, Ring, Settings, Skein, Stage, Tag,
    boundary,
};

#[cfg(test)]
mod tests;

/// Moves the outside of a part outwards where a hole comes too near to it.
#[derive(Clone, Debug, Settings)]
pub struct Widen {
    /// How much clay there is at least between a hole and the outside. With 2 a wall fits around the hole and one around
    /// the part; more makes the place stronger and the bulge larger.
    #[setting(default = 2.0, min = 1.0, max = 10.0, unit = "beads")]
    pub least_wall: Ratio,
}

impl Stage for Widen {
    const NAME: &'static str = "widen";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        skein.rewrite(notes, |index, layer, notes| self.layer(index, layer, &facts, notes))
    }
}

impl Widen {
    fn layer(
        &self,
        index: usize,
        layer: Layer,
        facts: &Facts,
        notes: &mut Notes,
    ) -> Result<Vec<Line>, Error> {
        let reach = self.least_wall.f64() * facts.bead_width()?.um();
        match widened(&boundary(&layer.lines), reach) {
            Some(outlines) => {
                notes.layer(index, "the outside is wider than drawn where a hole comes near to it");
                let z = layer.z();
                Ok(with_outlines(layer.lines, &outlines, z))
            }
            None => Ok(layer.lines),
        }
    }
}

/// The outlines with `reach` microns of clay around every hole; `None` when that is so already.
///
/// Holes stay as they are, and so does an island that stands in one: there is no room around it.
fn widened(outlines: &[Ring], reach: f64) -> Option<Vec<Ring>> {
    if outlines.iter().all(|outline| outline.area2() > 0) {
        return None;
    }
    let encloses = |outer: &Ring, other: &Ring| {
        outer != other && other.0.first().is_some_and(|point| outer.contains(*point))
    };
    let (mut wide, mut still): (Vec<Ring>, Vec<Ring>) = (Vec::new(), Vec::new());
    for mut island in islands(outlines) {
        let holes = island.split_off(1);
        let Some(outside) = island.pop() else { continue };
        let guards: Vec<Ring> = if holes.is_empty()
            || outlines.iter().any(|outer| outer.area2() > 0 && encloses(outer, &outside))
        {
            Vec::new()
        } else {
            let guards = holes.iter().flat_map(|hole| offset(&[hole.clone().reversed()], reach));
            guards.filter(|guard| stands_out(guard, &outside)).collect()
        };
        if guards.is_empty() { &mut still } else { &mut wide }.push(outside);
        wide.extend(guards);
    }
    if wide.is_empty() {
        return None;
    }
    // A neighbour that the wider outside runs into becomes one with it.
    let grown = united(&wide);
    let met = |outer: &Ring| {
        let pair = |ring: &Ring| {
            ring.area2() > 0 && (encloses(ring, outer) || crossing(&[ring.clone(), outer.clone()]))
        };
        grown.iter().any(pair) && !outlines.iter().any(|other| other.area2() > 0 && encloses(other, outer))
    };
    let (met, still): (Vec<Ring>, Vec<Ring>) = still.into_iter().partition(met);
    let grown = if met.is_empty() { grown } else { united(&[wide, met].concat()) };
    let holes = outlines.iter().filter(|outline| outline.area2() <= 0).cloned();
    Some(holes.chain(still).chain(grown).collect())
}

/// Whether any of a guard lies outside an outline.
fn stands_out(guard: &Ring, outside: &Ring) -> bool {
    guard.0.first().is_some_and(|point| !outside.contains(*point))
        || crossing(&[guard.clone(), outside.clone()])
}

/// A layer's lines with other outlines, where the first of the old ones stood; every other line stays.
fn with_outlines(lines: Vec<Line>, outlines: &[Ring], z: Micron) -> Vec<Line> {
    let blocks = outlines.iter().flat_map(|outline| {
        let point = move |point: &skein::Point| {
            Line::Point(Mark::Boundary, Point3 { x: point.x, y: point.y, z: z.0 })
        };
        [Line::Open(Tag::NestedRing), Line::Open(Tag::BoundaryPerimeter)]
            .into_iter()
            .chain(outline.0.iter().map(point))
            .chain([Line::Close(Tag::BoundaryPerimeter), Line::Close(Tag::NestedRing)])
    });
    let mut blocks = Some(blocks);
    let mut out = Vec::with_capacity(lines.len());
    for line in lines {
        match line {
            Line::Open(Tag::NestedRing | Tag::BoundaryPerimeter) => {
                out.extend(blocks.take().into_iter().flatten())
            }
            Line::Close(Tag::NestedRing | Tag::BoundaryPerimeter) | Line::Point(Mark::Boundary, _) => {}
            other => out.push(other),
        }
    }
    out
}
