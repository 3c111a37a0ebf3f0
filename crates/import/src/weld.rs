//! Corners become vertices: what lies in the same micron is the same point.
//!
//! The original keeps a dictionary from the printed text of a vertex to its index; here it is a table of indexes,
//! and the key is the vertex itself. A vertex has the index of its first occurrence in the file.

use crate::Unit;
use crate::error::{ImportError, Place};
use rayon::prelude::*;
use shape::{Point3, TriangleMesh};

/// The vertices so far and where to find them.
pub(crate) struct Welder {
    /// Every point once, in order of first occurrence.
    pub(crate) vertices: Vec<Point3>,
    /// One more than an index into the vertices, at the place its hash gives or the next free one after it. The bits
    /// that the index does not need hold a piece of the hash, so that a stranger is seldom fetched to be compared.
    slots: Vec<u32>,
    /// The number of slots as a power of two: so many top bits of a hash are its place.
    bits: u32,
}

const FREE: u32 = 0;
const NOBODY: u32 = u32::MAX;
/// How many corners are looked up together: enough fetches in flight to hide the way to memory, few enough for the
/// first-level cache.
pub(crate) const BATCH: usize = 96;
/// Work in pieces pays from this many facets in a piece.
pub(crate) const LEAST_WORK: usize = 16_384;

impl Welder {
    /// A table for the vertices of so many triangles; a closed mesh has half as many vertices.
    pub(crate) fn new(triangles: usize) -> Self {
        let bits = triangles.max(64).next_power_of_two().trailing_zeros();
        let vertices = Vec::with_capacity(triangles / 2 + triangles / 64);
        Self { vertices, slots: vec![FREE; 1 << bits], bits }
    }

    /// The index of a point, which is a new one when it was not met before.
    #[inline]
    pub(crate) fn index(&mut self, point: Point3) -> u32 {
        self.find(hash(point), point)
    }

    /// The indices of many points. First all hashes, then all first looks into the table, which do not wait for each
    /// other, then the comparisons.
    pub(crate) fn indices(&mut self, points: &[Point3], out: &mut [u32]) {
        let mut hashes = [0u64; BATCH];
        let mut looks = [FREE; BATCH];
        for (points, out) in points.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            for (point, hash) in points.iter().zip(&mut hashes) {
                *hash = self::hash(*point);
            }
            for (look, hash) in looks.iter_mut().zip(&hashes).take(points.len()) {
                *look = self.slots.get(self.place(*hash)).copied().unwrap_or(FREE);
            }
            for (((point, hash), look), out) in points.iter().zip(hashes).zip(looks).zip(out) {
                // Should the table grow meanwhile, a look at the old one finds another vertex or none at all.
                let mask = self.mask();
                let index = (look & mask).wrapping_sub(1);
                let alike = (look ^ hash as u32) & !mask == 0;
                let found = alike && self.vertices.get(index as usize) == Some(point);
                *out = if found { index } else { self.find(hash, *point) };
            }
        }
    }

    #[inline]
    fn place(&self, hash: u64) -> usize {
        (hash >> (64 - self.bits)) as usize
    }

    /// The bits of a slot that hold an index.
    #[inline]
    fn mask(&self) -> u32 {
        NOBODY.checked_shl(self.bits).map_or(NOBODY, |above| !above)
    }

    #[inline]
    fn find(&mut self, hash: u64, point: Point3) -> u32 {
        let mask = self.mask();
        let tag = (hash as u32) & !mask;
        let mut place = self.place(hash);
        loop {
            let Some(slot) = self.slots.get_mut(place) else {
                place = 0;
                continue;
            };
            if *slot == FREE {
                let index = self.vertices.len() as u32;
                *slot = tag | (index + 1);
                self.vertices.push(point);
                // Half full is the most at which a search stays short.
                if self.vertices.len() * 2 > self.slots.len() {
                    self.grow();
                }
                return index;
            }
            let index = (*slot & mask).wrapping_sub(1);
            if *slot & !mask == tag && self.vertices.get(index as usize) == Some(&point) {
                return index;
            }
            place += 1;
        }
    }

    #[cold]
    fn grow(&mut self) {
        self.bits += 1;
        // The old table goes before the new one comes.
        self.slots = Vec::new();
        self.slots = vec![FREE; 1 << self.bits];
        let mask = self.mask();
        for (number, point) in (1u32..).zip(&self.vertices) {
            let hash = hash(*point);
            let mut place = self.place(hash);
            while self.slots.get(place).is_none_or(|slot| *slot != FREE) {
                place = if place < self.slots.len() { place + 1 } else { 0 };
            }
            if let Some(slot) = self.slots.get_mut(place) {
                *slot = hash as u32 & !mask | number;
            }
        }
    }
}

