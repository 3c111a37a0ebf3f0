//! The comment blocks at both ends of a file; both models share them.

use gcode::Kind;

/// Watches the kinds of lines go by.
#[derive(Clone, Debug, Default)]
pub(crate) struct Comments {
    first_code: Option<usize>,
    last_code: Option<usize>,
    in_head: bool,
    in_tail: bool,
    lines: usize,
}

impl Comments {
    #[inline]
    pub(crate) fn feed(&mut self, kind: Kind) {
        match kind {
            Kind::Blank => {}
            Kind::Comment => {
                self.in_head |= self.first_code.is_none();
                self.in_tail = true;
            }
            Kind::Code => {
                self.first_code.get_or_insert(self.lines);
                self.last_code = Some(self.lines);
                self.in_tail = false;
            }
        }
        self.lines += 1;
    }

    /// The last line of the head and the first of the tail.
    pub(crate) fn ends(&self) -> (Option<usize>, Option<usize>) {
        let head_end = self.first_code.unwrap_or(self.lines);
        let tail_start = self.last_code.map_or(0, |index| index + 1);
        (self.in_head.then(|| head_end.saturating_sub(1)), self.in_tail.then_some(tail_start))
    }
}
