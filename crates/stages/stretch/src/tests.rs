use super::*;
use skein::{Facts, Micron, Tag};

fn ratio(value: f64) -> Ratio {
    Ratio::from_f64(value).expect("a ratio")
}

/// A layer with one wall of these points, in mm, for a bead of this width.
fn wall(kind: &str, side: &str, width: f64, points: &[(f64, f64)]) -> Skein {
    let mut text = format!("(</extruderInitialization>)\n(<layer> 0.2 )\n(<{kind}> {side} )\n");
    for (index, (x, y)) in points.iter().enumerate() {
        text += &format!("G1 X{x:.3} Y{y:.3} Z0.4\n");
        if index == 0 {
            text += "M101\n";
        }
    }
    text += &format!("M103\n(</{kind}>)\n(</layer>)\n");
    let mut skein = Skein::read(text.as_bytes()).expect("a skein");
    let facts = Facts { bead_width: Micron::from_mm(width), ..Facts::default() };
    skein.state(&facts).expect("facts");
    skein
}

fn points(stage: &Stretch, skein: Skein) -> Vec<(f64, f64)> {
    let skein = stage.craft(skein, &mut Notes::default()).expect("stretch");
    assert_eq!(skein.verify(), Ok(()));
    let steps = skein.layers.iter().flat_map(|layer| &layer.lines).filter_map(Line::as_move);
    steps.map(|step| (Micron(step.to.x).mm(), Micron(step.to.y).mm())).collect()
}

/// A ring of 32 sides, closed, counter-clockwise or not.
fn circle(radius: f64, inner: bool) -> Vec<(f64, f64)> {
    let turn = if inner { -1.0 } else { 1.0 };
    let at = |side: i32| f64::from(side) * turn * std::f64::consts::TAU / 32.0;
    (0..=32).map(|side| (radius * at(side % 32).cos(), radius * at(side % 32).sin())).collect()
}

/// The mean radius of a circle of 5 mm when it has been stretched.
fn radius(stage: &Stretch, width: f64, inner: bool) -> f64 {
    let side = if inner { "inner" } else { "outer" };
    let ring = points(stage, wall("edge", side, width, &circle(5.0, inner)));
    // stages_tests.md X7: closed.
    assert_eq!(ring.first(), ring.last());
    ring[1..].iter().map(|(x, y)| x.hypot(*y)).sum::<f64>() / 32.0
}

/// What the original does: amounts and cross limit are of 0.4 mm, whatever the width (D15).
fn original(width: f64) -> Stretch {
    let share = 0.4 / width;
    Stretch {
        outer_over_bead_width: ratio(0.1 * share),
        inner_over_bead_width: ratio(0.32 * share),
        cross_limit_over_bead_width: ratio(5.0 * share),
        ..Stretch::default()
    }
}

/// stages_tests.md X1.
#[test]
fn x1_a_straight_line_stays() {
    let line: Vec<(f64, f64)> =
        (0..20).map(|step| (f64::from(step * step) * 0.3, f64::from(step * step) * 0.1)).collect();
    let stage = Stretch { path_over_bead_width: ratio(0.2), ..Stretch::default() };
    assert_eq!(
        points(&stage, wall("edge", "outer", 3.0, &line)),
        line.iter().map(|(x, y)| ((x * 1e3).round() / 1e3, (y * 1e3).round() / 1e3)).collect::<Vec<_>>()
    );
}

/// stages_tests.md X2, X3 and, in `radius`, X7.
#[test]
fn x2_x3_x7_a_circle_grows_and_a_hole_more_and_both_stay_closed() {
    assert!((radius(&original(0.72), 0.72, false) - 5.0059).abs() < 0.0005);
    assert!((radius(&original(0.72), 0.72, true) - 5.0190).abs() < 0.0005);
}

/// stages_tests.md X4; the original's first point of a loop goes another way, so a thirty-second of the shift is open.
#[test]
fn x4_wide_beads_by_the_original() {
    assert!((radius(&original(3.0), 3.0, false) - 5.0192).abs() < 0.001);
    assert!((radius(&original(3.0), 3.0, true) - 5.0614).abs() < 0.003);
}

/// stages_tests.md X5: amounts by the width, with the cross limit of 2 mm that the row's numbers have; and with a limit
/// by the width, where all of the bend counts.
#[test]
fn x5_amounts_go_by_the_width() {
    let limit = original(3.0).cross_limit_over_bead_width;
    let stage = Stretch { cross_limit_over_bead_width: limit, ..Stretch::default() };
    assert!((radius(&stage, 3.0, false) - 5.144).abs() < 0.008);
    assert!((radius(&stage, 3.0, true) - 5.46).abs() < 0.025);
    assert!(radius(&Stretch::default(), 3.0, false) > radius(&stage, 3.0, false));
}

/// stages_tests.md X6.
#[test]
fn x6_corners_of_long_sides_stay() {
    let square = [(0.0, 0.0), (40.0, 0.0), (40.0, 40.0), (0.0, 40.0), (0.0, 0.0)];
    // The part of the shift along a side is across the other, so nothing is left.
    assert_eq!(points(&Stretch::default(), wall("edge", "outer", 0.72, &square)), square);
}

#[test]
fn points_upon_points_and_beads_of_one_move_pass() {
    for line in [vec![(0.0, 0.0), (0.0, 0.0), (0.0, 0.0)], vec![(0.0, 0.0), (5.0, 0.0)], vec![(1.0, 1.0)]] {
        assert_eq!(points(&Stretch::default(), wall("loop", "outer", 3.0, &line)), line);
    }
}

#[test]
fn without_amounts_nothing_changes() {
    let none = Ratio(0);
    let stage = Stretch {
        outer_over_bead_width: none,
        inner_over_bead_width: none,
        loop_over_bead_width: none,
        ..Stretch::default()
    };
    let skein = wall("edge", "inner", 3.0, &circle(5.0, true));
    assert!(!skein.layers.is_empty() && skein.head.contains(&Line::Close(Tag::ExtruderInitialization)));
    assert_eq!(stage.craft(skein.clone(), &mut Notes::default()), Ok(skein));
}
