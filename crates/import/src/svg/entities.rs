//! What a document may unfold to.

use crate::error::{ErrorKind, ImportError, Place};

/// How long an entity may be: the longest in use are addresses of name spaces.
const LONGEST: usize = 256;
/// How much a drawing may grow when its entities are unfolded, beside its own size.
const MOST_UNFOLDED: usize = 16 << 20;

/// Refuses entities that hold more than a word: those of other entities grow without bounds.
///
/// # Errors
/// With the byte of the entity.
pub(super) fn check(text: &str) -> Result<(), ImportError> {
    let refused = |at: usize, message: &str| {
        let hint = "save it again as plain SVG, without entities";
        ImportError::new(ErrorKind::TooLarge, Place::Byte(at), message, hint)
    };
    let mut longest = 0;
    for (at, _) in text.match_indices("<!ENTITY") {
        let rest = text.get(at..).unwrap_or_default();
        let Some(start) = rest.find(['"', '\'']) else { continue };
        let (_, quoted) = rest.split_at(start);
        let mark = if quoted.starts_with('"') { '"' } else { '\'' };
        let value = quoted.get(1..).and_then(|value| value.split(mark).next()).unwrap_or_default();
        if value.len() > LONGEST || value.contains(['<', '&', '%']) {
            return Err(refused(at, "an entity of the drawing holds more than a word"));
        }
        longest = longest.max(value.len());
    }
    let used = text.bytes().filter(|byte| *byte == b'&').count();
    if longest.saturating_mul(used) > text.len().saturating_add(MOST_UNFOLDED) {
        return Err(refused(0, "the entities of the drawing make it many times as large"));
    }
    Ok(())
}
