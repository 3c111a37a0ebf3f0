//! Polygons of a mesh become triangles.
//!
//! A polygon is looked at along the axis along which it is widest. When all others see its first corner, a fan is
//! enough; otherwise a constrained Delaunay triangulation says what lies inside.

use shape::Point3;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Cuts polygons into triangles.
#[derive(Default)]
pub(crate) struct Cutter {
    /// Polygons that cross themselves, which became fans.
    pub(crate) crossed: usize,
    points: Vec<Point3>,
}

impl Cutter {
    /// Appends the triangles of a polygon with at least three corners, all of which are indices of points. They have
    /// the sides of the polygon and no others that are open.
    pub(crate) fn cut(&mut self, corners: &[u32], points: &[Point3], out: &mut Vec<[u32; 3]>) {
        if let [a, b, c] = corners {
            out.push([*a, *b, *c]);
            return;
        }
        self.points.clear();
        let points = corners.iter().map(|corner| points.get(*corner as usize).copied().unwrap_or_default());
        self.points.extend(points);
        let inside = flat(&self.points).filter(|flat| !sees_all(flat)).map(|flat| delaunay(&flat));
        match inside {
            Some(Some(triangles)) => {
                let corner = |index: usize| corners.get(index).copied().unwrap_or_default();
                out.extend(triangles.into_iter().map(|triangle| triangle.map(corner)));
                return;
            }
            Some(None) => self.crossed += 1,
            None => {}
        }
        if let Some((first, rest)) = corners.split_first() {
            out.extend(rest.windows(2).filter_map(|pair| match pair {
                [second, third] => Some([*first, *second, *third]),
                _ => None,
            }));
        }
    }
}

/// A point of the plane in which a polygon is cut.
type Flat = [i64; 2];

/// The polygon seen along the axis along which it is widest, counter-clockwise; `None` when it is a line from all
/// sides.
fn flat(points: &[Point3]) -> Option<Vec<Flat>> {
    let planes: [fn(&Point3) -> [i32; 2]; 3] =
        [|point| [point.y, point.z], |point| [point.z, point.x], |point| [point.x, point.y]];
    let (plane, area) = planes
        .map(|plane| (plane, area2(points.iter().map(|point| plane(point).map(i64::from)))))
        .into_iter()
        .max_by_key(|(_, area)| area.unsigned_abs())?;
    let flat = points.iter().map(|point| plane(point).map(i64::from));
    match area {
        0 => None,
        1.. => Some(flat.collect()),
        // The mirror image has the same triangles.
        _ => Some(flat.map(|[x, y]| [y, x]).collect()),
    }
}

/// Twice the area inside, positive when the polygon runs counter-clockwise.
fn area2(points: impl Iterator<Item = Flat> + Clone) -> i128 {
    let next = points.clone().cycle().skip(1);
    let cross = |([a_x, a_y], [b_x, b_y]): (Flat, Flat)| {
        i128::from(a_x) * i128::from(b_y) - i128::from(a_y) * i128::from(b_x)
    };
    points.zip(next).map(cross).sum()
}

/// Whether a fan around the first corner has only triangles that are not turned over and not flat.
fn sees_all(polygon: &[Flat]) -> bool {
    let Some((first, rest)) = polygon.split_first() else { return false };
    rest.windows(2)
        .all(|pair| matches!(pair, [second, third] if area2([*first, *second, *third].into_iter()) > 0))
}

