//! The potter's own lines before and after the print.

use crate::Comments;
use skein::{Error, Place};

/// Lines that are copied into the file as they are.
pub(crate) struct Alteration<'a>(&'a str);

/// Commands that wait for or set a temperature.
const HEATERS: [u32; 4] = [104, 109, 140, 190];

impl<'a> Alteration<'a> {
    /// # Errors
    /// When a line would heat. Firmware made for plastic obeys it if it can, and dries the clay in the nozzle.
    pub(crate) fn new(name: &str, text: &'a str) -> Result<Self, Error> {
        for (index, line) in text.lines().enumerate() {
            if heats(line) {
                return Err(Error::new(format!("`{}` heats", line.trim()))
                    .at(Place::At(format!("`{name}`, line {}", index + 1)))
                    .hint("a clay printer has no heater: leave the line out"));
            }
        }
        Ok(Self(text))
    }

    pub(crate) fn write(&self, comments: Comments, out: &mut Vec<u8>) {
        for line in self.0.lines() {
            let line = if comments == Comments::None { bare(line) } else { line.trim_end() };
            if !line.trim().is_empty() {
                out.extend_from_slice(line.as_bytes());
                out.push(b'\n');
            }
        }
    }

    /// The first line that moves down, or to a height below `top` microns. The lines are taken to begin in absolute
    /// coordinates.
    pub(crate) fn lowers(&self, top: i32) -> Option<&'a str> {
        let mut relative = false;
        self.0.lines().find(|line| match command(line) {
            Some((b'G', 90, _)) => {
                relative = false;
                false
            }
            Some((b'G', 91, _)) => {
                relative = true;
                false
            }
            Some((b'G', 0 | 1, words)) => {
                let floor = if relative { 0 } else { i64::from(top) };
                word(words, b'Z').is_some_and(|z| z < floor)
            }
            _ => false,
        })
    }
}

/// The line without its remark.
pub(crate) fn bare(line: &str) -> &str {
    let line = line.split(';').next().unwrap_or("");
    // A bracket opens a remark in the G-code of milling machines, but is plain text in a message for the display.
    let cut =
        if line.trim_start().starts_with(['G', 'g']) { line.split('(').next().unwrap_or("") } else { line };
    cut.trim_end()
}

fn heats(line: &str) -> bool {
    let Some((b'M', number, words)) = command(line) else { return false };
    // S heats and waits, R also waits while it cools: both hold a temperature.
    HEATERS.contains(&number)
        && [b'S', b'R'].iter().any(|letter| word(words, *letter).is_some_and(|value| value > 0))
}

/// The letter and the number of a line's command, and what follows. A line number before it is skipped.
pub(crate) fn command(line: &str) -> Option<(u8, u32, &str)> {
    let line = bare(line).trim_start();
    let line = match line.strip_prefix(['N', 'n']) {
        Some(numbered) => numbered.trim_start_matches(|digit: char| digit.is_ascii_digit()).trim_start(),
        None => line,
    };
    let letter = line.bytes().next()?.to_ascii_uppercase();
    let words = line.get(1..)?;
    let end = words.bytes().position(|byte| !byte.is_ascii_digit()).unwrap_or(words.len());
    let (number, words) = words.split_at(end);
    Some((letter, number.parse().ok()?, words))
}

/// The number behind a letter in thousandths, if it is there and a number.
fn word(words: &str, letter: u8) -> Option<i64> {
    let at = words.bytes().position(|byte| byte.eq_ignore_ascii_case(&letter))?;
    unit::decimal::read_prefix(words.as_bytes().get(at + 1..)?.trim_ascii_start(), 3).map(|(value, _)| value)
}
