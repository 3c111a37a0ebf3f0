#![doc = include_str!("../README.md")]

mod infill;
mod order;
mod source;
mod strand;
mod walls;

use rayon::prelude::*;
use skein::{Angle, Choice, Direction, Error, Layer, Notes, Point, Ratio, Settings, Skein, Stage};
use source::Source;
use strand::{Island, Strand};

/// Adds the inner walls and the infill, and puts the threads of each layer in order.
#[derive(Clone, Debug, Settings)]
pub struct Fill {
    /// How many beads the wall is thick, the outermost included. With 0 the infill reaches the outline.
    #[setting(default = 2, min = 0, max = 1000)]
    pub walls: u32,
    /// How many layers are solid above the bed and above every gap.
    #[setting(default = 2, min = 0, max = 10000)]
    pub base_layers: u32,
    /// How many layers are solid below every surface that looks up. 0 for a pot that stays open.
    #[setting(default = 2, min = 0, max = 10000)]
    pub top_layers: u32,
    /// The share of the inside that is clay: 0 is empty, 1 solid.
    #[setting(default = 0.2, min = 0.0, max = 1.0)]
    pub density: Ratio,
    /// How far the infill runs into the wall, in beads. More binds better and bulges more.
    #[setting(default = 0.0, min = 0.0, max = 0.5, unit = "beads")]
    pub overlap: Ratio,
    /// The direction of the infill lines on the first layer, from the x axis.
    #[setting(default = 45.0, min = -360.0, max = 360.0, unit = "°")]
    pub begin_rotation: Angle,
    /// How far the direction turns on every other layer.
    #[setting(default = 90.0, min = -360.0, max = 360.0, unit = "°")]
    pub odd_layer_extra_rotation: Angle,
    /// The order of a layer's parts. Walls from the inside out leave the best surface.
    #[setting(default = ThreadSequence::LoopsPerimeterInfill)]
    pub thread_sequence: ThreadSequence,
    /// Where a wall starts and ends.
    #[setting(default = Start::Nearest)]
    pub start: Start,
    /// The place that the seam is nearest to, when `start` is "seam".
    #[setting(default = Point::new(0, 0), min = -100000.0, max = 100000.0, unit = "mm")]
    pub seam: Point,
}

/// The order of a layer's parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum ThreadSequence {
    /// Inner walls, outermost wall, infill.
    LoopsPerimeterInfill,
    /// Inner walls, infill, outermost wall.
    LoopsInfillPerimeter,
    /// Infill, inner walls, outermost wall.
    InfillLoopsPerimeter,
    /// Infill, outermost wall, inner walls.
    InfillPerimeterLoops,
    /// Outermost wall, inner walls, infill.
    PerimeterLoopsInfill,
    /// Outermost wall, infill, inner walls.
    PerimeterInfillLoops,
}

/// Where a wall starts and ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Start {
    /// Nearest to where the nozzle is: the shortest travels.
    Nearest,
    /// Nearest to a place: all seams above each other.
    Seam,
}

impl Stage for Fill {
    const NAME: &'static str = "fill";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        // Read everything first: what is solid depends on the layers around.
        let sources = std::mem::take(&mut skein.layers)
            .into_par_iter()
            .enumerate()
            .map(|(index, layer)| Source::read(layer, &facts).map_err(|error| error.in_layer(index)))
            .collect::<Result<Vec<Source>, Error>>()?;
        let planned: Vec<(Vec<Island>, Notes)> = (0..sources.len())
            .into_par_iter()
            .map(|index| {
                let mut notes = Notes::default();
                let islands = self.islands(&sources, index, &mut notes);
                (islands, notes)
            })
            .collect();
        let mut layers = Vec::with_capacity(planned.len());
        for (islands, remarks) in planned {
            notes.append(remarks);
            layers.push(islands);
        }
        // Where a layer starts depends on where the last one ended.
        let ordered = order::layers(layers, self);
        skein.layers = sources
            .into_par_iter()
            .zip(ordered)
            .enumerate()
            .map(|(index, (source, islands))| Layer { lines: source.write(&islands, self.direction(index)) })
            .collect();
        Ok(skein)
    }
}

impl Fill {
    /// The direction of the infill lines of a layer that is no bridge.
    fn direction(&self, layer: usize) -> Direction {
        let turn = if layer % 2 == 1 { self.odd_layer_extra_rotation.0 } else { 0 };
        Angle(self.begin_rotation.0 + turn).direction()
    }

    /// Everything that is laid on a layer, island by island, in no order yet.
    fn islands(&self, sources: &[Source], index: usize, notes: &mut Notes) -> Vec<Island> {
        let source = &sources[index];
        if source.outlines.is_empty() {
            return Vec::new();
        }
        let surroundings = self.surroundings(sources, index);
        let solid = self.density == Ratio::ONE || surroundings.is_none();
        let mut strands: Vec<Strand> = source.middles.clone();
        let inside = walls::lay(source, self, solid, &mut strands);
        let direction = source.bridge.unwrap_or_else(|| self.direction(index));
        let turn = source.bridge.is_none().then_some(index % 2);
        let job = infill::Job { fill: self, source, inside: &inside, direction, turn, surroundings };
        job.run(index, &mut strands, notes);
        strand::sort_into_islands(&source.outlines, strands)
    }

    /// The layers that must all hold clay above and below a place for it not to be a surface; `None` when one of
    /// them is missing, so that everything is surface.
    fn surroundings<'a>(&self, sources: &'a [Source], index: usize) -> Option<Vec<&'a Source>> {
        let below = (1..=self.base_layers as usize).map(|step| index.checked_sub(step));
        let above = (1..=self.top_layers as usize).map(|step| index.checked_add(step));
        below
            .chain(above)
            .map(|layer| sources.get(layer?).filter(|source| !source.outlines.is_empty()))
            .collect()
    }
}
