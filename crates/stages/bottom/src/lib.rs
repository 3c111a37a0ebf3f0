#![doc = include_str!("../README.md")]

use skein::{Error, Micron, Notes, Ratio, Settings, Slices, Stage};

#[cfg(test)]
mod tests;

/// Puts the lowest layer where the bed is.
#[derive(Clone, Debug, Settings)]
pub struct Bottom {
    /// How high the bed is. A bat of plaster or wood that lies on the bed of the machine lifts it by its thickness.
    #[setting(default = 0.0, min = -100.0, max = 1000.0, unit = "mm")]
    pub altitude: Micron,
    /// How high the middle of the lowest layer lies above the bed, as a share of the layer's height. At half a height
    /// the bead is pressed as everywhere; more leaves a gap for a bat that is not flat, less presses harder.
    #[setting(default = 0.5, min = 0.0, max = 2.0)]
    pub additional_height: Ratio,
}

impl Stage<Slices> for Bottom {
    const NAME: &'static str = "bottom";

    fn craft(&self, mut slices: Slices, _notes: &mut Notes) -> Result<Slices, Error> {
        let Some(lowest) = slices.layers.first() else { return Ok(slices) };
        let height = match lowest.thickness {
            Some(height) => height,
            None => slices.facts.layer_height()?,
        };
        let high = || {
            Error::new(format!("a bed at {} mm is out of range", self.altitude))
                .hint("altitude is the thickness of the bat")
        };
        let share = Micron::from_mm(height.mm() * self.additional_height.f64()).ok_or_else(high)?;
        let rise = i64::from(self.altitude.0) + i64::from(share.0) - i64::from(lowest.z.0);
        let lift = |z: i32| Micron::from_places(i64::from(z) + rise).ok_or_else(high);
        for layer in &mut slices.layers {
            layer.z = lift(layer.z.0)?;
        }
        slices.bounds.min.z = lift(slices.bounds.min.z)?.0;
        slices.bounds.max.z = lift(slices.bounds.max.z)?.0;
        Ok(slices)
    }
}
