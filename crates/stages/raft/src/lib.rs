#![doc = include_str!("../README.md")]

mod bed;
mod course;
mod heat;
mod lay;
mod support;
#[cfg(test)]
mod tests;

use bed::Bed;
use course::Course;
use heat::{Heat, Steps};
use lay::{Rates, Threads, in_order};
use rayon::prelude::*;
use skein::{
    Angle, Choice, Error, Facts, Layer, Line, Micron, Notes, Nozzle, Ratio, Ring, Settings, Skein, Stage,
    Tag, boundary,
};
use support::Support;

/// Builds what the part stands on and what holds up its overhangs.
#[derive(Clone, Debug, Settings)]
pub struct Raft {
    /// How many layers of spaced lines lie under the part. They let air under a slab that dries, and the part comes off
    /// them more easily than off the bat.
    #[setting(default = 1, min = 0, max = 100)]
    pub base_layers: u32,
    /// How high a base layer is, in layer heights; its beads are wider by the same share.
    #[setting(default = 1.0, min = 0.1, max = 10.0)]
    pub base_thickness: Ratio,
    /// The share of a base layer that is clay. Less comes off more easily and sags more.
    #[setting(default = 0.5, min = 0.05, max = 1.0)]
    pub base_density: Ratio,
    /// The speed of the base, as a share of the feed. Thicker beads are laid slower besides, so that clay flows as fast
    /// as ever.
    #[setting(default = 0.5, min = 0.05, max = 10.0)]
    pub base_feed: Ratio,
    /// The clay of the base, as a share. More sticks better to a bat that is not flat.
    #[setting(default = 1.0, min = 0.1, max = 10.0)]
    pub base_flow: Ratio,
    /// How high the nozzle stands above the middle of a base bead, in heights of that bead: 0.5 is its top, less
    /// presses it.
    #[setting(default = 0.5, min = 0.1, max = 1.0)]
    pub base_nozzle_lift: Ratio,
    /// How many finer layers lie between base and part. Each crosses the one below.
    #[setting(default = 0, min = 0, max = 100)]
    pub interface_layers: u32,
    /// How high an interface layer is, in layer heights; its beads are wider by the same share.
    #[setting(default = 1.0, min = 0.1, max = 10.0)]
    pub interface_thickness: Ratio,
    /// The share of an interface layer that is clay, and of the dense layers of support.
    #[setting(default = 0.7, min = 0.05, max = 1.0)]
    pub interface_density: Ratio,
    /// The speed of the interface, as a share of the feed.
    #[setting(default = 1.0, min = 0.05, max = 10.0)]
    pub interface_feed: Ratio,
    /// The clay of the interface, as a share.
    #[setting(default = 1.0, min = 0.1, max = 10.0)]
    pub interface_flow: Ratio,
    /// How high the nozzle stands above the middle of an interface bead, in heights of that bead.
    #[setting(default = 0.5, min = 0.1, max = 1.0)]
    pub interface_nozzle_lift: Ratio,
    /// How high the nozzle stands above the middle of the part's first bead, in layer heights: 0.5 is its top; more leaves
    /// a gap over the raft, so that the part comes off, less presses it on. The whole part is raised with it.
    #[setting(default = 0.5, min = 0.1, max = 2.0)]
    pub object_nozzle_lift: Ratio,
    /// How far the raft reaches beyond the part.
    #[setting(default = 1.0, min = 0.0, max = 100.0, unit = "beads")]
    pub margin: Ratio,
    /// How much farther it reaches for its size, in percent of the longer side of the part.
    #[setting(default = 1.0, min = 0.0, max = 100.0, unit = "%")]
    pub additional_margin_over_length: Ratio,
    /// Where support is built. It is of the same clay and has to be cut off while that is wet.
    #[setting(default = SupportChoice::None)]
    pub support: SupportChoice,
    /// The overhang, from the vertical, that needs no support.
    #[setting(default = 45.0, min = 0.0, max = 89.0, unit = "°")]
    pub support_minimum_angle: Angle,
    /// The free room between support and the walls beside it. Less holds better and is harder to cut.
    #[setting(default = 0.25, min = 0.0, max = 20.0, unit = "beads")]
    pub support_gap: Ratio,
    /// How far support reaches beyond what it holds.
    #[setting(default = 0.5, min = 0.0, max = 20.0, unit = "beads")]
    pub support_margin: Ratio,
    /// The share of support that is clay: at 0.5 the lines of its zig-zag are two beads apart.
    #[setting(default = 0.5, min = 0.05, max = 1.0)]
    pub support_density: Ratio,
    /// Whether every other layer of support crosses the one below. It stands better and is harder to cut.
    #[setting(default = false)]
    pub support_cross_hatch: bool,
    /// How many layers of support directly under the part are as dense as the interface.
    #[setting(default = 0, min = 0, max = 1000)]
    pub support_interface_layers: u32,
    /// How many layers of support directly over the bed are as dense as the interface, so that it stands.
    #[setting(default = 1, min = 0, max = 1000)]
    pub support_base_layers: u32,
    /// The speed of support, as a share of that of the layer it is on.
    #[setting(default = 1.0, min = 0.05, max = 10.0)]
    pub support_feed: Ratio,
    /// The clay of support, as a share.
    #[setting(default = 1.0, min = 0.1, max = 10.0)]
    pub support_flow: Ratio,
    /// Lines of your own before the support of a layer.
    #[setting(default = "")]
    pub support_start: String,
    /// Lines of your own behind it.
    #[setting(default = "")]
    pub support_end: String,
}

