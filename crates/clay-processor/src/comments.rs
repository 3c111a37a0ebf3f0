//! The comment blocks at both ends of a file; both models share them.

use gcode::Kind;

/// Watches the kinds of lines go by.
#[derive(Clone, Debug, Default)]
pub(crate) struct Comments {
    first_code: Option<usize>,
    behind_code: usize,
    in_head: bool,
    in_tail: bool,
}

impl Comments {
    /// Takes the line at `index`.
    #[inline(always)]
    pub(crate) fn feed(&mut self, index: usize, kind: Kind) {
        match kind {
            Kind::Blank => {}
            Kind::Comment => {
                self.in_head |= self.first_code.is_none();
                self.in_tail = true;
            }
            Kind::Code => {
                self.first_code.get_or_insert(index);
                self.behind_code = index + 1;
                self.in_tail = false;
            }
        }
    }

    /// The last line of the head and the first of the tail, of so many `lines`.
    pub(crate) fn ends(&self, lines: usize) -> (Option<usize>, Option<usize>) {
        let head_end = self.first_code.unwrap_or(lines);
        (self.in_head.then(|| head_end.saturating_sub(1)), self.in_tail.then_some(self.behind_code))
    }
}
