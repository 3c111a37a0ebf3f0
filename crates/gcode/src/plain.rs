//! Reads the lines that nearly all of a file is made of, straight from the text.
//!
//! A plain line is a `G`, one digit, and words of a letter in upper case and a number, no letter twice, with one blank
//! before each and a line end behind the last: `G1 X12.5 Y3 E.25`. There is nothing to skip in it and nothing to remember, so it is read
//! in one pass that finds the line end by coming to it, which costs a third of finding the end first and then asking of
//! every piece what it is.
//!
//! The law: a plain line becomes the same [`Line`] that [`Line::read`] makes of it.

use crate::line::{Kind, Line};
use crate::number::read_number;
use crate::short::short;
use crate::word::Code;

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
    #[inline(always)]
    pub fn read_plain(&mut self, text: &[u8]) -> Option<usize> {
        let [b'G', digit @ b'0'..=b'9', b' ', ..] = text else { return None };
        self.kind = Kind::Code;
        self.command = Some(Code::g(u16::from(digit - b'0')));
        self.unreadable = false;
        self.words.clear();
        self.read_short_words(text, 3)
    }

    /// Reads words from `index` on as long as their numbers are short, which most are.
    #[inline(always)]
    fn read_short_words(&mut self, text: &[u8], mut index: usize) -> Option<usize> {
        // In a register, unlike the mask of the words.
        let mut present = 0;
        while let Some(&[letter, ref number @ ..]) = text.get(index..).and_then(<[u8]>::first_chunk::<9>) {
            let Some((value, length)) = short(*number) else { break };
            if !letter.is_ascii_uppercase() {
                return None;
            }
            present = self.words.put_new(present, letter, value)?;
            index = index.wrapping_add(length).wrapping_add(2);
            match number[length] {
                b' ' => {}
                b'\n' => {
                    self.words.set_present(present);
                    return Some(index);
                }
                b'\r' => {
                    self.words.set_present(present);
                    return behind_line_feed(text, index);
                }
                _ => return None,
            }
        }
        self.words.set_present(present);
        self.read_any_words(text, index)
    }

    /// Reads words from `index` on.
    #[inline(never)]
    fn read_any_words(&mut self, text: &[u8], mut index: usize) -> Option<usize> {
        loop {
            let letter = *text.get(index)?;
            if !letter.is_ascii_uppercase() {
                return None;
            }
            let (value, end) = read_number(text, index.wrapping_add(1))?;
            if self.words.has(letter) {
                return None;
            }
            self.words.put(letter, value);
            index = end.wrapping_add(1);
            match text.get(end)? {
                b' ' => {}
                b'\n' => return Some(index),
                b'\r' => return behind_line_feed(text, index),
                _ => return None,
            }
        }
    }
}

#[inline(never)]
fn behind_line_feed(text: &[u8], index: usize) -> Option<usize> {
    (text.get(index) == Some(&b'\n')).then_some(index.wrapping_add(1))
}
