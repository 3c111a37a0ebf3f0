//! The cheapest way from one place of a layer to another, where open air costs more than clay.

use crate::Measures;
use crate::outlines::{Crossing, Outlines, open_share};
use shape::plane::simplified;
use skein::Point;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Knows the outlines of a layer and the corners around which ways may bend.
#[derive(Debug)]
pub struct Guide {
    pub(crate) outlines: Outlines,
    pub(crate) measures: Measures,
    /// Found when the first way needs them.
    corners: Option<Corners>,
    /// Room for crossings, kept from one question to the next.
    found: Vec<Crossing>,
}

/// The places around which a shortest way may bend: where the clay is around a corner, a little inside.
#[derive(Debug, Default)]
struct Corners {
    corners: Vec<Corner>,
    /// For each side of an outline the corner that comes behind it; nothing when its ring has none.
    after: Vec<Option<usize>>,
}

#[derive(Clone, Copy, Debug)]
struct Corner {
    at: Point,
    previous: usize,
    next: usize,
}

/// After so many corners a search takes the best way so far, so that a comb-shaped part does not take for ever.
const PATIENCE: usize = 400;

/// A mitre reaches no further than this many margins.
const MITRE: f64 = 2.0;

/// The share of the margin by which the outline may be simplified before its corners are counted.
const COARSE: f64 = 0.25;

impl Guide {
    /// A guide that knows nothing but the outlines yet.
    pub fn new(outlines: Outlines, measures: Measures) -> Self {
        Self { outlines, measures, corners: None, found: Vec::new() }
    }

    /// The way points between two places; none when the straight way is as good. In no case does more of the way lie in
    /// open air.
    pub fn way(&mut self, from: Point, to: Point) -> Vec<Point> {
        self.outlines.crossings(from, to, &mut self.found);
        if self.found.is_empty() || self.measures.price == 0.0 {
            return Vec::new();
        }
        let air = open_share(&self.found) * from.distance(to);
        // A bead that leaves the clay by less than half its width still lies on it.
        if air < self.measures.width / 2.0 {
            return Vec::new();
        }
        let bends = self.search(from, to);
        let jumps = self.jumps(&bends);
        for way in [jumps, bends] {
            if way.len() > 2 && self.open_air(&way) <= air {
                return way[1..way.len() - 1].to_vec();
            }
        }
        Vec::new()
    }

    /// How much of a way lies in open air, in microns.
    pub(crate) fn open_air(&mut self, way: &[Point]) -> f64 {
        way.windows(2).map(|pair| self.outlines.air(pair[0], pair[1], &mut self.found)).sum()
    }

    /// What a way costs: its length, and the price of its open air.
    pub(crate) fn cost(&mut self, way: &[Point]) -> f64 {
        let length: f64 = way.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        length + self.measures.price * self.open_air(way)
    }

    /// What the straight way costs of which one end lies on clay; its crossings are left in `found`.
    fn straight(&mut self, from: Point, to: Point) -> f64 {
        self.outlines.crossings(from, to, &mut self.found);
        let open = if self.found.is_empty() { 0.0 } else { open_share(&self.found) };
        from.distance(to) * (1.0 + self.measures.price * open)
    }

    /// The cheapest way around corners, with both its ends: a search for the best first (A*), in which every corner may
    /// also be reached straight from where its neighbour was reached (Theta*: Nash, Daniel, Koenig and Felner 2007).
    fn search(&mut self, from: Point, to: Point) -> Vec<Point> {
        let corners = self.corners.take().unwrap_or_else(|| Corners::new(&self.outlines, &self.measures));
        let mut search = Search::new(&corners, from, to);
        let mut reached = Vec::new();
        for _ in 0..PATIENCE {
            let Some(here) = search.next() else { break };
            let place = search.place(here);
            let cost = self.straight(place, to);
            reached.clear();
            reached.extend(corners.around(here));
            // What stands in the way can be passed at either side.
            let ends = self.found.len().saturating_sub(2).max(2);
            let blocks = self.found.iter().take(2).chain(self.found.iter().skip(ends));
            reached.extend(blocks.flat_map(|crossing| corners.beside(crossing.side)).flatten());
            search.reach(search.goal(), here, cost);
            for corner in reached.drain(..) {
                if search.is_done(corner) {
                    continue;
                }
                let origin = search.parent(here);
                for before in [Some(here), (origin != here).then_some(origin)].into_iter().flatten() {
                    if search.may_reach(corner, before) {
                        let cost = self.straight(search.place(before), corners.corners[corner].at);
                        search.reach(corner, before, cost);
                    }
                }
            }
        }
        let way = search.way();
        self.corners = Some(corners);
        self.straightened(way)
    }

