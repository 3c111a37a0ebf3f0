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
        let mut worst = (limit, None);
        for index in from + 1..to {
            let gap = distance2_to_segment(at(from), at(to), at(index));
            if gap > worst.0 {
                worst = (gap, Some(index));
            }
        }
        if let Some(middle) = worst.1 {
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

/// Squared distance in square microns from a point to a segment.
fn distance2_to_segment(from: Point, to: Point, point: Point) -> f64 {
    let (along, reach) = (from.delta(to), from.delta(point));
    let (along, reach) = ((along.0 as f64, along.1 as f64), (reach.0 as f64, reach.1 as f64));
    let length2 = along.0 * along.0 + along.1 * along.1;
    let share =
        if length2 > 0.0 { ((along.0 * reach.0 + along.1 * reach.1) / length2).clamp(0.0, 1.0) } else { 0.0 };
    let gap = (reach.0 - share * along.0, reach.1 - share * along.1);
    gap.0 * gap.0 + gap.1 * gap.1
}
