//! From triangles to edges: which face lies across which side.
//!
//! Every side of every triangle is filed under its smaller vertex by a counting sort; what belongs together then
//! lies in one short bucket and is paired there. The vertices are shared out among the threads in ranges, and no
//! bucket is seen by two of them, so that the result cannot depend on how many there are.

use super::{Edge, Face, Flaws, Point3, TriangleMesh};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

impl TriangleMesh {
    /// The most triangles a mesh may have: a side is known by a 32-bit number, and each triangle has three.
    pub const MOST_TRIANGLES: usize = u32::MAX as usize / 6;

    /// Finds the edges of triangles.
    ///
    /// Sides between the same two vertices are paired, first those of opposite direction in the order of the
    /// triangles, as neighbours on a well made surface are; then, where only one direction is left because a
    /// neighbour is flipped, those of the same direction. What finds no partner is an open edge. Edges are ordered by
    /// their smaller vertex, and those of one vertex by the first side they have in the order of the triangles.
    ///
    /// The three vertices of a triangle must differ.
    ///
    /// # Panics
    ///
    /// When a triangle names a vertex that does not exist, or beyond [`TriangleMesh::MOST_TRIANGLES`].
    ///
    /// ```
    /// use shape::{Point3, TriangleMesh};
    ///
    /// let corners = [[0, 0, 0], [1000, 0, 0], [0, 1000, 0], [0, 0, 1000]];
    /// let vertices = corners.map(|[x, y, z]| Point3 { x, y, z }).to_vec();
    /// let mesh = TriangleMesh::from_triangles(vertices, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
    /// assert_eq!((mesh.edges.len(), mesh.open_edges()), (6, 0));
    /// ```
    pub fn from_triangles(vertices: Vec<Point3>, triangles: Vec<[u32; 3]>) -> Self {
        let parts =
            if triangles.len() < PARALLEL_FROM { 1 } else { rayon::current_num_threads().min(MOST_PARTS) };
        Self::from_triangles_in(vertices, triangles, parts)
    }

    fn from_triangles_in(vertices: Vec<Point3>, triangles: Vec<[u32; 3]>, parts: usize) -> Self {
        assert!(triangles.len() <= Self::MOST_TRIANGLES, "more triangles than a mesh may have");
        let most = triangles.par_iter().map(|[a, b, c]| *a.max(b).max(c)).max();
        assert!(most.is_none_or(|most| (most as usize) < vertices.len()), "a triangle without its vertex");

        // First the room each bucket needs, then the buckets, then the edges: each step tells how much the next
        // has to hold.
        let width = vertices.len().div_ceil(parts).max(1);
        let mut ends = vec![0u32; vertices.len()];
        let side_counts: Vec<usize> = ends
            .par_chunks_mut(width)
            .enumerate()
            .map(|(part, ends)| count(&triangles, first(part, width), ends))
            .collect();

        let mut sides = vec![0u64; triangles.len() * 3];
        let paired: Vec<Paired> = ends
            .par_chunks_mut(width)
            .zip(shares(&mut sides, &side_counts))
            .enumerate()
            .map(|(part, (ends, sides))| {
                file(&triangles, first(part, width), ends, sides);
                buckets(ends, sides).map(|(_, bucket)| pair(bucket)).fold(Paired::default(), Paired::plus)
            })
            .collect();

        let edge_counts: Vec<usize> = paired.iter().map(|paired| paired.edges).collect();
        let whole = paired.into_iter().fold(Paired::default(), Paired::plus);
        let total = whole.edges;
        // Each edge has one side or two.
        let flaws = Flaws { open: 2 * total - triangles.len() * 3, alike: whole.alike };
        let mut edges: Vec<Edge> = (0..total).into_par_iter().map(|_| UNKNOWN).collect();
        let edge_of: Vec<[AtomicU32; 3]> =
            (0..triangles.len()).into_par_iter().map(|_| Default::default()).collect();
        let offsets: Vec<usize> = edge_counts
            .iter()
            .scan(0, |sum, count| {
                let offset = *sum;
                *sum += count;
                Some(offset)
            })
            .collect();
        ends.par_chunks_mut(width)
            .zip(shares(&mut sides, &side_counts))
            .zip(shares(&mut edges, &edge_counts))
            .zip(offsets)
            .enumerate()
            .for_each(|(part, (((ends, sides), edges), offset))| {
                join(first(part, width), ends, sides, edges, offset as u32, &edge_of);
            });
        drop((sides, ends));

        let faces = triangles
            .into_par_iter()
            .zip(&edge_of)
            .map(|(vertices, edges)| {
                let [a, b, c] = edges;
                Face { vertices, edges: [a.load(Relaxed), b.load(Relaxed), c.load(Relaxed)] }
            })
            .collect();
        Self { vertices, faces, edges, flaws }
    }
}

