//! The pieces of a line with their places, for those who change a word and keep the rest of the text.

use crate::lines::find_byte;
use crate::number::read_number;

/// A piece of a line. `start..end` is its place in the line's text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Token {
    /// A letter and its number.
    Word {
        /// In upper case.
        letter: u8,
        /// Nothing if no number follows the letter.
        value: Option<f64>,
        /// Where the letter stands.
        start: usize,
        /// Where the number begins; `end` if there is none.
        number_start: usize,
        /// Behind the number.
        end: usize,
    },
    /// From `;` to the end, or from `(` to `)`. A `(` that nothing closes takes the rest of the line.
    Remark {
        /// Where the mark stands.
        start: usize,
        /// Behind the remark.
        end: usize,
    },
    /// From `*` to the next remark or the end.
    Checksum {
        /// Where the `*` stands.
        start: usize,
        /// Behind the checksum.
        end: usize,
    },
    /// Anything else, up to the next blank, letter, remark or checksum.
    Other {
        /// Where it begins.
        start: usize,
        /// Behind it.
        end: usize,
    },
}

/// The pieces of a line from left to right. Every byte but the blanks is in one of them, except for remarks between a
/// letter and its number.
#[derive(Clone, Debug)]
pub struct Tokens<'a> {
    text: &'a [u8],
    index: usize,
}

impl<'a> Tokens<'a> {
    /// The pieces of `text`, a line without its end.
    #[inline]
    pub fn new(text: &'a [u8]) -> Self {
        Self { text, index: 0 }
    }

    /// The next word, if its number stands right behind its letter; else nothing is taken but blanks.
    // Called twice, by the one who reads every line: worth its size.
    #[inline(always)]
    pub(crate) fn plain_word(&mut self) -> Option<(u8, f64)> {
        let mut index = self.index;
        let mut byte = *self.text.get(index)?;
        while is_blank(byte) {
            index = index.wrapping_add(1);
            self.index = index;
            byte = *self.text.get(index)?;
        }
        let letter = byte & !0x20;
        if !letter.is_ascii_uppercase() {
            return None;
        }
        let (value, end) = read_number(self.text, index.wrapping_add(1))?;
        self.index = end;
        Some((letter, value))
    }

    /// Whether the line is at its end.
    #[inline]
    pub(crate) fn is_done(&self) -> bool {
        self.index >= self.text.len()
    }

    #[inline]
    fn word(&mut self, letter: u8) -> Token {
        let start = self.index;
        let mut number_start = start.wrapping_add(1);
        if let Some(&byte) = self.text.get(number_start)
            && (is_blank(byte) || byte == b'(')
        {
            number_start = skip_gap(self.text, number_start);
        }
        if let Some((value, end)) = read_number(self.text, number_start) {
            self.index = end;
            return Token::Word { letter, value: Some(value), start, number_start, end };
        }
        let end = start.wrapping_add(1);
        self.index = end;
        Token::Word { letter, value: None, start, number_start: end, end }
    }

    #[cold]
    fn remark(&mut self) -> Token {
        let start = self.index;
        self.index = remark_end(self.text, start);
        Token::Remark { start, end: self.index }
    }

    /// All that is neither blank nor word.
    #[cold]
    fn other(&mut self, first: u8) -> Token {
        let start = self.index;
        let rest = self.text.get(start..).unwrap_or_default();
        let is_checksum = first == b'*';
        let ends = |&byte: &u8| match byte {
            b';' | b'(' => true,
            _ if is_checksum => false,
            byte => is_blank(byte) || byte == b'*' || byte.is_ascii_alphabetic(),
        };
        let length = rest.iter().skip(1).position(ends).map_or(rest.len(), |index| index + 1);
        self.index = start + length;
        if is_checksum {
            Token::Checksum { start, end: self.index }
        } else {
            Token::Other { start, end: self.index }
        }
    }
}

impl Iterator for Tokens<'_> {
    type Item = Token;

    #[inline]
    fn next(&mut self) -> Option<Token> {
        loop {
            let byte = *self.text.get(self.index)?;
            if is_blank(byte) {
                self.index = self.index.wrapping_add(1);
                continue;
            }
            let upper = byte & !0x20;
            return Some(match byte {
                _ if upper.is_ascii_uppercase() => self.word(upper),
                b';' | b'(' => self.remark(),
                other => self.other(other),
            });
        }
    }
}

/// Control bytes count as blanks: a file cut off on its card is full of zeros.
#[inline(always)]
fn is_blank(byte: u8) -> bool {
    byte <= b' '
}

/// Behind the blanks and closed remarks that begin at `index`.
#[inline]
fn skip_gap(text: &[u8], mut index: usize) -> usize {
    loop {
        match text.get(index) {
            Some(&byte) if is_blank(byte) => index = index.wrapping_add(1),
            Some(b'(') => index = remark_end(text, index),
            _ => return index,
        }
    }
}

/// Where the remark that begins at `start` ends.
#[cold]
fn remark_end(text: &[u8], start: usize) -> usize {
    let rest = text.get(start..).unwrap_or_default();
    let length = match rest.first() {
        Some(b'(') => find_byte(b')', rest).map_or(rest.len(), |index| index + 1),
        _ => rest.len(),
    };
    start + length
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_knows_its_place() {
        let text = b"n3 G1 X 12.5(c)?Y*7 ;r";
        let pieces: Vec<_> = Tokens::new(text)
            .map(|token| match token {
                Token::Word { start, end, .. }
                | Token::Remark { start, end }
                | Token::Checksum { start, end }
                | Token::Other { start, end } => String::from_utf8_lossy(&text[start..end]).into_owned(),
            })
            .collect();
        assert_eq!(pieces, ["n3", "G1", "X 12.5", "(c)", "?", "Y", "*7 ", ";r"]);
        let third = Tokens::new(text).nth(2);
        assert_eq!(
            third,
            Some(Token::Word { letter: b'X', value: Some(12.5), start: 6, number_start: 8, end: 12 })
        );
    }
}
