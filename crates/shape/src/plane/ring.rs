use super::Point;

/// A closed loop of points; the first is not repeated at the end. Counter-clockwise around clay, clockwise around
/// a hole.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Ring(pub Vec<Point>);

impl Ring {
    /// The rectangle around the way between two points, `half` microns from it on every side; `None` where there is no
    /// way.
    pub fn around(from: Point, to: Point, half: f64) -> Option<Self> {
        let (x, y) = from.delta(to);
        let length = from.distance(to);
        if length == 0.0 {
            return None;
        }
        let (x, y) = (x as f64 / length * half, y as f64 / length * half);
        let corner = |at: Point, x: f64, y: f64| {
            Point::new(at.x.saturating_add(x.round() as i32), at.y.saturating_add(y.round() as i32))
        };
        Some(Self(vec![
            corner(from, y - x, -x - y),
            corner(to, x + y, y - x),
            corner(to, x - y, x + y),
            corner(from, -x - y, x - y),
        ]))
    }

    /// Twice the signed area in square microns: positive when counter-clockwise.
    pub fn area2(&self) -> i128 {
        // Taken about the first point, so that the products of a part far from the origin stay small.
        let Some(&origin) = self.0.first() else { return 0 };
        let mut sum = 0i128;
        let mut before = (0i64, 0i64);
        for &point in &self.0[1..] {
            let here = origin.delta(point);
            sum += i128::from(before.0) * i128::from(here.1) - i128::from(before.1) * i128::from(here.0);
            before = here;
        }
        sum
    }

    /// Signed area in mm².
    pub fn area(&self) -> f64 {
        self.area2() as f64 / 2e6
    }

    /// Length of the loop in microns.
    pub fn length(&self) -> f64 {
        self.segments().map(|(from, to)| from.distance(to)).sum()
    }

    /// Every side, the one that closes the loop last.
    pub fn segments(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        let next = self.0.iter().skip(1).chain(self.0.first());
        self.0.iter().zip(next).map(|(from, to)| (*from, *to))
    }

    /// Whether a point lies inside, by the crossing rule: a point on the left side of the loop counts as inside, one
    /// on the right does not.
    pub fn contains(&self, point: Point) -> bool {
        self.segments().filter(|(a, b)| crosses_left_of(*a, *b, point)).count() % 2 == 1
    }

    /// The least and the greatest coordinates; `None` for no points.
    pub fn bounds(&self) -> Option<(Point, Point)> {
        let first = *self.0.first()?;
        Some(self.0.iter().fold((first, first), |(low, high), point| {
            (
                Point::new(low.x.min(point.x), low.y.min(point.y)),
                Point::new(high.x.max(point.x), high.y.max(point.y)),
            )
        }))
    }

    /// The loop the other way round.
    pub fn reversed(mut self) -> Self {
        self.0.reverse();
        self
    }
}

/// Whether the segment crosses the horizontal ray from the point to the left. An end on the ray's height counts as
/// above it, so a vertex counts once.
fn crosses_left_of(a: Point, b: Point, point: Point) -> bool {
    if (a.y > point.y) == (b.y > point.y) {
        return false;
    }
    let turn = super::point::cross(a, b, point);
    if b.y > a.y { turn < 0 } else { turn > 0 }
}
