//! The parts of any lines that lie inside a region, and threads made of them.
//!
//! Every cut end knows its place on the region's outline, so a thread can go from the end of one part to the next end
//! along the very outline: such a joint crosses nothing. The outline's sides are filed in a grid, so a line is compared
//! only with those beside it.

use super::vector::V;
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
/// there when that is at most `reach` microns away, and on. What is shorter than `least` is left out.
pub fn threads(lines: &[Line], region: &[Ring], reach: f64, least: f64) -> Vec<Thread> {
    let Some(grid) = Grid::new(region) else { return Vec::new() };
    let mut book = Book { region, parts: Vec::new() };
    let mut whole = Vec::new();
    for line in lines {
        if grid.cut(line, region, &mut book.parts) && grid.holds(line, region) {
            whole.push(Thread {
                points: line.points.iter().map(|point| rounded(*point)).collect(),
                closed: line.closed,
            });
        }
    }
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
    points: Vec<Point>,
    ends: [Spot; 2],
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
    fn cut(&self, line: &Line, region: &[Ring], parts: &mut Vec<Part>) -> bool {
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
                    parts.push(part(line, &crossings[entry], crossing));
                    inside = None;
                }
                (false, None) => {}
            }
        }
        if line.closed
            && let (Some(entry), Some(leave)) = (inside, crossings.iter().find(|crossing| !crossing.enters))
        {
            parts.push(part(line, &crossings[entry], leave));
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
fn part(line: &Line, entry: &Crossing, leave: &Crossing) -> Part {
    let count = line.points.len();
    let mut points = vec![rounded(entry.place)];
    let (first, last) = (entry.along as usize + 1, leave.along as usize);
    let round = line.closed && leave.along < entry.along;
    let corners = if round { (first..count).chain(0..last + 1) } else { (first..last + 1).chain(0..0) };
    for corner in corners {
        push(&mut points, rounded(line.points[corner]));
    }
    push(&mut points, rounded(leave.place));
    Part { points, ends: [entry.spot, leave.spot] }
}

/// The parts of all lines, to be joined.
struct Book<'a> {
    region: &'a [Ring],
    parts: Vec<Part>,
}

/// The number of a part, and which of its two ends.
type End = (usize, usize);

/// A way along the outline from one end to the next.
struct Joint {
    ends: [End; 2],
    way: Vec<Point>,
    length: f64,
}

impl Book<'_> {
    /// Joins the parts, each end once and nothing to a circle: first from line to line as far as that goes, then what is
    /// left, the shortest ways first.
    fn threads(&self, reach: f64) -> Vec<Thread> {
        let mut joints = self.joints(reach);
        joints.sort_by(|one, other| one.length.total_cmp(&other.length));
        let mut knots = Knots::new(self.parts.len(), &joints);
        for first in 0..self.parts.len() {
            for end in [1, 0] {
                let mut here = (first, end);
                while let Some((part, end)) = knots.go_on(here, &joints) {
                    here = (part, 1 - end);
                }
            }
        }
        for index in 0..joints.len() {
            knots.tie(index, &joints);
        }
        let mut done = vec![false; self.parts.len()];
        let mut threads = Vec::new();
        for first in 0..self.parts.len() {
            let free = knots.at[first].iter().position(Option::is_none);
            if let (false, Some(enter)) = (done[first], free) {
                threads.push(self.thread((first, enter), &knots.at, &joints, &mut done));
            }
        }
        threads
    }

    /// Follows a thread from where it begins.
    fn thread(
        &self,
        mut enter: End,
        at: &[[Option<usize>; 2]],
        joints: &[Joint],
        done: &mut [bool],
    ) -> Thread {
        let mut points = Vec::new();
        loop {
            let (part, end) = enter;
            done[part] = true;
            push_all(&mut points, &self.parts[part].points, end == 0);
            let Some(joint) = at[part][1 - end].map(|index| &joints[index]) else {
                return Thread { points, closed: false };
            };
            let forwards = joint.ends[0] == (part, 1 - end);
            push_all(&mut points, &joint.way, forwards);
            enter = joint.ends[usize::from(forwards)];
        }
    }

    /// Every way along the outline from an end to the next that is short enough.
    fn joints(&self, reach: f64) -> Vec<Joint> {
        let spot = |end: &End| self.parts[end.0].ends[end.1];
        let mut ends: Vec<End> = (0..self.parts.len()).flat_map(|part| [(part, 0), (part, 1)]).collect();
        ends.sort_by(|one, other| {
            let (one, other) = (spot(one), spot(other));
            one.ring.cmp(&other.ring).then(one.side.cmp(&other.side)).then(one.share.total_cmp(&other.share))
        });
        let mut joints = Vec::new();
        for ring in ends.chunk_by(|one, other| spot(one).ring == spot(other).ring) {
            for (from, to) in ring.iter().zip(ring.iter().skip(1).chain(ring.first())) {
                if let Some((way, length)) = self.way(spot(from), spot(to), reach) {
                    joints.push(Joint { ends: [*from, *to], way, length });
                }
            }
        }
        joints
    }

    /// The corners of the outline from one spot forwards to another, and how long the way is; `None` when it is too long.
    fn way(&self, from: Spot, to: Spot, reach: f64) -> Option<(Vec<Point>, f64)> {
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
        step(place(to)).then_some((way, length))
    }
}

