//! The pages of the stages are their tests: every pair of fences is a case.
//!
//! A case has the nearest heading above it as its name. Its fences are
//!
//! * `toml`, if it wants settings: a profile, in which a section is a stage;
//! * `skein before` or, for preface and bottom, `svg before`, for scale and carve `obj before`;
//! * `skein after`, for export `gcode after`, for carve and bottom `svg after`, for scale `obj after`, or `error`: the
//!   error's text, and perhaps a line `hint: …`.
//!
//! A `before` that has no header gets [`HEADER`], and then only the layers are compared. Every case is run from text to
//! text and in memory. `CLAYFORGE_BLESS=1 cargo test -p all-tests cases` rewrites the last fence of each case that fails.

use crate::support::{blessing, craft, difference, folders, name_of, root, text_of};
use clayforge::{
    Bench, Document, Error, Form, Notes, Place, Plate, Profile, Source, only_built_in, read_part, stage,
};
use skein::{Layer, Skein, Slices};
use std::fmt::Write;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// What a `before` without a header begins with.
const HEADER: &str = include_str!("case-header.gcode");

/// What it ends with.
const END: &str = "(</crafting>)\n";

/// A fence of a page.
struct Fence {
    /// The words behind the backticks.
    info: String,
    /// The number of the line of its backticks, from one.
    line: usize,
    /// Where its body stands in the page.
    body: Range<usize>,
}

/// A case of a page.
struct Case {
    stage: String,
    page: PathBuf,
    heading: String,
    /// The line of the first fence.
    line: usize,
    settings: String,
    /// What the text before is: `skein`, `svg` or `obj`.
    kind: String,
    before: String,
    /// What is expected: `skein`, `gcode`, `svg`, `obj` or `error`.
    wanted: String,
    expected: String,
    /// Where the expectation stands in the page.
    place: Range<usize>,
}

/// The pages of all stages: the manual, and what is in the folder `cases`.
fn pages() -> Vec<(String, PathBuf)> {
    let mut pages = Vec::new();
    for folder in folders(&root().join("crates/stages")) {
        let stage = name_of(&folder);
        pages.push((stage.clone(), folder.join("README.md")));
        let more =
            fs::read_dir(folder.join("cases")).into_iter().flatten().flatten().map(|entry| entry.path());
        let mut more: Vec<PathBuf> =
            more.filter(|path| path.extension().is_some_and(|end| end == "md")).collect();
        more.sort();
        pages.extend(more.into_iter().map(|page| (stage.clone(), page)));
    }
    pages
}

/// The headings and the fences of a page in order.
fn fences(page: &str) -> Vec<Result<Fence, String>> {
    let mut found: Vec<Result<Fence, String>> = Vec::new();
    let mut open: Option<(Fence, usize)> = None;
    let mut at = 0;
    for (index, line) in page.split_inclusive('\n').enumerate() {
        let bare = line.trim_end();
        if let Some((mut fence, ticks)) = open.take() {
            if bare.len() >= ticks && bare.bytes().all(|byte| byte == b'`') {
                fence.body.end = at;
                found.push(Ok(fence));
            } else {
                open = Some((fence, ticks));
            }
        } else if bare.starts_with("```") {
            let ticks = bare.bytes().take_while(|byte| *byte == b'`').count();
            let body = at + line.len();
            let fence = Fence { info: bare[ticks..].trim().to_owned(), line: index + 1, body: body..body };
            open = Some((fence, ticks));
        } else if bare.starts_with('#') {
            found.push(Err(bare.trim_start_matches('#').trim().to_owned()));
        }
        at += line.len();
    }
    assert!(open.is_none(), "a fence is never closed");
    found
}

