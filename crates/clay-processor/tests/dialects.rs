//! Files as the programs of potters write them.

use clay_processor::{Habit, Model, Options, Processor, Report, process};

/// Layers and spirals as `start–end@height`.
fn found(model: &Model) -> (Vec<String>, Vec<String>) {
    let runs = |runs: &[clay_processor::Run]| {
        runs.iter()
            .map(|run| {
                let height = run.height.map_or_else(|| String::from("?"), |height| format!("{height:.3}"));
                format!("{}-{}@{height}", run.start_index, run.end_index)
            })
            .collect()
    };
    (runs(&model.layers), runs(&model.spirals))
}

#[track_caller]
fn expect(model: &Model, layers: &[&str], spirals: &[&str]) {
    let (found_layers, found_spirals) = found(model);
    assert_eq!(found_layers, layers, "layers");
    assert_eq!(found_spirals, spirals, "spirals");
}

fn habits(report: &Report) -> Vec<Habit> {
    report.notes.iter().map(|note| note.habit).collect()
}

#[test]
fn cura_layers_change_with_g0() {
    let report = process(
        b";FLAVOR:Marlin\nG28 ;Home\nG92 E0\nG1 F1500 E-6.5\n;LAYER:0\nG0 F3600 X40 Y40 Z1.2\nG1 F1500 E0\n\
          G1 F1200 X60 Y40 E1\nG1 X60 Y60 E2\nG1 X40 Y40 E3\nG1 F1500 E-3.5\n;LAYER:1\nG0 F3600 X40 Y42 Z2.4\n\
          G1 F1500 E3\nG1 F1200 X60 Y40 E4\nG1 X60 Y60 E5\nG1 X40 Y40 E6\nM107\n;End of Gcode\n",
    );
    expect(&report.letter, &[], &[]);
    expect(&report.machine, &["7-9@1.200", "14-16@2.400"], &[]);
    assert_eq!(habits(&report), [Habit::RapidLayerChange]);
    assert_eq!(report.interruptions.count, 1);
    assert!((report.interruptions.longest - (2.0_f64 * 2.0 + 1.2 * 1.2).sqrt()).abs() < 1e-9);
    assert_eq!(report.extruding_lines, 6);
}

#[test]
fn prusaslicer_vase_is_one_spiral_over_its_base() {
    let report = process(
        b"M83\nM203 X200 Y200 Z12\nG1 Z1 F7800\nG1 X0 Y0\nG1 X30 Y0 E3\nG1 X30 Y30 E3\nG1 X0 Y0 E4\n\
          G1 X30 Y0 Z1.25 E3\nG1 X30 Y30 Z1.5 E3\nG92 E0\nG1 X0 Y30 Z1.75 E3\nG1 X0 Y0 Z2 E3\n\
          G1 X30 Y0 Z2.25 E3\nG1 E-2 F2400\nG1 Z10\n",
    );
    expect(&report.letter, &["3-6@1.000"], &["7-8@1.250", "10-12@1.750"]);
    expect(&report.machine, &["4-6@1.000"], &["7-12@1.250"]);
    assert_eq!(habits(&report), [Habit::LeadingTravel, Habit::ResetInSpiral]);
    assert_eq!(report.letter.max_height, 10.0, "an M203 is no move");
    assert_eq!(report.machine.max_height, 2.25);
}

#[test]
fn coilcam_repeats_x_y_z_and_e() {
    let mut text = String::from("G28\nG90\nM83\nG1 F10000 X50 Y50 Z1.5 E0\n");
    for layer in 1..=3 {
        let z = 1.5 * f64::from(layer);
        for (x, y) in [(80, 50), (80, 80), (50, 80), (50, 50)] {
            text.push_str(&format!("G1 F1500 X{x} Y{y} Z{z} E2.5\n"));
        }
    }
    let report = process(text.as_bytes());
    expect(&report.letter, &[], &["3-15@1.500"]);
    expect(&report.machine, &["4-7@1.500", "8-11@3.000", "12-15@4.500"], &[]);
    assert_eq!(habits(&report), [Habit::RepeatedZ, Habit::SilentE]);
}

