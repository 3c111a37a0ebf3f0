//! Cross-sections of a mesh at many heights.
//!
//! Every face is looked at once and filed under the planes that cross it; a plane's section is then walked from face
//! to face across their common edges. Nothing is matched by position, so cracks are not papered over and near
//! misses do not meet.
//!
//! A vertex on a plane counts as above it. This is the seed's search for a free zone around the plane with the zone
//! interval shrunk to nothing: coordinates are whole microns, so just below the plane there is never a vertex. The
//! outline then runs through the vertex itself, and a level face on the plane belongs to what is above.

use super::{Edge, Face, Point3, TriangleMesh};
use crate::Point;
use rayon::prelude::*;

/// A mesh with its faces filed under rising planes.
pub struct Sections<'a> {
    mesh: &'a TriangleMesh,
    planes: &'a [i32],
    /// Where each plane's faces begin in `faces`; one more than there are planes.
    starts: Vec<usize>,
    /// The faces that cross each plane, in file order.
    faces: Vec<u32>,
}

/// A piece of a section, with the clay on its left where the face it starts in says so.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chain {
    /// The points; a closed chain does not repeat its first.
    pub points: Vec<Point>,
    /// Whether it came back to its start. An open chain ends at open edges of the mesh.
    pub closed: bool,
}

impl<'a> Sections<'a> {
    /// Files the faces under the planes, which rise.
    pub fn new(mesh: &'a TriangleMesh, planes: &'a [i32]) -> Self {
        let mut starts = vec![0usize; planes.len() + 1];
        let index = PlaneIndex::new(planes);
        // Side by side, and laid end to end in file order.
        let pieces: Vec<Vec<(u32, u32, u32)>> = mesh
            .faces
            .par_chunks(PIECE)
            .enumerate()
            .map(|(piece, faces)| {
                let first = (piece * PIECE) as u32;
                let spans = faces.iter().zip(first..).filter_map(|(face, number)| {
                    let [a, b, c] = face.vertices.map(|vertex| mesh.vertices[vertex as usize].z);
                    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
                    let (from, to) = (index.up_to(low), index.up_to(high));
                    (from < to).then_some((number, from as u32, to as u32))
                });
                spans.collect()
            })
            .collect();
        let spans: Vec<(u32, u32, u32)> = pieces.concat();
        for &(_, from, to) in &spans {
            for plane in from..to {
                starts[plane as usize + 1] += 1;
            }
        }
        for plane in 0..planes.len() {
            starts[plane + 1] += starts[plane];
        }
        let mut next = starts.clone();
        let mut faces = vec![0u32; starts[planes.len()]];
        for &(face, from, to) in &spans {
            for plane in from..to {
                faces[next[plane as usize]] = face;
                next[plane as usize] += 1;
            }
        }
        Self { mesh, planes, starts, faces }
    }

    /// The section at a plane.
    pub fn at(&self, plane: usize) -> Vec<Chain> {
        let faces = &self.faces[self.starts[plane]..self.starts[plane + 1]];
        let mut walk = Walk { mesh: self.mesh, z: self.planes[plane], faces, seen: vec![false; faces.len()] };
        let mut chains = Vec::new();
        for start in 0..faces.len() {
            if !walk.seen[start] {
                walk.seen[start] = true;
                chains.push(walk.chain(start));
            }
        }
        chains
    }
}

/// How many planes lie at or below a height, without a search where the planes are evenly spaced.
struct PlaneIndex<'a> {
    planes: &'a [i32],
    step: f64,
}

impl<'a> PlaneIndex<'a> {
    fn new(planes: &'a [i32]) -> Self {
        let step = match planes {
            [first, .., last] => (f64::from(*last) - f64::from(*first)) / (planes.len() - 1) as f64,
            _ => 1.0,
        };
        Self { planes, step: step.max(1.0) }
    }

    fn up_to(&self, z: i32) -> usize {
        let Some(first) = self.planes.first() else { return 0 };
        let guess = (f64::from(z) - f64::from(*first)) / self.step + 1.0;
        let mut count = (guess.max(0.0) as usize).min(self.planes.len());
        while count > 0 && self.planes[count - 1] > z {
            count -= 1;
        }
        while count < self.planes.len() && self.planes[count] <= z {
            count += 1;
        }
        count
    }
}

/// One plane being walked.
struct Walk<'a> {
    mesh: &'a TriangleMesh,
    z: i32,
    faces: &'a [u32],
    seen: Vec<bool>,
}

