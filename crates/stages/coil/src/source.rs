//! A layer as fill left it, read once.

use crate::track::{Spot, spot};
use shape::plane::boolean::difference;
use shape::plane::offset;
use skein::{
    Bead, Error, Facts, Feature, Layer, Line, Mark, Nozzle, Point, Point3, Ratio, Ring, Side, Tag, boundary,
};

/// The most beads that one loop can hold.
pub const MOST_BEADS: usize = 3;

/// What coil needs of a layer.
#[derive(Debug)]
pub struct Source {
    /// The layer itself, for when it stays as it is.
    pub layer: Layer,
    /// The outlines of the part.
    pub outlines: Vec<Ring>,
    /// The wall that becomes a turn, or why it does not.
    pub wall: Result<Wall, &'static str>,
    /// Whether the inside is filled all over.
    pub solid: bool,
    /// Whether fill laid anything but walls.
    pub filled: bool,
    /// Where fill starts the outermost wall.
    pub start: Spot,
    /// A bead of this layer's height.
    pub bead: Bead,
    /// How high the nozzle stands.
    pub top: i32,
}

/// The wall of a layer that is one ring.
#[derive(Clone, Debug)]
pub struct Wall {
    /// The middles of its beads, the outermost first, counter-clockwise.
    pub beads: Vec<Ring>,
    /// How far apart they lie and how wide each is, in microns.
    pub pitch: f64,
    /// Whether there is clay to the middle in the drawing.
    pub full: bool,
}

/// What fill laid on a layer.
#[derive(Default)]
struct Laid {
    walls: Vec<Ring>,
    /// Length times flow of all infill, in microns.
    infill: f64,
    others: usize,
}

impl Source {
    /// Reads a layer; `beads` is how many the wall shall have, 0 for as many as there are.
    pub fn read(layer: Layer, facts: &Facts, beads: usize) -> Result<Self, Error> {
        let bead = facts.bead()?.of_height(layer.height(facts)?);
        let outlines = boundary(&layer.lines);
        let laid = Laid::read(&layer.lines);
        let spacing = bead.spacing().um();
        let clay = laid.walls.iter().map(Ring::length).sum::<f64>() * spacing;
        let inside = outlines.iter().map(Ring::area).sum::<f64>() * 1e6 - clay;
        let wall = wall(&outlines, &laid.walls, beads, spacing);
        Ok(Self {
            top: layer.nozzle_z(facts)?.0,
            solid: laid.infill > 0.0 && laid.infill * spacing > SOLID * inside,
            filled: laid.infill > 0.0 || laid.others > 0,
            start: laid.walls.first().and_then(|ring| ring.0.first()).copied().map(spot).unwrap_or_default(),
            layer,
            outlines,
            wall,
            bead,
        })
    }

    /// The lines of the layer with one thread in place of all that fill laid. What nobody knows stays, at the top.
    pub fn write(&self, feature: Feature, thread: Vec<Line>) -> Vec<Line> {
        let mut lines: Vec<Line> = Vec::with_capacity(thread.len() + 64);
        let stays = |line: &&Line| {
            matches!(
                line,
                Line::Layer(_) | Line::Thickness(_) | Line::Verbatim(_) | Line::Pasted(_) | Line::Value(_)
            )
        };
        lines.extend(self.layer.lines.iter().filter(stays).cloned());
        lines.push(Line::Open(Tag::NestedRing));
        let z = self.layer.z().0;
        for outline in &self.outlines {
            lines.push(Line::Open(Tag::BoundaryPerimeter));
            let places = outline.0.iter().map(|at| Point3 { x: at.x, y: at.y, z });
            lines.extend(places.map(|at| Line::Point(Mark::Boundary, at)));
            lines.push(Line::Close(Tag::BoundaryPerimeter));
        }
        let (open, close) = feature.tags();
        lines.push(open);
        lines.extend(thread);
        lines.extend([close, Line::Close(Tag::NestedRing), Line::Close(Tag::Layer)]);
        lines
    }
}

/// A layer is solid when its infill takes so much of the room between the walls.
const SOLID: f64 = 0.75;

