//! A mesh whose layers close, made from one whose layers do not.

use crate::{holes, orient, rims, split, twins, weld};
use shape::TriangleMesh;
use std::borrow::Cow;

/// How a mesh is to be repaired.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repair {
    /// Vertices of open edges nearer than this, in microns, are one; a vertex so near to an open side lies on it.
    pub weld: i32,
    /// The longest hole that is closed though it is far from flat, in microns. Less than nothing leaves all holes open.
    pub widest_hole: i64,
}

impl Repair {
    /// Of a layer's height so much is the width of the cracks that are closed, and of a bead's width at most so much:
    /// less than anyone sees, and far less than a detail that could be printed.
    const CRACK_OF_LAYER: i32 = 20;
    const CRACK_OF_BEAD: i32 = 40;

    /// The repair for layers of a height of beads of a width, in microns.
    pub fn for_layers(height: i32, width: i32, widest_hole: i64) -> Self {
        Self { weld: (height / Self::CRACK_OF_LAYER).min(width / Self::CRACK_OF_BEAD).max(1), widest_hole }
    }
}

/// What was repaired.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repairs {
    /// Vertices of open edges that were taken for one that lies near.
    pub welded: usize,
    /// Faces left out because two of their corners became one, or all lie on a line beside an open edge.
    pub degenerate: usize,
    /// Faces left out because there is another between the same vertices.
    pub doubled: usize,
    /// Sides split at vertices that lie on them.
    pub split: usize,
    /// Faces turned over because they disagreed with their neighbours.
    pub turned: usize,
    /// Shells turned over because they were inside out.
    pub shells_turned: usize,
    /// Holes closed with triangles.
    pub holes: usize,
    /// The longest side of the box around any of them, in microns.
    pub widest_hole: i64,
    /// Holes that stay open.
    pub holes_left: usize,
    /// Open edges before.
    pub open_before: usize,
    /// Open edges that stay.
    pub open_after: usize,
    /// Whether a surface has only one side, so that it has no inside.
    pub one_sided: bool,
}

impl Repairs {
    /// What was done as sentences, one for each kind.
    pub fn notes(&self) -> Vec<String> {
        let some = |count: usize, one: &str, many: &str| {
            (count > 0).then(|| if count == 1 { format!("1 {one}") } else { format!("{count} {many}") })
        };
        let mm = |length: i64| length as f64 / 1000.0;
        let mut notes: Vec<String> = [
            some(
                self.welded,
                "vertex beside a crack was joined with its neighbour",
                "vertices beside cracks were joined with their neighbours",
            ),
            some(self.degenerate, "face without area was left out", "faces without area were left out"),
            some(self.doubled, "duplicate face was left out", "duplicate faces were left out"),
            some(self.split, "side was split at a T-junction", "sides were split at T-junctions"),
            some(self.turned, "flipped face was turned over", "flipped faces were turned over"),
            some(
                self.shells_turned,
                "shell was inside out and turned over",
                "shells were inside out and turned over",
            ),
        ]
        .into_iter()
        .flatten()
        .collect();
        if let Some(holes) = some(self.holes, "hole in the mesh was closed", "holes in the mesh were closed")
        {
            notes.push(format!("{holes}, the widest {:.1} mm", mm(self.widest_hole)));
        }
        if let Some(edges) =
            some(self.open_after, "edge of the mesh stays open", "edges of the mesh stay open")
        {
            notes.push(edges);
        }
        if self.one_sided {
            notes.push("a surface has one side only, like a Moebius strip: it has no inside".to_owned());
        }
        notes
    }
}

/// T-junctions on several sides of one face are split one after the other.
const ROUNDS: usize = 4;

/// Repairs a mesh: duplicates out, cracks and T-junctions closed, neighbours agreed, holes closed, shells outside out.
pub fn repair(mesh: &TriangleMesh, how: Repair) -> (TriangleMesh, Repairs) {
    let mut work = Work {
        mesh: Cow::Borrowed(mesh),
        done: Repairs { open_before: mesh.flaws.open, ..Repairs::default() },
    };
    work.weld(how.weld);
    if work.mesh.flaws.open > 0 {
        work.without_flat();
        work.split(how.weld);
    }
    work.agree();
    if how.widest_hole >= 0 && work.mesh.flaws.open > 0 && !work.done.one_sided {
        work.fill(how);
        work.agree();
    }
    work.outwards();
    work.done.open_after = work.mesh.flaws.open;
    (work.mesh.into_owned(), work.done)
}

