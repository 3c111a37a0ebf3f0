//! Parallel lines across a region, and zig-zag threads made of them.
//!
//! Work happens in a frame turned so that the lines are level. A row is a line of the hatch; where it crosses the
//! region's rings it is cut into spans. Every crossing knows its neighbours along its ring, so a thread can go from
//! the end of one row to the next row along the very outline of the region: such a joint crosses nothing.

mod solid;

use super::{Point, Ring};
pub use solid::Run;

/// The rows of a hatch, from the lowest up.
pub struct Hatch {
    cosine: f64,
    sine: f64,
    spacing: f64,
    /// Row `k` lies at height base + `k` × spacing in the turned frame.
    base: f64,
    /// The number of the lowest row.
    first: i64,
    rows: Rows,
    crossings: Vec<Crossing>,
    /// The turned points of all rings, one ring after the other.
    points: Vec<(f64, f64)>,
    rings: Vec<std::ops::Range<usize>>,
}

/// The spans of successive rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    spans: Vec<Span>,
    /// Where each row ends in `spans`.
    ends: Vec<u32>,
}

impl Rows {
    /// The rows in order, each with its spans from left to right.
    pub fn iter(&self) -> impl Iterator<Item = &[Span]> {
        (0..self.ends.len()).map(|row| self.row(row))
    }

    /// The spans of a row; none beyond the last.
    pub fn row(&self, row: usize) -> &[Span] {
        let range = self.range(row);
        &self.spans[range]
    }

    /// Appends a span to the row that is being built.
    pub fn push(&mut self, span: Span) {
        self.spans.push(span);
    }

    /// Ends the row that is being built.
    pub fn end_row(&mut self) {
        self.ends.push(self.spans.len() as u32);
    }

    fn range(&self, row: usize) -> std::ops::Range<usize> {
        let end = |row: usize| self.ends.get(row).copied().unwrap_or(self.spans.len() as u32) as usize;
        let start = if row == 0 { 0 } else { end(row - 1) };
        start..end(row)
    }
}

/// A part of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Its end with the smaller x.
    pub left: End,
    /// Its end with the greater x.
    pub right: End,
}

/// An end of a span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// Where, in the turned frame, in microns.
    pub x: f64,
    /// The crossing it lies on; none where the span was cut.
    crossing: Option<u32>,
}

impl End {
    /// A cut end.
    pub fn cut(x: f64) -> Self {
        Self { x, crossing: None }
    }
}

/// Where a row crosses a ring.
#[derive(Clone, Copy)]
struct Crossing {
    x: f64,
    row: i64,
    /// The side of the ring, as the index of its first point.
    side: u32,
    /// The crossings before and after it along the ring.
    before: u32,
    after: u32,
}

impl Hatch {
    /// Cuts rows in a direction (cosine, sine) across a region; row 0 passes through the origin of the plane, so rows
    /// of all layers of one direction lie above each other.
    pub fn new(region: &[Ring], direction: (f64, f64), spacing: f64) -> Self {
        let (points, rings) = turned(region, direction);
        Self::across(points, rings, direction, spacing, 0.0)
    }

    /// Cuts rows that fit the region: the first runs along its lower end, the last along its upper end, and between
    /// them they lie evenly, as near to `spacing` as that allows.
    pub fn fitted(region: &[Ring], direction: (f64, f64), spacing: f64) -> Self {
        let (points, rings) = turned(region, direction);
        let (base, spacing) = fitted_rows(&points, spacing);
        Self::across(points, rings, direction, spacing, base)
    }

