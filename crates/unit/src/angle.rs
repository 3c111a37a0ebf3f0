use crate::{decimal, round_within};
use std::fmt;
use std::str::FromStr;

/// An angle in thousandths of a degree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Angle(pub i32);

impl Angle {
    /// The nearest thousandth of a degree; `None` for NaN and beyond ±1 000 000°.
    pub fn from_degrees(degrees: f64) -> Option<Self> {
        round_within(degrees * 1000.0, 1e9).map(|value| Self(value as i32))
    }

    /// Degrees.
    pub fn degrees(self) -> f64 {
        f64::from(self.0) / 1000.0
    }

    /// The unit vector at this angle from the x axis.
    pub fn direction(self) -> Direction {
        let radians = self.degrees().to_radians();
        Direction::from_vector(libm::cos(radians), libm::sin(radians)).unwrap_or(Direction::X)
    }
}

/// A direction in the plane: a unit vector in millionths, printed as the complex number `(0.6+0.8j)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Direction {
    /// Millionths along x.
    pub x: i32,
    /// Millionths along y.
    pub y: i32,
}

impl Direction {
    /// Along the x axis.
    pub const X: Self = Self { x: 1_000_000, y: 0 };

    /// The direction of a vector of any length; `None` when it has none.
    pub fn from_vector(x: f64, y: f64) -> Option<Self> {
        let length = (x * x + y * y).sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        Some(Self {
            x: round_within(x / length * 1e6, 1e6)? as i32,
            y: round_within(y / length * 1e6, 1e6)? as i32,
        })
    }

    /// Cosine and sine, renormalised to length one.
    pub fn unit(self) -> (f64, f64) {
        let (x, y) = (f64::from(self.x), f64::from(self.y));
        let length = (x * x + y * y).sqrt();
        if length > 0.0 { (x / length, y / length) } else { (1.0, 0.0) }
    }

    /// The square root as a complex number: half the angle, in the right half plane.
    pub fn half(self) -> Self {
        let (x, y) = self.unit();
        let half_x = ((1.0 + x) / 2.0).max(0.0).sqrt();
        let half_y = ((1.0 - x) / 2.0).max(0.0).sqrt() * if y < 0.0 { -1.0 } else { 1.0 };
        Self::from_vector(half_x, half_y).unwrap_or(Self::X)
    }
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = vec![b'('];
        decimal::write_short(&mut text, i64::from(self.x), 6);
        if self.y >= 0 {
            text.push(b'+');
        }
        decimal::write_short(&mut text, i64::from(self.y), 6);
        text.extend_from_slice(b"j)");
        f.write_str(&String::from_utf8_lossy(&text))
    }
}

impl FromStr for Direction {
    type Err = crate::NotANumber;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parse = || {
            let inner = text.strip_prefix('(')?.strip_suffix("j)")?.as_bytes();
            let (x, length) = decimal::read_prefix(inner, 6)?;
            let y = decimal::read(inner.get(length..)?, 6)?;
            let within = |value: i64| i32::try_from(value).ok().filter(|value| value.abs() <= 1_000_000);
            Some(Self { x: within(x)?, y: within(y)? })
        };
        parse().ok_or(crate::NotANumber)
    }
}
