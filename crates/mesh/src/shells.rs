//! Which faces hang together.

use shape::{Edge, TriangleMesh};

/// Things in groups; the group is known by its least member.
pub(crate) struct Groups(Vec<u32>);

impl Groups {
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    pub(crate) fn of(&mut self, mut one: u32) -> u32 {
        while self.0[one as usize] != one {
            // Every other step is cut short, so that the next way is half as long.
            let above = self.0[self.0[one as usize] as usize];
            self.0[one as usize] = above;
            one = above;
        }
        one
    }

    pub(crate) fn join(&mut self, one: u32, other: u32) {
        let (one, other) = (self.of(one), self.of(other));
        self.0[one.max(other) as usize] = one.min(other);
    }
}

/// The shells of a mesh: the number of each face's shell, and how many there are.
pub(crate) struct Shells {
    pub(crate) of_face: Vec<u32>,
    pub(crate) count: usize,
}

impl Shells {
    /// Faces that share an edge, as the edges pair them, are of one shell. Shells are numbered by their first face.
    pub(crate) fn of(mesh: &TriangleMesh) -> Self {
        let mut groups = Groups::new(mesh.faces.len());
        for edge in mesh.edges.iter().filter(|edge| edge.faces[1] != Edge::OPEN) {
            groups.join(edge.faces[0], edge.faces[1]);
        }
        let mut of_face = vec![0u32; mesh.faces.len()];
        let mut count = 0;
        for face in 0..mesh.faces.len() as u32 {
            let first = groups.of(face);
            of_face[face as usize] = if first == face {
                count += 1;
                count - 1
            } else {
                of_face[first as usize]
            };
        }
        Self { of_face, count: count as usize }
    }

    /// Six times the signed volume of each shell in cubic microns, and whether it is closed.
    ///
    /// What an open shell encloses depends on the point from which it is seen: it is the middle of its own box.
    pub(crate) fn volumes(&self, mesh: &TriangleMesh) -> Vec<(i128, bool)> {
        let mut open = vec![false; self.count];
        for edge in mesh.edges.iter().filter(|edge| edge.faces[1] == Edge::OPEN) {
            open[self.of_face[edge.faces[0] as usize] as usize] = true;
        }
        let mut boxes = vec![crate::tree::Box3::around([]); self.count];
        for (face, shell) in mesh.faces.iter().zip(&self.of_face) {
            boxes[*shell as usize].add(mesh.corners(face));
        }
        let mut volumes = vec![0i128; self.count];
        for (face, shell) in mesh.faces.iter().zip(&self.of_face) {
            let middle = boxes[*shell as usize].middle();
            let [a, b, c] = mesh.corners(face).map(|corner| {
                let corner = crate::tree::array(corner);
                [0, 1, 2].map(|axis| i128::from(corner[axis]) - i128::from(middle[axis]))
            });
            volumes[*shell as usize] += a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
        volumes.into_iter().zip(open).map(|(volume, open)| (volume, !open)).collect()
    }
}

/// Which edges lie where other edges lie too, because more than two faces meet there, and at how many places.
pub(crate) fn crowded_edges(mesh: &TriangleMesh) -> (Vec<bool>, usize) {
    let mut crowded = vec![false; mesh.edges.len()];
    let (mut places, mut start) = (0, 0);
    // The edges of one vertex lie together, those between the same two vertices not always.
    let mut order: Vec<(u32, u32)> = Vec::new();
    for edges in mesh.edges.chunk_by(|one, other| one.vertices[0] == other.vertices[0]) {
        order.clear();
        order.extend((start..).zip(edges).map(|(number, edge)| (edge.vertices[1], number)));
        order.sort_unstable();
        for group in order.chunk_by(|one, other| one.0 == other.0).filter(|group| group.len() > 1) {
            places += 1;
            group.iter().for_each(|(_, number)| crowded[*number as usize] = true);
        }
        start += edges.len() as u32;
    }
    (crowded, places)
}