/// Which joints are made.
struct Knots {
    /// The joint made at each end of each part.
    at: Vec<[Option<usize>; 2]>,
    /// The joints that could be made there.
    could: Vec<[Vec<usize>; 2]>,
    /// A part that each part is joined to; itself for the first of its thread.
    group: Vec<usize>,
}

impl Knots {
    fn new(parts: usize, joints: &[Joint]) -> Self {
        let mut could: Vec<[Vec<usize>; 2]> = vec![Default::default(); parts];
        for (index, joint) in joints.iter().enumerate() {
            joint.ends.iter().for_each(|(part, end)| could[*part][*end].push(index));
        }
        Self { at: vec![[None; 2]; parts], could, group: (0..parts).collect() }
    }

    /// Makes a joint from an end, to the part of the later line when there are two, and says where it leads.
    fn go_on(&mut self, from: End, joints: &[Joint]) -> Option<End> {
        let other = |index: &usize| {
            let [one, other] = joints[*index].ends;
            if one == from { other } else { one }
        };
        let mut ways = self.could[from.0][from.1].clone();
        ways.sort_by_key(|way| std::cmp::Reverse(other(way).0));
        let way = ways.into_iter().find(|way| self.tie(*way, joints))?;
        Some(other(&way))
    }

    /// Makes a joint if both its ends are free and not of one thread; says whether it did.
    fn tie(&mut self, index: usize, joints: &[Joint]) -> bool {
        let ends = joints[index].ends;
        let [one, other] = ends.map(|(part, _)| self.root(part));
        let free = one != other && ends.iter().all(|(part, end)| self.at[*part][*end].is_none());
        if free {
            self.group[one.max(other)] = one.min(other);
            ends.iter().for_each(|(part, end)| self.at[*part][*end] = Some(index));
        }
        free
    }

    fn root(&mut self, mut part: usize) -> usize {
        while self.group[part] != part {
            self.group[part] = self.group[self.group[part]];
            part = self.group[part];
        }
        part
    }
}

/// The sides of a line, the one that closes it last.
///
/// Each is moved off the whole microns in which outlines have their corners, by far less than is printed and far more than
/// the error of a float, so that a line that is drawn in whole microns, too, goes through no corner and along no side.
fn stretches(line: &Line) -> impl Iterator<Item = ((f64, f64), (f64, f64))> + '_ {
    let closing = line.points.first().filter(|_| line.closed);
    let moved = |point: &(f64, f64)| (point.0 + 1.23e-4, point.1 + 4.57e-4);
    line.points
        .iter()
        .zip(line.points.iter().skip(1).chain(closing))
        .map(move |(from, to)| (moved(from), moved(to)))
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

fn push_all(points: &mut Vec<Point>, more: &[Point], forwards: bool) {
    if forwards {
        more.iter().for_each(|point| push(points, *point));
    } else {
        more.iter().rev().for_each(|point| push(points, *point));
    }
}

fn push(points: &mut Vec<Point>, point: Point) {
    if points.last() != Some(&point) {
        points.push(point);
    }
}
