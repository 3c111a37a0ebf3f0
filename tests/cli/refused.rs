//! What is refused, and how that is said.

use crate::command::{Room, assert_message};
use crate::support::{Triangles, cuboid, stl, text_stl};

/// What is wrong with a part, its name, its bytes, more words for the command, and what the message must say.
type Refused = (&'static str, &'static str, Vec<u8>, &'static [&'static str], &'static [&'static str]);

fn refused_parts() -> Vec<Refused> {
    let cube = || cuboid([0.0; 3], [20.0, 20.0, 10.0]);
    let with = |change: fn(&mut Triangles)| {
        let mut part = cube();
        change(&mut part);
        stl(&part)
    };
    let mut short = stl(&cube());
    short.truncate(434);
    let mut picture = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
    picture.resize(700, 7);
    vec![
        ("an empty file", "empty.stl", Vec::new(), &[], &["empty.stl", "empty"]),
        ("a part that ends early", "short.stl", short, &[], &["short.stl", "12 facets", "7", "434"]),
        (
            "a place that is no number",
            "nan.stl",
            with(|part| part[3][1][0] = f64::NAN),
            &[],
            &["nan.stl", "facet"],
        ),
        (
            "an infinite place",
            "inf.stl",
            with(|part| part[3][1][0] = f64::INFINITY),
            &[],
            &["inf.stl", "facet"],
        ),
        ("a picture", "picture.stl", picture, &[], &["picture.stl", "png"]),
        (
            "facets without area only",
            "needles.stl",
            with(|part| part.iter_mut().for_each(|one| one[2] = one[1])),
            &[],
            &["needles.stl", "area"],
        ),
        (
            "a place beyond a kilometre",
            "huge.stl",
            with(|part| part[3][1][0] = 1e9),
            &[],
            &["huge.stl", "facet"],
        ),
        (
            "a part larger than the bed",
            "wide.stl",
            stl(&cuboid([0.0; 3], [500.0, 20.0, 10.0])),
            &[],
            &["carve", "500", "200"],
        ),
        (
            "a part higher than the printer",
            "tall.stl",
            stl(&cuboid([0.0; 3], [20.0, 20.0, 900.0])),
            &[],
            &["carve", "900", "200"],
        ),
        (
            "a flat part",
            "flat.stl",
            stl(&cuboid([0.0; 3], [20.0, 20.0, 0.1])),
            &[],
            &["carve", "0.1", "flat"],
        ),
        ("a text without facets", "none.stl", b"solid none\nendsolid none\n".to_vec(), &[], &["none.stl"]),
        (
            "a text that is no part",
            "prose.stl",
            b"Dear potter, this is no part.\n".to_vec(),
            &[],
            &["prose.stl"],
        ),
        (
            "a part in words that ends early",
            "half.stl",
            text_stl(&cube()).into_bytes()[..400].to_vec(),
            &[],
            &["half.stl"],
        ),
        (
            "an unknown profile",
            "part.stl",
            stl(&cube()),
            &["--profile", "porcelain"],
            &["porcelain", "profile list"],
        ),
        (
            "an unknown key",
            "part.stl",
            stl(&cube()),
            &["--set", "fill.wals=2"],
            &["fill.wals", "did you mean `fill.walls`?"],
        ),
        (
            "a value out of bounds",
            "part.stl",
            stl(&cube()),
            &["--set", "fill.density=3"],
            &["fill.density", "above 1"],
        ),
        (
            "a value of another type",
            "part.stl",
            stl(&cube()),
            &["--set", "fill.walls=many"],
            &["fill.walls", "number"],
        ),
        ("a folder that is not there", "part.stl", stl(&cube()), &["-o", "nowhere/part.gcode"], &["nowhere"]),
        (
            "an unknown stage to stop at",
            "part.stl",
            stl(&cube()),
            &["--until", "glaze"],
            &["glaze", "clayforge stages"],
        ),
        (
            "heat at the start",
            "part.stl",
            stl(&cube()),
            &["--set", "alteration.start=M104 S200"],
            &["M104", "heat"],
        ),
    ]
}