impl Laid {
    fn read(lines: &[Line]) -> Self {
        let mut laid = Self::default();
        let mut nozzle = Nozzle::default();
        let mut ring: Vec<Point> = Vec::new();
        for line in lines {
            match line {
                Line::On => {
                    ring = nozzle.at.iter().map(|at| Point::new(at.x, at.y)).collect();
                }
                Line::Off => match nozzle.feature() {
                    Feature::Edge(Side::Outer) | Feature::Loop(Side::Outer)
                        if ring.first() == ring.last() =>
                    {
                        ring.pop();
                        laid.walls.push(Ring(std::mem::take(&mut ring)));
                    }
                    Feature::Infill | Feature::Edge(_) | Feature::Loop(_) => {}
                    _ => laid.others += 1,
                },
                _ => {}
            }
            if let (Some(step), Some(from), true) = (line.as_move(), nozzle.at, nozzle.on) {
                ring.push(Point::new(step.to.x, step.to.y));
                if nozzle.feature() == Feature::Infill {
                    laid.infill += line.length(from) * nozzle.flow.f64();
                }
            }
            nozzle.follow(line);
        }
        laid.walls.sort_by_cached_key(|ring| std::cmp::Reverse(ring.area2()));
        laid
    }
}

/// The beads of a wall, when the layer is one ring.
fn wall(outlines: &[Ring], laid: &[Ring], beads: usize, spacing: f64) -> Result<Wall, &'static str> {
    let wall = match outlines {
        [outer] if Side::of(outer) == Side::Outer => around_clay(laid, beads, spacing)?,
        [outer, hole] if Side::of(outer) == Side::Outer && Side::of(hole) == Side::Inner => {
            around_a_hole(outer, hole, beads, spacing)?
        }
        [] => return Err("there is nothing on it"),
        _ => return Err("it is not one ring"),
    };
    if wall.beads.iter().any(|bead| bead.length() < SHORTEST * wall.pitch) {
        return Err("it is too small to go round");
    }
    Ok(wall)
}

/// A turn shorter than so many beads has no room for its seam.
const SHORTEST: f64 = 6.0;

/// As many walls as fill has laid one inside the other, or as many as are wanted.
fn around_clay(laid: &[Ring], beads: usize, spacing: f64) -> Result<Wall, &'static str> {
    let Some((outermost, inner)) = laid.split_first() else { return Err("fill has laid no wall") };
    let wanted = if beads == 0 { laid.len().min(MOST_BEADS) } else { beads };
    let mut walls = vec![outermost.clone()];
    for (index, ring) in inner.iter().take(wanted - 1).enumerate() {
        if !ring.0.first().is_some_and(|point| walls[index].contains(*point)) {
            return Err("its walls fall apart");
        }
        walls.push(ring.clone());
    }
    while walls.len() < wanted {
        walls.push(inside(outermost, spacing * walls.len() as f64)?);
    }
    Ok(Wall { beads: walls, pitch: spacing, full: true })
}

/// As many walls as fit between two outlines that are equally far apart all round.
fn around_a_hole(outer: &Ring, hole: &Ring, beads: usize, spacing: f64) -> Result<Wall, &'static str> {
    let area = (outer.area() + hole.area()) * 1e6;
    let around = outer.length() + hole.length();
    let thickness = 2.0 * area / around;
    let count = if beads == 0 { (thickness / spacing).round().max(1.0) } else { beads as f64 };
    let pitch = thickness / count;
    if count > MOST_BEADS as f64 || !(LEAST_ROOM..=MOST_ROOM).contains(&(pitch / spacing)) {
        return Err("its wall is not one to three beads thick");
    }
    let even = offset(std::slice::from_ref(outer), -thickness);
    let hole = [hole.clone().reversed()];
    let uneven: f64 =
        difference(&even, &hole).iter().chain(&difference(&hole, &even)).map(Ring::area).sum::<f64>() * 1e6;
    if uneven > UNEVEN * spacing * hole[0].length() {
        return Err("its wall is not equally thick all round");
    }
    let beads = (0..count as usize).map(|bead| inside(outer, (bead as f64 + 0.5) * pitch));
    Ok(Wall { beads: beads.collect::<Result<_, _>>()?, pitch, full: false })
}

/// A bead between two outlines may be so much narrower or wider than it is by itself.
const LEAST_ROOM: f64 = 0.6;
const MOST_ROOM: f64 = 1.5;

/// The thickness of a wall may differ by so many beads, taken all round.
const UNEVEN: f64 = 0.25;

/// The ring that lies so far inside another.
fn inside(outer: &Ring, distance: f64) -> Result<Ring, &'static str> {
    match <[Ring; 1]>::try_from(offset(std::slice::from_ref(outer), -distance)) {
        Ok([ring]) => Ok(ring),
        Err(_) => Err("its walls fall apart"),
    }
}

/// The share of a nominal bead's section that fills a gap of this height and room of this width, both in microns.
pub fn share(bead: &Bead, gap: f64, width: f64) -> Ratio {
    let section = bead.section.area(bead.width.mm(), gap / 1000.0) / bead.area();
    let share = section * width / bead.spacing().um().max(1.0);
    // In thousandths: finer than any ram, and lines stay short.
    Ratio::from_f64((share * 1000.0).round() / 1000.0).unwrap_or(Ratio::ONE)
}
