//! Mesh to layers of loops.

use shape::TriangleMesh;
use skein::{Choice, Error, Machine, Micron, Notes, Section, Settings, Slices};

/// Cuts a part into layers.
#[derive(Clone, Debug, Settings)]
pub struct Carve {
    /// How high a layer is. Half the nozzle is a good start: lower layers press the clay and show less, higher ones
    /// print faster and stand less well.
    #[setting(default = 1.5, min = 0.05, max = 100.0, unit = "mm")]
    pub layer_height: Micron,
    /// How high the first layer is. Lower than the others presses the clay onto the bed.
    #[setting(default = 1.2, min = 0.05, max = 100.0, unit = "mm")]
    pub first_layer_height: Micron,
    /// How wide a bead is laid. A little more than the nozzle presses it against its neighbours.
    #[setting(default = 3.2, min = 0.1, max = 200.0, unit = "mm")]
    pub bead_width: Micron,
    /// The form of a bead's cross-section: how much clay one millimetre of bead takes, and how far apart neighbours
    /// lie so that they fill the room between them.
    #[setting(default = Section::Rectangle)]
    pub bead_section: Section,
    /// Where the part is put before it is cut.
    #[setting(default = Place::Bed)]
    pub place: Place,
    /// The widest gap in an open outline that is closed with a straight line.
    #[setting(default = 10.0, min = 0.0, max = 1000.0, unit = "mm")]
    pub close_gaps: Micron,
    /// Whether layers that span a gap are recognised, so that their infill runs across it.
    #[setting(default = true)]
    pub find_bridges: bool,
}

/// Where the part is put before it is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Place {
    /// On the middle of the bed, standing on it.
    Bed,
    /// Where its file has it; only its height is brought down to the bed.
    Keep,
}

impl Carve {
    /// The craft word.
    pub const NAME: &'static str = "carve";

    /// Cuts the part.
    ///
    /// # Errors
    /// When there is nothing to print, or the part does not fit the machine.
    pub fn carve(&self, _mesh: &TriangleMesh, _machine: &Machine, _notes: &mut Notes) -> Result<Slices, Error> {
        Err(Error::new("under construction"))
    }
}
