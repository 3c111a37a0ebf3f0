use super::*;

fn cube(low: i32, high: i32) -> TriangleMesh {
    let corner = |index: usize| {
        let side = |bit: usize| if index >> bit & 1 == 0 { low } else { high };
        Point3 { x: side(0), y: side(1), z: side(2) }
    };
    const FACES: [[u32; 3]; 12] = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    TriangleMesh::from_triangles((0..8).map(corner).collect(), FACES.to_vec())
}

fn ratio(value: f64) -> Ratio {
    Ratio::from_f64(value).expect("a ratio")
}

/// stages_tests.md SC1: the sizes; the layers keep their height, since the part is scaled before it is cut (§9.2).
#[test]
fn sc1_factors_of_one_s_own() {
    let stage = Scale {
        drying_shrinkage: Ratio(0),
        firing_shrinkage: Ratio(0),
        xy_plane_scale: ratio(1.05),
        z_axis_scale: ratio(1.1),
        ..Scale::default()
    };
    let mut part = cube(0, 20_000);
    let volume = part.volume();
    stage.scale(&mut part, &mut Notes::default()).expect("small enough");
    let bounds = part.bounds();
    assert_eq!((bounds.min.x, bounds.max.x, bounds.min.z, bounds.max.z), (-500, 20_500, 0, 22_000));
    assert!((part.volume() / volume - 1.05 * 1.05 * 1.1).abs() < 1e-9);
}

/// stages_tests.md SC3.
#[test]
fn sc3_twelve_percent_of_shrinkage() {
    let stage = Scale { drying_shrinkage: ratio(0.12), firing_shrinkage: Ratio(0), ..Scale::default() };
    let (plane, up) = stage.factors();
    assert!((plane - 1.1364).abs() < 1e-4 && plane == up);
    let mut part = cube(10_000, 110_000);
    stage.scale(&mut part, &mut Notes::default()).expect("small enough");
    let bounds = part.bounds();
    assert_eq!((bounds.min.x, bounds.max.x, bounds.min.z), (3_182, 116_818, 10_000));
}

#[test]
fn drying_and_firing_come_one_after_the_other() {
    let stage = Scale {
        drying_shrinkage: ratio(0.1),
        firing_shrinkage: ratio(0.2),
        settling: ratio(0.5),
        ..Scale::default()
    };
    let (plane, up) = stage.factors();
    assert!((plane * 0.9 * 0.8 - 1.0).abs() < 1e-12 && (up - 2.0 * plane).abs() < 1e-9);
}

#[test]
fn more_than_any_machine_is_refused() {
    let stage = Scale { xy_plane_scale: ratio(100.0), ..Scale::default() };
    assert!(stage.scale(&mut cube(0, 900_000_000), &mut Notes::default()).is_err());
}