#[test]
fn a_refused_part_gives_one_and_a_message_and_leaves_no_file() {
    let mut failures = Vec::new();
    for (what, name, bytes, words, says) in refused_parts() {
        let room = Room::new();
        room.put(name, bytes);
        let before = room.listing();
        let ran = room.run(&[&["slice", name], words].concat());
        let checked = std::panic::catch_unwind(|| {
            assert_eq!(ran.code, Some(1), "{}", ran.err);
            assert_message(&ran.err, says);
            assert!(ran.out.is_empty(), "something on standard output");
            assert_eq!(room.listing(), before, "the folder has changed");
        });
        if let Err(why) = checked {
            let why = why.downcast_ref::<String>().cloned().unwrap_or_default();
            failures.push(format!("{what}: {why}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Promise 4: a message names the file, so that a batch of parts can be searched for it.
#[test]
fn a_refusal_names_the_part_whoever_refuses() {
    for (what, name, bytes, words, _) in
        refused_parts().into_iter().filter(|(_, _, _, words, _)| words.is_empty())
    {
        let room = Room::new();
        room.put(name, bytes);
        let ran = room.run(&[&["slice", name], words].concat());
        assert!(ran.err.starts_with(&format!("error: {name}: ")), "{what}: {}", ran.err);
    }
}

#[test]
fn a_part_that_is_not_there_is_said() {
    let room = Room::new();
    let ran = room.run(&["slice", "missing.stl"]);
    assert_eq!(ran.code, Some(1));
    assert_message(&ran.err, &["missing.stl", "no such file"]);
    assert!(room.listing().is_empty());
}

#[test]
fn a_mistake_in_a_profile_has_its_line_and_column() {
    for (text, says) in [
        ("[fill]\nwals = 3\n", ["mine.toml:2:1", "did you mean `fill.walls`?"]),
        ("[fill]\nwalls = \"two\"\n", ["mine.toml:2:9", "number"]),
        ("[fill]\nwalls = -1\n", ["mine.toml:2:9", "below 0"]),
        ("[carve]\nlayer_height = nan\n", ["mine.toml:2:16", "carve.layer_height"]),
        ("inherits = \"porcelain\"\n", ["mine.toml:1:12", "porcelain"]),
        (
            "sequence = [\"carve\", \"preface\", \"fill\", \"inset\", \"export\"]\n",
            ["mine.toml:1:12", "inset must come first"],
        ),
    ] {
        let room = Room::new();
        room.put("mine.toml", text).put("part.stl", stl(&cuboid([0.0; 3], [20.0, 20.0, 10.0])));
        let before = room.listing();
        for words in
            [&["slice", "part.stl", "--profile", "mine.toml"][..], &["profile", "check", "mine.toml"]]
        {
            let ran = room.run(words);
            assert_eq!(ran.code, Some(1), "{text}: {}", ran.err);
            assert_message(&ran.err, &says);
        }
        assert_eq!(room.listing(), before, "{text}");
    }
}

#[test]
fn a_profile_that_is_no_toml_has_its_place_and_a_hint() {
    for (text, place) in [
        ("[fill\nwalls = 1\n", "mine.toml:1:"),
        ("[fill]\nwalls =\n", "mine.toml:2:"),
        ("a = 1\na = 2\n", "mine.toml:2:"),
    ] {
        let room = Room::new();
        room.put("mine.toml", text);
        let ran = room.run(&["profile", "check", "mine.toml"]);
        assert_eq!(ran.code, Some(1), "{text}");
        assert_message(&ran.err, &[place]);
    }
}

#[test]
fn wrong_usage_gives_two() {
    let room = Room::new();
    for words in [
        &[][..],
        &["slice"],
        &["slice", "part.stl", "--layers", "3"],
        &["slice", "part.stl", "--set", "fill.walls"],
        &["slice", "part.stl", "--threads", "many"],
        &["bake"],
        &["craft"],
        &["profile"],
        &["explain"],
        &["check"],
    ] {
        let ran = room.run(words);
        assert_eq!(ran.code, Some(2), "{words:?}: {}", ran.err);
        assert!(ran.out.is_empty() && !ran.err.is_empty(), "{words:?}");
    }
    assert!(room.listing().is_empty());
}

#[test]
fn help_is_no_mistake() {
    let room = Room::new();
    for words in [&["--help"][..], &["--version"], &["slice", "--help"], &["help", "craft"]] {
        let ran = room.run(words).done();
        assert!(ran.err.is_empty() && !ran.out.is_empty(), "{words:?}");
    }
}
