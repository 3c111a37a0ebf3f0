//! What people read: errors, the summary, exit codes.

use clayforge::{Error, Notes, Sliced, stage};
use serde_json::json;
use std::fmt::Write as _;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

/// Why a command ended early.
pub enum Stop {
    /// It was refused or failed.
    Failed(Error),
    /// It found fault with what it was asked to check and has said so.
    Fault,
    /// Nobody reads what it writes any more; nothing to complain about.
    Unread,
}

impl From<Error> for Stop {
    fn from(error: Error) -> Self {
        Self::Failed(error)
    }
}

/// What a command returns.
pub type Done = Result<(), Stop>;

/// Says what went wrong, if anything, and turns it into an exit code.
pub fn exit(done: Done) -> ExitCode {
    match done {
        Ok(()) | Err(Stop::Unread) => ExitCode::SUCCESS,
        Err(Stop::Fault) => ExitCode::FAILURE,
        Err(Stop::Failed(error)) => {
            let mut text = format!("{} {error}\n", paint("error:", "1;31"));
            if let Some(hint) = &error.hint {
                let _ = writeln!(text, "  {} {hint}", paint("hint:", "1"));
            }
            say(&text);
            ExitCode::FAILURE
        }
    }
}

/// Writes to standard error; when even that fails there is nobody to tell.
pub fn say(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// A word in colour, if people with a terminal read it and have not asked for none.
fn paint(word: &str, colour: &str) -> String {
    let plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    if plain || !io::stderr().is_terminal() {
        word.to_owned()
    } else {
        format!("\x1b[{colour}m{word}\x1b[0m")
    }
}

/// Says the notes, those of equal text as one.
pub fn notes(notes: &Notes) {
    /// More lines than this nobody reads.
    const MOST: usize = 20;
    let lines = notes.summary();
    let mut text = String::new();
    for line in lines.iter().take(MOST) {
        let _ = writeln!(text, "{} {line}", paint("warning:", "1;33"));
    }
    if lines.len() > MOST {
        let _ = writeln!(text, "  and {} more; all of them: --report FILE.json", lines.len() - MOST);
    }
    say(&text);
}

/// The summary after a slice.
pub fn summary(sliced: &Sliced, output: &str, wall: Duration) {
    let mut text = String::new();
    if let Some(figures) = &sliced.figures {
        let _ = writeln!(
            text,
            "{}, {} ({:.2} m), {} ({:.2} m)",
            count(figures.layers, "layer"),
            count(figures.threads, "thread"),
            figures.extruded_mm / 1000.0,
            count(figures.travels, "travel"),
            figures.travel_mm / 1000.0
        );
        let _ = writeln!(
            text,
            "{:.1} ml of clay, {:.0} g wet; about {} on the machine",
            figures.volume_mm3 / 1000.0,
            figures.mass_g,
            time(figures.time_s)
        );
    }
    if let Some(found) = sliced.found.filter(|found| found.spirals > 0) {
        let _ = writeln!(text, "{}", count(found.spirals, "spiral"));
    }
    let _ = writeln!(text, "{} {output} ({:.2} s)", paint("wrote", "1;32"), wall.as_secs_f64());
    say(&text);
}

/// So many of a thing whose plural has an s.
fn count(number: usize, thing: &str) -> String {
    format!("{number} {thing}{}", if number == 1 { "" } else { "s" })
}

/// A duration as people say it.
pub fn time(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round() as u64;
    match minutes {
        0 => format!("{seconds:.0} s"),
        1..=59 => format!("{minutes} min"),
        _ => format!("{} h {:02} min", minutes / 60, minutes % 60),
    }
}

/// `--report` as JSON.
pub fn json(sliced: &Sliced, stages: &[(&'static str, Duration)]) -> String {
    let figures = sliced.figures.unwrap_or_default();
    let found = sliced.found.unwrap_or_default();
    let stages: Vec<_> = stages
        .iter()
        .map(|(name, time)| json!({ "name": name, "ms": time.as_secs_f64() * 1000.0 }))
        .collect();
    let warnings: Vec<_> = sliced
        .notes
        .iter()
        .map(|note| json!({ "stage": note.stage, "layer": note.layer, "text": note.text }))
        .collect();
    let report = json!({
        "layers": figures.layers,
        "spirals": found.spirals,
        "threads": figures.threads,
        "travels": figures.travels,
        "extruded_mm": figures.extruded_mm,
        "travel_mm": figures.travel_mm,
        "volume_mm3": figures.volume_mm3,
        "mass_g": figures.mass_g,
        "time_s": figures.time_s,
        "stages": stages,
        "warnings": warnings,
    });
    format!("{report:#}\n")
}

/// An error with the name of the input in front, so that a batch can be searched for it: when a stage refuses it, or
/// when the error names nobody. What a profile or another file is to blame for stays with that file.
pub fn about(input: &Path, mut error: Error) -> Error {
    if stage(&error.what).is_some() {
        error.what = format!("{}: {}", input.display(), error.what);
    }
    error.said_by(&input.display().to_string())
}

/// An error of the operating system about a file, in words.
pub fn io_error(path: &Path, doing: &str, error: &io::Error) -> Error {
    use io::ErrorKind;
    let (why, hint) = match error.kind() {
        ErrorKind::NotFound => {
            ("there is no such file or folder".to_owned(), Some("check the spelling and the folder"))
        }
        ErrorKind::PermissionDenied => (format!("you may not {doing} it"), Some("check the permissions")),
        ErrorKind::StorageFull | ErrorKind::FileTooLarge | ErrorKind::QuotaExceeded => (
            "there is no room left to write it".to_owned(),
            Some("nothing was changed; make room and try again"),
        ),
        ErrorKind::IsADirectory => ("it is a folder".to_owned(), Some("name a file")),
        _ => (format!("cannot {doing} it: {error}"), None),
    };
    let said = Error::new(why).said_by(&path.display().to_string());
    match hint {
        Some(hint) => said.hint(hint),
        None => said,
    }
}
