//! Arcs: G2 and G3 with one meaning for all stages. The end is absolute like that of any move; I and J count from the
//! start. (In the seed the end of an arc was absolute for one stage and relative for the next: stages.md D2.)

use crate::Move;
use shape::Point3;
use unit::Micron;

/// A move along a piece of a circle, level or rising evenly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arc {
    /// Where it ends, how fast it is, and what it pushes out.
    pub step: Move,
    /// Where its centre is.
    pub center: Center,
    /// Clockwise is G2, counter-clockwise G3.
    pub clockwise: bool,
}

/// How an arc says where its centre is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Center {
    /// I and J: from the start of the arc to its centre.
    Offset {
        /// Along x.
        i: Micron,
        /// Along y.
        j: Micron,
    },
    /// R: the radius; the arc is the shorter of the two, or with a negative R the longer.
    Radius(Micron),
}

impl Arc {
    /// The centre in microns, for an arc that starts at `from`.
    ///
    /// A radius shorter than half the chord is taken as half the chord, as firmware does.
    pub fn center_from(&self, from: Point3) -> (f64, f64) {
        let (x, y) = (f64::from(from.x), f64::from(from.y));
        match self.center {
            Center::Offset { i, j } => (x + i.um(), y + j.um()),
            Center::Radius(radius) => {
                let (dx, dy) = (f64::from(self.step.to.x) - x, f64::from(self.step.to.y) - y);
                let chord = (dx * dx + dy * dy).sqrt();
                if chord == 0.0 {
                    return (x, y);
                }
                let height = (radius.um() * radius.um() - chord * chord / 4.0).max(0.0).sqrt();
                // The centre of the shorter counter-clockwise arc lies to the left of its chord.
                let side = if self.clockwise == (radius.0 < 0) { height } else { -height };
                (x + dx / 2.0 - dy / chord * side, y + dy / 2.0 + dx / chord * side)
            }
        }
    }

    /// The angle it turns through, in radians, always positive; a whole turn when it ends over its start.
    pub fn sweep(&self, from: Point3) -> f64 {
        use std::f64::consts::TAU;
        let (x, y) = self.center_from(from);
        if matches!(self.center, Center::Radius(_)) && (from.x, from.y) == (self.step.to.x, self.step.to.y) {
            return 0.0;
        }
        let angle = |at: Point3| libm::atan2(f64::from(at.y) - y, f64::from(at.x) - x);
        let turn = angle(self.step.to) - angle(from);
        let turn = if self.clockwise { -turn } else { turn }.rem_euclid(TAU);
        if turn < 1e-9 { TAU } else { turn }
    }

    /// Points along it, the end included, so close that no chord leaves the arc by more than `tolerance` microns.
    pub fn chords(&self, from: Point3, tolerance: f64) -> Vec<Point3> {
        let (x, y) = self.center_from(from);
        let radius = libm::hypot(f64::from(from.x) - x, f64::from(from.y) - y);
        let sweep = self.sweep(from);
        let step = 2.0 * libm::acos(1.0 - (tolerance / radius.max(tolerance)).min(1.0));
        let count = (sweep / step).ceil().clamp(1.0, 100_000.0) as i32;
        let begin = libm::atan2(f64::from(from.y) - y, f64::from(from.x) - x);
        let sign = if self.clockwise { -1.0 } else { 1.0 };
        let rise = f64::from(self.step.to.z) - f64::from(from.z);
        let at = |index: i32| {
            let share = f64::from(index) / f64::from(count);
            let angle = begin + sign * sweep * share;
            Point3 {
                x: (x + radius * libm::cos(angle)).round() as i32,
                y: (y + radius * libm::sin(angle)).round() as i32,
                z: (f64::from(from.z) + rise * share).round() as i32,
            }
        };
        (1..count).map(at).chain([self.step.to]).collect()
    }

    /// Its length in microns from where it starts, the way up included.
    pub fn length(&self, from: Point3) -> f64 {
        let (x, y) = self.center_from(from);
        let radius = libm::hypot(f64::from(from.x) - x, f64::from(from.y) - y);
        let rise = f64::from(self.step.to.z) - f64::from(from.z);
        libm::hypot(radius * self.sweep(from), rise)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn arc(to: (i32, i32), center: Center, clockwise: bool) -> Arc {
        Arc { step: Move::to(Point3 { x: to.0, y: to.1, z: 0 }), center, clockwise }
    }

    const FROM: Point3 = Point3 { x: 10_000, y: 0, z: 0 };

    #[test]
    fn a_quarter_one_way_is_three_quarters_the_other_way() {
        let center = Center::Offset { i: Micron(-10_000), j: Micron(0) };
        assert!((arc((0, 10_000), center, false).length(FROM) - 5_000.0 * PI).abs() < 1e-6);
        assert!((arc((0, 10_000), center, true).length(FROM) - 15_000.0 * PI).abs() < 1e-6);
        assert!((arc((10_000, 0), center, true).length(FROM) - 20_000.0 * PI).abs() < 1e-6);
    }

    #[test]
    fn a_radius_means_the_shorter_arc_and_a_negative_one_the_longer() {
        for (clockwise, radius, quarters) in
            [(false, 10_000, 1.0), (false, -10_000, 3.0), (true, 10_000, 1.0), (true, -10_000, 3.0)]
        {
            let length = arc((0, 10_000), Center::Radius(Micron(radius)), clockwise).length(FROM);
            assert!((length - quarters * 5_000.0 * PI).abs() < 1e-3, "{clockwise} {radius}: {length}");
        }
    }
}
