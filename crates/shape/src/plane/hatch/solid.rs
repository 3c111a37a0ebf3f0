//! Rows that fill a region to its border, with as much clay as there is room.
//!
//! A row ends near the flank of what is beside the region. Where the border runs straight across the rows, the thread turns
//! with a bead that is as wide as what lies between the ends and the flank. Else it goes to the end of the next row through
//! the strip that the border leaves beside the longer one, with a bead as wide as the strip: a wedge where the border
//! crosses the rows, a segment where it bulges over the last of them. Strips that no thread goes through get beads too, where
//! they are long enough; a thread that ends beside one goes on into it.

use super::{Book, Crossing, Hatch, Span, fitted_rows, push, turned};
use crate::plane::{Point, Ring};

/// A bead with a width for each stretch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// Its corners.
    pub points: Vec<Point>,
    /// How wide it is from each corner to the next, in microns.
    pub widths: Vec<f64>,
}

impl Run {
    /// What it covers, in square microns.
    pub fn area(&self) -> f64 {
        let stretches = self.points.windows(2).zip(&self.widths);
        stretches.map(|(ends, width)| ends[0].distance(ends[1]) * width).sum()
    }

    fn push(&mut self, point: Point, width: f64) {
        let count = self.points.len();
        push(&mut self.points, point);
        if count > 0 && self.points.len() > count {
            self.widths.push(width);
        }
    }

    fn reverse(&mut self) {
        self.points.reverse();
        self.widths.reverse();
    }
}

/// A place of the turned frame in the strip between a row and the border, and how wide the strip is there.
type Place = (f64, f64, f64);

/// A strip that no joint goes through.
struct Strip {
    /// The crossings at the ends of its part of the border.
    ends: [u32; 2],
    places: Vec<Place>,
    area: f64,
}

/// The narrowest bead of a strip, in row spacings: what is narrower is no more than the rows beside it give when they are
/// pressed.
const NARROWEST: f64 = 0.25;
/// How long a strip is that gets a bead of its own, in row spacings.
const SHORTEST: f64 = 0.75;
/// The narrowest bead on the way through a strip to the next row.
const THINNEST: f64 = 0.1;
/// How far the border goes along the rows from one to the next before it leaves a strip beside them, in row spacings.
const STEEP: f64 = 0.25;
/// So many stretches at most are made of one side of a strip.
const FINEST: f64 = 16.0;

impl Hatch {
    /// Cuts rows that [fit](Self::fitted) one region across another that is a little larger.
    pub fn fitted_to(inside: &[Ring], region: &[Ring], direction: (f64, f64), spacing: f64) -> Self {
        let (base, spacing) = fitted_rows(&turned(inside, direction).0, spacing);
        let (points, rings) = turned(region, direction);
        Self::across(points, rings, direction, spacing, base)
    }

    /// Beads that fill the region and what lies within `margin` microns of it: a zig-zag of all rows, and what it does not
    /// reach.
    pub fn filled(&self, margin: f64) -> Vec<Run> {
        Filling::new(self, margin).run()
    }
}

struct Filling<'a> {
    book: Book<'a>,
    hatch: &'a Hatch,
    margin: f64,
    /// For every crossing whether the border from it to the next one has a joint.
    joined: Vec<bool>,
    /// For every crossing the run that begins or ends there, and whether it ends.
    tips: Vec<Option<(usize, bool)>>,
}

impl<'a> Filling<'a> {
    fn new(hatch: &'a Hatch, margin: f64) -> Self {
        let count = hatch.crossings.len();
        let book = Book::new(hatch, &hatch.rows);
        Self { book, hatch, margin, joined: vec![false; count], tips: vec![None; count] }
    }

