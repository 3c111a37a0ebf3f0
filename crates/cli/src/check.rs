//! `clayforge check`.

use crate::args::Check;
use crate::output::Output;
use crate::profile;
use crate::report::{Done, Stop, io_error};
use clayforge::Error;
use clayforge::clay_processor::{Limits, Model, Options, Processor, Report, Severity, json};
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Read, Write};
use std::path::Path;

/// Says what a file is made of, and whether it may be printed.
pub fn run(check: &Check) -> Done {
    let limits = match &check.profile {
        Some(name) => profile::read(name)?.limits(),
        None => Limits::default(),
    };
    let report = read(&check.file, limits)?;
    let mut out = Output::stdout();
    let written = if check.json {
        write_json(&report, &mut out)
    } else {
        out.write(described(&check.file.display().to_string(), &report).as_bytes())
    };
    written.map_err(|error| out.stop(error))?;
    out.finish()?;
    if report.ok() { Ok(()) } else { Err(Stop::Fault) }
}

/// Reads a file piece by piece: it may be larger than the memory.
fn read(path: &Path, limits: Limits) -> Result<Report, Error> {
    /// Large enough that asking for it costs nothing, small enough to stay in the cache.
    const PIECE: usize = 256 * 1024;
    let name = if path.as_os_str() == "-" { Path::new("standard input") } else { path };
    let refuse = |error: io::Error| io_error(name, "read", &error);
    let mut file: Box<dyn Read> = match path.as_os_str() == "-" {
        true => Box::new(io::stdin().lock()),
        false => Box::new(File::open(path).map_err(refuse)?),
    };
    let mut processor = Processor::new(Options { limits, ..Options::default() });
    let mut piece = vec![0; PIECE];
    loop {
        match file.read(&mut piece) {
            Ok(0) => return Ok(processor.finish()),
            Ok(length) => processor.push(piece.get(..length).unwrap_or_default()),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(refuse(error)),
        }
    }
}

/// The text of a large file's report is larger than the report, so it is never whole.
fn write_json(report: &Report, out: &mut Output) -> Result<(), Error> {
    /// Takes pieces of text; keeps the error that [`io::Error`] has no room for.
    struct Pieces<'a>(&'a mut Output, Option<Error>);
    impl Write for Pieces<'_> {
        fn write(&mut self, piece: &[u8]) -> io::Result<usize> {
            match self.0.write(piece) {
                Ok(()) => Ok(piece.len()),
                Err(error) => {
                    self.1 = Some(error);
                    Err(io::ErrorKind::Other.into())
                }
            }
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let mut pieces = BufWriter::new(Pieces(out, None));
    // What fails is kept by `Pieces`.
    let _ = writeln!(pieces, "{}", json(report)).and_then(|()| pieces.flush());
    match pieces.get_mut().1.take() {
        Some(error) => Err(error),
        None => Ok(()),
    }
}

fn described(name: &str, report: &Report) -> String {
    let mut text = format!("{name}: {} lines, {} that print\n", report.lines, report.extruding_lines);
    // Writing to a string cannot fail.
    for (who, model) in [("machine", &report.machine), ("letter", &report.letter)] {
        let _ = writeln!(text, "  {who:8} {}", counts(model));
    }
    for (spiral, pitch) in report.machine.spirals.iter().zip(&report.pitches) {
        let _ = write!(text, "  spiral from line {}: ", spiral.start_index + 1);
        let _ = match pitch.rise {
            Some(rise) => writeln!(text, "{:.1} turns, {rise:.3} mm each", pitch.turns),
            None => writeln!(text, "no whole turn above itself"),
        };
    }
    for note in &report.notes {
        let _ = writeln!(text, "  note: {}", note.text);
    }
    for verdict in &report.verdicts {
        let word = match verdict.severity {
            Severity::Forbids => "fault",
            Severity::Warns => "warning",
        };
        let _ = writeln!(text, "  {word}: {}", verdict.text);
    }
    text.push_str(if report.ok() { "ok\n" } else { "not ok\n" });
    text
}

fn counts(model: &Model) -> String {
    format!(
        "{} layers, {} spirals, up to {} mm; without extrusion {} moves across, {} up or down, {} aslant",
        model.layers.len(),
        model.spirals.len(),
        model.max_height,
        model.horizontal_movement_without_extrusion.len(),
        model.vertical_movement_without_extrusion.len(),
        model.diagonal_movement_without_extrusion.len()
    )
}
