//! Parallel lines across a region, and zig-zag threads made of them.
//!
//! Work happens in a frame turned so that the lines are level. A row is a line of the hatch; where it crosses the
//! region's rings it is cut into spans. Every crossing knows its neighbours along its ring, so a thread can go from
//! the end of one row to the next row along the very outline of the region: such a joint crosses nothing.

use super::{Point, Ring};

/// The rows of a hatch, from the lowest up.
pub struct Hatch {
    cosine: f64,
    sine: f64,
    spacing: f64,
    /// The number of the lowest row; row `k` lies at height `k` × spacing in the turned frame.
    first: i64,
    rows: Vec<Vec<Span>>,
    crossings: Vec<Crossing>,
    /// The turned points of all rings, one ring after the other.
    points: Vec<(f64, f64)>,
    rings: Vec<std::ops::Range<usize>>,
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
    pub fn new(region: &[Ring], (cosine, sine): (f64, f64), spacing: f64) -> Self {
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
        let mut crossings: Vec<Crossing> = Vec::new();
        for ring in &rings {
            let from = crossings.len() as u32;
            for side in ring.clone() {
                let (a, b) = (points[side], points[if side + 1 == ring.end { ring.start } else { side + 1 }]);
                // A row is crossed when exactly one end lies above it.
                let (below, above) = (ceiling(a.1 / spacing), ceiling(b.1 / spacing));
                let mut cross = |row: i64| {
                    let share = (row as f64 * spacing - a.1) / (b.1 - a.1);
                    let x = a.0 + share.clamp(0.0, 1.0) * (b.0 - a.0);
                    crossings.push(Crossing { x, row, side: side as u32, before: 0, after: 0 });
                };
                if below < above {
                    (below..above).for_each(&mut cross);
                } else {
                    (above..below).rev().for_each(&mut cross);
                }
            }
            let to = crossings.len() as u32;
            for index in from..to {
                crossings[index as usize].before = if index == from { to - 1 } else { index - 1 };
                crossings[index as usize].after = if index + 1 == to { from } else { index + 1 };
            }
        }
        let first = crossings.iter().map(|crossing| crossing.row).min().unwrap_or(0);
        let last = crossings.iter().map(|crossing| crossing.row).max().unwrap_or(-1);
        let mut ends: Vec<Vec<u32>> = vec![Vec::new(); (last - first + 1).max(0) as usize];
        for (index, crossing) in crossings.iter().enumerate() {
            ends[(crossing.row - first) as usize].push(index as u32);
        }
        let rows = ends
            .into_iter()
            .map(|mut row| {
                row.sort_unstable_by(|one, other| {
                    crossings[*one as usize].x.total_cmp(&crossings[*other as usize].x).then(one.cmp(other))
                });
                let end = |index: u32| End { x: crossings[index as usize].x, crossing: Some(index) };
                row.chunks_exact(2).map(|pair| Span { left: end(pair[0]), right: end(pair[1]) }).collect()
            })
            .collect();
        Self { cosine, sine, spacing, first, rows, crossings, points, rings }
    }

    /// The number of the lowest row.
    pub fn first(&self) -> i64 {
        self.first
    }

    /// The spans of every row, from the lowest up.
    pub fn rows(&self) -> &[Vec<Span>] {
        &self.rows
    }

    /// The spans of the row with a number, none where the region does not reach.
    pub fn row(&self, number: i64) -> &[Span] {
        usize::try_from(number - self.first)
            .ok()
            .and_then(|index| self.rows.get(index))
            .map_or(&[], Vec::as_slice)
    }

    /// The height of a row in the turned frame.
    pub fn height(&self, number: i64) -> f64 {
        number as f64 * self.spacing
    }

