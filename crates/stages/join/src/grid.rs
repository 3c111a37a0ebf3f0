//! Finds the sides near a place, or across a way, without looking at all of them.

use skein::Point;

/// Sides in square cells.
pub struct Grid {
    /// The width of a cell in microns.
    cell: i64,
    /// How far the nearest is looked for; at most a cell's width.
    reach: f64,
    /// The lowest cell, and how many there are in both directions.
    low: (i64, i64),
    columns: i64,
    rows: i64,
    /// Where the sides of each cell begin in `entries`, row by row, and at last where they end.
    starts: Vec<u32>,
    entries: Vec<u32>,
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
    /// Sorts sides into cells, so that what lies within a reach in microns is found. The cells are at least that wide, and
    /// so wide that there are not many more of them than sides.
    pub fn new(sides: impl Iterator<Item = Side>, reach: f64) -> Self {
        let sides: Vec<Side> = sides.collect();
        let points = || sides.iter().flat_map(|side| [side.from, side.to]);
        let span = |axis: fn(Point) -> i32| {
            points().map(|point| i64::from(axis(point))).fold(None, |range: Option<(i64, i64)>, value| {
                Some(range.map_or((value, value), |(low, high)| (low.min(value), high.max(value))))
            })
        };
        let ((left, right), (bottom, top)) =
            (span(|point| point.x).unwrap_or((0, 0)), span(|point| point.y).unwrap_or((0, 0)));
        let mut cell = (reach.ceil() as i64).max(1);
        let most = 4 * sides.len() as i64 + 16;
        while ((right - left) / cell + 3) * ((top - bottom) / cell + 3) > most {
            cell *= 2;
        }
        // A border of empty cells around, so that a neighbour is always there.
        let low = (left.div_euclid(cell) - 1, bottom.div_euclid(cell) - 1);
        let (columns, rows) = (right.div_euclid(cell) - low.0 + 2, top.div_euclid(cell) - low.1 + 2);
        let starts = vec![0; (columns * rows + 1) as usize];
        let mut grid = Self { cell, reach, low, columns, rows, starts, entries: Vec::new(), sides };
        grid.sort();
        grid
    }

    /// Counts what lies in each cell, then puts it there.
    fn sort(&mut self) {
        let mut places: Vec<(u32, u32)> = Vec::with_capacity(self.sides.len() * 2);
        for (index, side) in self.sides.iter().enumerate() {
            self.each_cell(side.from, side.to, |cell| places.push((cell as u32, index as u32)));
        }
        for (cell, _) in &places {
            self.starts[*cell as usize + 1] += 1;
        }
        for cell in 1..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        let mut next = self.starts.clone();
        self.entries = vec![0; places.len()];
        for (cell, side) in places {
            self.entries[next[cell as usize] as usize] = side;
            next[cell as usize] += 1;
        }
    }

    /// The nearest place within reach of a point, on what is wanted; of equally near ones the first.
    pub fn nearest(&self, point: Point, wanted: impl Fn(u32) -> bool) -> Option<Near> {
        let mut best: Option<Near> = None;
        let (column, row) = self.cell_of(i64::from(point.x), i64::from(point.y));
        let around =
            (row - 1..=row + 1).flat_map(|row| (column - 1..=column + 1).map(move |column| (column, row)));
        for cell in around.filter_map(|(column, row)| self.index(column, row)) {
            for side in self.of(cell) {
                // Most sides are too far away, and need not be asked about.
                let (share, distance) = side.nearest(point);
                if distance > best.map_or(self.reach, |best| best.distance) || !wanted(side.owner) {
                    continue;
                }
                let near = Near {
                    owner: side.owner,
                    along: side.start + share * side.from.distance(side.to),
                    distance,
                };
                let nearer = best.is_none_or(|best| {
                    (near.distance, near.owner, near.along) < (best.distance, best.owner, best.along)
                });
                if nearer {
                    best = Some(near);
                }
            }
        }
        best
    }

    /// Whether a straight way crosses a side.
    pub fn is_crossed(&self, from: Point, to: Point) -> bool {
        let mut crossed = false;
        self.each_cell(from, to, |cell| {
            crossed = crossed || self.of(cell).any(|side| cross(from, to, side.from, side.to));
        });
        crossed
    }

    fn of(&self, cell: usize) -> impl Iterator<Item = &Side> {
        let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
        self.entries[range].iter().map(|side| &self.sides[*side as usize])
    }

    fn cell_of(&self, x: i64, y: i64) -> (i64, i64) {
        (x.div_euclid(self.cell) - self.low.0, y.div_euclid(self.cell) - self.low.1)
    }

    fn index(&self, column: i64, row: i64) -> Option<usize> {
        let inside = (0..self.columns).contains(&column) && (0..self.rows).contains(&row);
        inside.then_some((row * self.columns + column) as usize)
    }

    /// Every cell that a side touches: row by row, from where it enters to where it leaves.
    fn each_cell(&self, from: Point, to: Point, mut visit: impl FnMut(usize)) {
        let (low, high) = if from.y <= to.y { (from, to) } else { (to, from) };
        let ends = [low, high].map(|point| (i64::from(point.x), i64::from(point.y)));
        let [first, last] = ends.map(|(x, y)| self.cell_of(x, y));
        if first == last {
            self.index(first.0, first.1).into_iter().for_each(visit);
            return;
        }
        let [(x, y), (far_x, far_y)] = ends.map(|(x, y)| (x as f64, y as f64));
        for row in first.1..=last.1 {
            let border = |row: i64| {
                let share = (((row + self.low.1) * self.cell) as f64 - y) / (far_y - y);
                x + (far_x - x) * share.clamp(0.0, 1.0)
            };
            let (one, other) = if first.1 == last.1 { (x, far_x) } else { (border(row), border(row + 1)) };
            // A micron more to both sides: what lies on a border belongs to both cells.
            let column = |x: f64| (x as i64).div_euclid(self.cell) - self.low.0;
            for column in column(one.min(other) - 2.0)..=column(one.max(other) + 2.0) {
                self.index(column, row).into_iter().for_each(&mut visit);
            }
        }
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
pub fn cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |a, b, c| shape::plane::cross(a, b, c).signum();
    a.x.min(b.x) <= c.x.max(d.x)
        && c.x.min(d.x) <= a.x.max(b.x)
        && a.y.min(b.y) <= c.y.max(d.y)
        && c.y.min(d.y) <= a.y.max(b.y)
        && side(a, b, c) * side(a, b, d) <= 0
        && side(c, d, a) * side(c, d, b) <= 0
}
