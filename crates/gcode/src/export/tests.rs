use super::*;
use crate::parse::Parser;

fn exported(from: &str, to: &str, text: &str) -> (String, Vec<String>) {
    let (from, to) = (Flavor::named(from).expect("built in"), Flavor::named(to).expect("built in"));
    let mut exporter = GcodeExporter::new(to).from_flavor(from);
    let mut out = Vec::new();
    Parser::new(from).read(text.as_bytes(), |step| exporter.line(&step, &mut out));
    let problems = exporter.diagnostics().list().iter().map(ToString::to_string).collect();
    (String::from_utf8(out).expect("text"), problems)
}

#[track_caller]
fn becomes(from: &str, to: &str, text: &str, expected: &str) {
    let (found, problems) = exported(from, to, text);
    assert_eq!(found.trim_end(), expected, "{from} to {to}: {text}");
    assert_eq!(problems, [""; 0], "{from} to {to}: {text}");
}

#[test]
fn a_program_of_one_machine_is_written_for_another() {
    becomes("marlin", "cincinnati", "G1 X25.4 Y-50.8 F1524\nG4 P1500", "G1 X1 Y-2 F60\nG4 P1.5");
    becomes("cincinnati", "marlin", "G0 X1 F60\n(a [cup])\nG4 P2", "G0 X25.4 F1524\n;a [cup]\nG4 S2");
    becomes("marlin", "cincinnati", "G92 X25.4 E0", "G92 X1 E0");
    becomes("grbl", "siemens", "G21\nG2 X5 R3 F60\nG59", "G71\nG2 X5 CR=3 F60\nG506");
    becomes("klipper", "marlin", "G1 X5 E-0.00001\nT1\nG28 X Y", "G1 X5 E-0.00001\nT1\nG28 X Y");
    becomes("marlin", "rs274", "G2 X5 I1 P2", "G2 X5 I1 J0 P3");
    becomes("grbl", "marlin", "M3 S600\nG1 X1\nG1 X2 S900", "M3 S600\nG1 X1\nG1 X2 S900");
}

#[test]
fn what_cannot_be_said_is_a_remark_and_a_diagnostic() {
    for (from, to, text, expected, problem) in [
        ("marlin", "grbl", "G1 X5 E1", "; not said: how much to extrude\nG1 X5", "how much to extrude"),
        ("marlin", "cincinnati", "G1 E1", "( not said: how much to extrude)", "how much to extrude"),
        ("marlin", "klipper", "G2 X5 R3", "; not said: an arc by its radius\nG1 X5", "an arc by its radius"),
        (
            "cincinnati",
            "marlin",
            "M3 S60",
            "; not said: how fast to turn the screw",
            "how fast to turn the screw",
        ),
        (
            "siemens",
            "marlin",
            "BEAD_AREA=12",
            "; not said: how large a bead to lay",
            "how large a bead to lay",
        ),
        ("siemens", "grbl", "G4 S3", "; not said: how long to wait", "how long to wait"),
        ("siemens", "grbl", "G500", "; not said: a system of coordinates", "a system of coordinates"),
        ("grbl", "marlin", "G93", "; not said: another unit of the feed", "another unit of the feed"),
        ("grbl", "cincinnati", "M3 S60", "( not said: how fast to mill)", "how fast to mill"),
        (
            "cincinnati",
            "marlin",
            "M69",
            "; not said: a pause with the extruder running",
            "a pause with the extruder running",
        ),
        (
            "klipper",
            "marlin",
            "SET_VELOCITY_LIMIT ACCEL=5",
            "; not said: what only the other machine knows",
            "what only the other machine knows",
        ),
        (
            "marlin",
            "reprapfirmware",
            "M203 X5",
            "; not said: what only the other machine knows",
            "what only the other machine knows",
        ),
    ] {
        let (found, problems) = exported(from, to, text);
        assert_eq!(found.trim_end(), expected, "{text}");
        assert_eq!(problems, [format!("line 1: {problem}")], "{text}");
    }
}

#[test]
fn positions_survive_a_machine_that_counts_in_inches() {
    let text = "G1 X12.345 Y-7.89 Z0.6 F1800\nG1 X100.001 Y33.3333\nG3 X90 Y20 I-5.5 J1\n";
    let (there, _) = exported("marlin", "cincinnati", text);
    let (back, _) = exported("cincinnati", "marlin", &there);
    let places = |text: &str| {
        let mut found = Vec::new();
        Parser::new(&Flavor::default()).read(text.as_bytes(), |step| {
            let row = Row::of(&step);
            found.push([row.x.or(0.0), row.y.or(0.0), row.z.or(0.0), row.first.or(0.0)]);
        });
        found
    };
    let (before, after) = (places(text), places(&back));
    assert_eq!(before.len(), after.len());
    // A ten-thousandth of an inch.
    let off = before.iter().flatten().zip(after.iter().flatten()).map(|(a, b)| (a - b).abs());
    assert!(off.fold(0.0, f64::max) < 0.00254);
}
