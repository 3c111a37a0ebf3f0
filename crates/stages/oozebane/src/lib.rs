#![doc = include_str!("../README.md")]

use skein::{Error, Notes, Ratio, Settings, Skein, Stage};

/// Says what it is for.
#[derive(Clone, Debug, Settings)]
pub struct Oozebane {
    /// What gets better and what gets worse when it grows.
    #[setting(default = 1.0, min = 0.0, max = 2.0)]
    pub amount: Ratio,
}

impl Stage for Oozebane {
    const NAME: &'static str = "oozebane";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        skein.rewrite(notes, |_index, layer, _notes| Ok(layer.lines))
    }
}
