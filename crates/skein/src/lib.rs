//! The two documents that flow between the stages, and what a stage is.
//!
//! * [`Slices`]: the loops of each layer. Its text is the SVG that carve writes and preface reads.
//! * [`Skein`]: a list of [`Line`]s; line *i* in memory is line *i* + 1 of the text. Its text is tagged G-code.
//!
//! A stage is its settings with one method, [`Stage::craft`]. It sees its document and its own settings and nothing
//! else: no files, no clock, no environment. Whatever a later stage must know rides in the document as a typed
//! [`Facts`] entry. Every quantity is an integer of its last printed decimal, so reading undoes writing and a chain
//! run in memory gives the bytes of a chain of Unix filters.

mod arc;
pub mod command;
mod document;
mod error;
mod facts;
mod lag;
mod line;
mod machine;
mod notes;
mod nozzle;
mod pen;
mod reader;
#[doc(hidden)]
pub mod settings;

mod slices;
mod span;
mod stage;
mod svg;
mod thread;
mod verify;

pub use arc::{Arc, Center};
pub use document::{Layer, Signature, Skein};
pub use error::{Error, Place};
pub use facts::{Bead, Facts, Section};
pub use lag::{End, OrLag};
pub use line::{Feature, Line, Mark, Move, Side, Tag};
pub use machine::{Bed, BedArea, BedShape, EUnit, Firmware, Heaters, Machine, Origin};
pub use notes::{Note, Notes};
pub use nozzle::Nozzle;
pub use pen::Pen;
pub use reader::Reader;
pub use settings::{Choice, Field, Kind, Setting, SettingError, Settings, Value};
pub use skein_derive::{Choice, Settings};
pub use slices::{RotatedLoopLayer, Slices};
pub use span::{Span, boundary, spans};
pub use stage::Stage;
pub use thread::{Stretch, Thread, along};

pub use shape::{Point, Point3, Ring};
pub use unit::{Angle, Celsius, Direction, Extrusion, Feed, Micron, Ratio};

// The derive names this crate by its outside name.
extern crate self as skein;
