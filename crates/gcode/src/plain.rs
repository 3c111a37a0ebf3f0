//! Reads the lines that nearly all of a file is made of, straight from the text.
//!
//! A plain line is a `G`, one digit, and words of a letter in upper case and a number, with one blank before each and a
//! line end behind the last: `G1 X12.5 Y3 E.25`. There is nothing to skip in it and nothing to remember, so it is read
//! in one pass that finds the line end by coming to it, which costs a third of finding the end first and then asking of
//! every piece what it is.
//!
//! The law: a line that is plain is, once read, the same [`Line`] that [`Line::read`] makes of it.

use crate::line::{Kind, Line};
use crate::number::read_number;
use crate::short::read_short;
use crate::word::Command;

impl Line {
    /// Becomes the first line of `text` if that is plain and has an end; returns where the next line begins. Otherwise
    /// the line has no meaning until it is read again, as by [`read`](Self::read), which takes every line.
    ///
    /// ```
    /// let mut line = gcode::Line::default();
    /// assert_eq!(line.read_plain(b"G1 X1.5 E2\nG1 Y5\n"), Some(11));
    /// assert_eq!(line, gcode::Line::of(b"G1 X1.5 E2"));
    /// assert_eq!(line.read_plain(b"G1 X1.5 E2"), None);
    /// assert_eq!(line.read_plain(b"M104 S200\n"), None);
    /// ```
    #[inline]
    pub fn read_plain(&mut self, text: &[u8]) -> Option<usize> {
        let [b'G', digit @ b'0'..=b'9', b' ', ..] = text else { return None };
        self.kind = Kind::Code;
        self.command = Some(Command::g(u16::from(digit - b'0')));
        self.unreadable = false;
        self.words.clear();
        let mut index: usize = 3;
        loop {
            let letter = *text.get(index)?;
            if !letter.is_ascii_uppercase() {
                return None;
            }
            let Some((value, end)) = read_short(text, index.wrapping_add(1)) else {
                return self.read_plain_rest(text, index);
            };
            self.words.put(letter, value);
            index = end.wrapping_add(1);
            match text.get(end)? {
                b' ' => {}
                b'\n' => return Some(index),
                b'\r' if text.get(index) == Some(&b'\n') => return Some(index.wrapping_add(1)),
                _ => return None,
            }
        }
    }

    /// Reads the words of a plain line from `index` on, whatever their numbers.
    #[inline(never)]
    fn read_plain_rest(&mut self, text: &[u8], mut index: usize) -> Option<usize> {
        loop {
            let letter = *text.get(index)?;
            if !letter.is_ascii_uppercase() {
                return None;
            }
            let (value, end) = read_number(text, index.wrapping_add(1))?;
            self.words.put(letter, value);
            index = end.wrapping_add(1);
            match text.get(end)? {
                b' ' => {}
                b'\n' => return Some(index),
                b'\r' if text.get(index) == Some(&b'\n') => return Some(index.wrapping_add(1)),
                _ => return None,
            }
        }
    }
}
