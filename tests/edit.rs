//! `clayforge edit`: the cases of its page, chains, refusals, and files of our own slicer.

use crate::command::Room;
use crate::support::{blessing, clay, difference, example, root, sliced, text_of};
use clayforge::clay_processor::process;
use std::fs;
use std::ops::Range;

/// A case of the page.
struct Case<'a> {
    name: &'a str,
    words: &'a str,
    before: &'a str,
    other: Option<&'a str>,
    /// What is expected: the text of `after` or of `error`.
    expected: &'a str,
    is_error: bool,
}

impl Case<'_> {
    /// Where the expectation stands in the page that it was cut from.
    fn place(&self, page: &str) -> Range<usize> {
        let start = self.expected.as_ptr() as usize - page.as_ptr() as usize;
        start..start + self.expected.len()
    }
}

/// The text of a fence and what follows it.
fn fence<'a>(section: &'a str, head: &str) -> Option<&'a str> {
    let start = section.find(&format!("\n```{head}\n"))? + head.len() + 5;
    let length = section[start..].find("```")?;
    Some(&section[start..start + length])
}

fn cases(page: &str) -> Vec<Case<'_>> {
    let sections = page.split("\n## ").skip(1);
    sections
        .filter_map(|section| {
            let words = fence(section, "edit")?.trim();
            let after = fence(section, "gcode after");
            Some(Case {
                name: section.lines().next().unwrap_or(""),
                words,
                before: fence(section, "gcode before").expect("a case has a file"),
                other: fence(section, "gcode other"),
                expected: after.or(fence(section, "error")).expect("a case has a result"),
                is_error: after.is_none(),
            })
        })
        .collect()
}

/// What the command makes of a case.
fn result(case: &Case<'_>, line_end: &str) -> String {
    let room = Room::new();
    room.put("part.gcode", case.before.replace('\n', line_end));
    if let Some(other) = case.other {
        room.put("other.gcode", other);
    }
    let mut words = vec!["edit", "part.gcode", "-o", "-"];
    words.extend(case.words.split(' '));
    let ran = room.run(&words);
    if !case.is_error {
        return ran.done().out();
    }
    assert_eq!(ran.code, Some(1), "{}: {}", case.name, ran.out());
    ran.err.replace("error: ", "").replace("  hint: ", "hint: ")
}

