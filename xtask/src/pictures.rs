//! The pictures of the pages, drawn by the program itself from the cases, so that they cannot go stale.

use crate::solid::{Solid, Window, around};
use clayforge::{
    Document, Drawing, Error, Event, Form, Notes, Profile, STAGES, Source, craft, draw, draw_text, emulate,
    only_built_in, read_part, slice,
};
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// The vase of the README, and for each `NAME.svg` or `NAME-WORD.svg` that the page of a stage shows the case behind it.
pub fn run(args: &[String]) -> Result<(), String> {
    if let Some(word) = args.first() {
        return Err(format!("`{word}` is not known; `pictures` has no options"));
    }
    let root = crate::root();
    put(&root.join("docs/vase.svg"), &vase(&root)?)?;
    for entry in STAGES {
        for (name, after) in pictures(entry.name, entry.page) {
            let picture = case(entry.name, entry.page, after).map_err(|error| format!("{name}: {error}"))?;
            put(&root.join(format!("crates/stages/{}/{name}", entry.name)), &picture)?;
        }
    }
    Ok(())
}

fn put(path: &Path, text: &str) -> Result<(), String> {
    println!("{} ({} kB)", path.display(), text.len().div_ceil(1000));
    fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}

/// One layer of the example vase, and a dozen of them from the bottom to the top.
fn vase(root: &Path) -> Result<String, String> {
    const STAGE: &str = "fill";
    let part = root.join("examples/vase.stl");
    let part = fs::read(&part).map_err(|error| format!("{}: {error}", part.display()))?;
    let profile = Profile::built_in("clay").ok_or("there is no profile `clay`")?.map_err(say)?;
    let mut drawings = None;
    let mut watch = |event: Event<'_>| {
        if let Event::Done { name: STAGE, document, .. } = event {
            drawings = Some((one_layer(document, 14)?, draw(document, Drawing { layer: None, most: 12 })?));
        }
        Ok(())
    };
    slice(part, &profile, Some(STAGE), &mut watch, &mut |_| Ok(())).map_err(say)?;
    let (one, sheet) = drawings.ok_or("the chain has no fill")?;
    side_by_side(&[(one, ""), (sheet, "")])
}

fn one_layer(document: &Document, layer: usize) -> Result<String, Error> {
    draw(document, Drawing { layer: Some(layer), ..Drawing::default() })
}

/// The pictures that a page shows of its own cases, each with where it stands.
fn pictures<'a>(stage: &str, page: &'a str) -> Vec<(&'a str, usize)> {
    let links = page.match_indices("](").filter_map(|(at, _)| {
        let (name, _) = page[at + 2..].split_once(')')?;
        let word = name.strip_prefix(stage)?.strip_suffix(".svg")?;
        (word.is_empty() || word.starts_with('-')).then_some((name, at))
    });
    links.collect()
}

/// The first case of a page behind a place, before and after.
fn case(stage: &str, page: &str, behind: usize) -> Result<String, String> {
    let find = |fence: &str| page[behind..].find(fence).map(|start| behind + start);
    let (start, form) = ["skein", "svg", "obj"]
        .iter()
        .filter_map(|form| find(&format!("```{form} before\n")).map(|start| (start, *form)))
        .min()
        .ok_or("the page has no case")?;
    let section = page[..start].rfind("\n## ").unwrap_or(0);
    let before = block(&page[start..]);
    let before = if form == "skein" { format!("{HEADER}{before}{FOOTER}") } else { before.to_owned() };
    let settings = page[section..start].find("```toml\n").map_or("", |toml| block(&page[section + toml..]));
    let settings = Source { name: format!("the page of {stage}"), text: settings.to_owned() };
    let mut profile = Profile::read(settings, &only_built_in).map_err(say)?;
    profile.set(&format!("{stage}.active"), "true").map_err(say)?;
    let mut after = Vec::new();
    let mut sink = |piece: &[u8]| {
        after.extend_from_slice(piece);
        Ok(())
    };
    craft(stage, before.as_bytes(), &profile, &mut Notes::default(), &mut sink).map_err(say)?;
    let (one, other) =
        (Subject::of(before.as_bytes(), form, &profile)?, Subject::of(&after, &after_form(stage), &profile)?);
    // Two solids are seen through one window, so that the larger one looks larger.
    let window = match (&one, &other) {
        (Subject::Solid(one), Subject::Solid(other)) => Some(around(one.window(), other.window())),
        _ => None,
    };
    side_by_side(&[(one.drawn(window), "before"), (other.drawn(window), "after")])
}

