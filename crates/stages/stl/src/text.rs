//! Text STL, word by word: where the lines break does not matter, except for names, which end with their line.

use crate::weld::{self, Welder};
use crate::{Format, Import, Place, Report, StlError, StlErrorKind};
use shape::{Point3, TriangleMesh};
use unit::Micron;

/// Whether the bytes hold a vertex with its three numbers, or at least start like a text STL.
pub(crate) fn looks_like_text(bytes: &[u8]) -> bool {
    let mut words = Words::new(bytes);
    let starts_with_solid =
        words.clone().next().is_some_and(|word| Keyword::of(word.text) == Some(Keyword::Solid));
    // Without a vertex it may still be a text that was cut early; a binary header brings zeros.
    if starts_with_solid && !bytes.iter().take(1024).any(|byte| *byte == 0) {
        return true;
    }
    while let Some(word) = words.next() {
        if Keyword::of(word.text) == Some(Keyword::Vertex) {
            let mut ahead = words.clone();
            if (0..3).all(|_| ahead.next().is_some_and(|word| number(word.text).is_ok())) {
                return true;
            }
        }
    }
    false
}

pub(crate) fn read(bytes: &[u8]) -> Result<Import, StlError> {
    let mut reader = Reader {
        words: Words::new(bytes),
        // A facet as text takes 200 bytes and more.
        welder: Welder::new(bytes.len() / 250),
        triangles: Vec::with_capacity(bytes.len() / 250),
        report: Report { format: Format::Text, ..Report::default() },
    };
    reader.file()?;
    let Reader { welder, triangles, mut report, .. } = reader;
    if triangles.is_empty() {
        return Err(StlError::no_facets(Place::File));
    }
    report.facets = triangles.len();
    report.degenerate = triangles.iter().filter(|triangle| weld::collapsed(**triangle)).count();
    let mesh = weld::mesh(welder.vertices, triangles, report.degenerate)?;
    Ok(Import { mesh, report })
}

struct Reader<'a> {
    words: Words<'a>,
    welder: Welder,
    triangles: Vec<[u32; 3]>,
    report: Report,
}

/// Where the reader stands between facets.
#[derive(Clone, Copy, PartialEq)]
enum Inside {
    Nothing,
    Solid,
    /// Facets without a `solid` before them, which then need no `endsolid` either.
    Unnamed,
}

