//! Arcs: how long they are and where they go.

use std::f64::consts::TAU;

use gcode::Words;

use crate::motion::Turn;

/// An arc that ends this near to its start is a full circle, rad.
const FULL: f64 = 1e-9;

/// A part of a circle in XY, as seen from its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arc {
    /// The centre, mm.
    centre: (f64, f64),
    /// The angle that it goes round, counter-clockwise positive, rad.
    pub(crate) sweep: f64,
    /// The length, mm.
    pub(crate) length: f64,
}

impl Arc {
    /// The `G2` or `G3` by `by`, with its centre at I and J from the start, or with radius R. Nothing if it names
    /// neither or makes no arc; then it is a straight line.
    pub(crate) fn of(by: (f64, f64), words: &Words, scale: f64, turn: Turn) -> Option<Self> {
        if words.has_any(b"IJ") {
            let [i, j] = [b'I', b'J'].map(|letter| words.get(letter).unwrap_or(0.0) * scale);
            Self::around((i, j), by, turn)
        } else {
            Self::of_radius(words.get(b'R')? * scale, by, turn)
        }
    }

    fn around((i, j): (f64, f64), (x, y): (f64, f64), turn: Turn) -> Option<Self> {
        let radius = (i * i + j * j).sqrt();
        // From the centre, the start lies at (-i, -j) and the end at (x - i, y - j).
        let (end_x, end_y) = (x - i, y - j);
        let counter = (j * end_x - i * end_y).atan2(-i * end_x - j * end_y);
        let angle = if turn == Turn::Counter { counter } else { -counter };
        let angle = if angle <= FULL { angle + TAU } else { angle };
        let length = radius * angle;
        // A centre at the start makes no arc.
        (radius > 0.0).then_some(Self { centre: (i, j), sweep: turn.sign() * angle, length })
    }

    fn of_radius(signed: f64, (x, y): (f64, f64), turn: Turn) -> Option<Self> {
        let (radius, chord) = (signed.abs(), (x * x + y * y).sqrt());
        if radius == 0.0 || chord == 0.0 {
            return None;
        }
        // Rounding may leave the ends a little farther apart than the circle is wide.
        let half = (chord / (2.0 * radius)).min(1.0);
        let short = 2.0 * half.asin();
        // A negative radius asks for the long way round.
        let angle = if signed < 0.0 { TAU - short } else { short };
        // Counter-clockwise the short way, the centre is on the left.
        let side = turn.sign() * signed.signum() * radius * (1.0 - half * half).sqrt() / chord;
        let centre = (x / 2.0 - y * side, y / 2.0 + x * side);
        let length = (radius * angle).max(chord);
        Some(Self { centre, sweep: turn.sign() * angle, length })
    }

    /// Points on it from `start`, the last one being its end `by` away: chords of at most 5°, so that what lies
    /// between them and the arc is less than a thousandth of the radius.
    pub(crate) fn points(self, start: (f64, f64), by: (f64, f64)) -> impl Iterator<Item = (f64, f64)> {
        const CHORD: f64 = TAU / 72.0;
        let chords = (self.sweep.abs() / CHORD).ceil().clamp(1.0, 72.0) as u32;
        let (i, j) = self.centre;
        (1..=chords).map(move |chord| {
            if chord == chords {
                return (start.0 + by.0, start.1 + by.1);
            }
            let (sin, cos) = (self.sweep * f64::from(chord) / f64::from(chords)).sin_cos();
            (start.0 + i - i * cos + j * sin, start.1 + j - i * sin - j * cos)
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn length(text: &str, by: (f64, f64), turn: Turn) -> f64 {
        let arc = Arc::of(by, &gcode::Line::of(text.as_bytes()).words, 1.0, turn);
        arc.map_or(by.0.hypot(by.1), |arc| arc.length)
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

    #[test]
    fn points_lie_on_the_circle_whichever_way_it_is_named() {
        for (text, turn) in [
            ("G3 I-10", Turn::Counter),
            ("G2 I-10", Turn::Clockwise),
            ("G3 R10", Turn::Counter),
            ("G2 R-10", Turn::Clockwise),
        ] {
            let by = (-10.0, 10.0);
            let arc = Arc::of(by, &gcode::Line::of(text.as_bytes()).words, 1.0, turn).expect("an arc");
            let points: Vec<(f64, f64)> = arc.points((15.0, 5.0), by).collect();
            // The centre is (5, 5).
            points.iter().for_each(|(x, y)| near((x - 5.0).hypot(y - 5.0), 10.0));
            assert_eq!(points.last(), Some(&(5.0, 15.0)), "{text}");
            let along: f64 =
                points.windows(2).map(|two| (two[1].0 - two[0].0).hypot(two[1].1 - two[0].1)).sum();
            assert!((along / arc.length - 1.0).abs() < 0.06, "{text}: {along} of {}", arc.length);
        }
    }
}
