//! Replacements in the finished file, for machines with words of their own.

use skein::{Error, Place};

/// What is replaced, and by what, in the order of the setting.
pub(crate) struct Table(Vec<(Vec<u8>, Vec<u8>)>);

impl Table {
    /// Reads `old<tab>new`, a rule a line.
    ///
    /// # Errors
    /// When a line has no tab or replaces nothing.
    pub(crate) fn read(text: &str) -> Result<Self, Error> {
        let rules = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        let rule = |(index, line): (usize, &str)| match line.split_once('\t') {
            Some((old, new)) if !old.is_empty() => {
                Ok((old.as_bytes().to_vec(), new.replace("\\n", "\n").into_bytes()))
            }
            _ => Err(Error::new(format!("`{line}` replaces nothing"))
                .at(Place::At(format!("`replace`, line {}", index + 1)))
                .hint("a rule is what is replaced, a tab, and what takes its place: \"M101\\tM106 S255\"")),
        };
        rules.map(rule).collect::<Result<_, _>>().map(Self)
    }

    /// The text with every rule applied, if there are any. A piece of text ends with a line, so no rule is cut.
    pub(crate) fn apply(&self, text: &[u8]) -> Option<Vec<u8>> {
        let (first, rest) = self.0.split_first()?;
        Some(rest.iter().fold(replaced(text, first), |text, rule| replaced(&text, rule)))
    }
}

/// Replaces a rule's text; where it begins or ends like a word, only where the word begins or ends: `M10` is no part of
/// `M101`.
fn replaced(text: &[u8], (old, new): &(Vec<u8>, Vec<u8>)) -> Vec<u8> {
    let is_part = |byte: Option<&u8>| byte.is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'.');
    let mut out = Vec::with_capacity(text.len());
    let mut at = 0;
    while at < text.len() {
        let end = at + old.len();
        let matches = text[at..].starts_with(old)
            && !(is_part(old.first()) && at > 0 && is_part(text.get(at - 1)))
            && !(is_part(old.last()) && is_part(text.get(end)));
        if matches {
            out.extend_from_slice(new);
            at = end;
        } else {
            out.push(text[at]);
            at += 1;
        }
    }
    // A line that was replaced by nothing is gone.
    let mut lines = Vec::with_capacity(out.len());
    for line in out.split_inclusive(|byte| *byte == b'\n').filter(|line| *line != b"\n") {
        lines.extend_from_slice(line);
    }
    lines
}
