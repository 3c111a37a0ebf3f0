use super::*;
use proptest::prelude::*;
use shape::{Bounds, Point3, TriangleMesh};
use unit::Angle;

type Corners = [[i32; 3]; 3];

/// Corners in microns; equal ones become one vertex.
fn mesh(triangles: &[Corners]) -> TriangleMesh {
    let mut vertices: Vec<Point3> = Vec::new();
    let mut index = |[x, y, z]: [i32; 3]| {
        let point = Point3 { x, y, z };
        vertices.iter().position(|known| *known == point).unwrap_or_else(|| {
            vertices.push(point);
            vertices.len() - 1
        }) as u32
    };
    let triangles = triangles.iter().map(|face| face.map(&mut index)).collect();
    TriangleMesh::from_triangles(vertices, triangles)
}

/// A box between two corners in microns.
fn cuboid(low: [i32; 3], high: [i32; 3]) -> Vec<Corners> {
    let at = |bits: usize| -> [i32; 3] {
        std::array::from_fn(|axis| if bits >> axis & 1 == 0 { low[axis] } else { high[axis] })
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
    quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|face| face.map(at)).collect()
}

fn cube() -> Vec<Corners> {
    cuboid([0; 3], [20_000; 3])
}

fn flipped(part: Vec<Corners>) -> Vec<Corners> {
    part.into_iter().map(|[a, b, c]| [a, c, b]).collect()
}

const HOW: Repair = Repair { weld: 50, widest_hole: 10_000 };

/// Repairs, and checks that what comes out is closed and encloses what it should.
#[track_caller]
fn repaired(part: &[Corners], volume: f64) -> Repairs {
    let (sound, done) = repair(&mesh(part), HOW);
    assert!(sound.flaws.none(), "{:?} after {done:?}", sound.flaws);
    assert!((sound.volume() - volume).abs() <= volume * 1e-2, "{} mm³ after {done:?}", sound.volume());
    done
}

#[test]
fn a_sound_part_is_left_as_it_is() {
    let part = mesh(&cube());
    let (same, done) = repair(&part, HOW);
    assert_eq!((same, done), (part, Repairs::default()));
}

#[test]
fn any_facet_that_is_missing_is_put_back() {
    for missing in 0..12 {
        let mut part = cube();
        part.remove(missing);
        assert_eq!(repaired(&part, 8000.0).holes, 1);
    }
}

#[test]
fn flipped_faces_are_turned_over_the_fewer_of_them() {
    let mut part = cube();
    part[3].swap(0, 1);
    part[8].swap(0, 1);
    assert_eq!(repaired(&part, 8000.0).turned, 2);
}

#[test]
fn doubled_faces_go_whichever_way_they_look() {
    let part = [cube(), vec![cube()[4]], flipped(vec![cube()[7]])].concat();
    // One that looks both ways encloses nothing, and the hole that is left is closed again.
    let done = repaired(&part, 8000.0);
    assert_eq!((done.doubled, done.holes), (3, 1));
    let two_sided = [cube(), flipped(cube())].concat();
    assert_eq!(repaired(&two_sided, 8000.0).doubled, 12);
}

#[test]
fn a_t_junction_is_split() {
    // The upright edge at the corner has a vertex half-way up on one side only.
    let mut part = cube();
    let edge = [[20_000, 0, 0], [20_000, 0, 20_000]];
    let face =
        part.iter().position(|face| edge.iter().all(|end| face.contains(end))).expect("a face on the edge");
    let old = part.remove(face);
    let middle = [20_000, 0, 10_000];
    part.push(old.map(|corner| if corner == edge[0] { middle } else { corner }));
    part.push(old.map(|corner| if corner == edge[1] { middle } else { corner }));
    assert_eq!(mesh(&part).flaws.open, 3);
    assert_eq!(repaired(&part, 8000.0).split, 1);
}

