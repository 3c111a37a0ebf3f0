//! `clayforge emulate` on files of our own slicer and on what is no such file.

use crate::command::Room;
use crate::support::{example, text_of};
use serde_json::Value as Json;

const PRINT: &str = "\
M83
G1 Z1.5 F600
G1 X10 Y10 F6000
G1 X60 E150 F1800
G1 Y60 E150
G4 P500
G1 X10 E150
";

/// A room with a cup that was sliced in it.
fn room() -> Room {
    let room = Room::new();
    room.put("cup.stl", example("cup"));
    room.run(&["slice", "cup.stl", "-o", "cup.gcode", "--report", "cup.json", "--quiet"]).done();
    room
}

fn json(room: &Room, words: &[&str]) -> Json {
    serde_json::from_str(&room.run(words).done().out()).expect("JSON")
}

fn number(report: &Json, key: &str) -> f64 {
    report[key].as_f64().unwrap_or_else(|| panic!("{key} is {}", report[key]))
}

#[test]
fn the_json_has_the_keys_that_scripts_read() {
    let room = Room::new();
    room.put("print.gcode", PRINT);
    let words = ["emulate", "print.gcode", "--acceleration", "500", "--motion", "constant", "--json"];
    let report = json(&room, &words);
    let mut keys: Vec<&str> = report.as_object().expect("an object").keys().map(String::as_str).collect();
    keys.sort_unstable();
    assert_eq!(
        keys,
        [
            "bounds",
            "commands",
            "deposition_length",
            "diagnostics",
            "dwell_time",
            "mass",
            "moving_time",
            "n_layers",
            "path_length",
            "total_time",
            "travel_length",
            "volume"
        ]
    );
    assert_eq!(report["commands"], 7);
    assert_eq!(number(&report, "dwell_time"), 0.5);
    assert_eq!(number(&report, "deposition_length"), 150.0);
    assert_eq!(report["bounds"]["max"], serde_json::json!([60.0, 60.0, 1.5]));
    assert_eq!(report["diagnostics"], serde_json::json!([]));
    let sum = number(&report, "moving_time") + number(&report, "dwell_time");
    assert!((number(&report, "total_time") - sum).abs() < 1e-9);
    // At the set speed the beads take 5 s and nobody knows from where the first move comes; with corners it takes longer, and without jerk at the ends still more.
    let times: Vec<f64> = ["constant", "trapezoid", "scurve"]
        .iter()
        .map(|motion| {
            let words = ["emulate", "print.gcode", "--acceleration", "500", "--motion", motion, "--json"];
            number(&json(&room, &words), "total_time")
        })
        .collect();
    assert!((times[0] - 5.5).abs() < 1e-9 && times[0] < times[1] && times[1] < times[2], "{times:?}");
    let patient = ["emulate", "print.gcode", "--acceleration", "500", "--junction-deviation", "0", "--json"];
    assert!(number(&json(&room, &patient), "total_time") > times[1]);
}

#[test]
fn a_machine_may_cruise_through_short_moves() {
    let room = Room::new();
    room.put("print.gcode", "G91\nG1 X1.5 F6000\n").put("klipper.toml", "[motion]\ncruise_ratio = 0.5\n");
    let time = |machine: &str| {
        number(&json(&room, &["emulate", "print.gcode", "--machine", machine, "--json"]), "total_time")
    };
    // 500 mm/s²: up and down again, and half of the way at the top speed.
    let top = (250.0f64 * 1.5).sqrt();
    assert!((time("clay") - 2.0 * (1.5f64 / 500.0).sqrt()).abs() < 1e-9);
    assert!((time("klipper.toml") - (2.0 * top / 500.0 + 0.75 / top)).abs() < 1e-9);
}

#[test]
fn slice_and_emulate_agree_about_the_time() {
    let room = room();
    let report: Json = serde_json::from_str(&text_of(&room.path("cup.json"))).expect("JSON");
    let found = json(&room, &["emulate", "cup.gcode", "--machine", "clay", "--json"]);
    assert!((number(&found, "total_time") - number(&report, "time_s")).abs() < 1e-6);
    // A bead of less clay than the last decimal of E is a travel by its letters: some microns of metres.
    assert!((number(&found, "deposition_length") - number(&report, "extruded_mm")).abs() < 0.01);
    assert!((number(&found, "mass") / number(&report, "mass_g") - 1.0).abs() < 1e-3);
    assert_eq!(found["n_layers"], report["layers"]);
    // Nothing in a file of our own is doubtful.
    assert_eq!(found["diagnostics"], serde_json::json!([]));
    room.run(&["emulate", "cup.gcode", "--strict"]).done();
}