    /// Joins spans to threads: each goes along a span, over to the next row, and back. `rows` holds for every row of
    /// the hatch the parts of its spans that are wanted, in order. A joint along the outline is at most `reach`
    /// microns long; cut ends of neighbouring rows are joined straight when they are at most `reach` apart.
    pub fn threads(&self, rows: &[Vec<Span>], reach: f64) -> Vec<Vec<Point>> {
        let mut book = Book::new(self, rows);
        let mut threads = Vec::new();
        for (row, spans) in rows.iter().enumerate() {
            for index in 0..spans.len() {
                if book.used[row][index] {
                    continue;
                }
                book.used[row][index] = true;
                // Begin at the end that leads nowhere, so that the other one may lead on.
                let leads_on = book.next(row, index, true, reach).is_some();
                threads.push(book.thread(row, index, leads_on, reach));
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

/// Which spans have been used, and which span ends at a crossing.
struct Book<'a> {
    hatch: &'a Hatch,
    rows: &'a [Vec<Span>],
    used: Vec<Vec<bool>>,
    /// For every crossing the span (row, index) that ends there.
    at_crossing: Vec<Option<(u32, u32)>>,
}

/// How a thread goes on: the span it enters, at which end, and the points on the way.
struct Joint {
    row: usize,
    index: usize,
    enter_right: bool,
    way: Vec<Point>,
}

impl<'a> Book<'a> {
    fn new(hatch: &'a Hatch, rows: &'a [Vec<Span>]) -> Self {
        let mut at_crossing = vec![None; hatch.crossings.len()];
        for (row, spans) in rows.iter().enumerate() {
            for (index, span) in spans.iter().enumerate() {
                for end in [span.left, span.right] {
                    if let Some(crossing) = end.crossing {
                        at_crossing[crossing as usize] = Some((row as u32, index as u32));
                    }
                }
            }
        }
        Self { hatch, rows, used: rows.iter().map(|spans| vec![false; spans.len()]).collect(), at_crossing }
    }

    /// Follows a thread from a span to where nothing leads on.
    fn thread(&mut self, mut row: usize, mut index: usize, mut to_right: bool, reach: f64) -> Vec<Point> {
        let mut points = Vec::new();
        loop {
            let span = self.rows[row][index];
            let height = self.hatch.height(self.hatch.first + row as i64);
            let (from, to) = if to_right { (span.left, span.right) } else { (span.right, span.left) };
            for end in [from, to] {
                push(&mut points, self.hatch.turned_back(end.x, height));
            }
            let Some(joint) = self.next(row, index, to_right, reach) else { return points };
            joint.way.into_iter().for_each(|point| push(&mut points, point));
            self.used[joint.row][joint.index] = true;
            (row, index, to_right) = (joint.row, joint.index, !joint.enter_right);
        }
    }

    /// Where a thread goes on from the right or left end of a span: to the row above, else to the one below.
    fn next(&self, row: usize, index: usize, right: bool, reach: f64) -> Option<Joint> {
        let span = self.rows[row][index];
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
            let (row, index) =
                self.at_crossing[other as usize].map(|(row, index)| (row as usize, index as usize))?;
            if (there.row - here.row).abs() != 1 || self.used[row][index] {
                return None;
            }
            let way = self.way(here, there, forwards, reach)?;
            let enter_right = self.rows[row][index].right.crossing == Some(other);
            Some(Joint { row, index, enter_right, way })
        })
    }

    /// The corners of the ring between two neighbouring crossings; `None` when the way is too long.
    fn way(&self, from: Crossing, to: Crossing, forwards: bool, reach: f64) -> Option<Vec<Point>> {
        let hatch = self.hatch;
        let ring = &hatch.rings[hatch.rings.partition_point(|ring| ring.end <= from.side as usize)];
        let (mut side, last) = (from.side as usize, to.side as usize);
        let mut here = (from.x, hatch.height(from.row));
        let mut length = 0.0;
        let mut way = Vec::new();
        let mut step = |place: (f64, f64)| {
            length += ((place.0 - here.0).powi(2) + (place.1 - here.1).powi(2)).sqrt();
            here = place;
            length <= reach
        };
        while side != last {
            let corner;
            if forwards {
                side = if side + 1 == ring.end { ring.start } else { side + 1 };
                corner = hatch.points[side];
            } else {
                corner = hatch.points[side];
                side = if side == ring.start { ring.end - 1 } else { side - 1 };
            }
            if !step(corner) {
                return None;
            }
            way.push(hatch.turned_back(corner.0, corner.1));
        }
        step((to.x, hatch.height(to.row))).then_some(way)
    }

    fn across(&self, row: usize, x: f64, right: bool, reach: f64) -> Option<Joint> {
        let gap = |end: End| (end.x - x).hypot(self.hatch.spacing);
        [row + 1, row.wrapping_sub(1)].into_iter().find_map(|other| {
            let spans = self.rows.get(other)?;
            spans.iter().enumerate().find_map(|(index, span)| {
                let end = if right { span.right } else { span.left };
                let fits = end.crossing.is_none() && gap(end) <= reach && !self.used[other][index];
                fits.then(|| Joint { row: other, index, enter_right: right, way: Vec::new() })
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
