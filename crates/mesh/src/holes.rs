//! Holes: loops of open edges, closed with triangles between their vertices.

use crate::rims::{self, Side};
use crate::tree::{Box3, array};
use shape::TriangleMesh;

/// What became of the holes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Filled {
    /// The triangles that close them.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// How many are closed.
    pub(crate) holes: usize,
    /// How many stay open.
    pub(crate) left: usize,
    /// The longest side of the box around any hole that was closed, in microns.
    pub(crate) widest: i64,
}

/// A rim that leaves its plane by less than this share of its length has an obvious lid; the holes that a scanner leaves
/// where it could not see are like that.
const NEARLY_FLAT: f64 = 0.25;

/// Closes the holes that are flat within `tolerance` or nearly so for their size, or no longer than `widest` microns.
///
/// Other holes have no shape that could be guessed.
pub(crate) fn filled(mesh: &TriangleMesh, sides: &[Side], tolerance: f64, widest: i64) -> Filled {
    let mut filled = Filled::default();
    for rim in rims::loops(sides).into_iter().filter(|rim| !is_lonely(rim, sides)) {
        let around = Box3::around(rim.iter().map(|vertex| mesh.vertices[*vertex as usize]));
        let length = (0..3).map(|axis| i64::from(around.high[axis]) - i64::from(around.low[axis])).max();
        let length = length.unwrap_or_default();
        match triangles(mesh, &rim, tolerance.max(length as f64 * NEARLY_FLAT), length <= widest) {
            Some(triangles) => {
                filled.triangles.extend(triangles);
                filled.holes += 1;
                filled.widest = filled.widest.max(length);
            }
            None => filled.left += 1,
        }
    }
    filled
}

/// Whether a rim runs around a single triangle: that is no hole in anything.
fn is_lonely(rim: &[u32], sides: &[Side]) -> bool {
    let face = |place: usize| {
        let (to, from) = (rim[place], rim[(place + 1) % rim.len()]);
        let side = sides.partition_point(|side| (side.from, side.to) < (from, to));
        sides.get(side).filter(|side| (side.from, side.to) == (from, to)).map(|side| side.face)
    };
    rim.len() == 3 && face(0).is_some() && face(0) == face(1) && face(1) == face(2)
}

/// Above this many corners a hole is closed with a fan or not at all: cutting ears takes the square of their number.
const MOST_EARS: usize = 1000;

/// Up to so many corners the best ear is looked for and not the first.
const PLUMP: usize = 128;

/// Triangles over a rim; `None` when it is not flat and may not be bent, or turns back on itself.
fn triangles(mesh: &TriangleMesh, rim: &[u32], tolerance: f64, bent: bool) -> Option<Vec<[u32; 3]>> {
    if rim.len() < 3 {
        return None;
    }
    if let [a, b, c] = rim {
        return Some(vec![[*a, *b, *c]]);
    }
    let points: Vec<[f64; 3]> =
        rim.iter().map(|vertex| array(mesh.vertices[*vertex as usize]).map(f64::from)).collect();
    let normal = normal(&points)?;
    let height =
        |point: &[f64; 3]| (0..3).map(|axis| (point[axis] - points[0][axis]) * normal[axis]).sum::<f64>();
    let (low, high) =
        points.iter().map(height).fold((0.0f64, 0.0f64), |(low, high), h| (low.min(h), high.max(h)));
    if high - low > tolerance && !bent {
        return None;
    }
    let flat = flattened(&points, normal);
    if rim.len() <= MOST_EARS {
        return ears(&flat).map(|ears| ears.into_iter().map(|ear| ear.map(|corner| rim[corner])).collect());
    }
    // A level lid is cut by no plane, so that its triangles may overlap; others must not.
    let level = points.iter().all(|point| point[2] == points[0][2]);
    (level || is_convex(&flat))
        .then(|| (1..rim.len() - 1).map(|place| [rim[0], rim[place], rim[place + 1]]).collect())
}

/// The normal of a loop after Newell, of length one; `None` when it encloses nothing.
fn normal(points: &[[f64; 3]]) -> Option<[f64; 3]> {
    let mut sum = [0.0; 3];
    let origin = points[0];
    for (from, to) in points.iter().zip(points.iter().cycle().skip(1)) {
        let (a, b) = ([0, 1, 2].map(|i| from[i] - origin[i]), [0, 1, 2].map(|i| to[i] - origin[i]));
        sum[0] += a[1] * b[2] - a[2] * b[1];
        sum[1] += a[2] * b[0] - a[0] * b[2];
        sum[2] += a[0] * b[1] - a[1] * b[0];
    }
    let length = sum.iter().map(|part| part * part).sum::<f64>().sqrt();
    (length > 0.0).then(|| sum.map(|part| part / length))
}

