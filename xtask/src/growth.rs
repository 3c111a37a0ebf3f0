//! How time and memory grow with the triangles of a part and with its layers: figures, their exponents, and curves.

mod plot;

use crate::examples::{Mesh, vase, write};
use crate::process::{Bench, Run, clayforge, machine, median, said};
use plot::{Curve, Plot};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

const TRIANGLES: [usize; 4] = [10_000, 100_000, 1_000_000, 4_000_000];
const LAYERS: [usize; 6] = [100, 200, 500, 1000, 2000, 5000];
/// What the parts with many layers are made of.
const FACETS: usize = 100_000;
/// How high their layers are, in mm.
const LAYER: f64 = 0.1;

/// A size of a part, and what each way of treating it came to.
struct Size {
    count: usize,
    /// The larger of what was read and what was written, in bytes.
    file: u64,
    runs: Vec<Run>,
}

/// What is done to the parts of a series, as a curve is called and as a column is.
struct Series {
    ways: &'static [&'static str],
    sizes: Vec<Size>,
}

/// `growth [--clayforge BINARY] [--runs N]` measures, draws docs/growth-*.svg and puts the tables into
/// docs/performance.md.
pub fn run(args: &[String]) -> Result<(), String> {
    let (mut runs, mut program) = (5, None);
    for option in args.chunks(2) {
        let [name, value] = option else { return Err(format!("`{}` needs a value", option[0])) };
        match name.as_str() {
            "--clayforge" => program = Some(PathBuf::from(value)),
            "--runs" => runs = value.parse().map_err(|_| format!("`{value}` is no number of runs"))?,
            _ => return Err(format!("`{name}` is not known; there are `--clayforge` and `--runs`")),
        }
    }
    if runs == 0 {
        return Err("no runs, no figures: `--runs` must be 1 or more".to_owned());
    }
    let mut text = format!("Medians of {runs} runs on {}.\n", machine());
    let program = program.map_or_else(clayforge, Ok)?;
    let bench = Bench::new("growth")?;
    let docs = crate::root().join("docs");
    for (name, noun, series) in [
        ("growth-triangles", "triangles", by_triangles(&program, &bench, runs)?),
        ("growth-layers", "layers", by_layers(&program, &bench, runs)?),
    ] {
        let picture = docs.join(format!("{name}.svg"));
        fs::write(&picture, plot::draw(&series.plots(noun))).map_err(|error| said(&picture, &error))?;
        // Writing to a string cannot fail.
        let _ = write!(text, "\n![time and memory over {noun}]({name}.svg)\n\n{}", series.table(noun));
    }
    crate::page::put(&docs.join("performance.md"), "growth", &text)
}

/// The vase of ever more triangles: sliced in layers of 1.5 mm, examined, and with a hole and a face that is turned over
/// sliced once more.
fn by_triangles(program: &Path, bench: &Bench, runs: usize) -> Result<Series, String> {
    let (part, spoiled) = (bench.room.join("part.stl"), bench.room.join("spoiled.stl"));
    let out = bench.room.join("part.gcode");
    let mut series = Series { ways: &["slice", "slice, repaired", "mesh"], sizes: Vec::new() };
    for count in TRIANGLES {
        let mut mesh = vase(count);
        write(&part, "vase", &mesh)?;
        spoil(&mut mesh);
        write(&spoiled, "spoiled vase", &mesh)?;
        let ways = [slicing(&part, &out, &[]), slicing(&spoiled, &out, &[]), words(&["mesh"], &part)];
        series.measure(count, program, bench, runs, &ways, &[&part, &out])?;
    }
    Ok(series)
}

/// A vase that is ever higher, in layers of a tenth of a millimetre.
fn by_layers(program: &Path, bench: &Bench, runs: usize) -> Result<Series, String> {
    let (part, out) = (bench.room.join("part.stl"), bench.room.join("part.gcode"));
    let mut series = Series { ways: &["slice"], sizes: Vec::new() };
    let sets = [
        format!("carve.layer_height={LAYER}"),
        format!("carve.first_layer_height={LAYER}"),
        "carve.bead_width=1".to_owned(),
        "machine.nozzle=1".to_owned(),
        "machine.bed=[300,300,600]".to_owned(),
    ];
    for count in LAYERS {
        let mut mesh = vase(FACETS);
        let high = mesh.0.iter().map(|[_, _, z]| *z).fold(0.0, f32::max);
        let stretch = (count as f64 * LAYER) as f32 / high;
        for [_, _, z] in &mut mesh.0 {
            *z *= stretch;
        }
        write(&part, "vase", &mesh)?;
        series.measure(count, program, bench, runs, &[slicing(&part, &out, &sets)], &[&part, &out])?;
    }
    Ok(series)
}

/// Takes a face out of a mesh, and turns another over.
fn spoil((_, triangles): &mut Mesh) {
    let (first, second) = (triangles.len() / 3, triangles.len() / 2);
    triangles[second].swap(0, 1);
    triangles.remove(first);
}

fn words(words: &[&str], path: &Path) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).chain([path.display().to_string()]).collect()
}

fn slicing(part: &Path, out: &Path, sets: &[String]) -> Vec<String> {
    let mut all = words(&["slice", "--quiet"], part);
    all.extend(words(&["-o"], out));
    all.extend(sets.iter().flat_map(|set| ["--set".to_owned(), set.clone()]));
    all
}

