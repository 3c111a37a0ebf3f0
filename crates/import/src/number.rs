//! Decimal numbers as texts have them, to whole microns without a float on the way.

use crate::Unit;
use unit::Micron;

/// Why a word is no coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Trouble {
    NotANumber,
    NotFinite,
    TooFar,
}

/// A decimal number as it is written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Decimal {
    negative: bool,
    digits: u64,
    /// The power of ten that the digits are multiplied with.
    power: i64,
    /// Whether a comma stands where the point should.
    pub(crate) comma: bool,
}

impl Decimal {
    /// Reads a whole word: a sign, digits, a point or a comma, an exponent.
    #[inline]
    pub(crate) fn read(word: &[u8]) -> Result<Self, Trouble> {
        let (negative, mut rest) = match word {
            [b'-', rest @ ..] => (true, rest),
            [b'+', rest @ ..] => (false, rest),
            _ => (false, word),
        };
        let (mut any, mut value, mut left_out, mut decimals) = (false, 0u64, 0i64, 0i64);
        let mut mark = None;
        while let [byte, tail @ ..] = rest {
            match byte {
                b'0'..=b'9' => {
                    any = true;
                    if value < MOST_DIGITS {
                        value = value * 10 + u64::from(byte - b'0');
                    } else {
                        left_out += 1;
                    }
                    decimals += i64::from(mark.is_some());
                }
                b'.' | b',' if mark.is_none() => mark = Some(*byte),
                _ => break,
            }
            rest = tail;
        }
        if !any {
            let is_word = matches!(rest, [b'n' | b'N' | b'i' | b'I', ..]);
            return Err(if is_word && mark.is_none() { Trouble::NotFinite } else { Trouble::NotANumber });
        }
        let exponent = match rest {
            [] => 0,
            [b'e' | b'E' | b'd' | b'D', exponent @ ..] => {
                self::exponent(exponent).ok_or(Trouble::NotANumber)?
            }
            // The way some Windows programs print what is no number.
            [b'#', ..] => return Err(Trouble::NotFinite),
            _ => return Err(Trouble::NotANumber),
        };
        let power = exponent + left_out - decimals;
        Ok(Self { negative, digits: value, power, comma: mark == Some(b',') })
    }

    /// As a length of a unit in whole microns, halves away from zero.
    #[inline]
    pub(crate) fn microns(self, unit: Unit) -> Result<i32, Trouble> {
        let microns = self.magnitude(unit.microns())?;
        let microns =
            i32::try_from(microns).ok().filter(|microns| *microns <= Micron::LIMIT).ok_or(Trouble::TooFar)?;
        Ok(if self.negative { -microns } else { microns })
    }

    /// As a length of a unit in whole picometres, for what is still to be turned and scaled. A float holds them
    /// exactly up to the limit of nine kilometres.
    pub(crate) fn picometres(self, unit: Unit) -> Result<f64, Trouble> {
        let picometres = self.magnitude(unit.microns() * PICOMETRES)?;
        let picometres =
            Some(picometres).filter(|length| *length <= MOST_PICOMETRES).ok_or(Trouble::TooFar)? as f64;
        Ok(if self.negative { -picometres } else { picometres })
    }

    /// As a plain number, for factors and angles.
    pub(crate) fn plain(self) -> f64 {
        // Both are exact for all that a person would write; a quotient of exact floats is rounded once.
        let digits = self.digits as f64;
        let power =
            i32::try_from(self.power).unwrap_or(if self.power < 0 { i32::MIN / 2 } else { i32::MAX / 2 });
        let value = if power < 0 { digits / 10f64.powi(-power) } else { digits * 10f64.powi(power) };
        if self.negative { -value } else { value }
    }

    /// The digits times a factor, rounded to a whole number.
    #[inline]
    fn magnitude(self, factor: u64) -> Result<u64, Trouble> {
        let shift = usize::try_from(self.power.unsigned_abs()).unwrap_or(usize::MAX);
        if let (Some(value), Some(divisor)) = (self.digits.checked_mul(factor), POWERS.get(shift))
            && self.power <= 0
            && let Some(sum) = value.checked_add(divisor / 2)
        {
            return Ok(sum / divisor);
        }
        let value = u128::from(self.digits) * u128::from(factor);
        let shift = u32::try_from(shift).unwrap_or(u32::MAX);
        let power = 10u128.checked_pow(shift);
        let whole = match power {
            _ if value == 0 => Some(0),
            Some(power) if self.power >= 0 => value.checked_mul(power),
            Some(divisor) => value.checked_add(divisor / 2).map(|sum| sum / divisor),
            // Less than half a micron, or more than all.
            None if self.power < 0 => Some(0),
            None => None,
        };
        whole.and_then(|whole| u64::try_from(whole).ok()).ok_or(Trouble::TooFar)
    }
}

/// How many picometres a micron has.
pub(crate) const PICOMETRES: u64 = 1_000_000;

