//! A layer taken apart into its islands, and written again.

use crate::strand::Strand;
use crate::tree::Weave;
use skein::{Error, Feature, Layer, Line, Mark, Nozzle, Pen, Point, Point3, Ratio, Ring, Tag};

/// A layer: lines that stay, and islands between them.
#[derive(Debug, Default)]
pub struct Sheet {
    /// What stands in front of the islands.
    pub head: Vec<Line>,
    /// The islands.
    pub islands: Vec<Island>,
    /// What closes the layer.
    pub tail: Vec<Line>,
    /// The height of the nozzle.
    pub z: i32,
    /// Where clay ends in a layer that stays as it is, since clay climbs in it or goes on to the next; such a layer is all
    /// head.
    pub kept: Option<Option<Point>>,
}

/// How a layer is laid.
#[derive(Debug, Default)]
pub struct Plan {
    /// The islands in their order.
    pub order: Vec<usize>,
    /// The threads of each island, in that order.
    pub paths: Vec<Vec<Path>>,
}

impl Plan {
    /// Whether the first thread comes from the layer below.
    pub fn flows_on(&self) -> bool {
        self.paths.iter().flatten().next().is_some_and(|first| first.flows_on)
    }
}

/// Everything that belongs to an outline.
#[derive(Debug, Default)]
pub struct Island {
    /// Lines that are no beads, in front of the beads.
    pub lines: Vec<Line>,
    /// Its outlines.
    pub outlines: Vec<Ring>,
    /// What is laid on it.
    pub strands: Vec<Strand>,
    /// Whether it has a block of its own.
    nested: bool,
}

/// A place on a path, and the bead that leads there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Where it ends.
    pub to: Point,
    /// The share of a nominal section that flows on the way.
    pub flow: f64,
    /// What the bead is for.
    pub feature: Feature,
}

/// One thread.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// Where it begins.
    pub start: Point,
    /// The way.
    pub steps: Vec<Step>,
    /// The way back to where it began, left out when the thread climbs to the next layer instead.
    pub closing: Option<Step>,
    /// Whether clay flows on from the thread before.
    pub flows_on: bool,
}

impl Path {
    /// Where its steps end.
    pub fn end(&self) -> Point {
        self.steps.last().map_or(self.start, |step| step.to)
    }

    /// Where it ends with its closing: what follows begins near there, above or beside.
    pub fn closed_end(&self) -> Point {
        self.closing.map_or(self.end(), |closing| closing.to)
    }
}

impl Sheet {
    /// Takes a layer apart; `entering` is the nozzle in front of it and `leaving` behind it.
    ///
    /// # Errors
    /// When a bead starts nowhere, or something in a bead cannot be joined.
    pub fn read(layer: Layer, z: i32, entering: &Nozzle, leaving: &Nozzle) -> Result<Self, Error> {
        if entering.on || leaving.on || climbs(&layer, z, entering) {
            let end = leaving.at.map(|at| Point::new(at.x, at.y));
            return Ok(Self { head: layer.lines, z, kept: Some(end), ..Self::default() });
        }
        let mut sheet = Self { z, ..Self::default() };
        let mut island: Option<Island> = None;
        let mut loose = Island::default();
        let mut nozzle = *entering;
        let mut thread: Option<(Vec<Point>, Vec<Ratio>)> = None;
        let mut outline = Vec::new();
        for line in layer.lines {
            nozzle.follow(&line);
            match &line {
                Line::Open(Tag::NestedRing) => island = Some(Island { nested: true, ..Island::default() }),
                Line::Close(Tag::NestedRing) => sheet.islands.extend(island.take()),
                Line::On => {
                    let at = nozzle.at.ok_or_else(|| Error::new("a bead starts nowhere"))?;
                    thread = Some((vec![Point::new(at.x, at.y)], Vec::new()));
                }
                Line::Off => {
                    if let Some((points, flows)) = thread.take() {
                        let home = island.as_mut().unwrap_or(&mut loose);
                        home.strands.extend(Strand::new(nozzle.feature(), points, &flows));
                    }
                }
                Line::Move(step) => {
                    if step.feed.is_some() || step.extrusion.is_some() {
                        return Err(Error::new("a move says already how fast it is or what it pushes")
                            .hint("join comes before speed and dimension"));
                    }
                    if let Some((points, flows)) = &mut thread {
                        points.push(Point::new(step.to.x, step.to.y));
                        flows.push(nozzle.flow);
                    }
                }
                Line::Arc(_) => {
                    return Err(Error::new("a bead has an arc").hint("join comes before fillet"));
                }
                // What says how a bead is laid is said anew.
                Line::Flow(_) => {}
                Line::Wall(..)
                | Line::Open(Tag::Infill | Tag::Middle)
                | Line::Close(Tag::Edge | Tag::Loop | Tag::Infill | Tag::Middle) => {}
                _ => {
                    if let Some(island) = &mut island {
                        match &line {
                            Line::Point(Mark::Boundary, at) => outline.push(Point::new(at.x, at.y)),
                            Line::Close(Tag::BoundaryPerimeter) => {
                                island.outlines.push(Ring(std::mem::take(&mut outline)));
                            }
                            _ => {}
                        }
                        island.lines.push(line);
                    } else if sheet.islands.is_empty() {
                        sheet.head.push(line);
                    } else {
                        sheet.tail.push(line);
                    }
                }
            }
        }
        if !loose.strands.is_empty() {
            // Beads that belong to no outline stand behind those that do, or behind the head.
            if sheet.islands.is_empty() {
                let closing = |line: &Line| matches!(line, Line::Close(_));
                let end = sheet.head.iter().rposition(|line| !closing(line)).map_or(0, |last| last + 1);
                sheet.tail = sheet.head.split_off(end);
            }
            sheet.islands.push(loose);
        }
        Ok(sheet)
    }

