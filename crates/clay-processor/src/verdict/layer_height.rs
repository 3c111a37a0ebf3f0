//! How high a layer is, as far as a file shows it while it goes by.

use crate::motion::{Class, EPSILON_Z, Move};
use crate::spirals::LONGEST_FLAT;

/// Clay that falls so many layer heights falls in the air.
const AIR: f64 = 3.0;

/// The height of the highest layer so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LayerHeight {
    /// mm; 0 in the first turn of a spiral.
    height: f64,
    /// Somebody has said it, or clay has been laid at two heights: the first layer may be of another height than the rest.
    known: bool,
    /// Where a layer was laid last, or a spiral has come to, mm.
    level: f64,
    /// Slopes since, and the flat way behind the last of them, mm.
    slopes: usize,
    flat: f64,
}

impl LayerHeight {
    /// What somebody says of it, mm.
    pub(crate) fn new(said: Option<f64>) -> Self {
        Self { height: said.unwrap_or(0.0), known: said.is_some(), ..Self::default() }
    }

    /// Whether clay that `step` lays at `altitude` may show something. It does not where a layer goes on, as nearly
    /// everywhere.
    #[inline(always)]
    pub(crate) fn may_rise(&self, step: &Move, altitude: f64) -> bool {
        step.class == Class::Slope || altitude - self.level > EPSILON_Z
    }

    /// Clay is laid by `step` on a slope, or above the last level.
    pub(crate) fn rise(&mut self, step: &Move, altitude: f64) {
        if step.class == Class::Slope {
            self.slopes += 1;
            self.flat = 0.0;
            // One slope leads from a layer to the next; in a spiral only a whole turn shows how high a layer is.
            if self.slopes > 1 {
                self.level = altitude;
            }
            return;
        }
        // Behind a slope it may be a spiral whose height is rounded.
        self.flat += step.flat_length();
        if self.slopes > 0 && self.flat <= LONGEST_FLAT {
            return;
        }
        self.height = self.height.max(altitude - self.level);
        self.known |= self.level > 0.0;
        self.skip_to(altitude);
    }

    /// A spiral has come round and lies so much higher.
    pub(crate) fn turn(&mut self, rise: f64) {
        self.height = self.height.max(rise);
        self.known = true;
    }

    /// What is laid at `altitude` lies on no layer.
    pub(crate) fn skip_to(&mut self, altitude: f64) {
        *self = Self { level: altitude, slopes: 0, flat: 0.0, ..*self };
    }

    /// Whether clay that lies so far above all other is laid in the air.
    pub(crate) fn is_lifted(&self, rise: f64) -> bool {
        self.known && rise > AIR * self.height
    }

    /// What differs by less is of one layer, mm.
    pub(crate) fn same(&self) -> f64 {
        (self.height / 2.0).max(EPSILON_Z)
    }

    /// Clay that is laid at `altitude` falls in the air if what stands below is lower than this. Nothing if it is little
    /// above the bed, or nobody knows how high a layer is.
    pub(crate) fn air_below(&self, altitude: f64) -> Option<f64> {
        let deep = altitude - AIR * self.height;
        (deep > 0.0 && self.height > 0.0).then_some(deep)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is known behind strokes of these lengths and rises.
    fn seen(strokes: &[(f64, f64)]) -> (f64, bool) {
        let mut layer = LayerHeight::new(None);
        let mut altitude = 0.0;
        for (length, rise) in strokes {
            altitude += rise;
            let step = Move::made_up(*length, *rise, Some(altitude));
            if layer.may_rise(&step, altitude) {
                layer.rise(&step, altitude);
            }
        }
        (layer.height, layer.known)
    }

    #[test]
    fn a_layer_is_as_high_as_the_step_to_it() {
        assert_eq!(seen(&[(20.0, 1.0), (20.0, 0.0)]), (1.0, false), "the first");
        assert_eq!(seen(&[(20.0, 1.0), (20.0, 0.0), (20.0, 1.5), (20.0, 0.0)]), (1.5, true));
        let rounded = [(1.0, 0.1), (1.0, 0.0), (1.0, 0.1), (1.0, 0.0), (1.0, 0.1), (1.0, 0.1), (1.0, 0.0)];
        assert_eq!(seen(&rounded).0, 0.0, "a spiral that has not come round");
    }
}
