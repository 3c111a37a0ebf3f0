//! What a line of G-code says that no stage has made: just enough to see whether it moves, counts otherwise, or heats.

use crate::{Heaters, Line};

/// The line without its remark.
pub fn bare(line: &str) -> &str {
    let line = line.split(';').next().unwrap_or("");
    // A bracket opens a remark in the G-code of milling machines, but is plain text in a message for the display.
    let cut =
        if line.trim_start().starts_with(['G', 'g']) { line.split('(').next().unwrap_or("") } else { line };
    cut.trim_end()
}

/// The letter and the number of a line's command, and what follows. A line number before it is skipped.
pub fn command(line: &str) -> Option<(u8, u32, &str)> {
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
pub fn word(words: &str, letter: u8) -> Option<i64> {
    let at = words.bytes().position(|byte| byte.eq_ignore_ascii_case(&letter))?;
    unit::decimal::read_prefix(words.as_bytes().get(at + 1..)?.trim_ascii_start(), 3).map(|(value, _)| value)
}

impl Heaters {
    /// Whether a line would heat what the machine cannot heat. Firmware made for plastic obeys it if it can, and dries the
    /// clay in the nozzle; or finds no sensor, and stops.
    pub fn refuse(self, line: &str) -> bool {
        let Some((b'M', number, words)) = command(line) else { return false };
        let has = match number {
            104 | 109 => self.nozzle,
            140 | 190 => self.bed,
            141 | 191 => self.chamber,
            _ => return false,
        };
        // S heats and waits, R also waits while it cools: both hold a temperature.
        !has && [b'S', b'R'].iter().any(|letter| word(words, *letter).is_some_and(|value| value > 0))
    }
}

impl Line {
    /// What the line says to the machine, if no stage has a word of its own for it.
    pub fn plain(&self) -> Option<&str> {
        match self {
            Self::Verbatim(text) | Self::Pasted(text) => Some(text),
            _ => None,
        }
    }
}
