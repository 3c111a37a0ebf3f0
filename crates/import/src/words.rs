//! What all readers of plain text share.

use crate::Unit;
use crate::error::{ImportError, Place, quoted};
use crate::number::Trouble;

#[inline]
pub(crate) fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

/// The line of a byte, counted from one. Lines end in any of three ways, and are counted when somebody asks, which is
/// at most once.
pub(crate) fn line(text: &[u8], byte: usize) -> usize {
    let before = text.get(..byte).unwrap_or(text);
    let breaks = before.iter().filter(|byte| **byte == b'\n').count();
    let alone = before.windows(2).filter(|pair| matches!(pair, [b'\r', next] if *next != b'\n')).count();
    1 + breaks + alone + usize::from(before.last() == Some(&b'\r'))
}

/// The error for a word that should be a coordinate.
#[cold]
pub(crate) fn no_coordinate(
    trouble: Trouble,
    place: Place,
    word: &[u8],
    unit: Unit,
    needs: &str,
) -> ImportError {
    let word = quoted(word);
    match trouble {
        Trouble::NotFinite => ImportError::not_finite(place, &word),
        Trouble::TooFar => ImportError::too_far(place, &word, unit),
        Trouble::NotANumber => ImportError::syntax(place, format!("`{word}` is no number, and {needs}")),
    }
}

#[cfg(test)]
mod tests {
    use super::line;

    #[test]
    fn lines_end_in_three_ways() {
        assert_eq!([0, 2, 5, 7].map(|byte| line(b"a\nb\r\nc\rd", byte)), [1, 2, 3, 4]);
    }
}