impl Walk<'_> {
    /// The chain through a face: forwards until it closes or ends, then backwards from the start.
    fn chain(&mut self, start: usize) -> Chain {
        let face = self.faces[start];
        let (enter, leave) = self.crossed_edges(&self.mesh.faces[face as usize]);
        let mut points = Vec::with_capacity(self.faces.len() - start);
        points.push(self.cut(enter));
        if self.follow(face, leave, enter, &mut points) {
            return Chain { points, closed: true };
        }
        let mut behind = Vec::new();
        self.follow(face, enter, leave, &mut behind);
        // The first of `behind` is the point that `points` already starts with.
        behind.reverse();
        behind.pop();
        behind.append(&mut points);
        Chain { points: behind, closed: false }
    }

    /// Goes on across an edge of a face from face to face; `true` when it comes back to the edge it started from.
    fn follow(&mut self, mut face: u32, mut edge: u32, goal: u32, points: &mut Vec<Point>) -> bool {
        loop {
            if edge == goal {
                return true;
            }
            points.push(self.cut(edge));
            let Some(next) = self.mesh.edges[edge as usize].across(face) else { return false };
            // The faces are in file order, so a binary search finds this one's place.
            let Ok(place) = self.faces.binary_search(&next) else { return false };
            let (one, other) = self.crossed_edges(&self.mesh.faces[next as usize]);
            edge = if one == edge { other } else { one };
            if self.seen[place] {
                return edge == goal || one == goal || other == goal;
            }
            self.seen[place] = true;
            face = next;
        }
    }

    /// The edge where the outline enters a face and the one where it leaves, with the clay on the left.
    ///
    /// Seen from outside, the corners run counter-clockwise and the clay lies behind; so one walks from the edge
    /// that comes down through the plane to the one that goes up.
    fn crossed_edges(&self, face: &Face) -> (u32, u32) {
        let above = face.vertices.map(|vertex| self.mesh.vertices[vertex as usize].z >= self.z);
        let (mut down, mut up) = (0, 0);
        for side in 0..3 {
            match (above[side], above[(side + 1) % 3]) {
                (true, false) => down = face.edges[side],
                (false, true) => up = face.edges[side],
                _ => {}
            }
        }
        (down, up)
    }

    /// Where an edge meets the plane. The ends are taken in the edge's own order, so both its faces get one answer.
    fn cut(&self, edge: u32) -> Point {
        let Edge { vertices: [a, b], .. } = self.mesh.edges[edge as usize];
        let (a, b) = (self.mesh.vertices[a as usize], self.mesh.vertices[b as usize]);
        let (rise, part) = (i64::from(b.z) - i64::from(a.z), i64::from(self.z) - i64::from(a.z));
        let at = |from: i32, to: i32| {
            // Heights and lengths are below 2·10⁹, their product fits; halves are rounded up.
            let product = (i64::from(to) - i64::from(from)) * part;
            let (product, rise) = if rise < 0 { (-product, -rise) } else { (product, rise) };
            (i64::from(from) + (2 * product + rise).div_euclid(2 * rise)) as i32
        };
        Point::new(at(a.x, b.x), at(a.y, b.y))
    }
}

/// Which planes have a nearly level underside of the part in the room just below them: only there can an outline jump
/// outwards from one plane to the next by more than `slope` times the distance between them.
pub fn planes_over_undersides(mesh: &TriangleMesh, planes: &[i32], slope: f64) -> Vec<bool> {
    let index = PlaneIndex::new(planes);
    let Some(origin) = mesh.vertices.first() else { return vec![false; planes.len()] };
    // For each piece of the mesh its share of the volume, and the planes over faces that look down and up.
    type Spans = Vec<(u32, u32)>;
    let pieces: Vec<(f64, [Spans; 2])> = mesh
        .faces
        .par_chunks(PIECE)
        .map(|faces| {
            let mut volume = 0.0;
            let mut spans = [Vec::new(), Vec::new()];
            for face in faces {
                let [a, b, c] = mesh.corners(face);
                let from_a = |to: Point3| [to.x - a.x, to.y - a.y, to.z - a.z].map(f64::from);
                let (u, v) = (from_a(b), from_a(c));
                let (x, y, z) =
                    (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
                volume += z * (f64::from(a.z) + f64::from(b.z) + f64::from(c.z) - 3.0 * f64::from(origin.z));
                if (x * x + y * y) * slope * slope <= z * z && z != 0.0 {
                    let low = index.up_to(a.z.min(b.z).min(c.z).saturating_sub(1));
                    let high = (index.up_to(a.z.max(b.z).max(c.z)) + 1).min(planes.len());
                    if low < high {
                        spans[usize::from(z > 0.0)].push((low as u32, high as u32));
                    }
                }
            }
            (volume, spans)
        })
        .collect();
    // A part whose triangles are inside out has its undersides where they look up.
    let volume: f64 = pieces.iter().map(|(volume, _)| volume).sum();
    let side = usize::from(volume < 0.0);
    let mut level = vec![false; planes.len()];
    for &(low, high) in pieces.iter().flat_map(|(_, spans)| &spans[side]) {
        level[low as usize..high as usize].fill(true);
    }
    level
}

/// How many faces are looked at in one go: the same for any number of threads, since sums of floats depend on it.
const PIECE: usize = 16_384;
