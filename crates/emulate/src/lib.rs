//! What a machine makes of G-code: where it is at which time, how fast, and what it lays.
//!
//! ```text
//! text ─ gcode ─► commands ─ Machine ─► Operation ─ AdditivePart ─► layers, paths, mass
//!                              │            │
//!                         MotionProfile     └─► Table, EventSeries, PolyData
//! ```
//!
//! 1. [`gcode`] reads the text: it computes what is to be computed ([`gcode::preprocess`]) and gives typed
//!    [`Commands`].
//! 2. A [`Machine`] walks over them once, keeps positions and modes, and hands its moves to the planner of
//!    [`motion`], which gives each its speeds and its time.
//! 3. An [`Operation`] has the commands and one entry of [`ProcessData`] for each; [`AdditiveOperation`] and
//!    [`SubtractiveOperation`] know what is deposited or cut away too.
//! 4. An [`AdditivePart`] looks at the deposits: segments, layers, paths, mass; [`Table`], [`EventSeries`] and
//!    [`PolyData`] hand all of it to other programs.
//!
//! The [`guide`] shows all of it by examples. Lengths are mm, times s, speeds mm/s, volumes mm³, masses g, densities g/cm³. All work is linear in the length of
//! the program, and nothing that a program says makes it fail: what is wrong stands among the diagnostics.

mod arc;
mod bead;
mod commands;
mod error;
mod events;
mod extruder;
#[doc = include_str!("guide.md")]
pub mod guide {}
mod machine;
pub mod motion;
mod operation;
mod part;
mod picture;
mod process;
mod statistics;
mod table;
mod vtk;

pub use arc::{Arc, ArcFault};
pub use bead::{Bead, Shape};
pub use commands::{Commands, read_operation};
pub use error::Error;
pub use events::{EventField, EventOptions, EventSeries};
pub use extruder::Extruder;
pub use machine::{BareG92, Corner, Limits, Machine, Stream, Totals};
pub use operation::{AdditiveOperation, Operation, SubtractiveOperation};
pub use part::{AdditivePart, CHORD_TOLERANCE, Layer, Path, Segment, SegmentKind};
pub use picture::{View, picture};
pub use process::{Action, Moment, ProcessData, ProcessRow};
pub use statistics::{Bounds, Statistics};
pub use table::{Column, Table};
pub use vtk::{CellData, PolyData};