    /// A way without the places that it is cheaper to leave out.
    fn straightened(&mut self, way: Vec<Point>) -> Vec<Point> {
        let mut kept: Vec<Point> = Vec::with_capacity(way.len());
        for (index, here) in way.iter().enumerate() {
            if let (Some(before), Some(next)) = (kept.last().copied(), way.get(index + 1))
                && self.straight(before, *next) <= self.straight(before, *here) + self.straight(*here, *next)
            {
                continue;
            }
            kept.push(*here);
        }
        kept
    }
}

impl Corners {
    fn new(outlines: &Outlines, measures: &Measures) -> Self {
        let mut found = Vec::new();
        let mut corners = Self::default();
        let tolerance = measures.margin.min(measures.width) * COARSE;
        for (number, ring) in outlines.rings().enumerate() {
            let first = corners.corners.len();
            let sides = outlines.ring(number);
            // For each corner the side that begins there.
            let mut begins = Vec::new();
            let coarse = simplified(&ring, tolerance).map(|ring| ring.0).unwrap_or_default();
            let mut kept = 0;
            for (side, point) in sides.clone().zip(&ring.0) {
                let Some(here) = coarse.get(kept).filter(|here| *here == point) else { continue };
                let before = coarse[(kept + coarse.len() - 1) % coarse.len()];
                let behind = coarse[(kept + 1) % coarse.len()];
                kept += 1;
                if shape::plane::cross(before, *here, behind) < 0 {
                    let at = inside(before, *here, behind, measures.margin, outlines, &mut found);
                    corners.corners.push(Corner { at, previous: 0, next: 0 });
                    begins.push(side);
                }
            }
            corners.join(first);
            let mut next = 0;
            for side in sides {
                while begins.get(next).is_some_and(|begin| *begin <= side) {
                    next += 1;
                }
                corners.after.push((!begins.is_empty()).then(|| first + next % begins.len()));
            }
        }
        corners
    }

    /// Joins the last corners, from the first of them, to a ring.
    fn join(&mut self, first: usize) {
        let ring = &mut self.corners[first..];
        let count = ring.len();
        for (index, corner) in ring.iter_mut().enumerate() {
            corner.previous = first + (index + count - 1) % count;
            corner.next = first + (index + 1) % count;
        }
    }

    /// The corners next to one on its ring.
    fn around(&self, place: usize) -> impl Iterator<Item = usize> {
        self.corners.get(place).into_iter().flat_map(|corner| [corner.previous, corner.next])
    }

    /// The corners before and behind a side of an outline.
    fn beside(&self, side: usize) -> [Option<usize>; 2] {
        let after = self.after[side];
        [after.map(|after| self.corners[after].previous), after]
    }
}

/// A corner moved to the inside by the margin from both its sides; where the clay is narrow, to its middle.
fn inside(
    before: Point,
    here: Point,
    behind: Point,
    margin: f64,
    outlines: &Outlines,
    found: &mut Vec<Crossing>,
) -> Point {
    let (Some(come), Some(go)) = (unit(before, here), unit(here, behind)) else { return here };
    let Some((x, y)) = norm((come.0 - go.0, come.1 - go.1)) else { return here };
    let half_turn = ((1.0 + come.0 * go.0 + come.1 * go.1) / 2.0).max(0.0).sqrt();
    let reach = margin * (1.0 / half_turn).min(MITRE);
    let far = moved(here, (x, y), 2.0 * reach);
    outlines.crossings(here, far, found);
    let room = found.iter().find(|crossing| !crossing.enters && crossing.share > 0.01);
    moved(here, (x, y), room.map_or(reach, |crossing| reach * crossing.share.min(1.0)))
}