    fn run(mut self) -> Vec<Run> {
        let mut runs = Vec::new();
        let rows = self.hatch.rows.ends.len();
        for row in 0..rows {
            for span in self.hatch.rows.range(row) {
                if !std::mem::replace(&mut self.book.used[span], true) {
                    let run = self.thread(span, runs.len());
                    runs.push(run);
                }
            }
        }
        let mut strips: Vec<Strip> = (0..self.joined.len())
            .filter(|index| !self.joined[*index])
            .flat_map(|index| self.strips(index))
            .collect();
        // Large ones first: a thread goes on into one strip at each of its ends.
        strips.sort_by(|one, other| other.area.total_cmp(&one.area).then(one.ends.cmp(&other.ends)));
        for strip in strips {
            let mut run = Run::default();
            self.lay(&strip.places, 0.0, &mut run);
            let tip = strip.ends.iter().position(|end| self.tips[*end as usize].is_some());
            match tip.and_then(|side| Some((side, self.tips[strip.ends[side] as usize].take()?))) {
                Some((side, (index, at_end))) => attach(&mut runs[index], run, side == 1, at_end),
                None => runs.push(run),
            }
        }
        runs
    }

    /// Follows a thread from a span to where nothing leads on.
    fn thread(&mut self, mut span: usize, index: usize) -> Run {
        let ends = |Span { left, right }: Span| (left.crossing, right.crossing);
        let (left, right) = ends(self.hatch.rows.spans[span]);
        // Begin at the end that leads nowhere, so that the other one may lead on.
        let mut to_right = right.is_some_and(|crossing| self.next(crossing).is_some());
        self.tip(if to_right { left } else { right }, index, false);
        let mut run = Run::default();
        loop {
            let row = self.hatch.rows.spans[span];
            let (from, to) = if to_right { (row.left, row.right) } else { (row.right, row.left) };
            let Some((start, end)) = from.crossing.zip(to.crossing) else { return run };
            let height = self.hatch.height(self.hatch.crossings[start as usize].row);
            for place in [from, to] {
                run.push(self.hatch.turned_back(place.x, height), self.hatch.spacing);
            }
            let Some((other, forwards)) = self.next(end) else {
                self.tip(Some(end), index, true);
                return run;
            };
            self.joined[if forwards { end } else { other } as usize] = true;
            self.joint(end, other, forwards, &mut run);
            let Some(next) = self.book.at_crossing[other as usize] else { return run };
            span = next as usize;
            self.book.used[span] = true;
            to_right = self.hatch.rows.spans[span].left.crossing == Some(other);
        }
    }

    fn tip(&mut self, crossing: Option<u32>, run: usize, at_end: bool) {
        if let Some(crossing) = crossing {
            self.tips[crossing as usize] = Some((run, at_end));
        }
    }

    /// The crossing along the border that a thread goes on to: on the row above, else on the one below.
    fn next(&self, crossing: u32) -> Option<(u32, bool)> {
        let here = self.hatch.crossings[crossing as usize];
        let mut neighbours = [(here.before, false), (here.after, true)];
        neighbours.sort_by_key(|(other, _)| std::cmp::Reverse(self.hatch.crossings[*other as usize].row));
        neighbours.into_iter().find(|(other, _)| {
            let there = self.hatch.crossings[*other as usize];
            let span = self.book.at_crossing[*other as usize];
            (there.row - here.row).abs() == 1 && span.is_some_and(|span| !self.book.used[span as usize])
        })
    }

    /// The way along the border from one row to the next.
    fn joint(&self, from: u32, to: u32, forwards: bool, run: &mut Run) {
        let (here, there) = (self.hatch.crossings[from as usize], self.hatch.crossings[to as usize]);
        let border = self.border(here, there, forwards);
        if (here.x - there.x).abs() <= STEEP * self.hatch.spacing {
            for (x, y) in border {
                run.push(self.hatch.turned_back(x, y), 2.0 * self.margin);
            }
            return;
        }
        let thin = THINNEST * self.hatch.spacing;
        for places in wide_parts(&self.places(&border, here.row, forwards), thin) {
            self.lay(&places, thin, run);
        }
        run.push(self.hatch.turned_back(there.x, self.hatch.height(there.row)), thin);
    }

    /// The strips along the border from a crossing to the next, where they are wide and long enough for a bead.
    fn strips(&self, index: usize) -> Vec<Strip> {
        let here = self.hatch.crossings[index];
        let there = self.hatch.crossings[here.after as usize];
        let spacing = self.hatch.spacing;
        // Most parts of a border run across the rows.
        if (here.x - there.x).abs() < SHORTEST * spacing {
            return Vec::new();
        }
        let border = self.border(here, there, true);
        let places = self.places(&border, here.row, true);
        let strip = |places: Vec<Place>| {
            let pairs = || places.windows(2);
            let length: f64 = pairs().map(|pair| (pair[0].0 - pair[1].0).abs()).sum();
            let area =
                pairs().map(|pair| (pair[0].0 - pair[1].0).abs() * f64::midpoint(pair[0].2, pair[1].2)).sum();
            (length >= SHORTEST * spacing).then_some(Strip { ends: [index as u32, here.after], places, area })
        };
        wide_parts(&places, NARROWEST * spacing).into_iter().filter_map(strip).collect()
    }