/// The cases of a page.
fn cases(stage: &str, page: &Path) -> Vec<Case> {
    let text = text_of(page);
    let mut cases = Vec::new();
    let mut heading = String::new();
    let mut settings = (String::new(), 0);
    let mut before: Option<(String, String, usize)> = None;
    for item in fences(&text) {
        let fence = match item {
            Ok(fence) => fence,
            Err(title) => {
                assert!(before.is_none(), "{}: `{heading}` has a before without an after", page.display());
                heading = title;
                settings = (String::new(), 0);
                continue;
            }
        };
        let body = || text[fence.body.clone()].to_owned();
        match fence.info.split_whitespace().collect::<Vec<_>>().as_slice() {
            ["toml"] => settings = (body(), fence.line),
            [kind @ ("skein" | "svg" | "obj"), "before"] => {
                before = Some(((*kind).to_owned(), body(), fence.line))
            }
            [wanted @ ("skein" | "gcode" | "svg" | "obj"), "after"] | [wanted @ "error"] => {
                let place = format!("{}:{}", page.display(), fence.line);
                let (kind, before, line) =
                    before.take().unwrap_or_else(|| panic!("{place}: `{wanted}` without a before"));
                cases.push(Case {
                    stage: stage.to_owned(),
                    page: page.to_owned(),
                    heading: heading.clone(),
                    line: if settings.1 > 0 { settings.1 } else { line },
                    settings: std::mem::take(&mut settings.0),
                    kind,
                    before,
                    wanted: (*wanted).to_owned(),
                    expected: body(),
                    place: fence.body,
                });
                settings.1 = 0;
            }
            _ => {}
        }
    }
    assert!(before.is_none(), "{}: `{heading}` has a before without an after", page.display());
    cases
}

impl Case {
    fn name(&self) -> String {
        let page = self.page.strip_prefix(root()).unwrap_or(&self.page);
        format!("{}:{}: {}", page.display(), self.line, self.heading)
    }

    /// The settings of the case; a stage that is off by default is on, since it is what the page is about.
    fn profile(&self) -> Result<Profile, Error> {
        let source = Source { name: "settings".to_owned(), text: self.settings.clone() };
        let mut profile = Profile::read(source, &only_built_in)?;
        if stage(&self.stage).is_some_and(|entry| !entry.active) {
            profile.set(&format!("{}.active", self.stage), "true")?;
        }
        Ok(profile)
    }

    /// Whether the text before has a header of its own.
    fn has_header(&self) -> bool {
        self.kind != "skein" || self.before.contains("(</extruderInitialization>)")
    }

    /// The whole text before.
    fn input(&self) -> String {
        if self.has_header() { self.before.clone() } else { format!("{HEADER}{}{END}", self.before) }
    }

    /// What the stage makes of the case, both ways.
    fn run(&self) -> Result<String, String> {
        let input = self.input();
        let in_text = self.run_as_text(&input);
        let in_memory = self.run_in_memory(&input);
        match (in_text, in_memory) {
            (Ok((text, notes)), Ok((made, remarks))) => {
                let described = |notes: &Notes| notes.summary().join("\n");
                if text != made {
                    return Err(format!("text (-) and memory (+) differ:\n{}", difference(&text, &made)));
                }
                if described(&notes) != described(&remarks) {
                    let (notes, remarks) = (described(&notes), described(&remarks));
                    return Err(format!(
                        "text (-) and memory (+) say different things:\n{}",
                        difference(&notes, &remarks)
                    ));
                }
                Ok(text)
            }
            (Err(error), Err(other)) if error == other => Ok(self.told(error)),
            (Ok(_), Err(error)) => Err(format!("only in memory it is refused: {error}")),
            (Err(error), Ok(_)) => Err(format!("only as text it is refused: {error}")),
            (Err(error), Err(other)) => Err(format!("as text: {error}\nin memory: {other}")),
        }
    }

    /// An error as the fence has it: who speaks is left out, and lines are counted in the fence.
    fn told(&self, mut error: Error) -> String {
        error.what.clear();
        if let (Place::Line(line), false) = (&mut error.place, self.has_header()) {
            *line = line.saturating_sub(HEADER.lines().count());
        }
        match &error.hint {
            Some(hint) => format!("{error}\nhint: {hint}\n"),
            None => format!("{error}\n"),
        }
    }

    fn run_as_text(&self, input: &str) -> Result<(String, Notes), Error> {
        let profile = self.profile()?;
        let mut notes = Notes::default();
        let text = craft(&self.stage, input.as_bytes(), &profile, &mut notes)?;
        Ok((self.seen(&text, input, &profile)?, notes))
    }