/// A mesh under repair. Finding the edges anew is what costs, so it is done as seldom as can be.
struct Work<'a> {
    mesh: Cow<'a, TriangleMesh>,
    done: Repairs,
}

impl Work<'_> {
    fn triangles(&self) -> Vec<[u32; 3]> {
        self.mesh.faces.iter().map(|face| face.vertices).collect()
    }

    /// New triangles between the same vertices; those that have become a line are left out.
    fn set(&mut self, mut triangles: Vec<[u32; 3]>) {
        let before = triangles.len();
        triangles.retain(|[a, b, c]| a != b && b != c && c != a);
        self.done.degenerate += before - triangles.len();
        // The old edges go before the new ones come.
        let vertices = match std::mem::replace(&mut self.mesh, Cow::Owned(TriangleMesh::default())) {
            Cow::Borrowed(mesh) => mesh.vertices.clone(),
            Cow::Owned(mesh) => mesh.vertices,
        };
        self.mesh = Cow::Owned(TriangleMesh::from_triangles(vertices, triangles));
    }

    /// The triangles without those of the numbers, which rise.
    fn without(&self, numbers: &[u32]) -> Vec<[u32; 3]> {
        let mut triangles = self.triangles();
        let (mut number, mut next) = (0u32, numbers.iter().copied().peekable());
        triangles.retain(|_| {
            number += 1;
            next.next_if_eq(&(number - 1)).is_none()
        });
        triangles
    }

    /// Duplicate faces go, and cracks are closed.
    fn weld(&mut self, tolerance: i32) {
        let needless = twins::needless(&self.mesh);
        let (becomes, count) = weld::welded(&self.mesh, &rims::open_sides(&self.mesh), tolerance);
        self.done.doubled += needless.len();
        self.done.welded += count;
        if !needless.is_empty() || count > 0 {
            let mut triangles = self.without(&needless);
            triangles.as_flattened_mut().iter_mut().for_each(|vertex| *vertex = becomes[*vertex as usize]);
            self.set(triangles);
        }
    }

    /// Faces whose corners lie on a line do no harm unless they have an open side: then they hide a T-junction.
    fn without_flat(&mut self) {
        let mut flat: Vec<u32> = rims::open_sides(&self.mesh)
            .into_iter()
            .map(|side| side.face)
            .filter(|face| self.mesh.normal(&self.mesh.faces[*face as usize]) == [0.0; 3])
            .collect();
        flat.sort_unstable();
        flat.dedup();
        if !flat.is_empty() {
            self.done.degenerate += flat.len();
            self.set(self.without(&flat));
        }
    }

    fn split(&mut self, tolerance: i32) {
        for _ in 0..ROUNDS {
            let sides = rims::open_sides(&self.mesh);
            let mut triangles = self.triangles();
            let (count, again) = split::split(&self.mesh, &sides, tolerance, &mut triangles);
            if count == 0 {
                return;
            }
            self.done.split += count;
            self.set(triangles);
            if !again {
                return;
            }
        }
    }

    fn agree(&mut self) {
        if self.mesh.flaws.alike == 0 {
            return;
        }
        let turns = orient::agreed(&self.mesh);
        self.done.one_sided |= turns.one_sided;
        self.done.turned += turns.count;
        if turns.count > 0 {
            orient::turn(self.mesh.to_mut(), &turns.over);
        }
        // Where more than two faces meet others may belong together now.
        if self.mesh.flaws.alike > 0 {
            self.set(self.triangles());
        }
    }

    fn fill(&mut self, how: Repair) {
        let sides = rims::open_sides(&self.mesh);
        let filled = holes::filled(&self.mesh, &sides, f64::from(how.weld), how.widest_hole);
        self.done.holes = filled.holes;
        self.done.holes_left = filled.left;
        self.done.widest_hole = filled.widest;
        if filled.holes > 0 {
            let mut triangles = self.triangles();
            triangles.extend(filled.triangles);
            self.set(triangles);
        }
    }

    fn outwards(&mut self) {
        let (over, shells) = orient::inside_out(&self.mesh);
        if shells > 0 {
            self.done.shells_turned += shells;
            orient::turn(self.mesh.to_mut(), &over);
        }
    }
}
