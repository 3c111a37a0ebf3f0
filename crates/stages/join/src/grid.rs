//! Finds the sides near a place, or across a way, without looking at all of them.

use skein::Point;

/// Sides in square cells.
pub struct Grid {
    cell: f64,
    /// The sides of each cell, sorted by cell.
    entries: Vec<((i32, i32), u32)>,
    sides: Vec<Side>,
}

/// A side of a strand or an outline.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// The strand or outline it belongs to.
    pub owner: u32,
    /// How far along its owner it begins, in microns.
    pub start: f64,
    /// Its ends.
    pub from: Point,
    /// Its ends.
    pub to: Point,
}

/// The nearest place on something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// What it is on.
    pub owner: u32,
    /// How far along it, in microns.
    pub along: f64,
    /// How far away it is, in microns.
    pub distance: f64,
}

impl Grid {
    /// Sorts sides into cells of a width in microns.
    pub fn new(sides: impl Iterator<Item = Side>, cell: f64) -> Self {
        let sides: Vec<Side> = sides.collect();
        let mut entries = Vec::with_capacity(sides.len() * 2);
        for (index, side) in sides.iter().enumerate() {
            each_cell(side.from, side.to, cell, |at| entries.push((at, index as u32)));
        }
        entries.sort_unstable();
        entries.dedup();
        Self { cell, entries, sides }
    }

    /// The nearest place within a cell's width of a point, on what is wanted; of equally near ones the first.
    pub fn nearest(&self, point: Point, wanted: impl Fn(u32) -> bool) -> Option<Near> {
        let (x, y) = cell_of(point, self.cell);
        let mut best: Option<Near> = None;
        for cell in (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y))) {
            for side in self.of(cell).filter(|side| wanted(side.owner)) {
                let (share, distance) = side.nearest(point);
                let near = Near {
                    owner: side.owner,
                    along: side.start + share * side.from.distance(side.to),
                    distance,
                };
                let nearer = best.is_none_or(|best| {
                    (near.distance, near.owner, near.along) < (best.distance, best.owner, best.along)
                });
                if near.distance <= self.cell && nearer {
                    best = Some(near);
                }
            }
        }
        best
    }

    /// Whether a straight way crosses a side.
    pub fn is_crossed(&self, from: Point, to: Point) -> bool {
        let mut crossed = false;
        each_cell(from, to, self.cell, |cell| {
            crossed = crossed || self.of(cell).any(|side| cross(from, to, side.from, side.to));
        });
        crossed
    }

    fn of(&self, cell: (i32, i32)) -> impl Iterator<Item = &Side> {
        let from = self.entries.partition_point(|entry| entry.0 < cell);
        self.entries[from..]
            .iter()
            .take_while(move |entry| entry.0 == cell)
            .map(|entry| &self.sides[entry.1 as usize])
    }
}

impl Side {
    /// The share of the side at which it is nearest to a point, and how near, in microns.
    pub fn nearest(&self, point: Point) -> (f64, f64) {
        let (ax, ay) = self.from.delta(self.to);
        let (bx, by) = self.from.delta(point);
        let (ax, ay, bx, by) = (ax as f64, ay as f64, bx as f64, by as f64);
        let square = ax * ax + ay * ay;
        let share = if square > 0.0 { ((ax * bx + ay * by) / square).clamp(0.0, 1.0) } else { 0.0 };
        let (x, y) = (bx - ax * share, by - ay * share);
        (share, (x * x + y * y).sqrt())
    }
}

/// Whether two sides meet.
fn cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |a, b, c| shape::plane::cross(a, b, c).signum();
    side(a, b, c) * side(a, b, d) <= 0
        && side(c, d, a) * side(c, d, b) <= 0
        && a.x.min(b.x) <= c.x.max(d.x)
        && c.x.min(d.x) <= a.x.max(b.x)
        && a.y.min(b.y) <= c.y.max(d.y)
        && c.y.min(d.y) <= a.y.max(b.y)
}

fn cell_of(point: Point, cell: f64) -> (i32, i32) {
    ((f64::from(point.x) / cell).floor() as i32, (f64::from(point.y) / cell).floor() as i32)
}

/// Every cell that a side touches: row by row, from where it enters to where it leaves.
fn each_cell(from: Point, to: Point, cell: f64, mut visit: impl FnMut((i32, i32))) {
    let (low, high) = if from.y <= to.y { (from, to) } else { (to, from) };
    let (first, last) = (cell_of(low, cell).1, cell_of(high, cell).1);
    let rise = f64::from(high.y) - f64::from(low.y);
    for row in first..=last {
        let x = |y: f64| {
            let share = ((y - f64::from(low.y)) / rise).clamp(0.0, 1.0);
            f64::from(low.x) + (f64::from(high.x) - f64::from(low.x)) * share
        };
        let (one, other) = if first == last {
            (f64::from(low.x), f64::from(high.x))
        } else {
            (x(f64::from(row) * cell), x((f64::from(row) + 1.0) * cell))
        };
        // A micron more to both sides: what lies on a border belongs to both cells.
        let column = |x: f64| (x / cell).floor() as i32;
        for column in column(one.min(other) - 1.0)..=column(one.max(other) + 1.0) {
            visit((column, row));
        }
    }
}
