//! What one unit of E is in clay.

use std::f64::consts::FRAC_PI_4;

/// How a machine counts what it extrudes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Extruder {
    /// E is millimetres of a filament of this diameter, mm.
    Filament {
        /// Diameter, mm.
        diameter: f64,
    },
    /// E is mm³.
    #[default]
    Volume,
    /// E is millimetres of a ram of this diameter, mm.
    Piston {
        /// Diameter, mm.
        diameter: f64,
    },
    /// E is any unit that holds so many mm³.
    Unit {
        /// mm³ for each E.
        mm3: f64,
    },
    /// A screw that turns while the machine moves.
    Screw {
        /// mm³ for each revolution.
        mm3_per_revolution: f64,
    },
    /// Runs at one rate, or not at all.
    OnOff {
        /// mm³/s while it runs.
        mm3_per_second: f64,
    },
}

impl Extruder {
    /// mm³ for each unit of E. Of a machine without E words that is 1.
    pub fn mm3_per_unit(self) -> f64 {
        match self {
            Self::Filament { diameter } | Self::Piston { diameter } => FRAC_PI_4 * diameter * diameter,
            Self::Unit { mm3 } => mm3,
            Self::Volume | Self::Screw { .. } | Self::OnOff { .. } => 1.0,
        }
    }

    /// mm³/s when the screw turns with so many revolutions per second.
    pub fn mm3_per_second(self, revolutions: f64) -> f64 {
        match self {
            Self::Screw { mm3_per_revolution } => revolutions * mm3_per_revolution,
            Self::OnOff { mm3_per_second } if revolutions > 0.0 => mm3_per_second,
            Self::OnOff { .. } => 0.0,
            other => revolutions * other.mm3_per_unit(),
        }
    }

    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Filament { .. } => "filament",
            Self::Volume => "volume",
            Self::Piston { .. } => "piston",
            Self::Unit { .. } => "unit",
            Self::Screw { .. } => "screw",
            Self::OnOff { .. } => "on-off",
        }
    }
}