#[test]
fn fullcontrol_travels_with_e0() {
    let report = process(
        b"M83\nG0 F1000 X0 Y0 Z0.8\nG1 X10 E1\nG1 X20 E1\nG1 X30 Y10 E0\nG1 X40 E1\nG1 X50 E1\nG1 Z20 E0\n",
    );
    expect(&report.letter, &[], &[]);
    expect(&report.machine, &["2-6@0.800"], &[]);
    assert_eq!(report.machine.horizontal_movement_without_extrusion.len(), 1);
    assert_eq!(report.machine.vertical_movement_without_extrusion.len(), 1);
    assert_eq!(habits(&report), [Habit::RapidLayerChange, Habit::SilentE]);
}

#[test]
fn relative_coordinates_climb_as_they_add_up() {
    let report =
        process(b"G92 X0 Y0 Z1\nG91\nM83\nG1 X10 E1\nG1 X-10 E1\nG1 Z1\nG1 X10 E1\nG1 X-10 E1\nG90\nG1 Z9\n");
    expect(&report.letter, &["6-7@1.000"], &[]);
    expect(&report.machine, &["3-4@1.000", "6-7@2.000"], &[]);
    assert!(habits(&report).contains(&Habit::RelativeZ));
}

#[test]
fn relative_moves_from_an_unknown_height_leave_it_unknown() {
    let report = process(b"G28\nG91\nG1 Z10\nG90\nG1 X5 Y5\nG1 X9 E1\nG1 X0 E2\n");
    let lift = report.machine.vertical_movement_without_extrusion[0];
    assert_eq!((lift.from, lift.to), (None, None));
    expect(&report.machine, &["5-6@?"], &[]);
    assert!(!report.ok(), "nobody knows where it prints");
}

#[test]
fn marlin_takes_e_along_with_g91() {
    let text = b"G92 X0 Y0 Z1\nG91\nG1 X10 E1\nG1 X10 E1\nG1 X10 E1\n";
    expect(&process(text).machine, &[], &[]);
    let mut processor = Processor::new(Options { e_follows_g90: true, ..Options::default() });
    processor.push(text);
    expect(&processor.finish().machine, &["2-4@1.000"], &[]);
}

#[test]
fn spelling_does_not_matter() {
    let plain = process(b"G1 Z1\nG1 X10 Y0 E1 ; Zig\nG1 X0 E2.5\nG1 Z2\n");
    expect(&plain.machine, &["1-2@1.000"], &[]);
    for text in [
        "G1 Z1\r\nG1 X10 Y0 E1 ; Zig\r\nG1 X0 E2.5\r\nG1 Z2\r\n",
        "N1 G1 Z1*99\nN2 G1 X10 Y0 E1*5 ; Zig\nN3 G1 X0 E2.5*71\nN4 G1 Z2*3\n",
        "g01z1\ng01x10y0e1;z9\ng01x0e+2.5\ng01z2.",
        "\u{feff}G1(up)Z1\n  G1.0 X (right) 10 Y.0 E1 X99\n\tG1 X-0 E2.50\nG1 Z 2",
    ] {
        assert_eq!(process(text.as_bytes()), plain, "{text}");
    }
}

#[test]
fn a_reset_of_e_in_a_layer_changes_nothing() {
    let report = process(b"G1 Z1\nG1 X10 E5\nG1 X0 E9\nG92 E0\nG1 X10 E4\nG1 X0 E9\nG92 E5\nG1 X10 E5\n");
    expect(&report.machine, &["1-5@1.000"], &[]);
    expect(&report.letter, &["1-7@1.000"], &[]);
    assert_eq!(report.machine.horizontal_movement_without_extrusion.len(), 1);
}