    fn across(
        points: Vec<(f64, f64)>,
        rings: Vec<std::ops::Range<usize>>,
        (cosine, sine): (f64, f64),
        spacing: f64,
        base: f64,
    ) -> Self {
        let mut crossings: Vec<Crossing> = Vec::with_capacity(points.len());
        for ring in &rings {
            let from = crossings.len() as u32;
            for side in ring.clone() {
                let (a, b) = (points[side], points[if side + 1 == ring.end { ring.start } else { side + 1 }]);
                each_row((a.0, a.1 - base), (b.0, b.1 - base), spacing, |row, x| {
                    crossings.push(Crossing { x, row, side: side as u32, before: 0, after: 0 });
                });
            }
            let to = crossings.len() as u32;
            for index in from..to {
                crossings[index as usize].before = if index == from { to - 1 } else { index - 1 };
                crossings[index as usize].after = if index + 1 == to { from } else { index + 1 };
            }
        }
        let (first, starts, mut order) = by_row(crossings.iter().map(|crossing| crossing.row));
        let mut rows =
            Rows { spans: Vec::with_capacity(crossings.len() / 2), ends: Vec::with_capacity(starts.len()) };
        for row in starts.windows(2) {
            let row = &mut order[row[0] as usize..row[1] as usize];
            row.sort_unstable_by(|one, other| {
                crossings[*one as usize].x.total_cmp(&crossings[*other as usize].x).then(one.cmp(other))
            });
            let end = |index: u32| End { x: crossings[index as usize].x, crossing: Some(index) };
            rows.spans
                .extend(row.chunks_exact(2).map(|pair| Span { left: end(pair[0]), right: end(pair[1]) }));
            rows.end_row();
        }
        Self { cosine, sine, spacing, base, first, rows, crossings, points, rings }
    }

    /// The corners of a ring between two neighbouring crossings, in the turned frame.
    fn corners(&self, from: Crossing, to: Crossing, forwards: bool) -> impl Iterator<Item = (f64, f64)> {
        let ring = &self.rings[self.rings.partition_point(|ring| ring.end <= from.side as usize)];
        let (mut side, last) = (from.side as usize, to.side as usize);
        std::iter::from_fn(move || {
            if side == last {
                return None;
            }
            if forwards {
                side = if side + 1 == ring.end { ring.start } else { side + 1 };
                return Some(self.points[side]);
            }
            let corner = self.points[side];
            side = if side == ring.start { ring.end - 1 } else { side - 1 };
            Some(corner)
        })
    }

    /// The number of the lowest row.
    pub fn first(&self) -> i64 {
        self.first
    }

    /// The spans of every row, from the lowest up.
    pub fn rows(&self) -> &Rows {
        &self.rows
    }

    /// The height of a row in the turned frame.
    pub fn height(&self, number: i64) -> f64 {
        self.base + number as f64 * self.spacing
    }

    /// Joins spans to threads: each goes along a span, over to the next row, and back. `rows` holds for every row of
    /// the hatch the parts of its spans that are wanted, in order. A joint along the outline is at most `reach`
    /// microns long; cut ends of neighbouring rows are joined straight when they are at most `reach` apart.
    pub fn threads(&self, rows: &Rows, reach: f64) -> Vec<Vec<Point>> {
        let mut book = Book::new(self, rows);
        let mut threads = Vec::new();
        for row in 0..rows.ends.len() {
            for span in rows.range(row) {
                if std::mem::replace(&mut book.used[span], true) {
                    continue;
                }
                // Begin at the end that leads nowhere, so that the other one may lead on.
                let leads_on = book.next(row, span, true, reach).is_some();
                threads.push(book.thread(row, span, leads_on, reach));
            }
        }
        threads
    }

    /// A place of the turned frame in the plane.
    fn turned_back(&self, x: f64, y: f64) -> Point {
        let nearest = |value: f64| (value + 0.5f64.copysign(value)) as i32;
        Point::new(nearest(x * self.cosine - y * self.sine), nearest(x * self.sine + y * self.cosine))
    }
}

/// The intervals in which rows lie inside a region: a hatch without threads, where only the places matter.
pub struct Intervals {
    first: i64,
    starts: Vec<u32>,
    ends: Vec<f64>,
}

impl Intervals {
    /// As [`Hatch::new`].
    pub fn new(region: &[Ring], (cosine, sine): (f64, f64), spacing: f64) -> Self {
        let turned = |point: Point| {
            let (x, y) = (f64::from(point.x), f64::from(point.y));
            (x * cosine + y * sine, y * cosine - x * sine)
        };
        let mut crossings: Vec<(i64, f64)> = Vec::with_capacity(region.iter().map(|ring| ring.0.len()).sum());
        for ring in region {
            let Some(last) = ring.0.last() else { continue };
            let mut a = turned(*last);
            for point in &ring.0 {
                let b = turned(*point);
                each_row(a, b, spacing, |row, x| crossings.push((row, x)));
                a = b;
            }
        }
        let (first, starts, order) = by_row(crossings.iter().map(|crossing| crossing.0));
        let mut ends: Vec<f64> = order.into_iter().map(|index| crossings[index as usize].1).collect();
        for row in starts.windows(2) {
            ends[row[0] as usize..row[1] as usize].sort_unstable_by(f64::total_cmp);
        }
        Self { first, starts, ends }
    }