/// What pairing found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Paired {
    edges: usize,
    /// Pairs of sides that run the same way.
    alike: usize,
}

impl Paired {
    fn plus(self, other: Self) -> Self {
        Self { edges: self.edges + other.edges, alike: self.alike + other.alike }
    }
}

/// Below this one thread is done before a second has woken up.
const PARALLEL_FROM: usize = 20_000;
/// Each part reads all triangles and keeps its own; with many parts the reading is all there is.
const MOST_PARTS: usize = 8;
/// Buckets are rarely longer than six; from here on sorting beats searching.
const LONG_BUCKET: usize = 24;
const UNKNOWN: Edge = Edge { vertices: [0; 2], faces: [Edge::OPEN; 2] };

/// Set in a filed side that runs from the larger vertex to the smaller; after pairing, in the second of a pair.
const FLAG: u64 = 1 << 32;

/// A side as it is filed: the larger vertex, the flag, and the corner it starts from, so that filed sides of one
/// bucket sort by vertex, direction and order of the triangles.
#[inline]
fn filed(larger: u32, downwards: bool, corner: u32) -> u64 {
    u64::from(larger) << 33 | u64::from(downwards) << 32 | u64::from(corner)
}

#[inline]
fn corner(side: u64) -> u32 {
    side as u32
}

fn first(part: usize, width: usize) -> u32 {
    (part * width) as u32
}

/// Splits a slice into consecutive shares, one for each part.
fn shares<'a, T: Send>(mut rest: &'a mut [T], counts: &[usize]) -> Vec<&'a mut [T]> {
    let mut shares = Vec::with_capacity(counts.len());
    for count in counts {
        let (share, tail) = rest.split_at_mut(*count);
        shares.push(share);
        rest = tail;
    }
    shares
}

/// Leaves in `starts` where the bucket of each vertex from `first` on begins; returns the length of all of them.
fn count(triangles: &[[u32; 3]], first: u32, starts: &mut [u32]) -> usize {
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            // What is not ours wraps around or lies beyond the end.
            if let Some(count) = starts.get_mut((*from.min(to)).wrapping_sub(first) as usize) {
                *count += 1;
            }
        }
    }
    let mut sum = 0;
    for start in starts {
        sum += std::mem::replace(start, sum);
    }
    sum as usize
}

/// Puts each side into its bucket, in the order of the triangles, and turns the starts of the buckets into ends.
fn file(triangles: &[[u32; 3]], first: u32, starts: &mut [u32], sides: &mut [u64]) {
    let mut at = 0;
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if let Some(next) = starts.get_mut((*from.min(to)).wrapping_sub(first) as usize) {
                sides[*next as usize] = filed(*from.max(to), from > to, at);
                *next += 1;
            }
            at += 1;
        }
    }
}

/// The buckets by the position of their vertex.
fn buckets<'a>(ends: &'a [u32], sides: &'a mut [u64]) -> impl Iterator<Item = (usize, &'a mut [u64])> {
    let mut rest = sides;
    let mut start = 0;
    ends.iter().enumerate().map(move |(index, end)| {
        let (bucket, tail) = std::mem::take(&mut rest).split_at_mut((end - start) as usize);
        (rest, start) = (tail, *end);
        (index, bucket)
    })
}

/// Puts what belongs together side by side, the second of each pair flagged.
fn pair(bucket: &mut [u64]) -> Paired {
    if bucket.len() > LONG_BUCKET {
        return pair_long(bucket);
    }
    let (mut edges, mut alike) = (0, 0);
    let mut rest = bucket;
    while let Some((side, others)) = rest.split_first_mut() {
        let key = *side >> 32;
        let find = |wanted: u64| others.iter().position(|other| other >> 32 == wanted);
        let mate = match find(key ^ 1) {
            None => {
                let mate = find(key);
                alike += usize::from(mate.is_some());
                mate
            }
            mate => mate,
        };
        *side &= !FLAG;
        edges += 1;
        let paired = if let Some(mate) = mate {
            let moved = others[mate] | FLAG;
            for index in (0..mate).rev() {
                others[index + 1] = others[index];
            }
            others[0] = moved;
            1
        } else {
            0
        };
        rest = &mut others[paired..];
    }
    Paired { edges, alike }
}

