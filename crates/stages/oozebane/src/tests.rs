use super::*;

/// Threads of 20 mm in four pieces, each at its own place, after a travel from (0, 50).
fn print(starts: &[f64]) -> Skein {
    let mut text = String::from(
        "(<operatingFeedRatePerSecond> 16.0 </operatingFeedRatePerSecond>)\n(<edgeWidth> 0.72 </edgeWidth>)\n\
         (</extruderInitialization>)\n(<layer> 0.2 )\nG1 X0 Y50 Z0.2 F1200\n",
    );
    for start in starts {
        text += &format!("G1 X{start} Y0 Z0.2 F1200\nM101\n");
        for piece in 1..=4 {
            text += &format!("G1 X{} Y0 Z0.2 F960\n", start + 5.0 * f64::from(piece));
        }
        text += "M103\n";
    }
    Skein::read((text + "(</layer>)\n").as_bytes()).expect("a skein")
}

fn craft() -> Oozebane {
    Oozebane {
        early_shutdown_distance: OrLag::Is(Micron(1200)),
        early_startup_maximum_distance: OrLag::Is(Micron(1200)),
        early_startup_distance_constant: OrLag::Is(Micron(20_000)),
        first_early_startup_distance: OrLag::Is(Micron(25_000)),
        after_startup_distance: Micron(1200),
        ends: Ends::Slow,
        ..Oozebane::default()
    }
}

fn lines(stage: &Oozebane, skein: Skein) -> Vec<String> {
    let skein = stage.craft(skein, &mut Notes::default()).expect("oozebane");
    assert_eq!(skein.verify(), Ok(()));
    String::from_utf8(skein.write()).expect("text").lines().skip(5).map(str::to_owned).collect()
}

/// stages_tests.md Z1 to Z3.
#[test]
fn z1_to_z3_both_ends_of_the_first_thread() {
    assert_eq!(
        lines(&craft(), print(&[0.0])),
        [
            "G1 X0.0 Y25.0 Z0.2",
            "M101",
            "G1 X0.0 Y0.0 Z0.2 F960.0",
            "G1 X0.4 Y0.0 Z0.2 F480.0",
            "G1 X0.8 Y0.0 Z0.2 F800.0",
            "G1 X1.2 Y0.0 Z0.2 F960.0",
            "G1 X5.0 Y0.0 Z0.2",
            "G1 X10.0 Y0.0 Z0.2",
            "G1 X15.0 Y0.0 Z0.2",
            "G1 X18.8 Y0.0 Z0.2",
            "M103",
            "G1 X19.4 Y0.0 Z0.2 F480.0",
            "G1 X20.0 Y0.0 Z0.2 F160.0",
            "(</layer>)"
        ]
    );
}

/// stages_tests.md Z4 and Z5: the distance of a start follows from its own travel (D21).
#[test]
fn z4_z5_how_early_a_later_thread_starts() {
    for (gap, x) in [(1.0, "20.941"), (20.0, "39.241")] {
        let lines = lines(&craft(), print(&[0.0, 20.0 + gap]));
        let on = lines.iter().rposition(|line| line == "M101").expect("a start");
        assert_eq!(lines[on - 1], format!("G1 X{x} Y0.0 Z0.2 F1200.0"));
    }
}

/// stages_tests.md Z6.
#[test]
fn z6_after_a_short_travel_the_ramp_is_shorter() {
    let stage = Oozebane { minimum_distance_for_early_startup: Micron(2000), ..craft() };
    let lines = lines(&stage, print(&[0.0, 21.0]));
    let on = lines.iter().rposition(|line| line == "M101").expect("a start");
    assert_eq!(lines[on + 2..on + 4], ["G1 X21.3 Y0.0 Z0.2 F720.0", "G1 X21.6 Y0.0 Z0.2 F960.0"]);
}

/// stages_tests.md Z7.
#[test]
fn z7_a_thread_of_one_piece_stops_early_too() {
    let text = String::from_utf8(print(&[]).write()).expect("text");
    let text = text.replace("(</layer>)", "G1 X0 Y0 Z0.2\nM101\nG1 X20 Y0 Z0.2 F960\nM103\n(</layer>)");
    let lines = lines(&craft(), Skein::read(text.as_bytes()).expect("a skein"));
    let off = lines.iter().position(|line| line == "M103").expect("a stop");
    assert_eq!(lines[off - 1], "G1 X18.8 Y0.0 Z0.2");
}

#[test]
fn the_travel_of_a_start_reaches_back_through_the_layers_below() {
    let text = String::from_utf8(print(&[0.0]).write()).expect("text");
    let text = text.replace(
        "(</layer>)",
        "(</layer>)\n(<layer> 0.6 )\nG1 X40 Y0 Z0.2\n(</layer>)\n(<layer> 1.0 )\nG1 X40 Y20 Z0.2\nM101\n\
         G1 X60 Y20 Z0.2\nM103\n(</layer>)",
    );
    let stage = Oozebane { ends: Ends::Even, ..craft() };
    let lines = lines(&stage, Skein::read(text.as_bytes()).expect("a skein"));
    // 20 mm below and 20 mm here: 1.2 (1 - e^-2) = 1.0376.
    assert!(lines.iter().any(|line| line.starts_with("G1 X40.0 Y18.962 Z0.2")), "{lines:?}");
}
