#![doc = include_str!("../README.md")]

mod exact;

#[cfg(test)]
mod tests;

use shape::plane::{MiddleLine, all_simplified, offset, offset_with_loss, thin_parts};
use skein::{
    Bead, Choice, Error, Facts, Feature, Layer, Line, Micron, Move, Notes, Point, Point3, Ratio, Ring,
    Settings, Side, Skein, Stage, Tag, boundary,
};

/// Lays the outermost wall half a bead inside the outline, and a single bead where the part is too thin for that.
#[derive(Clone, Debug, Settings)]
pub struct Inset {
    /// What becomes of parts thinner than a bead.
    #[setting(default = ThinWalls::Middle)]
    pub thin_walls: ThinWalls,
    /// The narrowest bead the nozzle can lay, as a share of the bead width. Parts thinner than that come out this wide.
    #[setting(default = 0.4, min = 0.1, max = 1.0)]
    pub least_width: Ratio,
    /// How near to each other the middles of two walls may come. Where a part leaves them less, one bead on its middle
    /// takes the place of both; 0 lays both as long as they fit, and fill lets them share the room.
    #[setting(default = 0.0, min = 0.0, max = 1.0, unit = "beads")]
    pub overlap_removal_width: Ratio,
    /// Which face of a part with only one bead comes out as drawn, when it lies between a hole and the outside.
    #[setting(default = ExactWall::Neither)]
    pub exact_wall: ExactWall,
    /// How wide a bead lies on a layer that bridges a gap, as a share of the nominal width: it is pulled thin, or sags.
    /// Its wall runs half of that inside the outline. How much clay it gets there says `speed.bridge_flow`.
    #[setting(default = 1.0, min = 0.3, max = 2.0)]
    pub bridge_width: Ratio,
}

/// Which face of a part with only one bead comes out as drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum ExactWall {
    /// The bead lies on the middle and misses both faces equally.
    Neither,
    /// The hole: what goes in there fits.
    Hole,
    /// The outside: what is seen is as drawn.
    Outside,
}

/// What becomes of parts thinner than a bead.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum ThinWalls {
    /// One bead on their middle, with as much clay as they are wide.
    Middle,
    /// They are left out and reported.
    Report,
}

impl Stage for Inset {
    const NAME: &'static str = "inset";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        skein.rewrite(notes, |index, layer, notes| self.layer(index, &layer, &facts, notes))
    }
}

impl Inset {
    fn layer(
        &self,
        index: usize,
        layer: &Layer,
        facts: &Facts,
        notes: &mut Notes,
    ) -> Result<Vec<Line>, Error> {
        let bead = facts.bead()?.of_height(layer.height(facts)?);
        let z = layer.nozzle_z(facts)?.0;
        let outlines = boundary(&layer.lines);
        let bridges = layer.lines.iter().any(|line| matches!(line, Line::Rotation(Tag::BridgeRotation, _)));
        let width = bead.width.um() * if bridges { self.bridge_width.f64() } else { 1.0 };
        // The narrowest part that has room for two walls.
        let apart = self.overlap_removal_width.f64() * width;
        let core = offset_with_loss(&outlines, -(width + apart) / 2.0);
        let mut middles = thin_parts(&outlines, &core, width + apart);
        for middle in &mut middles {
            exact::lay(middle, self.exact_wall, &outlines, width);
        }
        let walls = if apart > 0.0 { offset(&core.rings, apart / 2.0) } else { core.rings };
        let walls = all_simplified(&walls, width / FINENESS);
        let homes = homes(&outlines, &walls);
        let mut lines =
            Vec::with_capacity(layer.lines.len() + walls.iter().map(|wall| wall.0.len() + 6).sum::<usize>());
        let mut outline = 0;
        // The middles go last in the layer, inside whatever block closes it.
        for line in &layer.lines {
            match line {
                Line::Close(Tag::BoundaryPerimeter) => {
                    for (wall, _) in walls.iter().zip(&homes).filter(|(_, home)| **home == outline) {
                        loop_thread(wall, z, &mut lines);
                    }
                    outline += 1;
                }
                Line::Close(Tag::BridgeRotation | Tag::Layer)
                    if !middles.is_empty() && outline != usize::MAX =>
                {
                    self.middles(index, &middles, &bead, z, notes, &mut lines)?;
                    outline = usize::MAX;
                }
                _ => {}
            }
            lines.push(line.clone());
        }
        Ok(lines)
    }

