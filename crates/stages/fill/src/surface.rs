//! What of a layer is seen from above or below.

use shape::plane::hatch::{End, Hatch, Intervals, Rows, Span};
use shape::plane::{Ring, boolean, offset};
use skein::Point;

/// The parts of a hatch that are seen from above or below.
#[derive(Default)]
pub struct Surface {
    first: i64,
    /// Its rows, spans of the hatch.
    pub rows: Rows,
}

impl Surface {
    /// What lies in the hatch and not inside the walls of all surrounding layers.
    pub fn find(hatch: &Hatch, around: &[&Intervals], step: f64) -> Self {
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

    /// The spans of the row with a number.
    pub fn row(&self, number: i64) -> &[Span] {
        usize::try_from(number - self.first).map_or(&[], |row| self.rows.row(row))
    }

    /// A region without the strips that the rows cover, and without what is then narrower than a bead; `None` when there
    /// are none.
    pub fn without(&self, region: &[Ring], (cosine, sine): (f64, f64), step: f64) -> Option<Vec<Ring>> {
        // Neighbouring strips overlap a little, so that rounding leaves no slit between them.
        let half = step / 2.0 + 2.0;
        let place = |x: f64, y: f64| {
            Point::new((x * cosine - y * sine).round() as i32, (x * sine + y * cosine).round() as i32)
        };
        let strips: Vec<Ring> = (self.first..)
            .zip(self.rows.iter())
            .flat_map(|(number, row)| {
                row.iter().map(move |span| (number as f64 * step, span.left.x, span.right.x))
            })
            .map(|(y, left, right)| {
                let corners = [(left, y - half), (right, y - half), (right, y + half), (left, y + half)];
                Ring(corners.map(|(x, y)| place(x, y)).to_vec())
            })
            .collect();
        if strips.is_empty() {
            return None;
        }
        let rest = boolean::difference(region, &strips);
        Some(offset(&offset(&rest, -step / 2.0), step / 2.0))
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