/// A place at a distance in microns in a direction.
pub(crate) fn moved(from: Point, direction: (f64, f64), distance: f64) -> Point {
    let axis = |from: i32, share: f64| (f64::from(from) + share * distance).round() as i32;
    Point::new(axis(from.x, direction.0), axis(from.y, direction.1))
}

/// The direction from one place to another.
pub(crate) fn unit(from: Point, to: Point) -> Option<(f64, f64)> {
    let (x, y) = from.delta(to);
    norm((x as f64, y as f64))
}

fn norm((x, y): (f64, f64)) -> Option<(f64, f64)> {
    let length = (x * x + y * y).sqrt();
    (length > 1e-9).then(|| (x / length, y / length))
}

/// What a search knows: corners by their number, behind them the start and the goal.
struct Search<'a> {
    corners: &'a Corners,
    ends: [Point; 2],
    nodes: Vec<Node>,
    open: BinaryHeap<Open>,
}

#[derive(Clone, Copy)]
struct Node {
    cost: f64,
    parent: usize,
    done: bool,
}

/// A place that waits, with the least that a way over it can cost.
#[derive(PartialEq)]
struct Open {
    least: f64,
    place: usize,
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    /// The cheapest is the greatest, since a heap gives the greatest first.
    fn cmp(&self, other: &Self) -> Ordering {
        other.least.total_cmp(&self.least).then(other.place.cmp(&self.place))
    }
}

impl<'a> Search<'a> {
    fn new(corners: &'a Corners, from: Point, to: Point) -> Self {
        let start = corners.corners.len();
        let mut nodes = vec![Node { cost: f64::INFINITY, parent: start, done: false }; start + 2];
        nodes[start].cost = 0.0;
        let open = BinaryHeap::from([Open { least: from.distance(to), place: start }]);
        Self { corners, ends: [from, to], nodes, open }
    }

    fn start(&self) -> usize {
        self.corners.corners.len()
    }

    fn goal(&self) -> usize {
        self.start() + 1
    }

    fn place(&self, number: usize) -> Point {
        let end = || self.ends[number - self.start()];
        self.corners.corners.get(number).map_or_else(end, |corner| corner.at)
    }

    fn parent(&self, number: usize) -> usize {
        self.nodes[number].parent
    }

    fn is_done(&self, number: usize) -> bool {
        self.nodes[number].done
    }

    /// The most promising place that has not been looked at; nothing when the goal is reached as well as it can be.
    fn next(&mut self) -> Option<usize> {
        while let Some(Open { least, place }) = self.open.pop() {
            if least >= self.nodes[self.goal()].cost || place == self.goal() {
                return None;
            }
            if !std::mem::replace(&mut self.nodes[place].done, true) {
                return Some(place);
            }
        }
        None
    }

    /// Whether a place can become cheaper by coming from another, if all between is clay.
    fn may_reach(&self, place: usize, before: usize) -> bool {
        let cost = self.nodes[before].cost + self.place(before).distance(self.place(place));
        let rest = self.place(place).distance(self.ends[1]);
        cost < self.nodes[place].cost && cost + rest < self.nodes[self.goal()].cost
    }

    /// Takes note that a place is reached from another at a cost.
    fn reach(&mut self, place: usize, before: usize, cost: f64) {
        let cost = self.nodes[before].cost + cost;
        if cost < self.nodes[place].cost {
            self.nodes[place] = Node { cost, parent: before, done: false };
            let least = cost + self.place(place).distance(self.ends[1]);
            self.open.push(Open { least, place });
        }
    }

    /// The way that was found, with both its ends.
    fn way(&self) -> Vec<Point> {
        let mut way = vec![self.ends[1]];
        let mut place = self.goal();
        while place != self.start() {
            place = self.parent(place);
            way.push(self.place(place));
        }
        way.reverse();
        way
    }
}