    /// The intervals of the row with a number, none where the region does not reach.
    pub fn row(&self, number: i64) -> impl Iterator<Item = (f64, f64)> + Clone {
        let row =
            usize::try_from(number - self.first).ok().and_then(|index| self.starts.get(index..index + 2));
        let ends = row.map_or(&[][..], |row| &self.ends[row[0] as usize..row[1] as usize]);
        ends.chunks_exact(2).map(|pair| (pair[0], pair[1]))
    }
}

/// The points of all rings in the frame turned so that the direction is level, and where each ring lies in them.
fn turned(region: &[Ring], (cosine, sine): (f64, f64)) -> (Vec<(f64, f64)>, Vec<std::ops::Range<usize>>) {
    let mut points = Vec::with_capacity(region.iter().map(|ring| ring.0.len()).sum());
    let mut rings = Vec::with_capacity(region.len());
    for ring in region {
        let start = points.len();
        points.extend(ring.0.iter().map(|point| {
            let (x, y) = (f64::from(point.x), f64::from(point.y));
            (x * cosine + y * sine, y * cosine - x * sine)
        }));
        rings.push(start..points.len());
    }
    (points, rings)
}

/// The height of the first row and how far apart rows lie that fit between the lowest and the highest of some points.
fn fitted_rows(points: &[(f64, f64)], spacing: f64) -> (f64, f64) {
    let heights = points.iter().map(|point| point.1);
    let (low, high) =
        heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    // A row on the very end has no length; a micron inside it has that of the side it runs along.
    let room = high - low - 2.0;
    let gaps = (room / spacing + 0.5).floor();
    if gaps < 1.0 { (f64::midpoint(low, high), spacing.max(room + 4.0)) } else { (low + 1.0, room / gaps) }
}

/// Every row that a side crosses, with where: a row is crossed when exactly one end lies above it.
#[inline]
fn each_row(a: (f64, f64), b: (f64, f64), spacing: f64, mut cross: impl FnMut(i64, f64)) {
    let (below, above) = (ceiling(a.1 / spacing), ceiling(b.1 / spacing));
    if below == above {
        return;
    }
    let slope = (b.0 - a.0) / (b.1 - a.1);
    let (low, high) = (a.0.min(b.0), a.0.max(b.0));
    let mut at = |row: i64| cross(row, (a.0 + (row as f64 * spacing - a.1) * slope).clamp(low, high));
    if below < above {
        (below..above).for_each(&mut at);
    } else {
        (above..below).rev().for_each(&mut at);
    }
}

/// Sorts indices by row: the lowest row, where each row's indices begin, and the indices.
fn by_row(rows: impl Iterator<Item = i64> + Clone) -> (i64, Vec<u32>, Vec<u32>) {
    let Some((first, last)) = rows.clone().fold(None, |range: Option<(i64, i64)>, row| {
        Some(range.map_or((row, row), |(low, high)| (low.min(row), high.max(row))))
    }) else {
        return (0, vec![0], Vec::new());
    };
    let mut starts = vec![0u32; (last - first + 2) as usize];
    let mut count = 0;
    for row in rows.clone() {
        starts[(row - first + 1) as usize] += 1;
        count += 1;
    }
    for index in 1..starts.len() {
        starts[index] += starts[index - 1];
    }
    let mut next = starts.clone();
    let mut order = vec![0u32; count];
    for (index, row) in rows.enumerate() {
        let place = &mut next[(row - first) as usize];
        order[*place as usize] = index as u32;
        *place += 1;
    }
    (first, starts, order)
}

/// Which spans have been used, and which span ends at a crossing.
struct Book<'a> {
    hatch: &'a Hatch,
    rows: &'a Rows,
    used: Vec<bool>,
    /// For every crossing the span that ends there.
    at_crossing: Vec<Option<u32>>,
}

/// How a thread goes on: the span it enters, at which end, and the points on the way.
struct Joint {
    row: usize,
    span: usize,
    enter_right: bool,
    way: Vec<Point>,
}

