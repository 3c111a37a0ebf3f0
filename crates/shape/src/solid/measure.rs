//! Size, volume and surface of a mesh.

use super::{Bounds, Face, Point3, TriangleMesh};
use rayon::prelude::*;

impl TriangleMesh {
    /// The box around all vertices; a point at the origin when there are none.
    pub fn bounds(&self) -> Bounds {
        let join = |one: Bounds, two: Bounds| Bounds {
            min: Point3 {
                x: one.min.x.min(two.min.x),
                y: one.min.y.min(two.min.y),
                z: one.min.z.min(two.min.z),
            },
            max: Point3 {
                x: one.max.x.max(two.max.x),
                y: one.max.y.max(two.max.y),
                z: one.max.z.max(two.max.z),
            },
        };
        let points = self
            .vertices
            .par_iter()
            .with_min_len(LEAST_WORK)
            .map(|point| Bounds { min: *point, max: *point });
        points.reduce_with(join).unwrap_or_default()
    }

    /// The enclosed volume in cubic millimetres: exact sums, rounded once.
    ///
    /// Negative when the surface is inside out. An open surface is closed towards the least corner of its box, so that
    /// neither the place of a part nor the order of its triangles matters.
    pub fn volume(&self) -> f64 {
        let origin = self.bounds().min;
        let six_fold: i128 = self
            .faces
            .par_iter()
            .with_min_len(LEAST_WORK)
            .map(|face| {
                let [a, [b_x, b_y, b_z], [c_x, c_y, c_z]] =
                    self.corners(face).map(|corner| from(origin, corner));
                let cross = [b_y * c_z - b_z * c_y, b_z * c_x - b_x * c_z, b_x * c_y - b_y * c_x];
                a.into_iter().zip(cross).map(|(a, cross)| a * cross).sum::<i128>()
            })
            .sum();
        six_fold as f64 / 6e9
    }

    /// The surface in square millimetres.
    pub fn area(&self) -> f64 {
        // Sums of floats depend on their order, so the pieces are the same for any number of threads.
        let pieces: Vec<f64> = self
            .faces
            .par_chunks(LEAST_WORK)
            .map(|faces| {
                faces
                    .iter()
                    .map(|face| self.normal(face).map(|length| length * length).iter().sum::<f64>().sqrt())
                    .sum()
            })
            .collect();
        pieces.iter().sum::<f64>() / 2e6
    }

    /// How many edges belong to one face only; zero for a closed surface.
    pub fn open_edges(&self) -> usize {
        self.flaws.open
    }

    /// Moves the part. A part within `unit::Micron::LIMIT` can be moved by as much in each direction.
    pub fn translate(&mut self, by: Point3) {
        for vertex in &mut self.vertices {
            *vertex = Point3 { x: vertex.x + by.x, y: vertex.y + by.y, z: vertex.z + by.z };
        }
    }

    /// The three corners of a face.
    pub fn corners(&self, face: &Face) -> [Point3; 3] {
        face.vertices.map(|vertex| self.vertices[vertex as usize])
    }

    /// The outward normal of a face, as long as twice its area in square microns. Zero only when it has no area.
    pub fn normal(&self, face: &Face) -> [f64; 3] {
        let [a, b, c] = self.corners(face);
        let ([b_x, b_y, b_z], [c_x, c_y, c_z]) = (from(a, b), from(a, c));
        [b_y * c_z - b_z * c_y, b_z * c_x - b_x * c_z, b_x * c_y - b_y * c_x].map(|length| length as f64)
    }
}

/// How much one thread takes at a time.
const LEAST_WORK: usize = 16_384;

/// Wide enough for a product of three lengths.
fn from(origin: Point3, point: Point3) -> [i128; 3] {
    [(origin.x, point.x), (origin.y, point.y), (origin.z, point.z)]
        .map(|(from, to)| i128::from(to) - i128::from(from))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box with a corner at the origin, two triangles a side.
    fn cuboid(x: i32, y: i32, z: i32) -> TriangleMesh {
        let vertices = (0..8)
            .map(|bits| Point3 { x: x * (bits & 1), y: y * (bits >> 1 & 1), z: z * (bits >> 2) })
            .collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
        let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        TriangleMesh::from_triangles(vertices, triangles)
    }

    #[test]
    fn a_cube_is_closed_and_has_its_size() {
        let cube = cuboid(10_000, 10_000, 10_000);
        assert_eq!((cube.vertices.len(), cube.edges.len(), cube.faces.len()), (8, 18, 12));
        assert_eq!(cube.open_edges(), 0);
        assert_eq!((cube.volume(), cube.area()), (1000.0, 600.0));
        assert_eq!(
            cube.bounds(),
            Bounds { min: Point3::default(), max: Point3 { x: 10_000, y: 10_000, z: 10_000 } }
        );
    }

    #[test]
    fn moving_changes_the_place_and_nothing_else() {
        let mut moved = cuboid(20_000, 10_000, 5_000);
        moved.translate(Point3 { x: 900_000_000, y: -900_000_000, z: 1 });
        assert_eq!((moved.volume(), moved.area()), (1000.0, 700.0));
        assert_eq!(moved.bounds().min, Point3 { x: 900_000_000, y: -900_000_000, z: 1 });
    }

    #[test]
    fn inside_out_is_less_than_nothing() {
        let cube = cuboid(1000, 1000, 1000);
        let flipped =
            cube.faces.iter().map(|face| [face.vertices[0], face.vertices[2], face.vertices[1]]).collect();
        assert_eq!(TriangleMesh::from_triangles(cube.vertices, flipped).volume(), -1.0);
    }

    #[test]
    fn the_largest_part_does_not_overflow() {
        let mut large = cuboid(2_000_000_000, 2_000_000_000, 2_000_000_000);
        large.translate(Point3 { x: -1_000_000_000, y: -1_000_000_000, z: -1_000_000_000 });
        assert!((large.volume() / 8e18 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn nothing_has_no_size() {
        let nothing = TriangleMesh::default();
        assert_eq!((nothing.bounds(), nothing.volume(), nothing.area()), (Bounds::default(), 0.0, 0.0));
    }
}