/// The triangles inside a polygon that runs counter-clockwise, by the places of their corners in it; `None` when it
/// crosses itself.
fn delaunay(polygon: &[Flat]) -> Option<Vec<[usize; 3]>> {
    let mut mesh = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    // The first corner at each vertex of the triangulation: a hole is often joined to the outside by a cut that is
    // walked twice.
    let mut corner_at: Vec<usize> = Vec::with_capacity(polygon.len());
    let mut handles: Vec<FixedVertexHandle> = Vec::with_capacity(polygon.len());
    for (corner, [x, y]) in polygon.iter().enumerate() {
        let handle = mesh.insert(Point2::new(*x as f64, *y as f64)).ok()?;
        if handle.index() == corner_at.len() {
            corner_at.push(corner);
        }
        handles.push(handle);
    }
    let mut constraints = Vec::new();
    for (from, to) in handles.iter().zip(handles.iter().cycle().skip(1)) {
        let edges = mesh.try_add_constraint(*from, *to);
        if edges.is_empty() && from != to {
            return None;
        }
        constraints.extend(edges);
    }
    // How much further in what lies to the left of a directed edge is than what lies to its right.
    let mut steps = vec![0i32; mesh.num_directed_edges()];
    for edge in constraints {
        *steps.get_mut(edge.index())? += 1;
        *steps.get_mut(edge.rev().index())? -= 1;
    }
    let mut depths: Vec<Option<i32>> = vec![None; mesh.num_all_faces()];
    let outside = mesh.outer_face();
    *depths.get_mut(outside.fix().index())? = Some(0);
    let mut to_see: Vec<_> = mesh.convex_hull().collect();
    while let Some(edge) = to_see.pop() {
        // The depth on the left is known, that on the right follows from it.
        let depth = depths.get(edge.face().fix().index()).copied().flatten()?;
        let beyond = edge.rev();
        let right = depths.get_mut(beyond.face().fix().index())?;
        if right.is_some() {
            continue;
        }
        *right = Some(depth - steps.get(edge.fix().index())?);
        to_see.extend(beyond.face().as_inner()?.adjacent_edges());
    }
    let mut triangles = Vec::with_capacity(polygon.len());
    let mut area = 0;
    for face in mesh.inner_faces() {
        if depths.get(face.fix().index()).copied().flatten()? <= 0 {
            continue;
        }
        let corner = |index: usize| corner_at.get(index).copied().unwrap_or_default();
        let triangle = face.vertices().map(|vertex| corner(vertex.fix().index()));
        area += area2(triangle.map(|corner| polygon.get(corner).copied().unwrap_or_default()).into_iter());
        triangles.push(triangle);
    }
    (area == area2(polygon.iter().copied())).then_some(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The triangles of a flat polygon, seen from the side to which `up` points.
    fn cut(outline: &[[i32; 2]], place: fn([i32; 2]) -> Point3) -> (Vec<[u32; 3]>, usize) {
        let points: Vec<Point3> = outline.iter().map(|point| place(*point)).collect();
        let corners: Vec<u32> = (0..points.len() as u32).collect();
        let (mut cutter, mut triangles) = (Cutter::default(), Vec::new());
        cutter.cut(&corners, &points, &mut triangles);
        (triangles, cutter.crossed)
    }

    fn area(outline: &[[i32; 2]], triangles: &[[u32; 3]]) -> Vec<i128> {
        let point = |corner: u32| outline[corner as usize].map(i64::from);
        triangles.iter().map(|triangle| area2(triangle.map(point).into_iter())).collect()
    }

    const ARROW: &[[i32; 2]] = &[[0, 0], [10, 10], [0, 4], [-10, 10]];
    /// A square with a square hole, joined by a cut.
    const KEYHOLE: &[[i32; 2]] =
        &[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0], [3, 3], [3, 6], [6, 6], [6, 3], [3, 3]];

    #[test]
    fn no_triangle_reaches_out_of_a_concave_polygon() {
        let comb: Vec<[i32; 2]> = (0..40)
            .map(|tooth| [tooth, if tooth % 2 == 0 { 20 } else { 1 }])
            .chain([[39, 0], [0, 0]])
            .rev()
            .collect();
        for (outline, expected) in [(ARROW, 80), (KEYHOLE, 144), (&comb, 0)] {
            let expected = if expected > 0 { expected } else { area2(comb.iter().map(|p| p.map(i64::from))) };
            for place in [
                (|[x, y]: [i32; 2]| Point3 { x, y, z: 7 }) as fn([i32; 2]) -> Point3,
                |[x, y]| Point3 { x: y, y: x, z: x },
                |[x, y]| Point3 { x: y, y: 3, z: -x },
            ] {
                let (triangles, crossed) = cut(outline, place);
                let areas = area(outline, &triangles);
                assert_eq!((triangles.len(), crossed), (outline.len() - 2, 0));
                assert!(areas.iter().all(|area| *area > 0), "{areas:?}");
                assert_eq!(areas.iter().sum::<i128>(), expected);
            }
        }
    }

    #[test]
    fn what_crosses_itself_is_a_fan_and_counted() {
        let bow_tie = [[0, 0], [10, 10], [10, 0], [0, 8], [-5, 2]];
        let (triangles, crossed) = cut(&bow_tie, |[x, y]| Point3 { x, y, z: 0 });
        assert_eq!((triangles.len(), crossed), (3, 1));
        let line = [[0, 0], [10, 10], [20, 20], [5, 5]];
        assert_eq!(cut(&line, |[x, y]| Point3 { x, y, z: 0 }).0.len(), 2);
    }
}
