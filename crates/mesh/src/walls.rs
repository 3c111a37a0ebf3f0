//! How thick the thinnest wall is.

use crate::tree::{Box3, Tree, array};
use rayon::prelude::*;
use shape::{Point3, TriangleMesh};

/// Faces from which is looked at most; of a finer mesh every so many-th is taken.
const MOST_LOOKS: usize = 100_000;

/// The cosine of the angle at which two faces still face each other: what is more aslant is an edge and no wall.
const FACING: f64 = 0.8;

/// The thinnest wall in microns, and where: from the middle of a face straight inwards to the face that looks the
/// other way. `None` when there is none that has a back.
pub(crate) fn thinnest(mesh: &TriangleMesh, tree: &Tree) -> Option<(f64, Point3)> {
    let step = mesh.faces.len().div_ceil(MOST_LOOKS).max(1);
    let bounds = mesh.bounds();
    let reach = [(bounds.min.x, bounds.max.x), (bounds.min.y, bounds.max.y), (bounds.min.z, bounds.max.z)]
        .map(|(low, high)| f64::from(high) - f64::from(low))
        .iter()
        .sum::<f64>();
    (0..mesh.faces.len())
        .into_par_iter()
        .step_by(step)
        .filter_map(|face| behind(mesh, tree, face as u32, reach))
        .min_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)))
}

/// How far behind a face the next one lies, if it looks the other way.
fn behind(mesh: &TriangleMesh, tree: &Tree, face: u32, reach: f64) -> Option<(f64, Point3)> {
    let corners = mesh.corners(&mesh.faces[face as usize]);
    let inward = unit(mesh.normal(&mesh.faces[face as usize]).map(|part| -part))?;
    let middle =
        [0, 1, 2].map(|axis| corners.iter().map(|corner| f64::from(array(*corner)[axis])).sum::<f64>() / 3.0);
    let mut nearest: Option<(f64, u32)> = None;
    // The search shrinks with what is found; it starts with the longest ray that can hit anything.
    let reach_now = std::cell::Cell::new(reach);
    tree.visit(|around| meets_ray(around, middle, inward, reach_now.get()), &mut |other| {
        if other == face {
            return;
        }
        if let Some(far) = hit(mesh, other, middle, inward).filter(|far| *far <= reach_now.get()) {
            if nearest.is_none_or(|(known, who)| (far, other) < (known, who)) {
                nearest = Some((far, other));
            }
            reach_now.set(far);
        }
    });
    let (far, other) = nearest?;
    let back = unit(mesh.normal(&mesh.faces[other as usize]))?;
    let facing = (0..3).map(|axis| back[axis] * inward[axis]).sum::<f64>() >= FACING;
    facing.then(|| {
        let [x, y, z] = middle.map(|value| value as i32);
        (far, Point3 { x, y, z })
    })
}

fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = vector.iter().map(|part| part * part).sum::<f64>().sqrt();
    (length > 0.0).then(|| vector.map(|part| part / length))
}

/// Whether a ray of some length meets a box grown by a micron.
fn meets_ray(around: &Box3, start: [f64; 3], along: [f64; 3], reach: f64) -> bool {
    let (mut enter, mut leave) = (0.0f64, reach);
    for axis in 0..3 {
        let (low, high) = (f64::from(around.low[axis]) - 1.0, f64::from(around.high[axis]) + 1.0);
        if along[axis] == 0.0 {
            if start[axis] < low || start[axis] > high {
                return false;
            }
            continue;
        }
        let (one, other) = ((low - start[axis]) / along[axis], (high - start[axis]) / along[axis]);
        enter = enter.max(one.min(other));
        leave = leave.min(one.max(other));
    }
    enter <= leave
}

/// How far along a ray it meets a face, if in front (Möller and Trumbore 1997).
fn hit(mesh: &TriangleMesh, face: u32, start: [f64; 3], along: [f64; 3]) -> Option<f64> {
    let [a, b, c] = mesh.corners(&mesh.faces[face as usize]).map(|corner| array(corner).map(f64::from));
    let minus = |one: [f64; 3], other: [f64; 3]| [0, 1, 2].map(|axis| one[axis] - other[axis]);
    let cross = |u: [f64; 3], v: [f64; 3]| {
        [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    };
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let (u, v, to) = (minus(b, a), minus(c, a), minus(start, a));
    let p = cross(along, v);
    let slope = dot(u, p);
    if slope == 0.0 {
        return None;
    }
    let s = dot(to, p) / slope;
    let q = cross(to, u);
    let t = dot(along, q) / slope;
    let far = dot(v, q) / slope;
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && far > 0.0).then_some(far)
}
