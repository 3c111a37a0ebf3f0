//! Layers that another program has drawn: nothing is cut, and all else is done that carve does.

use crate::planes::Slab;
use crate::{Carve, NOTHING_HERE, Rotation, Surface, loops, plate, slid};
use rayon::prelude::*;
use shape::{Bounds, Point, Point3, Ring};
use skein::{Error, Machine, Micron, Notes, RotatedLoopLayer, Slices};
use std::ops::RangeInclusive;

impl Carve {
    /// Puts drawn layers on the bed.
    ///
    /// Their heights are those of the drawing: how high a layer is follows from how far it is from the next. The width
    /// of the bead is what the drawing says, else the setting.
    ///
    /// # Errors
    /// When there is nothing to print, layers are lower than any bead, or they do not fit the machine.
    pub fn lay(&self, drawing: Slices, machine: &Machine, notes: &mut Notes) -> Result<Slices, Error> {
        let said = drawing.facts.layer_height.unwrap_or(self.layer_height);
        let (slabs, usual) = slabs(&drawing.layers, said)?;
        let width = drawing.facts.bead_width.unwrap_or(self.bead_width);
        if !WIDTHS.contains(&width) {
            let (low, high) = (WIDTHS.start(), WIDTHS.end());
            return Err(Error::new(format!(
                "the beads of the drawing are {width} mm wide, not {low} to {high} mm"
            ))
            .hint("correct its edgeWidth, or take that out: then carve.bead_width is the width"));
        }
        let first = slabs.first().map_or(usual, |slab| slab.height);
        let carve =
            Self { layer_height: usual, first_layer_height: first, bead_width: width, ..self.clone() };
        self.say_differences(&carve, notes);
        carve.check_bead(machine, notes)?;
        carve.laid(drawing.layers, slabs, machine, notes)
    }

    fn say_differences(&self, drawn: &Self, notes: &mut Notes) {
        for (what, own, drawn) in [
            ("layer_height", self.layer_height, drawn.layer_height),
            ("bead_width", self.bead_width, drawn.bead_width),
        ] {
            if own != drawn {
                notes.say(format!("the drawing has {drawn} mm where carve.{what} is {own} mm"));
            }
        }
        if self.rotate != Rotation::default() {
            notes.say("the layers of a drawing are not turned: carve.rotate is for meshes");
        }
        if self.surface == Surface::Wall {
            notes.say("what is drawn is clay: carve.surface = \"wall\" is for meshes");
        }
    }

    fn laid(
        &self,
        layers: Vec<RotatedLoopLayer>,
        slabs: Vec<Slab>,
        machine: &Machine,
        notes: &mut Notes,
    ) -> Result<Slices, Error> {
        let corners = || layers.iter().flat_map(|layer| &layer.loops).flat_map(|ring| ring.0.iter().copied());
        let spot = self.spot(bounds(corners(), &slabs)?, machine, notes)?;
        plate::fits(corners(), spot.shift, &spot.bounds, machine)?;
        let kept = self.kept(layers.into_iter().zip(slabs).collect())?;
        let tolerance = self.tolerance();
        let layers: Vec<RotatedLoopLayer> = kept
            .into_par_iter()
            .map(|(layer, slab)| RotatedLoopLayer {
                z: Micron(slab.middle.0 + spot.shift.z),
                thickness: (slab.height != self.layer_height).then_some(slab.height),
                rotation: None,
                loops: loops::of_rings(&layer.loops, tolerance)
                    .into_iter()
                    .map(|ring: Ring| slid(ring, spot.shift))
                    .collect(),
            })
            .collect();
        let empty = layers.iter().enumerate().filter(|(_, layer)| layer.loops.is_empty());
        empty.for_each(|(index, _)| notes.layer(index, NOTHING_HERE));
        if layers.iter().all(|layer| layer.loops.is_empty()) {
            return Err(Error::new("nothing is drawn in the layers")
                .hint("lower carve.skip_lowest and carve.skip_topmost, or look at the drawing"));
        }
        let mut slices =
            Slices { facts: self.facts(machine), bounds: spot.bounds, layers, ..Slices::default() };
        if self.find_bridges {
            self.bridged(&mut slices, |_| true);
        }
        Ok(slices)
    }
}

