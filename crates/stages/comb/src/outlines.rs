//! The outlines of a layer, asked where a straight way crosses them.

use skein::{Point, Ring};

/// The sides of all outlines, in boxes of boxes, so that a way looks only at those near it.
#[derive(Debug)]
pub struct Outlines {
    sides: Vec<Side>,
    /// For each ring where its sides begin; at last where they end.
    rings: Vec<usize>,
    /// Boxes around [`FAN`] sides, around [`FAN`] of those, and so on up to one.
    levels: Vec<Vec<Bounds>>,
}

/// A side of an outline; the clay lies to its left.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// Where it begins.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// The ring that it belongs to.
    pub ring: usize,
}

/// Where a straight way crosses an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The share of the way up to here.
    pub share: f64,
    /// Whether it goes into the clay here, or out of it.
    pub enters: bool,
    /// The side of the outline.
    pub side: usize,
}

/// How many boxes lie in one of the next level.
const FAN: usize = 8;

/// Crossings nearer to each other than this many microns are the touching of a corner.
const TOUCH: f64 = 0.5;

impl Outlines {
    /// Files the sides of some rings.
    pub fn new(rings: &[Ring]) -> Self {
        let mut sides = Vec::with_capacity(rings.iter().map(|ring| ring.0.len()).sum());
        let mut starts = vec![0];
        for (number, ring) in rings.iter().enumerate() {
            sides.extend(ring.segments().map(|(from, to)| Side { from, to, ring: number }));
            starts.push(sides.len());
        }
        let mut levels: Vec<Vec<Bounds>> = Vec::new();
        if !sides.is_empty() {
            levels.push(
                sides
                    .chunks(FAN)
                    .map(|group| Bounds::around(group.iter().map(|side| Bounds::of(side.from, side.to))))
                    .collect(),
            );
        }
        while let Some(below) = levels.last().filter(|level| level.len() > 1) {
            levels.push(below.chunks(FAN).map(|group| Bounds::around(group.iter().copied())).collect());
        }
        Self { sides, rings: starts, levels }
    }

    /// A side by its number.
    pub fn side(&self, number: usize) -> Side {
        self.sides[number]
    }

    /// The sides of a ring, by their numbers.
    pub fn ring(&self, number: usize) -> std::ops::Range<usize> {
        self.rings[number]..self.rings[number + 1]
    }

    /// The rings.
    pub fn rings(&self) -> impl Iterator<Item = Ring> + '_ {
        (0..self.rings.len() - 1)
            .map(|number| Ring(self.sides[self.ring(number)].iter().map(|side| side.from).collect()))
    }

    /// Where a straight way crosses the outlines, in order: by turns into the clay and out of it.
    pub fn crossings(&self, from: Point, to: Point, found: &mut Vec<Crossing>) {
        found.clear();
        if from == to {
            return;
        }
        let line = Way::new(from, to);
        if let Some(top) = self.levels.len().checked_sub(1) {
            self.visit(top, 0..self.levels[top].len(), &line, found);
        }
        found.sort_by(|one, other| one.share.total_cmp(&other.share).then(one.side.cmp(&other.side)));
        // A way that touches a corner crosses both of its sides there, which is as good as none.
        let length = from.distance(to);
        let mut kept = 0;
        for index in 0..found.len() {
            let here = found[index];
            let touches = |before: &Crossing| {
                before.enters != here.enters && (here.share - before.share) * length < TOUCH
            };
            if found[..kept].last().is_some_and(touches) {
                kept -= 1;
            } else {
                found[kept] = here;
                kept += 1;
            }
        }
        found.truncate(kept);
    }

    fn visit(&self, level: usize, boxes: std::ops::Range<usize>, line: &Way, found: &mut Vec<Crossing>) {
        for index in boxes {
            if !line.meets(&self.levels[level][index]) {
                continue;
            }
            let inner = index * FAN;
            match level.checked_sub(1) {
                Some(below) => {
                    let end = self.levels[below].len().min(inner + FAN);
                    self.visit(below, inner..end, line, found);
                }
                None => {
                    let end = self.sides.len().min(inner + FAN);
                    found.extend((inner..end).filter_map(|side| line.crossing(side, &self.sides[side])));
                }
            }
        }
    }

    /// How much of a straight way lies in open air, in microns; `found` is left with its crossings.
    pub fn air(&self, from: Point, to: Point, found: &mut Vec<Crossing>) -> f64 {
        self.crossings(from, to, found);
        let length = from.distance(to);
        if found.is_empty() {
            let middle = Point::new(i32::midpoint(from.x, to.x), i32::midpoint(from.y, to.y));
            return if self.holds(middle) { 0.0 } else { length };
        }
        open_share(found) * length
    }

    /// Whether a place lies on clay.
    pub fn holds(&self, at: Point) -> bool {
        let Some(all) = self.levels.last().and_then(|level| level.first()) else { return false };
        if at.x > all.high.x {
            return false;
        }
        let mut found = Vec::new();
        self.crossings(at, Point::new(all.high.x.saturating_add(1), at.y), &mut found);
        let balance: i32 = found.iter().map(|crossing| if crossing.enters { -1 } else { 1 }).sum();
        balance > 0
    }
}

