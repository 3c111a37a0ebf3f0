//! Where the surface runs through itself.

use crate::tree::{Box3, Tree, array};
use rayon::prelude::*;
use shape::TriangleMesh;

/// Pairs of faces counted at most: a surface that runs through itself more often is beyond counting.
pub(crate) const MOST: usize = 100_000;

/// How many faces are looked at between two looks at the sum: the same for any number of threads.
const PIECE: usize = 8192;

/// How many pairs of faces run through each other, up to about [`MOST`].
///
/// Faces that only touch, or lie in one plane, are not counted; nor are those that share an edge.
pub(crate) fn count(mesh: &TriangleMesh, tree: &Tree) -> usize {
    let mut sum = 0;
    for start in (0..mesh.faces.len()).step_by(PIECE) {
        let end = (start + PIECE).min(mesh.faces.len());
        sum += (start..end)
            .into_par_iter()
            .with_min_len(256)
            .map(|face| of(mesh, tree, face as u32))
            .sum::<usize>();
        if sum >= MOST {
            break;
        }
    }
    sum
}

/// How many faces of a higher number run through a face.
fn of(mesh: &TriangleMesh, tree: &Tree, face: u32) -> usize {
    let mine = &mesh.faces[face as usize];
    let corners = mesh.corners(mine);
    let mut count = 0;
    tree.meeting(&Box3::around(corners), |other| {
        if other <= face || count > MOST {
            return;
        }
        let theirs = &mesh.faces[other as usize];
        let shared = mine.vertices.iter().filter(|vertex| theirs.vertices.contains(vertex)).count();
        let through = shared < 2 && {
            let (one, two) = (corners.map(array), mesh.corners(theirs).map(array));
            runs_through(one, two) || runs_through(two, one)
        };
        count += usize::from(through);
    });
    count
}

/// Whether a side of the first triangle goes through the second from one side to the other: exact.
fn runs_through(one: [[i32; 3]; 3], [a, b, c]: [[i32; 3]; 3]) -> bool {
    let heights = one.map(|corner| side(corner, a, b, c));
    (0..3).any(|turn| {
        let (from, to) = (turn, (turn + 1) % 3);
        if heights[from] * heights[to] >= 0 {
            return false;
        }
        let (p, q) = (one[from], one[to]);
        let turns = [side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)];
        turns.iter().all(|turn| *turn >= 0) || turns.iter().all(|turn| *turn <= 0)
    })
}

/// On which side of the plane through three points a point lies: −1, 0 or 1.
fn side(point: [i32; 3], a: [i32; 3], b: [i32; 3], c: [i32; 3]) -> i128 {
    let from = |to: [i32; 3]| [0, 1, 2].map(|axis| i128::from(to[axis]) - i128::from(point[axis]));
    let (a, b, c) = (from(a), from(b), from(c));
    let volume = a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0]);
    volume.signum()
}
