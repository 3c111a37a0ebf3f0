#![doc = include_str!("../README.md")]

use skein::{Choice, Error, Layer, Line, Notes, Nozzle, Ratio, Settings, Skein, Stage};

#[cfg(test)]
mod tests;

/// Moves the seam of the walls from layer to layer.
#[derive(Clone, Debug, Settings)]
pub struct Jitter {
    /// Where the seams of the layers go.
    #[setting(default = Seams::Golden)]
    pub seams: Seams,
    /// How wide the seams are spread along the wall, in bead widths, half to each side of where they were. Wider hides
    /// them better, narrower keeps them where `fill` has hidden them.
    #[setting(default = 2.0, min = 0.0, max = 100.0)]
    pub over_bead_width: Ratio,
    /// Another number gives another `random` pattern.
    #[setting(default = 1, min = 0, max = 1000000)]
    pub seed: u32,
}

/// Where the seams of the layers go.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Seams {
    /// Spread evenly: each layer turns by the golden section, so that neighbours lie far apart.
    Golden,
    /// Spread by chance, the same for the same seed.
    Random,
    /// Anywhere on the wall, by the golden section of its whole length.
    Around,
}

/// The golden section: the share of a turn that keeps all places far apart the longest.
const GOLDEN: f64 = 0.618_034;

impl Stage for Jitter {
    const NAME: &'static str = "jitter";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        if self.seams != Seams::Around && self.over_bead_width.0 == 0 {
            notes.say("a spread of 0 leaves the seams where they are");
            return Ok(skein);
        }
        let spread = skein.facts()?.bead_width()?.um() * self.over_bead_width.f64();
        let nozzles = skein.nozzles();
        skein
            .rewrite(notes, |index, layer, notes| Ok(self.turn(index, layer, &nozzles[index], spread, notes)))
    }
}

impl Jitter {
    /// Turns every closed wall of a layer.
    fn turn(
        &self,
        index: usize,
        layer: Layer,
        entering: &Nozzle,
        spread: f64,
        notes: &mut Notes,
    ) -> Vec<Line> {
        let share = self.share(index);
        let mut mixed = false;
        let lines = layer.rethread(entering, |thread, before, behind| {
            let free = thread.is_wall() && !before.on && !behind.on;
            mixed |= !free && thread.has_wall();
            let wall = Some(thread).filter(|_| free)?;
            let length = wall.length();
            let shift = match self.seams {
                Seams::Around => share * length,
                Seams::Golden | Seams::Random => spread * (share - 0.5),
            };
            let (first, second) = wall.clone().split(shift.rem_euclid(length));
            Some(second.join(first))
        });
        if mixed {
            notes.layer(index, "walls that `join` has made one thread with others have no seam to move");
        }
        lines
    }

    /// How far the seam of a layer goes, as a share of the spread.
    fn share(&self, layer: usize) -> f64 {
        match self.seams {
            Seams::Golden | Seams::Around => ((layer as f64 + 1.0) * GOLDEN).fract(),
            Seams::Random => chance(u64::from(self.seed), layer as u64),
        }
    }
}

/// A number from 0 up to 1 that looks like chance: the mixing function of SplitMix64 (Steele, Lea and Flood 2014).
fn chance(seed: u64, index: u64) -> f64 {
    let mut mixed = seed.wrapping_add((index + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}
