//! Plane geometry.

pub mod boolean;
mod curves;
mod offset;
mod point;
mod ring;
mod simplify;

pub use offset::{crossing, offset, outside, united};
pub use point::{Point, cross};
pub use ring::Ring;
pub use simplify::simplified;

#[cfg(test)]
mod tests;
