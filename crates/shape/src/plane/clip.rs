//! The parts of any lines that lie inside a region, and threads made of them.
//!
//! Every cut end knows its place on the region's outline, so a thread can go from the end of one part to the next end
//! along the very outline: such a joint crosses nothing. The outline's sides are filed in a grid, so a line is compared
//! only with those beside it.

use super::curves::V;
use super::{Point, Ring};

/// A line to be cut: its points in microns; a closed one does not repeat its first.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The points.
    pub points: Vec<(f64, f64)>,
    /// Whether it returns to its first point.
    pub closed: bool,
}

/// A line in whole microns, as it comes out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Thread {
    /// The points.
    pub points: Vec<Point>,
    /// Whether it returns to its first point.
    pub closed: bool,
}

/// The parts of lines inside a region, joined to threads: each goes along a part, along the outline to the next end
/// there when that is at most `reach` microns away, and on. Parts of later lines are preferred, so that threads go
/// through the lines in order. What is shorter than `least` is left out.
pub fn threads(lines: &[Line], region: &[Ring], reach: f64, least: f64) -> Vec<Thread> {
    let Some(grid) = Grid::new(region) else { return Vec::new() };
    let mut book = Book { region, parts: Vec::new(), ends: Vec::new(), places: Vec::new() };
    let mut whole = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        if grid.cut(line, region, index, &mut book.parts) && grid.holds(line, region) {
            whole.push(Thread {
                points: line.points.iter().map(|point| rounded(*point)).collect(),
                closed: line.closed,
            });
        }
    }
    book.file();
    let mut threads = book.threads(reach);
    threads.append(&mut whole);
    threads.retain(|thread| thread.points.len() > 1 && length(&thread.points) >= least);
    threads
}

/// A place on the outline.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Spot {
    ring: usize,
    /// The side, as the index of its first point.
    side: usize,
    /// How far along the side, from 0 to 1.
    share: f64,
}

/// A part of a line from where it enters the region to where it leaves it.
struct Part {
    line: usize,
    points: Vec<Point>,
    ends: [Spot; 2],
    used: bool,
}

/// A line crossing the outline.
struct Crossing {
    /// How far along the line, in sides.
    along: f64,
    enters: bool,
    spot: Spot,
    place: (f64, f64),
}

/// The sides of the outline by the cells they touch.
struct Grid {
    low: (f64, f64),
    cell: f64,
    columns: usize,
    rows: usize,
    /// Where the sides of each cell begin in `sides`.
    starts: Vec<u32>,
    /// Ring and side.
    sides: Vec<(u32, u32)>,
}

impl Grid {
    /// `None` for a region without points.
    fn new(region: &[Ring]) -> Option<Self> {
        let bounds = region.iter().filter_map(Ring::bounds);
        let (low, high) = bounds.reduce(|(low, high), (least, most)| {
            (
                Point::new(low.x.min(least.x), low.y.min(least.y)),
                Point::new(high.x.max(most.x), high.y.max(most.y)),
            )
        })?;
        let (width, height) = low.delta(high);
        let (width, height) = (width as f64 + 2.0, height as f64 + 2.0);
        // As many cells as sides: memory and time stay linear in the outline.
        let count: usize = region.iter().map(|ring| ring.0.len()).sum();
        let cell =
            (width * height / count as f64).sqrt().max(width.max(height) / (4.0 * count as f64)).max(1.0);
        let columns = (width / cell) as usize + 1;
        let rows = (height / cell) as usize + 1;
        let low = (f64::from(low.x) - 1.0, f64::from(low.y) - 1.0);
        let mut grid =
            Self { low, cell, columns, rows, starts: vec![0; columns * rows + 1], sides: Vec::new() };
        let mut filed: Vec<(u32, (u32, u32))> = Vec::with_capacity(3 * count);
        for (ring, points) in region.iter().enumerate() {
            for (side, (from, to)) in points.segments().enumerate() {
                grid.each_cell(floats(from), floats(to), |cell| {
                    filed.push((cell as u32, (ring as u32, side as u32)))
                });
            }
        }
        for (cell, _) in &filed {
            grid.starts[*cell as usize + 1] += 1;
        }
        for index in 1..grid.starts.len() {
            grid.starts[index] += grid.starts[index - 1];
        }
        let mut next = grid.starts.clone();
        grid.sides = vec![(0, 0); filed.len()];
        for (cell, side) in filed {
            let place = &mut next[cell as usize];
            grid.sides[*place as usize] = side;
            *place += 1;
        }
        Some(grid)
    }