    /// What lies beside what on each island; the spacing of the beads is in microns.
    pub fn weaves(&self, spacing: f64) -> Vec<Weave<'_>> {
        let islands = self.islands.iter();
        islands.map(|island| Weave::new(&island.strands, &island.outlines, spacing)).collect()
    }

    /// Writes the layer. `flows` are the flow in front of it and the one to leave behind it; `goes_on` is whether its last
    /// thread goes on in the next layer.
    pub fn write(mut self, plan: &Plan, flows: (Ratio, Ratio), goes_on: bool) -> Vec<Line> {
        if self.kept.is_some() {
            return self.head;
        }
        let nozzle = Nozzle { flow: flows.0, on: plan.flows_on(), ..Nozzle::default() };
        let steps: usize = plan.paths.iter().flatten().map(|path| path.steps.len() + 6).sum();
        let others: usize = self.islands.iter().map(|island| island.lines.len() + 2).sum();
        let mut pen = Pen::new(&nozzle, self.head.len() + self.tail.len() + steps + others);
        self.head.into_iter().for_each(|line| pen.push(line));
        let count: usize = plan.paths.iter().map(Vec::len).sum();
        let mut written = 0;
        for (index, paths) in plan.order.iter().zip(&plan.paths) {
            let island = std::mem::take(&mut self.islands[*index]);
            if island.nested {
                pen.push(Line::Open(Tag::NestedRing));
            }
            island.lines.into_iter().for_each(|line| pen.push(line));
            for path in paths {
                written += 1;
                write_path(path, self.z, goes_on && written == count, &mut pen);
            }
            if island.nested {
                pen.push(Line::Close(Tag::NestedRing));
            }
        }
        self.tail.into_iter().for_each(|line| pen.push(line));
        pen.finish(&Nozzle { flow: flows.1, ..Nozzle::default() })
    }
}

/// Whether a bead of the layer rises, as in a spiral.
fn climbs(layer: &Layer, z: i32, entering: &Nozzle) -> bool {
    let mut on = entering.on;
    layer.lines.iter().any(|line| {
        match line {
            Line::On => on = true,
            Line::Off => on = false,
            _ => {}
        }
        on && line.as_move().is_some_and(|step| step.to.z != z)
    })
}

/// Writes a thread; each change of what the bead is for closes one block and opens the next.
fn write_path(path: &Path, z: i32, goes_on: bool, pen: &mut Pen) {
    let place = |at: Point| Point3 { x: at.x, y: at.y, z };
    let rise =
        path.flows_on.then(|| path.steps.first().map(|first| Step { to: path.start, ..*first })).flatten();
    let mut open: Option<Feature> = None;
    for step in rise.iter().chain(&path.steps).chain(path.closing.as_ref().filter(|_| !goes_on)) {
        if open != Some(step.feature) {
            if let Some(before) = open {
                pen.push(before.tags().1);
            }
            pen.push(step.feature.tags().0);
            if open.is_none() && !path.flows_on {
                pen.go(place(path.start), None);
            }
            open = Some(step.feature);
        }
        pen.flow(Ratio::from_f64((step.flow * 1e4).round() / 1e4).unwrap_or(Ratio::ONE));
        pen.on();
        pen.go(place(step.to), None);
    }
    if !goes_on {
        pen.off();
    }
    pen.flow(Ratio::ONE);
    if let Some(last) = open {
        pen.push(last.tags().1);
    }
}
