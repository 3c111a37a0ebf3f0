//! The pages of `cases/`: G-code as programs and people write it, and what both models make of it.
//!
//! A case is a heading that is a claim, a fence `gcode`, and a fence `found`. `CLAYFORGE_BLESS=1 cargo test -p
//! clay-processor cases` writes what is found; read the difference before you keep it.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use clay_processor::{Bed, Firmware, LayerHeights, Limits, Model, Options, Processor, Report, Run, Severity};

/// The printer of the pages that need one: 200 × 200 × 100 mm, layers of 1.5 mm over a first of 1 mm, E in mm³.
const PRINTER: Limits = Limits {
    bed: Some(Bed { least: (0.0, 0.0), greatest: (200.0, 200.0), round: false, height: 100.0 }),
    layers: Some(LayerHeights { first: 1.0, rest: 1.5 }),
    bead_width: Some(3.0),
    e_per_mm3: Some(1.0),
    max_e_speed: Some(100.0),
    max_flow: Some(80.0),
    heated: Some(false),
    firmware: Some(Firmware::Marlin),
    longest_e: None,
};

/// Pages whose name begins so are held against the printer; the others are read without knowing any.
const FOR_PRINTER: &str = "printer";

fn pages() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let mut pages: Vec<PathBuf> =
        fs::read_dir(folder).expect("the folder").flatten().map(|entry| entry.path()).collect();
    pages.sort();
    pages
}

#[test]
fn every_case_is_found_as_its_page_says() {
    let bless = std::env::var_os("CLAYFORGE_BLESS").is_some();
    let (mut cases, mut failures) = (0, String::new());
    for path in pages() {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let limits = if name.starts_with(FOR_PRINTER) { PRINTER } else { Limits::default() };
        let page = fs::read_to_string(&path).expect("a page");
        let mut blessed = String::new();
        let mut rest = page.as_str();
        let mut heading = "";
        while let Some((before, fenced)) = rest.split_once("```gcode\n") {
            let (gcode, after) = fenced.split_once("```\n").expect("the fence closes");
            let (between, fenced) = after.split_once("```found\n").expect("what is found follows");
            let (expected, after) = fenced.split_once("```\n").expect("the fence closes");
            heading = before.lines().rev().find(|line| line.starts_with("## ")).unwrap_or(heading);
            let found = found(&read(gcode, limits));
            if found != expected {
                let _ = writeln!(failures, "{name}: {heading}\nexpected:\n{expected}found:\n{found}");
            }
            let crlf = self::found(&read(&gcode.replace('\n', "\r\n"), limits));
            assert_eq!(crlf, found, "{name}: {heading}, with CR and LF");
            let _ = write!(blessed, "{before}```gcode\n{gcode}```\n{between}```found\n{found}```\n");
            (rest, cases) = (after, cases + 1);
        }
        blessed.push_str(rest);
        if bless && blessed != page {
            fs::write(&path, blessed).expect("the page can be written");
        }
    }
    assert!(cases >= 30, "only {cases} cases");
    assert!(bless || failures.is_empty(), "{failures}");
}

fn read(gcode: &str, limits: Limits) -> Report {
    let mut processor = Processor::new(Options { limits, ..Options::default() });
    processor.push(gcode.as_bytes());
    processor.finish()
}

/// A report in a few lines. Lines of the file are counted from 0, as in the models; what is empty is left out.
fn found(report: &Report) -> String {
    let mut text = String::new();
    if report.letter == report.machine {
        in_short("both", &report.letter, &mut text);
    } else {
        in_short("letter", &report.letter, &mut text);
        in_short("machine", &report.machine, &mut text);
    }
    let breaks = &report.interruptions;
    if breaks.count > 0 {
        let _ = writeln!(
            text,
            "breaks: {}, {:.3} mm, longest {:.3}",
            breaks.count, breaks.length, breaks.longest
        );
    }
    for pitch in &report.pitches {
        let rise = pitch.rise.map_or_else(String::new, |rise| format!(", {rise:.3} mm each"));
        let _ = writeln!(text, "turns: {:.2}{rise}", pitch.turns);
    }
    for note in &report.notes {
        let _ = writeln!(text, "note: {:?} at {}, {}", note.habit, note.index, note.count);
    }
    for verdict in &report.verdicts {
        let word = if verdict.severity == Severity::Forbids { "FORBIDS" } else { "warns" };
        let at = verdict.place.map_or_else(String::new, |place| format!(" at {}", place.index));
        let _ = writeln!(text, "{word}: {}{at}, {}", verdict.rule.name(), verdict.count);
    }
    text
}

fn in_short(name: &str, model: &Model, text: &mut String) {
    let height = |height: Option<f64>| {
        height.map_or_else(|| "?".to_owned(), |mm| format!("{}", (mm * 1e6).round() / 1e6))
    };
    let run = |run: &Run| format!("{}-{}@{}", run.start_index, run.end_index, height(run.height));
    let comments = [
        model.first_part_comments_end.map(|end| format!("head ends {end}")),
        model.last_part_comments_start.map(|start| format!("tail starts {start}")),
    ];
    let lists = [
        ("layers", model.layers.iter().map(run).collect::<Vec<_>>()),
        ("spirals", model.spirals.iter().map(run).collect()),
        (
            "across",
            model
                .horizontal_movement_without_extrusion
                .iter()
                .map(|travel| format!("{}@{}", travel.index, height(travel.height)))
                .collect(),
        ),
        (
            "up or down",
            model
                .vertical_movement_without_extrusion
                .iter()
                .map(|lift| format!("{}:{}>{}", lift.index, height(lift.from), height(lift.to)))
                .collect(),
        ),
        (
            "aslant",
            model.diagonal_movement_without_extrusion.iter().map(|travel| travel.index.to_string()).collect(),
        ),
    ];
    let lists = lists
        .iter()
        .filter(|(_, items)| !items.is_empty())
        .map(|(name, items)| format!("{name} {}", items.join(" ")));
    let parts: Vec<String> = comments.into_iter().flatten().chain(lists).collect();
    let _ = writeln!(text, "{name}: {}", if parts.is_empty() { "nothing".into() } else { parts.join("; ") });
}