    /// Every cell that a stretch touches, row by row; a hair more on each side, so that rounding misses none.
    fn each_cell(&self, a: (f64, f64), b: (f64, f64), mut visit: impl FnMut(usize)) {
        const HAIR: f64 = 1e-6;
        let scaled =
            |point: (f64, f64)| ((point.0 - self.low.0) / self.cell, (point.1 - self.low.1) / self.cell);
        let (a, b) = (scaled(a), scaled(b));
        let (low, high) = if a.1 <= b.1 { (a, b) } else { (b, a) };
        if high.1 < -HAIR || low.1 > self.rows as f64 + HAIR {
            return;
        }
        let slope = if high.1 > low.1 { (high.0 - low.0) / (high.1 - low.1) } else { 0.0 };
        let first = (low.1 - HAIR).max(0.0) as usize;
        let last = ((high.1 + HAIR).max(0.0) as usize).min(self.rows - 1);
        for row in first..=last {
            let at = |y: f64| low.0 + (y.clamp(low.1, high.1) - low.1) * slope;
            let (one, other) = if high.1 - low.1 > HAIR {
                (at(row as f64 - HAIR), at(row as f64 + 1.0 + HAIR))
            } else {
                (low.0, high.0)
            };
            let (left, right) = (one.min(other) - HAIR, one.max(other) + HAIR);
            if right < 0.0 || left >= self.columns as f64 {
                continue;
            }
            for column in left.max(0.0) as usize..=(right as usize).min(self.columns - 1) {
                visit(row * self.columns + column);
            }
        }
    }

    /// Cuts a line; `true` when it meets no outline at all.
    fn cut(&self, line: &Line, region: &[Ring], index: usize, parts: &mut Vec<Part>) -> bool {
        let mut crossings: Vec<Crossing> = Vec::new();
        let mut near: Vec<(u32, u32)> = Vec::new();
        for (number, (a, b)) in stretches(line).enumerate() {
            near.clear();
            self.each_cell(a, b, |cell| {
                near.extend_from_slice(
                    &self.sides[self.starts[cell] as usize..self.starts[cell + 1] as usize],
                );
            });
            if near.is_empty() {
                continue;
            }
            near.sort_unstable();
            near.dedup();
            let from = crossings.len();
            for &(ring, side) in &near {
                crossings.extend(crossing(a, b, number, region, ring as usize, side as usize));
            }
            crossings[from..].sort_by(|one, other| one.along.total_cmp(&other.along));
        }
        if crossings.is_empty() {
            return true;
        }
        let turns = crossings.len();
        // A closed line has no end in the clay: it is followed from where it first enters, once round.
        let start =
            if line.closed { crossings.iter().position(|crossing| crossing.enters).unwrap_or(0) } else { 0 };
        let mut inside: Option<usize> = None;
        let mut step = 0;
        while step < turns {
            let here = (start + step) % turns;
            let crossing = &crossings[here];
            step += 1;
            match (crossing.enters, inside) {
                // A corner of the outline that only touches the line from outside is no end.
                (true, Some(_)) if step < turns => {
                    let next = &crossings[(start + step) % turns];
                    if !next.enters && (next.along - crossing.along).abs() < TOUCH {
                        step += 1;
                        continue;
                    }
                    inside = Some(here);
                }
                (true, _) => inside = Some(here),
                (false, Some(entry)) => {
                    parts.push(part(line, index, &crossings[entry], crossing));
                    inside = None;
                }
                (false, None) => {}
            }
        }
        if line.closed
            && let (Some(entry), Some(leave)) = (inside, crossings.iter().find(|crossing| !crossing.enters))
        {
            parts.push(part(line, index, &crossings[entry], leave));
        }
        false
    }

