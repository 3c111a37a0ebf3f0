use crate::{decimal, round_within};
use std::fmt;
use std::num::{NonZeroI64, NonZeroU32};
use std::str::FromStr;

/// A length in whole microns; printed as millimetres with up to three decimals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Micron(pub i32);

impl Micron {
    /// The longest length a document may hold: one kilometre. Differences and sums of two still fit an `i32`.
    pub const LIMIT: i32 = 1_000_000_000;
    /// No length.
    pub const ZERO: Self = Self(0);

    /// The nearest micron to a length in millimetres; `None` for NaN and beyond ±1 km.
    pub fn from_mm(mm: f64) -> Option<Self> {
        round_within(mm * 1000.0, f64::from(Self::LIMIT)).map(|microns| Self(microns as i32))
    }

    /// Millimetres.
    pub fn mm(self) -> f64 {
        f64::from(self.0) / 1000.0
    }

    /// Microns as a float, for geometry.
    pub fn um(self) -> f64 {
        f64::from(self.0)
    }
}

/// A dimensionless factor in millionths; printed with up to six decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Ratio(pub i32);

impl Ratio {
    /// One: nothing changes.
    pub const ONE: Self = Self(1_000_000);

    /// The nearest millionth; `None` for NaN and beyond ±1000.
    pub fn from_f64(value: f64) -> Option<Self> {
        round_within(value * 1e6, 1e9).map(|millionths| Self(millionths as i32))
    }

    /// The factor as a float.
    pub fn f64(self) -> f64 {
        f64::from(self.0) / 1e6
    }
}

/// A temperature in thousandths of a degree Celsius, or a change of it per second; printed with up to three decimals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Celsius(pub i32);

impl Celsius {
    /// The nearest thousandth of a degree; `None` for NaN and beyond ±10 000 °C.
    pub fn from_degrees(degrees: f64) -> Option<Self> {
        round_within(degrees * 1000.0, 1e7).map(|thousandths| Self(thousandths as i32))
    }

    /// Degrees.
    pub fn degrees(self) -> f64 {
        f64::from(self.0) / 1000.0
    }
}

/// A speed in microns per *minute*, because `F` is written in millimetres per minute. Never zero: a feed rate of
/// zero is a machine that waits forever.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Feed(NonZeroU32);

impl Feed {
    /// The fastest feed a document may hold: 60 m/s would be one kilometre in 17 s; this is 33 m/s.
    pub const LIMIT: u32 = 2_000_000_000;

    /// A feed of so many microns per minute; `None` when zero or beyond the limit.
    pub fn new(microns_per_minute: u32) -> Option<Self> {
        NonZeroU32::new(microns_per_minute).filter(|feed| feed.get() <= Self::LIMIT).map(Self)
    }

    /// The nearest feed to millimetres per second. One that shall stand in a header, which has three decimals, must be
    /// rounded to these before; settings are.
    pub fn from_mm_per_s(value: f64) -> Option<Self> {
        round_within(value * 60_000.0, f64::from(Self::LIMIT))
            .and_then(|feed| u32::try_from(feed).ok())
            .and_then(Self::new)
    }

    /// Millimetres per second.
    pub fn mm_per_s(self) -> f64 {
        f64::from(self.0.get()) / 60_000.0
    }

    /// Microns per minute, as stored.
    pub fn get(self) -> u32 {
        self.0.get()
    }
}

/// What one move pushes out, in hundred-thousandths of the machine's E unit; printed with up to five decimals.
///
/// Stored with its sign bit flipped so that `Option<Extrusion>` needs no room of its own.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Extrusion(NonZeroI64);

impl Extrusion {
    /// `None` for the one value that has no room, `i64::MIN`.
    pub fn new(hundred_thousandths: i64) -> Option<Self> {
        NonZeroI64::new(hundred_thousandths ^ i64::MIN).map(Self)
    }

    /// Hundred-thousandths of an E unit.
    pub fn get(self) -> i64 {
        self.0.get() ^ i64::MIN
    }

    /// E units.
    pub fn f64(self) -> f64 {
        self.get() as f64 / 1e5
    }
}

impl fmt::Debug for Extrusion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Extrusion({self})")
    }
}

/// Gives a quantity its printed form and its reader, side by side.
macro_rules! decimal_text {
    ($type:ty, $places:literal, |$it:ident| $get:expr, |$value:ident| $make:expr) => {
        impl $type {
            /// Decimal places of the printed form.
            pub const PLACES: u32 = $places;

            /// Appends the canonical form.
            #[inline]
            pub fn write(self, out: &mut Vec<u8>) {
                let $it = self;
                decimal::write(out, $get, $places);
            }

            /// Reads a whole word; `None` when it is no number or out of range.
            #[inline]
            pub fn read(text: &[u8]) -> Option<Self> {
                decimal::read(text, $places).and_then(Self::from_places)
            }

            /// From an integer of the last printed decimal.
            #[inline]
            pub fn from_places($value: i64) -> Option<Self> {
                $make
            }
        }

        impl fmt::Display for $type {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let mut text = Vec::with_capacity(24);
                self.write(&mut text);
                f.write_str(&String::from_utf8_lossy(&text))
            }
        }

        impl FromStr for $type {
            type Err = NotANumber;
            fn from_str(text: &str) -> Result<Self, NotANumber> {
                Self::read(text.as_bytes()).ok_or(NotANumber)
            }
        }
    };
}

/// The text is no number, or one beyond the limits of the quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotANumber;

impl fmt::Display for NotANumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("not a number, or out of range")
    }
}

decimal_text!(Micron, 3, |it| i64::from(it.0), |value| {
    i32::try_from(value).ok().filter(|microns| microns.unsigned_abs() <= Self::LIMIT as u32).map(Self)
});
decimal_text!(Celsius, 3, |it| i64::from(it.0), |value| {
    i32::try_from(value).ok().filter(|thousandths| thousandths.unsigned_abs() <= 10_000_000).map(Self)
});
decimal_text!(Ratio, 6, |it| i64::from(it.0), |value| i32::try_from(value).ok().map(Self));
decimal_text!(Feed, 3, |it| i64::from(it.get()), |value| u32::try_from(value).ok().and_then(Self::new));
decimal_text!(Extrusion, 5, |it| it.get(), |value| Self::new(value));
