#![doc = include_str!("../README.md")]

mod meter;
mod outlines;
mod relief;
#[cfg(test)]
mod relief_tests;
#[cfg(test)]
mod tests;

use meter::{Account, Meter, Total};
use rayon::prelude::*;
use relief::Relief;
use skein::{Choice, Error, Line, Micron, Notes, Nozzle, Place, Ratio, Reader, Settings, Skein, Stage, Tag};

/// Puts an E word on every move that lays clay.
#[derive(Clone, Debug, Settings)]
pub struct Dimension {
    /// Whether an E word counts from the last one or from the start of the print.
    #[setting(default = Counting::Relative)]
    pub counting: Counting,
    /// Multiplies all clay: found by weighing what comes out. Too little leaves gaps between the beads, too much heaps
    /// clay up in front of the nozzle.
    #[setting(default = 1.0, min = 0.1, max = 10.0)]
    pub flow: Ratio,
    /// How much clay is drawn back where a bead ends and pushed in again where the next begins. It takes the pressure
    /// off, so that less follows on the travel; too much draws air into the nozzle.
    #[setting(default = 0.0, min = 0.0, max = 1000.0, unit = "mm³")]
    pub retraction_volume: Ratio,
    /// What is pushed in beyond what was drawn back: what has been lost on the travel.
    #[setting(default = 0.0, min = 0.0, max = 1000.0, unit = "mm³")]
    pub restart_extra_volume: Ratio,
    /// What is pushed in before the very first bead, until the clay is at the end of the nozzle.
    #[setting(default = 0.0, min = 0.0, max = 1000.0, unit = "mm³")]
    pub prime_volume: Ratio,
    /// How fast clay is drawn back. The machine's own limit for the ram is a matter of its firmware.
    #[setting(default = 200.0, min = 0.1, max = 1000.0, unit = "mm³/s")]
    pub retraction_speed: Ratio,
    /// How fast clay is pushed in again.
    #[setting(default = 200.0, min = 0.1, max = 1000.0, unit = "mm³/s")]
    pub restart_speed: Ratio,
    /// A travel up to this length over clay wants no relief; from twice this length on it wants all, between them a
    /// part.
    #[setting(default = 6.0, min = 0.0, max = 1000.0, unit = "mm")]
    pub minimum_travel: Micron,
    /// Whether there is a relief before travels that stay over the clay of one island, too. What drops there is covered
    /// by the next layer.
    #[setting(default = false)]
    pub retract_within_island: bool,
    /// An absolute E beyond this is set back to zero at the next layer, for firmware that counts in short floats; 0 is
    /// never. In the machine's unit of E.
    #[setting(default = 0, min = 0, max = 1000000000)]
    pub maximum_e_before_reset: u32,
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

    /// Three steps, so that layers run side by side and the result is the same on every number of cores: the clay of
    /// each layer by itself, then what lies below each layer, then the E words of each layer.
    fn craft(&self, mut skein: Skein, _notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        let meter = Meter::new(&facts, self.flow, self.counting)?;
        let usual = facts.layer_height()?;
        if let Some(relief) = Relief::new(self, &facts, meter.step())? {
            relief.write(&mut skein)?;
        }

        let nozzles = skein.nozzles();
        let mut below = meter.write(&mut skein.head, usual, Nozzle::default(), Account::default())?;
        let clay: Vec<Result<Total, Error>> = skein
            .layers
            .par_iter()
            .zip(&nozzles)
            .map(|(layer, nozzle)| meter.measure(&layer.lines, layer.height(&facts)?, *nozzle))
            .collect();
        let mut accounts = Vec::with_capacity(clay.len());
        let mut zero = 0;
        for (index, clay) in clay.into_iter().enumerate() {
            let clay = clay.map_err(|error| error.at(Place::Layer(index)))?;
            let reset =
                self.is_beyond(meter.rounded(below)?.saturating_sub(zero)) && clay != Total::default();
            if reset {
                zero = meter.rounded(below)?;
            }
            accounts.push((Account { below, zero }, reset));
            below = below + clay;
        }
        skein.each(|index, layer| {
            let height = layer.height(&facts)?;
            let (account, reset) = accounts[index];
            meter.write(&mut layer.lines, height, nozzles[index], account)?;
            if reset {
                let behind = 1 + usize::from(matches!(layer.lines.get(1), Some(Line::Thickness(_))));
                layer.lines.insert(behind.min(layer.lines.len()), Reader::default().line(ZERO)?);
            }
            Ok(())
        })?;
        meter.write(&mut skein.tail, usual, nozzles[skein.layers.len()], Account { below, zero })?;
        self.announce(&mut skein)?;
        Ok(skein)
    }
}

/// The E of the machine counts from here.
const ZERO: &[u8] = b"G92 E0";

impl Dimension {
    /// Whether an absolute E, in hundred-thousandths, is set back.
    fn is_beyond(&self, e: i64) -> bool {
        let limit = i64::from(self.maximum_e_before_reset) * 100_000;
        self.counting == Counting::Absolute && limit > 0 && e > limit
    }

    /// Says in the file how E counts, and from zero. Marlin's G90 also makes E absolute, so this comes after the header
    /// with its G90.
    fn announce(&self, skein: &mut Skein) -> Result<(), Error> {
        let mode = match self.counting {
            Counting::Relative => "M83",
            Counting::Absolute => "M82",
        };
        let mut reader = Reader::default();
        let lines = [reader.line(mode.as_bytes())?, reader.line(ZERO)?];
        let crafting = skein.head.iter().position(|line| *line == Line::Open(Tag::Crafting));
        let index = crafting.map_or(skein.head.len(), |index| index + 1);
        skein.head.splice(index..index, lines);
        Ok(())
    }
}
