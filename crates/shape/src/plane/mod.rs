//! Plane geometry.

mod point;
mod ring;

pub use point::{Point, cross};
pub use ring::Ring;