    /// Whether a line that meets no outline lies inside the region.
    fn holds(&self, line: &Line, region: &[Ring]) -> bool {
        let Some(&first) = line.points.first() else { return false };
        let high = (self.low.0 + self.cell * self.columns as f64, self.low.1 + self.cell * self.rows as f64);
        let near = (self.low.0..=high.0).contains(&first.0) && (self.low.1..=high.1).contains(&first.1);
        near && region.iter().filter(|ring| ring.contains(rounded(first))).count() % 2 == 1
    }
}

/// Crossings nearer to each other than this share of a side are at one place.
const TOUCH: f64 = 1e-9;

/// Where a stretch crosses a side, if it does. What lies on a line counts as left of it, for every stretch and every side
/// alike, so a corner on a line is crossed by both of its sides or by neither.
fn crossing(
    a: (f64, f64),
    b: (f64, f64),
    number: usize,
    region: &[Ring],
    ring: usize,
    side: usize,
) -> Option<Crossing> {
    let points = &region[ring].0;
    let after = if side + 1 == points.len() { 0 } else { side + 1 };
    let (p, q) = (floats(points[side]), floats(points[after]));
    let (from_p, from_q) = (turn(a, b, p), turn(a, b, q));
    let (from_a, from_b) = (turn(p, q, a), turn(p, q, b));
    if (from_p >= 0.0) == (from_q >= 0.0) || (from_a >= 0.0) == (from_b >= 0.0) {
        return None;
    }
    let share = from_p / (from_p - from_q);
    let along = (from_a / (from_a - from_b)).clamp(0.0, 1.0 - TOUCH);
    let place = (p.0 + (q.0 - p.0) * share, p.1 + (q.1 - p.1) * share);
    // Clay lies to the left of every side.
    Some(Crossing {
        along: number as f64 + along,
        enters: from_b >= 0.0,
        spot: Spot { ring, side, share },
        place,
    })
}

/// The points of a line from one crossing to another, round its end if it is closed.
fn part(line: &Line, index: usize, entry: &Crossing, leave: &Crossing) -> Part {
    let count = line.points.len();
    let mut points = vec![rounded(entry.place)];
    let (first, last) = (entry.along as usize + 1, leave.along as usize);
    let round = line.closed && leave.along < entry.along;
    let corners = if round { (first..count).chain(0..last + 1) } else { (first..last + 1).chain(0..0) };
    for corner in corners {
        push(&mut points, rounded(line.points[corner]));
    }
    push(&mut points, rounded(leave.place));
    Part { line: index, points, ends: [entry.spot, leave.spot], used: false }
}

/// The parts, and where their ends lie along the outline.
struct Book<'a> {
    region: &'a [Ring],
    parts: Vec<Part>,
    /// Part and end, along each ring in order.
    ends: Vec<(usize, usize)>,
    /// Where each end of each part stands in `ends`.
    places: Vec<[usize; 2]>,
}

/// How a thread goes on.
struct Joint {
    part: usize,
    end: usize,
    way: Vec<Point>,
}

