//! Lines between the walls: solid at surfaces, sparse inside.

use crate::Fill;
use crate::source::Source;
use crate::strand::{Strand, spacing};
use shape::plane::hatch::{End, Hatch, Intervals, Rows, Span};
use shape::plane::{islands, offset};
use skein::{Direction, Feature, Notes, Point, Ratio, Ring};

/// The infill of one layer.
pub struct Job<'a> {
    /// The settings.
    pub fill: &'a Fill,
    /// The layer.
    pub source: &'a Source,
    /// Where the middles of its beads may go.
    pub inside: &'a [Ring],
    /// The direction of the lines.
    pub direction: Direction,
    /// Which of the two directions that layers have by turns it has; none for a bridge.
    pub turn: Option<usize>,
    /// The layers that hide a place from above and below; `None` when all of it is surface.
    pub surroundings: Option<Vec<&'a Source>>,
}

/// How far a joint between two rows may go, in spacings.
const REACH: f64 = 4.0;

impl Job<'_> {
    /// Lays the infill.
    pub fn run(&self, layer: usize, strands: &mut Vec<Strand>, notes: &mut Notes) {
        let step = spacing(&self.source.bead);
        let density = self.fill.density.f64();
        let turned = self.direction.unit();
        let surroundings = match &self.surroundings {
            Some(around) if density < 1.0 => around,
            _ => {
                for island in islands(self.inside) {
                    self.solid(layer, &island, turned, step, strands, notes);
                }
                return;
            }
        };
        let solid = if self.fill.base_layers == 0 && self.fill.top_layers == 0 {
            Surface::default()
        } else {
            let hatch = Hatch::new(self.inside, turned, step);
            // Layers of one direction and spacing share the rows of those around them.
            let shared = |source: &&Source| self.turn.filter(|_| spacing(&source.bead) == step);
            let own: Vec<Intervals> = surroundings
                .iter()
                .filter(|source| shared(source).is_none())
                .map(|source| Intervals::new(&source.edges, turned, step))
                .collect();
            let rows =
                surroundings.iter().filter_map(|source| Some(source.rows(shared(source)?, turned, step)));
            let around: Vec<&Intervals> = rows.chain(&own).collect();
            let surface = Surface::find(&hatch, &around, step);
            for points in hatch.threads(&surface.rows, REACH * step) {
                self.lay(points, Ratio::ONE, strands);
            }
            surface
        };
        if density > 0.0 {
            let apart = step / density;
            let hatch = Hatch::new(self.inside, turned, apart);
            let mut rows = Rows::default();
            for (index, row) in hatch.rows().iter().enumerate() {
                let height = hatch.height(hatch.first() + index as i64);
                without(row, solid.row((height / step).round() as i64), step, &mut rows);
                rows.end_row();
            }
            for points in hatch.threads(&rows, REACH * apart) {
                self.lay(points, Ratio::ONE, strands);
            }
        }
    }

    /// Fills an island, with as much clay as there is room.
    fn solid(
        &self,
        layer: usize,
        island: &[Ring],
        turned: (f64, f64),
        step: f64,
        strands: &mut Vec<Strand>,
        notes: &mut Notes,
    ) {
        let hatch = Hatch::fitted(island, turned, step);
        let threads = hatch.threads(hatch.rows(), REACH * step);
        let length: f64 =
            threads.iter().flat_map(|points| points.windows(2)).map(|pair| pair[0].distance(pair[1])).sum();
        if length == 0.0 {
            return;
        }
        // The middles of the beads reach to half a bead from what is beside them; the room is that much larger.
        let reach = (0.5 - self.fill.overlap.f64()) * step;
        let room: f64 = offset(island, reach).iter().map(Ring::area).sum();
        let wanted = room * 1e6 / (length * step);
        let flow = wanted.clamp(LEAST, MOST);
        if (flow - wanted).abs() > 1e-9 {
            notes.layer(layer, "the room between the walls is too narrow for even infill; it holds more or less clay than there is room");
        }
        let flow = Ratio::from_f64((flow * 1000.0).round() / 1000.0).unwrap_or(Ratio::ONE);
        for points in threads {
            self.lay(points, flow, strands);
        }
    }

    fn lay(&self, points: Vec<Point>, flow: Ratio, strands: &mut Vec<Strand>) {
        if points.len() < 2 {
            return;
        }
        let flows = if flow == Ratio::ONE { Vec::new() } else { vec![flow; points.len() - 1] };
        strands.push(Strand { feature: Feature::Infill, points, flows, closed: false });
    }
}

/// A bead takes a third more or less than its nominal clay before it gaps or bulges.
const LEAST: f64 = 0.67;
const MOST: f64 = 1.34;

/// The parts of a hatch that are seen from above or below.
#[derive(Default)]
struct Surface {
    first: i64,
    rows: Rows,
}

