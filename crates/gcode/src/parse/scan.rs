//! Reads the words of any line, however it is spelled, and tells what is wrong with it.

use super::Parser;
use super::block::{Block, CodeWord};
use crate::diagnostic::Problem;
use crate::lines::find_byte;
use crate::number::read_number;
use crate::word::Code;
use std::borrow::Cow;

/// Where the words of a line begin: behind blanks and a line number.
pub(super) fn body_start(line: &[u8]) -> usize {
    let blanks = |from: usize| {
        let rest = line.get(from..).unwrap_or_default();
        from + rest.iter().position(|&byte| byte > b' ' || byte == 0).unwrap_or(rest.len())
    };
    let start = blanks(0);
    if !matches!(line.get(start), Some(b'N' | b'n')) {
        return start;
    }
    let digits = blanks(start + 1);
    let rest = line.get(digits..).unwrap_or_default();
    match rest.iter().position(|byte| !byte.is_ascii_digit()).unwrap_or(rest.len()) {
        0 => start,
        length => blanks(digits + length),
    }
}

/// `text` up to a `;`, which quotes may protect, without blanks around it.
pub(super) fn before_remark(text: &[u8], quotes: bool) -> (&[u8], Option<&[u8]>) {
    let mut quoted = false;
    for (index, &byte) in text.iter().enumerate() {
        match byte {
            b'"' if quotes => quoted = !quoted,
            b';' if !quoted => {
                let (before, remark) = text.split_at(index);
                return (before.trim_ascii(), remark.get(1..));
            }
            _ => {}
        }
    }
    (text.trim_ascii(), None)
}

/// How many bytes at `start` belong to a number that cannot be read.
fn junk_length(line: &[u8], start: usize, more: &[u8]) -> usize {
    let rest = line.get(start..).unwrap_or_default();
    let ends = |byte: &u8| !(byte.is_ascii_digit() || b"+-.".contains(byte) || more.contains(byte));
    rest.iter().position(ends).unwrap_or(rest.len())
}

fn skip_blanks(line: &[u8], mut index: usize) -> usize {
    while line.get(index).is_some_and(|&byte| byte <= b' ' && byte != 0) {
        index += 1;
    }
    index
}

