/// A point in space, in microns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Point3 {
    /// Microns along x.
    pub x: i32,
    /// Microns along y.
    pub y: i32,
    /// Microns upwards.
    pub z: i32,
}

/// A triangle of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// Indices into [`TriangleMesh::vertices`], counter-clockwise seen from outside.
    pub vertices: [u32; 3],
    /// Indices into [`TriangleMesh::edges`]: edge `i` joins vertices `i` and `i + 1`.
    pub edges: [u32; 3],
}

/// A side of one face or the common side of two.
///
/// Where more than two faces meet in one line, they are paired by opposite direction in file order and each pair
/// has an edge of its own, so that an edge never joins more than two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// The two ends, the smaller index first.
    pub vertices: [u32; 2],
    /// The faces; the second is [`Edge::OPEN`] where the surface has a rim.
    pub faces: [u32; 2],
}

impl Edge {
    /// No face on this side: the edge of a hole.
    pub const OPEN: u32 = u32::MAX;

    /// The face on the other side of the edge, if there is one.
    #[inline]
    pub fn across(&self, face: u32) -> Option<u32> {
        let other = if self.faces[0] == face { self.faces[1] } else { self.faces[0] };
        (other != Self::OPEN).then_some(other)
    }
}

/// A part as triangles: every vertex once, every edge with its faces.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TriangleMesh {
    /// Every corner once.
    pub vertices: Vec<Point3>,
    /// The triangles, in file order.
    pub faces: Vec<Face>,
    /// Every side once.
    pub edges: Vec<Edge>,
    /// What was wrong with the sides when they were paired.
    pub flaws: Flaws,
}

/// What is wrong with the edges of a mesh: found while they are made, at no cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flaws {
    /// Edges with one face only.
    pub open: usize,
    /// Edges whose two faces run the same way along them, because one is turned over.
    pub alike: usize,
}

impl Flaws {
    /// Whether every edge has two faces that agree which side is out.
    pub fn none(&self) -> bool {
        *self == Self::default()
    }
}

/// The box around a part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bounds {
    /// Least x, y, z.
    pub min: Point3,
    /// Greatest x, y, z.
    pub max: Point3,
}
