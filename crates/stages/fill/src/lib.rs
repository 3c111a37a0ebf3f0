#![doc = include_str!("../README.md")]

mod infill;
mod map;
mod order;
mod pattern;
mod rings;
mod source;
mod strand;
mod surface;
mod walls;
mod widths;

#[cfg(test)]
mod tests;

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
    /// How many inner walls more there are on the first and every other solid layer. Solid layers that differ in them
    /// interlock with their infill.
    #[setting(default = 0, min = 0, max = 1000)]
    pub extra_shells_base: u32,
    /// How many inner walls more there are on the solid layers between those.
    #[setting(default = 0, min = 0, max = 1000)]
    pub extra_shells_alternating_solid_layer: u32,
    /// How many inner walls more there are on layers with a sparse inside.
    #[setting(default = 0, min = 0, max = 1000)]
    pub extra_shells_sparse_layer: u32,
    /// How many inner walls more there are on layers that bridge a gap.
    #[setting(default = 0, min = 0, max = 1000)]
    pub extra_shells_bridge_layer: u32,
    /// How many layers are solid above the bed and above every gap.
    #[setting(default = 2, min = 0, max = 10000)]
    pub base_layers: u32,
    /// How many layers are solid below every surface that looks up. 0 for a pot that stays open.
    #[setting(default = 2, min = 0, max = 10000)]
    pub top_layers: u32,
    /// How flat an overhang or a slope must be to count as a surface, from vertical. With 0 every step is one; with more
    /// the layers around are first grown by what a wall leaning that far stands out, less a bead.
    #[setting(default = 0.0, min = 0.0, max = 80.0, unit = "°")]
    pub surrounding_angle: Angle,
    /// Of how many layers the first `diaphragm_thickness` are solid: floors inside, which stiffen high walls.
    #[setting(default = 100, min = 1, max = 100000, unit = "layers")]
    pub diaphragm_period: u32,
    /// How many layers such a floor is thick; 0 for none.
    #[setting(default = 0, min = 0, max = 10000, unit = "layers")]
    pub diaphragm_thickness: u32,
    /// The share of the inside that is clay: 0 is empty, 1 solid.
    #[setting(default = 0.2, min = 0.0, max = 1.0)]
    pub density: Ratio,
    /// How layers are laid that are solid all over. Bridges and the solid parts of other layers always have lines.
    #[setting(default = SolidPattern::Line)]
    pub solid_pattern: SolidPattern,
    /// How sparse infill is laid. Solid layers have lines or rings, as `solid_pattern` says.
    #[setting(default = Pattern::Line)]
    pub pattern: Pattern,
    /// How far two lines of the rectangular and the hexagonal pattern run into each other where they meet. More binds
    /// better and bulges more.
    #[setting(default = 0.1, min = 0.0, max = 0.5, unit = "beads")]
    pub grid_overlap: Ratio,
    /// After how many layers the meetings of the rectangular pattern are again as far open as at first: each goes from
    /// `junction_separation_at_end` to `junction_separation_at_middle` and back, so that a wall of cells is an accordion.
    #[setting(default = 10, min = 1, max = 100000, unit = "layers")]
    pub junction_band: u32,
    /// How far two lines of the rectangular pattern stay apart where they meet, at both ends of a band: 0 not at all, 1 by
    /// as much as there is room between two lines. Lines that stay apart do not hold each other.
    #[setting(default = 0.0, min = 0.0, max = 0.8)]
    pub junction_separation_at_end: Ratio,
    /// The same in the middle of a band.
    #[setting(default = 0.0, min = 0.0, max = 0.8)]
    pub junction_separation_at_middle: Ratio,
    /// How much room is left between the circles of the circular pattern. With 0 they touch and hold each other.
    #[setting(default = 0.0, min = 0.0, max = 1.0, unit = "beads")]
    pub circle_gap: Ratio,
    /// How far the infill runs into the wall, in beads. More binds better and bulges more.
    #[setting(default = 0.0, min = 0.0, max = 0.5, unit = "beads")]
    pub overlap: Ratio,
    /// The direction of the infill lines on the first layer, from the x axis.
    #[setting(default = 45.0, min = -360.0, max = 360.0, unit = "°")]
    pub begin_rotation: Angle,
    /// How many layers in a row have that direction before one is turned.
    #[setting(default = 1, min = 1, max = 100000, unit = "layers")]
    pub begin_rotation_repeat: u32,
    /// How far the direction turns on that layer.
    #[setting(default = 90.0, min = -360.0, max = 360.0, unit = "°")]
    pub odd_layer_extra_rotation: Angle,
    /// The sharpest corner that an infill thread goes round, measured between its two sides; at a sharper one it ends and
    /// a new one begins. 0 goes round all: clay wants few ends.
    #[setting(default = 0.0, min = 0.0, max = 89.0, unit = "°")]
    pub sharpest_angle: Angle,
    /// The order of a layer's parts. Walls from the inside out leave the best surface.
    #[setting(default = ThreadSequence::LoopsPerimeterInfill)]
    pub thread_sequence: ThreadSequence,
    /// The order on the first layer. The outermost wall first shows where the part lies, and sticks best.
    #[setting(default = ThreadSequence::PerimeterLoopsInfill)]
    pub first_layer_sequence: ThreadSequence,
    /// Where a wall starts and ends.
    #[setting(default = Start::Nearest)]
    pub start: Start,
    /// The place that the seam is nearest to, when `start` is "seam".
    #[setting(default = Point::new(0, 0), min = -100000.0, max = 100000.0, unit = "mm")]
    pub seam: Point,
}

