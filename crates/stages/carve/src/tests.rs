use super::*;
use skein::BedShape;

fn mesh(vertices: &[[f64; 3]], faces: &[[u32; 3]]) -> TriangleMesh {
    let micron = |mm: f64| (mm * 1000.0).round() as i32;
    let vertices =
        vertices.iter().map(|[x, y, z]| Point3 { x: micron(*x), y: micron(*y), z: micron(*z) }).collect();
    TriangleMesh::from_triangles(vertices, faces.to_vec())
}

/// A prism over a polygon in x–z, from y 0 to `depth`; the polygon is given as convex pieces sharing corners.
fn prism(profile: &[(f64, f64)], triangles: &[[u32; 3]], depth: f64) -> TriangleMesh {
    let count = profile.len() as u32;
    let mut vertices: Vec<[f64; 3]> = profile.iter().map(|(x, z)| [*x, 0.0, *z]).collect();
    vertices.extend(profile.iter().map(|(x, z)| [*x, depth, *z]));
    let mut faces = Vec::new();
    for &[a, b, c] in triangles {
        faces.push([a, b, c]);
        faces.push([a + count, c + count, b + count]);
    }
    for a in 0..count {
        let b = (a + 1) % count;
        faces.push([a, a + count, b]);
        faces.push([b, a + count, b + count]);
    }
    mesh(&vertices, &faces)
}

fn block(x: (f64, f64), y: f64, z: (f64, f64)) -> TriangleMesh {
    prism(&[(x.0, z.0), (x.1, z.0), (x.1, z.1), (x.0, z.1)], &[[0, 1, 2], [0, 2, 3]], y)
}

fn carve(mesh: &TriangleMesh) -> (Slices, Notes) {
    let mm = |value| Micron::from_mm(value).expect("a length");
    let settings = Carve {
        layer_height: mm(0.4),
        first_layer_height: mm(0.4),
        bead_width: mm(0.72),
        place: Place::Keep,
        ..Carve::default()
    };
    let mut notes = Notes::default();
    let slices = settings.carve(mesh, &Machine::default(), &mut notes).expect("layers");
    (slices, notes)
}

fn areas(slices: &Slices) -> Vec<Vec<f64>> {
    slices.layers.iter().map(|layer| layer.loops.iter().map(Ring::area).collect()).collect()
}

/// C1.
#[test]
fn c1_a_cube_has_one_square_a_layer() {
    let (slices, notes) = carve(&block((0.0, 20.0), 20.0, (0.0, 10.0)));
    assert_eq!(slices.layers.len(), 25);
    assert!(slices.layers.iter().all(|layer| layer.loops.len() == 1 && layer.loops[0].0.len() == 4));
    assert!(areas(&slices).iter().all(|loops| *loops == [400.0]));
    assert!(notes.is_empty());
}

/// C3: vertex rows exactly on the cutting planes.
#[test]
fn c3_a_row_of_vertices_on_a_plane_does_no_harm() {
    let heights = [0.0, 0.2, 1.0, 4.0];
    let mut profile: Vec<(f64, f64)> = heights.iter().map(|z| (20.0, *z)).collect();
    profile.extend(heights.iter().rev().map(|z| (0.0, *z)));
    let triangles: Vec<[u32; 3]> =
        (0..3u32).flat_map(|row| [[7 - row, row, row + 1], [7 - row, row + 1, 6 - row]]).collect();
    let (slices, _) = carve(&prism(&profile, &triangles, 20.0));
    assert_eq!(slices.layers.len(), 10);
    assert_eq!(slices.layers[0].z, Micron(200));
    assert!(areas(&slices).iter().all(|loops| *loops == [400.0]));
}

/// C11: two pillars and a slab across.
#[test]
fn c11_only_the_layer_over_the_gap_is_a_bridge() {
    let profile =
        [(0.0, 0.0), (5.0, 0.0), (5.0, 4.0), (25.0, 4.0), (25.0, 0.0), (30.0, 0.0), (30.0, 6.0), (0.0, 6.0)];
    let triangles = [[0, 1, 2], [0, 2, 7], [2, 3, 6], [2, 6, 7], [3, 4, 5], [3, 5, 6]];
    let (slices, _) = carve(&prism(&profile, &triangles, 10.0));
    assert_eq!(slices.layers.len(), 15);
    let bridges: Vec<(Micron, Direction)> =
        slices.layers.iter().filter_map(|layer| layer.rotation.map(|rotation| (layer.z, rotation))).collect();
    assert_eq!(bridges, [(Micron(4200), Direction::X)]);
}

