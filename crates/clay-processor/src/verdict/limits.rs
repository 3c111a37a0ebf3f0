//! What only somebody who knows the printer and the print can say.

/// What a file is held against. What is not known is not judged, unless its rule says otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// The room in which the nozzle may move.
    pub bed: Option<Bed>,
    /// How high the layers are meant to be.
    pub layers: Option<LayerHeights>,
    /// How wide a bead lies, mm.
    pub bead_width: Option<f64>,
    /// Units of E for a cubic millimetre of clay.
    pub e_per_mm3: Option<f64>,
    /// What E can do at most, in its unit per second.
    pub max_e_speed: Option<f64>,
    /// What the pump can do at most, mm³/s.
    pub max_flow: Option<f64>,
    /// Whether the machine can heat.
    pub heated: Option<bool>,
    /// The program in the machine.
    pub firmware: Option<Firmware>,
    /// The longest way of E that the firmware takes in one move, in its unit. If nothing is said, what the
    /// [`Firmware`] comes with.
    pub longest_e: Option<f64>,
}

/// The room over the bed, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bed {
    /// The least X and Y.
    pub least: (f64, f64),
    /// The greatest X and Y.
    pub greatest: (f64, f64),
    /// An ellipse that touches the sides; otherwise the whole rectangle.
    pub round: bool,
    /// The greatest Z.
    pub height: f64,
}

/// Heights of layers, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayerHeights {
    /// Of the first.
    pub first: f64,
    /// Of all others.
    pub rest: f64,
}

/// Programs in printers, by what they do with E.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Firmware {
    /// Refuses E while cold until `M302` allows it, refuses more than 200 of E in one move, and takes `G90` and `G91`
    /// to be about E too.
    Marlin,
    /// Refuses E while cold until `M302 P1` allows it.
    RepRap,
    /// Refuses more than 50 of E in a move that pushes only, and knows no `M302`.
    Klipper,
    /// Does as it is told.
    Plain,
}