    fn middles(
        &self,
        index: usize,
        middles: &[MiddleLine],
        bead: &Bead,
        z: i32,
        notes: &mut Notes,
        lines: &mut Vec<Line>,
    ) -> Result<(), Error> {
        for middle in middles {
            let spot = middle.points.first().copied().unwrap_or_default();
            if self.thin_walls == ThinWalls::Report {
                notes.spot(index, spot, "a part thinner than a bead is left out");
                continue;
            }
            let least = self.least_width.f64() * bead.width.um();
            if middle.widths.iter().any(|width| *width < least) {
                notes.spot(
                    index,
                    spot,
                    "a part is thinner than the narrowest bead and comes out wider than drawn",
                );
            }
            let (open, close) = Feature::Middle.tags();
            lines.push(open);
            middle_thread(middle, least, bead, z, lines)?;
            lines.push(close);
        }
        Ok(())
    }
}

/// A wall keeps no corner nearer to a straight line than half a hundredth of a bead.
const FINENESS: f64 = 200.0;

/// The outline that each wall belongs to: the smallest that holds it, or for the wall of a hole the hole inside it.
fn homes(outlines: &[Ring], walls: &[Ring]) -> Vec<usize> {
    if outlines.len() == 1 {
        return vec![0; walls.len()];
    }
    let boxes: Vec<(Point, Point)> =
        outlines.iter().map(|outline| outline.bounds().unwrap_or_default()).collect();
    // Smaller ones first, so that the first that fits is the smallest.
    let mut order: Vec<usize> = (0..outlines.len()).collect();
    order.sort_by_cached_key(|index| outlines[*index].area2().abs());
    let (outer, inner): (Vec<usize>, Vec<usize>) =
        order.into_iter().partition(|index| Side::of(&outlines[*index]) == Side::Outer);
    let inside = |point: Point, (low, high): (Point, Point)| {
        (low.x..=high.x).contains(&point.x) && (low.y..=high.y).contains(&point.y)
    };
    let home = |wall: &Ring| match (Side::of(wall), wall.0.first(), wall.bounds()) {
        (Side::Outer, Some(&point), _) => {
            outer.iter().find(|index| inside(point, boxes[**index]) && outlines[**index].contains(point))
        }
        (Side::Inner, _, Some(around)) => inner.iter().find(|index| {
            outlines[**index].0.first().is_some_and(|point| inside(*point, around) && wall.contains(*point))
        }),
        _ => None,
    };
    walls.iter().map(|wall| home(wall).copied().unwrap_or(0)).collect()
}

/// A closed wall: to its first point, round it, and back.
fn loop_thread(wall: &Ring, z: i32, lines: &mut Vec<Line>) {
    let step = |point: &Point| Line::Move(Move::to(Point3 { x: point.x, y: point.y, z }));
    let Some(first) = wall.0.first() else { return };
    let (open, close) = Feature::Edge(Side::of(wall)).tags();
    lines.push(open);
    lines.push(step(first));
    lines.push(Line::On);
    lines.extend(wall.0[1..].iter().chain([first]).map(step));
    lines.push(Line::Off);
    lines.push(close);
}

/// A bead along a middle line, with as much clay on each stretch as the part is wide there.
fn middle_thread(
    middle: &MiddleLine,
    least: f64,
    bead: &Bead,
    z: i32,
    lines: &mut Vec<Line>,
) -> Result<(), Error> {
    let step = |point: &Point| Line::Move(Move::to(Point3 { x: point.x, y: point.y, z }));
    let Some(first) = middle.points.first() else { return Ok(()) };
    lines.push(step(first));
    lines.push(Line::On);
    let mut flow = None;
    for index in 1..middle.points.len() {
        let width = f64::midpoint(middle.widths[index - 1], middle.widths[index]).max(least);
        let width = Micron::from_mm(width / 1000.0).unwrap_or(bead.width);
        // In hundredths: a finer step than any ram, and fewer lines.
        let share = (Bead { width, ..*bead }.area() / bead.area() * 100.0).round() / 100.0;
        let share = Ratio::from_f64(share).ok_or_else(|| Error::new("a bead has no flow"))?;
        if flow != Some(share) {
            lines.push(Line::Flow(share));
            flow = Some(share);
        }
        lines.push(step(&middle.points[index]));
    }
    lines.push(Line::Off);
    lines.push(Line::Flow(Ratio::ONE));
    Ok(())
}
