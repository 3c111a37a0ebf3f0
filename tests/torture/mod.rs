//! The torture set: parts as potters find them. Each is sliced by the command in a process of its own, and must come to
//! what its class says: the right layers, with a warning where one is due, or a refusal that names the trouble.

mod bytes;
mod cases;
mod plate;
mod shapes;

use crate::command::program;
use crate::support::{Triangles, cuboid};
use serde_json::Value as Json;
use skein::Slices;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// What a part must come to.
pub enum Expect {
    /// Right layers, and not a word.
    Right(Layers),
    /// Right layers, and a warning that has this in it.
    Warned(Layers, &'static str),
    /// No file, and an error that has this in it.
    Refused(&'static str),
}

/// What the layers must be: the area in mm² and the number of loops at a height.
pub enum Layers {
    /// By a formula, the areas within a share.
    Are(Box<dyn Fn(f64) -> (f64, usize) + Send + Sync>, f64),
    /// Whatever they are: there is no right answer.
    Any,
}

/// A part with what it must come to.
pub struct Case {
    pub name: &'static str,
    pub file: Vec<u8>,
    pub settings: &'static [&'static str],
    pub expect: Expect,
}

/// The box that most spoiled parts are made of: 20 × 20 × 12 mm.
pub fn cube() -> Triangles {
    cuboid([0.0; 3], [20.0, 20.0, 12.0])
}

/// A process may have so much memory beside eight times its file: the program, its threads, the dump.
const BASE_MEMORY: usize = 384 << 20;

struct Ran {
    code: Option<i32>,
    err: String,
    time: Duration,
    slices: Option<Slices>,
    warnings: Vec<String>,
    wrote: bool,
}

/// Slices a file in a folder of its own, with a limit on memory and time.
fn run(case: &Case) -> Ran {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    fs::write(path("part.stl"), &case.file).expect("a part");
    let mut words = vec![program().display().to_string()];
    for word in [
        "slice",
        "part.stl",
        "-o",
        "part.gcode",
        "--dump",
        "steps",
        "--report",
        "report.json",
        "--threads",
        "1",
    ] {
        words.push(word.to_owned());
    }
    let fine = ["machine.bed=[400, 400, 400]", "machine.nozzle=2", "carve.layer_height=1"];
    let fine = fine.into_iter().chain(["carve.first_layer_height=1", "carve.bead_width=2"]);
    for setting in fine.chain(case.settings.iter().copied()) {
        words.extend(["--set".to_owned(), setting.to_owned()]);
    }
    let mut command = limited(&words, (BASE_MEMORY + 8 * case.file.len()) >> 10);
    let start = Instant::now();
    let mut child = command.current_dir(folder.path()).stderr(Stdio::piped()).spawn().expect("it starts");
    while child.try_wait().expect("a child").is_none() && start.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(2));
    }
    let time = start.elapsed();
    let _ = child.kill();
    let output = child.wait_with_output().expect("it ends");
    let report: Json = fs::read_to_string(path("report.json"))
        .ok()
        .and_then(|text| serde_json::from_str(&text).ok())
        .unwrap_or_default();
    let warnings = report["warnings"].as_array().cloned().unwrap_or_default();
    Ran {
        code: output.status.code(),
        err: String::from_utf8_lossy(&output.stderr).into_owned(),
        time,
        slices: read_slices(&path("steps").join("01-carve.svg")),
        warnings: warnings.iter().filter_map(|warning| warning["text"].as_str().map(str::to_owned)).collect(),
        wrote: path("part.gcode").exists(),
    }
}

/// How long a run may take on a machine that has other work; what hangs without working is met by this.
const PATIENCE: Duration = Duration::from_secs(120);

/// A command that may not have more than so many kilobytes, nor work for more than 10 s.
fn limited(words: &[String], kilobytes: usize) -> Command {
    if cfg!(unix) {
        let mut command = Command::new("sh");
        command
            .args(["-c", "ulimit -v \"$0\"; ulimit -t 10; exec \"$@\""])
            .arg(kilobytes.to_string())
            .args(words);
        return command;
    }
    let mut command = Command::new(&words[0]);
    command.args(&words[1..]);
    command
}

fn read_slices(path: &Path) -> Option<Slices> {
    Slices::read(&fs::read(path).ok()?).ok()
}

/// Why a run is not what was expected; nothing when it is.
fn fault(case: &Case, ran: &Ran) -> Option<String> {
    if ran.time >= PATIENCE {
        return Some(format!("it takes more than {} s", PATIENCE.as_secs()));
    }
    let first = ran.err.lines().next().unwrap_or_default();
    let (layers, warning) = match &case.expect {
        Expect::Refused(word) => {
            let refused =
                ran.code == Some(1) && !ran.wrote && first.starts_with("error:") && ran.err.contains(word);
            return (!refused).then(|| format!("exit {:?}, not refused for {word:?}: {}", ran.code, ran.err));
        }
        Expect::Right(layers) => (layers, None),
        Expect::Warned(layers, word) => (layers, Some(*word)),
    };
    if ran.code != Some(0) || !ran.wrote {
        return Some(format!("exit {:?}: {}", ran.code, ran.err));
    }
    let said = ran.warnings.join("\n");
    match warning {
        Some(word) if !said.contains(word) => return Some(format!("no warning has {word:?}: {said}")),
        // What later stages say of thin beads is not about the mesh.
        None if ran.warnings.iter().any(|text| TROUBLE.iter().any(|word| text.contains(word))) => {
            return Some(format!("a warning that is not due: {said}"));
        }
        _ => {}
    }
    let Layers::Are(at, share) = layers else { return None };
    let Some(slices) = &ran.slices else { return Some("no slices".to_owned()) };
    slices.layers.iter().find_map(|layer| {
        let (area, loops) = at(layer.z.mm());
        let found: f64 = layer.loops.iter().map(shape::Ring::area).sum();
        let near = (found - area).abs() <= share * area.max(1.0);
        (!near || layer.loops.len() != loops).then(|| {
            format!(
                "z {}: {found} mm² in {} loops, not {area} in {loops}; {said}",
                layer.z,
                layer.loops.len()
            )
        })
    })
}

/// Words of warnings that say that something is wrong with a mesh.
const TROUBLE: &[&str] =
    &["mesh", "face", "facet", "shell", "hole", "solid", "vertices", "T-junction", "nothing of"];

#[test]
fn every_part_of_the_torture_set_comes_to_what_its_class_says() {
    use rayon::prelude::*;
    let cases: Vec<Case> = bytes::cases().into_iter().chain(cases::cases()).collect();
    assert!(cases.len() >= 80, "there are {}", cases.len());
    program();
    let faults: Vec<String> = cases
        .par_iter()
        .filter_map(|case| fault(case, &run(case)).map(|fault| format!("{}: {fault}", case.name)))
        .collect();
    assert!(faults.is_empty(), "{} of {} parts:\n{}", faults.len(), cases.len(), faults.join("\n"));
}
