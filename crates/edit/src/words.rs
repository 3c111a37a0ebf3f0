//! Changes numbers in a line and leaves the rest of its text alone.

use gcode::{Token, Tokens};
use unit::decimal;

/// More decimals than these no machine and no reader keeps.
const MOST_DECIMALS: u32 = 9;

/// Words that a line shall have, at most one for each letter.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Changes {
    list: [Change; 10],
    length: usize,
}

/// A word that a line shall have.
#[derive(Clone, Copy, Debug, Default)]
struct Change {
    letter: u8,
    value: f64,
    decimals: u32,
}

impl Changes {
    /// The number behind `letter` shall be `value`, with at least so many decimals, or as many as it had.
    pub(crate) fn put(&mut self, letter: u8, value: f64, decimals: u32) {
        if let Some(slot) = self.list.get_mut(self.length) {
            *slot = Change { letter, value, decimals };
            self.length += 1;
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// Takes the change of a letter, so that it is not made twice.
    fn take(&mut self, letter: u8) -> Option<Change> {
        let place = self.list.iter().take(self.length).position(|change| change.letter == letter)?;
        self.length -= 1;
        self.list.swap(place, self.length);
        self.list.get(self.length).copied()
    }
}

/// Appends `text`, a line without its end, with `changes` made: numbers are replaced where they stand, and words that
/// are missing are put behind the last one. A checksum is made anew.
pub(crate) fn rewrite(out: &mut Vec<u8>, text: &[u8], mut changes: Changes) {
    let line_start = out.len();
    let lower = text.iter().find(|byte| byte.is_ascii_alphabetic()).is_some_and(u8::is_ascii_lowercase);
    let piece = |from: usize, to: usize| text.get(from..to).unwrap_or_default();
    let mut copied = 0;
    for token in Tokens::new(text) {
        match token {
            Token::Word { letter, value: Some(_), number_start, end, .. } => {
                if let Some(change) = changes.take(letter) {
                    out.extend_from_slice(piece(copied, number_start));
                    let written = decimals(piece(number_start, end));
                    write_number(out, change.value, change.decimals.max(written));
                } else {
                    out.extend_from_slice(piece(copied, end));
                }
                copied = end;
            }
            Token::Word { end, .. } | Token::Other { end, .. } => {
                out.extend_from_slice(piece(copied, end));
                copied = end;
            }
            Token::Checksum { start, end } => {
                append(out, &mut changes, lower);
                out.extend_from_slice(piece(copied, start));
                let sum = checksum(out.get(line_start..).unwrap_or_default());
                out.extend_from_slice(format!("*{sum}").as_bytes());
                let old = piece(start, end);
                let digits = old.iter().skip(1).take_while(|byte| byte.is_ascii_digit()).count();
                copied = start + 1 + digits;
            }
            Token::Remark { start, .. } if text.get(start) == Some(&b';') => break,
            Token::Remark { end, .. } => {
                // What stands between words is kept; what ends the line comes behind the words that are added.
                if Tokens::new(piece(end, text.len())).any(|token| matches!(token, Token::Word { .. })) {
                    out.extend_from_slice(piece(copied, end));
                    copied = end;
                }
            }
        }
    }
    append(out, &mut changes, lower);
    out.extend_from_slice(piece(copied, text.len()));
}

/// Writes the words that the line did not have.
fn append(out: &mut Vec<u8>, changes: &mut Changes, lower: bool) {
    for change in changes.list.iter().take(changes.length) {
        out.push(b' ');
        out.push(if lower { change.letter.to_ascii_lowercase() } else { change.letter });
        write_number(out, change.value, change.decimals);
    }
    changes.length = 0;
}

/// What stands behind the `*`: all bytes before it, one after the other, joined by exclusive or.
pub(crate) fn checksum(code: &[u8]) -> u8 {
    code.iter().fold(0, |sum, byte| sum ^ byte)
}

/// How many digits stand behind the point.
fn decimals(number: &[u8]) -> u32 {
    let point = number.iter().position(|&byte| byte == b'.');
    // A line is shorter than 4 GB, or its digits do not matter.
    point.map_or(0, |point| u32::try_from(number.len() - point - 1).unwrap_or(MOST_DECIMALS))
}

/// Appends a number with up to so many decimals.
pub(crate) fn write_number(out: &mut Vec<u8>, value: f64, decimals: u32) {
    /// Up to here doubles are whole numbers without gaps.
    const EXACT: f64 = 9e15;
    let places = decimals.min(MOST_DECIMALS);
    let scaled = (value * 10_f64.powi(places.cast_signed())).round();
    if scaled.abs() < EXACT {
        decimal::write_short(out, scaled as i64, places);
    } else {
        out.extend_from_slice(format!("{value}").as_bytes());
    }
}

/// Whether two numbers are one with so many decimals.
pub(crate) fn is_written_alike(a: f64, b: f64, decimals: u32) -> bool {
    (a - b).abs() * 10_f64.powi(decimals.cast_signed()) < 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(text: &str, words: &[(u8, f64)]) -> String {
        let mut changes = Changes::default();
        for &(letter, value) in words {
            changes.put(letter, value, 5);
        }
        let mut out = Vec::new();
        rewrite(&mut out, text.as_bytes(), changes);
        String::from_utf8(out).expect("text")
    }

    #[test]
    fn only_the_number_changes() {
        assert_eq!(changed("G1  X10.0 Y 7\tE.5 ; E9", &[(b'E', 0.25)]), "G1  X10.0 Y 7\tE0.25 ; E9");
        assert_eq!(changed("g1x10y(c) 7e2", &[(b'X', 5.0), (b'E', -0.5)]), "g1x5y(c) 7e-0.5");
        assert_eq!(changed("G1 X1.1234567", &[(b'X', 1.0 / 3.0)]), "G1 X0.3333333", "as many decimals");
        assert_eq!(changed("G1 X1 X2", &[(b'X', 3.0)]), "G1 X3 X2", "of two words the first counts");
    }

    #[test]
    fn missing_words_stand_behind_the_last_one() {
        assert_eq!(changed("G1 X1 ; go", &[(b'F', 600.0)]), "G1 X1 F600 ; go");
        assert_eq!(changed("g1 x1 (go)", &[(b'F', 600.0)]), "g1 x1 f600 (go)");
        assert_eq!(changed("G1", &[(b'X', 0.5)]), "G1 X0.5");
    }

    #[test]
    fn a_checksum_holds_again() {
        let code = "N3 G1 X2.5";
        let expected = format!("{code}*{} ;r", checksum(code.as_bytes()));
        assert_eq!(changed("N3 G1 X5*97 ;r", &[(b'X', 2.5)]), expected);
        let code = "N3 G1 X5 F60";
        let expected = format!("{code}*{}", checksum(code.as_bytes()));
        assert_eq!(changed("N3 G1 X5*97", &[(b'F', 60.0)]), expected);
    }

    #[test]
    fn no_number_is_lost_for_being_large() {
        let mut out = Vec::new();
        write_number(&mut out, 1e18, 5);
        assert_eq!(out, b"1000000000000000000");
    }
}
