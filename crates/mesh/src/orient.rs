//! Which side of a face is out.

use crate::shells::{Shells, crowded_edges};
use crate::tree::{Box3, Tree, array};
use shape::{Edge, TriangleMesh};

/// The faces that must be turned over so that neighbours agree.
pub(crate) struct Turns {
    /// Whether each face is to be turned over.
    pub(crate) over: Vec<bool>,
    /// How many are.
    pub(crate) count: usize,
    /// Whether a surface has one side only, like a Moebius strip, so that its faces cannot agree.
    pub(crate) one_sided: bool,
}

/// Goes from face to face and turns those that disagree with their neighbours: in each shell the fewer.
///
/// Where more than two faces meet nothing is concluded from one about the other.
pub(crate) fn agreed(mesh: &TriangleMesh) -> Turns {
    let (crowded, _) = crowded_edges(mesh);
    let mut over: Vec<Option<bool>> = vec![None; mesh.faces.len()];
    let mut turns = Turns { over: Vec::new(), count: 0, one_sided: false };
    let mut shell: Vec<u32> = Vec::new();
    for start in 0..mesh.faces.len() as u32 {
        if over[start as usize].is_some() {
            continue;
        }
        over[start as usize] = Some(false);
        shell.clear();
        shell.push(start);
        let mut reached = 0;
        while let Some(&face) = shell.get(reached) {
            reached += 1;
            let here = over[face as usize] == Some(true);
            for edge in mesh.faces[face as usize].edges {
                let Some(next) = mesh.edges[edge as usize].across(face).filter(|_| !crowded[edge as usize])
                else {
                    continue;
                };
                let wanted = here != (runs_up(mesh, face, edge) == runs_up(mesh, next, edge));
                match over[next as usize] {
                    None => {
                        over[next as usize] = Some(wanted);
                        shell.push(next);
                    }
                    Some(found) => turns.one_sided |= found != wanted,
                }
            }
        }
        let turned = shell.iter().filter(|face| over[**face as usize] == Some(true)).count();
        let most = turned * 2 > shell.len();
        if most {
            shell.iter().for_each(|face| over[*face as usize] = over[*face as usize].map(|over| !over));
        }
        turns.count += if most { shell.len() - turned } else { turned };
    }
    turns.over = over.into_iter().map(|over| over == Some(true)).collect();
    turns
}

/// Turns faces over where they are. The pairs of faces at the edges stay as they are.
pub(crate) fn turn(mesh: &mut TriangleMesh, over: &[bool]) {
    for (face, _) in mesh.faces.iter_mut().zip(over).filter(|(_, over)| **over) {
        // The edges begin with the one between the first two vertices.
        face.vertices.swap(1, 2);
        face.edges.swap(0, 2);
    }
    let alike = |(edge, number): &(&Edge, u32)| {
        let [one, other] = edge.faces;
        other != Edge::OPEN && runs_up(mesh, one, *number) == runs_up(mesh, other, *number)
    };
    mesh.flaws.alike = mesh.edges.iter().zip(0u32..).filter(alike).count();
}

/// Whether a face runs along an edge from its smaller vertex to its larger.
fn runs_up(mesh: &TriangleMesh, face: u32, edge: u32) -> bool {
    let corners = &mesh.faces[face as usize];
    let turn = corners.edges.iter().position(|side| *side == edge).unwrap_or_default();
    corners.vertices[turn] == mesh.edges[edge as usize].vertices[0]
}