impl Reader<'_> {
    fn file(&mut self) -> Result<(), StlError> {
        let mut inside = Inside::Nothing;
        while let Some(word) = self.words.next() {
            let keyword = Keyword::of(word.text);
            if inside == Inside::Nothing && !word.leads {
                // The name after `endsolid`, with any words in it; in a file of one line, the next solid.
                if keyword != Some(Keyword::Solid) {
                    continue;
                }
                if !self.words.facet_on_this_line() {
                    self.words.skip_line();
                    continue;
                }
            }
            match (keyword, inside) {
                (Some(Keyword::Solid), Inside::Nothing | Inside::Unnamed) => {
                    self.name();
                    self.report.solids += 1;
                    inside = Inside::Solid;
                }
                (Some(Keyword::EndSolid), Inside::Solid) => inside = Inside::Nothing,
                (Some(Keyword::Facet), _) => {
                    if inside == Inside::Nothing {
                        self.report.solids += 1;
                        inside = Inside::Unnamed;
                    }
                    self.facet(word)?;
                }
                (None | Some(Keyword::Normal), _) => {
                    self.report.ignored_lines += 1;
                    self.words.skip_line();
                }
                (Some(Keyword::Solid), Inside::Solid) => {
                    return Err(self.unexpected(word, "the solid before it has no `endsolid`"));
                }
                (Some(Keyword::EndSolid), _) => {
                    return Err(self.unexpected(word, "there is no `solid` before it"));
                }
                (Some(_), _) => return Err(self.unexpected(word, "there is no `facet` before it")),
            }
        }
        if inside == Inside::Solid {
            return Err(self.truncated(format!(
                "the text ends without `endsolid` after {} facets",
                self.triangles.len()
            )));
        }
        Ok(())
    }

    /// A name is the rest of the line; in a file of one line, it ends where the facets begin.
    fn name(&mut self) {
        loop {
            let before = self.words.clone();
            let Some(word) = self.words.next() else { return };
            let ends = match Keyword::of(word.text) {
                _ if word.leads => true,
                Some(Keyword::EndSolid) => true,
                Some(Keyword::Facet) => before.starts_facet(),
                _ => false,
            };
            if ends {
                self.words = before;
                return;
            }
        }
    }

    /// From the word after `facet` to `endfacet`.
    fn facet(&mut self, start: Word) -> Result<(), StlError> {
        let mut corners = [0u32; 3];
        let mut seen = 0usize;
        loop {
            let Some(word) = self.words.next() else {
                return Err(self.ends_in_facet());
            };
            match Keyword::of(word.text) {
                Some(Keyword::Vertex) => {
                    let point =
                        Point3 { x: self.coordinate()?, y: self.coordinate()?, z: self.coordinate()? };
                    if let Some(corner) = corners.get_mut(seen) {
                        *corner = self.welder.index(point);
                    }
                    seen += 1;
                }
                Some(Keyword::EndFacet) => break,
                Some(Keyword::Normal | Keyword::Outer | Keyword::Loop | Keyword::EndLoop) => {}
                Some(Keyword::Facet | Keyword::Solid | Keyword::EndSolid) => {
                    return Err(self.unexpected(word, "the facet before it has no `endfacet`"));
                }
                // A normal, which is not believed and may be anything.
                None if seen == 0 => {}
                // The last word may have lost its end.
                None if self.words.is_at_end() => return Err(self.ends_in_facet()),
                None => return Err(self.unexpected(word, "a vertex has three numbers")),
            }
        }
        if seen != 3 {
            return Err(StlError::new(
                StlErrorKind::NotATriangle,
                self.words.place(start),
                format!("a facet has {seen} vertices instead of 3"),
                "export the model with triangles only",
            ));
        }
        if self.triangles.len() == TriangleMesh::MOST_TRIANGLES {
            return Err(StlError::too_large(self.triangles.len() + 1));
        }
        self.triangles.push(corners);
        Ok(())
    }

    #[inline]
    fn coordinate(&mut self) -> Result<i32, StlError> {
        let Some(word) = self.words.next() else {
            return Err(self.ends_in_facet());
        };
        match number(word.text) {
            Ok((microns, comma)) => {
                self.report.decimal_commas += usize::from(comma);
                Ok(microns)
            }
            // The last word may have lost its end.
            Err(_) if self.words.is_at_end() => Err(self.ends_in_facet()),
            Err(Trouble::NotFinite) => Err(StlError::not_finite(self.words.place(word), &quoted(word))),
            Err(Trouble::TooFar) => Err(StlError::too_far(self.words.place(word), &quoted(word))),
            Err(Trouble::NotANumber) => Err(StlError::new(
                StlErrorKind::Syntax,
                self.words.place(word),
                format!("`{}` is no number, and a vertex needs three", quoted(word)),
                "export the model again, or as binary STL",
            )),
        }
    }

    #[cold]
    fn unexpected(&self, word: Word, why: &str) -> StlError {
        let message = format!("`{}` does not belong here: {why}", quoted(word));
        StlError::new(
            StlErrorKind::Syntax,
            self.words.place(word),
            message,
            "export the model again, or as binary STL",
        )
    }

    #[cold]
    fn ends_in_facet(&self) -> StlError {
        self.truncated(format!("the text ends inside facet {}", self.triangles.len() + 1))
    }

    #[cold]
    fn truncated(&self, what: String) -> StlError {
        let place = Place::Line(self.words.line(self.words.text.len()));
        let hint = "the end of the file is missing; export, copy or download it again";
        StlError::new(StlErrorKind::Truncated, place, format!("truncated: {what}"), hint)
    }
}

/// The user's own text, in a length that fits a message.
fn quoted(word: Word) -> String {
    let text = String::from_utf8_lossy(word.text.get(..40).unwrap_or(word.text));
    text.chars().map(|letter| if letter.is_control() { '\u{fffd}' } else { letter }).collect()
}

#[derive(Clone, Copy, PartialEq)]
enum Keyword {
    Solid,
    EndSolid,
    Facet,
    Normal,
    Outer,
    Loop,
    Vertex,
    EndLoop,
    EndFacet,
}

