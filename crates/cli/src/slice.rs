//! `clayforge slice`.

use crate::args::Slice;
use crate::dump::Dump;
use crate::output::{Output, put};
use crate::profile;
use crate::report::{self, Done, Stop, io_error};
use clayforge::{Error, Event, Form, stage};
use indicatif::{ProgressBar, ProgressStyle};
use std::fs;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Slices a part.
pub fn run(slice: &Slice) -> Done {
    let start = Instant::now();
    if slice.threads > 0 {
        // Only one pool can be, and it is this one: nothing has used it yet.
        let _ = clayforge::set_threads(slice.threads);
    }
    let profile = profile::load(&slice.settings)?;
    let output = target(slice)?;
    let part = fs::read(&slice.part).map_err(|error| io_error(&slice.part, "read", &error))?;
    let mut out = Output::open(&output)?;
    let mut dump = slice.dump.as_deref().map(Dump::begin).transpose()?;
    let progress = progress(slice);

    let mut clock = Instant::now();
    let mut times: Vec<(&'static str, Duration)> = Vec::new();
    let mut finished: Vec<u8> = Vec::new();
    let keeps = dump.is_some();
    let mut watch = |event: Event<'_>| match event {
        Event::Started { name } => {
            progress.set_message(name);
            clock = Instant::now();
            Ok(())
        }
        Event::Done { name, number, of, document } => {
            times.push((name, clock.elapsed()));
            progress.set_length(of as u64);
            progress.set_position(number as u64);
            match &mut dump {
                Some(dump) => dump.stage(number, name, document),
                None => Ok(()),
            }
        }
    };
    let mut sink = |piece: &[u8]| {
        if keeps {
            finished.extend_from_slice(piece);
        }
        out.write(piece)
    };
    let done = clayforge::slice(part, &profile, slice.until.as_deref(), &mut watch, &mut sink);
    progress.finish_and_clear();
    let sliced = done.map_err(|error| out.stop(report::about(&slice.part, error)))?;
    if let (Some(dump), Some(Form::Gcode)) = (&mut dump, sliced.form) {
        dump.file(&finished)?;
    }
    out.finish()?;
    if let Some(path) = &slice.report {
        put(path, report::json(&sliced, &times).as_bytes())?;
    }
    if !slice.quiet {
        report::notes(&sliced.notes);
        report::summary(&sliced, &output.display().to_string(), start.elapsed());
    }
    Ok(())
}

/// Where the result goes: as asked, or the part's name with the ending of what is made. What a stage in the middle
/// makes has the stage in its name, so that it is not taken for a file that the machine can read.
fn target(slice: &Slice) -> Result<PathBuf, Stop> {
    let last = slice.until.as_deref().and_then(stage).map(|entry| (entry.name, entry.make().forms().1));
    let output = match (&slice.output, last) {
        (Some(output), _) => output.clone(),
        (None, None | Some((_, Form::Gcode))) => slice.part.with_extension(Form::Gcode.extension()),
        (None, Some((name, form))) => slice.part.with_extension(format!("{name}.{}", form.extension())),
    };
    if same(&output, &slice.part) {
        return Err(Stop::Failed(
            Error::new("the output would take the place of the part")
                .hint("choose another name with -o")
                .said_by(&output.display().to_string()),
        ));
    }
    Ok(output)
}

fn same(one: &Path, other: &Path) -> bool {
    match (fs::canonicalize(one), fs::canonicalize(other)) {
        (Ok(one), Ok(other)) => one == other,
        _ => one == other,
    }
}

/// A bar on a terminal; elsewhere one that draws nothing.
fn progress(slice: &Slice) -> ProgressBar {
    if slice.quiet || !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(1);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {msg} {elapsed}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}