impl Surface {
    /// What lies in the hatch and not inside the walls of all surrounding layers.
    fn find(hatch: &Hatch, around: &[&Intervals], step: f64) -> Self {
        let seen: Vec<Vec<(f64, f64)>> = hatch
            .rows()
            .iter()
            .enumerate()
            .map(|(index, row)| {
                let number = hatch.first() + index as i64;
                let mut seen = Vec::new();
                for span in row {
                    let (left, right) = (span.left.x, span.right.x);
                    let hides =
                        |cover: &&Intervals| cover.row(number).any(|(from, to)| from <= left && right <= to);
                    // Nearly every span is hidden whole.
                    let mut rest: Vec<&Intervals> = Vec::new();
                    rest.extend(around.iter().filter(|cover| !hides(cover)));
                    if rest.is_empty() {
                        continue;
                    }
                    let mut hidden = vec![(left, right)];
                    for cover in rest {
                        hidden = common(&hidden, cover.row(number));
                    }
                    without_hidden((left, right), &hidden, &mut seen);
                }
                seen
            })
            .collect();
        if seen.iter().all(Vec::is_empty) {
            return Self::default();
        }
        let kept = without_specks(seen, 4.0 * step * step, step);
        // A surface is laid a bead farther than it is seen, so that it rests on what is beside it.
        let mut rows = Rows::default();
        for (index, row) in hatch.rows().iter().enumerate() {
            let near = index.saturating_sub(1)..(index + 2).min(kept.len());
            let mut wide: Vec<(f64, f64)> =
                kept[near].iter().flatten().map(|(left, right)| (left - step, right + step)).collect();
            wide.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
            inside(row, &wide, 2.0 * step, &mut rows);
            rows.end_row();
        }
        Self { first: hatch.first(), rows }
    }

    fn row(&self, number: i64) -> &[Span] {
        usize::try_from(number - self.first).map_or(&[], |row| self.rows.row(row))
    }
}

/// What two sorted lists of intervals have in common.
fn common(one: &[(f64, f64)], other: impl Iterator<Item = (f64, f64)> + Clone) -> Vec<(f64, f64)> {
    let mut both = Vec::with_capacity(one.len());
    for &(left, right) in one {
        for (start, end) in other.clone() {
            let (from, to) = (left.max(start), right.min(end));
            if from < to {
                both.push((from, to));
            }
        }
    }
    both
}

/// An interval without sorted others.
fn without_hidden(whole: (f64, f64), without: &[(f64, f64)], out: &mut Vec<(f64, f64)>) {
    let mut from = whole.0;
    for &(left, right) in without {
        if left > from {
            out.push((from, left));
        }
        from = from.max(right);
    }
    if whole.1 > from {
        out.push((from, whole.1));
    }
}

/// Drops patches, connected from row to row, smaller than an area in square microns.
fn without_specks(rows: Vec<Vec<(f64, f64)>>, least: f64, step: f64) -> Vec<Vec<(f64, f64)>> {
    let mut parent: Vec<usize> = Vec::new();
    let mut areas: Vec<f64> = Vec::new();
    let mut above: Vec<((f64, f64), usize)> = Vec::new();
    let mut labels: Vec<Vec<usize>> = Vec::with_capacity(rows.len());
    fn root(parent: &mut [usize], mut node: usize) -> usize {
        while parent[node] != node {
            parent[node] = parent[parent[node]];
            node = parent[node];
        }
        node
    }
    for row in &rows {
        let mut here = Vec::with_capacity(row.len());
        for &span in row {
            let node = parent.len();
            parent.push(node);
            areas.push((span.1 - span.0) * step);
            for &(other, label) in &above {
                if other.0 < span.1 && span.0 < other.1 {
                    let (one, two) = (root(&mut parent, node), root(&mut parent, label));
                    if one != two {
                        parent[one.max(two)] = one.min(two);
                        areas[one.min(two)] += areas[one.max(two)];
                    }
                }
            }
            here.push((span, node));
        }
        labels.push(here.iter().map(|(_, node)| *node).collect());
        above = here;
    }
    rows.into_iter()
        .zip(labels)
        .map(|(row, labels)| {
            let kept =
                row.into_iter().zip(labels).filter(|(_, label)| areas[root(&mut parent, *label)] >= least);
            kept.map(|(span, _)| span).collect()
        })
        .collect()
}

/// The parts of a row's spans inside sorted intervals. An end nearer than `snap` to the span's own end goes there.
fn inside(row: &[Span], wide: &[(f64, f64)], snap: f64, parts: &mut Rows) {
    for span in row {
        let mut run: Option<(f64, f64)> = None;
        let mut close = |run: Option<(f64, f64)>| {
            let Some((from, to)) = run else { return };
            let left = if from - span.left.x < snap { span.left } else { End::cut(from) };
            let right = if span.right.x - to < snap { span.right } else { End::cut(to) };
            parts.push(Span { left, right });
        };
        for &(left, right) in wide {
            let (from, to) = (left.max(span.left.x), right.min(span.right.x));
            if from >= to {
                continue;
            }
            match &mut run {
                Some((_, end)) if from - *end < snap => *end = end.max(to),
                _ => close(run.replace((from, to))),
            }
        }
        close(run);
    }
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
