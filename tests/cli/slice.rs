//! What `slice` writes.

use crate::command::{Room, assert_message};
use crate::support::{FINE, clay, cuboid, example, name_of, sliced, stl, text_of, text_stl, tube};
use clayforge::{Form, Profile, STAGES, Station};
use serde_json::Value as Json;
use std::fs;
use std::io::Read;
use std::process::{ChildStdout, Stdio};

#[test]
fn slice_writes_the_file_of_the_library_beside_the_part() {
    let room = Room::new();
    room.put("pair.stl", example("pair"));
    let ran = room.run(&["slice", "pair.stl"]).done();
    assert!(ran.out.is_empty(), "results go to the file");
    assert!(ran.err.contains("layers") && ran.err.contains("pair.gcode"), "no summary: {}", ran.err);
    assert_eq!(room.listing().keys().collect::<Vec<_>>(), ["pair.gcode", "pair.stl"]);
    let expected = sliced("pair", &example("pair"), &clay(&[]));
    assert!(room.listing()["pair.gcode"] == expected.gcode(), "the command and the library differ");
    let checked = room.run(&["check", "pair.gcode"]).done();
    assert!(checked.out().ends_with("ok\n"), "{}", checked.out());
    let json: Json =
        serde_json::from_slice(&room.run(&["check", "pair.gcode", "--json"]).done().out).expect("JSON");
    for key in ["letter", "machine", "notes", "ok"] {
        assert!(json.get(key).is_some(), "no {key}");
    }
    for key in [
        "first_part_comments_end",
        "last_part_comments_start",
        "max_height",
        "layers",
        "spirals",
        "horizontal_movement_without_extrusion",
        "vertical_movement_without_extrusion",
        "diagonal_movement_without_extrusion",
    ] {
        assert!(json["machine"].get(key).is_some() && json["letter"].get(key).is_some(), "no {key}");
    }
    assert_eq!(json["ok"], Json::Bool(true));
}

/// A start or an end that endangers the machine is found in the finished file, which then does not appear.
#[test]
fn slice_refuses_what_it_wrote_when_it_breaks_a_rule() {
    for (set, says) in [
        ("alteration.start=G28\nG1 Z-1 F600", "the nozzle goes to z -1"),
        ("alteration.end=M84\nG1 X50 Y50 E500 F600", "after the motors were switched off"),
        ("alteration.end=G91\nG1 Z40\nG90\nG1 X50 Y50 E500 F600", "mm above all that stands"),
    ] {
        let room = Room::new();
        room.put("cube.stl", example("cube"));
        let ran = room.run(&["slice", "cube.stl", "--set", set]);
        assert_eq!(ran.code, Some(1), "{set}: {}", ran.err);
        assert_message(&ran.err, &["check", "must not be printed", says]);
        assert_eq!(room.listing().keys().collect::<Vec<_>>(), ["cube.stl"], "{set}");
    }
}

#[test]
fn check_tells_what_must_not_be_printed_from_what_is_only_worth_knowing() {
    let room = Room::new();
    room.put(
        "mine.toml",
        "[machine]\nbed = [100, 100, 50]\n[carve]\nlayer_height = 1\nfirst_layer_height = 1\n",
    );
    let layer =
        |z: u32, x: u32| format!("G0 X{x} Y10 Z{z} F3000\nG1 X50 E1 F900\nG1 Y50 E1\nG1 X{x} Y10 E1\n");
    let sound = format!("M83\nM302 P1\nG28\n{}{}", layer(1, 10), layer(2, 10));
    let outside = format!("M104 S200\n{sound}{}", layer(3, 110));
    for (name, text, ok, rules) in [
        ("sound.gcode", &sound, true, vec!["interrupted"]),
        ("outside.gcode", &outside, false, vec!["outside_bed", "heats", "travel_outside", "interrupted"]),
    ] {
        room.put(name, text);
        let ran = room.run(&["check", name, "--profile", "mine.toml", "--json"]);
        assert_eq!(ran.code, Some(i32::from(!ok)), "{name}: {}", ran.err);
        let json: Json = serde_json::from_slice(&ran.out).expect("JSON");
        assert_eq!(json["ok"], Json::Bool(ok), "{name}");
        let found: Vec<&str> = json["verdicts"]
            .as_array()
            .expect("a list")
            .iter()
            .filter_map(|verdict| verdict["rule"].as_str())
            .collect();
        assert_eq!(found, rules, "{name}");
        let text = room.run(&["check", name, "--profile", "mine.toml"]);
        assert_eq!(text.code, ran.code, "{name}");
        assert_eq!(text.out().contains("fault: "), !ok, "{}", text.out());
        assert!(text.out().ends_with(if ok { "\nok\n" } else { "not ok\n" }), "{}", text.out());
    }
    // Without a profile nobody knows the bed, and a heater is only doubtful.
    assert!(room.run(&["check", "outside.gcode"]).done().out().contains("warning: line 1: a heater is set"));
}

