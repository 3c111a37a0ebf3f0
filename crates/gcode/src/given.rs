//! Values that a line may give or leave out.

use std::fmt;

/// A number that a line gives, or nothing: what takes 16 bytes as an `Option<f64>`, in 8. Half of what is kept of a
/// file is such values.
///
/// ```
/// use gcode::Given;
///
/// assert_eq!(Given::new(2.5).get(), Some(2.5));
/// assert_eq!(Given::NONE.or(7.0), 7.0);
/// ```
// A line never gives NaN, so NaN stands for nothing.
#[derive(Clone, Copy)]
pub struct Given(f64);

impl Given {
    /// Not given.
    pub const NONE: Self = Self(f64::NAN);

    /// Given as `value`; nothing if that is NaN.
    #[inline]
    pub const fn new(value: f64) -> Self {
        Self(value)
    }

    /// The value, if it is given.
    #[inline]
    pub fn get(self) -> Option<f64> {
        self.is_some().then_some(self.0)
    }

    /// The value, or `default` if it is not given.
    #[inline]
    pub fn or(self, default: f64) -> f64 {
        if self.is_some() { self.0 } else { default }
    }

    /// Whether it is given.
    #[inline]
    pub fn is_some(self) -> bool {
        !self.0.is_nan()
    }

    /// Whether it is not given.
    #[inline]
    pub fn is_none(self) -> bool {
        self.0.is_nan()
    }
}

impl Default for Given {
    fn default() -> Self {
        Self::NONE
    }
}

impl From<Option<f64>> for Given {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::NONE, Self)
    }
}

impl PartialEq for Given {
    fn eq(&self, other: &Self) -> bool {
        self.get() == other.get()
    }
}

impl fmt::Debug for Given {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.get() {
            Some(value) => value.fmt(f),
            None => f.write_str("_"),
        }
    }
}