#[test]
fn arcs_print_as_long_as_they_are() {
    let report = process(b"M83\nG1 Z1\nG0 X10 Y0\nG2 I-10 E5\nG3 X-10 Y0 R10 E3\nG0 X0\n");
    expect(&report.letter, &[], &[]);
    expect(&report.machine, &["3-4@1.000"], &[]);
    assert_eq!(habits(&report), [Habit::Arcs]);

    // A flat arc of 2.2 mm between two rises ends the spiral, though its ends are only 1.4 mm apart.
    let climb = |flat: &str| {
        process(
            format!(
                "M83\nG1 X0 Y0 Z1\nG1 X5 Z1.1 E1\nG1 X10 Z1.2 E1\n{flat}\nG1 X15 Y1 Z1.3 E1\nG1 X20 Z1.4 E1\n"
            )
            .as_bytes(),
        )
    };
    expect(&climb("G1 X11 Y1 E1").machine, &[], &["2-6@1.100"]);
    expect(&climb("G3 X11 Y1 J0.7 I0.7 E1").machine, &[], &["2-3@1.100", "5-6@1.300"]);
}

#[test]
fn inches_become_millimetres() {
    let report = process(b"G20\nG1 Z0.1\nG1 X1 E1\nG1 X0 E2\nG21\nG1 Z50.8\n");
    expect(&report.machine, &["2-3@2.540"], &[]);
    assert!((report.machine.max_height - 2.54).abs() < 1e-12);
    assert_eq!(report.letter.max_height, 50.8);
    assert!(habits(&report).contains(&Habit::Inches));
}

#[test]
fn a_wave_vase_falls_and_rises_in_one_spiral() {
    let report = process(
        b"M83\nG1 X0 Y0 Z1\nG1 X10 Z1.5 E1\nG1 Y10 Z1.2 E1\nG1 X0 Z1.9 E1\nG1 Y0 Z1.6 E1\nG1 Z9\n\
          G1 X10 Z8 E1\nG1 X0 Z7 E1\n",
    );
    // The last two lines only fall: no spiral, and no two of them are at one height.
    expect(&report.machine, &[], &["2-5@1.500"]);
}

#[test]
fn flat_lines_after_a_spiral_are_a_layer() {
    let report = process(
        b"M83\nG1 X0 Y0 Z1\nG1 X5 Z1.1 E1\nG1 X10 Z1.2 E1\nG1 X10.5 E1\nG1 X11 E1\nG1 X20 E1\nG1 X30 E1\nG1 Z5\n",
    );
    expect(&report.machine, &["4-7@1.200"], &["2-3@1.100"]);
}

#[test]
fn a_short_flat_stretch_without_a_climb_stays_a_layer() {
    // Up and down again in one go: not higher at the end, so the lines are layers of their heights.
    let report =
        process(b"M83\nG1 X0 Y0 Z1\nG1 X5 Z2 E1\nG1 X6 E1\nG1 X5 Z1 E1\nG1 X4 E1\nG1 X3.5 E1\nG1 Z5\n");
    expect(&report.machine, &["2-3@2.000", "4-6@1.000"], &[]);
}

#[test]
fn only_the_axes_named_are_homed() {
    let report = process(b"G92 X0 Y0 Z3\nG28 X Y\nG1 X5 Y5\nG28 Z0\nG1 X6\n");
    let heights: Vec<_> =
        report.machine.horizontal_movement_without_extrusion.iter().map(|travel| travel.height).collect();
    assert_eq!(heights, [Some(3.0), None]);
}

#[test]
fn printing_at_the_bed_or_below_is_not_ok() {
    assert!(process(b"G1 Z1\nG1 X1 E1\nG1 X2 E2\n").ok());
    assert!(!process(b"G1 Z0\nG1 X1 E1\nG1 X2 E2\n").ok());
    assert!(!process(b"G1 Z-1\nG1 X1 E1\nG1 X2 E2\n").ok());
}

#[test]
fn a_word_that_cannot_be_read_is_told() {
    let report = process(b"G1 Z1\nG1 X E1\nG1 X1.2.3 E2\nG28 X Y\nM117 X\n");
    let told =
        report.notes.iter().find(|note| note.habit == Habit::UnreadWord).map(|note| note.text.as_str());
    assert_eq!(
        told,
        Some("line 2 and 1 more: a word of a move has no number that can be read and is ignored")
    );
}