#[test]
fn a_crack_is_closed_and_an_edge_is_never_shrunk() {
    let mut part = cube();
    for face in part.iter_mut().filter(|face| face.iter().all(|corner| corner[2] == 20_000)) {
        *face = face.map(|[x, y, z]| [x + 20, y - 20, z + 10]);
    }
    assert_eq!(repaired(&part, 8000.0).welded, 4);
    // A needle whose own corners are nearer than the tolerance stays a needle.
    let needle = mesh(&[[[0, 0, 0], [20, 0, 0], [0, 0, 9000]]]);
    assert_eq!(repair(&needle, Repair { weld: 50, widest_hole: -1 }).0, needle);
}

#[test]
fn shells_are_outside_out_and_cavities_stay() {
    let inner = || cuboid([5_000; 3], [15_000; 3]);
    let beside = || cuboid([50_000, 0, 0], [60_000, 10_000, 10_000]);
    assert_eq!(repaired(&flipped(cube()), 8000.0).shells_turned, 1);
    assert_eq!(repaired(&[cube(), flipped(inner())].concat(), 7000.0).shells_turned, 0);
    assert_eq!(repaired(&[flipped(cube()), inner()].concat(), 7000.0).shells_turned, 2);
    assert_eq!(repaired(&[cube(), flipped(beside())].concat(), 9000.0).shells_turned, 1);
    // A hollow part inside out beside a sound one: its cavity turns with it.
    let other = cuboid([100_000, 0, 0], [130_000; 3]);
    let volume = mesh(&other).volume() + 7000.0;
    assert_eq!(repaired(&[other, flipped(cube()), inner()].concat(), volume).shells_turned, 2);
}

#[test]
fn a_bent_hole_is_closed_only_when_it_is_small() {
    // A pyramid without its sides is no hole in anything.
    let corner = |x: i32, y: i32, z: i32| [x, y, z];
    let bent = vec![
        [corner(0, 0, 0), corner(30_000, 0, 30_000), corner(30_000, 30_000, 0)],
        [corner(0, 0, 0), corner(30_000, 30_000, 0), corner(0, 30_000, 30_000)],
    ];
    assert_eq!(repair(&mesh(&bent), HOW).1.holes, 0);
    assert_eq!(repair(&mesh(&bent), Repair { widest_hole: 40_000, ..HOW }).1.holes, 1);
}

#[test]
fn a_diagnosis_counts_what_is_wrong() {
    let mut part = [cube(), cuboid([10_000; 3], [30_000; 3]), vec![cube()[1]]].concat();
    part[4].swap(0, 1);
    part.remove(9);
    let found = diagnose(&mesh(&part), 500);
    // The duplicate hangs together with nothing.
    assert_eq!((found.flipped, found.duplicate, found.shells), (1, 1, 3));
    assert_eq!((found.open_edges, found.holes), (6, 2));
    assert!(found.crossings > 0 && !found.is_sound());
    let sound = diagnose(&mesh(&cube()), 500);
    assert!(sound.is_sound() && sound.stand.stands());
    assert_eq!(sound.stand.margin, Some(10_000.0));
    assert_eq!(sound.thinnest_wall.map(|(thick, _)| thick), Some(20_000.0));
    assert_eq!(sound.overhang, None);
}

#[test]
fn an_overhang_and_a_tower_that_tips_are_found() {
    let leaning = |z: i32| if z == 0 { 0 } else { 40_000 };
    let part: Vec<Corners> =
        cube().into_iter().map(|face| face.map(|[x, y, z]| [x + leaning(z), y, z])).collect();
    let found = diagnose(&mesh(&part), 500);
    let overhang = found.overhang.expect("one side looks down");
    assert!((overhang.angle - 26.565).abs() < 1e-3, "{overhang:?}");
    assert!(
        !found.stand.stands() && found.stand.margin.is_some_and(|margin| (margin + 9_000.0).abs() < 600.0)
    );
}

#[test]
fn quarter_turns_are_exact_and_come_back() {
    let part = mesh(&cuboid([0; 3], [30_000, 20_000, 10_000]));
    let quarter = Turn { x: Angle(90_000), ..Turn::default() };
    let up = turned(&part, quarter).expect("it is small").bounds();
    assert_eq!((up.max.x - up.min.x, up.max.y - up.min.y, up.max.z - up.min.z), (30_000, 10_000, 20_000));
    let back = (0..4).fold(part.clone(), |part, _| turned(&part, quarter).expect("it is small"));
    assert_eq!(back, part);
}

