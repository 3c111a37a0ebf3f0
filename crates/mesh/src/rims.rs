//! The open edges of a mesh, and the loops they form.

use shape::{Edge, TriangleMesh};

/// An open side: the edge runs from the first vertex to the second in its face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    pub(crate) from: u32,
    pub(crate) to: u32,
    pub(crate) face: u32,
}

/// Every open side, sorted.
pub(crate) fn open_sides(mesh: &TriangleMesh) -> Vec<Side> {
    let mut sides: Vec<Side> = Vec::with_capacity(mesh.flaws.open);
    for (number, edge) in (0u32..).zip(&mesh.edges).filter(|(_, edge)| edge.faces[1] == Edge::OPEN) {
        let face = edge.faces[0];
        let corners = mesh.faces[face as usize];
        let turn = (0..3).find(|turn| corners.edges[*turn] == number).unwrap_or_default();
        sides.push(Side { from: corners.vertices[turn], to: corners.vertices[(turn + 1) % 3], face });
    }
    sides.sort_unstable();
    sides
}

/// The vertices of open sides, each once, sorted.
pub(crate) fn vertices(sides: &[Side]) -> Vec<u32> {
    let mut vertices: Vec<u32> = sides.iter().flat_map(|side| [side.from, side.to]).collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

/// The loops of the rims, each as its vertices in the order in which a face that fills the hole would have them.
///
/// Where holes touch in a vertex each is a loop of its own. Sides that come back to no start form none.
pub(crate) fn loops(sides: &[Side]) -> Vec<Vec<u32>> {
    // A face across an open side runs along it the other way round.
    let mut steps: Vec<(u32, u32)> = sides.iter().map(|side| (side.to, side.from)).collect();
    steps.sort_unstable();
    let mut used = vec![false; steps.len()];
    let next = |vertex: u32, used: &mut Vec<bool>| {
        let start = steps.partition_point(|(from, _)| *from < vertex);
        let place =
            (start..steps.len()).take_while(|place| steps[*place].0 == vertex).find(|place| !used[*place])?;
        used[place] = true;
        Some(steps[place].1)
    };
    let mut loops = Vec::new();
    // Where a vertex stands in the path that is being walked.
    let mut place_of = std::collections::HashMap::new();
    for start in vertices(sides) {
        let mut path = vec![start];
        place_of.insert(start, 0);
        while let Some(here) = path.last().copied() {
            let Some(vertex) = next(here, &mut used) else {
                // A dead end: back to where another way leads on.
                place_of.remove(&here);
                path.pop();
                continue;
            };
            if let Some(&place) = place_of.get(&vertex) {
                let closed: Vec<u32> = path.drain(place..).collect();
                closed.iter().for_each(|vertex| {
                    place_of.remove(vertex);
                });
                loops.push(closed);
                path.push(vertex);
                place_of.insert(vertex, place);
            } else {
                place_of.insert(vertex, path.len());
                path.push(vertex);
            }
        }
    }
    loops
}
