//! The convex outline of points, exactly.

use shape::Point;
use shape::plane::{Ring, cross};

/// The smallest convex ring around points, counter-clockwise; `None` when they have no area.
///
/// Andrew's monotone chain: the points from left to right make the lower side, back again the upper one.
pub(crate) fn hull(mut points: Vec<Point>) -> Option<Ring> {
    points.sort_unstable();
    points.dedup();
    let mut corners = side(points.iter().copied());
    corners.pop();
    let mut upper = side(points.iter().rev().copied());
    upper.pop();
    corners.append(&mut upper);
    (corners.len() > 2).then_some(Ring(corners))
}

/// The corners that turn left on the way along sorted points.
fn side(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut corners: Vec<Point> = Vec::new();
    for point in points {
        while let [.., before, last] = corners.as_slice()
            && cross(*before, *last, point) <= 0
        {
            corners.pop();
        }
        corners.push(point);
    }
    corners
}