/// The box around drawn layers.
fn bounds(mut corners: impl Iterator<Item = Point>, slabs: &[Slab]) -> Result<Bounds, Error> {
    let nothing = || Error::new("nothing is drawn in the layers").hint("look at the drawing");
    let first = corners.next().ok_or_else(nothing)?;
    let (low, high) = corners.fold((first, first), |(low, high), point| {
        (
            Point::new(low.x.min(point.x), low.y.min(point.y)),
            Point::new(high.x.max(point.x), high.y.max(point.y)),
        )
    });
    let bottom = slabs.first().map_or(0, |slab| slab.middle.0 - slab.height.0 / 2);
    let top = slabs.last().map_or(0, |slab| slab.middle.0 + slab.height.0 - slab.height.0 / 2);
    Ok(Bounds { min: Point3 { x: low.x, y: low.y, z: bottom }, max: Point3 { x: high.x, y: high.y, z: top } })
}

/// What the height of a drawn layer is the height of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meaning {
    /// Where it was cut, as carve and Slic3r write it.
    Middle,
    /// Where the nozzle lays it.
    Top,
    /// What it stands on.
    Bottom,
}

impl Meaning {
    /// Guessed from the lowest layers, which stand on the bed: it lies half a layer above it, or a whole, or none.
    fn of(heights: &[i64], usual: i64) -> Self {
        let lowest = heights.first().copied().unwrap_or_default();
        // Over a first layer of any height the second ends where the first ended and begins half a layer below its middle.
        let gap = heights.get(1).map_or(0, |second| second - 2 * lowest - usual / 2);
        match () {
            () if lowest.abs() * 4 < usual => Self::Bottom,
            () if heights.len() > 1 && lowest > 0 && gap.abs() * 4 < usual => Self::Middle,
            () if lowest * 4 < 3 * usual => Self::Middle,
            () => Self::Top,
        }
    }
}

/// The layers of drawn heights from the bottom up, and the height that most of them have.
///
/// # Errors
/// When a layer is lower or higher than any may be.
fn slabs(layers: &[RotatedLoopLayer], said: Micron) -> Result<(Vec<Slab>, Micron), Error> {
    let heights: Vec<i64> = layers.iter().map(|layer| i64::from(layer.z.0)).collect();
    let gaps: Vec<i64> = heights.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut sorted = gaps.clone();
    sorted.sort_unstable();
    // Half of an even number of gaps: the lower, since a layer may be missing but hardly be there twice.
    let usual = sorted.get(sorted.len().saturating_sub(1) / 2).copied().unwrap_or(i64::from(said.0));
    // Heights are rounded when they are written.
    let usual = if (usual - i64::from(said.0)).abs() <= ROUNDING { i64::from(said.0) } else { usual };
    let meaning = Meaning::of(&heights, usual);
    let lowest = heights.first().copied().unwrap_or_default();
    let first = match meaning {
        // Layers that float are taken for the upper part of something.
        Meaning::Middle if lowest > 0 && lowest < 2 * usual => 2 * lowest,
        Meaning::Top if lowest <= 2 * usual => lowest,
        Meaning::Bottom if !gaps.is_empty() => gaps.first().copied().unwrap_or(usual),
        _ => usual,
    };
    let mut slabs = Vec::with_capacity(heights.len());
    let mut high = snapped(first, usual);
    for (index, &height) in heights.iter().enumerate() {
        let below = index.checked_sub(1).and_then(|below| gaps.get(below)).copied();
        let above = gaps.get(index).copied();
        high = match (meaning, below, above) {
            (_, None, _) => high,
            (Meaning::Top, Some(gap), _) | (Meaning::Bottom, _, Some(gap)) => snapped(gap, usual),
            (Meaning::Bottom, Some(_), None) => usual,
            // From middle to middle it is half of one layer and half of the other.
            (Meaning::Middle, Some(gap), _) => {
                let rest = snapped(2 * gap - high, usual);
                if rest * 4 > usual { rest } else { gap }
            }
        };
        let middle = match meaning {
            Meaning::Middle => height,
            Meaning::Top => height - high + high / 2,
            Meaning::Bottom => height + high / 2,
        };
        let micron =
            |value: i64| i32::try_from(value).ok().map(Micron).filter(|value| value.0.abs() < HIGHEST);
        let slab = micron(middle).zip(micron(high)).map(|(middle, height)| Slab { middle, height });
        slabs.push(slab.ok_or_else(|| {
            Error::layer(index, "the layer lies more than 250 m high")
                .hint("check the heights of the drawing")
        })?);
    }
    if let Some(index) = slabs.iter().position(|slab| !HEIGHTS.contains(&slab.height)) {
        let height = slabs[index].height;
        let (low, high) = (HEIGHTS.start(), HEIGHTS.end());
        return Err(Error::layer(index, format!("the layer is {height} mm high, not {low} to {high} mm"))
            .hint("check the heights of the drawing: they are millimetres, and no layer may be missing"));
    }
    let usual = i32::try_from(usual).map_or(said, Micron);
    Ok((slabs, usual))
}