/// What a stage writes, in the word of a fence.
fn after_form(stage: &str) -> String {
    let gives = clayforge::stage(stage).map(|entry| entry.make().forms().1);
    let word = match gives {
        Some(Form::Mesh) => "obj",
        Some(Form::Slices) => "svg",
        Some(Form::Gcode) => "gcode",
        _ => "skein",
    };
    word.to_owned()
}

/// Something to be drawn.
enum Subject {
    Solid(Solid),
    Drawing(String),
}

impl Subject {
    fn of(text: &[u8], form: &str, profile: &Profile) -> Result<Self, String> {
        match form {
            "obj" => {
                let part = read_part(text, profile, &mut Notes::default()).map_err(say)?;
                Ok(Self::Solid(Solid::of(&part)))
            }
            "gcode" => run_by_a_machine(text, profile).map(Self::Drawing),
            _ => draw_text(text, Drawing::default()).map_err(say).map(Self::Drawing),
        }
    }

    fn drawn(self, window: Option<Window>) -> String {
        match self {
            Self::Solid(solid) => solid.draw(window.unwrap_or_else(|| solid.window())),
            Self::Drawing(svg) => svg,
        }
    }
}

/// The lowest layer of a file as a machine lays it, coloured by speed.
fn run_by_a_machine(gcode: &[u8], profile: &Profile) -> Result<String, String> {
    // The cases count clay from move to move; only the file of a whole chain says so.
    let relative = [b"M83\n", gcode].concat();
    let steps = emulate::Commands::read(&relative).steps;
    let operation = profile.emulator().process_additive(steps).map_err(|error| error.to_string())?;
    let bead = emulate::Bead::estimated(&operation, emulate::Bead::default());
    let part =
        emulate::AdditivePart::new(&operation, bead, [0.0, 0.0, 1.0]).map_err(|error| error.to_string())?;
    emulate::picture(&part, "feedrate", emulate::View::Layer(0)).map_err(|error| error.to_string())
}

/// What stands between a fence and the next.
fn block(text: &str) -> &str {
    let body = text.split_once('\n').map_or("", |(_, body)| body);
    body.find("```").map_or(body, |end| &body[..end])
}

/// The header that the cases of the pages leave out.
const HEADER: &str = include_str!("../../tests/case-header.gcode");
const FOOTER: &str = "(</crafting>)\n";

/// Drawings of equal height in a row, each with a word above it.
fn side_by_side(drawings: &[(String, &str)]) -> Result<String, String> {
    const HEIGHT: f64 = 480.0;
    const GAP: f64 = 16.0;
    let words = if drawings.iter().all(|(_, word)| word.is_empty()) { 0.0 } else { 28.0 };
    let mut x = GAP;
    let mut inside = String::new();
    for (svg, word) in drawings {
        let (head, body) = svg.split_once('\n').ok_or("a drawing has no body")?;
        let said = |name: &str| {
            let (_, rest) = head.split_once(name)?;
            rest.split_once('"').map(|(value, _)| value)
        };
        let window = said("viewBox=\"").ok_or("a drawing has no window")?;
        // Outlines take their width from the drawing as a whole, where it says one.
        let line = said("stroke-width=\"").unwrap_or("1");
        let sizes: Vec<f64> = window.split(' ').filter_map(|number| number.parse().ok()).collect();
        let [_, _, wide, high] = sizes[..] else { return Err("a drawing has no size".to_owned()) };
        let width = (HEIGHT * wide / high).round();
        // Writing to a string cannot fail.
        let _ = write!(
            inside,
            "<svg x=\"{x}\" y=\"{}\" width=\"{width}\" height=\"{HEIGHT}\" viewBox=\"{window}\" \
             stroke-width=\"{line}\">\n{body}",
            GAP + words
        );
        if !word.is_empty() {
            let _ = writeln!(
                inside,
                "<text x=\"{x}\" y=\"{}\" font-family=\"sans-serif\" font-size=\"18\">{word}</text>",
                GAP + 14.0
            );
        }
        x += width + GAP;
    }
    let high = HEIGHT + 2.0 * GAP + words;
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {x} {high}\" width=\"{x}\" height=\"{high}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fffdf8\"/>\n{inside}</svg>\n"
    ))
}

fn say(error: Error) -> String {
    error.to_string()
}
