use super::{Point, Ring};

/// The ring without the corners that a straight side passes within `tolerance` microns.
///
/// One walk round the ring: from each kept corner the directions that pass all later ones near enough form a cone,
/// which narrows until a corner lies outside; the one before it is kept (Williams 1978). Kept corners stay where they
/// are, in their order. `None` when nothing with an area is left.
pub fn simplified(ring: &Ring, tolerance: f64) -> Option<Ring> {
    let points = without_doubles(&ring.0);
    if points.len() < 3 {
        return None;
    }
    // The least point is a corner of the hull: it is surely kept, and the same wherever the ring starts.
    let start = (0..points.len()).min_by_key(|index| points[*index])?;
    let mut keep = vec![false; points.len()];
    keep[start] = true;
    let mut anchor = start;
    let mut before = start;
    let mut cone = Cone::default();
    for step in 1..=points.len() {
        let here = if start + step < points.len() { start + step } else { start + step - points.len() };
        if !cone.admits(points[anchor], points[here]) {
            keep[before] = true;
            anchor = before;
            cone = Cone::default();
        }
        cone.narrow(points[anchor], points[here], tolerance);
        before = here;
    }
    let kept: Vec<Point> =
        points.iter().zip(&keep).filter(|(_, keep)| **keep).map(|(point, _)| *point).collect();
    let ring = Ring(kept);
    (ring.0.len() > 2 && ring.area2() != 0).then_some(ring)
}

/// Every ring [`simplified`].
pub fn all_simplified(rings: &[Ring], tolerance: f64) -> Vec<Ring> {
    rings.iter().filter_map(|ring| simplified(ring, tolerance)).collect()
}

fn without_doubles(points: &[Point]) -> Vec<Point> {
    let mut single: Vec<Point> = Vec::with_capacity(points.len());
    for point in points {
        if single.last() != Some(point) {
            single.push(*point);
        }
    }
    while single.len() > 1 && single.first() == single.last() {
        single.pop();
    }
    single
}

/// The directions from a corner that pass all corners since then near enough.
#[derive(Default)]
struct Cone {
    /// Its left and right side; none while every direction will do.
    sides: Option<((f64, f64), (f64, f64))>,
    /// How far the last corner was, squared.
    reach2: f64,
}

impl Cone {
    /// Whether a side from the anchor to a point passes all corners since then, and goes on from the last of them.
    fn admits(&self, anchor: Point, point: Point) -> bool {
        let Some((left, right)) = self.sides else { return true };
        let toward = vector(anchor, point);
        cross(right, toward) >= 0.0 && cross(toward, left) >= 0.0 && dot(toward, toward) >= self.reach2
    }

    fn narrow(&mut self, anchor: Point, point: Point, tolerance: f64) {
        let toward = vector(anchor, point);
        self.reach2 = dot(toward, toward);
        if self.reach2 <= tolerance * tolerance {
            return;
        }
        let aside = tolerance / self.reach2.sqrt();
        let left = (toward.0 - toward.1 * aside, toward.1 + toward.0 * aside);
        let right = (toward.0 + toward.1 * aside, toward.1 - toward.0 * aside);
        self.sides = Some(match self.sides {
            None => (left, right),
            Some((old_left, old_right)) => (
                if cross(left, old_left) >= 0.0 { left } else { old_left },
                if cross(old_right, right) >= 0.0 { right } else { old_right },
            ),
        });
    }
}

fn vector(from: Point, to: Point) -> (f64, f64) {
    let (x, y) = from.delta(to);
    (x as f64, y as f64)
}

fn cross(one: (f64, f64), other: (f64, f64)) -> f64 {
    one.0 * other.1 - one.1 * other.0
}

fn dot(one: (f64, f64), other: (f64, f64)) -> f64 {
    one.0 * other.0 + one.1 * other.1
}
