//! Another nozzle.

use std::f64::consts::FRAC_PI_4;

use clay_processor::process;
use gcode::Line;
use skein::Error;

use crate::follow::{Zone, follow};
use crate::machine::{EPSILON_Z, Machine, Move};
use crate::survey::Survey;
use crate::writer::Aim;
use crate::{Edited, amount, factor, said};

/// Gives the beads the section that another nozzle lays: as much wider as the nozzle is, and as high as the layer.
///
/// The path stays, so walls become thicker about their middle. Primes and retractions stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nozzle {
    /// The nozzle for which the file was made, mm.
    pub old: f64,
    /// The nozzle that prints it, mm.
    pub new: f64,
    /// The form of a bead cut across.
    pub section: Section,
    /// The width of a bead in nozzles.
    pub spread: f64,
    /// The height of a layer, mm; measured if it is not given.
    pub layer: Option<f64>,
}

/// The form of a bead cut across.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Section {
    /// Width times height.
    #[default]
    Rectangle,
    /// A rectangle with round ends.
    Stadium,
    /// An ellipse.
    Ellipse,
}

impl Section {
    /// The area, mm². See `spec/clay.md` §5.1.
    fn area(self, width: f64, height: f64) -> f64 {
        match self {
            Self::Rectangle => width * height,
            Self::Stadium => width * height - (1.0 - FRAC_PI_4) * height * height,
            Self::Ellipse => FRAC_PI_4 * width * height,
        }
    }
}

impl Nozzle {
    pub(crate) fn apply(&self, text: &[u8]) -> Result<Edited, Error> {
        let [old, new] = [("the old nozzle", self.old), ("the new nozzle", self.new)].map(|(what, size)| {
            let size = amount(what, size, 1000.0)?;
            if size > 0.0 {
                Ok(size)
            } else {
                Err(Error::new(format!("{what} is 0 mm wide")).hint("give its bore in mm"))
            }
        });
        let (old, new) = (old?, new?);
        let survey = Survey::of(text)?;
        let spread = factor("the width of a bead in nozzles", self.spread)?;
        let (ratio, how) = if self.section == Section::Stadium {
            let height = self.layer.map_or_else(|| measured_layer(text), Ok)?;
            factor("the height of a layer", height)?;
            let narrow = old.min(new) * spread;
            if height > narrow {
                let message =
                    format!("a layer of {height:.3} mm is higher than a bead of {narrow:.3} mm is wide");
                return Err(
                    Error::new(message).hint("such a bead is no stadium: choose the section `ellipse`")
                );
            }
            let area = |nozzle: f64| self.section.area(nozzle * spread, height);
            (area(new) / area(old), format!("layers of {height:.3} mm"))
        } else {
            // Width and height are factors of the area, and all but the nozzle is the same in both.
            (
                self.section.area(new, 1.0) / self.section.area(old, 1.0),
                "layers as high as they are".to_owned(),
            )
        };
        let ratio = factor("the factor of E", ratio)?;
        let aim = |zone: Zone, _: &Line, was: &Move, _: &Machine| {
            let clay = if zone == Zone::Part && was.prints() { was.clay * ratio } else { was.clay };
            Ok(Aim { clay, ..Aim::same(was) })
        };
        let out = follow(text, &survey, aim)?;
        Ok(said(out, &[format!("{new} mm instead of {old} mm, {how}: E of beads times {ratio:.6}")]))
    }
}

/// The difference of height that most neighbouring layers have.
fn measured_layer(text: &[u8]) -> Result<f64, Error> {
    let layers = process(text).machine.layers;
    let mut heights: Vec<f64> = layers.iter().filter_map(|layer| layer.height).collect();
    heights.sort_by(f64::total_cmp);
    let mut gaps: Vec<f64> =
        heights.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| *gap > EPSILON_Z).collect();
    gaps.sort_by(f64::total_cmp);
    gaps.get(gaps.len() / 2).copied().ok_or_else(|| {
        Error::new("the height of a layer cannot be measured: the file has no two layers")
            .hint("say how high a layer is, in mm")
    })
}
