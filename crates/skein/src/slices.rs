use crate::{Facts, Signature};
use shape::{Bounds, Ring};
use unit::{Direction, Micron};

/// A part cut into layers: the loops of each layer. Its text is an SVG drawing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Slices {
    /// What later stages must know.
    pub facts: Facts,
    /// The box around the part.
    pub bounds: Bounds,
    /// The stages that have been here, with their settings.
    pub done: Vec<Signature>,
    /// The layers from the bottom up.
    pub layers: Vec<RotatedLoopLayer>,
}

/// The loops of one layer, and the direction in which it bridges a gap, if it does.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RotatedLoopLayer {
    /// The nominal height: the middle of the layer.
    pub z: Micron,
    /// The height of the layer, where it is not the one of the facts.
    pub thickness: Option<Micron>,
    /// The direction of the bridge.
    pub rotation: Option<Direction>,
    /// Counter-clockwise around clay, clockwise around holes; larger first.
    pub loops: Vec<Ring>,
}
