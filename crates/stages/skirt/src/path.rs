//! Rings that become unbroken lines.

use skein::{Point, Ring};

/// The points of one unbroken line.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Path(pub(crate) Vec<Point>);

impl Path {
    pub(crate) fn extend(&mut self, other: &Self) {
        self.0.extend_from_slice(&other.0);
    }
}

/// The rings of several levels, the innermost first, as lines: each goes from the outermost ring around an island inwards,
/// and steps from one ring to the next where they are no further than `near` apart. Every ring begins and ends as near to
/// `target` as it can, and the island nearest to it comes last.
pub(crate) fn chains(levels: &[Vec<Ring>], target: Option<Point>, near: f64) -> Vec<Path> {
    let Some(innermost) = levels.first() else { return Vec::new() };
    let first_corner = innermost.iter().find_map(|ring| ring.0.first().copied());
    let Some(target) = target.or(first_corner) else { return Vec::new() };
    let mut islands: Vec<(i64, &Ring)> =
        innermost.iter().map(|ring| (target.distance2(nearest(ring, target).1), ring)).collect();
    islands.sort_by_key(|(distance, _)| std::cmp::Reverse(*distance));
    let mut outer: Vec<Vec<&Ring>> = levels[1..].iter().map(|level| level.iter().collect()).collect();
    let mut paths: Vec<Path> = Vec::new();
    for (_, island) in islands {
        let Some(&inside) = island.0.first() else { continue };
        let mut around: Vec<&Ring> = vec![island];
        for level in &mut outer {
            // A ring around several islands goes with the first of them.
            around
                .extend(level.iter().position(|ring| ring.contains(inside)).map(|index| level.remove(index)));
        }
        let mut path = Path::default();
        for ring in around.into_iter().rev() {
            let ring = closed(ring, target);
            let far = |(end, start): (&Point, &Point)| end.distance(*start) > near;
            if path.0.last().zip(ring.first()).is_some_and(far) {
                paths.push(std::mem::take(&mut path));
            }
            path.0.extend(ring);
        }
        paths.push(path);
    }
    paths
}

/// The place of a ring nearest to a point, and the side it lies on.
fn nearest(ring: &Ring, point: Point) -> (usize, Point) {
    let places = ring.segments().enumerate().map(|(side, (from, to))| (side, foot(from, to, point)));
    places.min_by_key(|(_, place)| point.distance2(*place)).unwrap_or((0, point))
}

/// The place between two points nearest to a third.
fn foot(from: Point, to: Point, point: Point) -> Point {
    let ((x, y), (px, py)) = (from.delta(to), from.delta(point));
    let length2 = (x * x + y * y) as f64;
    if length2 == 0.0 {
        return from;
    }
    let share = ((x as f64 * px as f64 + y as f64 * py as f64) / length2).clamp(0.0, 1.0);
    let part = |whole: i64| (whole as f64 * share).round() as i32;
    Point::new(from.x + part(x), from.y + part(y))
}

/// A ring from its place nearest to a point all the way round to there.
fn closed(ring: &Ring, target: Point) -> Vec<Point> {
    let (side, start) = nearest(ring, target);
    let (before, behind) = ring.0.split_at((side + 1).min(ring.0.len()));
    let mut points = vec![start];
    points.extend(behind.iter().chain(before).copied());
    points.push(start);
    points.dedup();
    points
}
