//! Solid geometry: what a part is before it is sliced.

mod mesh;
mod topology;
mod measure;

pub use mesh::{Bounds, Edge, Face, Point3, TriangleMesh};
