//! A layer as inset left it, read once.

use crate::strand::{Island, Strand};
use shape::plane::hatch::Intervals;
use shape::plane::offset;
use skein::{
    Bead, Direction, Error, Facts, Feature, Layer, Line, Micron, Move, Nozzle, Point, Point3, Ratio, Ring,
    Side, Tag,
};
use skein::{Mark, boundary};
use std::borrow::Cow;
use std::sync::OnceLock;

/// What fill needs of a layer.
pub struct Source {
    /// The outlines of the part.
    pub outlines: Vec<Ring>,
    /// The middles of the outermost walls.
    pub edges: Vec<Ring>,
    /// Beads on the middle of thin parts.
    pub middles: Vec<Strand>,
    /// The direction of a bridge.
    pub bridge: Option<Direction>,
    /// A bead of this layer's height.
    pub bead: Bead,
    z: Micron,
    nozzle_z: i32,
    /// The rows inside the walls, for each of the two directions that layers have by turns; made when a layer near by
    /// first asks.
    rows: [OnceLock<Intervals>; 2],
    /// The lines that open the layer, and those nobody knows.
    head: Vec<Line>,
    /// The lines that close it.
    tail: Vec<Line>,
}

impl Source {
    /// Reads a layer.
    pub fn read(layer: Layer, facts: &Facts) -> Result<Self, Error> {
        let mut source = Self {
            outlines: boundary(&layer.lines),
            edges: Vec::new(),
            middles: Vec::new(),
            bridge: None,
            bead: facts.bead()?.of_height(layer.height(facts)?),
            z: layer.z(),
            nozzle_z: layer.nozzle_z(facts)?.0,
            rows: Default::default(),
            head: Vec::new(),
            tail: Vec::new(),
        };
        let mut nozzle = Nozzle::default();
        let mut thread: Option<Strand> = None;
        for line in layer.lines {
            nozzle.follow(&line);
            match line {
                Line::Rotation(Tag::BridgeRotation, direction) => {
                    source.bridge = Some(direction);
                    source.head.push(line);
                }
                Line::Layer(_)
                | Line::Thickness(_)
                | Line::Verbatim(_)
                | Line::Pasted(_)
                | Line::Value(_) => source.head.push(line),
                Line::Close(Tag::Layer | Tag::BridgeRotation) => source.tail.push(line),
                Line::On => {
                    let start = nozzle.at.ok_or_else(|| Error::new("a bead starts nowhere"))?;
                    let start = Point::new(start.x, start.y);
                    thread = Some(Strand {
                        feature: nozzle.feature(),
                        points: vec![start],
                        flows: Vec::new(),
                        closed: false,
                    });
                }
                Line::Move(step) => {
                    if let Some(thread) = &mut thread {
                        thread.points.push(Point::new(step.to.x, step.to.y));
                        thread.flows.push(nozzle.flow);
                    }
                }
                Line::Arc(_) => {
                    return Err(Error::new("a wall has an arc").hint("fillet comes behind fill"));
                }
                Line::Off => source.take(thread.take()),
                // Everything else is laid anew.
                _ => {}
            }
        }
        Ok(source)
    }

    fn take(&mut self, thread: Option<Strand>) {
        let Some(mut thread) = thread else { return };
        if !matches!(thread.feature, Feature::Edge(_)) {
            self.middles.push(Strand { feature: Feature::Middle, ..thread });
            return;
        }
        if thread.points.first() == thread.points.last() {
            thread.points.pop();
        }
        if thread.points.len() > 2 {
            self.edges.push(Ring(thread.points));
        }
    }

    /// The rows inside the walls in the direction of even (0) or odd (1) layers.
    pub fn rows(&self, turn: usize, turned: (f64, f64), step: f64) -> &Intervals {
        self.rows[turn].get_or_init(|| Intervals::new(&self.edges, turned, step))
    }

    /// What the walls enclose, grown by a distance in microns.
    pub fn grown(&self, distance: f64) -> Cow<'_, [Ring]> {
        if distance > 0.0 { Cow::Owned(offset(&self.edges, distance)) } else { Cow::Borrowed(&self.edges) }
    }

    /// The layer with everything that is laid on it.
    pub fn write(&self, islands: &[Island], direction: Direction) -> Vec<Line> {
        let strands = islands.iter().flat_map(|island| &island.strands);
        let count = self.outlines.iter().map(|ring| ring.0.len() + 4).sum::<usize>()
            + strands.map(|strand| strand.points.len() + 6).sum::<usize>();
        let mut lines = Vec::with_capacity(count + self.head.len() + self.tail.len() + 2);
        lines.extend_from_slice(&self.head);
        if !islands.is_empty() {
            lines.push(Line::Rotation(Tag::Rotation, self.bridge.unwrap_or(direction)));
        }
        for island in islands {
            lines.push(Line::Open(Tag::NestedRing));
            for outline in island.outlines.iter().filter_map(|index| self.outlines.get(*index)) {
                lines.push(Line::Open(Tag::BoundaryPerimeter));
                let z = self.z.0;
                lines.extend(
                    outline
                        .0
                        .iter()
                        .map(|point| Line::Point(Mark::Boundary, Point3 { x: point.x, y: point.y, z })),
                );
                lines.push(Line::Close(Tag::BoundaryPerimeter));
            }
            for strand in &island.strands {
                strand.write(self.nozzle_z, &mut lines);
            }
            lines.push(Line::Close(Tag::NestedRing));
        }
        if !islands.is_empty() {
            lines.push(Line::Close(Tag::Rotation));
        }
        lines.extend_from_slice(&self.tail);
        lines
    }
}

impl Strand {
    fn write(&self, z: i32, lines: &mut Vec<Line>) {
        let step = |point: &Point| Line::Move(Move::to(Point3 { x: point.x, y: point.y, z }));
        let Some((first, rest)) = self.points.split_first() else { return };
        let (open, close) = self.feature.tags();
        lines.push(open);
        lines.push(step(first));
        lines.push(Line::On);
        let mut flow = Ratio::ONE;
        let closing = if self.closed { Some(first) } else { None };
        for (index, point) in rest.iter().chain(closing).enumerate() {
            let wanted = self.flows.get(index).copied().unwrap_or(Ratio::ONE);
            if wanted != flow {
                lines.push(Line::Flow(wanted));
                flow = wanted;
            }
            lines.push(step(point));
        }
        lines.push(Line::Off);
        if flow != Ratio::ONE {
            lines.push(Line::Flow(Ratio::ONE));
        }
        lines.push(close);
    }

    /// A closed wall.
    pub fn wall(feature: fn(Side) -> Feature, ring: Ring) -> Self {
        Self::ring(feature(Side::of(&ring)), ring.0)
    }

    /// A closed bead.
    pub fn ring(feature: Feature, points: Vec<Point>) -> Self {
        Self { feature, points, flows: Vec::new(), closed: true }
    }
}
