//! What the command says of itself.

use crate::command::{Room, assert_message};
use crate::support::example;
use clayforge::STAGES;
use serde_json::Value as Json;
use std::fs;

#[test]
fn the_list_of_stages_is_the_table() {
    let room = Room::new();
    let list: Json = serde_json::from_slice(&room.run(&["stages", "--json"]).done().out).expect("JSON");
    let list = list.as_array().expect("a list");
    let names: Vec<&str> = list.iter().filter_map(|stage| stage["name"].as_str()).collect();
    assert_eq!(names, STAGES.iter().map(|entry| entry.name).collect::<Vec<_>>());
    assert!(list.iter().all(|stage| stage["about"].as_str().is_some_and(|about| about.len() > 10)));
    let text = room.run(&["stages"]).done().out();
    assert!(names.iter().all(|name| text.lines().any(|line| line.starts_with(name))), "{text}");
}

#[test]
fn a_setting_is_explained_with_its_default_and_bounds() {
    let room = Room::new();
    let text = room.run(&["explain", "fill.walls"]).done().out();
    assert!(
        text.contains("fill.walls") && text.contains("default 2") && text.contains("0 to 1000"),
        "{text}"
    );
    for entry in STAGES {
        let page = room.run(&["explain", entry.name]).done().out();
        assert!(
            page.contains(&format!("# {}", entry.name)) && page.contains("All settings"),
            "{}",
            entry.name
        );
    }
    let ran = room.run(&["explain", "fill.wals"]);
    assert_eq!(ran.code, Some(1));
    assert_message(&ran.err, &["fill.wals", "did you mean `fill.walls`?"]);
}

#[test]
fn a_profile_that_is_shown_reads_back() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    for name in ["clay", "generic-ram", "generic-auger"] {
        let shown = room.run(&["profile", "show", name]).done().out();
        room.put("shown.toml", &shown);
        room.run(&["profile", "check", "shown.toml"]).done();
        assert_eq!(room.run(&["profile", "show", "shown.toml"]).done().out(), shown, "{name}");
        let expected = room.run(&["slice", "cube.stl", "-o", "-", "--quiet", "--profile", name]).done().out;
        let found =
            room.run(&["slice", "cube.stl", "-o", "-", "--quiet", "--profile", "shown.toml"]).done().out;
        assert!(found == expected, "{name} shown and read prints differently");
    }
    let list = room.run(&["profile", "list"]).done().out();
    assert!(list.contains("clay") && list.contains("generic-ram"), "{list}");
    room.put("new.toml", room.run(&["profile", "new"]).done().out);
    room.run(&["profile", "check", "new.toml"]).done();
    let schema: Json = serde_json::from_slice(&room.run(&["profile", "schema"]).done().out).expect("JSON");
    assert!(schema["properties"]["fill"]["properties"]["walls"].is_object(), "{schema:#}");
}

/// A file here comes before one of the config folder, and that before a built-in one; `.toml` may stand or not.
#[test]
fn a_profile_is_looked_for_here_then_in_the_config_folder_then_in_the_program() {
    let room = Room::new();
    let density = |name: &str| {
        let shown = room.run(&["profile", "show", name]).done().out();
        let (_, fill) = shown.split_once("[fill]").expect("a section");
        fill.lines().find(|line| line.starts_with("density")).unwrap_or("").to_owned()
    };
    assert_eq!(["clay", "clay.toml"].map(density), ["density = 0.2"; 2]);
    room.put("cube.stl", example("cube"));
    let slice = |name| room.run(&["slice", "cube.stl", "-o", "-", "--quiet", "--profile", name]).done().out;
    let built_in = slice("clay");
    assert!(slice("clay.toml") == built_in);
    let own = "inherits = \"clay\"\nfill.density = ";
    fs::create_dir_all(room.path("config/clayforge")).expect("a new folder");
    room.put("config/clayforge/clay.toml", format!("{own}0.5\n"));
    assert_eq!(["clay", "clay.toml"].map(density), ["density = 0.5"; 2]);
    assert!(slice("clay.toml") == slice("clay") && slice("clay.toml") != built_in);
    room.put("clay.toml", format!("{own}0.75\n"));
    assert_eq!(["clay", "clay.toml"].map(density), ["density = 0.75"; 2]);
    let ran = room.run(&["slice", "cube.stl", "--profile", "nowhere/clay.toml"]);
    assert_message(&ran.err, &["nowhere/clay.toml", "profile list"]);
}

/// Nothing is said twice at the start. A line with E at the end holds for absolute E, too: it counts anew.
#[test]
fn the_profiles_of_the_program_say_every_command_of_the_start_once_and_never_go_down() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    for name in ["clay", "generic-ram", "generic-auger"] {
        let text = room.run(&["slice", "cube.stl", "-o", "-", "--quiet", "--profile", name]).done().out();
        let commands: Vec<&str> = text.lines().filter(|line| !line.starts_with(';')).collect();
        let start: Vec<&str> = commands.iter().copied().take_while(|line| !line.starts_with("G1")).collect();
        assert_eq!(start, ["G90", "G21", "M302 P1", "G28", "M83", "G92 E0"], "{name}");
        let end =
            commands.iter().rposition(|line| line.contains(" X") || line.contains(" Y")).expect("moves");
        let relief: &[&str] = match name {
            "generic-ram" => &["G92 E0", "G1 E-0.2 F6"],
            "generic-auger" => &["G92 E0", "G1 E-5 F300"],
            _ => &[],
        };
        assert_eq!(commands[end + 1..], [relief, &["G91", "G1 Z10 F600", "G90", "M84"]].concat(), "{name}");
    }
}

#[test]
fn a_stage_refuses_a_text_of_another_kind() {
    let room = Room::new();
    for (stage, input) in
        [("fill", &b"no skein\n"[..]), ("preface", b"<svg/>"), ("carve", b""), ("export", b"G1 X1\n")]
    {
        let ran = room.feed(&["craft", stage], input);
        assert_eq!(ran.code, Some(1), "{stage}: {}", ran.err);
        assert!(ran.err.starts_with("error: ") && ran.out.is_empty(), "{stage}: {}", ran.err);
    }
    let ran = room.run(&["craft", "glaze"]);
    assert_eq!(ran.code, Some(1));
    assert_message(&ran.err, &["glaze", "clayforge stages"]);
}
