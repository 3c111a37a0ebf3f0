//! clayforge against the other slicers of the machine: time and memory on the same parts with equal settings.

mod slicers;

use slicers::{SETTINGS, Setting, Slicer, cura_resources, installed};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// What a run came to; nothing when it failed.
#[derive(Clone, Copy)]
struct Run {
    time: Duration,
    /// The most memory that was in use, kB.
    memory: u64,
}

/// `compare [--clayforge BINARY] [--runs N] [--out FILE] [PART.stl]...` prints a table of medians and ratios.
pub fn run(args: &[String]) -> Result<(), String> {
    let (mut runs, mut ours, mut out, mut parts) = (5, None, None, Vec::new());
    let mut args = args.iter();
    while let Some(word) = args.next() {
        let mut value = || args.next().ok_or_else(|| format!("`{word}` needs a value"));
        match word.as_str() {
            "--runs" => {
                let number = value()?;
                runs = number.parse().map_err(|_| format!("`{number}` is no number of runs"))?;
            }
            "--clayforge" => ours = Some(PathBuf::from(value()?)),
            "--out" => out = Some(PathBuf::from(value()?)),
            option if option.starts_with('-') => {
                return Err(format!(
                    "`{option}` is not known; there are `--clayforge`, `--runs` and `--out`"
                ));
            }
            part => parts.push(PathBuf::from(part)),
        }
    }
    if runs == 0 {
        return Err("no runs, no figures: `--runs` must be 1 or more".to_owned());
    }
    if parts.is_empty() {
        parts =
            ["vase", "cup", "bowl"].map(|name| crate::root().join(format!("examples/{name}.stl"))).to_vec();
    }
    let slicers = installed(ours.map_or_else(built, Ok)?);
    let table = compared(&slicers, &parts, runs)?;
    match out {
        Some(path) => fs::write(&path, table).map_err(|error| said(&path, &error)),
        None => {
            println!("{table}");
            Ok(())
        }
    }
}

/// Ours, built for release.
fn built() -> Result<PathBuf, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let words = ["build", "--release", "--locked", "-p", "cli"];
    let build = Command::new(cargo).current_dir(crate::root()).args(words).status();
    if !build.is_ok_and(|status| status.success()) {
        return Err("clayforge could not be built".to_owned());
    }
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| crate::root().join("target"), PathBuf::from);
    Ok(target.join(format!("release/clayforge{}", std::env::consts::EXE_SUFFIX)))
}

fn said(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}

/// Runs all in turn (A B C A B C …), so that a change of the machine's speed meets all of them.
fn compared(slicers: &[Slicer], parts: &[PathBuf], runs: usize) -> Result<String, String> {
    let room = std::env::temp_dir().join(format!("clayforge-compare-{}", std::process::id()));
    fs::create_dir_all(&room).map_err(|error| said(&room, &error))?;
    let done = table(slicers, parts, runs, &room);
    fs::remove_dir_all(&room).map_err(|error| said(&room, &error))?;
    done
}

fn table(slicers: &[Slicer], parts: &[PathBuf], runs: usize, room: &Path) -> Result<String, String> {
    let mut table = String::from("| part | setting |");
    let (ours, others) = slicers.split_first().ok_or("there is nothing to compare")?;
    let _ = write!(table, " {} | MiB |", ours.name);
    for slicer in others {
        let _ = write!(table, " {} | MiB | time ratio | memory ratio |", slicer.name);
    }
    let columns = 4 + 4 * others.len();
    let _ = writeln!(table, "\n|{}", "---|".repeat(columns));
    let mut products = vec![(0.0, 0.0, 0u32); others.len()];
    for part in parts {
        let name = part.file_stem().unwrap_or_default().to_string_lossy();
        for setting in &SETTINGS {
            let found = in_turn(slicers, part, setting, runs, room)?;
            let (mine, theirs) = found.split_first().ok_or("there is nothing to compare")?;
            let _ = write!(table, "| {name} | {} |{}", setting.name, cells(mine));
            for (runs, product) in theirs.iter().zip(&mut products) {
                let (time, memory) = (
                    ratio(runs, mine, |run| run.time.as_secs_f64()),
                    ratio(runs, mine, |run| run.memory as f64),
                );
                let _ = match (time, memory) {
                    (Some(time), Some(memory)) => {
                        product.0 += time.ln();
                        product.1 += memory.ln();
                        product.2 += 1;
                        write!(table, "{} {time:.1} | {memory:.1} |", cells(runs))
                    }
                    _ => write!(table, "{} | |", cells(runs)),
                };
            }
            table.push('\n');
        }
    }
    table.push('\n');
    for (slicer, (time, memory, count)) in others.iter().zip(products).filter(|(_, (_, _, count))| *count > 0)
    {
        let mean = |sum: f64| (sum / f64::from(count)).exp();
        let _ = writeln!(
            table,
            "{}: {:.1} times the time and {:.1} times the memory, geometric means over {count}.",
            slicer.name,
            mean(time),
            mean(memory)
        );
    }
    Ok(table)
}

