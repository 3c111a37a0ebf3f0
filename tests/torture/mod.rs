//! The torture set: parts as potters find them. Each is sliced by the command in a process of its own, and must come to
//! what its class says: the right layers, with a warning where one is due, or a refusal that names the trouble.

mod bytes;
mod cases;
mod plate;
mod shapes;

use crate::command::program;
use crate::support::{Triangles, cuboid, stl};
use serde_json::Value as Json;
use skein::Slices;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
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

struct Ran {
    code: Option<i32>,
    err: String,
    time: Duration,
    slices: Option<Slices>,
    warnings: Vec<String>,
    wrote: bool,
}

/// A part may take so many kilobytes more than the box and eight times its file, because what is written may be larger than
/// what was read: the G-code of the Klein bottle is three times its file, and with the dump it takes between 4 and 5 MB of
/// them; a hundred towers take 3 MB, and of the others none takes more than 1.1 MB. The rest is one stack of a thread and what
/// the pools of the allocator differ by from run to run.
const MARGIN: usize = 8 << 10;

/// The words that slice `part.stl`.
fn words(settings: &[&str]) -> Vec<String> {
    let program = program().display().to_string();
    let steps =
        ["part.stl", "-o", "part.gcode", "--dump", "steps", "--report", "report.json", "--threads", "1"];
    let fine = ["machine.bed=[400, 400, 400]", "machine.nozzle=2", "carve.layer_height=1"];
    let fine = fine.into_iter().chain(["carve.first_layer_height=1", "carve.bead_width=2"]);
    let sets = fine.chain(settings.iter().copied()).flat_map(|setting| ["--set", setting]);
    [program.as_str(), "slice"].into_iter().chain(steps).chain(sets).map(str::to_owned).collect()
}

/// The least memory with which the sound box is sliced, in kilobytes: what the program takes whatever the part is. Found by
/// halving.
fn floor() -> usize {
    static FLOOR: OnceLock<usize> = OnceLock::new();
    *FLOOR.get_or_init(|| {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("part.stl"), stl(&cube())).expect("a part");
        let words = words(&[]);
        let enough = |kilobytes: usize| {
            let mut command = limited(&words, kilobytes);
            let mut child =
                command.current_dir(folder.path()).stderr(Stdio::null()).spawn().expect("it starts");
            waited(&mut child);
            child.wait().is_ok_and(|done| done.success())
        };
        let (mut low, mut high) = (0, 1 << 20);
        assert!(enough(high), "the box is not sliced with a gigabyte");
        // On a system that does not keep to limits, anything is enough.
        while high - low > 64 {
            let middle = usize::midpoint(low, high);
            *(if enough(middle) { &mut high } else { &mut low }) = middle;
        }
        high
    })
}

/// Slices a file in a folder of its own, with a limit on memory and time.
fn run(case: &Case) -> Ran {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    fs::write(path("part.stl"), &case.file).expect("a part");
    let memory = floor() + MARGIN + 8 * case.file.len().div_ceil(1 << 10);
    let mut command = limited(&words(case.settings), memory);
    let mut child = command.current_dir(folder.path()).stderr(Stdio::piped()).spawn().expect("it starts");
    let time = waited(&mut child);
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

/// Waits until a run ends, or ends it; how long that took.
fn waited(child: &mut Child) -> Duration {
    let start = Instant::now();
    while child.try_wait().expect("a child").is_none() && start.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(2));
    }
    let time = start.elapsed();
    let _ = child.kill();
    time
}

/// How long a run may take on a machine that has other work; what hangs without working is met by this.
const PATIENCE: Duration = Duration::from_secs(120);

/// A command that may not have more than so many kilobytes of data (what it has asked for, touched or not), nor work for more than 10 s.
fn limited(words: &[String], kilobytes: usize) -> Command {
    if cfg!(unix) {
        let mut command = Command::new("sh");
        command
            .args(["-c", "ulimit -d \"$0\"; ulimit -t 10; exec \"$@\""])
            .arg(kilobytes.to_string())
            .args(words)
            // Where memory ends, drawing up who called whom takes more of it, and the standard library waits for itself.
            .env("RUST_BACKTRACE", "0");
        return command;
    }
    let mut command = Command::new(&words[0]);
    command.args(&words[1..]);
    command
}

fn read_slices(path: &Path) -> Option<Slices> {
    Slices::read(&fs::read(path).ok()?).ok()
}

/// The file is read back in threads while it is written, and every thread asks for its stack at once.
#[test]
#[cfg(target_os = "linux")]
fn a_slice_without_room_for_its_threads_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("part.stl"), stl(&cube())).expect("a part");
    let mut command = limited(&words(&[]), floor() * 2 / 3);
    let mut child = command.current_dir(folder.path()).stderr(Stdio::piped()).spawn().expect("it starts");
    let time = waited(&mut child);
    let output = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(time < PATIENCE && output.status.code() == Some(1), "{:?}: {said}", output.status);
    assert!(said.starts_with("error: ") && said.contains("no thread begins"), "{said}");
    assert!(!folder.path().join("part.gcode").exists());
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