/// How sparse infill is laid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Pattern {
    /// Parallel lines, which cross those of the layer below.
    Line,
    /// Square cells, standing on their corners between zigzags.
    Rectangular,
    /// Honeycomb.
    Hexagonal,
    /// Circles side by side.
    Circular,
    /// Rings that follow the walls inwards, each joined to the next.
    Concentric,
}

/// How layers are laid that are solid all over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum SolidPattern {
    /// Parallel lines, which cross those of the layer below: they bind best.
    Line,
    /// Walls all the way in, and what is left between them: no open corners where lines would turn.
    Concentric,
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
    /// As `nearest`, but every layer begins at the corner of the part with the least x + y.
    LowerLeft,
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
        let walls = self.walls(&sources);
        let planned: Vec<(Vec<Island>, Notes)> = (0..sources.len())
            .into_par_iter()
            .map(|index| {
                let mut notes = Notes::default();
                let islands = self.islands(&sources, index, walls[index], &mut notes);
                (islands, notes)
            })
            .collect();
        let mut layers = Vec::with_capacity(planned.len());
        for (islands, remarks) in planned {
            notes.append(remarks);
            layers.push(islands);
        }
        // Where a layer starts depends on where the last one ended.
        let ordered = order::layers(layers, &sources, self);
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
    /// Which of the two directions a layer has that is no bridge: 0, or 1 for the one that is turned.
    fn turn(&self, layer: usize) -> usize {
        let repeat = self.begin_rotation_repeat as usize;
        usize::from(layer % (repeat + 1) == repeat)
    }

    /// The direction of the infill lines of a layer that is no bridge.
    fn direction(&self, layer: usize) -> Direction {
        let turn = if self.turn(layer) == 1 { self.odd_layer_extra_rotation.0 } else { 0 };
        Angle(self.begin_rotation.0 + turn).direction()
    }

    /// How many walls each layer has. The first solid layer behind one with as many inner walls as a base has those of
    /// the alternating ones, so that no two solid layers are alike.
    fn walls(&self, sources: &[Source]) -> Vec<u32> {
        let mut last = None;
        let extra = |index| {
            let source: &Source = &sources[index];
            let extra = if source.bridge.is_some() {
                self.extra_shells_bridge_layer
            } else if self.density < Ratio::ONE && self.surroundings(sources, index).is_some() {
                self.extra_shells_sparse_layer
            } else if last == Some(self.extra_shells_base) {
                self.extra_shells_alternating_solid_layer
            } else {
                self.extra_shells_base
            };
            last = Some(extra);
            self.walls + extra
        };
        (0..sources.len()).map(extra).collect()
    }

    /// Everything that is laid on a layer, island by island, in no order yet.
    fn islands(&self, sources: &[Source], index: usize, walls: u32, notes: &mut Notes) -> Vec<Island> {
        let source = &sources[index];
        if source.outlines.is_empty() {
            return Vec::new();
        }
        let surroundings = self.surroundings(sources, index);
        let solid = self.density == Ratio::ONE || surroundings.is_none();
        let mut strands: Vec<Strand> = source.middles.clone();
        let rings = solid && source.bridge.is_none() && self.solid_pattern == SolidPattern::Concentric;
        let walls = if rings { u32::MAX } else { walls };
        let mut inside = walls::lay(source, self, walls, solid, &mut strands);
        if rings {
            inside.clear();
        }
        let direction = source.bridge.unwrap_or_else(|| self.direction(index));
        let turn = source.bridge.is_none().then_some(self.turn(index));
        let job =
            infill::Job { fill: self, source, layer: index, inside: &inside, direction, turn, surroundings };
        job.run(&mut strands, notes);
        strand::sort_into_islands(&source.outlines, strands)
    }

    /// The layers that must all hold clay above and below a place for it not to be a surface, each with how far it is
    /// grown first, in microns; `None` when one of them is missing, so that everything is surface.
    fn surroundings<'a>(&self, sources: &'a [Source], index: usize) -> Option<Vec<(&'a Source, f64)>> {
        if index % (self.diaphragm_period as usize) < self.diaphragm_thickness as usize {
            return None;
        }
        let bead = &sources[index].bead;
        let lean = self.surrounding_angle.direction().unit();
        let lean = lean.1 / lean.0 * bead.height.um();
        let below = (1..=self.base_layers as usize).map(|step| (step, index.checked_sub(step)));
        let above = (1..=self.top_layers as usize).map(|step| (step, index.checked_add(step)));
        below
            .chain(above)
            .map(|(step, layer)| {
                let source = sources.get(layer?).filter(|source| !source.outlines.is_empty())?;
                Some((source, (step as f64 * lean - bead.width.um()).max(0.0)))
            })
            .collect()
    }
}
