//! Cracks: vertices of rims that nearly meet become one.

use crate::rims::{self, Side};
use crate::tree::{Box3, Tree, array};
use shape::TriangleMesh;

/// For every vertex the one that it becomes: for most themselves, for those of rims the first one within `tolerance`.
///
/// The two ends of an edge never become one, however short it is: that would take away what the file has.
/// Returns also how many vertices become another.
pub(crate) fn welded(mesh: &TriangleMesh, sides: &[Side], tolerance: i32) -> (Vec<u32>, usize) {
    let mut becomes: Vec<u32> = (0..mesh.vertices.len() as u32).collect();
    let rim = rims::vertices(sides);
    let point = |vertex: u32| mesh.vertices[vertex as usize];
    let tree = Tree::new(rim.iter().map(|vertex| Box3::around([point(*vertex)])));
    let mut neighbours: Vec<(u32, u32)> =
        sides.iter().flat_map(|side| [(side.from, side.to), (side.to, side.from)]).collect();
    neighbours.sort_unstable();
    let of = |vertex: u32| {
        let start = neighbours.partition_point(|(from, _)| *from < vertex);
        neighbours[start..].iter().take_while(move |(from, _)| *from == vertex).map(|(_, to)| *to)
    };
    // Whom each vertex that is kept has taken in, itself included.
    let mut members: std::collections::HashMap<u32, Vec<u32>> = std::collections::HashMap::new();
    let mut count = 0;
    for &vertex in &rim {
        let mut near: Vec<(i64, u32)> = Vec::new();
        tree.meeting(&Box3::around([point(vertex)]).grown(tolerance), |item| {
            let other = rim[item as usize];
            let away = distance2(array(point(vertex)), array(point(other)));
            if other < vertex && becomes[other as usize] == other && away <= i64::from(tolerance).pow(2) {
                near.push((away, other));
            }
        });
        near.sort_unstable();
        let kept = near.iter().map(|(_, other)| *other).find(|other| {
            let taken = members.get(other).map_or(&[][..], Vec::as_slice);
            !of(vertex).any(|neighbour| neighbour == *other || taken.contains(&neighbour))
        });
        let kept = kept.unwrap_or(vertex);
        count += usize::from(kept != vertex);
        becomes[vertex as usize] = kept;
        members.entry(kept).or_default().push(vertex);
    }
    (becomes, count)
}

fn distance2(one: [i32; 3], other: [i32; 3]) -> i64 {
    (0..3).map(|axis| (i64::from(one[axis]) - i64::from(other[axis])).pow(2)).fold(0, i64::saturating_add)
}
