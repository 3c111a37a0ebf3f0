//! The one printer and the one reader of numbers.
//!
//! A number is an integer and a count of decimal places. It is printed with the places it needs, at least one
//! (`10.0`, `0.125`), never with an exponent and never as `-0.0`. The reader is more generous: `+2`, `.5`, `3.`,
//! trailing zeros. Digits beyond the places are rounded, halves away from zero.

/// Appends `value` / 10^`places` in canonical form.
///
/// ```
/// let mut text = Vec::new();
/// unit::decimal::write(&mut text, -12_500, 3);
/// assert_eq!(text, b"-12.5");
/// ```
#[inline]
pub fn write(out: &mut Vec<u8>, value: i64, places: u32) {
    write_at_least(out, value, places, 1);
}

/// Like [`write`], but an integral value is printed without a decimal point: the short form of G-code.
#[inline]
pub fn write_short(out: &mut Vec<u8>, value: i64, places: u32) {
    write_at_least(out, value, places, 0);
}

const POWERS: [u64; 10] =
    [1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000, 1_000_000_000];

/// The three digits of every number below a thousand.
const DIGITS: [[u8; 3]; 1000] = {
    let mut table = [[b'0'; 3]; 1000];
    let mut number = 0;
    while number < 1000 {
        table[number] =
            [b'0' + (number / 100) as u8, b'0' + (number / 10 % 10) as u8, b'0' + (number % 10) as u8];
        number += 1;
    }
    table
};

#[inline]
fn write_at_least(out: &mut Vec<u8>, value: i64, places: u32, least: u32) {
    let magnitude = value.unsigned_abs();
    if places == 3 && magnitude < 1_000_000 {
        return write_small(out, value < 0, magnitude as u32, least);
    }
    let mut buffer = [0u8; 32];
    let mut at = buffer.len();
    let (whole, fraction) = match places {
        // Constants divide faster than variables.
        5 => (magnitude / 100_000, magnitude % 100_000),
        _ => (magnitude / POWERS[places as usize], magnitude % POWERS[places as usize]),
    };
    let mut fraction = fraction;
    let mut left = places;
    while left > least && fraction.is_multiple_of(10) {
        fraction /= 10;
        left -= 1;
    }
    if left > 0 {
        for _ in 0..left {
            at -= 1;
            buffer[at] = b'0' + (fraction % 10) as u8;
            fraction /= 10;
        }
        at -= 1;
        buffer[at] = b'.';
    }
    let mut whole = whole;
    loop {
        at -= 1;
        buffer[at] = b'0' + (whole % 10) as u8;
        whole /= 10;
        if whole == 0 {
            break;
        }
    }
    if value < 0 {
        at -= 1;
        buffer[at] = b'-';
    }
    out.extend_from_slice(&buffer[at..]);
}

/// Three places and less than a metre: nearly every coordinate there is.
#[inline]
fn write_small(out: &mut Vec<u8>, negative: bool, thousandths: u32, least: u32) {
    let (whole, fraction) = ((thousandths / 1000) as usize, (thousandths % 1000) as usize);
    let leading = 3 - usize::from(whole >= 100) - usize::from(whole >= 10) - 1;
    let places = match fraction {
        0 => least as usize,
        _ if fraction.is_multiple_of(100) => 1,
        _ if fraction.is_multiple_of(10) => 2,
        _ => 3,
    };
    let ([a, b, c], [d, e, f]) = (DIGITS[whole], DIGITS[fraction]);
    // Written as a block of fixed size and cut, which is faster than copying just as many bytes as there are.
    let block = u64::from_le_bytes([a, b, c, b'.', d, e, f, 0]) >> (8 * leading);
    if negative {
        out.push(b'-');
    }
    out.extend_from_slice(&block.to_le_bytes());
    let kept = 3 - leading + if places > 0 { 1 + places } else { 0 };
    out.truncate(out.len() - 8 + kept);
}

/// The number at the start of `text` as an integer of 10^-`places`, and how many bytes it took.
///
/// `None` when no number stands there or when it does not fit. Both a comma and an exponent end the number, so
/// that a caller who wants the whole word must compare the length.
#[inline]
pub fn read_prefix(text: &[u8], places: u32) -> Option<(i64, usize)> {
    let negative = text.first() == Some(&b'-');
    let mut at = usize::from(negative || text.first() == Some(&b'+'));
    let start = at;
    let mut value: i64 = 0;
    while let Some(digit) = text.get(at).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit < 10) {
        value = value.checked_mul(10)?.checked_add(i64::from(digit))?;
        at += 1;
    }
    let mut digits = at - start;
    let mut left = places;
    if text.get(at) == Some(&b'.') {
        at += 1;
        let mut round_up = None;
        while let Some(digit) = text.get(at).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit < 10) {
            if left > 0 {
                value = value.checked_mul(10)?.checked_add(i64::from(digit))?;
                left -= 1;
            } else if round_up.is_none() {
                round_up = Some(digit >= 5);
            }
            at += 1;
            digits += 1;
        }
        value = value.checked_add(i64::from(round_up == Some(true)))?;
    }
    if digits == 0 {
        return None;
    }
    while left > 0 {
        value = value.checked_mul(10)?;
        left -= 1;
    }
    Some((if negative { -value } else { value }, at))
}

/// The whole of `text` as an integer of 10^-`places`.
///
/// ```
/// assert_eq!(unit::decimal::read(b"1.5", 3), Some(1500));
/// assert_eq!(unit::decimal::read(b"1.5mm", 3), None);
/// ```
pub fn read(text: &[u8], places: u32) -> Option<i64> {
    read_prefix(text, places).filter(|(_, length)| *length == text.len()).map(|(value, _)| value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_small_number_has_one_spelling_that_reads_back() {
        for value in (-1_002_000..1_002_000).step_by(7).chain([
            -1,
            0,
            1,
            10,
            100,
            999_999,
            1_000_000,
            i64::MAX,
            i64::MIN + 1,
        ]) {
            for places in [3, 5, 6] {
                let (mut text, mut short) = (Vec::new(), Vec::new());
                write(&mut text, value, places);
                write_short(&mut short, value, places);
                let plain = String::from_utf8_lossy(&text).into_owned();
                assert_eq!(read(&text, places), Some(value), "{plain}");
                assert_eq!(read(&short, places), Some(value), "{plain}");
                assert!(plain.contains('.') && (plain.ends_with(".0") || !plain.ends_with('0')), "{plain}");
                assert_eq!(plain.strip_suffix(".0").unwrap_or(&plain).as_bytes(), short);
            }
        }
    }
}
