//! Geometry in whole microns.
//!
//! [`solid`] holds what a part is: a triangle mesh and its cross-sections. [`plane`] holds what a layer is: rings,
//! regions, offsets, booleans, hatching, the middle of thin walls. Coordinates are `i32` microns within
//! ±1 km, which is `unit::Micron::LIMIT`; sums and products are taken in `i64` or in floats and rounded once, at the end.

pub mod plane;
pub mod solid;

pub use plane::{Point, Ring};
pub use solid::{Bounds, Edge, Face, Flaws, Point3, TriangleMesh};
