#![doc = include_str!("../README.md")]

mod meter;
#[cfg(test)]
mod tests;

use meter::{Meter, Total};
use rayon::prelude::*;
use skein::{Choice, Error, Line, Notes, Nozzle, Place, Ratio, Reader, Settings, Skein, Stage, Tag};

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

        let nozzles = skein.nozzles();
        let mut below = meter.write(&mut skein.head, usual, Nozzle::default(), Total::default())?;
        let clay: Vec<Result<Total, Error>> = skein
            .layers
            .par_iter()
            .zip(&nozzles)
            .map(|(layer, nozzle)| meter.measure(&layer.lines, layer.height(&facts)?, *nozzle))
            .collect();
        let mut bases = Vec::with_capacity(clay.len());
        for (index, clay) in clay.into_iter().enumerate() {
            bases.push(below);
            below = below + clay.map_err(|error| error.at(Place::Layer(index)))?;
        }
        skein.each(|index, layer| {
            let height = layer.height(&facts)?;
            meter.write(&mut layer.lines, height, nozzles[index], bases[index]).map(|_| ())
        })?;
        meter.write(&mut skein.tail, usual, nozzles[skein.layers.len()], below)?;
        self.announce(&mut skein)?;
        Ok(skein)
    }
}

impl Dimension {
    /// Says in the file how E counts, and from zero. Marlin's G90 also makes E absolute, so this comes after the header
    /// with its G90.
    fn announce(&self, skein: &mut Skein) -> Result<(), Error> {
        let mode = match self.counting {
            Counting::Relative => "M83",
            Counting::Absolute => "M82",
        };
        let mut reader = Reader::default();
        let lines = [reader.line(mode.as_bytes())?, reader.line(b"G92 E0")?];
        let crafting = skein.head.iter().position(|line| *line == Line::Open(Tag::Crafting));
        let index = crafting.map_or(skein.head.len(), |index| index + 1);
        skein.head.splice(index..index, lines);
        Ok(())
    }
}