    fn run_in_memory(&self, input: &str) -> Result<(String, Notes), Error> {
        let profile = self.profile()?;
        let station = profile.station(&self.stage).ok_or_else(|| Error::new("there is no such stage"))?;
        let said = |error: Error| error.said_by(&self.stage);
        let mut notes = Notes::default();
        let document = match station.work.forms().0 {
            Form::Mesh => {
                let part = read_part(input.as_bytes(), &profile, &mut notes).map_err(said)?;
                Document::Mesh(Plate { parts: vec![part], done: Vec::new() })
            }
            Form::Slices => Document::Slices(Slices::read(input.as_bytes()).map_err(said)?),
            _ => Document::Skein(Skein::read(input.as_bytes()).map_err(said)?),
        };
        let mut out = Vec::new();
        let mut sink = |piece: &[u8]| {
            out.extend_from_slice(piece);
            Ok(())
        };
        let mut bench = Bench { machine: &profile.machine, notes: &mut notes, sink: &mut sink };
        let made = station.work.work(document, &mut bench).map_err(said)?;
        notes.said_by(&self.stage);
        let text = match made {
            // Not through the writer and back: what is in memory is what counts.
            Document::Skein(skein) if !self.whole() => layers_of(&skein),
            made => self.seen(&made.text().unwrap_or(out), input, &profile)?,
        };
        Ok((text, notes))
    }

    /// Whether the whole text is compared, header and all.
    fn whole(&self) -> bool {
        self.wanted == "skein" && self.expected.contains("(</extruderInitialization>)")
    }

    /// The part of what was made that the fence shows.
    fn seen(&self, text: &[u8], input: &str, profile: &Profile) -> Result<String, Error> {
        if self.wanted == "obj" {
            return obj(text);
        }
        let whole = String::from_utf8_lossy(text).into_owned();
        if Form::of(text) == Form::Slices {
            return Ok(lines(whole.lines().filter(|line| line.trim_start().starts_with("<g id"))));
        }
        if self.whole() {
            // The lines in which the pipeline signs are not the stage's.
            let own = |line: &&str| {
                !(line.starts_with("(<procedureName>")
                    || line.starts_with(&format!("(<setting> {} ", self.stage)))
            };
            return Ok(lines(whole.lines().filter(own)));
        }
        if self.wanted == "gcode" || self.stage == "export" {
            let (head, tail) = self.around(input, profile)?;
            let body: Vec<&str> = whole.lines().collect();
            return Ok(lines(body[head..body.len() - tail].iter().copied()));
        }
        Ok(layers_of(&Skein::read(text)?))
    }

    /// How many lines export writes before the first layer and behind the last.
    fn around(&self, input: &str, profile: &Profile) -> Result<(usize, usize), Error> {
        let count = |skein: &Skein, profile: &Profile| {
            let mut notes = Notes::default();
            craft("export", &skein.write(), profile, &mut notes)
                .map(|text| String::from_utf8_lossy(&text).lines().count())
        };
        let mut empty = Skein::read(input.as_bytes())?;
        empty.layers.clear();
        let both = count(&empty, profile)?;
        empty.tail.clear();
        let head = count(&empty, profile)?;
        Ok((head, both - head))
    }

    /// Why the case does not hold, if it does not, and what its last fence should say.
    fn check(&self) -> Result<(), (String, Option<String>)> {
        let found = self.run().map_err(|why| (why, None))?;
        if self.expected.trim().is_empty() {
            return Err((format!("the fence is empty; found\n{found}"), Some(found)));
        }
        let refused = self.wanted == "error";
        let hint_is_left_out = refused && !self.expected.contains("\nhint: ");
        let matches = if hint_is_left_out {
            found.lines().next() == self.expected.lines().next()
        } else {
            same(&found, &self.expected)
        };
        if matches {
            return Ok(());
        }
        let why = format!(
            "-- expected\n{}-- found\n{found}-- difference\n{}",
            self.expected,
            difference(&self.expected, &found)
        );
        Err((why, Some(found)))
    }
}

/// Equal but for blanks at the ends of lines.
fn same(one: &str, other: &str) -> bool {
    one.lines().map(str::trim_end).eq(other.lines().map(str::trim_end))
}

/// A mesh as the text of an OBJ file, which people can read.
fn obj(mesh: &[u8]) -> Result<String, Error> {
    let part = read_part(mesh, &Profile::default(), &mut Notes::default())?;
    let mm = |microns: i32| f64::from(microns) / 1000.0;
    let mut text = String::new();
    for at in &part.vertices {
        let _ = writeln!(text, "v {} {} {}", mm(at.x), mm(at.y), mm(at.z));
    }
    for face in &part.faces {
        let [a, b, c] = face.vertices.map(|vertex| vertex + 1);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    Ok(text)
}

fn lines<'a>(lines: impl Iterator<Item = &'a str>) -> String {
    lines.fold(String::new(), |text, line| text + line + "\n")
}