/// The runs of every slicer; the first of each only warms up.
fn in_turn(
    slicers: &[Slicer],
    part: &Path,
    setting: &Setting,
    runs: usize,
    room: &Path,
) -> Result<Vec<Vec<Option<Run>>>, String> {
    let mut found = vec![Vec::new(); slicers.len()];
    for turn in 0..=runs {
        for (slicer, runs) in slicers.iter().zip(&mut found) {
            let out = room.join("out.gcode");
            let words = (slicer.words)(setting, part, &out, room)?;
            let run = measured(&slicer.program, &words, &out, room)?;
            if turn > 0 {
                runs.push(run);
            }
        }
    }
    Ok(found)
}

/// Runs a program under GNU time, which knows the most memory that it used.
fn measured(program: &Path, words: &[String], out: &Path, room: &Path) -> Result<Option<Run>, String> {
    const TIME: &str = "/usr/bin/time";
    let report = room.join("memory");
    let _ = fs::remove_file(out);
    let resources = cura_resources();
    let begun = Instant::now();
    let status = Command::new(TIME)
        .args(["-q", "-f", "%M", "-o"])
        .args([&report, program])
        .args(words)
        .env("CURA_ENGINE_SEARCH_PATH", format!("{resources}/definitions:{resources}/extruders"))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .map_err(|error| format!("{TIME}: {error}; it comes with: apt-get install time"))?;
    let time = begun.elapsed();
    let text = fs::read_to_string(&report).map_err(|error| said(&report, &error))?;
    let memory = text.trim().parse().ok();
    let made = status.success() && fs::metadata(out).is_ok_and(|file| file.len() > 0);
    Ok(memory.filter(|_| made).map(|memory| Run { time, memory }))
}

/// Seconds and MiB, as medians.
fn cells(runs: &[Option<Run>]) -> String {
    let all: Option<Vec<Run>> = runs.iter().copied().collect();
    match all {
        Some(runs) => {
            let of = |figure: fn(&Run) -> f64| median(runs.iter().map(figure).collect());
            format!(
                " {:.3} s | {:.0} |",
                of(|run| run.time.as_secs_f64()),
                of(|run| run.memory as f64 / 1024.0)
            )
        }
        None => " failed | |".to_owned(),
    }
}

/// The median of the ratios of the turns; nothing when a run failed.
fn ratio(theirs: &[Option<Run>], ours: &[Option<Run>], figure: fn(&Run) -> f64) -> Option<f64> {
    let turns = theirs.iter().zip(ours);
    let ratios: Option<Vec<f64>> =
        turns.map(|(one, other)| Some(figure(&(*one)?) / figure(&(*other)?))).collect();
    ratios.map(median)
}

fn median(mut figures: Vec<f64>) -> f64 {
    figures.sort_by(f64::total_cmp);
    let middle = figures.len() / 2;
    match figures.len() {
        0 => f64::NAN,
        count if count.is_multiple_of(2) => (figures[middle - 1] + figures[middle]) / 2.0,
        _ => figures[middle],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(seconds: u64) -> Option<Run> {
        Some(Run { time: Duration::from_secs(seconds), memory: seconds * 1024 })
    }

    #[test]
    fn ratios_are_taken_turn_by_turn() {
        let (theirs, ours) = ([run(8), run(30), run(2)], [run(4), run(3), run(1)]);
        assert_eq!(ratio(&theirs, &ours, |run| run.time.as_secs_f64()), Some(2.0));
        assert_eq!(ratio(&[run(1), None], &[run(1), run(1)], |run| run.memory as f64), None);
    }

    #[test]
    fn a_median_of_an_even_number_lies_between() {
        assert_eq!((median(vec![4.0, 1.0]), median(vec![9.0, 1.0, 2.0])), (2.5, 2.0));
        assert_eq!(cells(&[run(1), None]), " failed | |");
    }
}
