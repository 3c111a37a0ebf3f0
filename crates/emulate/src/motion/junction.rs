//! How fast a machine goes round the corner between two moves.

use super::least;
use super::moves::{Move, dot};

/// Beyond this cosine two directions are opposite: a full stop. GRBL uses the same.
const REVERSAL: f64 = 0.999_999;
/// Marlin looks for small moves below this length, mm, ...
const MARLIN_SHORT: f64 = 1.0;
/// ... and for turns of less than 45 degrees, by a hair, so that one of 45 degrees is none.
#[expect(clippy::approx_constant, reason = "Marlin has no more digits, and they decide")]
const MARLIN_GENTLE: f64 = -0.707_106_781_2;
/// Marlin takes no gentle turn for less than this, rad.
const MARLIN_LEAST_ANGLE: f64 = 0.033;

/// The rule for the speed at a corner.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum JunctionModel {
    /// The junction deviation of GRBL: the circle that touches both moves and passes the corner at that distance.
    #[default]
    Grbl,
    /// As GRBL, and the circle must also touch within the halves of both moves (Klipper since 2024).
    Klipper,
    /// As GRBL, and small moves in a gentle turn are taken for the chords of an arc (Marlin).
    MarlinSmall,
    /// As GRBL, but turns of less than 18 degrees cost nothing and of more than 162 a full stop (pyGCodeDecode).
    PyGCodeDecode,
    /// No axis, of X, Y, Z and E, may jump by more than this, mm/s (Marlin without junction deviation, Prusa).
    ClassicJerk([f64; 4]),
    /// A full stop at every corner.
    FullStop,
    /// Corners cost nothing.
    None,
}

impl JunctionModel {
    /// The square of the highest speed from one move to the next, mm²/s²; infinite where there is no limit. The speeds
    /// of the two moves are not looked at, except by [`ClassicJerk`](Self::ClassicJerk).
    #[inline]
    pub fn speed_squared(self, before: &Move, after: &Move) -> f64 {
        if !before.is_path() || !after.is_path() {
            return 0.0;
        }
        match self {
            Self::None => return f64::INFINITY,
            Self::FullStop => return 0.0,
            Self::ClassicJerk(jerk) => return classic(before, after, jerk),
            _ => {}
        }
        let acceleration = least(before.acceleration, after.acceleration);
        if acceleration == f64::INFINITY {
            return f64::INFINITY;
        }
        let mut corner = Corner::between(before.tangent_out, after.tangent_in);
        if self == Self::MarlinSmall {
            // Marlin knows no way straighter than this.
            corner = Corner::of_cos(corner.cos.max(-REVERSAL));
        }
        let around = corner.speed_squared(acceleration, after.junction_deviation);
        match self {
            Self::PyGCodeDecode => corner.of_py_gcode_decode(around),
            _ if corner.cos > REVERSAL => 0.0,
            Self::Klipper => {
                let half = 0.5 * corner.sin_half / corner.cos_half();
                let limit = |step: &Move| step.length * step.acceleration * half;
                // 0/0 of a reversal that is just none is no limit either.
                around.min(limit(before)).min(limit(after))
            }
            Self::MarlinSmall if after.length < MARLIN_SHORT && corner.cos < MARLIN_GENTLE => {
                let turn = libm::acos(-corner.cos);
                around.min(after.length * acceleration / turn.max(MARLIN_LEAST_ANGLE))
            }
            _ => around,
        }
    }

    /// The square of the speed with which a run may begin or end with a move.
    pub(crate) fn rest_squared(self, step: &Move) -> f64 {
        match self {
            Self::ClassicJerk(jerk) if step.is_path() => {
                let [x, y, z] = step.tangent_in;
                let axes = [x, y, z, step.extruder];
                let safe = (0..4).map(|axis| jerk[axis] / axes[axis].abs()).fold(f64::INFINITY, f64::min);
                let speed = safe.min(step.target);
                speed * speed
            }
            _ => 0.0,
        }
    }
}

/// A corner: theta is the angle between the way back and the way on, so that straight on is pi.
#[derive(Clone, Copy)]
struct Corner {
    cos: f64,
    sin_half: f64,
}

impl Corner {
    #[inline]
    fn between(before: [f64; 3], after: [f64; 3]) -> Self {
        Self::of_cos((-dot(before, after)).clamp(-1.0, 1.0))
    }

    #[inline]
    fn of_cos(cos: f64) -> Self {
        Self { cos, sin_half: (0.5 * (1.0 - cos)).sqrt() }
    }

    #[inline]
    fn cos_half(self) -> f64 {
        (0.5 * (1.0 + self.cos)).sqrt()
    }

    /// v² = a·r of the circle with r = jd·s/(1 − s), as in GRBL's planner; 1 − s is taken as cos²(theta/2)/(1 + s),
    /// which keeps its digits when the corner is nearly straight.
    #[inline]
    fn speed_squared(self, acceleration: f64, deviation: f64) -> f64 {
        let rest = 0.5 * (1.0 + self.cos) / (1.0 + self.sin_half);
        if rest <= 0.0 { f64::INFINITY } else { acceleration * deviation * self.sin_half / rest }
    }

    fn of_py_gcode_decode(self, around: f64) -> f64 {
        // The sines of half of 162 and of half of 18 degrees.
        const STRAIGHT: f64 = 0.987_688_340_595_137_8;
        const BACK: f64 = 0.156_434_465_040_230_87;
        if self.sin_half >= STRAIGHT {
            f64::INFINITY
        } else if self.sin_half <= BACK {
            0.0
        } else {
            around
        }
    }
}

/// The common speed is lowered until no axis jumps by more than its jerk. An axis that turns back counts with its
/// larger speed and not with the sum, as Prusa's firmware does.
fn classic(before: &Move, after: &Move, jerk: [f64; 4]) -> f64 {
    let speed = before.target.min(after.target);
    let mut factor: f64 = 1.0;
    for (axis, &most) in jerk.iter().enumerate() {
        let of = |tangent: [f64; 3], extruder: f64| speed * tangent.get(axis).copied().unwrap_or(extruder);
        let old = of(before.tangent_out, before.extruder);
        let new = of(after.tangent_in, after.extruder);
        let jump = if old * new < 0.0 { old.abs().max(new.abs()) } else { (new - old).abs() };
        if jump > most {
            factor = factor.min(most / jump);
        }
    }
    (speed * factor) * (speed * factor)
}
