//! `clayforge craft`.

use crate::args::Craft;
use crate::output::Output;
use crate::profile;
use crate::report::{self, Done, io_error};
use clayforge::{Error, Notes};
use std::fs;
use std::io::{self, Read};
use std::path::Path;

/// Runs one stage.
pub fn run(craft: &Craft) -> Done {
    let input = craft.input.as_deref().unwrap_or(Path::new("-"));
    if clayforge::stage(&craft.stage).is_none() {
        // Said before anything is waited for.
        let error = Error::new(format!("there is no stage `{}`", craft.stage)).said_by("craft");
        return Err(error.hint("all stages: clayforge stages").into());
    }
    let profile = profile::load(&craft.settings)?;
    let text = read(input)?;
    let mut out = Output::open(craft.output.as_deref().unwrap_or(Path::new("-")))?;
    let mut notes = Notes::default();
    let done = clayforge::craft(&craft.stage, &text, &profile, &mut notes, &mut |piece| out.write(piece));
    let name = if input.as_os_str() == "-" { Path::new("standard input") } else { input };
    done.map_err(|error| out.stop(report::about(name, error)))?;
    out.finish()?;
    report::notes(&notes);
    Ok(())
}

/// All bytes of a file, or of standard input for `-`.
pub fn read(input: &Path) -> Result<Vec<u8>, Error> {
    if input.as_os_str() == "-" {
        let mut text = Vec::new();
        io::stdin()
            .lock()
            .read_to_end(&mut text)
            .map_err(|error| io_error(Path::new("standard input"), "read", &error))?;
        return Ok(text);
    }
    fs::read(input).map_err(|error| io_error(input, "read", &error))
}