/// The faces of the shells that are inside out.
///
/// A closed shell that lies in no other must enclose a volume. One inside another is a cavity when it is turned the
/// other way, and stays as it is; when the other is turned, it is turned too.
pub(crate) fn inside_out(mesh: &TriangleMesh) -> (Vec<bool>, usize) {
    let shells = Shells::of(mesh);
    let volumes = shells.volumes(mesh);
    let mut over = vec![false; shells.count];
    // A part with all its cavities inside out is turned as a whole.
    let all = volumes.iter().map(|(volume, _)| *volume).sum::<i128>() < 0;
    let inward = |shell: usize| volumes[shell].1 && (volumes[shell].0 < 0) != all;
    if all || (0..shells.count).any(inward) {
        over.fill(all);
        let view = View::new(mesh, &shells);
        let mut turned = vec![false; shells.count];
        for shell in (0..shells.count).filter(|shell| inward(*shell)) {
            turned[shell] = !view.is_within(shell, |_| true);
        }
        if turned.contains(&true) {
            for shell in 0..shells.count {
                let within = !turned[shell] && view.is_within(shell, |other| turned[other]);
                over[shell] ^= turned[shell] || within;
            }
        }
    }
    let count = over.iter().filter(|over| **over).count();
    (shells.of_face.iter().map(|shell| over[*shell as usize]).collect(), count)
}

/// The shells as seen along the x axis.
struct View<'a> {
    mesh: &'a TriangleMesh,
    shells: &'a Shells,
    tree: Tree,
    /// The vertices of each shell that reach farthest, to both sides along all axes.
    extremes: Vec<[[i32; 3]; 6]>,
}

impl<'a> View<'a> {
    fn new(mesh: &'a TriangleMesh, shells: &'a Shells) -> Self {
        let mut extremes = vec![None; shells.count];
        for (face, shell) in mesh.faces.iter().zip(&shells.of_face) {
            for corner in mesh.corners(face).map(array) {
                let known = extremes[*shell as usize].get_or_insert([corner; 6]);
                for axis in 0..3 {
                    // Of equally far ones the least, so that the order of the faces does not matter.
                    let (low, high) = (known[axis], known[axis + 3]);
                    known[axis] = if (corner[axis], corner) < (low[axis], low) { corner } else { low };
                    known[axis + 3] =
                        if (-corner[axis], corner) < (-high[axis], high) { corner } else { high };
                }
            }
        }
        let extremes = extremes.into_iter().map(Option::unwrap_or_default).collect();
        let tree = Tree::new(mesh.faces.iter().map(|face| Box3::around(mesh.corners(face))));
        Self { mesh, shells, tree, extremes }
    }

    /// Whether a shell lies inside some others: all its extremes do. One that only reaches into another does not.
    fn is_within(&self, shell: usize, asked: impl Fn(usize) -> bool) -> bool {
        self.extremes[shell].iter().all(|at| self.winding(*at, shell, &asked) != 0)
    }

    /// How often some shells, but not a point's own, wind around the point.
    fn winding(&self, at: [i32; 3], shell: usize, asked: impl Fn(usize) -> bool) -> i32 {
        let ray = Box3 { low: [i32::MIN, at[1], at[2]], high: at };
        let mut winding = 0;
        self.tree.meeting(&ray, |face| {
            let other = self.shells.of_face[face as usize] as usize;
            if other != shell && asked(other) {
                winding += crossing(self.mesh.corners(&self.mesh.faces[face as usize]).map(array), at);
            }
        });
        winding
    }
}

/// Whether the ray from a point to the left leaves (1) or enters (−1) the solid through a triangle: exact, and a ray
/// through an edge crosses one of its two faces.
fn crossing(corners: [[i32; 3]; 3], at: [i32; 3]) -> i32 {
    let [a, b, c] =
        corners.map(|corner| [0, 1, 2].map(|axis| i128::from(corner[axis]) - i128::from(at[axis])));
    let mut turn = 0i128;
    for (from, to) in [(a, b), (b, c), (c, a)] {
        let left = from[1] * to[2] - from[2] * to[1];
        if from[2] <= 0 && to[2] > 0 && left > 0 {
            turn += 1;
        } else if from[2] > 0 && to[2] <= 0 && left < 0 {
            turn -= 1;
        }
    }
    let side = a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0]);
    if turn != 0 && side.signum() == -turn { -(turn as i32) } else { 0 }
}