/// The share of a way that lies in open air, by its crossings, of which there is at least one.
pub fn open_share(crossings: &[Crossing]) -> f64 {
    let mut open = 0.0;
    let mut before = 0.0;
    for crossing in crossings {
        if crossing.enters {
            open += crossing.share - before;
        }
        before = crossing.share;
    }
    if crossings.last().is_some_and(|last| !last.enters) { open + 1.0 - before } else { open }
}

/// An upright box.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: Point,
    high: Point,
}

impl Bounds {
    fn of(one: Point, other: Point) -> Self {
        Self {
            low: Point::new(one.x.min(other.x), one.y.min(other.y)),
            high: Point::new(one.x.max(other.x), one.y.max(other.y)),
        }
    }

    fn around(boxes: impl Iterator<Item = Self>) -> Self {
        boxes
            .reduce(|one, other| Self {
                low: Point::new(one.low.x.min(other.low.x), one.low.y.min(other.low.y)),
                high: Point::new(one.high.x.max(other.high.x), one.high.y.max(other.high.y)),
            })
            .unwrap_or(Self { low: Point::default(), high: Point::default() })
    }
}

/// A straight way that looks for crossings.
struct Way {
    from: Point,
    to: Point,
    bounds: Bounds,
    direction: (f64, f64),
}

impl Way {
    fn new(from: Point, to: Point) -> Self {
        let (x, y) = from.delta(to);
        Self { from, to, bounds: Bounds::of(from, to), direction: (x as f64, y as f64) }
    }

    /// Whether it may pass through a box.
    fn meets(&self, other: &Bounds) -> bool {
        let own = &self.bounds;
        if own.high.x < other.low.x
            || other.high.x < own.low.x
            || own.high.y < other.low.y
            || other.high.y < own.low.y
        {
            return false;
        }
        // How far the middle of the box lies aside, against how far its corners reach.
        let (x, y) = self.direction;
        let (width, height) = other.low.delta(other.high);
        let (width, height) = (width as f64 / 2.0, height as f64 / 2.0);
        let (dx, dy) = self.from.delta(other.low);
        let (dx, dy) = (dx as f64 + width, dy as f64 + height);
        // One micron more, for the rounding.
        (x * dy - y * dx).abs() <= x.abs() * (height + 1.0) + y.abs() * (width + 1.0)
    }

    /// Where it crosses a side. A corner on the way counts as left of it, so that crossings are into the clay and out of
    /// it by turns.
    fn crossing(&self, number: usize, side: &Side) -> Option<Crossing> {
        let begin = shape::plane::cross(self.from, self.to, side.from);
        let end = shape::plane::cross(self.from, self.to, side.to);
        if (begin >= 0) == (end >= 0) {
            return None;
        }
        let along_side = begin as f64 / (begin as f64 - end as f64);
        let (x, y) = side.from.delta(side.to);
        let (dx, dy) = self.from.delta(side.from);
        let (dx, dy) = (dx as f64 + x as f64 * along_side, dy as f64 + y as f64 * along_side);
        let (wx, wy) = self.direction;
        let share = (dx * wx + dy * wy) / (wx * wx + wy * wy);
        (0.0..=1.0).contains(&share).then_some(Crossing { share, enters: begin >= 0, side: number })
    }
}
