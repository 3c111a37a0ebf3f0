//! Breaks in the printing: groups of movements without extrusion that have printing before and after them.

use crate::report::{Crossing, Interruptions};

/// The breaks found so far and the one that goes on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Breaks {
    pub(crate) found: Interruptions,
    /// What has been travelled since the last printing.
    open: Option<Break>,
}

#[derive(Clone, Copy, Debug)]
struct Break {
    first: usize,
    length: f64,
    over_air: f64,
}

impl Breaks {
    /// The nozzle goes a way without clay behind some printing, `over_air` of it with nothing below.
    pub(crate) fn travel(&mut self, index: usize, length: f64, over_air: f64) {
        let open = self.open.get_or_insert(Break { first: index, length: 0.0, over_air: 0.0 });
        open.length += length;
        open.over_air += over_air;
    }

    /// It prints again. Less than `least` over air is no crossing.
    #[inline(always)]
    pub(crate) fn print(&mut self, least: f64) {
        if let Some(open) = self.open.take() {
            self.close(&open, least);
        }
    }

    #[cold]
    fn close(&mut self, open: &Break, least: f64) {
        let found = &mut self.found;
        found.count += 1;
        found.length += open.length;
        if found.longest_index.is_none() || open.length > found.longest {
            found.longest = open.length;
            found.longest_index = Some(open.first);
        }
        if open.over_air > least {
            found.open_air.push(Crossing { index: open.first, length: open.over_air });
        }
    }
}
