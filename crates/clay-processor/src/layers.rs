//! Groups printing into layers, whatever happens between the printing.

use crate::motion::EPSILON_Z;
use crate::report::Run;

/// The layers found so far and the one that is growing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layers {
    pub(crate) found: Vec<Run>,
    open: Option<Group>,
}

/// Printing lines at one height.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group {
    pub(crate) height: Option<f64>,
    pub(crate) first: usize,
    pub(crate) last: usize,
    pub(crate) lines: usize,
}

/// A state to come back to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    found: usize,
    open: Option<Group>,
}

impl Layers {
    /// A line printed at `height`. Returns whether it goes on with a layer.
    #[inline(always)]
    pub(crate) fn flat(&mut self, index: usize, height: Option<f64>) -> bool {
        if let Some(group) = &mut self.open
            && is_level(group.height, height)
        {
            group.last = index;
            group.lines += 1;
            return true;
        }
        self.start(Group { height, first: index, last: index, lines: 1 });
        false
    }

    /// A line printed up or down to `height` starts a layer.
    #[inline]
    pub(crate) fn slope(&mut self, index: usize, height: Option<f64>) {
        self.start(Group { height, first: index, last: index, lines: 1 });
    }

    /// Ends the layer that grows and lets `group` grow.
    #[cold]
    pub(crate) fn start(&mut self, group: Group) {
        self.end();
        self.open = Some(group);
    }

    /// Ends the layer that grows.
    pub(crate) fn end(&mut self) {
        if let Some(group) = self.open.take().filter(|group| group.lines >= 2) {
            let layer = Run { start_index: group.first, end_index: group.last, height: group.height };
            self.found.push(layer);
        }
    }

    pub(crate) fn mark(&self) -> Mark {
        Mark { found: self.found.len(), open: self.open }
    }

    /// Forgets the lines since `mark`: they are a spiral.
    pub(crate) fn return_to(&mut self, mark: Mark) {
        self.found.truncate(mark.found);
        self.open = mark.open;
    }
}

#[inline]
fn is_level(a: Option<f64>, b: Option<f64>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= EPSILON_Z,
        (None, None) => true,
        _ => false,
    }
}
