use super::{Point, Ring};

/// The ring without the corners that a straight side passes within `tolerance` microns (Douglas and Peucker 1973).
///
/// Kept corners stay where they are. `None` when nothing with an area is left.
pub fn simplified(ring: &Ring, tolerance: f64) -> Option<Ring> {
    let mut points: Vec<Point> = Vec::with_capacity(ring.0.len());
    for point in &ring.0 {
        if points.last() != Some(point) {
            points.push(*point);
        }
    }
    while points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    if points.len() < 3 {
        return None;
    }
    // Two corners that are surely kept: one far from the first, and the one farthest from that.
    let farthest =
        |from: Point| (0..points.len()).max_by_key(|index| from.distance2(points[*index])).unwrap_or(0);
    let one = farthest(points[0]);
    points.rotate_left(one);
    let other = (1..points.len()).max_by_key(|index| points[0].distance2(points[*index]))?;
    let mut keep = vec![false; points.len() + 1];
    (keep[0], keep[other], keep[points.len()]) = (true, true, true);
    let limit = tolerance * tolerance;
    let at = |index: usize| points[if index == points.len() { 0 } else { index }];
    let mut spans = vec![(0, other), (other, points.len())];
    while let Some((from, to)) = spans.pop() {
        let (index, gap) = farthest_from(at(from), at(to), &points[from + 1..to]);
        if gap > limit {
            let middle = from + 1 + index;
            keep[middle] = true;
            spans.push((from, middle));
            spans.push((middle, to));
        }
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

/// Which of some points is farthest from a segment, and its squared distance in square microns.
fn farthest_from(from: Point, to: Point, points: &[Point]) -> (usize, f64) {
    let float = |(x, y): (i64, i64)| (x as f64, y as f64);
    let along = float(from.delta(to));
    let length2 = along.0 * along.0 + along.1 * along.1;
    let inverse = if length2 > 0.0 { 1.0 / length2 } else { 0.0 };
    let mut worst = (0, -1.0);
    for (index, point) in points.iter().enumerate() {
        let reach = float(from.delta(*point));
        let share = (along.0 * reach.0 + along.1 * reach.1) * inverse;
        let gap = if share <= 0.0 {
            reach.0 * reach.0 + reach.1 * reach.1
        } else if share >= 1.0 {
            let beyond = (reach.0 - along.0, reach.1 - along.1);
            beyond.0 * beyond.0 + beyond.1 * beyond.1
        } else {
            let cross = along.0 * reach.1 - along.1 * reach.0;
            cross * cross * inverse
        };
        if gap > worst.1 {
            worst = (index, gap);
        }
    }
    worst
}
