//! Outlines of points, from lines, curves and arcs.

use std::f64::consts::{PI, TAU};

/// A line of points in units of the drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Way {
    pub(super) points: Vec<(f64, f64)>,
    pub(super) closed: bool,
}

/// Why an outline cannot be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trouble {
    /// It cannot be read.
    Damaged,
    /// It has no place within a kilometre.
    TooFar,
    /// Its curves have more points than a drawing may have.
    TooMany,
    /// It crosses itself more often than an outline may.
    Tangled,
}

/// Draws outlines whose chords keep within a tolerance of its curves.
pub(super) struct Pen {
    pub(super) ways: Vec<Way>,
    tolerance: f64,
    /// How many more points there may be.
    left: usize,
    here: (f64, f64),
}

/// More chords than a curve within a kilometre can ask for.
const MOST_CHORDS: f64 = 100_000.0;

impl Pen {
    pub(super) fn new(tolerance: f64, left: usize) -> Self {
        Self { ways: Vec::new(), tolerance, left, here: (0.0, 0.0) }
    }

    pub(super) fn here(&self) -> (f64, f64) {
        self.here
    }

    /// How many points were drawn.
    pub(super) fn points(&self) -> usize {
        self.ways.iter().map(|way| way.points.len()).sum()
    }

    pub(super) fn move_to(&mut self, to: (f64, f64)) -> Result<(), Trouble> {
        self.ways.push(Way::default());
        self.line_to(to)
    }

    pub(super) fn line_to(&mut self, to: (f64, f64)) -> Result<(), Trouble> {
        self.left = self.left.checked_sub(1).ok_or(Trouble::TooMany)?;
        // What is drawn behind `z` begins where the outline began.
        if self.ways.last().is_none_or(|way| way.closed) {
            self.ways.push(Way { points: vec![self.here], closed: false });
        }
        if let Some(way) = self.ways.last_mut() {
            way.points.push(to);
        }
        self.here = to;
        Ok(())
    }

    pub(super) fn close(&mut self) {
        if let Some(way) = self.ways.last_mut() {
            way.closed = true;
            self.here = way.points.first().copied().unwrap_or(self.here);
        }
    }

    /// A quadratic Bézier curve.
    pub(super) fn quadratic(&mut self, by: (f64, f64), to: (f64, f64)) -> Result<(), Trouble> {
        let from = self.here;
        let third =
            |end: (f64, f64)| (end.0 + (by.0 - end.0) * 2.0 / 3.0, end.1 + (by.1 - end.1) * 2.0 / 3.0);
        self.cubic(third(from), third(to), to)
    }

    /// A cubic Bézier curve. With n chords of equal parameter it is missed by at most M / 8 n², where M, its greatest
    /// second derivative, is six times the greatest second difference of its points (Wang 1984).
    pub(super) fn cubic(
        &mut self,
        first: (f64, f64),
        second: (f64, f64),
        to: (f64, f64),
    ) -> Result<(), Trouble> {
        let from = self.here;
        let bend = |a: (f64, f64), b: (f64, f64), c: (f64, f64)| {
            libm::hypot(a.0 - 2.0 * b.0 + c.0, a.1 - 2.0 * b.1 + c.1)
        };
        let most = bend(from, first, second).max(bend(first, second, to));
        let count = self.chords((0.75 * most / self.tolerance).sqrt())?;
        for step in 1..count {
            let t = step as f64 / count as f64;
            let u = 1.0 - t;
            let weights = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
            let mix = |a: f64, b: f64, c: f64, d: f64| {
                let [p, q, r, s] = weights;
                p * a + q * b + r * c + s * d
            };
            self.line_to((mix(from.0, first.0, second.0, to.0), mix(from.1, first.1, second.1, to.1)))?;
        }
        self.line_to(to)
    }

