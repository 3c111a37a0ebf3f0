//! T-junctions: an open side with vertices of other rims on it is split there.

use crate::rims::{self, Side};
use crate::tree::{Box3, Tree, array};
use shape::{Point3, TriangleMesh};

/// Splits the faces whose open sides pass within `tolerance` of vertices of rims, at these vertices.
///
/// Returns how many sides were split, and whether a face has more of them: one side of a face is split at a time.
pub(crate) fn split(
    mesh: &TriangleMesh,
    sides: &[Side],
    tolerance: i32,
    triangles: &mut Vec<[u32; 3]>,
) -> (usize, bool) {
    let rim = rims::vertices(sides);
    let point = |vertex: u32| mesh.vertices[vertex as usize];
    let tree = Tree::new(rim.iter().map(|vertex| Box3::around([point(*vertex)])));
    let (mut count, mut again) = (0, false);
    let mut done = vec![false; mesh.faces.len()];
    for side in sides {
        let (from, to) = (point(side.from), point(side.to));
        let mut on: Vec<(f64, u32)> = Vec::new();
        tree.meeting(&Box3::around([from, to]).grown(tolerance), |item| {
            let vertex = rim[item as usize];
            let corner = mesh.faces[side.face as usize].vertices.contains(&vertex);
            if let Some(share) =
                share_along(from, to, point(vertex), f64::from(tolerance)).filter(|_| !corner)
            {
                on.push((share, vertex));
            }
        });
        if on.is_empty() {
            continue;
        }
        if std::mem::replace(&mut done[side.face as usize], true) {
            again = true;
            continue;
        }
        on.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        count += 1;
        let corners = mesh.faces[side.face as usize].vertices;
        let apex = corners.into_iter().find(|corner| *corner != side.from && *corner != side.to);
        let Some(apex) = apex else { continue };
        let mut before = side.from;
        for (place, &(_, vertex)) in on.iter().enumerate() {
            if place == 0 {
                triangles[side.face as usize] = [before, vertex, apex];
            } else {
                triangles.push([before, vertex, apex]);
            }
            before = vertex;
        }
        triangles.push([before, side.to, apex]);
    }
    (count, again)
}

/// Where along a side its point nearest to another point is, if that is near enough and between the ends.
fn share_along(from: Point3, to: Point3, point: Point3, tolerance: f64) -> Option<f64> {
    let vector = |to: Point3| {
        let (from, to) = (array(from), array(to));
        [0, 1, 2].map(|axis| f64::from(to[axis]) - f64::from(from[axis]))
    };
    let dot = |one: [f64; 3], other: [f64; 3]| one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
    let (along, toward) = (vector(to), vector(point));
    let length2 = dot(along, along);
    let share = dot(along, toward) / length2;
    let aside2 = dot(toward, toward) - share * share * length2;
    (share > 0.0 && share < 1.0 && aside2 <= tolerance * tolerance).then_some(share)
}
