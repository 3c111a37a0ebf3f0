//! Without some commands.

use std::collections::BTreeMap;

use gcode::{Code, Line};
use skein::Error;

use crate::tape::{line_end, raw_lines, split_bom};
use crate::writer::Writer;
use crate::{Edited, said};

/// Takes named commands out of a file, each with its whole line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clean {
    /// Such as `M104`; case and leading zeros do not matter.
    pub commands: Vec<String>,
}

/// Temperatures of nozzle, bed and chamber: set, and set and wait.
pub const HEATERS: [&str; 6] = ["M104", "M109", "M140", "M190", "M141", "M191"];
/// The fan, on and off.
pub const FANS: [&str; 2] = ["M106", "M107"];

/// What moves, or decides what a later move means: without it everything behind would go elsewhere.
const NEEDED: [&str; 15] =
    ["G0", "G1", "G2", "G3", "G17", "G18", "G19", "G20", "G21", "G28", "G90", "G91", "G92", "M82", "M83"];

impl Clean {
    pub(crate) fn apply(&self, text: &[u8]) -> Result<Edited, Error> {
        // How often each was found.
        let mut found: BTreeMap<Code, usize> = BTreeMap::new();
        for name in &self.commands {
            found.insert(command(name)?, 0);
        }
        if found.is_empty() {
            return Err(Error::new("no command is named that shall go")
                .hint("name some, such as M104,M140, or use the presets for heaters and fans"));
        }
        let (bom, body) = split_bom(text);
        let mut writer = Writer::new(text.len(), line_end(text));
        writer.out.extend_from_slice(bom);
        let mut line = Line::default();
        for raw in raw_lines(body) {
            line.read(raw.text);
            match line.command.and_then(|command| found.get_mut(&command)) {
                Some(count) => {
                    *count += 1;
                    writer.leave_out(raw);
                }
                None => writer.keep(raw, &line),
            }
        }
        let counts: Vec<String> = found
            .iter()
            .filter(|(_, count)| **count > 0)
            .map(|(command, count)| format!("{} {count} times", spelled(*command)))
            .collect();
        let sentence = if counts.is_empty() {
            "nothing to take out".to_owned()
        } else {
            format!("taken out: {}", counts.join(", "))
        };
        Ok(said(writer.out, &[sentence]))
    }
}

/// A command by its name.
fn command(name: &str) -> Result<Code, Error> {
    let line = Line::of(name.trim().as_bytes());
    let is_alone = !line.unreadable && !line.words.has_bare() && line.words.iter().next().is_none();
    let Some(command) = line.command.filter(|_| is_alone) else {
        return Err(Error::new(format!("`{name}` is no command"))
            .hint("a command is a letter and a number, such as M104"));
    };
    if NEEDED.iter().any(|needed| Line::of(needed.as_bytes()).command == Some(command)) {
        return Err(Error::new(format!("`{name}` cannot go: what follows it would be printed elsewhere"))
            .hint("take out commands that neither move nor say how to read a move"));
    }
    Ok(command)
}

fn spelled(command: Code) -> String {
    format!("{}{}", char::from(command.letter), f64::from(command.thousandths) / 1000.0)
}
