//! Solid geometry: what a part is before it is sliced.

mod measure;
mod mesh;
mod section;
mod topology;

pub use mesh::{Bounds, Edge, Face, Flaws, Point3, TriangleMesh};
pub use section::{Chain, Sections, planes_over_undersides};