/// Below 2⁵³, so that a float holds every one of them.
const MOST_PICOMETRES: u64 = 9_000_000_000_000_000;

/// A value below this can take one more digit.
const MOST_DIGITS: u64 = 100_000_000_000_000_000;

const POWERS: [u64; 19] = {
    let mut powers = [1; 19];
    let mut index = 1;
    while index < 19 {
        powers[index] = powers[index - 1] * 10;
        index += 1;
    }
    powers
};

/// The number after `e`. Beyond a million all numbers are zero or too far away, so there it stops counting.
fn exponent(text: &[u8]) -> Option<i64> {
    let (sign, digits) = match text {
        [b'-', digits @ ..] => (-1, digits),
        [b'+', digits @ ..] => (1, digits),
        _ => (1, text),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    Some(sign * digits.iter().fold(0i64, |value, digit| (value * 10 + i64::from(digit - b'0')).min(1 << 40)))
}

/// A whole number with a sign, as indices and counts are.
#[inline]
pub(crate) fn whole(word: &[u8]) -> Option<i64> {
    let (negative, digits) = match word {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, word),
    };
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut value = 0i64;
    for digit in digits {
        value = value * 10 + i64::from(Some(digit.wrapping_sub(b'0')).filter(|digit| *digit < 10)?);
    }
    Some(if negative { -value } else { value })
}

/// Microns as a float, to the nearest whole one; `None` for what is no number or beyond a kilometre.
#[inline]
pub(crate) fn nearest(microns: f64) -> Option<i32> {
    // The nearest integer follows without a call of `round`.
    (microns.abs() <= f64::from(Micron::LIMIT)).then(|| (microns + 0.5f64.copysign(microns)) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn microns(text: &str, unit: Unit) -> Result<i32, Trouble> {
        Decimal::read(text.as_bytes())?.microns(unit)
    }

    #[test]
    fn numbers_in_every_form() {
        for (text, expected) in [
            ("0", 0),
            ("-0.0", 0),
            ("1", 1000),
            ("+1.5", 1500),
            (".5", 500),
            ("3.", 3000),
            ("-2.500000e+01", -25_000),
            ("1E3", 1_000_000),
            ("12345678.9e-4", 1_234_568),
            ("0.0005", 1),
            ("-0.0005", -1),
            ("1.0005", 1001),
            ("0.00049999999999999999999999999999", 0),
            ("1e-400", 0),
            ("0e999999999999999999999", 0),
            ("1000000.0000000000000000000000000001", 1_000_000_000),
            ("0000000000000000000000000000012.5", 12_500),
            ("0.0000000000000000000000000001e28", 1000),
            ("1d1", 10_000),
            ("12,5", 12_500),
        ] {
            assert_eq!(microns(text, Unit::Millimetre), Ok(expected), "{text}");
        }
        assert_eq!(Decimal::read(b"12,5").map(|number| number.comma), Ok(true));
    }

    #[test]
    fn units_are_exact() {
        for (text, unit, expected) in [
            ("1", Unit::Inch, 25_400),
            ("-0.5", Unit::Foot, -152_400),
            ("0.0123456789012345678", Unit::Metre, 12_346),
            ("7.5", Unit::Micron, 8),
            ("1e-3", Unit::Centimetre, 10),
        ] {
            assert_eq!(microns(text, unit), Ok(expected), "{text}");
        }
        let picometres = |text: &[u8], unit| Decimal::read(text).and_then(|number| number.picometres(unit));
        assert_eq!(picometres(b"-1.2345678", Unit::Inch), Ok(-31_358_022_120.0));
        assert_eq!(picometres(b"1e7", Unit::Metre), Err(Trouble::TooFar));
        assert_eq!(Decimal::read(b"-0.6428").map(Decimal::plain), Ok(-0.6428));
    }

    #[test]
    fn what_is_no_number() {
        for text in
            ["", "-", ".", "1.2.3", "1.000,5", "1,000.5", "1e", "1e+", "1mm", "0x10", "1\0", "--1", "vertex"]
        {
            assert_eq!(microns(text, Unit::Millimetre), Err(Trouble::NotANumber), "{text}");
        }
        for text in ["nan", "-NaN", "inf", "+Infinity", "nan(ind)", "1.#QNAN", "-1.#IND00"] {
            assert_eq!(microns(text, Unit::Millimetre), Err(Trouble::NotFinite), "{text}");
        }
        for text in
            ["1e30", "1000000.001", "3.4028235e38", "99999999999999999999999", "1e99999999999999999999"]
        {
            assert_eq!(microns(text, Unit::Millimetre), Err(Trouble::TooFar), "{text}");
        }
    }

    #[test]
    fn whole_numbers() {
        for (text, expected) in [("12", Some(12)), ("-3", Some(-3)), ("", None), ("1.0", None), ("-", None)] {
            assert_eq!(whole(text.as_bytes()), expected, "{text}");
        }
        assert_eq!(whole(b"99999999999999999999"), None);
    }
}
