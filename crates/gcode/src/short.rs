//! Reads a short number in one go.
//!
//! Most of a file is numbers such as `123.456`. A loop over their digits costs some ten instructions and half a
//! mispredicted jump a digit, so the reading of numbers is most of what the reading of a file costs. A number that ends
//! within eight bytes is in one machine word: its point is found, taken out, and its digits are summed in three
//! multiplications, whatever their count. What is read is what the loop over the digits reads, to the bit.

use crate::number::TENS;

const ONES: u64 = 0x0101_0101_0101_0101;
const HIGHS: u64 = ONES << 7;
const ZEROS: u64 = ONES * b'0' as u64;
/// Lifts all bytes above 9 to the high bit.
const ABOVE_NINE: u64 = ONES * (0x80 - 10);

/// The number without a sign that begins at `start` of `text` and where it ends, if both the number and one more byte
/// are among the eight bytes there.
#[inline(always)]
pub(crate) fn read_short(text: &[u8], start: usize) -> Option<(f64, usize)> {
    let (value, length) = short(eight_at(text, start)?)?;
    Some((value, start.wrapping_add(length)))
}

/// Eight bytes, the first of them lowest.
#[inline(always)]
fn eight_at(text: &[u8], start: usize) -> Option<u64> {
    text.get(start..)?.first_chunk().map(|eight| u64::from_le_bytes(*eight))
}

/// The number without a sign that `eight` begins with, and its length. Nothing if it does not end there.
#[inline(always)]
fn short(eight: u64) -> Option<(f64, usize)> {
    let digits = eight ^ ZEROS;
    // The high bits of all bytes that are no digits, up to the first that is not ASCII: its sum may carry.
    let others = (digits.wrapping_add(ABOVE_NINE) | digits) & HIGHS;
    let behind = others & others.wrapping_sub(1);
    let first = others ^ behind;
    let below_first = (first >> 7).wrapping_sub(1);
    let up_to_first = (first << 1).wrapping_sub(1);
    let point = first.trailing_zeros();
    if (eight >> (point & 56)) as u8 != b'.' {
        return whole(digits, first);
    }
    // The bits of the number with its point, and seven more.
    let end = behind.trailing_zeros();
    if !(16..64).contains(&end) {
        return None;
    }
    let joined = digits & below_first | (digits & !up_to_first) >> 8;
    let mantissa = sum(joined << (79 - end));
    let decimals = end.wrapping_sub(point) / 8;
    // At most six digits, so that mantissa and power are exact and the division rounds correctly.
    Some((mantissa as f64 / TENS[decimals.wrapping_sub(1) as usize & 15], end as usize / 8))
}

/// A number without a point, that ends at the bit `first`.
#[inline]
fn whole(digits: u64, first: u64) -> Option<(f64, usize)> {
    let end = first.trailing_zeros();
    (8..64).contains(&end).then(|| (sum(digits << (71 - end)) as f64, end as usize / 8))
}

/// The number that eight decimal digits make, the first of them in the lowest byte: sums neighbours to pairs, pairs to
/// fours, fours to the whole.
#[inline(always)]
fn sum(digits: u64) -> i64 {
    const PAIRS: u64 = 0x00FF_00FF_00FF_00FF;
    const FOURS: u64 = 0x0000_FFFF_0000_FFFF;
    let pairs = digits.wrapping_mul(10 << 8 | 1) >> 8 & PAIRS;
    let fours = pairs.wrapping_mul(100 << 16 | 1) >> 16 & FOURS;
    (fours.wrapping_mul(10_000 << 32 | 1) >> 32) as i64
}
