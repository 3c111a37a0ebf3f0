/// A point of the plane, in microns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Point {
    /// Microns along x.
    pub x: i32,
    /// Microns along y.
    pub y: i32,
}

impl Point {
    /// A point from its coordinates in microns.
    pub const fn new(x: i32, y: i32) -> Self {
        Self { x, y }
    }

    /// Distance to another point, in microns.
    pub fn distance(self, to: Self) -> f64 {
        let (x, y) = self.delta(to);
        ((x * x + y * y) as f64).sqrt()
    }

    /// Squared distance to another point, in square microns.
    pub fn distance2(self, to: Self) -> i64 {
        let (x, y) = self.delta(to);
        x * x + y * y
    }

    /// The vector to another point.
    pub fn delta(self, to: Self) -> (i64, i64) {
        (i64::from(to.x) - i64::from(self.x), i64::from(to.y) - i64::from(self.y))
    }
}

/// The cross product of `a → b` and `a → c`: positive when `c` lies to the left.
pub fn cross(a: Point, b: Point, c: Point) -> i128 {
    let (bx, by) = a.delta(b);
    let (cx, cy) = a.delta(c);
    i128::from(bx) * i128::from(cy) - i128::from(by) * i128::from(cx)
}
