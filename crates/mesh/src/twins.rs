//! Faces between the same three vertices.

use shape::TriangleMesh;
use std::cmp::Ordering;

/// Which faces are to go because another of the same three vertices makes them needless.
///
/// Of those that look the same way one stays. Two that look opposite ways enclose nothing and both go, unless their
/// neighbours are all such pairs: then the surface was written with two sides, and one side stays.
pub(crate) fn needless(mesh: &TriangleMesh) -> Vec<u32> {
    let mut suspects: Vec<([u32; 3], bool, u32)> = crowded_faces(mesh)
        .into_iter()
        .map(|number| {
            let (sorted, even) = canonical(mesh.faces[number as usize].vertices);
            (sorted, even, number)
        })
        .collect();
    suspects.sort_unstable();
    let mut needless = Vec::new();
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    for group in suspects.chunk_by(|one, other| one.0 == other.0) {
        let (odd, even) = group.split_at(group.partition_point(|(_, even, _)| !even));
        let numbers =
            |group: &[([u32; 3], bool, u32)]| group.iter().map(|(.., number)| *number).collect::<Vec<_>>();
        let (odd, even) = (numbers(odd), numbers(even));
        match odd.len().cmp(&even.len()) {
            Ordering::Equal => {
                pairs.push([odd[0].min(even[0]), odd[0].max(even[0])]);
                needless.extend(odd[1..].iter().chain(&even[1..]));
            }
            // What is more often there than its reverse is meant.
            Ordering::Greater => needless.extend(odd[1..].iter().chain(&even)),
            Ordering::Less => needless.extend(odd.iter().chain(&even[1..])),
        }
    }
    let two_sided = wholly_paired(mesh, &pairs);
    for (pair, two_sided) in pairs.iter().zip(two_sided) {
        needless.extend(if two_sided { &pair[1..] } else { &pair[..] });
    }
    needless.sort_unstable();
    needless
}

/// The faces all of whose sides are shared by more than two faces or by none but their twin.
fn crowded_faces(mesh: &TriangleMesh) -> Vec<u32> {
    let (crowded, _) = crate::shells::crowded_edges(mesh);
    let twin = |number: u32| {
        let face = &mesh.faces[number as usize];
        let across = |edge: u32| mesh.edges[edge as usize].across(number);
        let other = across(face.edges[0]);
        other.is_some() && face.edges.iter().all(|edge| across(*edge) == other)
    };
    (0..mesh.faces.len() as u32)
        .filter(|number| {
            mesh.faces[*number as usize].edges.iter().all(|edge| crowded[*edge as usize]) || twin(*number)
        })
        .collect()
}

/// Whether each pair hangs together with nothing but other pairs.
fn wholly_paired(mesh: &TriangleMesh, pairs: &[[u32; 2]]) -> Vec<bool> {
    if pairs.is_empty() {
        return Vec::new();
    }
    let mut in_pair = vec![false; mesh.faces.len()];
    pairs.iter().flatten().for_each(|face| in_pair[*face as usize] = true);
    let mut groups = crate::shells::Groups::new(mesh.vertices.len());
    for face in pairs.iter().map(|pair| &mesh.faces[pair[0] as usize]) {
        let [a, b, c] = face.vertices;
        groups.join(a, b);
        groups.join(b, c);
    }
    let mut mixed = vec![false; mesh.vertices.len()];
    for (face, _) in mesh.faces.iter().zip(&in_pair).filter(|(_, in_pair)| !**in_pair) {
        face.vertices.iter().for_each(|vertex| mixed[groups.of(*vertex) as usize] = true);
    }
    pairs.iter().map(|pair| !mixed[groups.of(mesh.faces[pair[0] as usize].vertices[0]) as usize]).collect()
}

/// The three sorted, and whether that took an even number of swaps.
fn canonical([a, b, c]: [u32; 3]) -> ([u32; 3], bool) {
    let mut sorted = [a, b, c];
    sorted.sort_unstable();
    let even = [[a, b, c], [b, c, a], [c, a, b]].contains(&sorted);
    (sorted, even)
}
