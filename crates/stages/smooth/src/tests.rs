use super::*;
use proptest::prelude::*;
use skein::{Facts, Micron};

/// A zig-zag of strokes of so many mm, 0.72 mm apart, on one layer behind a number of empty ones.
fn zigzag(stroke: f64, below: usize) -> Skein {
    let mut text = String::from("(</extruderInitialization>)\n");
    text += &"(<layer> 0.0 )\n(</layer>)\n".repeat(below);
    text += "(<layer> 0.6 )\n(<infill>)\nG1 X0 Y0 Z0.6 F1200\nM101\n";
    let mut y = 0.0;
    for line in 0..8 {
        if line > 0 {
            text += &format!("G1 X{:.2} Y{y:.3} Z0.6 F960\n", 0.72 * f64::from(line));
        }
        y = stroke - y;
        text += &format!("G1 X{:.2} Y{y:.3} Z0.6 F960\n", 0.72 * f64::from(line));
    }
    text += "M103\n(</infill>)\n(</layer>)\n";
    let mut skein = Skein::read(text.as_bytes()).expect("a skein");
    skein.state(&Facts { infill_width: Some(Micron(720)), ..Facts::default() }).expect("facts");
    skein
}

fn craft(skein: Skein) -> Skein {
    let skein = Smooth::default().craft(skein, &mut Notes::default()).expect("smooth");
    assert_eq!(skein.verify(), Ok(()));
    skein
}

/// Length, clay by length and flow, and time of all beads, in mm and minutes.
fn sums(skein: &Skein) -> (f64, f64, f64) {
    let mut nozzle = Nozzle::default();
    let mut sums = (0.0, 0.0, 0.0);
    for line in skein.lines() {
        let (from, on) = (nozzle.at, nozzle.on);
        nozzle.follow(line);
        if let (true, Some(from), Some(feed)) = (on, from, nozzle.feed) {
            let length = line.length(from) / 1000.0;
            sums.0 += length;
            sums.1 += length * nozzle.flow.f64();
            sums.2 += length / feed.mm_per_s();
        }
    }
    sums
}

/// stages_tests.md SM1: the length falls from 1.32 to 0.72 a step, and the flow makes up for it.
#[test]
fn sm1_jags_become_their_middle_line() {
    let raw = zigzag(0.6, 1);
    let done = craft(raw.clone());
    let steps: Vec<_> = done.lines().filter_map(Line::as_move).collect();
    let line = &steps[2..9];
    assert!(line.iter().all(|step| step.to.y == 300));
    assert_eq!(
        line.iter().map(|step| step.to.x).collect::<Vec<_>>(),
        [720, 1440, 2160, 2880, 3600, 4320, 5040]
    );
    assert_eq!(line[0].feed.map(|feed| feed.to_string()), Some("523.636".to_owned()));
    assert!(done.lines().any(|line| *line == Line::Flow(Ratio(1_833_333))));
    let (before, after) = (sums(&raw), sums(&done));
    assert!((before.0 - after.0 - 7.0 * 0.6).abs() < 1e-9);
    assert!((before.1 - after.1).abs() < 1e-5 && (before.2 - after.2).abs() < 1e-5);
}

/// stages_tests.md SM2: 1.0 would be lost, and 0.864 may be.
#[test]
fn sm2_long_strokes_stay() {
    assert_eq!(craft(zigzag(1.0, 1)), zigzag(1.0, 1));
}

/// stages_tests.md SM3.
#[test]
fn sm3_low_layers_stay() {
    assert_eq!(craft(zigzag(0.6, 0)), zigzag(0.6, 0));
}

proptest! {
    /// Whatever the strokes are, the clay stays.
    #[test]
    fn the_clay_stays(steps in prop::collection::vec((0..3000_i32, 0..900_i32), 2..40)) {
        let mut text = String::from("(</extruderInitialization>)\n(<layer> 0.2 )\n(</layer>)\n(<layer> 0.6 )\n(<infill>)\nG1 X0 Y0 Z0.6 F1200\nM101\n");
        let (mut x, mut up) = (0, false);
        for (stroke, pitch) in steps {
            let y = if up { 0 } else { stroke };
            up = !up;
            text += &format!("G1 X{} Y{} Z0.6 F960\n", Micron(x), Micron(y));
            x += pitch;
            text += &format!("G1 X{} Y{} Z0.6 F960\n", Micron(x), Micron(y));
        }
        text += "M103\n(</infill>)\n(</layer>)\n";
        let mut raw = Skein::read(text.as_bytes()).expect("a skein");
        raw.state(&Facts { infill_width: Some(Micron(720)), ..Facts::default() }).expect("facts");
        let done = craft(raw.clone());
        let (before, after) = (sums(&raw), sums(&done));
        prop_assert!((before.1 - after.1).abs() < 0.002 * before.1.max(1.0), "{} {}", before.1, after.1);
        prop_assert!(after.0 <= before.0 + 0.1);
    }
}
