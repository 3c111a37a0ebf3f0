//! Arcs and helices as they are, without chords.

use gcode::{Centre, Plane, Turn};
use std::f64::consts::TAU;

/// An end this near to the start, in angle, makes a full turn, rad; GRBL uses the same.
const FULL: f64 = 5e-7;
/// The ends of an arc may differ from its circle by this much, mm, ...
const SLACK: f64 = 0.005;
/// ... or by this part of the radius, ...
const SLACK_PART: f64 = 0.001;
/// ... but never by this much, mm. GRBL and LinuxCNC have the same limits.
const MOST_SLACK: f64 = 0.5;

/// A circular or helical way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// The plane it turns in.
    pub plane: Plane,
    /// The centre, along the axes of the plane, mm.
    pub centre: [f64; 2],
    /// The radius at its start, mm.
    pub radius: f64,
    /// The radius at its end, mm: the same but for what the file rounded.
    pub end_radius: f64,
    /// The angle at which it starts, rad.
    pub start: f64,
    /// The angle it sweeps, rad; negative is clockwise.
    pub sweep: f64,
    /// Where it starts along the third axis, mm.
    pub height: f64,
    /// How far it goes along the third axis, mm.
    pub rise: f64,
}

/// What is wrong with an arc, or merely odd.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ArcFault {
    /// The centre is the start.
    NoRadius,
    /// The radius goes round to the start, and could be any circle.
    ClosedByRadius,
    /// The end is not on the circle, by so many mm.
    OffCircle(f64),
    /// The ends are farther apart than the circle is wide, by so many mm.
    TooShort(f64),
}

/// X, Y, Z as first and second axis of the plane and the axis across.
const fn axes(plane: Plane) -> [usize; 3] {
    match plane {
        Plane::Xy => [0, 1, 2],
        Plane::Zx => [2, 0, 1],
        Plane::Yz => [1, 2, 0],
    }
}

impl Arc {
    /// The arc between two points. `around` is what the line says, mm, with an absolute centre already in the
    /// coordinates of the points.
    ///
    /// The second value is what is odd about it, though it can be followed: the end lies off the circle by more than
    /// rounding. What is off is spread over the arc.
    ///
    /// # Errors
    /// When there is no such arc.
    pub fn new(
        from: [f64; 3],
        to: [f64; 3],
        around: [f64; 2],
        turn: Turn,
    ) -> Result<(Self, Option<ArcFault>), ArcFault> {
        let [first, second, across] = axes(turn.plane);
        let start = [from[first], from[second]];
        let end = [to[first], to[second]];
        let mut odd = None;
        let centre = match turn.centre {
            Centre::Offset => [start[0] + around[0], start[1] + around[1]],
            Centre::Absolute => around,
            Centre::Radius => {
                let (centre, excess) = by_radius(start, end, around[0], turn.clockwise)?;
                if excess > 0.0 {
                    let fault = ArcFault::TooShort(excess);
                    if excess > SLACK.max(SLACK_PART * around[0].abs()) {
                        return Err(fault);
                    }
                    odd = Some(fault);
                }
                centre
            }
        };
        let a = [start[0] - centre[0], start[1] - centre[1]];
        let b = [end[0] - centre[0], end[1] - centre[1]];
        let (radius, end_radius) = (libm::hypot(a[0], a[1]), libm::hypot(b[0], b[1]));
        if radius <= 0.0 || end_radius <= 0.0 {
            return Err(ArcFault::NoRadius);
        }
        let off = (end_radius - radius).abs();
        if turn.centre != Centre::Radius && off > SLACK && (off > MOST_SLACK || off > SLACK_PART * radius) {
            odd = Some(ArcFault::OffCircle(off));
        }
        let between = libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
        let more = TAU * f64::from(turn.more);
        let sweep = match turn.clockwise {
            false => more + if between <= FULL { between + TAU } else { between },
            true => -more + if between >= -FULL { between - TAU } else { between },
        };
        let arc = Self {
            plane: turn.plane,
            centre,
            radius,
            end_radius,
            start: libm::atan2(a[1], a[0]),
            sweep,
            height: from[across],
            rise: to[across] - from[across],
        };
        Ok((arc, odd))
    }

