//! Words that change what a machine can do: its accelerations, speeds and corners.

use crate::command::Command;
use crate::parameters::{LengthUnit, Parameters};
use std::borrow::Cow;

/// What a word limits. Axes are X, Y, Z and E, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Of all moves, mm/s².
    Acceleration,
    /// Of moves without clay, mm/s².
    TravelAcceleration,
    /// Of E alone, mm/s².
    RetractAcceleration,
    /// Of one axis, mm/s².
    AxisAcceleration(u8),
    /// Of all moves, mm/s.
    Speed,
    /// Of one axis, mm/s.
    AxisSpeed(u8),
    /// How far a corner may be missed, mm.
    JunctionDeviation,
    /// The speed at a corner of 90 degrees, mm/s.
    CornerSpeed,
    /// The jump in speed of one axis, mm/s.
    AxisJerk(u8),
    /// The part of a move that is cruised through (Klipper), 0 or more and less than 1.
    CruiseRatio,
    /// The acceleration with which the highest speed of a move is found (Klipper until 2024), mm/s².
    AccelerationToDeceleration,
}

impl Quantity {
    /// Whether it may be so much.
    fn may_be(self, value: f64) -> bool {
        match self {
            Self::CruiseRatio => (0.0..1.0).contains(&value),
            _ => value > 0.0 && value.is_finite(),
        }
    }
}

/// How the number of a word becomes the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LimitValue {
    /// It is the limit.
    Same,
    /// It is the limit per minute.
    PerMinute,
    /// The limit is this number divided by it.
    Inverse(f64),
}

/// A word and what it limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// The command: `M204`, `SET_VELOCITY_LIMIT`, or a setting such as `$110`.
    pub command: Cow<'static, str>,
    /// The letter or name of the word; empty for a setting.
    pub word: Cow<'static, str>,
    /// What it limits.
    pub quantity: Quantity,
    /// How.
    pub value: LimitValue,
}

impl Limit {
    pub(super) const fn new(
        command: &'static str,
        word: &'static str,
        quantity: Quantity,
        value: LimitValue,
    ) -> Self {
        Self { command: Cow::Borrowed(command), word: Cow::Borrowed(word), quantity, value }
    }

    /// The limit that `command` sets, if it sets this one to what it may be: nearly all must be more than 0.
    pub fn of(&self, command: &Command<'_>) -> Option<f64> {
        let number = self.number(command)?;
        let value = match self.value {
            LimitValue::Same => number,
            LimitValue::PerMinute => number / 60.0,
            LimitValue::Inverse(dividend) => dividend / number,
        };
        self.quantity.may_be(value).then_some(value)
    }

    fn number(&self, command: &Command<'_>) -> Option<f64> {
        match command {
            Command::M { tenths, words } => {
                let code: u16 = self.command.strip_prefix('M')?.parse().ok()?;
                (code.checked_mul(10) == Some(*tenths)).then(|| words.get(*self.word.as_bytes().first()?))?
            }
            Command::Config { text } => {
                let (name, rest) = text.split_at_checked(self.command.len())?;
                if !name.eq_ignore_ascii_case(self.command.as_bytes()) {
                    return None;
                }
                if self.word.is_empty() {
                    let number = rest.strip_prefix(b"=")?;
                    return crate::read_number(number, 0).map(|(value, _)| value);
                }
                rest.first().is_some_and(u8::is_ascii_whitespace).then_some(())?;
                Parameters::new(rest, LengthUnit::Millimetre).named(&self.word)
            }
            _ => None,
        }
    }
}
