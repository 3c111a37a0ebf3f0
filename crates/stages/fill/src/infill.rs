//! What lies between the walls: solid lines at surfaces, a sparse pattern inside.

use crate::pattern::Cells;
use crate::source::Source;
use crate::strand::{Strand, spacing};
use crate::surface::Surface;
use crate::{Fill, Pattern, rings};
use shape::plane::clip;
use shape::plane::hatch::{End, Hatch, Intervals, Rows, Run, Span};
use shape::plane::{islands, offset};
use skein::{Angle, Direction, Feature, Notes, Point, Ratio, Ring};
use std::borrow::Cow;
use std::ops::Range;

/// The infill of one layer.
pub struct Job<'a> {
    /// The settings.
    pub fill: &'a Fill,
    /// The layer.
    pub source: &'a Source,
    /// Which layer it is.
    pub layer: usize,
    /// Where the middles of its beads may go.
    pub inside: &'a [Ring],
    /// The direction of the lines.
    pub direction: Direction,
    /// Which of the two directions that layers have by turns it has; none for a bridge.
    pub turn: Option<usize>,
    /// The layers that hide a place from above and below, and how far each is grown first; `None` when all of it is
    /// surface.
    pub surroundings: Option<Vec<(&'a Source, f64)>>,
}

/// How far a joint between two rows may go, in spacings.
const REACH: f64 = 4.0;

/// How far a joint between two lines of a pattern may go, in distances between lines of that density: past one cell. A
/// longer one runs beside the wall where nothing needs it.
const CELL_REACH: f64 = 2.5;

impl Job<'_> {
    /// Lays the infill.
    pub fn run(&self, strands: &mut Vec<Strand>, notes: &mut Notes) {
        let step = spacing(&self.source.bead);
        let density = self.fill.density.f64();
        let turned = self.direction.unit();
        let surroundings = match &self.surroundings {
            Some(around) if density < 1.0 => around,
            _ => {
                for island in islands(self.inside) {
                    self.solid(&island, turned, step, strands, notes);
                }
                return;
            }
        };
        let solid = if surroundings.is_empty() {
            Surface::default()
        } else {
            let hatch = Hatch::new(self.inside, turned, step);
            // Layers of one direction and spacing share the rows of those around them.
            let shared = |(source, grown): &&(&Source, f64)| {
                self.turn.filter(|_| *grown == 0.0 && spacing(&source.bead) == step)
            };
            let own: Vec<Intervals> = surroundings
                .iter()
                .filter(|source| shared(source).is_none())
                .map(|(source, grown)| Intervals::new(&source.grown(*grown), turned, step))
                .collect();
            let rows =
                surroundings.iter().filter_map(|source| Some(source.0.rows(shared(&source)?, turned, step)));
            let around: Vec<&Intervals> = rows.chain(&own).collect();
            let surface = Surface::find(&hatch, &around, step);
            for points in hatch.threads(&surface.rows, REACH * step) {
                self.lay(points, Vec::new(), strands);
            }
            surface
        };
        if density > 0.0 {
            self.sparse(&solid, turned, step, strands, notes);
        }
    }

    /// Lays what is between the walls and is no surface.
    fn sparse(
        &self,
        solid: &Surface,
        turned: (f64, f64),
        step: f64,
        strands: &mut Vec<Strand>,
        notes: &mut Notes,
    ) {
        let apart = step / self.fill.density.f64();
        match (self.fill.pattern, Cells::new(self.fill, self.layer, step)) {
            (Pattern::Line, _) => self.rows(solid, turned, step, apart, strands),
            (Pattern::Concentric, _) => {
                rings::lay(&self.room(solid, turned, step), apart, self.source, strands);
            }
            (_, Some(cells)) => self.cells(&cells, &self.room(solid, turned, step), step, apart, strands),
            (_, None) => {
                notes.layer(
                    self.layer,
                    "so much clay leaves no room for the cells of the pattern; lines are laid",
                );
                self.rows(solid, turned, step, apart, strands);
            }
        }
    }

    /// Parallel lines.
    fn rows(&self, solid: &Surface, turned: (f64, f64), step: f64, apart: f64, strands: &mut Vec<Strand>) {
        let hatch = Hatch::new(self.inside, turned, apart);
        let mut rows = Rows::default();
        for (index, row) in hatch.rows().iter().enumerate() {
            let height = hatch.height(hatch.first() + index as i64);
            without(row, solid.row((height / step).round() as i64), step, &mut rows);
            rows.end_row();
        }
        for points in hatch.threads(&rows, REACH * apart) {
            self.lay(points, Vec::new(), strands);
        }
    }

    /// Cells of a pattern, whose lines go on along the border from one to the next.
    fn cells(&self, cells: &Cells, room: &[Ring], step: f64, apart: f64, strands: &mut Vec<Strand>) {
        let turn = self.fill.pattern.turn(self.layer);
        let direction = Angle(self.fill.begin_rotation.0 + turn.0).direction().unit();
        for island in islands(room) {
            let lines = cells.lines(&island, direction, step);
            for thread in clip::threads(&lines, &island, CELL_REACH * apart, 2.0 * step) {
                if thread.closed {
                    strands.push(Strand::ring(Feature::Infill, thread.points));
                } else {
                    self.lay(thread.points, Vec::new(), strands);
                }
            }
        }
    }

    /// Where sparse infill may go: inside the walls and not in what is solid.
    fn room(&self, solid: &Surface, turned: (f64, f64), step: f64) -> Cow<'_, [Ring]> {
        match solid.without(self.inside, turned, step) {
            Some(room) => Cow::Owned(room),
            None => Cow::Borrowed(self.inside),
        }
    }

    /// Fills an island, with as much clay as there is room.
    fn solid(
        &self,
        island: &[Ring],
        turned: (f64, f64),
        step: f64,
        strands: &mut Vec<Strand>,
        notes: &mut Notes,
    ) {
        // The middles of the beads reach to half a bead from what is beside them; the room is that much larger. Rows turn
        // halfway there; where nothing is beside them they must not stand out.
        let reach = (0.5 - self.fill.overlap.f64()) * step;
        let margin = if self.fill.walls == 0 { reach } else { reach / 2.0 };
        let ends = if margin < reach { offset(island, reach - margin) } else { island.to_vec() };
        let runs = Hatch::fitted_to(island, &ends, turned, step).filled(margin);
        let laid: f64 = runs.iter().map(Run::area).sum();
        if laid == 0.0 {
            return;
        }
        let room: f64 = offset(island, reach).iter().map(Ring::area).sum();
        let wanted = room * 1e6 / laid;
        let factor = wanted.clamp(LEAST, MOST);
        if (factor - wanted).abs() > 1e-9 {
            notes.layer(self.layer, "the room between the walls is too narrow for even infill; it holds more or less clay than there is room");
        }
        for run in runs {
            let flow = |width: &f64| {
                Ratio::from_f64((width / step * factor * 1000.0).round() / 1000.0).unwrap_or(Ratio::ONE)
            };
            let flows = run.widths.iter().map(flow).collect();
            self.lay(run.points, flows, strands);
        }
    }

    /// Lays a thread; without flows it is of the nominal section.
    fn lay(&self, points: Vec<Point>, flows: Vec<Ratio>, strands: &mut Vec<Strand>) {
        for part in without_sharp_corners(&points, self.fill.sharpest_angle, spacing(&self.source.bead)) {
            if part.len() < 2 {
                continue;
            }
            let flows = flows.get(part.start..part.end - 1).unwrap_or_default().to_vec();
            strands.push(Strand {
                feature: Feature::Infill,
                points: points[part].to_vec(),
                flows,
                closed: false,
            });
        }
    }
}