/// One wide multiplication mixes all bits of all three, so that a grid of round numbers does not cluster.
#[inline]
fn hash(point: Point3) -> u64 {
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let one = u64::from(point.x as u32) | u64::from(point.y as u32) << 32;
    let two = u64::from(point.z as u32).wrapping_mul(GOLDEN);
    let product =
        u128::from(one ^ 0xa076_1d64_78bd_642f).wrapping_mul(u128::from(two ^ 0xe703_7ed1_a0b4_28db));
    (product as u64 ^ (product >> 64) as u64).wrapping_mul(GOLDEN)
}

/// Whether two corners are one point, so that the facet has no area.
#[inline]
pub(crate) fn collapsed([a, b, c]: [u32; 3]) -> bool {
    a == b || b == c || c == a
}

/// Facets by the indices of their corners, on their way to a mesh.
pub(crate) struct Facets {
    /// Every point once.
    pub(crate) vertices: Vec<Point3>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Facets {
    /// Welds the vertices of a file that numbers them itself: what lies in the same micron is one.
    ///
    /// Every corner must be the index of a vertex.
    pub(crate) fn welded(vertices: &[Point3], mut triangles: Vec<[u32; 3]>) -> Self {
        let mut welder = Welder::new(vertices.len());
        let mut indices = vec![0; vertices.len()];
        welder.indices(vertices, &mut indices);
        triangles.par_chunks_mut(LEAST_WORK).for_each(|triangles| {
            for vertex in triangles.as_flattened_mut() {
                *vertex = indices.get(*vertex as usize).copied().unwrap_or_default();
            }
        });
        Self { vertices: welder.vertices, triangles }
    }

    /// The mesh without the facets that collapse, and how many these are. Vertices are numbered by their first use and
    /// those that nobody uses are left out: they would count in the bounds.
    ///
    /// # Errors
    /// When there is no facet, or none has an area.
    pub(crate) fn mesh(self, unit: Unit) -> Result<(TriangleMesh, usize), ImportError> {
        let Self { vertices, mut triangles } = self;
        let facets = triangles.len();
        if facets == 0 {
            return Err(ImportError::no_facets(Place::File));
        }
        triangles.retain(|triangle| !collapsed(*triangle));
        let vertices = renumbered(vertices, &mut triangles);
        if !triangles.iter().any(|triangle| has_area(&vertices, triangle)) {
            return Err(ImportError::no_area(facets, unit));
        }
        let degenerate = facets - triangles.len();
        Ok((TriangleMesh::from_triangles(vertices, triangles), degenerate))
    }
}

/// The vertices in the order of their first use. Where they are in it already, nothing moves.
fn renumbered(vertices: Vec<Point3>, triangles: &mut [[u32; 3]]) -> Vec<Point3> {
    let mut most = 0;
    let in_order = triangles.as_flattened().iter().all(|vertex| {
        let next = *vertex <= most;
        most = most.max(vertex.saturating_add(1));
        next
    });
    if in_order && most as usize == vertices.len() {
        return vertices;
    }
    let mut indices = vec![NOBODY; vertices.len()];
    let mut used = Vec::with_capacity(vertices.len());
    for vertex in triangles.as_flattened_mut() {
        let (Some(index), Some(point)) = (indices.get_mut(*vertex as usize), vertices.get(*vertex as usize))
        else {
            continue;
        };
        if *index == NOBODY {
            *index = used.len() as u32;
            used.push(*point);
        }
        *vertex = *index;
    }
    used
}

/// Whether a triangle is more than a line.
fn has_area(vertices: &[Point3], triangle: &[u32; 3]) -> bool {
    let [Some(a), Some(b), Some(c)] = triangle.map(|vertex| vertices.get(vertex as usize)) else {
        return false;
    };
    let [[b_x, b_y, b_z], [c_x, c_y, c_z]] = [b, c].map(|to| {
        [(a.x, to.x), (a.y, to.y), (a.z, to.z)].map(|(from, to)| i128::from(to) - i128::from(from))
    });
    [b_y * c_z - b_z * c_y, b_z * c_x - b_x * c_z, b_x * c_y - b_y * c_x] != [0; 3]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slow and obvious welder.
    fn expected(points: &[Point3]) -> Vec<u32> {
        let mut seen = std::collections::HashMap::new();
        points
            .iter()
            .map(|point| {
                let next = seen.len() as u32;
                *seen.entry(*point).or_insert(next)
            })
            .collect()
    }

    #[test]
    fn one_by_one_and_in_batches_give_the_same_through_all_growth() {
        let points: Vec<Point3> = (0..5000i32)
            .map(|i| Point3 { x: (i * 37 % 1409) * 1000, y: i % 11 * 500, z: -(i * 7 % 90) })
            .collect();
        let (mut single, mut batched) = (Welder::new(0), Welder::new(0));
        let one_by_one: Vec<u32> = points.iter().map(|point| single.index(*point)).collect();
        let mut in_batches = vec![0; points.len()];
        batched.indices(&points, &mut in_batches);
        assert_eq!(one_by_one, expected(&points));
        assert_eq!(in_batches, one_by_one);
        assert_eq!(single.vertices, batched.vertices);
    }
}