/// How far heights are from where they should be because they were rounded, in microns.
const ROUNDING: i64 = 10;
/// What the settings allow, `carve.layer_height` and `carve.bead_width`.
const HEIGHTS: RangeInclusive<Micron> = Micron(50)..=Micron(100_000);
const WIDTHS: RangeInclusive<Micron> = Micron(100)..=Micron(200_000);
/// Higher than any machine, and so low that the distance of two heights is one.
const HIGHEST: i32 = Micron::LIMIT / 4;

/// The usual height where one is that but for rounding.
fn snapped(height: i64, usual: i64) -> i64 {
    if (height - usual).abs() <= ROUNDING { usual } else { height }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laid(heights: &[f64], said: f64) -> Vec<(f64, f64)> {
        let mm = |value| Micron::from_mm(value).expect("a length");
        let layers: Vec<RotatedLoopLayer> =
            heights.iter().map(|z| RotatedLoopLayer { z: mm(*z), ..Default::default() }).collect();
        let (slabs, _) = slabs(&layers, mm(said)).expect("layers");
        slabs.iter().map(|slab| (slab.middle.mm(), slab.height.mm())).collect()
    }

    #[test]
    fn heights_of_middles() {
        assert_eq!(laid(&[0.5, 1.5], 1.5), [(0.5, 1.0), (1.5, 1.0)]);
        assert_eq!(laid(&[0.6, 1.95, 3.45], 1.5), [(0.6, 1.2), (1.95, 1.5), (3.45, 1.5)]);
        // Slic3r with a first layer of 1.2 and others of 1 mm.
        assert_eq!(laid(&[0.6, 1.7, 2.7], 1.5), [(0.6, 1.2), (1.7, 1.0), (2.7, 1.0)]);
        assert_eq!(laid(&[0.75], 1.5), [(0.75, 1.5)]);
        // Layers of 1, 1, 2, 2 and 1 mm.
        let of_any = [(0.5, 1.0), (1.5, 1.0), (3.0, 2.0), (5.0, 2.0), (6.5, 1.0)];
        assert_eq!(laid(&of_any.map(|(z, _)| z), 1.5), of_any);
    }

    #[test]
    fn heights_of_tops_and_bottoms() {
        assert_eq!(laid(&[1.5, 3.0, 4.5], 1.0), [(0.75, 1.5), (2.25, 1.5), (3.75, 1.5)]);
        assert_eq!(laid(&[1.2, 2.7, 4.2], 1.0), [(0.6, 1.2), (1.95, 1.5), (3.45, 1.5)]);
        assert_eq!(laid(&[0.0, 2.0, 3.0], 1.0), [(1.0, 2.0), (2.5, 1.0), (3.5, 1.0)]);
        assert_eq!(laid(&[1.5], 1.5), [(0.75, 1.5)]);
    }

    #[test]
    fn layers_that_float_are_as_high_as_the_others() {
        assert_eq!(laid(&[20.0, 21.0], 1.5), [(19.5, 1.0), (20.5, 1.0)]);
    }

    #[test]
    fn layers_without_a_height_are_refused() {
        let layer = |z| RotatedLoopLayer { z: Micron(z), ..Default::default() };
        let error =
            slabs(&[layer(0), layer(1000), layer(1001), layer(2001)], Micron(1000)).expect_err("flat");
        assert!(error.message.contains("0.001 mm high, not 0.05 to 100.0 mm"), "{error}");
        // Far apart as they are, nothing overflows.
        let far = [layer(-900_000_000), layer(0), layer(900_000_000)];
        assert!(slabs(&far, Micron(1000)).expect_err("far").message.contains("250 m"));
    }
}
