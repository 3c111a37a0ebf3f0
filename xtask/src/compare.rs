//! clayforge against the other slicers of the machine on the same parts with equal settings: time, memory, and what comes
//! out.

mod slicers;
mod tables;

use crate::process::{Bench, Run, clayforge, machine, said};
use crate::quality::{Measure, Quality, mesh};
use slicers::{SETTINGS, Setting, Slicer, cura_resources, installed};
use std::fs;
use std::path::{Path, PathBuf};

/// How many layers of a file are looked at for what they cover.
const LAYERS: usize = 40;

/// What became of a part at a setting in the hands of one slicer.
struct Outcome {
    /// Every turn but the first, which warms up; nothing where it failed.
    runs: Vec<Option<Run>>,
    /// What came out, if anything did.
    quality: Option<Quality>,
}

/// A part at a setting, and what every slicer made of it.
struct Meeting {
    part: String,
    setting: &'static str,
    outcomes: Vec<Outcome>,
}

/// What is asked for.
struct Asked {
    runs: usize,
    ours: Option<PathBuf>,
    out: Option<PathBuf>,
    page: bool,
    parts: Vec<PathBuf>,
}

/// `compare [--clayforge BINARY] [--runs N] [--out FILE | --page] [PART.stl]...` prints a table of times, memory and their
/// ratios, and one of what comes out; with `--runs 0` the second alone. `--page` puts them into docs/performance.md.
pub fn run(args: &[String]) -> Result<(), String> {
    let asked = Asked::read(args)?;
    let machine = machine();
    let slicers = installed(asked.ours.map_or_else(clayforge, Ok)?);
    let bench = Bench::new("compare")?;
    let mut meetings = Vec::new();
    for part in &asked.parts {
        for setting in &SETTINGS {
            let outcomes = in_turn(&slicers, part, setting, asked.runs, &bench)?;
            let part = part.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            eprintln!("{part}, {}", setting.name);
            meetings.push(Meeting { part, setting: setting.name, outcomes });
        }
    }
    let mut tables = Vec::new();
    if asked.runs > 0 {
        tables.push(("compare: time and memory", tables::times(&slicers, &meetings, asked.runs, &machine)));
    }
    tables.push(("compare: what comes out", tables::qualities(&slicers, &meetings)));
    if asked.page {
        let page = crate::root().join("docs/performance.md");
        return tables.iter().try_for_each(|(name, table)| crate::page::put(&page, name, table));
    }
    let text: Vec<String> = tables.into_iter().map(|(_, table)| table).collect();
    match asked.out {
        Some(path) => fs::write(&path, text.join("\n")).map_err(|error| said(&path, &error)),
        None => {
            println!("{}", text.join("\n"));
            Ok(())
        }
    }
}

impl Asked {
    fn read(args: &[String]) -> Result<Self, String> {
        let mut asked = Self { runs: 5, ours: None, out: None, page: false, parts: Vec::new() };
        let mut args = args.iter();
        while let Some(word) = args.next() {
            let mut value = || args.next().ok_or_else(|| format!("`{word}` needs a value"));
            match word.as_str() {
                "--runs" => {
                    let number = value()?;
                    asked.runs = number.parse().map_err(|_| format!("`{number}` is no number of runs"))?;
                }
                "--clayforge" => asked.ours = Some(PathBuf::from(value()?)),
                "--out" => asked.out = Some(PathBuf::from(value()?)),
                "--page" => asked.page = true,
                option if option.starts_with('-') => {
                    return Err(format!(
                        "`{option}` is not known; there are `--clayforge`, `--runs`, `--out` and `--page`"
                    ));
                }
                part => asked.parts.push(PathBuf::from(part)),
            }
        }
        if asked.parts.is_empty() {
            let example = |name| crate::root().join(format!("examples/{name}.stl"));
            asked.parts = ["vase", "cup", "bowl"].map(example).to_vec();
        }
        Ok(asked)
    }
}

/// Runs all in turn (A B C A B C …), so that a change of the machine's speed meets all of them, and measures what the last
/// turn has made.
fn in_turn(
    slicers: &[Slicer],
    part: &Path,
    setting: &Setting,
    runs: usize,
    bench: &Bench,
) -> Result<Vec<Outcome>, String> {
    let bytes = fs::read(part).map_err(|error| said(part, &error))?;
    let solid = mesh(&bytes).map_err(|error| format!("{}: {error}", part.display()))?;
    let out = |slicer: &Slicer| bench.room.join(format!("{}.gcode", slicer.name));
    let mut found = vec![Vec::new(); slicers.len()];
    for turn in 0..=runs {
        for (slicer, runs) in slicers.iter().zip(&mut found) {
            let run = sliced(slicer, setting, part, &out(slicer), bench)?;
            if turn > 0 {
                runs.push(run);
            }
        }
    }
    let outcome = |(slicer, runs): (&Slicer, Vec<Option<Run>>)| {
        let measure = Measure { area: (slicer.area)(setting), layers: LAYERS };
        let quality = fs::read(out(slicer)).ok().and_then(|gcode| measure.of(&solid, &gcode).ok());
        Outcome { runs, quality }
    };
    Ok(slicers.iter().zip(found).map(outcome).collect())
}

/// Lets a slicer slice; nothing when it fails or writes nothing.
fn sliced(
    slicer: &Slicer,
    setting: &Setting,
    part: &Path,
    out: &Path,
    bench: &Bench,
) -> Result<Option<Run>, String> {
    let _ = fs::remove_file(out);
    let words = (slicer.words)(setting, part, out, &bench.room)?;
    let resources = cura_resources();
    let search = format!("{resources}/definitions:{resources}/extruders");
    let run = bench.run(&slicer.program, &words, &[("CURA_ENGINE_SEARCH_PATH", search)])?;
    Ok(run.filter(|_| fs::metadata(out).is_ok_and(|file| file.len() > 0)))
}