#[test]
fn the_page_is_the_test() {
    let path = root().join("crates/edit/README.md");
    let page = text_of(&path);
    let mut changed: Vec<(Range<usize>, String)> = Vec::new();
    let mut failures = String::new();
    for case in cases(&page) {
        let found = result(&case, "\n");
        if found != case.expected {
            failures += &format!("{}\n{}\n", case.name, difference(case.expected, &found));
            changed.push((case.place(&page), found));
        }
    }
    if blessing() {
        let mut blessed = page;
        for (place, found) in changed.into_iter().rev() {
            blessed.replace_range(place, &found);
        }
        return fs::write(&path, blessed).expect("the page can be written");
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn the_page_holds_with_other_line_ends() {
    let page = text_of(&root().join("crates/edit/README.md"));
    for case in cases(&page).iter().filter(|case| !case.is_error) {
        assert_eq!(result(case, "\r\n"), case.expected.replace('\n', "\r\n"), "{}", case.name);
    }
}

const PART: &str = "; a cup\nG1 X0 Y0 Z1 F600\nG1 X10 E4\nG1 Y10 E8\n";

#[test]
fn edits_chain_on_a_line_and_by_running_twice() {
    let room = Room::new();
    room.put("part.gcode", PART);
    let chain =
        ["edit", "part.gcode", "-o", "both.gcode", "scale", "--factor", "0.5", "speed", "--factor", "2"];
    let ran = room.run(&chain).done();
    assert!(ran.err.contains("scale: ") && ran.err.contains("speed: "), "{}", ran.err);
    assert_eq!(ran.out(), "", "the result goes into the file");
    room.run(&["edit", "part.gcode", "-o", "one.gcode", "scale", "--factor", "0.5"]).done();
    // The file may be its own result.
    room.run(&["edit", "one.gcode", "-o", "one.gcode", "speed", "--factor", "2"]).done();
    let files = room.listing();
    assert_eq!(files["both.gcode"], files["one.gcode"]);
    let text = String::from_utf8_lossy(&files["both.gcode"]).into_owned();
    let marks = text.match_indices("; edit ").count();
    assert_eq!(marks, 2, "{text}");
    assert!(text.starts_with("; a cup\n; edit scale: ") && text.contains("G1 X7.5 E1 F1200\n"), "{text}");
}

#[test]
fn standard_input_and_output_do_as_well() {
    let room = Room::new();
    let ran = room.feed(&["edit", "-", "nozzle", "--old", "2", "--new", "4"], PART.as_bytes()).done();
    assert!(ran.out().ends_with("G1 X10 E8\nG1 Y10 E16\n"), "{}", ran.out());
}

#[test]
fn a_refusal_leaves_no_file_and_the_old_one_alone() {
    let room = Room::new();
    room.put("part.gcode", PART).put("out.gcode", "old");
    for words in [
        &["scale", "--factor", "-1"][..],
        &["speed", "--factor", "0"],
        &["scale", "--factor", "0.5", "rim", "--turns", "1"],
        &["base", "missing.gcode"],
        &["base", "part.gcode"],
        &["pause", "--after-base"],
        &["clean", "G1"],
        &["nozzle", "--old", "0", "--new", "2"],
        &["nozzle", "--old", "1", "--new", "2", "--section", "stadium"],
    ] {
        let ran = room.run(&[&["edit", "part.gcode", "-o", "out.gcode"], words].concat());
        assert_eq!(ran.code, Some(1), "{words:?}: {}", ran.err);
        assert!(ran.err.starts_with("error: ") && ran.err.contains("hint: "), "{words:?}: {}", ran.err);
        assert_eq!(room.listing().len(), 2, "{words:?}");
        assert_eq!(room.listing()["out.gcode"], b"old", "{words:?}");
    }
    for words in [
        &["scale"][..],
        &["speed", "--top", "1"],
        &["pause"],
        &["clean"],
        &["rim", "--turns", "many"],
        &["enlarge"],
    ] {
        let ran = room.run(&[&["edit", "part.gcode", "-o", "out.gcode"], words].concat());
        assert_eq!(ran.code, Some(2), "{words:?}: {}", ran.err);
    }
}

#[test]
fn our_own_files_are_edited_and_still_what_they_were() {
    let run = sliced("cup", &example("cup"), &clay(&[]));
    let room = Room::new();
    room.put("cup.gcode", run.gcode());
    let before = process(run.gcode()).machine;
    room.run(&["edit", "cup.gcode", "-o", "small.gcode", "scale", "--factor", "0.5"]).done();
    let small = process(&room.listing()["small.gcode"]).machine;
    assert_eq!(small.layers.len(), before.layers.len());
    assert_eq!(small.spirals.len(), before.spirals.len());
    for (half, whole) in small.layers.iter().zip(&before.layers) {
        let heights = [half.height, whole.height].map(|height| height.expect("a layer has a height"));
        assert!((heights[0] * 2.0 - heights[1]).abs() < 1e-4, "{half:?} {whole:?}");
    }
    let middle = format!("{}", before.max_height / 2.0);
    let chain = ["speed", "--bottom", "1", "--top", "0.5", "pause", "--at", &middle, "--park", "0,0"];
    room.run(&[&["edit", "cup.gcode", "-o", "slow.gcode"], &chain[..]].concat()).done();
    let slow = process(&room.listing()["slow.gcode"]).machine;
    assert_eq!(slow.layers.len(), before.layers.len());
    assert!((slow.max_height - before.max_height).abs() < 1e-9);
}
