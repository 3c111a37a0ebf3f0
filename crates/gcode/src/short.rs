//! Reads a short number in one go.
//!
//! Most of a file is numbers such as `123.456`. A loop over their digits costs some ten instructions and half a
//! mispredicted jump a digit, so reading numbers is most of what reading a file costs. A number that ends within eight
//! bytes is in one machine word: it is moved until its point stands at the fourth byte, and its digits are summed in
//! three multiplications, as if there were three before the point and four behind it.
//!
//! The law: what is read is what the loop over the digits reads, to the bit.

use std::num::NonZeroU64;

const ONES: u64 = 0x0101_0101_0101_0101;
const HIGHS: u64 = ONES << 7;
const ZEROS: u64 = ONES * b'0' as u64;
/// The high bit of the byte where the point is put.
const POINT: u32 = 31;
/// Lifts all bytes above 9 to the high bit.
const ABOVE_NINE: u64 = ONES * (0x80 - 10);

/// The short number without a sign that begins at `start` of `text`, and where it ends.
#[inline]
pub(crate) fn read_short(text: &[u8], start: usize) -> Option<(f64, usize)> {
    let (value, length) = short(*text.get(start..)?.first_chunk()?)?;
    Some((value, start.wrapping_add(length)))
}

/// The number without a sign that `bytes` begin with, and its length below 8. Nothing if it does not end there, or is
/// not short: of up to seven digits, or of up to three before a point and one to four behind it.
#[inline(always)]
pub(crate) fn short(bytes: [u8; 8]) -> Option<(f64, usize)> {
    let text = u64::from_le_bytes(bytes);
    let digits = text ^ ZEROS;
    // The high bits of all bytes that are no digits, up to the first that is not ASCII: its sum may carry.
    let others = (digits.wrapping_add(ABOVE_NINE) | digits) & HIGHS;
    let first = others.trailing_zeros();
    if (text >> (first & 56)) as u8 != b'.' {
        return whole(digits, first);
    }
    let behind = NonZeroU64::new(others & others.wrapping_sub(1))?;
    let end = behind.trailing_zeros();
    let decimals_and_point = end.wrapping_sub(first);
    if first > POINT || !(16..=40).contains(&decimals_and_point) {
        return None;
    }
    let up_to_end = behind.get() ^ behind.get().wrapping_sub(1);
    let placed = (digits & up_to_end >> 8) << (POINT - first) ^ u64::from(b'.' ^ b'0') << 24;
    // The point, now a zero, makes the front ten times as large. The mantissa has seven digits at most, so that it and
    // the power are exact and the division rounds correctly.
    Some((sum::<1_000>(placed) as f64 / 10_000.0, end as usize / 8))
}

/// The number without a point that ends at the high bit `first`, and its length.
#[inline(always)]
fn whole(digits: u64, first: u32) -> Option<(f64, usize)> {
    (8..64).contains(&first).then(|| (sum::<10_000>(digits << (71 - first)) as f64, first as usize / 8))
}

/// Sums eight decimal digits, the first of them in the lowest byte: neighbours to pairs, pairs to fours, and the front
/// four times `FRONT` to the whole.
#[inline(always)]
fn sum<const FRONT: u64>(digits: u64) -> i64 {
    const PAIRS: u64 = 0x00FF_00FF_00FF_00FF;
    const FOURS: u64 = 0x0000_FFFF_0000_FFFF;
    let pairs = digits.wrapping_mul(10 << 8 | 1) >> 8 & PAIRS;
    let fours = pairs.wrapping_mul(100 << 16 | 1) >> 16 & FOURS;
    (fours.wrapping_mul(FRONT << 32 | 1) >> 32) as i64
}
