//! What a machine makes of G-code.
mod arc;
mod bead;
mod error;
mod events;
mod extruder;
mod machine;
pub mod motion;
mod operation;
mod part;
mod process;
mod program;
mod statistics;
mod table;
mod vtk;

pub use arc::{Arc, ArcFault};
pub use bead::{Bead, Shape};
pub use error::Error;
pub use events::{EventField, EventOptions, EventSeries};
pub use extruder::Extruder;
pub use machine::{BareG92, Corner, Limits, Machine, Stream, Totals};
pub use operation::{AdditiveOperation, Operation, SubtractiveOperation};
pub use part::{AdditivePart, CHORD_TOLERANCE, Layer, Path, Segment, SegmentKind};
pub use process::{Action, Moment, ProcessData, ProcessRow};
pub use program::Program;
pub use statistics::{Bounds, Statistics};
pub use table::{Column, Table};
pub use vtk::{CellData, PolyData};