/// C12: an overhang all round has no direction.
#[test]
fn c12_a_mushroom_is_no_bridge() {
    let mut vertices = Vec::new();
    for (half, z) in [(5.0, 0.0), (5.0, 6.0), (12.0, 6.0), (12.0, 10.0)] {
        vertices.extend([[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]]);
    }
    let mut faces = vec![[0, 2, 1], [0, 3, 2], [12, 13, 14], [12, 14, 15]];
    for level in 0..3u32 {
        for side in 0..4u32 {
            let (a, b) = (4 * level + side, 4 * level + (side + 1) % 4);
            faces.extend([[a, b, b + 4], [a, b + 4, a + 4]]);
        }
    }
    let part = mesh(&vertices.iter().map(|[x, y, z]| [x + 50.0, y + 50.0, *z]).collect::<Vec<_>>(), &faces);
    let (slices, _) = carve(&part);
    assert_eq!(slices.layers.len(), 25);
    assert!(slices.layers.iter().all(|layer| layer.rotation.is_none()));
}

/// C7: a gap is closed with a straight line and said.
#[test]
fn c7_a_missing_triangle_is_spanned_and_reported() {
    let whole = block((0.0, 20.0), 20.0, (0.0, 10.0));
    let faces: Vec<[u32; 3]> = whole.faces.iter().map(|face| face.vertices).collect();
    for missing in 4..faces.len() {
        let kept: Vec<[u32; 3]> =
            (0..faces.len()).filter(|index| *index != missing).map(|index| faces[index]).collect();
        let (slices, notes) = carve(&TriangleMesh::from_triangles(whole.vertices.clone(), kept));
        assert!(
            areas(&slices).iter().all(|loops| loops.len() == 1 && (loops[0] - 400.0).abs() < 0.1),
            "{missing}"
        );
        let level = whole.vertices[faces[missing][0] as usize].z
            == whole.vertices[faces[missing][1] as usize].z
            && whole.vertices[faces[missing][0] as usize].z == whole.vertices[faces[missing][2] as usize].z;
        assert!(level || !notes.is_empty());
    }
}

/// C5: triangles turned inside out slice the same.
#[test]
fn c5_a_part_inside_out_slices_the_same() {
    let whole = block((0.0, 20.0), 20.0, (0.0, 10.0));
    let flipped: Vec<[u32; 3]> = whole
        .faces
        .iter()
        .map(|face| {
            let [a, b, c] = face.vertices;
            [a, c, b]
        })
        .collect();
    let (slices, _) = carve(&TriangleMesh::from_triangles(whole.vertices.clone(), flipped));
    assert!(areas(&slices).iter().all(|loops| *loops == [400.0]));
}

/// C14: two boxes through each other.
#[test]
fn c14_overlapping_shells_are_united() {
    let (one, other) = (block((0.0, 10.0), 10.0, (0.0, 4.0)), block((5.0, 15.0), 8.0, (0.0, 4.0)));
    let mut vertices = one.vertices.clone();
    vertices.extend(&other.vertices);
    let shift = one.vertices.len() as u32;
    let mut faces: Vec<[u32; 3]> = one.faces.iter().map(|face| face.vertices).collect();
    faces.extend(other.faces.iter().map(|face| face.vertices.map(|vertex| vertex + shift)));
    let (slices, notes) = carve(&TriangleMesh::from_triangles(vertices, faces));
    assert!(areas(&slices).iter().all(|loops| *loops == [140.0]), "{:?}", areas(&slices)[0]);
    assert!(!notes.is_empty());
}

#[test]
fn a_part_larger_than_the_bed_is_refused() {
    let part = block((0.0, 250.0), 20.0, (0.0, 10.0));
    let error =
        Carve::default().carve(&part, &Machine::default(), &mut Notes::default()).expect_err("too large");
    assert!(error.message.contains("250.0 × 20.0 × 10.0"), "{error}");
}

#[test]
fn the_drawing_reads_back() {
    let (slices, _) = carve(&block((0.0, 20.0), 20.0, (0.0, 10.0)));
    assert_eq!(Slices::read(&slices.write()).expect("a drawing"), slices);
}

#[test]
fn a_part_whose_corners_hang_over_a_round_bed_is_refused() {
    let part = block((0.0, 150.0), 150.0, (0.0, 10.0));
    let square = Machine::default();
    let round = Machine { shape: BedShape::Ellipse, ..Machine::default() };
    assert!(Carve::default().carve(&part, &square, &mut Notes::default()).is_ok());
    let error = Carve::default().carve(&part, &round, &mut Notes::default()).expect_err("too large");
    assert!(error.message.contains("beside the round bed"), "{error}");
    let small = block((0.0, 140.0), 140.0, (0.0, 10.0));
    assert!(Carve::default().carve(&small, &round, &mut Notes::default()).is_ok());
}

