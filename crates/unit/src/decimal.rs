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

/// Two digits at a time halve the divisions.
const PAIRS: &[u8; 200] = b"0001020304050607080910111213141516171819\
2021222324252627282930313233343536373839\
4041424344454647484950515253545556575859\
6061626364656667686970717273747576777879\
8081828384858687888990919293949596979899";

#[inline]
fn write_at_least(out: &mut Vec<u8>, value: i64, places: u32, least: u32) {
    let mut buffer = [0u8; 32];
    let mut at = buffer.len();
    let magnitude = value.unsigned_abs();
    let (whole, fraction) = match places {
        // Constants divide faster than variables; three places are nearly all there is.
        3 => (magnitude / 1000, magnitude % 1000),
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
    while whole >= 100 {
        let pair = (whole % 100) as usize * 2;
        whole /= 100;
        at -= 2;
        buffer[at..at + 2].copy_from_slice(&PAIRS[pair..pair + 2]);
    }
    if whole >= 10 {
        let pair = whole as usize * 2;
        at -= 2;
        buffer[at..at + 2].copy_from_slice(&PAIRS[pair..pair + 2]);
    } else {
        at -= 1;
        buffer[at] = b'0' + whole as u8;
    }
    if value < 0 {
        at -= 1;
        buffer[at] = b'-';
    }
    out.extend_from_slice(&buffer[at..]);
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
