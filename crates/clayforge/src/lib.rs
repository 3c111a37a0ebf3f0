//! The facade: everything a program needs to turn a part into clay G-code.
//!
//! * [`STAGES`] is the table of stages; [`Profile`] holds the settings of all of them, read from TOML with places.
//! * [`slice()`] runs the chain in memory from a mesh or a drawing to the file; [`craft()`] runs one stage from text to text.
//! * [`draw()`] draws the layers of a document; [`explain()`] is the manual.
//!
//! It prints nothing, opens no file and knows no terminal: where bytes come from and go to is the caller's business.
//!
//! ```
//! let profile = clayforge::Profile::default();
//! let mut gcode = Vec::new();
//! let part = b"solid empty\nendsolid empty\n";
//! let refused = clayforge::slice(part, &profile, None, &mut |_| Ok(()), &mut |piece| {
//!     gcode.extend_from_slice(piece);
//!     Ok(())
//! });
//! assert!(refused.is_err(), "a part without facets cannot be printed");
//! ```

mod document;
mod door;
mod draw;
mod explain;
mod figures;
mod inspect;
mod limits;
mod name;
mod pipeline;
mod profile;
mod stages;
mod stopwatch;
#[cfg(test)]
mod tests;
mod work;

pub use clay_processor;
pub use document::{Document, Form, Plate};
pub use door::read_part;
pub use draw::{Drawing, draw};
pub use emulate;
pub use explain::explain;
pub use figures::Figures;
pub use gcode;
pub use import::Format;
pub use inspect::{Inspection, repaired};
pub use mesh;
pub use pipeline::{Event, Found, Sliced, Watch, craft, draw_text, set_threads, slice, slice_all};
pub use profile::{
    BUILT_IN, Clay, Lookup, Motion, Profile, Source, Station, built_in, is_built_in, only_built_in,
    read_flavor, schema, starter,
};
pub use skein::{Error, Note, Notes, Place};
pub use stages::{Chain, Entry, STAGES, check_sequence, stage};
pub use work::{Bench, Keys, Sink, Work};
