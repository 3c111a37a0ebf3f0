//! Where a way is at a length from its start, and how it bends there, in microns and seen from above.

use skein::Point3;

/// A way with the length up to each of its points.
pub(crate) struct Way<'a> {
    /// All points; the last of a closed thread is its first.
    points: &'a [Point3],
    lengths: Vec<f64>,
    closed: bool,
}

/// A place that goes on along a way and never back, so that all of a way takes as long as the way is.
struct Cursor<'a> {
    way: &'a Way<'a>,
    /// The side that it is on.
    side: usize,
    /// The length of the turns that it has made around a closed way.
    turned: f64,
}

impl<'a> Way<'a> {
    /// The way over such points; the last of a closed one is its first.
    pub(crate) fn new(points: &'a [Point3], closed: bool) -> Self {
        let mut lengths = vec![0.0; points.len()];
        for index in 1..points.len() {
            let (x, y) = between(points[index - 1], points[index]);
            lengths[index] = lengths[index - 1] + libm::hypot(x, y);
        }
        Self { points, lengths, closed }
    }

    /// The points that can be moved by themselves: the end of a closed way is its start.
    fn count(&self) -> usize {
        self.points.len() - usize::from(self.closed)
    }

    /// The ways from a point to the one before and the one behind; none at an open end.
    pub(crate) fn neighbours(&self, index: usize) -> ((f64, f64), (f64, f64)) {
        let at = self.points[index];
        let last = self.points.len() - 1;
        let before = match index {
            0 if self.closed => self.points[last - 1],
            0 => at,
            _ => self.points[index - 1],
        };
        let behind = if index == last { at } else { self.points[index + 1] };
        (between(at, before), between(at, behind))
    }

    /// For each point how the way bends there: nothing on a straight line, up to 2 where it turns back, and towards the
    /// outside. Looked at from so far before and behind; near an open end from as far as the end is.
    pub(crate) fn bends(&self, reach: f64) -> Vec<(f64, f64)> {
        let total = self.lengths.last().copied().unwrap_or(0.0);
        let mut before = Cursor { way: self, side: 0, turned: if self.closed { -total } else { 0.0 } };
        let mut behind = Cursor { way: self, side: 0, turned: 0.0 };
        (0..self.count())
            .map(|index| {
                let here = self.lengths[index];
                let room = if self.closed { total / 2.0 } else { here.min(total - here) };
                let reach = reach.min(room);
                if reach <= 0.0 {
                    return (0.0, 0.0);
                }
                let at = self.points[index];
                let (one, other) = (before.at(here - reach), behind.at(here + reach));
                let away = |from: (f64, f64)| {
                    ((f64::from(at.x) - from.0) / reach, (f64::from(at.y) - from.1) / reach)
                };
                let (one, other) = (away(one), away(other));
                (one.0 + other.0, one.1 + other.1)
            })
            .collect()
    }
}

impl Cursor<'_> {
    /// The place at a length, which is not less than the last one asked for.
    fn at(&mut self, length: f64) -> (f64, f64) {
        let Way { points, lengths, closed } = self.way;
        let sides = points.len() - 1;
        while self.turned + lengths[self.side + 1] < length {
            if self.side + 1 < sides {
                self.side += 1;
            } else if *closed {
                (self.side, self.turned) = (0, self.turned + lengths[sides]);
            } else {
                break;
            }
        }
        let (from, to) = (points[self.side], points[self.side + 1]);
        let (start, end) = (lengths[self.side], lengths[self.side + 1]);
        let share =
            if end > start { ((length - self.turned - start) / (end - start)).clamp(0.0, 1.0) } else { 0.0 };
        let (x, y) = between(from, to);
        (f64::from(from.x) + x * share, f64::from(from.y) + y * share)
    }
}

fn between(from: Point3, to: Point3) -> (f64, f64) {
    (f64::from(to.x) - f64::from(from.x), f64::from(to.y) - f64::from(from.y))
}
