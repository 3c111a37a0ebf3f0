//! Parts turned and put side by side.

use shape::{Bounds, Edge, Face, Flaws, Point3, TriangleMesh};
use unit::Angle;

/// Turns about the axes: about x first, then y, then z, each counter-clockwise seen from its end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Turn {
    /// About the x axis.
    pub x: Angle,
    /// About the y axis.
    pub y: Angle,
    /// About the z axis.
    pub z: Angle,
}

/// The part turned about the middle of its box; `None` when it would reach farther than coordinates do.
///
/// Quarter turns are exact.
pub fn turned(mesh: &TriangleMesh, turn: Turn) -> Option<TriangleMesh> {
    let Bounds { min, max } = mesh.bounds();
    let middle = [(min.x, max.x), (min.y, max.y), (min.z, max.z)]
        .map(|(low, high)| ((i64::from(low) + i64::from(high)) / 2) as f64);
    let [x, y, z] = [turn.x, turn.y, turn.z].map(cosine_and_sine);
    let mut turned = mesh.clone();
    for vertex in &mut turned.vertices {
        let mut at = [
            f64::from(vertex.x) - middle[0],
            f64::from(vertex.y) - middle[1],
            f64::from(vertex.z) - middle[2],
        ];
        for ((cosine, sine), (u, v)) in [(x, (1, 2)), (y, (2, 0)), (z, (0, 1))] {
            (at[u], at[v]) = (at[u] * cosine - at[v] * sine, at[u] * sine + at[v] * cosine);
        }
        let [x, y, z] = [0, 1, 2].map(|axis| (at[axis] + middle[axis]).round());
        let limit = f64::from(unit::Micron::LIMIT);
        if [x, y, z].iter().any(|value| value.abs() > limit) {
            return None;
        }
        *vertex = Point3 { x: x as i32, y: y as i32, z: z as i32 };
    }
    Some(turned)
}

fn cosine_and_sine(angle: Angle) -> (f64, f64) {
    match angle.0.rem_euclid(360_000) {
        0 => (1.0, 0.0),
        90_000 => (0.0, 1.0),
        180_000 => (-1.0, 0.0),
        270_000 => (0.0, -1.0),
        _ => {
            let radians = angle.degrees().to_radians();
            (libm::cos(radians), libm::sin(radians))
        }
    }
}

/// A part that finds no place on the bed beside the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoRoom {
    /// Its place in the list.
    pub part: usize,
}

/// How far each part moves so that all stand side by side on a bed of `width` by `depth` microns, `gap` apart, their
/// feet at one height, the first corner of all at zero.
///
/// They stand in rows, the deepest first; equal ones in the order in which they are given.
///
/// # Errors
/// When a part finds no room.
pub fn arranged(bounds: &[Bounds], width: i32, depth: i32, gap: i32) -> Result<Vec<Point3>, NoRoom> {
    let size = |part: usize| {
        let Bounds { min, max } = bounds[part];
        (i64::from(max.x) - i64::from(min.x), i64::from(max.y) - i64::from(min.y))
    };
    let mut order: Vec<usize> = (0..bounds.len()).collect();
    order.sort_by_key(|part| (std::cmp::Reverse(size(*part).1), *part));
    let (width, depth, gap) = (i64::from(width), i64::from(depth), i64::from(gap));
    let mut moves = vec![Point3::default(); bounds.len()];
    let (mut x, mut y, mut row) = (0i64, 0i64, 0i64);
    for part in order {
        let (wide, deep) = size(part);
        if x > 0 && x + wide > width {
            (x, y, row) = (0, y + row + gap, 0);
        }
        if wide > width || y + deep > depth {
            return Err(NoRoom { part });
        }
        let from = bounds[part].min;
        let to = |place: i64, from: i32| i32::try_from(place - i64::from(from)).map_err(|_| NoRoom { part });
        moves[part] = Point3 { x: to(x, from.x)?, y: to(y, from.y)?, z: to(0, from.z)? };
        x += wide + gap;
        row = row.max(deep);
    }
    Ok(moves)
}

/// Several parts as one mesh, each moved; their surfaces stay apart.
///
/// # Panics
/// When there are more faces or vertices than a mesh may have.
pub fn joined(parts: &[(&TriangleMesh, Point3)]) -> TriangleMesh {
    let mut whole = TriangleMesh::default();
    let faces: usize = parts.iter().map(|(mesh, _)| mesh.faces.len()).sum();
    assert!(faces <= TriangleMesh::MOST_TRIANGLES, "more triangles than a mesh may have");
    for (mesh, by) in parts {
        let [vertices, faces, edges] =
            [whole.vertices.len(), whole.faces.len(), whole.edges.len()].map(|count| count as u32);
        whole.vertices.extend(mesh.vertices.iter().map(|at| Point3 {
            x: at.x + by.x,
            y: at.y + by.y,
            z: at.z + by.z,
        }));
        whole.faces.extend(mesh.faces.iter().map(|face| Face {
            vertices: face.vertices.map(|vertex| vertex + vertices),
            edges: face.edges.map(|edge| edge + edges),
        }));
        let shifted = |face: u32| if face == Edge::OPEN { face } else { face + faces };
        whole.edges.extend(mesh.edges.iter().map(|edge| Edge {
            vertices: edge.vertices.map(|vertex| vertex + vertices),
            faces: edge.faces.map(shifted),
        }));
        whole.flaws =
            Flaws { open: whole.flaws.open + mesh.flaws.open, alike: whole.flaws.alike + mesh.flaws.alike };
    }
    whole
}
