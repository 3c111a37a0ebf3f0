//! The words of a command that is not a move, read when they are asked for.

use crate::token::{Token, Tokens};

/// Millimetres in an inch.
pub const MM_PER_INCH: f64 = 25.4;

/// The unit in which a line writes its lengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LengthUnit {
    /// `G21`.
    #[default]
    Millimetre,
    /// `G20`.
    Inch,
}

impl LengthUnit {
    /// Millimetres in one of it.
    #[inline]
    pub const fn mm(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Inch => MM_PER_INCH,
        }
    }
}

/// The words behind a code, as the line has them. They stay text because they are few, and because what they mean
/// depends on the machine.
///
/// ```
/// use gcode::{LengthUnit, Parameters};
///
/// let words = Parameters::new(b"X1 Y S=2.5", LengthUnit::Inch);
/// assert_eq!(words.length(b'X'), Some(25.4));
/// assert_eq!(words.get(b'S'), Some(2.5));
/// assert!(words.has(b'Y') && words.get(b'Y').is_none());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Parameters<'a> {
    /// The text behind the code, without line number, remarks and checksum.
    pub text: &'a [u8],
    /// The unit of the lengths in it.
    pub unit: LengthUnit,
}

impl<'a> Parameters<'a> {
    /// The words that `text` spells.
    pub const fn new(text: &'a [u8], unit: LengthUnit) -> Self {
        Self { text, unit }
    }

    /// The number behind `letter` (in upper case), as written. Of two words with one letter the last counts.
    pub fn get(&self, letter: u8) -> Option<f64> {
        self.iter().filter(|&(found, _)| found == letter).last().and_then(|(_, value)| value)
    }

    /// The number behind `letter` as a length, mm.
    pub fn length(&self, letter: u8) -> Option<f64> {
        Some(self.get(letter)? * self.unit.mm())
    }

    /// Whether `letter` is there, with a number or without.
    pub fn has(&self, letter: u8) -> bool {
        self.iter().any(|(found, _)| found == letter)
    }

    /// The letters in upper case with their numbers, in the order in which they are written, without G and M: those are
    /// codes of their own. `X5`, `X 5` and `X=5` are the same.
    pub fn iter(&self) -> impl Iterator<Item = (u8, Option<f64>)> + 'a {
        let text = self.text;
        let words =
            Tokens::new(text).filter(|token| !matches!(token, Token::Word { letter: b'G' | b'M', .. }));
        words.filter_map(move |token| match token {
            Token::Word { letter, value: Some(value), .. } => Some((letter, Some(value))),
            Token::Word { letter, value: None, end, .. } => Some((letter, assigned(text, end))),
            _ => None,
        })
    }

    /// The number of a name such as `ACCEL` in `SET_VELOCITY_LIMIT ACCEL=500`, in either case.
    pub fn named(&self, name: &str) -> Option<f64> {
        let words = self.text.split(|byte| byte.is_ascii_whitespace());
        words.rev().find_map(|word| {
            let (key, value) = word.split_at_checked(name.len())?;
            let number = value.strip_prefix(b"=")?;
            let (value, end) = crate::read_number(number, 0)?;
            (key.eq_ignore_ascii_case(name.as_bytes()) && end == number.len()).then_some(value)
        })
    }
}

/// The number behind an equal sign at `start`.
fn assigned(text: &[u8], start: usize) -> Option<f64> {
    let rest = text.get(start..)?.trim_ascii_start().strip_prefix(b"=")?.trim_ascii_start();
    crate::read_number(rest, 0).map(|(value, _)| value)
}