    /// The corners of the border between two neighbouring crossings, both included, in the turned frame.
    fn border(&self, from: Crossing, to: Crossing, forwards: bool) -> Vec<(f64, f64)> {
        let start = (from.x, self.hatch.height(from.row));
        let end = (to.x, self.hatch.height(to.row));
        std::iter::once(start).chain(self.hatch.corners(from, to, forwards)).chain([end]).collect()
    }

    /// The middle of the strip between the border and the row that it runs beside, and how wide it is, at every corner of the
    /// border between two neighbouring crossings.
    fn places(&self, border: &[(f64, f64)], row: i64, forwards: bool) -> Vec<Place> {
        let (Some(first), Some(last)) = (border.first(), border.last()) else { return Vec::new() };
        let spacing = self.hatch.spacing;
        let rise = border.iter().map(|place| place.1 - first.1).find(|rise| *rise != 0.0);
        let low = self.hatch.height(if rise.is_none_or(|rise| rise > 0.0) { row } else { row - 1 });
        // The region lies to the left of its border, so the row is below a border that goes to the left.
        let is_below = (last.0 < first.0) == forwards;
        let place = |&(x, y): &(f64, f64)| {
            let high = if is_below { y - low } else { low + spacing - y };
            let width = (high + self.margin - spacing / 2.0).min(spacing);
            let middle = (spacing + width.max(0.0)) / 2.0;
            (x, if is_below { low + middle } else { low + spacing - middle }, width)
        };
        border.iter().map(place).collect()
    }

    /// Lays a bead in a strip; `over` is the way to where it begins.
    fn lay(&self, places: &[Place], over: f64, run: &mut Run) {
        let Some(&(x, y, mut before)) = places.first() else { return };
        run.push(self.hatch.turned_back(x, y), over);
        for pair in places.windows(2) {
            let ((u, v, _), (x, y, width)) = (pair[0], pair[1]);
            // Cut so finely that no stretch differs much in width from the next.
            let count = ((x - u).abs() / self.hatch.spacing).ceil().clamp(1.0, FINEST);
            for part in 1..=count as u32 {
                let share = f64::from(part) / count;
                let at = |from: f64, to: f64, share: f64| from + (to - from) * share;
                let middle = at(before, width, share - 0.5 / count);
                run.push(self.hatch.turned_back(at(u, x, share), at(v, y, share)), middle);
            }
            before = width;
        }
    }
}

/// The parts of a strip that are at least so wide.
fn wide_parts(places: &[Place], least: f64) -> Vec<Vec<Place>> {
    let mut parts = Vec::new();
    let mut part: Vec<Place> = Vec::new();
    for (index, &place) in places.iter().enumerate() {
        let before = places[index.saturating_sub(1)];
        if (before.2 >= least) != (place.2 >= least) {
            let share = (least - before.2) / (place.2 - before.2);
            let along = |from: f64, to: f64| from + (to - from) * share;
            part.push((along(before.0, place.0), along(before.1, place.1), least));
        }
        if place.2 >= least {
            part.push(place);
        } else if !part.is_empty() {
            parts.push(std::mem::take(&mut part));
        }
    }
    if !part.is_empty() {
        parts.push(part);
    }
    parts
}

/// Adds a run to an end of another, `backwards` when the two meet at its end.
fn attach(run: &mut Run, mut more: Run, backwards: bool, at_end: bool) {
    if backwards == at_end {
        more.reverse();
    }
    let over = more.widths.iter().copied().fold(f64::INFINITY, f64::min);
    if !at_end {
        std::mem::swap(run, &mut more);
    }
    let mut points = more.points.into_iter();
    if let Some(first) = points.next() {
        run.push(first, over);
    }
    for (point, width) in points.zip(more.widths) {
        run.push(point, width);
    }
}