/// The same for the hub of a large fan, where searching would cost the square of its size.
fn pair_long(bucket: &mut [u64]) -> Paired {
    let mut alike = 0;
    let mut edges: Vec<(u64, Option<u64>)> = Vec::with_capacity(bucket.len() / 2 + 1);
    bucket.sort_unstable();
    for sides in bucket.chunk_by(|one, two| one >> 33 == two >> 33) {
        let (up, down) = sides.split_at(sides.partition_point(|side| side & FLAG == 0));
        let both = up.len().min(down.len());
        alike += (up.len() - both) / 2 + (down.len() - both) / 2;
        edges.extend(up.iter().zip(down).map(|(one, two)| {
            if corner(*one) < corner(*two) { (*one, Some(*two)) } else { (*two, Some(*one)) }
        }));
        edges.extend(
            up[both..]
                .chunks(2)
                .chain(down[both..].chunks(2))
                .map(|flipped| (flipped[0], flipped.get(1).copied())),
        );
    }
    edges.sort_unstable_by_key(|(side, _)| corner(*side));
    let paired = edges.iter().flat_map(|(one, two)| [Some(one & !FLAG), two.map(|two| two | FLAG)]).flatten();
    for (slot, side) in bucket.iter_mut().zip(paired) {
        *slot = side;
    }
    Paired { edges: edges.len(), alike }
}

