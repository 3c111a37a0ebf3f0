use super::*;
use skein::{Reader, Tag};

const CORNER: &str = "G1 X0 Y0 Z0.2 F1200\nM101\nG1 X20 Y0 Z0.2 F960\nG1 X20 Y20 Z0.2\nM103";

fn fillet(procedure: Procedure, radius: f64, text: &str) -> Vec<String> {
    let mut reader = Reader::default();
    let lines = text.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect();
    let head = vec![Line::Close(Tag::ExtruderInitialization)];
    let mut skein = Skein { head, layers: vec![Layer { lines }], ..Skein::default() };
    skein.state(&Facts { bead_width: Some(Micron(720)), ..Facts::default() }).expect("facts");
    let radius_over_bead_width = Ratio::from_f64(radius).expect("a ratio");
    let stage = Fillet { procedure, radius_over_bead_width, ..Fillet::default() };
    let skein = stage.craft(skein, &mut Notes::default()).expect("fillet");
    let text = String::from_utf8(skein.write()).expect("text");
    text.lines().filter(|line| line.starts_with('G')).map(str::to_owned).collect()
}

/// stages_tests.md U1.
#[test]
fn u1_a_bevel_cuts_the_corner_off() {
    assert_eq!(
        fillet(Procedure::Bevel, 0.35, CORNER)[1..3],
        ["G1 X19.748 Y0.0 Z0.2 F960.0", "G1 X20.0 Y0.252 Z0.2"]
    );
}

/// stages_tests.md U2, with the two feeds on the two sides of the corner.
#[test]
fn u2_the_corner_is_as_fast_as_the_mean_of_its_sides() {
    let text = "G1 X0 Y0 Z0.2\nM101\nG1 X20 Y0 Z0.2 F1200\nG1 X20 Y20 Z0.2 F960\nG1 X0 Y20 Z0.2\nM103";
    let lines = fillet(Procedure::Bevel, 0.35, text);
    assert_eq!(lines[2], "G1 X20.0 Y0.252 Z0.2 F1080.0");
    assert_eq!(lines[3], "G1 X20.0 Y19.748 Z0.2 F960.0");
    assert_eq!(lines[4], "G1 X19.748 Y20.0 Z0.2");
}

/// stages_tests.md U3 and U4.
#[test]
fn u3_u4_half_a_bead_and_the_arc_in_segments() {
    assert_eq!(
        fillet(Procedure::Bevel, 0.5, CORNER)[1..3],
        ["G1 X19.64 Y0.0 Z0.2 F960.0", "G1 X20.0 Y0.36 Z0.2"]
    );
    // The row's (19.8946, 0.1054), to the micron.
    assert_eq!(
        fillet(Procedure::ArcSegment, 0.5, CORNER)[1..4],
        ["G1 X19.64 Y0.0 Z0.2 F960.0", "G1 X19.895 Y0.105 Z0.2", "G1 X20.0 Y0.36 Z0.2"]
    );
}

/// stages_tests.md U5: the end is absolute, as it is under G90.
#[test]
fn u5_an_arc_ends_where_it_says() {
    assert_eq!(
        fillet(Procedure::ArcPoint, 0.35, CORNER)[1..3],
        ["G1 X19.748 Y0.0 Z0.2 F960.0", "G3 X20.0 Y0.252 Z0.2 I0.0 J0.252"]
    );
    assert_eq!(fillet(Procedure::ArcRadius, 0.35, CORNER)[2], "G3 X20.0 Y0.252 Z0.2 R0.252");
}

/// stages_tests.md U6 and U7.
#[test]
fn u6_u7_short_sides() {
    let corner = |side: &str| format!("G1 X0 Y0 Z0.2\nM101\nG1 X20 Y0 Z0.2\nG1 X20 Y{side} Z0.2\nM103");
    assert_eq!(fillet(Procedure::Bevel, 0.35, &corner("0.2"))[1], "G1 X20.0 Y0.0 Z0.2");
    assert_eq!(
        fillet(Procedure::Bevel, 0.35, &corner("0.6"))[1..3],
        ["G1 X19.8 Y0.0 Z0.2", "G1 X20.0 Y0.2 Z0.2"]
    );
}

#[test]
fn a_travel_that_turns_back_is_slowed_there() {
    let text = "G1 X0 Y0 Z0.2 F1200\nG1 X20 Y0 Z0.2\nG1 X0 Y1 Z0.2\nM101\nG1 X0 Y9 Z0.2\nM103";
    assert_eq!(
        fillet(Procedure::Bevel, 0.35, text)[1..5],
        [
            "G1 X19.64 Y0.0 Z0.2",
            "G1 X20.0 Y0.0 Z0.2 F600.0",
            "G1 X19.64 Y0.018 Z0.2",
            "G1 X0.0 Y1.0 Z0.2 F1200.0"
        ]
    );
}

#[test]
fn an_arc_touches_both_sides_whichever_way_it_turns() {
    for (to, clockwise) in [((30, 17), false), ((30, -17), true), ((5, 9), false), ((5, -9), true)] {
        let at = |x: i32, y: i32| Point3 { x: x * 1000, y: y * 1000, z: 0 };
        let corner = Corner::new(at(0, 0), at(20, 0), at(to.0, to.1), 500.0).expect("a corner");
        assert_eq!(corner.clockwise, clockwise);
        let center = (corner.before.x + corner.center.0, corner.before.y + corner.center.1);
        for end in corner.chords(8).chain([corner.before]) {
            let distance = libm::hypot(f64::from(end.x - center.0), f64::from(end.y - center.1));
            assert!((distance - corner.radius).abs() < 2.0, "{to:?}: {distance} {}", corner.radius);
        }
    }
}
