//! How long an arc is.

use std::f64::consts::TAU;

use gcode::Words;

use crate::motion::Turn;

/// An arc that ends this near to its start is a full circle, rad.
const FULL: f64 = 1e-9;

/// The length in XY of a `G2` or `G3` by `(x, y)`, with its centre at I and J from the start, or with radius R. What
/// names neither is a straight line.
pub(crate) fn arc_length((x, y): (f64, f64), words: &Words, scale: f64, turn: Turn) -> f64 {
    let chord = (x * x + y * y).sqrt();
    if words.has_any(b"IJ") {
        let i = words.get(b'I').unwrap_or(0.0) * scale;
        let j = words.get(b'J').unwrap_or(0.0) * scale;
        let radius = (i * i + j * j).sqrt();
        // From the centre, the start lies at (-i, -j) and the end at (x - i, y - j).
        let (end_x, end_y) = (x - i, y - j);
        let counter = (j * end_x - i * end_y).atan2(-i * end_x - j * end_y);
        let angle = if turn == Turn::Counter { counter } else { -counter };
        let angle = if angle <= FULL { angle + TAU } else { angle };
        // A centre at the start makes no arc.
        return if radius > 0.0 { radius * angle } else { chord };
    }
    match words.get(b'R') {
        Some(radius) if radius != 0.0 && chord > 0.0 => {
            let radius = radius * scale;
            // Rounding may leave the ends a little farther apart than the circle is wide.
            let short = 2.0 * (chord / (2.0 * radius.abs())).min(1.0).asin();
            // A negative radius asks for the long way round.
            let angle = if radius < 0.0 { TAU - short } else { short };
            (radius.abs() * angle).max(chord)
        }
        _ => chord,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn length(text: &str, by: (f64, f64), turn: Turn) -> f64 {
        arc_length(by, &gcode::Line::of(text.as_bytes()).words, 1.0, turn)
    }

    #[track_caller]
    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
    }

    #[test]
    fn arcs_are_as_long_as_they_are() {
        near(length("G3 I-10", (-10.0, 10.0), Turn::Counter), PI * 5.0);
        near(length("G2 I-10", (-10.0, 10.0), Turn::Clockwise), PI * 15.0);
        near(length("G2 I-10", (0.0, 0.0), Turn::Clockwise), PI * 20.0);
        near(length("G3 I-10", (0.0, 0.0), Turn::Counter), PI * 20.0);
        near(length("G2 R10", (10.0, 10.0), Turn::Clockwise), PI * 5.0);
        near(length("G2 R-10", (10.0, 10.0), Turn::Clockwise), PI * 15.0);
        near(length("G2 R5", (6.0, 8.0), Turn::Clockwise), PI * 5.0);
        near(length("G2", (3.0, 4.0), Turn::Clockwise), 5.0);
        near(length("G2 I0 J0", (3.0, 4.0), Turn::Clockwise), 5.0);
    }
}