/// The points without the axis along which the normal is longest, in an order that keeps the loop counter-clockwise.
fn flattened(points: &[[f64; 3]], normal: [f64; 3]) -> Vec<[f64; 2]> {
    let longest = (1..3)
        .fold(0, |longest, axis| if normal[axis].abs() > normal[longest].abs() { axis } else { longest });
    let (mut u, mut v) = ((longest + 1) % 3, (longest + 2) % 3);
    if normal[longest] < 0.0 {
        (u, v) = (v, u);
    }
    points.iter().map(|point| [point[u], point[v]]).collect()
}

fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn is_convex(points: &[[f64; 2]]) -> bool {
    let next = |place: usize| points[place % points.len()];
    (0..points.len()).all(|place| turn(next(place), next(place + 1), next(place + 2)) >= 0.0)
}

/// Cuts corner after corner off a loop that turns counter-clockwise; `None` when it crosses itself.
///
/// A straight corner is cut only when no other is left: its ear has no area.
fn ears(points: &[[f64; 2]]) -> Option<Vec<[usize; 3]>> {
    let mut left: Vec<usize> = (0..points.len()).collect();
    let mut ears = Vec::with_capacity(points.len() - 2);
    while left.len() > 3 {
        let count = left.len();
        let corner =
            |place: usize| [left[(place + count - 1) % count], left[place], left[(place + 1) % count]];
        let is_ear = |place: &usize| {
            let ear = corner(*place);
            let [a, b, c] = ear.map(|corner| points[corner]);
            let inside = |other: &usize| {
                let point = points[*other];
                !ear.contains(other)
                    && ![a, b, c].contains(&point)
                    && turn(a, b, point) >= 0.0
                    && turn(b, c, point) >= 0.0
                    && turn(c, a, point) >= 0.0
            };
            turn(a, b, c) > 0.0 && !left.iter().any(inside)
        };
        // The ear with the shortest cut keeps the triangles plump; that it is the first of its length keeps them the
        // same on every machine.
        let length = |place: &usize| {
            let [a, _, c] = corner(*place).map(|corner| points[corner]);
            (c[0] - a[0]).powi(2) + (c[1] - a[1]).powi(2)
        };
        let place = match (0..count).find(is_ear) {
            Some(first) if count > PLUMP => first,
            Some(_) => {
                (0..count).filter(is_ear).min_by(|one, other| length(one).total_cmp(&length(other)))?
            }
            None => (0..count).find(|place| {
                let [a, b, c] = corner(*place).map(|corner| points[corner]);
                turn(a, b, c) == 0.0
            })?,
        };
        ears.push(corner(place));
        left.remove(place);
    }
    ears.push([left[0], left[1], left[2]]);
    Some(ears)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[[f64; 2]], ears: &[[usize; 3]]) -> f64 {
        ears.iter().map(|[a, b, c]| turn(points[*a], points[*b], points[*c]) / 2.0).sum()
    }

    #[test]
    fn a_hollow_outline_is_cut_into_its_own_area() {
        let comb =
            [[0.0, 0.0], [9.0, 0.0], [9.0, 5.0], [7.0, 5.0], [7.0, 1.0], [2.0, 1.0], [2.0, 5.0], [0.0, 5.0]];
        let ears = ears(&comb).expect("it does not cross itself");
        assert_eq!(ears.len(), 6);
        assert!(ears.iter().all(|[a, b, c]| turn(comb[*a], comb[*b], comb[*c]) > 0.0));
        assert_eq!(area(&comb, &ears), 9.0 + 8.0 + 8.0);
    }

    #[test]
    fn corners_on_a_straight_side_are_used_too() {
        let square = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0]];
        let ears = ears(&square).expect("a square");
        assert_eq!((ears.len(), area(&square, &ears)), (4, 4.0));
    }

    #[test]
    fn a_bow_tie_has_no_ears() {
        assert_eq!(ears(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0], [-1.0, 9.0], [5.0, -9.0]]), None);
    }
}
