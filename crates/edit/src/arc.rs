//! The geometry of `G2` and `G3`.

use std::f64::consts::{FRAC_PI_2, TAU};

use gcode::Words;

/// An arc that ends this near to its start is a full circle, rad.
const FULL: f64 = 1e-9;

/// The plane in which arcs turn, by `G17`, `G18` or `G19`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Plane {
    /// `G17`.
    #[default]
    Xy,
    /// `G18`.
    Zx,
    /// `G19`.
    Yz,
}

impl Plane {
    /// The two axes of the plane, so that an arc against the clock turns from the first to the second.
    pub(crate) fn axes(self) -> [usize; 2] {
        match self {
            Self::Xy => [0, 1],
            Self::Zx => [2, 0],
            Self::Yz => [1, 2],
        }
    }
}

/// A part of a circle, with what the rest of the axes do along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arc {
    pub(crate) plane: Plane,
    centre: [f64; 2],
    radius: f64,
    start: f64,
    /// Positive against the clock, rad.
    sweep: f64,
}

impl Arc {
    /// The arc that `words` describe, lengths times `scale`; nothing if they describe none, as without I, J, K and R.
    pub(crate) fn new(
        plane: Plane,
        from: [f64; 3],
        to: [f64; 3],
        words: &Words,
        scale: f64,
        counter: bool,
    ) -> Option<Self> {
        let [a, b] = plane.axes();
        let (start, end) = ([from[a], from[b]], [to[a], to[b]]);
        let centre = match (offset(words, a), offset(words, b)) {
            (None, None) => centre_by_radius(start, end, words.get(b'R')? * scale, counter)?,
            (first, second) => {
                [start[0] + first.unwrap_or(0.0) * scale, start[1] + second.unwrap_or(0.0) * scale]
            }
        };
        let from_centre = |point: [f64; 2]| (point[1] - centre[1]).atan2(point[0] - centre[0]);
        let radius = (start[0] - centre[0]).hypot(start[1] - centre[1]);
        let (first, last) = (from_centre(start), from_centre(end));
        let angle = if counter { last - first } else { first - last }.rem_euclid(TAU);
        let angle = if angle <= FULL || angle >= TAU - FULL { TAU } else { angle };
        (radius > 0.0).then_some(Self {
            plane,
            centre,
            radius,
            start: first,
            sweep: if counter { angle } else { -angle },
        })
    }

    /// The length in the plane, mm.
    pub(crate) fn length(&self) -> f64 {
        self.radius * self.sweep.abs()
    }

    /// The place in the plane after `share` of the way.
    pub(crate) fn at(&self, share: f64) -> [f64; 2] {
        let angle = self.start + self.sweep * share;
        [self.centre[0] + self.radius * angle.cos(), self.centre[1] + self.radius * angle.sin()]
    }

    /// Into how many chords it is cut so that none is farther than `error` from it.
    pub(crate) fn chords(&self, error: f64) -> usize {
        let angle = 2.0 * (1.0 - error / self.radius).clamp(-1.0, 1.0).acos();
        // The cast saturates; a circle of a kilometre has some ten thousand.
        (self.sweep.abs() / angle.max(1e-3)).ceil().max(1.0) as usize
    }

    /// Where it is farthest in the direction of an axis, on the way.
    pub(crate) fn extremes(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        (0..4).filter_map(|quarter| {
            let ahead = (f64::from(quarter) * FRAC_PI_2 - self.start) * self.sweep.signum();
            let share = ahead.rem_euclid(TAU) / self.sweep.abs();
            (share < 1.0).then(|| self.at(share))
        })
    }
}

fn offset(words: &Words, axis: usize) -> Option<f64> {
    words.get([b'I', b'J', b'K'].get(axis).copied()?)
}

/// The centre of the circle through both ends; a negative radius asks for the long way round.
fn centre_by_radius(start: [f64; 2], end: [f64; 2], radius: f64, counter: bool) -> Option<[f64; 2]> {
    let (x, y) = (end[0] - start[0], end[1] - start[1]);
    let chord = x.hypot(y);
    if radius == 0.0 || chord == 0.0 {
        return None;
    }
    // Rounding may leave the ends a little farther apart than the circle is wide.
    let height = (radius * radius - chord * chord / 4.0).max(0.0).sqrt();
    let side = if counter == (radius > 0.0) { height } else { -height } / chord;
    Some([f64::midpoint(start[0], end[0]) - y * side, f64::midpoint(start[1], end[1]) + x * side])
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn arc(text: &str, to: [f64; 3], counter: bool) -> Arc {
        let words = gcode::Line::of(text.as_bytes()).words;
        Arc::new(Plane::Xy, [0.0; 3], to, &words, 1.0, counter).expect("an arc")
    }

    #[track_caller]
    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
    }

    #[test]
    fn arcs_are_as_long_as_they_are() {
        near(arc("G3 I-10", [-10.0, 10.0, 0.0], true).length(), PI * 5.0);
        near(arc("G2 I-10", [-10.0, 10.0, 0.0], false).length(), PI * 15.0);
        near(arc("G2 I-10", [0.0; 3], false).length(), PI * 20.0);
        near(arc("G2 R10", [10.0, 10.0, 0.0], false).length(), PI * 5.0);
        near(arc("G2 R-10", [10.0, 10.0, 0.0], false).length(), PI * 15.0);
        near(arc("G3 R-10", [10.0, 10.0, 0.0], true).length(), PI * 15.0);
        near(arc("G2 R5", [6.0, 8.0, 0.0], false).length(), PI * 5.0);
    }

    #[test]
    fn an_arc_ends_where_it_was_told_to() {
        for (text, counter) in [("G2 R8", false), ("G3 R8", true), ("G2 R-8", false), ("G3 R-8", true)] {
            let [x, y] = arc(text, [6.0, 8.0, 0.0], counter).at(1.0);
            near(x, 6.0);
            near(y, 8.0);
        }
    }

    #[test]
    fn an_arc_reaches_beyond_its_ends() {
        let half = arc("G3 I-10", [-20.0, 0.0, 0.0], true);
        let top = half.extremes().map(|[_, y]| y).fold(f64::MIN, f64::max);
        near(top, 10.0);
        assert!(half.extremes().all(|[_, y]| y > -1e-9), "the lower half is not on the way");
    }
}
