//! What of the bed a shape covers.

use super::frame::Frame;
use super::outline::{Trouble, Way};
use super::stroke;
use super::tangle::is_tangled;
use crate::number::nearest;
use shape::plane::boolean::{even_odd, nonzero, positive};
use shape::{Point, Ring};
use skein::Micron;

/// The region inside outlines: counter-clockwise around clay, clockwise around holes.
pub(super) fn filled(ways: &[Way], by_even_odd: bool, frame: &Frame) -> Result<Vec<Ring>, Trouble> {
    let rings: Vec<Ring> = ways.iter().map(|way| placed(way, frame).map(Ring)).collect::<Result<_, _>>()?;
    let rings: Vec<Ring> = rings.into_iter().filter(|ring| ring.0.len() > 2).collect();
    if is_tangled(rings.iter()) {
        return Err(Trouble::Tangled);
    }
    Ok(if by_even_odd { even_odd(&rings) } else { nonzero(&rings) })
}

/// The region that lines of a width cover.
pub(super) fn stroked(ways: &[Way], width: f64, frame: &Frame) -> Result<Vec<Ring>, Trouble> {
    let half = width * frame.mean_growth() / 2.0;
    if half.is_nan() || half > f64::from(Micron::LIMIT) / 4.0 {
        return Err(Trouble::TooFar);
    }
    let mut bands = Vec::new();
    for way in ways.iter().filter(|_| half > 0.0) {
        bands.extend(stroke::pieces(&placed(way, frame)?, way.closed, half));
    }
    let is_near =
        |point: &Point| point.x.unsigned_abs().max(point.y.unsigned_abs()) <= Micron::LIMIT.unsigned_abs();
    if !bands.iter().flat_map(|ring| &ring.0).all(is_near) {
        return Err(Trouble::TooFar);
    }
    if is_tangled(bands.iter()) {
        return Err(Trouble::Tangled);
    }
    Ok(positive(&bands))
}

fn placed(way: &Way, frame: &Frame) -> Result<Vec<Point>, Trouble> {
    let place = |&(x, y): &(f64, f64)| {
        let (x, y) = frame.at(x, y);
        Some(Point::new(nearest(x)?, nearest(y)?))
    };
    way.points.iter().map(place).collect::<Option<_>>().ok_or(Trouble::TooFar)
}