    /// Its length, mm: √((r·α)² + dz²).
    pub fn length(&self) -> f64 {
        libm::hypot(self.flat_length(), self.rise)
    }

    fn flat_length(&self) -> f64 {
        0.5 * (self.radius + self.end_radius) * self.sweep.abs()
    }

    /// The unit tangent after this part of the way, 0..1.
    pub fn tangent(&self, part: f64) -> [f64; 3] {
        let length = self.length();
        let flat = self.flat_length() / length * self.sweep.signum();
        let (sin, cos) = libm::sincos(self.start + self.sweep * part);
        self.placed([-sin * flat, cos * flat, self.rise / length])
    }

    /// The point after this part of the way, 0..1.
    pub fn point(&self, part: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(self.start + self.sweep * part);
        let radius = self.radius + (self.end_radius - self.radius) * part;
        self.placed([
            self.centre[0] + radius * cos,
            self.centre[1] + radius * sin,
            self.height + self.rise * part,
        ])
    }

    /// The highest speed at which the way round the curve needs no more than this acceleration, mm/s: √(a·r)/k, k being
    /// the share of the speed in the plane.
    pub fn speed_limit(&self, acceleration: f64) -> f64 {
        let flat = self.flat_length() / self.length();
        (acceleration * self.radius.min(self.end_radius)).sqrt() / flat
    }

    /// So many chords leave the arc by no more than `tolerance`, mm.
    pub fn chords(&self, tolerance: f64) -> usize {
        let radius = self.radius.max(self.end_radius);
        let step = 2.0 * libm::acos((1.0 - tolerance.max(1e-6) / radius).clamp(-1.0, 1.0));
        // A cast of a float to an integer holds at the ends of its range.
        ((self.sweep.abs() / step).ceil() as usize).clamp(1, 1 << 20)
    }

    /// The points in which the arc reaches its bounds within: where it goes along an axis of its plane.
    pub fn extremes(&self) -> impl Iterator<Item = [f64; 3]> {
        let quarter = std::f64::consts::FRAC_PI_2;
        let (low, high) = if self.sweep < 0.0 {
            (self.start + self.sweep, self.start)
        } else {
            (self.start, self.start + self.sweep)
        };
        let first = (low / quarter).ceil() as i64;
        // After one turn they repeat; the ends are known anyway.
        let last = ((high / quarter).floor() as i64).min(first.saturating_add(3));
        (first..=last).map(move |index| self.point((index as f64 * quarter - self.start) / self.sweep))
    }

    /// First, second and third axis of the plane as X, Y, Z.
    fn placed(&self, [first, second, across]: [f64; 3]) -> [f64; 3] {
        let mut point = [0.0; 3];
        for (axis, value) in axes(self.plane).into_iter().zip([first, second, across]) {
            point[axis] = value;
        }
        point
    }
}

/// The centre of a circle of this radius through two points, and by how much they are too far apart for it, mm.
fn by_radius(
    start: [f64; 2],
    end: [f64; 2],
    radius: f64,
    clockwise: bool,
) -> Result<([f64; 2], f64), ArcFault> {
    let by = [end[0] - start[0], end[1] - start[1]];
    let chord = libm::hypot(by[0], by[1]);
    if radius == 0.0 {
        return Err(ArcFault::NoRadius);
    }
    if chord <= 0.0 {
        return Err(ArcFault::ClosedByRadius);
    }
    let half = chord / 2.0;
    let height = (radius * radius - half * half).max(0.0).sqrt();
    // Left of the way for a short arc that turns left.
    let side = if clockwise == (radius > 0.0) { -1.0 } else { 1.0 };
    let centre = [
        start[0] + by[0] / 2.0 - side * height * by[1] / chord,
        start[1] + by[1] / 2.0 + side * height * by[0] / chord,
    ];
    Ok((centre, (half - radius.abs()).max(0.0)))
}