impl Parser<'_> {
    /// The words of `line` from `start` on.
    pub(super) fn scan<'a>(&mut self, line: &'a [u8], start: usize) -> Block<'a> {
        let mut block = Block { start, ..Block::default() };
        let mut first = None;
        let mut code_end = start;
        let mut index = start;
        let mut nul = false;
        while let Some(&byte) = line.get(index) {
            match byte {
                0 => {
                    if !nul {
                        self.report(index, Problem::NulByte);
                    }
                    nul = true;
                    index += 1;
                }
                1..=b' ' => index += 1,
                b';' => {
                    if !self.flavor.semicolon {
                        self.report(index, not_in_flavor("a remark with `;`"));
                    }
                    self.keep_remark(&mut block, line.get(index + 1..).unwrap_or_default(), index);
                    break;
                }
                b'(' => index = self.scan_remark(&mut block, line, index),
                b'*' if self.flavor.checksum => index = self.scan_checksum(line, index),
                _ => {
                    let word_start = index;
                    index = match byte {
                        b'A'..=b'Z' | b'a'..=b'z' => self.scan_word(&mut block, line, index),
                        b'0'..=b'9' | b'+' | b'-' | b'.' => {
                            self.report(index, Problem::NoLetter);
                            index + junk_length(line, index, b",")
                        }
                        b'"' if self.flavor.quotes => quoted_end(line, index),
                        _ => {
                            self.report(index, Problem::Unreadable);
                            unreadable_end(line, index)
                        }
                    };
                    first = first.or(Some(word_start));
                    code_end = index;
                    if block.text.is_some() {
                        return block;
                    }
                }
            }
        }
        let begin = first.unwrap_or(code_end);
        block.start = begin;
        block.code = line.get(begin..code_end).unwrap_or_default().trim_ascii_end();
        block
    }

    fn keep_remark<'a>(&mut self, block: &mut Block<'a>, text: &'a [u8], index: usize) {
        if !block.remarks.push(text) {
            self.report(index, Problem::TooMuch);
        }
    }

    /// Reads the remark in parentheses at `start`; returns where it ends.
    fn scan_remark<'a>(&mut self, block: &mut Block<'a>, line: &'a [u8], start: usize) -> usize {
        if !self.flavor.parentheses {
            self.report(start, not_in_flavor("a remark in parentheses"));
        }
        let rest = line.get(start + 1..).unwrap_or_default();
        let length = find_byte(b')', rest).unwrap_or_else(|| {
            self.report(start, Problem::OpenRemark);
            rest.len()
        });
        let text = rest.get(..length).unwrap_or_default();
        if let Some(nested) = find_byte(b'(', text) {
            self.report(start + 1 + nested, Problem::NestedRemark);
        }
        self.keep_remark(block, text, start);
        start + length + 2
    }

    /// Compares the checksum behind the `*` at `star`; returns where it ends.
    fn scan_checksum(&mut self, line: &[u8], star: usize) -> usize {
        let computed = line.get(..star).unwrap_or_default().iter().fold(0, |sum, byte| sum ^ byte);
        let digits = skip_blanks(line, star + 1);
        let rest = line.get(digits..).unwrap_or_default();
        let length = rest.iter().position(|byte| !byte.is_ascii_digit()).unwrap_or(rest.len());
        if length == 0 {
            self.report(star, Problem::NoChecksum);
            return star + 1;
        }
        let number = rest.get(..length).unwrap_or_default();
        let given = number.iter().fold(0_u32, |value, digit| {
            value.saturating_mul(10).saturating_add(u32::from(digit.wrapping_sub(b'0')))
        });
        if given != u32::from(computed) {
            self.report(star, Problem::WrongChecksum { given, computed });
        }
        digits + length
    }

    /// Reads the word whose letter stands at `start`; returns where it ends.
    fn scan_word<'a>(&mut self, block: &mut Block<'a>, line: &'a [u8], start: usize) -> usize {
        let letter = line.get(start).map_or(0, u8::to_ascii_uppercase);
        let next = line.get(start + 1).copied().unwrap_or(0);
        if self.flavor.named_words && (next.is_ascii_alphabetic() || next == b'_') {
            return self.scan_name(block, line, start);
        }
        let mut number = skip_blanks(line, start + 1);
        if self.flavor.named_words && line.get(number) == Some(&b'=') {
            number = skip_blanks(line, number + 1);
        }
        if let Some((value, end)) = read_number(line, number) {
            let (value, end) = self.whole_number(line, number, value, end);
            return match line.get(end) {
                Some(b',') => {
                    self.report(start, Problem::Comma(letter));
                    end + junk_length(line, end, b",")
                }
                Some(b'.') => {
                    self.report(start, Problem::NoNumber(letter));
                    end + junk_length(line, end, b",")
                }
                Some(b':') if letter == b'E' => {
                    let (sum, end) = mixed(line, end, value);
                    self.put(block, letter, sum, start);
                    end
                }
                _ => self.take(block, line, letter, value, start, end),
            };
        }
        match line.get(number) {
            Some(byte @ (b'0'..=b'9' | b'+' | b'-' | b'.')) => {
                let too_large = byte.is_ascii_digit();
                let problem = if too_large { Problem::OutOfRange(letter) } else { Problem::NoNumber(letter) };
                self.report(start, problem);
                number + junk_length(line, number, b",")
            }
            Some(b'[' | b'#' | b'{') => {
                let problem = Problem::Preprocess(Cow::Borrowed("an expression that nobody has computed"));
                self.report(number, problem);
                unreadable_end(line, number)
            }
            Some(b'"') if self.flavor.quotes => {
                block.words.put_bare(letter);
                quoted_end(line, number)
            }
            _ => {
                block.words.put_bare(letter);
                let before = start.checked_sub(1).and_then(|index| line.get(index));
                if !before.is_some_and(u8::is_ascii_alphabetic) {
                    block.bare.push((letter, start));
                }
                start + 1
            }
        }
    }

    /// The number at `start` that has been read up to `end`, with what follows behind blanks where those may stand
    /// within a number.
    fn whole_number(&self, line: &[u8], start: usize, value: f64, end: usize) -> (f64, usize) {
        let goes_on = |end: usize| {
            let next = skip_blanks(line, end);
            (next > end && line.get(next).is_some_and(|byte| byte.is_ascii_digit() || *byte == b'.'))
                .then_some(next)
        };
        if !self.flavor.digit_gaps || goes_on(end).is_none() {
            return (value, end);
        }
        let mut digits = [0; 64];
        let (mut length, mut index) = (0, start);
        let mut last = end;
        while let Some(&byte) = line.get(index) {
            let is_part = byte.is_ascii_digit() || byte == b'.' || (index == start && b"+-".contains(&byte));
            if is_part {
                let Some(slot) = digits.get_mut(length) else { return (value, end) };
                *slot = byte;
                length += 1;
                last = index + 1;
            } else if !(byte <= b' ' && byte != 0) {
                break;
            }
            index += 1;
        }
        let text = digits.get(..length).unwrap_or_default();
        match read_number(text, 0) {
            Some((value, read)) if read == length => (value, last),
            _ => (value, end),
        }
    }

    /// Keeps a word with its number.
    fn take<'a>(
        &mut self,
        block: &mut Block<'a>,
        line: &'a [u8],
        letter: u8,
        value: f64,
        start: usize,
        end: usize,
    ) -> usize {
        if !matches!(letter, b'G' | b'M') {
            self.put(block, letter, value, start);
            return end;
        }
        let tenths = Code::new(letter, value)
            .filter(|code| code.thousandths % 100 == 0)
            .and_then(|code| u16::try_from(code.thousandths / 100).ok());
        let Some(tenths) = tenths else {
            self.report(start, Problem::OutOfRange(letter));
            return end;
        };
        let code = CodeWord { letter, tenths, end };
        let is_text = letter == b'M' && self.flavor.text_codes.contains(&tenths);
        if is_text && block.codes.as_slice().is_empty() {
            let rest = line.get(end..).unwrap_or_default();
            let (text, remark) = before_remark(rest, self.flavor.quotes);
            if let Some(remark) = remark {
                self.keep_remark(block, remark, end);
            }
            block.text = Some((code, text));
        } else if !block.codes.push(code) {
            self.report(start, Problem::TooMuch);
        }
        end
    }

    fn put(&mut self, block: &mut Block<'_>, letter: u8, value: f64, start: usize) {
        if block.words.has(letter) {
            self.report(start, Problem::Repeated(letter));
            block.refused |= self.flavor.refuses_repeated;
        }
        block.words.replace(letter, value);
    }

    /// Reads a word of several letters at `start`; returns where it ends.
    fn scan_name<'a>(&mut self, block: &mut Block<'a>, line: &'a [u8], start: usize) -> usize {
        let rest = line.get(start..).unwrap_or_default();
        let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        let length = rest.iter().position(|byte| !is_part(byte)).unwrap_or(rest.len());
        let name = rest.get(..length).unwrap_or_default();
        let behind = skip_blanks(line, start + length);
        if line.get(behind) == Some(&b'=') {
            let number = skip_blanks(line, behind + 1);
            if let Some((value, end)) = read_number(line, number) {
                let is = |known: &str| !known.is_empty() && name.eq_ignore_ascii_case(known.as_bytes());
                if is(&self.flavor.arc_radius) {
                    block.radius = Some(value);
                } else if is(&self.flavor.bead_on) {
                    block.bead = Some(value);
                } else {
                    self.keep_name(block, line.get(start..end).unwrap_or_default(), start);
                }
                return end;
            }
        }
        if name.eq_ignore_ascii_case(b"SUPA") {
            block.machine = true;
            return start + length;
        }
        // Whatever stands behind a name that nobody knows may belong to it.
        let (text, _) = before_remark(rest, self.flavor.quotes);
        self.keep_name(block, text, start);
        start + text.len().max(length)
    }

    fn keep_name<'a>(&mut self, block: &mut Block<'a>, text: &'a [u8], start: usize) {
        if !block.names.push(text) {
            self.report(start, Problem::TooMuch);
        }
    }
}

/// The sum of the shares of several extruders, `E1:2`, whose first is `value`.
fn mixed(line: &[u8], mut end: usize, mut value: f64) -> (f64, usize) {
    while line.get(end) == Some(&b':')
        && let Some((share, behind)) = read_number(line, end + 1)
    {
        value += share;
        end = behind;
    }
    (value, end)
}

/// Behind the quoted text at `start`, in which `""` is a quotation mark.
fn quoted_end(line: &[u8], start: usize) -> usize {
    let rest = line.get(start + 1..).unwrap_or_default();
    find_byte(b'"', rest).map_or(line.len(), |index| start + index + 2)
}

/// Behind what cannot be read at `start`: at the next blank or remark.
fn unreadable_end(line: &[u8], start: usize) -> usize {
    let rest = line.get(start + 1..).unwrap_or_default();
    let ends = |byte: &u8| *byte <= b' ' || matches!(byte, b';' | b'(');
    start + 1 + rest.iter().position(ends).unwrap_or(rest.len())
}

pub(super) fn not_in_flavor(what: &'static str) -> Problem {
    Problem::NotInFlavor(Cow::Borrowed(what))
}
