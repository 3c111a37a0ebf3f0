//! A text cut into lines that keep their ends, so that what is not changed stays to the byte.

use gcode::{Kind, Line, find_byte, without_bom, without_cr};

/// A line and what ends it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Raw<'a> {
    /// Without its end.
    pub(crate) text: &'a [u8],
    /// LF, CR and LF, or nothing at the end of the file.
    pub(crate) end: &'a [u8],
}

/// The byte order mark, if there is one, and the rest.
pub(crate) fn split_bom(text: &[u8]) -> (&[u8], &[u8]) {
    text.split_at(text.len() - without_bom(text).len())
}

/// The lines of a text without a byte order mark.
pub(crate) fn raw_lines(text: &[u8]) -> impl Iterator<Item = Raw<'_>> {
    let mut rest = text;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let length = find_byte(b'\n', rest).map_or(rest.len(), |end| end + 1);
        let (whole, behind) = rest.split_at(length);
        rest = behind;
        let text = without_cr(whole.strip_suffix(b"\n").unwrap_or(whole));
        // A CR without LF at the end of the file belongs to the end as well.
        Some(Raw { text, end: whole.get(text.len()..).unwrap_or_default() })
    })
}

/// How the lines of this text end: as its first.
pub(crate) fn line_end(text: &[u8]) -> &'static [u8] {
    match raw_lines(split_bom(text).1).next() {
        Some(Raw { end: b"\r\n", .. }) => b"\r\n",
        _ => b"\n",
    }
}

/// How many bytes the comments and blank lines take that a text begins with.
pub(crate) fn head_length(text: &[u8]) -> usize {
    let (bom, body) = split_bom(text);
    let head = raw_lines(body).take_while(|raw| Line::of(raw.text).kind != Kind::Code);
    bom.len() + head.map(|raw| raw.text.len() + raw.end.len()).sum::<usize>()
}
