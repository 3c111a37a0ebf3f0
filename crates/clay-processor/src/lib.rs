//! What a file of clay G-code is made of: comment blocks, layers, spirals, and movements without extrusion; and whether
//! it may be printed.
//!
//! A potter's tools that change finished G-code (slow down with height, swap the base, scale) need to know which lines
//! are a layer and which a spiral. Two models answer, side by side, over one reading of the file:
//!
//! * The **letter** model reads the words as the `gcode_clay_processor` tool describes them: a layer is the `G1` lines
//!   without Z that follow a `G1` with Z, two or more; a spiral is two or more `G1` lines in a row with X or Y, Z and E.
//!   Numbers stand as they are written. It is a contract with the scripts made for that tool.
//! * The **machine** model does what a printer does: it keeps units, absolute and relative modes, the origin and the
//!   position, follows arcs, and calls printing what moves in XY while clay comes out. A layer is printing at one
//!   height, whatever the travels and hops between; a spiral is printing that climbs without a stop. Verdicts rest on
//!   it.
//!
//! Where they differ the file is not wrong: it has a habit that the letter does not foresee, such as layer changes
//! written with `G0`. Each habit that explains a difference becomes a [`DialectNote`].
//!
//! ```
//! let report = clay_processor::process(b"G1 Z1\nG1 X10 E1\nG1 X0 E2\nG0 X0 Z2\nG1 X10 E3\nG1 X0 E4\n");
//! assert_eq!(report.letter.layers.len(), 1);
//! assert_eq!(report.machine.layers.len(), 2);
//! assert!(report.notes[0].text.contains("G0"));
//! ```
//!
//! On the machine model rest the [`Verdict`]s: what must not be printed (below the bed, beside it, through clay that
//! stands, behind the end), and what a potter should know before it is (breaks, gaps, a pump that is asked for too
//! much, commands that firmware for plastic refuses while it is cold). What only somebody who knows the printer can say
//! is in [`Limits`].
//!
//! ```
//! use clay_processor::{Rule, Severity, process};
//!
//! let report = process(b"M83\nG1 X0 Y0 Z-1 F900\nG1 X10 E1\n");
//! assert_eq!(report.verdicts[0].rule, Rule::BelowBed);
//! assert_eq!(report.verdicts[0].severity, Severity::Forbids);
//! assert!(!report.ok());
//! ```
//!
//! Indices are lines counted from 0, as in the tool; sentences count from 1, as editors do. How a line is spelled is
//! the business of [`gcode`]; time and acceleration are the emulator's.

mod arc;
mod breaks;
mod comments;
mod habits;
mod helix;
mod json;
mod layers;
mod letter;
mod machine;
mod motion;
mod processor;
mod report;
mod spirals;
mod trail;
mod verdict;

pub use json::{json, to_json};
pub use processor::{Options, Processor, process};
pub use report::{
    Crossing, Diagonal, DialectNote, Habit, Horizontal, Interruptions, Model, Pitch, Report, Run, Steep,
    Vertical,
};
pub use verdict::{Bed, Firmware, LayerHeights, Limits, Place, Rule, Severity, Verdict};