    /// An elliptic arc from end to end (SVG 1.1, appendix F.6): `turn` is the angle of its first radius in degrees.
    pub(super) fn arc(
        &mut self,
        radii: (f64, f64),
        turn: f64,
        (large, sweep): (bool, bool),
        to: (f64, f64),
    ) -> Result<(), Trouble> {
        let from = self.here;
        let (mut rx, mut ry) = (radii.0.abs(), radii.1.abs());
        if rx == 0.0 || ry == 0.0 || from == to {
            return self.line_to(to);
        }
        let (sine, cosine) = (libm::sin(turn.to_radians()), libm::cos(turn.to_radians()));
        // From the middle of the chord, with the ellipse made upright.
        let (dx, dy) = ((from.0 - to.0) / 2.0, (from.1 - to.1) / 2.0);
        let (x, y) = (cosine * dx + sine * dy, cosine * dy - sine * dx);
        let short = (x / rx) * (x / rx) + (y / ry) * (y / ry);
        // Radii that do not reach grow until they do.
        if short > 1.0 {
            rx *= short.sqrt();
            ry *= short.sqrt();
        }
        let over = (1.0 / short - 1.0).max(0.0).sqrt() * if large == sweep { -1.0 } else { 1.0 };
        let (cx, cy) = (over * rx * y / ry, -over * ry * x / rx);
        let angle = |x: f64, y: f64| libm::atan2((y - cy) / ry, (x - cx) / rx);
        let start = angle(x, y);
        let mut sweeps = angle(-x, -y) - start;
        if sweep && sweeps < 0.0 {
            sweeps += TAU;
        } else if !sweep && sweeps > 0.0 {
            sweeps -= TAU;
        }
        let middle = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
        // A chord of angle δ misses a circle by r (1 − cos δ/2); never coarser than an octagon.
        let step = 2.0 * libm::acos((1.0 - self.tolerance / rx.max(ry)).max(0.0));
        let count = self.chords(sweeps.abs() / step.min(PI / 4.0))?;
        for step in 1..count {
            let at = start + sweeps * step as f64 / count as f64;
            let (x, y) = (cx + rx * libm::cos(at), cy + ry * libm::sin(at));
            self.line_to((middle.0 + cosine * x - sine * y, middle.1 + sine * x + cosine * y))?;
        }
        self.line_to(to)
    }

    /// An upright ellipse about a middle.
    pub(super) fn ellipse(&mut self, middle: (f64, f64), radii: (f64, f64)) -> Result<(), Trouble> {
        let (left, right) = ((middle.0 - radii.0, middle.1), (middle.0 + radii.0, middle.1));
        self.move_to(left)?;
        self.arc(radii, 0.0, (false, true), right)?;
        self.arc(radii, 0.0, (false, true), left)?;
        self.close();
        Ok(())
    }

    /// An upright rectangle from its corner, with round corners of these radii.
    pub(super) fn rectangle(
        &mut self,
        (x, y): (f64, f64),
        (width, height): (f64, f64),
        (rx, ry): (f64, f64),
    ) -> Result<(), Trouble> {
        let (rx, ry) = (rx.min(width / 2.0), ry.min(height / 2.0));
        let (right, low) = (x + width, y + height);
        if rx <= 0.0 || ry <= 0.0 {
            self.move_to((x, y))?;
            for corner in [(right, y), (right, low), (x, low)] {
                self.line_to(corner)?;
            }
        } else {
            self.move_to((x + rx, y))?;
            for (start, end) in [
                ((right - rx, y), (right, y + ry)),
                ((right, low - ry), (right - rx, low)),
                ((x + rx, low), (x, low - ry)),
                ((x, y + ry), (x + rx, y)),
            ] {
                self.line_to(start)?;
                self.arc((rx, ry), 0.0, (false, true), end)?;
            }
        }
        self.close();
        Ok(())
    }

    fn chords(&self, wanted: f64) -> Result<u32, Trouble> {
        let wanted = if wanted < 1.0 { 1.0 } else { wanted.ceil() };
        // What is no number lies in no range.
        if (1.0..=MOST_CHORDS).contains(&wanted) { Ok(wanted as u32) } else { Err(Trouble::TooFar) }
    }
}
