//! A flavor as keys and values, for profiles in whatever form: whoever reads one knows its syntax, and calls
//! [`Flavor::set`] for each key.

use super::{AffectsE, ArcTurns, DwellUnit, Extruder, Flavor, Limit, LimitValue, Quantity, Variables};
use crate::diagnostic::Tenths;
use crate::parameters::LengthUnit;
use std::borrow::Cow;
use std::fmt;

/// Why a key of a flavor was refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FlavorError {
    /// The key.
    pub key: String,
    /// What is so and what helps.
    pub message: String,
}

impl fmt::Display for FlavorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.key, self.message)
    }
}

impl std::error::Error for FlavorError {}

/// A value that is written as text and read back from it.
trait Entry: Sized {
    /// What may be written.
    const FORM: &'static str;

    fn write(&self) -> String;

    fn read(text: &str) -> Option<Self>;
}

/// Values that have names.
macro_rules! named {
    ($type:ty, $form:literal, $($name:literal = $value:expr),+) => {
        impl Entry for $type {
            const FORM: &'static str = $form;

            fn write(&self) -> String {
                [$(($name, $value)),+]
                    .iter()
                    .find(|(_, value)| value == self)
                    .map_or_else(String::new, |(name, _)| (*name).to_owned())
            }

            fn read(text: &str) -> Option<Self> {
                [$(($name, $value)),+].into_iter().find(|(name, _)| *name == text).map(|(_, value)| value)
            }
        }
    };
}

named!(bool, "true or false", "true" = true, "false" = false);
named!(LengthUnit, "mm or inch", "mm" = LengthUnit::Millimetre, "inch" = LengthUnit::Inch);
named!(
    DwellUnit,
    "s, ms, rev or s?",
    "s" = DwellUnit::Seconds,
    "s?" = DwellUnit::DoubtfulSeconds,
    "ms" = DwellUnit::Milliseconds,
    "rev" = DwellUnit::Revolutions
);
named!(
    Extruder,
    "amount, screw, area or none",
    "amount" = Extruder::Amount,
    "screw" = Extruder::Screw,
    "area" = Extruder::Area,
    "none" = Extruder::None
);
named!(
    AffectsE,
    "or, override or never",
    "or" = AffectsE::Or,
    "override" = AffectsE::Override,
    "never" = AffectsE::Never
);
named!(
    ArcTurns,
    "none, extra or total",
    "none" = ArcTurns::None,
    "extra" = ArcTurns::Extra,
    "total" = ArcTurns::Total
);
named!(
    Variables,
    "none, rs274, fanuc, siemens or reprap",
    "none" = Variables::None,
    "rs274" = Variables::Rs274,
    "fanuc" = Variables::Fanuc,
    "siemens" = Variables::Siemens,
    "reprap" = Variables::RepRap
);

impl Entry for Cow<'static, str> {
    const FORM: &'static str = "a text";

    fn write(&self) -> String {
        self.clone().into_owned()
    }

    fn read(text: &str) -> Option<Self> {
        Some(Cow::Owned(text.to_owned()))
    }
}

impl Entry for u8 {
    const FORM: &'static str = "a whole number up to 9";

    fn write(&self) -> String {
        self.to_string()
    }

    fn read(text: &str) -> Option<Self> {
        text.parse().ok().filter(|&value| value <= 9)
    }
}

/// A code in tenths.
impl Entry for u16 {
    const FORM: &'static str = "the number of a code, such as 117 or 92.1";

    fn write(&self) -> String {
        Tenths(*self).to_string()
    }

    fn read(text: &str) -> Option<Self> {
        let (whole, tenth) = text.split_once('.').unwrap_or((text, "0"));
        let tenth: u16 = tenth.parse().ok().filter(|&tenth| tenth < 10)?;
        whole.parse::<u16>().ok()?.checked_mul(10)?.checked_add(tenth)
    }
}

impl Entry for Option<(u16, u16)> {
    const FORM: &'static str = "the G numbers of inch and millimetre, such as `20 21`, or nothing";

    fn write(&self) -> String {
        self.map_or_else(String::new, |(inch, mm)| format!("{} {}", inch.write(), mm.write()))
    }

    fn read(text: &str) -> Option<Self> {
        if text.is_empty() {
            return Some(None);
        }
        let (inch, mm) = text.split_once(' ')?;
        Some(Some((u16::read(inch)?, u16::read(mm)?)))
    }
}

impl Entry for (u8, DwellUnit) {
    const FORM: &'static str = "a letter and s, ms or rev, such as `P ms`";

    fn write(&self) -> String {
        format!("{} {}", char::from(self.0), self.1.write())
    }

    fn read(text: &str) -> Option<Self> {
        let (letter, unit) = text.split_once(' ')?;
        let &[letter] = letter.as_bytes() else { return None };
        letter.is_ascii_uppercase().then_some((letter, DwellUnit::read(unit)?))
    }
}

/// Axes by number.
const AXES: [&str; 4] = ["X", "Y", "Z", "E"];

impl Entry for Quantity {
    const FORM: &'static str = "a limit";

    fn write(&self) -> String {
        let of = |name: &str, axis: &u8| format!("{name} {}", AXES.get(usize::from(*axis)).unwrap_or(&"?"));
        match self {
            Self::Acceleration => "acceleration".to_owned(),
            Self::TravelAcceleration => "travel_acceleration".to_owned(),
            Self::RetractAcceleration => "retract_acceleration".to_owned(),
            Self::Speed => "speed".to_owned(),
            Self::JunctionDeviation => "junction_deviation".to_owned(),
            Self::CornerSpeed => "corner_speed".to_owned(),
            Self::CruiseRatio => "cruise_ratio".to_owned(),
            Self::AccelerationToDeceleration => "acceleration_to_deceleration".to_owned(),
            Self::AxisAcceleration(axis) => of("acceleration", axis),
            Self::AxisSpeed(axis) => of("speed", axis),
            Self::AxisJerk(axis) => of("jerk", axis),
        }
    }

