//! Reads a decimal number as G-code writes it: `12`, `-.5`, `3.`, `+2`. There are no exponents, since `1E5` is a one and
//! the word `E5`.

use crate::short::read_short;

/// Powers of ten that a double holds exactly; dividing by one of them rounds once.
const TENS: [f64; 16] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// The number that begins at `start` of `text`, to the nearest double, and where it ends. Nothing if there is no digit,
/// or if the number is too large for a double.
#[inline]
pub fn read_number(text: &[u8], start: usize) -> Option<(f64, usize)> {
    let negative = text.get(start) == Some(&b'-');
    match read_short(text, start.wrapping_add(usize::from(negative))) {
        Some((size, end)) => Some((if negative { -size } else { size }, end)),
        None => read_any(text, start),
    }
}

/// Does what [`read_number`] does, digit by digit.
fn read_any(text: &[u8], start: usize) -> Option<(f64, usize)> {
    let mut index = start;
    let sign = *text.get(index)?;
    let negative = sign == b'-';
    if negative || sign == b'+' {
        index = index.wrapping_add(1);
    }
    let digits_start = index;
    // It may wrap when there are many digits; then it is not used.
    let mut mantissa: u64 = 0;
    index = take_digits(text, index, &mut mantissa);
    let mut digits = index.wrapping_sub(digits_start);
    let mut decimals = 0;
    if text.get(index) == Some(&b'.') {
        let point = index.wrapping_add(1);
        index = take_digits(text, point, &mut mantissa);
        decimals = index.wrapping_sub(point);
        digits = digits.wrapping_add(decimals);
    }
    if digits == 0 {
        return None;
    }
    // Fifteen digits are below 2^53, so mantissa and power are exact and the division rounds correctly.
    let size = match TENS.get(decimals) {
        Some(&power) if digits <= 15 => mantissa as f64 / power,
        _ => read_long(text.get(digits_start..index)?)?,
    };
    Some((if negative { -size } else { size }, index))
}

/// Appends the digits at `index` to `mantissa`; returns where they end.
#[inline(always)]
fn take_digits(text: &[u8], mut index: usize, mantissa: &mut u64) -> usize {
    while let Some(&byte) = text.get(index) {
        let digit = byte.wrapping_sub(b'0');
        if digit >= 10 {
            break;
        }
        *mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        index = index.wrapping_add(1);
    }
    index
}

/// The slow way, for numbers that were computed and printed with all their digits.
#[cold]
fn read_long(digits: &[u8]) -> Option<f64> {
    let value: f64 = str::from_utf8(digits).ok()?.parse().ok()?;
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_read_to_its_end() {
        assert_eq!(read_number(b"12", 0), Some((12.0, 2)));
        assert_eq!(read_number(b"X-.5Y", 1), Some((-0.5, 4)));
        assert_eq!(read_number(b"3.", 0), Some((3.0, 2)));
        assert_eq!(read_number(b"+2 ", 0), Some((2.0, 2)));
        assert_eq!(read_number(b"1E5", 0), Some((1.0, 1)));
        assert_eq!(read_number(b"1.2.3", 0), Some((1.2, 3)));
        assert_eq!(read_number(b"0.1234567890123456789", 0), Some((0.123_456_789_012_345_68, 21)));
    }

    #[test]
    fn no_digits_is_no_number() {
        for text in ["", "-", "+", ".", "-.", "--1", "+-1", "e", " 1"] {
            assert_eq!(read_number(text.as_bytes(), 0), None, "{text}");
        }
        assert_eq!(read_number(b"1", 5), None);
        assert_eq!(read_number("9".repeat(400).as_bytes(), 0), None, "too large");
    }
}