impl Series {
    /// Treats a part in all ways, in turn; the first turn warms up.
    fn measure(
        &mut self,
        count: usize,
        program: &Path,
        bench: &Bench,
        turns: usize,
        ways: &[Vec<String>],
        files: &[&Path],
    ) -> Result<(), String> {
        let mut found = vec![Vec::new(); ways.len()];
        for turn in 0..=turns {
            for (words, found) in ways.iter().zip(&mut found) {
                let run = bench.run(program, words, &[])?;
                let run = run.ok_or_else(|| format!("clayforge {} failed", words.join(" ")))?;
                if turn > 0 {
                    found.push(run);
                }
            }
        }
        let size = |path: &&Path| fs::metadata(path).map_or(0, |file| file.len());
        let file = files.iter().map(size).max().unwrap_or(0);
        self.sizes.push(Size { count, file, runs: found.iter().map(|runs| middle(runs)).collect() });
        eprintln!("{count}");
        Ok(())
    }

    fn plots(&self, noun: &'static str) -> Vec<Plot> {
        let plot = |title: &str, y, figure: fn(&Run) -> f64| Plot {
            title: format!("{title} over {noun}"),
            x: noun,
            y,
            curves: self
                .ways
                .iter()
                .enumerate()
                .map(|(way, name)| Curve {
                    name,
                    points: self
                        .sizes
                        .iter()
                        .map(|size| [size.count as f64, figure(&size.runs[way])])
                        .collect(),
                })
                .collect(),
        };
        vec![plot("Time", "s", seconds), plot("Memory", "MiB", mebibytes)]
    }

    /// The figures, and how each grows from the line above: with which power of the size.
    fn table(&self, noun: &str) -> String {
        let mut table = format!(
            "| | {noun} | file, MB | s | power | processor, s | power | MiB | power | memory / file |\n"
        );
        let _ = writeln!(table, "|---|{}", "--:|".repeat(9));
        for (way, name) in self.ways.iter().enumerate() {
            let mut above: Option<&Size> = None;
            for size in &self.sizes {
                let run = &size.runs[way];
                let cell = |figure: fn(&Run) -> f64, decimals: usize| {
                    let power = above.map_or_else(String::new, |above| {
                        let grown = figure(run) / figure(&above.runs[way]);
                        format!("{:.2}", exponent(size.count as f64 / above.count as f64, grown))
                    });
                    format!("{:.decimals$} | {power}", figure(run))
                };
                let _ = writeln!(
                    table,
                    "| {} | {} | {:.1} | {} | {} | {} | {:.1} |",
                    if above.is_none() { name } else { "" },
                    size.count,
                    size.file as f64 / 1e6,
                    cell(seconds, 3),
                    cell(worked, 2),
                    cell(mebibytes, 0),
                    run.memory as f64 * 1024.0 / size.file as f64
                );
                above = Some(size);
            }
        }
        table
    }
}

fn seconds(run: &Run) -> f64 {
    run.time.as_secs_f64()
}

fn worked(run: &Run) -> f64 {
    run.worked.as_secs_f64()
}

fn mebibytes(run: &Run) -> f64 {
    run.memory as f64 / 1024.0
}

/// With which power of the size something has grown.
fn exponent(size: f64, grown: f64) -> f64 {
    libm::log(grown) / libm::log(size)
}

/// The medians of runs.
fn middle(runs: &[Run]) -> Run {
    let of = |figure: fn(&Run) -> f64| median(runs.iter().map(figure).collect());
    Run {
        time: std::time::Duration::from_secs_f64(of(seconds)),
        worked: std::time::Duration::from_secs_f64(of(worked)),
        memory: of(|run| run.memory as f64) as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    fn run(milliseconds: u64, memory: u64) -> Run {
        let time = Duration::from_millis(milliseconds);
        Run { time, worked: time, memory }
    }

    #[test]
    fn the_table_says_with_which_power_a_figure_grows() {
        let size = |count, runs| Size { count, file: 1_000_000, runs };
        let sizes = vec![
            size(100, vec![run(10, 2048)]),
            size(1000, vec![run(1000, 2048)]),
            size(2000, vec![run(2000, 8192)]),
        ];
        let table = Series { ways: &["slice"], sizes }.table("layers");
        let lines: Vec<&str> = table.lines().skip(2).collect();
        assert_eq!(lines[0], "| slice | 100 | 1.0 | 0.010 |  | 0.01 |  | 2 |  | 2.1 |");
        assert_eq!(lines[1], "|  | 1000 | 1.0 | 1.000 | 2.00 | 1.00 | 2.00 | 2 | 0.00 | 2.1 |");
        assert_eq!(lines[2], "|  | 2000 | 1.0 | 2.000 | 1.00 | 2.00 | 1.00 | 8 | 2.00 | 8.4 |");
        let columns = |line: &str| line.matches('|').count();
        assert!(table.lines().all(|line| columns(line) == columns(lines[0])), "{table}");
    }

    #[test]
    fn a_spoiled_part_has_a_hole_and_a_face_that_is_turned_over() {
        let mut mesh = vase(1000);
        spoil(&mut mesh);
        let mut bytes = Vec::new();
        crate::examples::encode(&mut bytes, "spoiled", &mesh).expect("memory takes everything");
        let mesh = import::Import::default().read(&bytes).expect("a part").mesh;
        assert_eq!((mesh.flaws.open, mesh.flaws.alike), (3, 3));
    }
}