impl Keyword {
    #[inline]
    fn of(word: &[u8]) -> Option<Self> {
        let (name, keyword): (&[u8], _) = match (word.first().map(u8::to_ascii_lowercase), word.len()) {
            (Some(b'v'), 6) => (b"vertex", Self::Vertex),
            (Some(b'f'), 5) => (b"facet", Self::Facet),
            (Some(b'n'), 6) => (b"normal", Self::Normal),
            (Some(b'o'), 5) => (b"outer", Self::Outer),
            (Some(b'l'), 4) => (b"loop", Self::Loop),
            (Some(b's'), 5) => (b"solid", Self::Solid),
            (Some(b'e'), 7) => (b"endloop", Self::EndLoop),
            // `endsolid` and `endfacet` are equally long.
            (Some(b'e'), 8) if word.get(3).is_some_and(|letter| letter.eq_ignore_ascii_case(&b's')) => {
                (b"endsolid", Self::EndSolid)
            }
            (Some(b'e'), 8) => (b"endfacet", Self::EndFacet),
            _ => return None,
        };
        word.eq_ignore_ascii_case(name).then_some(keyword)
    }
}

/// The words of the text, one after the other.
#[derive(Clone)]
struct Words<'a> {
    text: &'a [u8],
    /// After the byte order mark.
    start: usize,
    at: usize,
}

#[derive(Clone, Copy)]
struct Word<'a> {
    text: &'a [u8],
    start: usize,
    /// The first of its line.
    leads: bool,
}

impl<'a> Words<'a> {
    fn new(text: &'a [u8]) -> Self {
        let start = if text.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Self { text, start, at: start }
    }

    #[inline]
    fn next(&mut self) -> Option<Word<'a>> {
        let mut leads = self.at == self.start;
        let mut rest = self.text.get(self.at..)?;
        while let Some((byte, tail)) = rest.split_first().filter(|(byte, _)| is_space(**byte)) {
            leads |= matches!(byte, b'\n' | b'\r');
            rest = tail;
        }
        let start = self.text.len() - rest.len();
        let length = rest.iter().position(|byte| is_space(*byte)).unwrap_or(rest.len());
        self.at = start + length;
        let text = rest.get(..length).filter(|text| !text.is_empty())?;
        Some(Word { text, start, leads })
    }

    fn is_at_end(&self) -> bool {
        self.at >= self.text.len()
    }

    /// Whether what follows is a facet and no mere mention of one.
    fn starts_facet(&self) -> bool {
        let mut ahead = self.clone();
        let mut keyword = || ahead.next().map(|word| Keyword::of(word.text));
        if keyword() != Some(Some(Keyword::Facet)) {
            return false;
        }
        match keyword() {
            Some(Some(Keyword::Outer)) => true,
            // After a normal come numbers, whatever they look like, and after three of them a loop.
            Some(Some(Keyword::Normal)) => (0..4).any(|_| keyword() == Some(Some(Keyword::Outer))),
            _ => false,
        }
    }

    /// Whether a facet begins before the line ends.
    fn facet_on_this_line(&self) -> bool {
        let mut ahead = self.clone();
        loop {
            let before = ahead.clone();
            match ahead.next() {
                Some(word) if word.leads => return false,
                Some(word) if Keyword::of(word.text) == Some(Keyword::Facet) && before.starts_facet() => {
                    return true;
                }
                Some(_) => {}
                None => return false,
            }
        }
    }

    fn skip_line(&mut self) {
        let rest = self.text.get(self.at..).unwrap_or_default();
        self.at += rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
    }

    /// Lines are counted when somebody asks, which is at most once.
    fn line(&self, byte: usize) -> usize {
        let before = self.text.get(..byte).unwrap_or(self.text);
        let breaks = before.iter().filter(|byte| **byte == b'\n').count();
        let alone = before.windows(2).filter(|pair| matches!(pair, [b'\r', next] if *next != b'\n')).count();
        1 + breaks + alone + usize::from(before.last() == Some(&b'\r'))
    }

    fn place(&self, word: Word) -> Place {
        Place::Line(self.line(word.start))
    }
}

#[inline]
fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Trouble {
    NotANumber,
    NotFinite,
    TooFar,
}