#[test]
fn a_dash_is_standard_output_and_quiet_is_quiet() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    let ran = room.run(&["slice", "cube.stl", "-o", "-", "--quiet"]).done();
    assert!(ran.err.is_empty(), "{}", ran.err);
    assert!(ran.out == sliced("cube", &example("cube"), &clay(&[])).gcode(), "the file is another");
    assert_eq!(room.listing().len(), 1, "nothing is written beside it");
}

#[test]
fn the_number_of_threads_and_the_language_make_no_difference() {
    let room = Room::new();
    room.put("pair.stl", example("pair"));
    let expected = room.run(&["slice", "pair.stl", "-o", "-"]).done().out;
    for (threads, language) in [("1", "C"), ("2", "de_DE.UTF-8"), ("3", "tr_TR.UTF-8")] {
        let mut command = room.command(&["slice", "pair.stl", "-o", "-", "--threads", threads]);
        let output =
            command.env("LC_ALL", language).env("TZ", "Asia/Kathmandu").output().expect("the command runs");
        assert!(output.stdout == expected, "{threads} threads, {language}");
    }
}

/// The parts and the profiles on which a pipe is compared with `slice`: name, bytes, words of the command.
fn piped() -> Vec<(&'static str, Vec<u8>, Vec<String>)> {
    let fine =
        || FINE.iter().flat_map(|(key, value)| ["--set".to_owned(), format!("{key}={value}")]).collect();
    vec![
        ("cube.stl", example("cube"), Vec::new()),
        ("pair.stl", example("pair"), Vec::new()),
        ("vase.stl", example("vase"), Vec::new()),
        // A speed of more decimals than the header has.
        ("slow.stl", example("cube"), vec!["--set".to_owned(), "speed.feed=33.3333".to_owned()]),
        ("block.stl", stl(&cuboid([0.0; 3], [20.0, 14.0, 2.0])), fine()),
        ("tube.stl", stl(&tube(10.0, 6.0, 1.0)), fine()),
        ("words.stl", text_stl(&tube(8.0, 5.0, 1.0)).into_bytes(), fine()),
        // All stages at once: the finished file is checked, too.
        ("all.stl", example("cube"), everything()),
    ]
}

/// The stages of the chain with the numbers that a dump gives them: carve is 1.
fn numbered(profile: &Profile) -> Vec<(usize, &Station)> {
    let chain = profile.chain().expect("a chain");
    let before = chain.iter().take_while(|station| station.work.forms().1 == Form::Mesh).count();
    chain
        .into_iter()
        .enumerate()
        .map(|(index, station)| ((index + 1).saturating_sub(before), station))
        .collect()
}

/// `--set STAGE.active=true` for every stage there is, but for the spiral, which no copies can be made of.
fn everything() -> Vec<String> {
    let mut words = vec!["--set".to_owned(), "machine.bed=[600, 600, 400]".to_owned()];
    for name in STAGES.iter().map(|entry| entry.name).filter(|name| *name != "coil") {
        words.extend(["--set".to_owned(), format!("{name}.active=true")]);
    }
    words
}

#[test]
fn a_5_stage_after_stage_in_a_pipe_gives_the_bytes_of_slice() {
    for (name, part, settings) in piped() {
        let room = Room::new();
        room.put(name, &part);
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let whole = room
            .run(&[&["slice", name, "-o", "-", "--quiet", "--dump", "steps"], &*settings].concat())
            .done()
            .out;
        let mut text = part;
        for (number, entry) in numbered(&Profile::default()) {
            let stage = entry.entry.name;
            text = room.feed(&[&["craft", stage], &*settings].concat(), &text).done().out;
            let form = entry.work.forms().1;
            let dumped = room.path("steps").join(format!("{number:02}-{stage}.{}", form.extension()));
            // The part as it came is not written again.
            if form == Form::Mesh && !dumped.exists() {
                continue;
            }
            assert!(
                fs::read(&dumped).ok().as_deref() == Some(&*text),
                "{name}: {stage} differs from {}",
                dumped.display()
            );
        }
        assert!(text == whole, "{name}: the pipe and slice differ");
    }
}