/// A bead takes a third more or less than its nominal clay before it gaps or bulges.
const LEAST: f64 = 0.67;
const MOST: f64 = 1.34;

/// A thread cut where it turns back more sharply than an angle between its two sides. What is then shorter than `least`
/// is left out: it was only the way from one line to the next. No angle cuts nothing.
fn without_sharp_corners(points: &[Point], sharpest: Angle, least: f64) -> Vec<Range<usize>> {
    let limit = Angle(180_000 - sharpest.0).direction().unit().0;
    let turns_back = |corner: &[Point]| {
        let (x, y) = corner[0].delta(corner[1]);
        let (u, v) = corner[1].delta(corner[2]);
        let lengths = corner[0].distance(corner[1]) * corner[1].distance(corner[2]);
        sharpest.0 > 0 && ((x * u + y * v) as f64) < limit * lengths
    };
    let cuts =
        points.windows(3).enumerate().filter(|(_, corner)| turns_back(corner)).map(|(index, _)| index + 1);
    let mut parts = Vec::new();
    let mut from = 0;
    for cut in cuts.chain([points.len().saturating_sub(1)]) {
        parts.push(from..cut + 1);
        from = cut;
    }
    let length = |part: &Range<usize>| {
        points[part.clone()].windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>()
    };
    parts.retain(|part| sharpest.0 == 0 || length(part) >= least);
    parts
}

/// A row's spans without others; pieces shorter than `least` are dropped.
fn without(row: &[Span], others: &[Span], least: f64, parts: &mut Rows) {
    for span in row {
        let mut left = span.left;
        for other in others.iter().filter(|other| other.right.x > span.left.x && other.left.x < span.right.x)
        {
            if other.left.x - left.x >= least {
                parts.push(Span { left, right: End::cut(other.left.x) });
            }
            left = End::cut(other.right.x);
        }
        if span.right.x - left.x >= least {
            parts.push(Span { left, right: span.right });
        }
    }
}
