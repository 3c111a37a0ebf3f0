//! Cross-sections of shapes that have a formula: area, perimeter and number of loops of every layer.

use super::*;
use std::f64::consts::TAU;

/// Millimetres to a mesh; equal corners are one vertex.
fn mesh(triangles: &[[[f64; 3]; 3]]) -> TriangleMesh {
    let mut index = std::collections::HashMap::new();
    let mut vertices = Vec::new();
    let mut of = |corner: [f64; 3]| {
        let [x, y, z] = corner.map(|mm| (mm * 1000.0).round() as i32);
        *index.entry((x, y, z)).or_insert_with(|| {
            vertices.push(Point3 { x, y, z });
            vertices.len() as u32 - 1
        })
    };
    let mut faces: Vec<[u32; 3]> = triangles.iter().map(|face| face.map(&mut of)).collect();
    faces.retain(|[a, b, c]| a != b && b != c && c != a);
    TriangleMesh::from_triangles(vertices, faces)
}

/// Turns a profile of radius and height around the z axis: one that begins on the axis ends there too, any other comes
/// back to its start.
fn revolved(profile: &[[f64; 2]], around: usize, radius: impl Fn(usize) -> f64) -> TriangleMesh {
    let at = |step: usize, place: usize| {
        let angle = TAU * (step % around) as f64 / around as f64;
        let [out, z] = profile[place % profile.len()];
        [out * radius(step % around) * libm::cos(angle), out * radius(step % around) * libm::sin(angle), z]
    };
    let closed = profile[0][0] > 0.0;
    let mut triangles = Vec::new();
    for step in 0..around {
        for place in 0..profile.len() - usize::from(!closed) {
            let [a, b, c, d] =
                [at(step, place), at(step + 1, place), at(step + 1, place + 1), at(step, place + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh(&triangles)
}

/// Cuts into layers of a millimetre and compares each: height → area, perimeter, loops. The shares are how much less
/// than the formula a chord may give, and `SIMPLIFY` may take more off.
fn compare(part: &TriangleMesh, share: f64, formula: impl Fn(f64) -> (f64, f64, usize)) {
    let one = Micron(1000);
    let settings = Carve {
        layer_height: one,
        first_layer_height: one,
        bead_width: Micron(2000),
        find_bridges: false,
        ..Carve::default()
    };
    assert!(part.flaws.none());
    let mut notes = Notes::default();
    let slices = settings.carve(part, &Machine::default(), &mut notes).expect("layers");
    assert!(notes.is_empty(), "{notes:?}");
    assert!(slices.layers.len() > 5);
    for layer in &slices.layers {
        let (area, perimeter, loops) = formula(layer.z.mm());
        let found: f64 = layer.loops.iter().map(Ring::area).sum();
        let length: f64 = layer.loops.iter().map(Ring::length).sum::<f64>() / 1000.0;
        // A corner dropped takes off at most the simplification along the perimeter; a rounded one a micron.
        let slack = if share == 0.0 { 0.0 } else { perimeter * (SIMPLIFY + 1.0) / 1000.0 };
        assert_eq!(layer.loops.len(), loops, "z {}", layer.z);
        assert!((found - area).abs() <= share * area + slack, "z {}: {found} mm², not {area}", layer.z);
        let slack = if share == 0.0 { 0.0 } else { 0.002 * perimeter + 0.04 };
        assert!(
            (length - perimeter).abs() <= share * perimeter + slack,
            "z {}: {length} mm, not {perimeter}",
            layer.z
        );
    }
}

/// By how much a regular polygon of so many corners falls short of its circle.
fn chord(corners: f64) -> f64 {
    1.0 - libm::sin(TAU / corners) * corners / TAU
}

#[test]
fn a_cube_is_exact() {
    let part = revolved(&[[0.0, 0.0], [1.0, 0.0], [1.0, 20.0], [0.0, 20.0]], 4, |_| 10.0);
    // The square stands on its corners: its diagonals are 20 mm.
    let side = Point::new(10_000, 0).distance(Point::new(0, 10_000)) / 1000.0;
    compare(&part, 0.0, |_| (200.0, 4.0 * side, 1));
}

#[test]
fn a_cone_shrinks_with_its_height() {
    let part = revolved(&[[0.0, 0.0], [30.0, 0.0], [0.0, 40.0]], 256, |_| 1.0);
    compare(&part, chord(256.0), |z| {
        let radius = 30.0 * (1.0 - z / 40.0);
        (TAU / 2.0 * radius * radius, TAU * radius, 1)
    });
}

#[test]
fn a_sphere_is_round_in_every_layer() {
    let profile: Vec<[f64; 2]> = (0..=180)
        .map(|step| {
            let angle = TAU / 2.0 * f64::from(step) / 180.0;
            let out = if step % 180 == 0 { 0.0 } else { 25.0 * libm::sin(angle) };
            [out, 25.0 - 25.0 * libm::cos(angle)]
        })
        .collect();
    let part = revolved(&profile, 360, |_| 1.0);
    compare(&part, 2.0 * chord(360.0), |z| {
        let square = 25.0 * 25.0 - (z - 25.0) * (z - 25.0);
        (TAU / 2.0 * square, TAU * square.sqrt(), 1)
    });
}

#[test]
fn a_torus_has_a_hole_in_every_layer() {
    let profile: Vec<[f64; 2]> = (0..180)
        .map(|step| {
            let angle = TAU * f64::from(step) / 180.0;
            [30.0 + 8.0 * libm::cos(angle), 8.0 + 8.0 * libm::sin(angle)]
        })
        .collect();
    let part = revolved(&profile, 360, |_| 1.0);
    compare(&part, 2.0 * chord(180.0), |z| {
        let wide = (64.0 - (z - 8.0) * (z - 8.0)).sqrt();
        (TAU * 30.0 * 2.0 * wide, TAU * 60.0, 2)
    });
}

#[test]
fn a_gear_keeps_its_teeth() {
    let teeth = 24;
    let radius = |step: usize| if step.is_multiple_of(2) { 25.0 } else { 20.0 };
    let part = revolved(&[[0.0, 0.0], [1.0, 0.0], [1.0, 12.0], [0.0, 12.0]], 2 * teeth, radius);
    let angle = TAU / (2 * teeth) as f64;
    let flank = libm::sqrt(25.0 * 25.0 + 20.0 * 20.0 - 2.0 * 25.0 * 20.0 * libm::cos(angle));
    let area = teeth as f64 * 25.0 * 20.0 * libm::sin(angle);
    // Straight flanks: nothing but the rounding to microns.
    compare(&part, 1e-6, |_| (area, (2 * teeth) as f64 * flank, 1));
}

#[test]
fn nested_tubes_have_two_loops_each() {
    let tube = |outer: f64, inner: f64| {
        revolved(&[[outer, 0.0], [outer, 15.0], [inner, 15.0], [inner, 0.0]], 180, |_| 1.0)
    };
    let [one, other] = [tube(40.0, 30.0), tube(20.0, 10.0)];
    let part = ::mesh::joined(&[(&one, Point3::default()), (&other, Point3::default())]);
    compare(&part, chord(180.0), |_| (TAU / 2.0 * (1600.0 - 900.0 + 400.0 - 100.0), TAU * 100.0, 4));
}