#[test]
fn every_file_is_written_in_its_form() {
    let room = room();
    let words = ["emulate", "cup.gcode", "--csv", "cup.csv", "--events", "cup.events", "--vtk", "cup.vtp"];
    room.run(&["emulate", "cup.gcode", "--parquet", "cup.parquet", "--arrow", "cup.arrow"]).done();
    room.run(&[&words[..], &["--picture", "cup.svg", "--color", "time", "--view", "layer=3"]].concat())
        .done();
    room.run(&["emulate", "cup.gcode", "--events", "cup.inp", "--vtk", "cup.vtk"]).done();
    let csv = text_of(&room.path("cup.csv"));
    let mut lines = csv.lines();
    let header = lines.next().expect("a header");
    assert!(header.starts_with("line,command,action,x,y,z,feedrate,time,"), "{header}");
    let columns = header.split(',').count();
    assert!(lines.all(|line| line.split(',').count() == columns));
    let commands = json(&room, &["emulate", "cup.gcode", "--json"])["commands"].as_u64();
    assert_eq!(Some(csv.lines().count() as u64 - 1), commands);
    let events = text_of(&room.path("cup.events"));
    assert!(
        events.lines().all(|line| line.split(',').filter(|cell| cell.parse::<f64>().is_ok()).count() == 5)
    );
    assert!(text_of(&room.path("cup.inp")).starts_with("*EVENT SERIES TYPE"));
    let begins = |name: &str, with: &[u8]| {
        let bytes = std::fs::read(room.path(name)).expect("it was written");
        assert!(bytes.starts_with(with), "{name}");
    };
    begins("cup.vtp", b"<?xml");
    begins("cup.vtk", b"# vtk DataFile");
    begins("cup.parquet", b"PAR1");
    begins("cup.arrow", b"ARROW1");
    let svg = text_of(&room.path("cup.svg"));
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>") && svg.contains(">time<"));
}

#[test]
fn what_is_wrong_is_told_and_strict_stops_at_it() {
    let room = Room::new();
    room.put("bad.gcode", "M83\nG1 X1,5 F600\nG1 X10 E1\n");
    let ran = room.run(&["emulate", "bad.gcode"]).done();
    assert!(ran.err.contains("line 2, column 4"), "{}", ran.err);
    let ran = room.run(&["emulate", "bad.gcode", "--strict", "--csv", "bad.csv"]);
    assert_eq!(ran.code, Some(1));
    assert!(ran.err.contains("bad.gcode: 2:4"), "{}", ran.err);
    assert!(!room.path("bad.csv").exists());
    let report = json(&room, &["emulate", "bad.gcode", "--json"]);
    assert_eq!(
        (&report["diagnostics"][0]["line"], &report["diagnostics"][0]["column"]),
        (&2.into(), &4.into())
    );
}

#[test]
fn what_is_no_gcode_is_refused() {
    let room = Room::new();
    room.put("packed.gcode", b"\x1f\x8b\x08\0\0\0\0\0").put("binary.gcode", b"GCDE\x01\0\0\0");
    for (words, why) in [
        (&["emulate", "packed.gcode"][..], "gzip"),
        (&["emulate", "binary.gcode"], "bgcode"),
        (&["emulate", "missing.gcode"], "there is no such file"),
        (&["emulate", "-", "--flavor", "abacus"], "there is no flavor `abacus`"),
        (&["emulate", "-", "--picture", "x.svg"], "nothing is deposited"),
        (&["emulate", "-", "--machine", "no-such-profile"], "no-such-profile"),
    ] {
        let ran = room.feed(words, b"");
        assert_eq!(ran.code, Some(1), "{words:?}: {}", ran.err);
        assert!(ran.err.contains(why), "{words:?}: {}", ran.err);
    }
    room.put("print.gcode", PRINT);
    let ran = room.run(&["emulate", "print.gcode", "--picture", "x.svg", "--color", "mood"]);
    assert!(ran.err.contains("no column of numbers `mood`") && ran.err.contains("speed_peak"), "{}", ran.err);
    for words in [["--view", "side"], ["--acceleration", "0"], ["--junction-deviation", "nan"]] {
        let ran = room.run(&[&["emulate", "print.gcode"][..], &words].concat());
        assert_eq!(ran.code, Some(2), "{words:?}: {}", ran.err);
    }
}

#[test]
fn a_flavor_of_ones_own_is_a_file() {
    let room = Room::new();
    room.put("print.gcode", "G4 P2\n").put("seconds.toml", "inherits = \"marlin\"\ndwell = [\"P s\"]\n");
    let dwell = |words: &[&str]| {
        number(&json(&room, &[&["emulate", "print.gcode", "--json"], words].concat()), "dwell_time")
    };
    assert_eq!(dwell(&["--flavor", "marlin"]), 0.002);
    assert_eq!(dwell(&["--flavor", "seconds.toml"]), 2.0);
    room.put("wrong.toml", "dwell = [\"P h\"]\n");
    let ran = room.run(&["emulate", "print.gcode", "--flavor", "wrong.toml"]);
    assert!(ran.code == Some(1) && ran.err.contains("wrong.toml: 1:9"), "{}", ran.err);
}
