//! The tables of a comparison.

use super::slicers::Slicer;
use super::{Meeting, Outcome};
use crate::process::{Run, median};
use crate::quality::Quality;
use std::fmt::Write as _;

/// Times, memory and their ratios, a line for each part and setting; and the geometric means of the ratios.
pub fn times(slicers: &[Slicer], meetings: &[Meeting], runs: usize, machine: &str) -> String {
    let Some((ours, others)) = slicers.split_first() else { return String::new() };
    // Writing to a string cannot fail, here and below.
    let mut table = format!("Medians of {runs} turns on {machine}; {}.\n\n", versions(slicers));
    let _ = write!(table, "| part | setting | {} | MiB |", ours.name);
    for slicer in others {
        let _ = write!(table, " {} | MiB | time ratio | memory ratio |", slicer.name);
    }
    let _ = writeln!(table, "\n|{}", "---|".repeat(4 + 4 * others.len()));
    let mut products = vec![(0.0, 0.0, 0u32); others.len()];
    for Meeting { part, setting, outcomes } in meetings {
        let Some((Outcome { runs: mine, .. }, theirs)) = outcomes.split_first() else { continue };
        let _ = write!(table, "| {part} | {setting} |{}", cells(mine));
        for (Outcome { runs, .. }, product) in theirs.iter().zip(&mut products) {
            let time = ratio(runs, mine, |run| run.time.as_secs_f64());
            let memory = ratio(runs, mine, |run| run.memory as f64);
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
    table.push('\n');
    let compared = others.iter().zip(products).filter(|(_, (_, _, count))| *count > 0);
    let said = compared.map(|(slicer, (time, memory, count))| {
        let mean = |sum: f64| (sum / f64::from(count)).exp();
        let (time, memory) = (mean(time), mean(memory));
        format!("{}: {time:.1} times the time and {memory:.1} times the memory over {count}", slicer.name)
    });
    let said: Vec<String> = said.collect();
    if !said.is_empty() {
        let _ = writeln!(table, "Geometric means: {}.", said.join("; "));
    }
    table
}

/// What comes out, a line for each part, setting and slicer.
pub fn qualities(slicers: &[Slicer], meetings: &[Meeting]) -> String {
    let measured =
        meetings.iter().flat_map(|meeting| &meeting.outcomes).filter_map(|outcome| outcome.quality.as_ref());
    let widest = measured.map(Quality::figures).max_by_key(Vec::len).unwrap_or_default();
    let names: Vec<&str> = widest.iter().map(|(name, _)| *name).collect();
    let mut table =
        format!("With {}.\n\n| part | setting | slicer | {} |\n", versions(slicers), names.join(" | "));
    let _ = writeln!(table, "|---|---|---|{}", "--:|".repeat(names.len()));
    for Meeting { part, setting, outcomes } in meetings {
        for (slicer, outcome) in slicers.iter().zip(outcomes) {
            let mut cells: Vec<String> = match &outcome.quality {
                Some(quality) => quality.figures().into_iter().map(|(_, figure)| figure).collect(),
                None => vec!["refused".to_owned()],
            };
            cells.resize(names.len(), String::new());
            let _ = writeln!(table, "| {part} | {setting} | {} | {} |", slicer.name, cells.join(" | "));
        }
    }
    table
}

/// The slicers with their versions.
fn versions(slicers: &[Slicer]) -> String {
    let all: Vec<String> = slicers.iter().map(Slicer::version).collect();
    all.join(", ")
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    fn run(seconds: u64) -> Option<Run> {
        let time = Duration::from_secs(seconds);
        Some(Run { time, worked: time, memory: seconds * 1024 })
    }

    #[test]
    fn ratios_are_taken_turn_by_turn() {
        let (theirs, ours) = ([run(8), run(30), run(2)], [run(4), run(3), run(1)]);
        assert_eq!(ratio(&theirs, &ours, |run| run.time.as_secs_f64()), Some(2.0));
        assert_eq!(ratio(&[run(1), None], &[run(1), run(1)], |run| run.memory as f64), None);
    }

    #[test]
    fn a_run_that_failed_has_no_figures() {
        assert_eq!(cells(&[run(1), None]), " failed | |");
        assert_eq!(cells(&[run(1), run(3)]), " 2.000 s | 2 |");
    }
}
