//! Tells G-code from files that only bear its name.

use std::fmt;

/// A file that is no text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotText {
    /// Binary G-code (bgcode), as PrusaSlicer writes it.
    BinaryGcode,
    /// A file compressed by gzip.
    Gzip,
    /// A zip archive, as 3MF is one.
    Zip,
    /// A text of two bytes a character.
    Utf16,
    /// More than one control byte in a hundred.
    Binary,
}

impl fmt::Display for NotText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::BinaryGcode => "binary G-code (bgcode); convert it to text, or export without it",
            Self::Gzip => "a gzip archive; unpack it first",
            Self::Zip => "a zip archive or a 3MF project; export G-code from it",
            Self::Utf16 => "a UTF-16 text; save it as UTF-8 or ASCII",
            Self::Binary => "a binary file, and no G-code",
        })
    }
}

impl std::error::Error for NotText {}

/// Looks at the beginning of a file.
///
/// # Errors
///
/// It is no text.
///
/// ```
/// assert!(gcode::check_text(b"G1 X5\n").is_ok());
/// assert_eq!(gcode::check_text(b"GCDE\x01\0\0\0"), Err(gcode::NotText::BinaryGcode));
/// ```
pub fn check_text(bytes: &[u8]) -> Result<(), NotText> {
    const LOOKED_AT: usize = 4096;
    match bytes {
        [b'G', b'C', b'D', b'E', ..] => return Err(NotText::BinaryGcode),
        [0x1F, 0x8B, ..] => return Err(NotText::Gzip),
        [b'P', b'K', 3, 4, ..] => return Err(NotText::Zip),
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => return Err(NotText::Utf16),
        _ => {}
    }
    let start = bytes.get(..LOOKED_AT).unwrap_or(bytes);
    let control = |byte: &&u8| **byte < b' ' && !matches!(**byte, b'\t' | b'\n' | b'\r' | 0x0C | 0x1A);
    let count = start.iter().filter(control).count();
    // One in a short text is a slip.
    if count > 1 && count * 100 > start.len() { Err(NotText::Binary) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_text_is_told_by_its_first_bytes() {
        assert_eq!(check_text(b""), Ok(()));
        assert_eq!(check_text(b"\xEF\xBB\xBFG1 X5 ; \xb0\n\0"), Ok(()));
        assert_eq!(check_text(b"\x1f\x8b\x08"), Err(NotText::Gzip));
        assert_eq!(check_text(b"PK\x03\x04"), Err(NotText::Zip));
        assert_eq!(check_text(b"\xff\xfeG\0"), Err(NotText::Utf16));
        assert_eq!(check_text(&[0; 100]), Err(NotText::Binary));
        let mostly_text = [b"G1 X5\n".repeat(100), vec![0; 5]].concat();
        assert_eq!(check_text(&mostly_text), Ok(()));
    }
}