/// C2: a last slab counts from three quarters of a layer on.
#[test]
fn c2_a_last_slab_of_less_than_three_quarters_is_left_out() {
    for (height, count) in [(10.0, 25), (10.1, 25), (10.35, 26)] {
        let (slices, _) = carve(&block((0.0, 20.0), 20.0, (0.0, height)));
        assert_eq!(slices.layers.len(), count, "{height}");
    }
}

/// C4: the larger loop first, counter-clockwise; the hole clockwise.
/// stages_tests.md C6: layers from 2 to -1.
#[test]
fn c6_layers_can_be_left_out_below_and_above() {
    let mm = |value| Micron::from_mm(value).expect("a length");
    let settings = Carve {
        layer_height: mm(0.4),
        first_layer_height: mm(0.4),
        bead_width: mm(0.72),
        skip_lowest: 2,
        skip_topmost: 1,
        ..Carve::default()
    };
    let cube = block((0.0, 20.0), 20.0, (0.0, 10.0));
    let slices = settings.carve(&cube, &Machine::default(), &mut Notes::default()).expect("a cube");
    let ends = (slices.layers.first(), slices.layers.last());
    assert_eq!(slices.layers.len(), 22);
    assert_eq!((ends.0.map(|layer| layer.z.0), ends.1.map(|layer| layer.z.0)), (Some(1_000), Some(9_400)));
    let none = Carve { skip_lowest: 20, skip_topmost: 5, ..settings };
    assert!(none.carve(&cube, &Machine::default(), &mut Notes::default()).is_err());
}

#[test]
fn c4_a_ring_is_an_outside_and_a_hole() {
    let mut vertices = Vec::new();
    for (radius, z) in [(15.0, 0.0), (8.0, 0.0), (15.0, 10.0), (8.0, 10.0)] {
        for corner in 0..48 {
            let angle = std::f64::consts::TAU * f64::from(corner) / 48.0;
            vertices.push([20.0 + radius * angle.cos(), 20.0 + radius * angle.sin(), z]);
        }
    }
    let mut faces = Vec::new();
    let mut wall = |from: u32, to: u32| {
        for a in 0..48u32 {
            let b = (a + 1) % 48;
            faces.extend([[from + a, from + b, to + b], [from + a, to + b, to + a]]);
        }
    };
    wall(0, 96);
    wall(144, 48);
    wall(48, 0);
    wall(96, 144);
    let (slices, notes) = carve(&mesh(&vertices, &faces));
    assert_eq!(slices.layers.len(), 25);
    for loops in areas(&slices) {
        assert!(loops.len() == 2 && loops[0] > 690.0 && loops[1] < -190.0, "{loops:?}");
    }
    assert!(notes.is_empty());
}

/// C8 and C9 say how far the plane is moved off a row of vertices. Ours is not moved: a vertex on it counts as above it,
/// and the layer keeps its nominal height.
#[test]
fn c8_c9_a_plane_through_vertices_is_not_moved() {
    let heights = [0.0, 0.2, 0.6, 10.0];
    let mut profile: Vec<(f64, f64)> = heights.iter().map(|z| (20.0, *z)).collect();
    profile.extend(heights.iter().rev().map(|z| (0.0, *z)));
    let triangles: Vec<[u32; 3]> =
        (0..3u32).flat_map(|row| [[7 - row, row, row + 1], [7 - row, row + 1, 6 - row]]).collect();
    let (slices, notes) = carve(&prism(&profile, &triangles, 20.0));
    let heights: Vec<i32> = slices.layers.iter().map(|layer| layer.z.0).collect();
    assert_eq!(heights, (0..25).map(|layer| 200 + 400 * layer).collect::<Vec<i32>>());
    assert!(areas(&slices).iter().all(|loops| *loops == [400.0]) && notes.is_empty());
}

/// C13: nothing to print is said and stops the chain.
#[test]
fn c13_a_part_flatter_than_a_layer_is_refused() {
    let flat = block((0.0, 20.0), 20.0, (0.0, 0.05));
    let error =
        Carve::default().carve(&flat, &Machine::default(), &mut Notes::default()).expect_err("too flat");
    assert!(error.hint.is_some(), "{error}");
}
