//! The drawing becomes tagged G-code.

use skein::{Error, Settings, Skein, Slices};

/// Turns layers of loops into the first skein: a header and an outline for each loop.
#[derive(Clone, Debug, Settings)]
pub struct Preface {
    /// A note of your own that travels with the print: clay, glaze, date.
    #[setting(default = "")]
    pub meta: String,
    /// Write G90: coordinates are absolute.
    #[setting(default = true)]
    pub set_positioning_to_absolute: bool,
    /// Write G21: lengths are millimetres.
    #[setting(default = true)]
    pub set_units_to_millimeters: bool,
}

impl Preface {
    /// The craft word.
    pub const NAME: &'static str = "preface";

    /// Writes the skein.
    ///
    /// # Errors
    /// When the slices lack a fact or the note cannot stand in a tag.
    pub fn craft(&self, _slices: &Slices) -> Result<Skein, Error> {
        Err(Error::new("under construction"))
    }
}