    fn read(text: &str) -> Option<Self> {
        let axis = |name: &str| AXES.iter().position(|axis| *axis == name).map(|index| index as u8);
        Some(match text.split_once(' ') {
            Some(("acceleration", name)) => Self::AxisAcceleration(axis(name)?),
            Some(("speed", name)) => Self::AxisSpeed(axis(name)?),
            Some(("jerk", name)) => Self::AxisJerk(axis(name)?),
            Some(_) => return None,
            None => match text {
                "acceleration" => Self::Acceleration,
                "travel_acceleration" => Self::TravelAcceleration,
                "retract_acceleration" => Self::RetractAcceleration,
                "speed" => Self::Speed,
                "junction_deviation" => Self::JunctionDeviation,
                "corner_speed" => Self::CornerSpeed,
                "cruise_ratio" => Self::CruiseRatio,
                "acceleration_to_deceleration" => Self::AccelerationToDeceleration,
                _ => return None,
            },
        })
    }
}

impl Entry for Limit {
    const FORM: &'static str = "a command, its word, and what it limits, such as `M203 X = speed X per minute` or `M66 L = acceleration 156.25 by`";

    fn write(&self) -> String {
        let gap = if self.word.is_empty() { "" } else { " " };
        let quantity = self.quantity.write();
        let rule = match self.value {
            LimitValue::Same => String::new(),
            LimitValue::PerMinute => " per minute".to_owned(),
            LimitValue::Inverse(dividend) => format!(" {dividend} by"),
        };
        format!("{}{gap}{} = {quantity}{rule}", self.command, self.word)
    }

    fn read(text: &str) -> Option<Self> {
        let (source, rule) = text.split_once(" = ")?;
        let (command, word) = source.split_once(' ').unwrap_or((source, ""));
        let (quantity, value) = if let Some(quantity) = rule.strip_suffix(" per minute") {
            (quantity, LimitValue::PerMinute)
        } else if let Some((quantity, dividend)) =
            rule.strip_suffix(" by").and_then(|rule| rule.rsplit_once(' '))
        {
            let dividend: f64 = dividend.parse().ok()?;
            if !dividend.is_finite() || dividend <= 0.0 {
                return None;
            }
            (quantity, LimitValue::Inverse(dividend))
        } else {
            (rule, LimitValue::Same)
        };
        let quantity = Quantity::read(quantity)?;
        Some(Self {
            command: Cow::Owned(command.to_owned()),
            word: Cow::Owned(word.to_owned()),
            quantity,
            value,
        })
    }
}

/// A list, its members between commas.
impl<T: Entry + Clone> Entry for Cow<'static, [T]> {
    const FORM: &'static str = T::FORM;

    fn write(&self) -> String {
        self.iter().map(Entry::write).collect::<Vec<_>>().join(", ")
    }

    fn read(text: &str) -> Option<Self> {
        let parts = text.split(',').map(str::trim).filter(|part| !part.is_empty());
        parts.map(T::read).collect::<Option<Vec<_>>>().map(Cow::Owned)
    }
}

fn put<T: Entry>(field: &mut T, key: &str, value: &str) -> Result<(), FlavorError> {
    *field = T::read(value.trim()).ok_or_else(|| FlavorError {
        key: key.to_owned(),
        message: format!("`{value}` is not {}", T::FORM),
    })?;
    Ok(())
}

/// The fields that are keys.
macro_rules! keys {
    ($($field:ident),+ $(,)?) => {
        impl Flavor {
            /// The keys that [`set`](Self::set) takes.
            pub const KEYS: &[&str] = &[$(stringify!($field)),+];

            /// Sets one field to what `value` says. A list is written with commas between its members.
            ///
            /// # Errors
            ///
            /// The key is unknown, or the value has another form. Then nothing is changed.
            ///
            /// ```
            /// let mut mine = gcode::Flavor::default();
            /// mine.set("name", "mine")?;
            /// mine.set("dwell", "X s, P ms")?;
            /// assert!(mine.set("dwell", "X h").is_err());
            /// # Ok::<(), gcode::FlavorError>(())
            /// ```
            pub fn set(&mut self, key: &str, value: &str) -> Result<(), FlavorError> {
                match key {
                    $(stringify!($field) => put(&mut self.$field, key, value),)+
                    _ => Err(FlavorError {
                        key: key.to_owned(),
                        message: format!("no key of a flavor; there are {}", Self::KEYS.join(", ")),
                    }),
                }
            }

            /// Every key with its value, as [`set`](Self::set) reads it.
            pub fn entries(&self) -> Vec<(&'static str, String)> {
                vec![$((stringify!($field), self.$field.write())),+]
            }
        }
    };
}

keys!(
    name,
    semicolon,
    parentheses,
    quotes,
    named_words,
    digit_gaps,
    refuses_repeated,
    unit,
    unit_codes,
    modal_motion,
    rapid,
    dwell,
    extruder,
    bead_on,
    bead_off,
    g90_affects_e,
    arcs,
    arc_radius,
    arc_turns,
    feed_modes,
    text_codes,
    checksum,
    purge_code,
    variables,
    limits,
    decimals,
    end,
);