/// Where support is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum SupportChoice {
    /// Nowhere.
    None,
    /// Only on layers that are empty between two that are not.
    EmptyLayersOnly,
    /// Under every overhang.
    Everywhere,
    /// Under overhangs that have nothing below them down to the bed.
    ExteriorOnly,
}

impl Stage for Raft {
    const NAME: &'static str = "raft";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        let mut heat = Heat::new(&facts)?;
        if skein.layers.is_empty() || (self.changes_nothing() && heat.is_none()) {
            return Ok(skein);
        }
        let rates = Rates { feed: facts.operating_feed()?, travel: facts.travel_feed()? };
        let outlines: Vec<Vec<Ring>> = skein.layers.par_iter().map(|layer| boundary(&layer.lines)).collect();
        let bed = Bed::new(&facts)?;
        let supports = support::find(self, &skein.layers, &outlines, &facts, &bed, notes)?;
        let courses =
            Course::stack(self, &skein.layers[0], &outlines, supports.first(), &facts, &bed, notes)?;

        let mut raft = Vec::with_capacity(courses.len());
        for course in &courses {
            let steps = heat.as_mut().map_or_else(Vec::new, |heat| course.heat(heat, &facts));
            raft.push(course.layer(steps, rates, &facts)?);
        }
        let top = courses.last().map_or(0, |course| course.rise());
        let first = skein.layers[0].height(&facts)?;
        let lift = Micron::from_mm(first.mm() * (self.object_nozzle_lift.f64() - 0.5)).unwrap_or_default();
        let nozzles = skein.nozzles();
        raise(&mut skein, i64::from(top) + i64::from(lift.0))?;
        let steps = match &mut heat {
            Some(heat) => heat.object(&skein.layers, &outlines, &supports, &facts)?,
            None => vec![Steps::default(); skein.layers.len()],
        };
        skein.each(|index, layer| {
            nozzles[index].restate(&mut layer.lines);
            let block = self.block(layer, &supports[index], &steps[index], nozzles[index], rates, &facts)?;
            let at = layer.opening();
            layer.lines.splice(at..at, block);
            Ok(())
        })?;
        if let (Some(heat), Some(layer)) = (&mut heat, skein.layers.first_mut()) {
            layer.lines = heat.first_layer(std::mem::take(&mut layer.lines))?;
        }
        skein.layers.splice(0..0, raft);
        Ok(skein)
    }
}

impl Raft {
    fn changes_nothing(&self) -> bool {
        self.base_layers == 0
            && self.interface_layers == 0
            && self.support == SupportChoice::None
            && self.object_nozzle_lift.f64() == 0.5
    }

    /// What comes first on a layer of the part: its support, and the steps of the temperature around it.
    fn block(
        &self,
        layer: &Layer,
        support: &Support,
        steps: &Steps,
        nozzle: Nozzle,
        rates: Rates,
        facts: &Facts,
    ) -> Result<Vec<Line>, Error> {
        if support.threads.is_empty() {
            return Ok(steps.after.clone());
        }
        let feed = first_feed(layer, nozzle).unwrap_or(rates.feed).mm_per_s() * self.support_feed.f64();
        let lay = Threads {
            z: layer.nozzle_z(facts)?.0,
            rates: Rates { feed: lay::feed(feed)?, ..rates },
            flow: self.support_flow,
            around: nozzle.flow,
        };
        let mut lines = vec![Line::Open(Tag::Support)];
        lines.extend(pasted(&self.support_start));
        lines.extend_from_slice(&steps.before);
        let from = nozzle.at.map(|at| skein::Point::new(at.x, at.y));
        lay.write(in_order(support.threads.clone(), from), &mut lines);
        lines.extend_from_slice(&steps.after);
        lines.extend(pasted(&self.support_end));
        lines.push(Line::Close(Tag::Support));
        Ok(lines)
    }
}

/// The speed of the first bead of a layer.
fn first_feed(layer: &Layer, mut nozzle: Nozzle) -> Option<skein::Feed> {
    for line in &layer.lines {
        if nozzle.on
            && let Some(step) = line.as_move()
        {
            return step.feed.or(nozzle.feed);
        }
        nozzle.follow(line);
    }
    None
}

/// Lines of the potter's own, so that no stage takes them for its own.
fn pasted(text: &str) -> Vec<Line> {
    let lines: Vec<Line> = text
        .lines()
        .map(str::trim_end)
        .filter(|line| !line.is_empty())
        .map(|line| Line::Pasted(line.into()))
        .collect();
    if lines.is_empty() {
        return lines;
    }
    let (open, close) = (Line::Open(Tag::Alteration), Line::Close(Tag::Alteration));
    std::iter::once(open).chain(lines).chain(std::iter::once(close)).collect()
}

/// Lifts all layers and what follows them.
fn raise(skein: &mut Skein, by: i64) -> Result<(), Error> {
    let lifted = |z: i32| {
        Micron::from_places(i64::from(z) + by)
            .ok_or_else(|| Error::new("the raft lifts the part out of range"))
    };
    let raise = |lines: &mut [Line]| -> Result<(), Error> {
        for line in lines {
            match line {
                Line::Layer(z) => *z = lifted(z.0)?,
                Line::Point(_, at) => at.z = lifted(at.z)?.0,
                line => {
                    if let Some(step) = line.as_move_mut() {
                        step.to.z = lifted(step.to.z)?.0;
                    }
                }
            }
        }
        Ok(())
    };
    skein.each(|_, layer| raise(&mut layer.lines))?;
    raise(&mut skein.tail)
}
