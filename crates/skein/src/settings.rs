//! Settings that describe themselves: `#[derive(Settings)]` makes the profile key, the bounds, the manual and the
//! default out of one field.

use std::fmt;
use unit::{Angle, Celsius, Feed, Micron, Ratio};

/// A value as it stands in a profile, before it has a meaning.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// `true` or `false`.
    Bool(bool),
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// Several values.
    List(Vec<Value>),
    /// Named values.
    Table(Vec<(String, Value)>),
}

impl From<bool> for Value {
    fn from(value: bool) -> Self {
        Self::Bool(value)
    }
}
impl From<f64> for Value {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}
impl From<i32> for Value {
    fn from(value: i32) -> Self {
        Self::Number(f64::from(value))
    }
}
impl From<&str> for Value {
    fn from(value: &str) -> Self {
        Self::Text(value.to_owned())
    }
}

impl Value {
    /// What kind of value this is, for "expected … , found …".
    fn describe(&self) -> &'static str {
        match self {
            Self::Bool(_) => "true or false",
            Self::Number(_) => "a number",
            Self::Text(_) => "a text",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
        }
    }

    /// Every number inside, for the bounds.
    fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Number(number) => vec![*number],
            Self::List(values) => values.iter().flat_map(Self::numbers).collect(),
            Self::Table(values) => values.iter().flat_map(|(_, value)| value.numbers()).collect(),
            Self::Bool(_) | Self::Text(_) => Vec::new(),
        }
    }
}

impl fmt::Display for Value {
    /// As it would be written in a profile, on one line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bool(value) => write!(f, "{value}"),
            Self::Number(value) => write!(f, "{value}"),
            Self::Text(value) => write!(f, "{value:?}"),
            Self::List(values) => {
                f.write_str("[")?;
                for (index, value) in values.iter().enumerate() {
                    write!(f, "{}{value}", if index == 0 { "" } else { ", " })?;
                }
                f.write_str("]")
            }
            Self::Table(values) => {
                f.write_str("{ ")?;
                for (index, (name, value)) in values.iter().enumerate() {
                    write!(f, "{}{name} = {value}", if index == 0 { "" } else { ", " })?;
                }
                f.write_str(" }")
            }
        }
    }
}

/// What a setting may hold, in words for its manual page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `true` or `false`.
    Switch,
    /// A whole number.
    Count,
    /// Any number.
    Number,
    /// A text.
    Text,
    /// One of some words, each with what it means.
    Choice(&'static [(&'static str, &'static str)]),
    /// Something with a form of its own, described.
    Form(&'static str),
}

/// One setting: everything its manual page says.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The key in the profile.
    pub name: &'static str,
    /// What it does, what gets better and what gets worse.
    pub about: &'static str,
    /// The unit of its numbers; empty when they have none.
    pub unit: &'static str,
    /// What it may hold.
    pub kind: Kind,
    /// Its value when nobody says otherwise.
    pub default: Value,
    /// The least number allowed.
    pub min: Option<f64>,
    /// The greatest number allowed.
    pub max: Option<f64>,
}

/// A struct of settings. Derived, never written by hand.
pub trait Settings: Default {
    /// Every setting, in the order of the struct.
    fn fields() -> Vec<Field>;
    /// Sets one from a profile; the value is checked for its type and against its bounds.
    fn set(&mut self, name: &str, value: &Value) -> Result<(), SettingError>;
    /// Every name with its present value.
    fn values(&self) -> Vec<(&'static str, Value)>;
}

/// Why a setting was refused.
#[derive(Clone, Debug, PartialEq)]
pub enum SettingError {
    /// There is no setting of this name.
    Unknown,
    /// The value does not fit; why, as a clause after `name = value`.
    Refused(String),
}

/// A type that a setting can have.
pub trait Setting: Sized {
    /// What a profile may say.
    const KIND: Kind;
    /// Reads a profile's value; the error says what was expected.
    fn read(value: &Value) -> Result<Self, String>;
    /// The value as a profile would say it.
    fn show(&self) -> Value;
}

/// An enum whose variants are words. Derived.
pub trait Choice: Sized + Copy + PartialEq + 'static {
    /// Each word with its meaning, in the order of the variants.
    const WORDS: &'static [(&'static str, &'static str)];
    /// The variants, in the same order.
    const ALL: &'static [Self];
}

impl<T: Choice> Setting for T {
    const KIND: Kind = Kind::Choice(T::WORDS);

    fn read(value: &Value) -> Result<Self, String> {
        let found = match value {
            Value::Text(word) => T::WORDS.iter().position(|(known, _)| known == word),
            _ => None,
        };
        found.and_then(|index| T::ALL.get(index).copied()).ok_or_else(|| {
            let words: Vec<String> = T::WORDS.iter().map(|(word, _)| format!("{word:?}")).collect();
            format!("is none of {}", words.join(", "))
        })
    }

    fn show(&self) -> Value {
        let index = T::ALL.iter().position(|variant| variant == self).unwrap_or(0);
        Value::Text(T::WORDS[index].0.to_owned())
    }
}

fn number(value: &Value) -> Result<f64, String> {
    match value {
        Value::Number(number) if number.is_finite() => Ok(*number),
        Value::Number(_) => Err("is no finite number".to_owned()),
        other => Err(format!("is {}, not a number", other.describe())),
    }
}