impl Book<'_> {
    fn file(&mut self) {
        self.ends = (0..self.parts.len()).flat_map(|part| [(part, 0), (part, 1)]).collect();
        let spot = |end: &(usize, usize)| self.parts[end.0].ends[end.1];
        self.ends.sort_by(|one, other| {
            let (one, other) = (spot(one), spot(other));
            one.ring.cmp(&other.ring).then(one.side.cmp(&other.side)).then(one.share.total_cmp(&other.share))
        });
        self.places = vec![[0; 2]; self.parts.len()];
        for (place, &(part, end)) in self.ends.iter().enumerate() {
            self.places[part][end] = place;
        }
    }

    fn threads(&mut self, reach: f64) -> Vec<Thread> {
        let mut threads = Vec::new();
        for first in 0..self.parts.len() {
            if std::mem::replace(&mut self.parts[first].used, true) {
                continue;
            }
            // Begin at the end that leads nowhere, so that the other one may lead on.
            let (mut part, mut enter) = (first, usize::from(self.next(first, 1, reach).is_none()));
            let mut points = Vec::new();
            loop {
                let along = &self.parts[part].points;
                if enter == 0 {
                    along.iter().for_each(|point| push(&mut points, *point));
                } else {
                    along.iter().rev().for_each(|point| push(&mut points, *point));
                }
                let Some(joint) = self.next(part, 1 - enter, reach) else { break };
                joint.way.into_iter().for_each(|point| push(&mut points, point));
                self.parts[joint.part].used = true;
                (part, enter) = (joint.part, joint.end);
            }
            threads.push(Thread { points, closed: false });
        }
        threads
    }

    /// Where a thread goes on from an end of a part: to one of the two ends beside it on the outline.
    fn next(&self, part: usize, end: usize, reach: f64) -> Option<Joint> {
        let here = self.parts[part].ends[end];
        let mut beside =
            [self.beside(self.places[part][end], true), self.beside(self.places[part][end], false)];
        beside.sort_by_key(|other| other.map(|(part, ..)| std::cmp::Reverse(self.parts[part].line)));
        beside.into_iter().flatten().find_map(|(other, its_end, forwards)| {
            if self.parts[other].used {
                return None;
            }
            let there = self.parts[other].ends[its_end];
            let way = if forwards {
                self.way(here, there, reach)?
            } else {
                let mut way = self.way(there, here, reach)?;
                way.reverse();
                way
            };
            Some(Joint { part: other, end: its_end, way })
        })
    }

    /// The end after or before a place on its ring.
    fn beside(&self, place: usize, forwards: bool) -> Option<(usize, usize, bool)> {
        let ring = |place: usize| {
            let (part, end) = self.ends[place];
            self.parts[part].ends[end].ring
        };
        let mine = ring(place);
        // The ends of a ring lie side by side, so its first and last are found by halving.
        let first = self.ends.partition_point(|(part, end)| self.parts[*part].ends[*end].ring < mine);
        let after = self.ends.partition_point(|(part, end)| self.parts[*part].ends[*end].ring <= mine);
        let other = match forwards {
            true if place + 1 == after => first,
            true => place + 1,
            false if place == first => after - 1,
            false => place - 1,
        };
        let (part, end) = self.ends[other];
        (other != place).then_some((part, end, forwards))
    }

    /// The corners of the outline from one spot forwards to another; `None` when the way is too long.
    fn way(&self, from: Spot, to: Spot, reach: f64) -> Option<Vec<Point>> {
        let ring = &self.region[from.ring].0;
        let place = |spot: Spot| {
            let after = if spot.side + 1 == ring.len() { 0 } else { spot.side + 1 };
            let (a, b) = (floats(ring[spot.side]), floats(ring[after]));
            (a.0 + (b.0 - a.0) * spot.share, a.1 + (b.1 - a.1) * spot.share)
        };
        let mut here = place(from);
        let mut length = 0.0;
        let mut step = |next: (f64, f64)| {
            length += ((next.0 - here.0).powi(2) + (next.1 - here.1).powi(2)).sqrt();
            here = next;
            length <= reach
        };
        let mut way = Vec::new();
        let mut side = from.side;
        let mut round = to.side == from.side && to.share < from.share;
        while side != to.side || round {
            round = false;
            side = if side + 1 == ring.len() { 0 } else { side + 1 };
            if !step(floats(ring[side])) {
                return None;
            }
            way.push(ring[side]);
        }
        step(place(to)).then_some(way)
    }
}

/// The sides of a line, the one that closes it last.
fn stretches(line: &Line) -> impl Iterator<Item = ((f64, f64), (f64, f64))> + '_ {
    let closing = line.points.first().filter(|_| line.closed);
    line.points.iter().zip(line.points.iter().skip(1).chain(closing)).map(|(from, to)| (*from, *to))
}

/// Positive when `c` lies to the left of the way from `a` to `b`.
fn turn(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> f64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

fn floats(point: Point) -> (f64, f64) {
    (f64::from(point.x), f64::from(point.y))
}

fn rounded((x, y): (f64, f64)) -> Point {
    V { x, y }.rounded()
}

fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

fn push(points: &mut Vec<Point>, point: Point) {
    if points.last() != Some(&point) {
        points.push(point);
    }
}