/// Writes the edges and tells the triangles their numbers.
fn join(
    first: u32,
    ends: &[u32],
    sides: &mut [u64],
    edges: &mut [Edge],
    offset: u32,
    edge_of: &[[AtomicU32; 3]],
) {
    let mut next = 0;
    for (index, bucket) in buckets(ends, sides) {
        for side in bucket {
            let (face, turn) = (corner(*side) / 3, corner(*side) % 3);
            if *side & FLAG == 0 {
                edges[next] = Edge {
                    vertices: [first + index as u32, (*side >> 33) as u32],
                    faces: [face, Edge::OPEN],
                };
                next += 1;
            } else {
                edges[next - 1].faces[1] = face;
            }
            // Plain stores: nobody else writes here, and the end of the parallel step is the fence.
            edge_of[face as usize][turn as usize].store(offset + next as u32 - 1, Relaxed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn points(count: i32) -> Vec<Point3> {
        (0..count).map(|index| Point3 { x: index, y: index % 7, z: index % 3 }).collect()
    }

    fn mesh(count: i32, triangles: &[[u32; 3]]) -> TriangleMesh {
        let mesh = TriangleMesh::from_triangles(points(count), triangles.to_vec());
        assert_lawful(&mesh);
        mesh
    }

    /// What holds for any mesh: faces and edges name each other, and the order is the documented one.
    fn assert_lawful(mesh: &TriangleMesh) {
        for (index, face) in mesh.faces.iter().enumerate() {
            for turn in 0..3 {
                let mut ends = [face.vertices[turn], face.vertices[(turn + 1) % 3]];
                ends.sort_unstable();
                let edge = mesh.edges[face.edges[turn] as usize];
                assert_eq!(edge.vertices, ends);
                assert!(edge.faces.contains(&(index as u32)));
            }
        }
        let named: usize = mesh.edges.iter().map(|edge| 1 + usize::from(edge.faces[1] != Edge::OPEN)).sum();
        assert_eq!(named, mesh.faces.len() * 3);
        assert!(mesh.edges.is_sorted_by_key(|edge| edge.vertices[0]));
        assert!(mesh.edges.iter().all(|edge| edge.faces[0] <= edge.faces[1]));
        let open = mesh.edges.iter().filter(|edge| edge.faces[1] == Edge::OPEN).count();
        let alike = mesh.edges.iter().filter(|edge| runs_alike(mesh, edge)).count();
        assert_eq!(mesh.flaws, Flaws { open, alike });
    }

    fn runs_alike(mesh: &TriangleMesh, edge: &Edge) -> bool {
        let [a, b] = edge.vertices;
        let runs = |face: u32| {
            let corners = mesh.faces[face as usize].vertices;
            (0..3).any(|turn| corners[turn] == a && corners[(turn + 1) % 3] == b)
        };
        edge.faces[1] != Edge::OPEN && runs(edge.faces[0]) == runs(edge.faces[1])
    }

    const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

    #[test]
    fn a_tetrahedron_is_closed() {
        let mesh = mesh(4, &TETRAHEDRON);
        assert_eq!((mesh.edges.len(), mesh.open_edges()), (6, 0));
        assert_eq!(mesh.vertices.len() + mesh.faces.len() - mesh.edges.len(), 2);
    }

    #[test]
    fn a_missing_face_leaves_three_open_edges() {
        let mesh = mesh(4, &TETRAHEDRON[1..]);
        assert_eq!((mesh.edges.len(), mesh.open_edges()), (6, 3));
    }

    #[test]
    fn a_flipped_face_still_has_its_neighbours() {
        let mut triangles = TETRAHEDRON;
        triangles[2].swap(0, 1);
        let mesh = mesh(4, &triangles);
        assert_eq!((mesh.edges.len(), mesh.open_edges()), (6, 0));
    }

    /// Two tetrahedra that touch along 0–1: each keeps a surface of its own.
    #[test]
    fn where_four_faces_meet_there_are_two_edges() {
        let other = TETRAHEDRON.map(|face| face.map(|vertex| if vertex < 2 { vertex } else { vertex + 2 }));
        let mesh = mesh(6, &[TETRAHEDRON, other].concat());
        assert_eq!((mesh.edges.len(), mesh.open_edges()), (12, 0));
        let shared: Vec<_> =
            mesh.edges.iter().filter(|edge| edge.vertices == [0, 1]).map(|edge| edge.faces).collect();
        assert_eq!(shared, [[0, 1], [4, 5]]);
    }

    #[test]
    fn three_faces_on_one_line_leave_one_open() {
        let mesh = mesh(5, &[[0, 1, 2], [0, 1, 3], [1, 0, 4]]);
        let shared: Vec<_> =
            mesh.edges.iter().filter(|edge| edge.vertices == [0, 1]).map(|edge| edge.faces).collect();
        assert_eq!(shared, [[0, 2], [1, Edge::OPEN]]);
    }

    #[test]
    fn nothing_has_no_edges() {
        assert_eq!(TriangleMesh::from_triangles(Vec::new(), Vec::new()), TriangleMesh::default());
    }

    #[test]
    fn a_fan_takes_no_longer_than_its_size() {
        let count = 60_000;
        let triangles: Vec<_> = (1..count).map(|index| [0, index, index % (count - 1) + 1]).collect();
        let mesh = mesh(count as i32, &triangles);
        assert_eq!(mesh.open_edges(), count as usize - 1);
    }

    proptest! {
        /// Few vertices and many triangles: every bucket is crowded.
        #[test]
        fn the_number_of_parts_and_the_way_of_pairing_do_not_matter(
            triangles in prop::collection::vec(prop::sample::subsequence((0u32..9).collect::<Vec<_>>(), 3), 0..60),
            flips in prop::collection::vec(any::<bool>(), 60),
        ) {
            let triangles: Vec<[u32; 3]> = triangles.iter().zip(flips)
                .map(|(face, flip)| if flip { [face[0], face[2], face[1]] } else { [face[0], face[1], face[2]] })
                .collect();
            let one = TriangleMesh::from_triangles_in(points(9), triangles.clone(), 1);
            assert_lawful(&one);
            for parts in [2, 3, 7] {
                prop_assert_eq!(&one, &TriangleMesh::from_triangles_in(points(9), triangles.clone(), parts));
            }
        }

        #[test]
        fn long_and_short_buckets_are_paired_alike(keys in prop::collection::vec(0u64..8, 0..=LONG_BUCKET)) {
            let bucket: Vec<u64> = keys.iter().enumerate().map(|(corner, key)| key << 32 | corner as u64).collect();
            let (mut short, mut long) = (bucket.clone(), bucket);
            prop_assert_eq!(pair(&mut short), pair_long(&mut long));
            prop_assert_eq!(short, long);
        }
    }
}