/// The number doors of the quantities: one line each.
macro_rules! number_setting {
    ($($type:ty: $make:expr, $show:expr;)*) => {$(
        impl Setting for $type {
            const KIND: Kind = Kind::Number;
            fn read(value: &Value) -> Result<Self, String> {
                let make: fn(f64) -> Option<$type> = $make;
                make(number(value)?).ok_or_else(|| "is out of range".to_owned())
            }
            fn show(&self) -> Value {
                let show: fn(&$type) -> f64 = $show;
                Value::Number(show(self))
            }
        }
    )*};
}

number_setting! {
    Micron: Micron::from_mm, |it| it.mm();
    Ratio: Ratio::from_f64, |it| it.f64();
    Celsius: Celsius::from_degrees, |it| it.degrees();
    Angle: Angle::from_degrees, |it| it.degrees();
    // Whole microns a second, as many decimals as a header has: what the moves say and what the header says is the same.
    Feed: |speed| Feed::from_mm_per_s((speed * 1000.0).round() / 1000.0), |it| it.mm_per_s();
}

impl Setting for bool {
    const KIND: Kind = Kind::Switch;
    fn read(value: &Value) -> Result<Self, String> {
        match value {
            Value::Bool(value) => Ok(*value),
            other => Err(format!("is {}, not true or false", other.describe())),
        }
    }
    fn show(&self) -> Value {
        Value::Bool(*self)
    }
}

impl Setting for u32 {
    const KIND: Kind = Kind::Count;
    fn read(value: &Value) -> Result<Self, String> {
        let number = number(value)?;
        if number.fract() != 0.0 {
            return Err("is no whole number".to_owned());
        }
        if (0.0..=1e9).contains(&number) { Ok(number as Self) } else { Err("is out of range".to_owned()) }
    }
    fn show(&self) -> Value {
        Value::Number(f64::from(*self))
    }
}

impl Setting for String {
    const KIND: Kind = Kind::Text;
    fn read(value: &Value) -> Result<Self, String> {
        match value {
            Value::Text(text) => Ok(text.clone()),
            other => Err(format!("is {}, not a text in quotes", other.describe())),
        }
    }
    fn show(&self) -> Value {
        Value::Text(self.clone())
    }
}

/// A point of the bed.
impl Setting for shape::Point {
    const KIND: Kind = Kind::Form("[x, y]");
    fn read(value: &Value) -> Result<Self, String> {
        match value {
            Value::List(values) if values.len() == 2 => {
                Ok(Self::new(Micron::read_value(&values[0])?.0, Micron::read_value(&values[1])?.0))
            }
            _ => Err("is not of the form [x, y]".to_owned()),
        }
    }
    fn show(&self) -> Value {
        Value::List(vec![Micron(self.x).show(), Micron(self.y).show()])
    }
}

/// A place of the nozzle.
impl Setting for shape::Point3 {
    const KIND: Kind = Kind::Form("[x, y, z]");
    fn read(value: &Value) -> Result<Self, String> {
        match value {
            Value::List(values) if values.len() == 3 => Ok(Self {
                x: Micron::read_value(&values[0])?.0,
                y: Micron::read_value(&values[1])?.0,
                z: Micron::read_value(&values[2])?.0,
            }),
            _ => Err("is not of the form [x, y, z]".to_owned()),
        }
    }
    fn show(&self) -> Value {
        Value::List(vec![Micron(self.x).show(), Micron(self.y).show(), Micron(self.z).show()])
    }
}

/// Disambiguates [`Setting::read`] from the reader of text that the quantities have themselves.
pub(crate) trait ReadValue: Setting {
    fn read_value(value: &Value) -> Result<Self, String> {
        <Self as Setting>::read(value)
    }
}
impl<T: Setting> ReadValue for T {}

/// For the derive: reads a value and checks its bounds. A number beyond them hears of them even when the type could not
/// hold it either: they say more.
pub fn read_within<T: Setting>(
    value: &Value,
    min: Option<f64>,
    max: Option<f64>,
    unit: &str,
) -> Result<T, SettingError> {
    let space = if unit.is_empty() { "" } else { " " };
    let beyond = value.numbers().into_iter().find_map(|number| {
        let below = min.filter(|min| number < *min).map(|min| format!("is below {min}{space}{unit}"));
        below.or_else(|| max.filter(|max| number > *max).map(|max| format!("is above {max}{space}{unit}")))
    });
    let is_number = matches!((T::KIND, value), (Kind::Number | Kind::Count, Value::Number(_)));
    match (T::read_value(value), beyond) {
        (Ok(read), None) => Ok(read),
        (Err(why), beyond) => Err(beyond.filter(|_| is_number).unwrap_or(why)),
        (Ok(_), Some(beyond)) => Err(beyond),
    }
    .map_err(SettingError::Refused)
}

/// For the derive: the default of a setting.
///
/// # Panics
/// When the default in the source is no value of the type or out of its own bounds: our bug, and every test of the
/// stage finds it.
pub fn default_of<T: Setting>(value: &Value, min: Option<f64>, max: Option<f64>) -> T {
    match read_within(value, min, max, "") {
        Ok(value) => value,
        Err(error) => panic!("bad default {value}: {error:?}"),
    }
}