#[test]
fn a_mesh_is_written_as_it_is_read() {
    let part = mesh(&cube());
    let bytes = binary_stl(&part, "a cube");
    assert_eq!(bytes.len(), 84 + 12 * 50);
    let corner = |at: usize| f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
    let read: Vec<i32> = (0..9).map(|place| (corner(96 + 4 * place) * 1000.0).round() as i32).collect();
    let first = part.corners(&part.faces[0]);
    assert_eq!(read, first.iter().flat_map(|at| [at.x, at.y, at.z]).collect::<Vec<_>>());
}

proptest! {
    /// Parts that find room stand on the bed and keep their distance.
    #[test]
    fn parts_on_a_plate_do_not_touch(sizes in prop::collection::vec((1i32..60_000, 1i32..60_000, -9_000i32..9_000), 1..9)) {
        let bounds: Vec<Bounds> = sizes
            .iter()
            .map(|(x, y, at)| Bounds {
                min: Point3 { x: *at, y: -at, z: *at },
                max: Point3 { x: at + x, y: y - at, z: at + 5 },
            })
            .collect();
        let Ok(moves) = arranged(&bounds, 200_000, 150_000, 5_000) else { return Ok(()) };
        let placed: Vec<(i32, i32, i32, i32)> = bounds
            .iter()
            .zip(&moves)
            .map(|(part, by)| (part.min.x + by.x, part.max.x + by.x, part.min.y + by.y, part.max.y + by.y))
            .collect();
        for (index, one) in placed.iter().enumerate() {
            prop_assert!(one.0 >= 0 && one.1 <= 200_000 && one.2 >= 0 && one.3 <= 150_000);
            prop_assert_eq!(bounds[index].min.z + moves[index].z, 0);
            for other in &placed[..index] {
                let gap = (one.0 - other.1).max(other.0 - one.1).max(one.2 - other.3).max(other.2 - one.3);
                prop_assert!(gap >= 5_000, "{} between {:?} and {:?}", gap, one, other);
            }
        }
    }

    /// Any triangles at all: no panic, and what is repaired stays within its box.
    #[test]
    fn nothing_breaks_the_repair(
        points in prop::collection::vec((-40i32..40, -40i32..40, -40i32..40), 3..24),
        corners in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..40),
    ) {
        let triangles: Vec<Corners> = corners
            .iter()
            .map(|(a, b, c)| [a, b, c].map(|corner| {
                let (x, y, z) = points[corner.index(points.len())];
                [x * 500, y * 500, z * 500]
            }))
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .collect();
        let part = mesh(&triangles);
        let (sound, done) = repair(&part, Repair { weld: 700, widest_hole: 20_000 });
        prop_assert!(sound.faces.is_empty() || sound.bounds().max <= part.bounds().max || done.doubled > 0 || done.welded > 0);
        diagnose(&part, 500);
        diagnose(&sound, 500);
    }

    /// A box that loses facets and has others flipped is the box again, as long as its holes are holes.
    #[test]
    fn a_spoiled_box_is_mended(missing in prop::collection::btree_set(0usize..12, 0..3), turned in prop::collection::btree_set(0usize..12, 0..4)) {
        let part: Vec<Corners> = (0..12)
            .filter(|place| !missing.contains(place))
            .map(|place| {
                let [a, b, c] = cube()[place];
                if turned.contains(&place) { [a, c, b] } else { [a, b, c] }
            })
            .collect();
        let (sound, done) = repair(&mesh(&part), Repair { weld: 50, widest_hole: 100_000 });
        // Two neighbours that are both missing leave a hole that may be closed the other way across.
        prop_assert!(sound.flaws.none() && (sound.volume() - 8000.0).abs() < 1334.0, "{:?} {}", done, sound.volume());
    }
}