/// A decimal number of millimetres as the nearest whole micron, halves away from zero, and whether it has a comma.
///
/// The digits are taken as the integer they are; no float comes in, and so no float can round twice.
#[inline]
fn number(word: &[u8]) -> Result<(i32, bool), Trouble> {
    let (negative, mut rest) = match word {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, word),
    };
    let (mut digits, mut value, mut left_out, mut decimals) = (false, 0u64, 0i64, 0i64);
    let mut mark = None;
    while let [byte, tail @ ..] = rest {
        match byte {
            b'0'..=b'9' => {
                digits = true;
                if value < MOST_DIGITS {
                    value = value * 10 + u64::from(byte - b'0');
                } else {
                    left_out += 1;
                }
                decimals += i64::from(mark.is_some());
            }
            b'.' | b',' if mark.is_none() => mark = Some(*byte),
            _ => break,
        }
        rest = tail;
    }
    if !digits {
        let is_word = matches!(rest, [b'n' | b'N' | b'i' | b'I', ..]);
        return Err(if is_word && mark.is_none() { Trouble::NotFinite } else { Trouble::NotANumber });
    }
    let exponent = match rest {
        [] => 0,
        [b'e' | b'E' | b'd' | b'D', exponent @ ..] => self::exponent(exponent).ok_or(Trouble::NotANumber)?,
        // The way some Windows programs print what is no number.
        [b'#', ..] => return Err(Trouble::NotFinite),
        _ => return Err(Trouble::NotANumber),
    };
    let power = exponent + left_out - decimals + 3;
    let shift = usize::try_from(power.unsigned_abs()).unwrap_or(usize::MAX);
    let microns = if power >= 0 {
        match POWERS.get(shift) {
            _ if value == 0 => 0,
            Some(factor) => value.checked_mul(*factor).ok_or(Trouble::TooFar)?,
            None => return Err(Trouble::TooFar),
        }
    } else {
        // Less than half a micron beyond the table.
        POWERS.get(shift).map_or(0, |divisor| (value + divisor / 2) / divisor)
    };
    let microns =
        i32::try_from(microns).ok().filter(|microns| *microns <= Micron::LIMIT).ok_or(Trouble::TooFar)?;
    Ok((if negative { -microns } else { microns }, mark == Some(b',')))
}

/// A value below this can take one more digit, and half a power of ten besides.
const MOST_DIGITS: u64 = 100_000_000_000_000_000;

const POWERS: [u64; 19] = {
    let mut powers = [1; 19];
    let mut index = 1;
    while index < 19 {
        powers[index] = powers[index - 1] * 10;
        index += 1;
    }
    powers
};

/// The number after `e`. Beyond a million all numbers are zero or too far away, so there it stops counting.
fn exponent(text: &[u8]) -> Option<i64> {
    let (sign, digits) = match text {
        [b'-', digits @ ..] => (-1, digits),
        [b'+', digits @ ..] => (1, digits),
        _ => (1, text),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    Some(sign * digits.iter().fold(0i64, |value, digit| (value * 10 + i64::from(digit - b'0')).min(1 << 40)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_every_form() {
        for (text, microns) in [
            ("0", 0),
            ("-0.0", 0),
            ("1", 1000),
            ("+1.5", 1500),
            (".5", 500),
            ("3.", 3000),
            ("-2.500000e+01", -25_000),
            ("1E3", 1_000_000),
            ("12345678.9e-4", 1_234_568),
            ("0.0005", 1),
            ("-0.0005", -1),
            ("0.00049999999999999999999999999999", 0),
            ("1e-400", 0),
            ("0e999999999999999999999", 0),
            ("1000000.0000000000000000000000000001", 1_000_000_000),
            ("0000000000000000000000000000012.5", 12_500),
            ("0.0000000000000000000000000001e28", 1000),
            ("1d1", 10_000),
        ] {
            assert_eq!(number(text.as_bytes()), Ok((microns, false)), "{text}");
        }
        assert_eq!(number(b"12,5"), Ok((12_500, true)));
    }

    #[test]
    fn what_is_no_number() {
        for text in
            ["", "-", ".", "1.2.3", "1.000,5", "1,000.5", "1e", "1e+", "1mm", "0x10", "1\0", "--1", "vertex"]
        {
            assert_eq!(number(text.as_bytes()), Err(Trouble::NotANumber), "{text}");
        }
        for text in ["nan", "-NaN", "inf", "+Infinity", "nan(ind)", "1.#QNAN", "-1.#IND00"] {
            assert_eq!(number(text.as_bytes()), Err(Trouble::NotFinite), "{text}");
        }
        for text in
            ["1e30", "1000000.001", "3.4028235e38", "99999999999999999999999", "1e99999999999999999999"]
        {
            assert_eq!(number(text.as_bytes()), Err(Trouble::TooFar), "{text}");
        }
    }

    #[test]
    fn lines_end_in_three_ways() {
        let words = Words::new(b"a\nb\r\nc\rd");
        assert_eq!([0, 2, 5, 7].map(|byte| words.line(byte)), [1, 2, 3, 4]);
    }
}
