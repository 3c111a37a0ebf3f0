//! Plane geometry.

pub mod boolean;
mod boxes;
pub mod clip;
mod curves;
pub mod hatch;
mod islands;
mod middle;
mod offset;
mod point;
mod ring;
mod simplify;
mod tree;
mod vector;

pub use boxes::{Bounds, Boxes, gap2};
pub use curves::Offset;
pub use islands::islands;
pub use middle::{MiddleLine, dab, thin_parts};
pub use offset::{crossing, facing, offset, offset_with_loss, outside, united};
pub use point::{Point, cross};
pub use ring::Ring;
pub use simplify::{all_simplified, simplified};

#[cfg(test)]
mod tests;
