//! Judges what the machine does: what must not be printed, and what a potter should know before it is.
//!
//! Moves and commands go by once. Each kind of fault has its rule and each group of rules its file; a rule keeps where
//! it was first broken, how often and how badly, never a list, so that memory does not grow with the faults.

mod ending;
mod findings;
mod firmware;
mod ground;
mod judge;
mod layer_height;
mod limits;
mod pump;
mod repeats;
mod room;
mod rule;
mod text;
mod tower;

pub(crate) use judge::Judge;
pub use limits::{Bed, Firmware, LayerHeights, Limits};
pub use rule::{Place, Rule, Severity, Verdict};
