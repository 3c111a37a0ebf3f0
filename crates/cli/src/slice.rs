//! `clayforge slice`.

use crate::args::Slice;
use crate::dump::Dump;
use crate::output::{Output, put};
use crate::profile;
use crate::report::{self, Done, Stop, io_error};
use clayforge::{Error, Event, Form, Profile, stage};
use indicatif::{ProgressBar, ProgressStyle};
use std::cell::Cell;
use std::fs;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// Slices parts.
pub fn run(slice: &Slice) -> Done {
    let start = Instant::now();
    if slice.threads > 0 {
        // Only one pool can be, and it is this one: nothing has used it yet.
        let _ = clayforge::set_threads(slice.threads);
    }
    let mut settings = slice.settings.clone();
    settings.set.extend(slice.placing.settings());
    let profile = profile::load(&settings)?;
    let output = target(slice, &profile)?;
    // Which part is being read or was read last, so that a fault is told of the right one.
    let at = Cell::new(0);
    let read = |(index, path): (usize, &PathBuf)| {
        at.set(index);
        fs::read(path).map_err(|error| io_error(path, "read", &error))
    };
    // A file that is not there shall not cost a temporary one.
    let first = read((0, first(slice)))?;
    let rest = slice.parts.iter().enumerate().skip(1).map(read);
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
    let parts = std::iter::once(Ok(first)).chain(rest);
    let done = clayforge::slice_all(parts, &profile, slice.until.as_deref(), &mut watch, &mut sink);
    progress.finish_and_clear();
    let mut sliced = done.map_err(|error| out.stop(report::about(&slice.parts[at.get()], error)))?;
    if let (Some(dump), Some(Form::Gcode)) = (&mut dump, sliced.form) {
        dump.file(&finished)?;
    }
    out.finish()?;
    for (path, format) in slice.parts.iter().zip(&sliced.formats) {
        let extension = path.extension().map(|extension| extension.to_string_lossy()).unwrap_or_default();
        format.misnamed(&extension).into_iter().for_each(|note| sliced.notes.say(note));
    }
    sliced.notes.said_by("import");
    if let Some(path) = &slice.report {
        put(path, report::json(&sliced, &times).as_bytes())?;
    }
    if !slice.quiet {
        report::notes(&sliced.notes);
        report::summary(&sliced, &output.display().to_string(), start.elapsed());
    }
    Ok(())
}

/// The part that gives the result its name.
fn first(slice: &Slice) -> &PathBuf {
    // The parser asks for one at least.
    &slice.parts[0]
}

/// Where the result goes: as asked, or the part's name with the ending of what is made. What a stage in the middle
/// makes has the stage in its name, so that it is not taken for a file that the machine can read.
fn target(slice: &Slice, profile: &Profile) -> Result<PathBuf, Stop> {
    let last = slice.until.as_deref().and_then(stage).map(|entry| (entry.name, entry.make().forms().1));
    let output = match (&slice.output, last) {
        (Some(output), _) => output.clone(),
        (None, None | Some((_, Form::Gcode))) => {
            let part = first(slice);
            let stem = part.file_stem().unwrap_or_default().to_string_lossy();
            part.with_file_name(profile.file_name(&stem, &now()))
        }
        (None, Some((name, form))) => first(slice).with_extension(format!("{name}.{}", form.extension())),
    };
    if slice.parts.iter().any(|part| same(&output, part)) {
        return Err(Stop::Failed(
            Error::new("the output would take the place of the part")
                .hint("choose another name with -o")
                .said_by(&output.display().to_string()),
        ));
    }
    Ok(output)
}

/// The day and the time in UTC, like `2026-11-22-1605`.
fn now() -> String {
    let minutes = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs() / 60);
    let (days, minutes) = (minutes / 1440, minutes % 1440);
    // Civil from days, counted in eras of 400 years that begin in March (Hinnant, chrono-compatible date algorithms).
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let date = day - (153 * month + 2) / 5 + 1;
    let (year, month) = if month < 10 { (year, month + 3) } else { (year + 1, month - 9) };
    format!("{:04}-{month:02}-{date:02}-{:02}{:02}", era * 400 + year, minutes / 60, minutes % 60)
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
