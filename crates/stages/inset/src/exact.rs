//! A bead that is flush with one face of a part instead of missing both equally.

use crate::ExactWall;
use shape::plane::MiddleLine;
use skein::{Point, Ring, Side};

/// Moves a middle line sideways so that the bead's flank lies on the face that is wanted, in a part that has a hole on one
/// side and the outside on the other. In any other part neither face is the one, and the line stays.
pub fn lay(line: &mut MiddleLine, wanted: ExactWall, outlines: &[Ring], width: f64) {
    let side = match wanted {
        ExactWall::Neither => return,
        ExactWall::Hole => Side::Inner,
        ExactWall::Outside => Side::Outer,
    };
    let normals = normals(&line.points);
    let middle = line.points.len() / 2;
    let Some(&normal) = normals.get(middle) else { return };
    // A little beyond the face, so that the face is surely the nearest.
    let beyond = |sense: f64| moved(line.points[middle], normal, sense * line.widths[middle] * 0.6);
    let (left, right) = (nearest_side(outlines, beyond(1.0)), nearest_side(outlines, beyond(-1.0)));
    let sense = match (left, right) {
        (Some(one), Some(other)) if one == other => return,
        (Some(one), _) if one == side => 1.0,
        _ => -1.0,
    };
    for ((point, normal), room) in line.points.iter_mut().zip(&normals).zip(&line.widths) {
        *point = moved(*point, *normal, sense * (room - width) / 2.0);
    }
}

/// For every point the vector to its left that keeps the two stretches beside it at one distance when each is moved by
/// that; no longer than twice the distance.
fn normals(points: &[Point]) -> Vec<(f64, f64)> {
    let closed = points.len() > 2 && points.first() == points.last();
    let left = |from: Point, to: Point| {
        let (x, y) = from.delta(to);
        let length = from.distance(to).max(1.0);
        (-(y as f64) / length, x as f64 / length)
    };
    let last = points.len().saturating_sub(1);
    let stretch = |index: usize| left(points[index], points[index + 1]);
    (0..points.len())
        .filter(|_| last > 0)
        .map(|index| {
            let before = if index > 0 {
                index - 1
            } else if closed {
                last - 1
            } else {
                0
            };
            let after = if index < last {
                index
            } else if closed {
                0
            } else {
                last - 1
            };
            let (one, other) = (stretch(before), stretch(after));
            let along = 1.0 + one.0 * other.0 + one.1 * other.1;
            let scale = 1.0 / along.max(0.5);
            ((one.0 + other.0) * scale, (one.1 + other.1) * scale)
        })
        .collect()
}

fn moved(point: Point, (x, y): (f64, f64), by: f64) -> Point {
    Point::new((f64::from(point.x) + x * by).round() as i32, (f64::from(point.y) + y * by).round() as i32)
}

/// Whether the outline nearest to a place is one around the clay or one around a hole.
fn nearest_side(outlines: &[Ring], place: Point) -> Option<Side> {
    let nearest = |ring: &Ring| {
        ring.segments().map(|side| distance_to(place, side)).min_by(f64::total_cmp).unwrap_or(f64::INFINITY)
    };
    outlines.iter().min_by(|one, other| nearest(one).total_cmp(&nearest(other))).map(Side::of)
}

/// How far a place is from a stretch, in microns.
fn distance_to(place: Point, (from, to): (Point, Point)) -> f64 {
    let (x, y) = from.delta(to);
    let (u, v) = from.delta(place);
    let length2 = (x * x + y * y) as f64;
    let share = if length2 > 0.0 { ((x * u + y * v) as f64 / length2).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (u as f64 - share * x as f64, v as f64 - share * y as f64);
    (x * x + y * y).sqrt()
}
