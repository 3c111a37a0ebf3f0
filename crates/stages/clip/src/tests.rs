use super::*;
use skein::{Facts, Micron, Reader, Tag};

fn square(kind: &str, low: f64, high: f64) -> String {
    format!(
        "(<{kind}> outer )\nG1 X{low} Y{low} Z0.2\nM101\nG1 X{high} Y{low} Z0.2\nG1 X{high} Y{high} Z0.2\n\
         G1 X{low} Y{high} Z0.2\nG1 X{low} Y{low} Z0.2\nM103\n(</{kind}>)\n"
    )
}

/// The lines of a layer, clipped.
fn clip(over_bead_width: f64, reach: f64, text: &str) -> Vec<String> {
    let mut reader = Reader::default();
    let lines = text.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect();
    let head = vec![Line::Close(Tag::ExtruderInitialization)];
    let mut skein = Skein { head, layers: vec![Layer { lines }], ..Skein::default() };
    skein.state(&Facts { bead_width: Some(Micron(720)), ..Facts::default() }).expect("facts");
    let ratio = |value: f64| Ratio::from_f64(value).expect("a ratio");
    let stage =
        Clip { over_bead_width: ratio(over_bead_width), maximum_connection_over_bead_width: ratio(reach) };
    let skein = stage.craft(skein, &mut Notes::default()).expect("clip");
    let text = String::from_utf8(skein.write()).expect("text");
    text.lines().filter(|line| line.starts_with(['G', 'M'])).map(str::to_owned).collect()
}

/// What SFACT cuts at a ratio of 0.5 and h = 0.4: 0.5 · 0.4 · π/4 of 0.72 mm.
const SFACT: f64 = 0.5 * 0.4 * std::f64::consts::FRAC_PI_4 / 0.72;

/// stages_tests.md K1 and K2 (our measure is the bead width; K2's cut is asked for in it).
#[test]
fn k1_k2_both_ends_are_cut() {
    let lines = clip(0.5, 0.0, &square("edge", 0.36, 19.64));
    assert_eq!((lines[0].as_str(), lines[5].as_str()), ("G1 X0.72 Y0.36 Z0.2", "G1 X0.36 Y0.72 Z0.2"));
    assert_eq!(clip(SFACT, 0.0, &square("edge", 0.36, 19.64))[0], "G1 X0.517 Y0.36 Z0.2");
}

/// stages_tests.md K3: no more than three tenths at either end, as much at the one as at the other.
#[test]
fn k3_a_small_loop_keeps_its_middle() {
    let lines = clip(0.5, 0.0, &square("edge", 0.0, 0.25));
    assert_eq!(lines[0], "G1 X0.25 Y0.05 Z0.2");
    assert_eq!(lines[lines.len() - 2], "G1 X0.05 Y0.25 Z0.2");
}

/// stages_tests.md K4 to K7.
#[test]
fn k4_to_k7_neighbours_are_joined_where_nothing_is_in_the_way() {
    let threads = |cut: f64, reach: f64, kinds: [&str; 2]| {
        let text = square(kinds[0], 1.08, 18.92) + &square(kinds[1], 1.8, 18.2);
        clip(cut, reach, &text)
    };
    let stops = |lines: &[String]| lines.iter().filter(|line| *line == "M103").count();
    let joined = threads(SFACT, 10.0, ["loop", "loop"]);
    assert_eq!(stops(&joined), 1);
    let joint = joined.iter().position(|line| line == "G1 X1.08 Y1.237 Z0.2").expect("the end of the first");
    assert_eq!(joined[joint + 1], "G1 X1.957 Y1.8 Z0.2");
    assert_eq!(stops(&threads(0.5, 10.0, ["loop", "loop"])), 2, "K5");
    assert_eq!(stops(&threads(SFACT, 0.0, ["loop", "loop"])), 2, "K6");
    assert_eq!(stops(&threads(SFACT, 10.0, ["loop", "edge"])), 2, "K7");
}

#[test]
fn a_joint_never_crosses_an_outline() {
    let mut wall = String::from("(<boundaryPerimeter>)\n");
    for (x, y) in [(1.5, 0.0), (1.5, 30.0), (-9.0, 30.0), (-9.0, 0.0)] {
        wall += &format!("(<boundaryPoint> X{x} Y{y} Z0.2 </boundaryPoint>)\n");
    }
    wall += "(</boundaryPerimeter>)\n";
    let text = wall + &square("loop", 1.08, 18.92) + &square("loop", 1.8, 18.2);
    assert_eq!(clip(SFACT, 10.0, &text).iter().filter(|line| *line == "M103").count(), 2);
}
