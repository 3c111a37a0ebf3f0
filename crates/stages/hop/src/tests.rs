use super::*;
use skein::{Micron, Reader, Tag};

const ON: &str = "G1 X0 Y0 Z0.2\nM101\nG1 X10 Y0 Z0.2\nM103\n";

fn places(hop: &Hop, height: i32, text: &str) -> Vec<(f64, f64)> {
    let mut reader = Reader::default();
    let lines = format!("{ON}{text}\nM101\nG1 X90 Y0 Z0.2\nM103");
    let lines = lines.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect();
    let head = vec![Line::Close(Tag::ExtruderInitialization)];
    let mut skein = Skein { head, layers: vec![Layer { lines }], ..Skein::default() };
    let facts =
        Facts { layer_height: Some(Micron(height)), bead_width: Some(Micron(720)), ..Facts::default() };
    skein.state(&facts).expect("facts");
    let skein = hop.craft(skein, &mut Notes::default()).expect("hop");
    let steps: Vec<Point3> = skein.lines().filter_map(Line::as_move).map(|step| step.to).collect();
    let mm = |microns: i32| f64::from(microns) / 1000.0;
    steps[2..steps.len() - 1].iter().map(|at| (mm(at.x), mm(at.z))).collect()
}

fn hop(over_layer_height: f64, degrees: f64) -> Hop {
    Hop {
        over_layer_height: Ratio::from_f64(over_layer_height).expect("a ratio"),
        minimum_angle: Angle::from_degrees(degrees).expect("an angle"),
        minimum_travel: Ratio(0),
    }
}

/// stages_tests.md Q1 to Q3.
#[test]
fn q1_to_q3_up_across_and_down() {
    assert_eq!(places(&hop(1.0, 30.0), 400, "G1 X20"), [(10.693, 0.6), (19.307, 0.6), (20.0, 0.2)]);
    assert_eq!(places(&hop(1.5, 30.0), 400, "G1 X20"), [(11.039, 0.8), (18.961, 0.8), (20.0, 0.2)]);
    assert_eq!(places(&hop(1.0, 20.0), 400, "G1 X20")[1], (18.901, 0.6));
}

/// stages_tests.md Q4.
#[test]
fn q4_a_short_travel_rises_over_five_twelfths_of_it() {
    assert_eq!(places(&hop(1.0, 30.0), 400, "G1 X11"), [(10.417, 0.6), (10.583, 0.6), (11.0, 0.2)]);
}

/// stages_tests.md Q5.
#[test]
fn q5_a_travel_of_two_parts_stays_up_until_its_end() {
    assert_eq!(
        places(&hop(1.0, 30.0), 400, "G1 X14\nG1 X20"),
        [(10.693, 0.6), (14.0, 0.6), (19.307, 0.6), (20.0, 0.2)],
    );
}

/// stages_tests.md Q7 and Q8.
#[test]
fn q7_q8_the_top_is_above_the_higher_end() {
    assert_eq!(places(&hop(1.0, 30.0), 400, "G1 X20 Z0.6"), [(10.693, 1.0), (19.307, 1.0), (20.0, 0.6)]);
    assert_eq!(places(&hop(1.5, 90.0), 2000, "G1 X20"), [(10.0, 3.2), (20.0, 3.2), (20.0, 0.2)]);
}

/// stages_tests.md Q6: where clay flows nothing is moved.
#[test]
fn q6_beads_stay_where_they_are() {
    let text = "G1 X20\nM101\nG1 X30 Y0 Z0.2\nG1 X30 Y9 Z0.2\nM103\nG1 X50";
    assert_eq!(
        places(&hop(1.0, 90.0), 400, text),
        [
            (10.0, 0.6),
            (20.0, 0.6),
            (20.0, 0.2),
            (30.0, 0.2),
            (30.0, 0.2),
            (30.0, 0.6),
            (50.0, 0.6),
            (50.0, 0.2)
        ],
    );
}