impl<'a> Book<'a> {
    fn new(hatch: &'a Hatch, rows: &'a Rows) -> Self {
        let mut at_crossing = vec![None; hatch.crossings.len()];
        for (index, span) in rows.spans.iter().enumerate() {
            for crossing in [span.left, span.right].into_iter().filter_map(|end| end.crossing) {
                at_crossing[crossing as usize] = Some(index as u32);
            }
        }
        Self { hatch, rows, used: vec![false; rows.spans.len()], at_crossing }
    }

    /// Follows a thread from a span to where nothing leads on.
    fn thread(&mut self, mut row: usize, mut span: usize, mut to_right: bool, reach: f64) -> Vec<Point> {
        let mut points = Vec::new();
        loop {
            let Span { left, right } = self.rows.spans[span];
            let height = self.hatch.height(self.hatch.first + row as i64);
            let (from, to) = if to_right { (left, right) } else { (right, left) };
            for end in [from, to] {
                push(&mut points, self.hatch.turned_back(end.x, height));
            }
            let Some(joint) = self.next(row, span, to_right, reach) else { return points };
            joint.way.into_iter().for_each(|point| push(&mut points, point));
            self.used[joint.span] = true;
            (row, span, to_right) = (joint.row, joint.span, !joint.enter_right);
        }
    }

    /// Where a thread goes on from the right or left end of a span: to the row above, else to the one below.
    fn next(&self, row: usize, span: usize, right: bool, reach: f64) -> Option<Joint> {
        let span = self.rows.spans[span];
        let end = if right { span.right } else { span.left };
        match end.crossing {
            Some(crossing) => self.along_ring(crossing, reach),
            None => self.across(row, end.x, right, reach),
        }
    }

    fn along_ring(&self, crossing: u32, reach: f64) -> Option<Joint> {
        let here = self.hatch.crossings[crossing as usize];
        let mut neighbours = [(here.before, false), (here.after, true)];
        neighbours.sort_by_key(|(other, _)| std::cmp::Reverse(self.hatch.crossings[*other as usize].row));
        neighbours.into_iter().find_map(|(other, forwards)| {
            let there = self.hatch.crossings[other as usize];
            let span = self.at_crossing[other as usize]? as usize;
            if (there.row - here.row).abs() != 1 || self.used[span] {
                return None;
            }
            let way = self.way(here, there, forwards, reach)?;
            let enter_right = self.rows.spans[span].right.crossing == Some(other);
            Some(Joint { row: (there.row - self.hatch.first) as usize, span, enter_right, way })
        })
    }

    /// The corners of the ring between two neighbouring crossings; `None` when the way is too long.
    fn way(&self, from: Crossing, to: Crossing, forwards: bool, reach: f64) -> Option<Vec<Point>> {
        let hatch = self.hatch;
        let mut here = (from.x, hatch.height(from.row));
        let mut length = 0.0;
        let mut way = Vec::new();
        let mut step = |place: (f64, f64)| {
            length += ((place.0 - here.0).powi(2) + (place.1 - here.1).powi(2)).sqrt();
            here = place;
            length <= reach
        };
        for corner in hatch.corners(from, to, forwards) {
            if !step(corner) {
                return None;
            }
            way.push(hatch.turned_back(corner.0, corner.1));
        }
        step((to.x, hatch.height(to.row))).then_some(way)
    }

    fn across(&self, row: usize, x: f64, right: bool, reach: f64) -> Option<Joint> {
        let reach2 = reach * reach - self.hatch.spacing * self.hatch.spacing;
        [Some(row + 1), row.checked_sub(1)].into_iter().flatten().find_map(|other| {
            self.rows.range(other).find_map(|span| {
                let Span { left, right: far } = self.rows.spans[span];
                let end = if right { far } else { left };
                let fits = end.crossing.is_none() && (end.x - x).powi(2) <= reach2 && !self.used[span];
                fits.then(|| Joint { row: other, span, enter_right: right, way: Vec::new() })
            })
        })
    }
}

/// The least whole number not below a value. (`f64::ceil` is a call into a library on plain x86-64.)
fn ceiling(value: f64) -> i64 {
    let whole = value as i64;
    whole + i64::from(whole as f64 != value && value > 0.0)
}

fn push(points: &mut Vec<Point>, point: Point) {
    if points.last() != Some(&point) {
        points.push(point);
    }
}
