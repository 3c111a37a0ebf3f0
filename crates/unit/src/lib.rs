//! Quantities as integers of the decimal in which they are printed.
//!
//! A document never holds a float: what is stored is what is written, so reading undoes writing.
//! Floats enter through one door per quantity (`from_mm` and its kin), which has one rounding rule and
//! refuses NaN and the absurd. Sines and roots belong to [`angle`]; polygons belong to the crate `shape`.

mod angle;
pub mod decimal;
mod quantity;

pub use angle::{Angle, Direction};
pub use quantity::{Celsius, Extrusion, Feed, Micron, NotANumber, Ratio};

/// The door from floats to integers: the nearest integer, halves away from zero, or `None` for NaN and for
/// anything beyond ±`limit`.
pub fn round_within(value: f64, limit: f64) -> Option<i64> {
    if value.is_nan() || value.abs() >= limit + 0.5 {
        return None;
    }
    // `f64::round` is a call into a library on plain x86-64; a cast is one instruction.
    let whole = value as i64;
    let rest = value - whole as f64;
    Some(whole + i64::from(rest >= 0.5) - i64::from(rest <= -0.5))
}