/// The text of all layers.
fn layers_of(skein: &Skein) -> String {
    let only = Skein {
        layers: skein.layers.iter().map(|Layer { lines }| Layer { lines: lines.clone() }).collect(),
        ..Skein::default()
    };
    String::from_utf8_lossy(&only.write()).into_owned()
}

#[test]
fn every_case_of_every_page_holds() {
    let mut failures = Vec::new();
    let mut count = 0;
    for (stage, page) in pages() {
        let mut wanted: Vec<(Range<usize>, String)> = Vec::new();
        for case in cases(&stage, &page) {
            count += 1;
            match case.check() {
                Ok(()) => {}
                Err((_, Some(found))) if blessing() => wanted.push((case.place.clone(), found)),
                Err((why, _)) => failures.push(format!("{}\n{why}", case.name())),
            }
        }
        if !wanted.is_empty() {
            let mut text = text_of(&page);
            // From the end, so that the places in front stay where they are.
            for (place, found) in wanted.into_iter().rev() {
                text.replace_range(place, &found);
            }
            fs::write(&page, text).unwrap_or_else(|error| panic!("{}: {error}", page.display()));
        }
    }
    assert!(count > 20, "only {count} cases were found");
    if !failures.is_empty() {
        let mut text = String::new();
        for failure in &failures {
            let _ = writeln!(text, "\n{failure}");
        }
        panic!(
            "{} of {count} cases do not hold\n{text}\nIf what was found is right, this rewrites the pages:\n  \
             CLAYFORGE_BLESS=1 cargo test -p all-tests cases\n",
            failures.len()
        );
    }
}

/// F6: a stage that is switched off gives its text back, to the byte.
#[test]
fn f6_a_stage_that_is_switched_off_changes_nothing_in_any_case() {
    for (stage, page) in pages() {
        for case in
            cases(&stage, &page).into_iter().filter(|case| case.kind == "skein" && case.stage != "export")
        {
            let mut profile = Profile::default();
            profile.set(&format!("{stage}.active"), "false").unwrap_or_else(|error| panic!("{error}"));
            let input = case.input();
            let text = craft(&stage, input.as_bytes(), &profile, &mut Notes::default());
            assert_eq!(
                text.as_deref().map(String::from_utf8_lossy),
                Ok(input.as_str().into()),
                "{}",
                case.name()
            );
        }
    }
}

/// F7 and F10: a stage signs directly above the end of the header, and does not work on what it has signed.
#[test]
fn f7_f10_a_stage_signs_its_work_and_does_it_once_in_every_case() {
    for (stage, page) in pages() {
        for case in cases(&stage, &page).into_iter().filter(|case| case.wanted == "skein") {
            let profile = case.profile().unwrap_or_else(|error| panic!("{}: {error}", case.name()));
            let mut notes = Notes::default();
            let once = craft(&stage, case.input().as_bytes(), &profile, &mut notes)
                .unwrap_or_else(|error| panic!("{}: {error}", case.name()));
            let text = String::from_utf8_lossy(&once);
            let signed = format!("(<procedureName> {stage} </procedureName>)\n(</extruderInitialization>)\n");
            assert!(text.contains(&signed), "{}\n{text}", case.name());
            let twice = craft(&stage, &once, &profile, &mut notes)
                .unwrap_or_else(|error| panic!("{}: {error}", case.name()));
            assert_eq!(String::from_utf8_lossy(&twice), text, "{}", case.name());
        }
    }
}

/// F11: a layer without anything in it passes through every stage.
#[test]
fn f11_a_layer_without_a_ring_passes_through_every_stage() {
    let mut text =
        format!("{HEADER}(<layer> 0.75 )\n(</layer>)\n(<layer> 2.25 )\n(</layer>)\n{END}").into_bytes();
    let profile = Profile::default();
    for station in
        profile.stations.iter().filter(|station| station.work.forms() == (Form::Skein, Form::Skein))
    {
        let name = station.entry.name;
        text = craft(name, &text, &profile, &mut Notes::default())
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let skein = Skein::read(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(layers_of(&skein), "(<layer> 0.75 )\n(</layer>)\n(<layer> 2.25 )\n(</layer>)\n", "{name}");
    }
}