/// stages_tests.md A-5: one `clayforge craft` for each stage, each reading what the one before writes while it writes it.
#[test]
fn a_5_the_chain_as_one_pipe_gives_the_bytes_of_slice() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    for settings in [Vec::new(), everything()] {
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let whole = room.run(&[&["slice", "cube.stl", "-o", "-", "--quiet"], &*settings].concat()).done().out;
        let mut last: Option<ChildStdout> = None;
        let mut running = Vec::new();
        for (_, station) in numbered(&Profile::default()) {
            let input = match last.take() {
                Some(before) => Stdio::from(before),
                None => Stdio::from(fs::File::open(room.path("cube.stl")).expect("the part")),
            };
            let mut command = room.command(&[&["craft", station.entry.name], &*settings].concat());
            let mut child = command
                .stdin(input)
                .stdout(Stdio::piped())
                .stderr(Stdio::null())
                .spawn()
                .expect("the command runs");
            last = child.stdout.take();
            running.push((station.entry.name, child));
        }
        let mut text = Vec::new();
        last.expect("a chain has stages").read_to_end(&mut text).expect("the pipe is read");
        for (stage, mut child) in running {
            assert!(child.wait().expect("the command ends").success(), "{stage}");
        }
        assert!(text == whole, "the pipe and slice differ");
    }
}

/// stages_tests.md SC2.
#[test]
fn sc2_a_part_is_scaled_once() {
    let room = Room::new();
    let scale = ["craft", "scale", "--set", "scale.active=true"];
    let once = room.feed(&scale, &example("cube")).done().out;
    assert_ne!(once, example("cube"));
    assert!(room.feed(&scale, &once).done().out == once);
}

#[test]
fn a_dump_has_the_text_and_the_drawing_of_every_stage() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    room.run(&["slice", "cube.stl", "--dump", "steps", "--set", "fill.active=false"]).done();
    let mut expected = Vec::new();
    for (number, station) in numbered(&Profile::default()) {
        if station.work.forms().1 == Form::Mesh {
            continue;
        }
        let name = format!("{number:02}-{}", station.entry.name);
        expected.push(format!("{name}.{}", station.work.forms().1.extension()));
        expected.push(format!("{name}.layers.svg"));
    }
    expected.sort();
    let entries = fs::read_dir(room.path("steps")).expect("the folder is made").flatten();
    let mut found: Vec<String> = entries.map(|entry| name_of(&entry.path())).collect();
    found.sort();
    assert_eq!(found, expected);
    for name in found {
        let text = text_of(&room.path("steps").join(&name));
        assert!(!text.is_empty(), "{name} is empty");
        assert!(!name.ends_with(".svg") || text.trim_end().ends_with("</svg>"), "{name} is no drawing");
    }
}

#[test]
fn until_stops_behind_a_stage() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    room.run(&["slice", "cube.stl", "--until", "carve", "--quiet"]).done();
    room.run(&["slice", "cube.stl", "--until", "fill", "--quiet"]).done();
    let expected = sliced("cube", &example("cube"), &clay(&[]));
    let listing = room.listing();
    assert!(listing["cube.carve.svg"] == expected.behind("carve"));
    assert!(listing["cube.fill.gcode"] == expected.behind("fill"));
}

#[test]
fn the_report_has_the_keys_that_scripts_read() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    room.run(&["slice", "cube.stl", "--report", "cube.json", "--set", "carve.bead_width=1"]).done();
    let report: Json = serde_json::from_str(&text_of(&room.path("cube.json"))).expect("JSON");
    for key in ["layers", "threads", "travels"] {
        assert!(report[key].as_u64().is_some_and(|count| count > 0), "{key}: {}", report[key]);
    }
    assert_eq!(report["spirals"], 0);
    for key in ["extruded_mm", "travel_mm", "volume_mm3", "mass_g", "time_s"] {
        assert!(report[key].as_f64().is_some_and(|number| number > 0.0), "{key}: {}", report[key]);
    }
    let stages = report["stages"].as_array().expect("a list");
    let names: Vec<&str> = stages.iter().filter_map(|stage| stage["name"].as_str()).collect();
    for station in Profile::default().chain().expect("a chain") {
        assert!(names.contains(&station.entry.name), "no {} in {names:?}", station.entry.name);
    }
    assert!(stages.iter().all(|stage| stage["ms"].as_f64().is_some_and(|time| time >= 0.0)));
    let warnings = report["warnings"].as_array().expect("a list");
    assert!(!warnings.is_empty(), "a bead of 1 mm from a nozzle of 3 mm is worth a word");
    for warning in warnings {
        assert!(
            warning["stage"].is_string() && warning["text"].is_string() && warning.get("layer").is_some()
        );
    }
    // The profile is about no layer.
    assert!(warnings.iter().any(|warning| warning["stage"] == "profile" && warning["layer"].is_null()));
}
