//! Everything worth knowing of a mesh before it is printed.

use crate::shells::{Shells, crowded_edges};
use crate::tree::{Box3, Tree};
use crate::{Overhang, Stand, crossings, orient, overhang, rims, stand, twins, walls};
use shape::{Bounds, Point3, TriangleMesh};

/// What a mesh is and what is wrong with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Its triangles.
    pub faces: usize,
    /// Its vertices, equal ones counted once.
    pub vertices: usize,
    /// The box around it.
    pub bounds: Bounds,
    /// The enclosed volume in mm³, negative when it is inside out; of an open mesh a guess.
    pub volume: f64,
    /// The surface in mm².
    pub area: f64,
    /// Pieces of surface that hang together.
    pub shells: usize,
    /// Shells that are inside out though they lie in no other.
    pub inside_out: usize,
    /// Edges with one face only.
    pub open_edges: usize,
    /// The loops that they form.
    pub holes: usize,
    /// Places where more than two faces meet in an edge.
    pub non_manifold_edges: usize,
    /// Faces that disagree with their neighbours about which side is out.
    pub flipped: usize,
    /// Whether a surface has one side only, like a Moebius strip.
    pub one_sided: bool,
    /// Faces between the same three vertices as another.
    pub duplicate: usize,
    /// Faces whose corners lie on a line.
    pub degenerate: usize,
    /// Pairs of faces that run through each other; [`Diagnosis::MOST_CROSSINGS`] and more are not counted.
    pub crossings: usize,
    /// The thinnest wall in microns and a spot in it, if there is a wall.
    pub thinnest_wall: Option<(f64, Point3)>,
    /// The most level underside above the bed.
    pub overhang: Option<Overhang>,
    /// Whether it stands.
    pub stand: Stand,
}

impl Diagnosis {
    /// More crossings than this are not counted.
    pub const MOST_CROSSINGS: usize = crossings::MOST;

    /// Whether the surface encloses a solid as it is, so that nothing needs repair.
    pub fn is_sound(&self) -> bool {
        self.open_edges == 0
            && self.non_manifold_edges == 0
            && self.flipped == 0
            && self.inside_out == 0
            && self.duplicate == 0
            && self.crossings == 0
            && !self.one_sided
    }
}

/// Examines a mesh. What lies less than `floor` microns over its lowest point touches the bed.
pub fn diagnose(mesh: &TriangleMesh, floor: i32) -> Diagnosis {
    let bounds = mesh.bounds();
    let floor = bounds.min.z.saturating_add(floor);
    let tree = Tree::new(mesh.faces.iter().map(|face| Box3::around(mesh.corners(face))));
    let turns = orient::agreed(mesh);
    let (_, inside_out) = orient::inside_out(mesh);
    let (_, non_manifold_edges) = crowded_edges(mesh);
    Diagnosis {
        faces: mesh.faces.len(),
        vertices: mesh.vertices.len(),
        bounds,
        volume: mesh.volume(),
        area: mesh.area(),
        shells: Shells::of(mesh).count,
        inside_out,
        open_edges: mesh.flaws.open,
        holes: rims::loops(&rims::open_sides(mesh)).len(),
        non_manifold_edges,
        flipped: turns.count,
        one_sided: turns.one_sided,
        duplicate: twins::needless(mesh).len(),
        degenerate: mesh.faces.iter().filter(|face| mesh.normal(face) == [0.0; 3]).count(),
        crossings: crossings::count(mesh, &tree),
        thinnest_wall: walls::thinnest(mesh, &tree),
        overhang: overhang::lowest(mesh, floor),
        stand: stand::of(mesh, floor),
    }
}
