//! Writes numbers as G-code has them.

/// Appends `value` with at most so many decimals (nine), without zeros at the end, without an exponent, and without a
/// minus before a zero.
pub(super) fn write_number(value: f64, decimals: u8, out: &mut Vec<u8>) {
    const TENS: [f64; 10] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];
    /// Above it a double has no decimals left to round.
    const EXACT: f64 = 9e15;
    let decimals = usize::from(decimals.min(9));
    let scaled = value * TENS.get(decimals).copied().unwrap_or(1e9);
    if scaled.abs() > EXACT {
        return out.extend_from_slice(format!("{value}").as_bytes());
    }
    // The cast is exact after rounding.
    let whole = scaled.round() as i64;
    if whole < 0 {
        out.push(b'-');
    }
    write_digits(whole.unsigned_abs(), decimals, out);
}

/// Appends `size`, of whose digits the last `decimals` stand behind the point.
fn write_digits(mut size: u64, mut decimals: usize, out: &mut Vec<u8>) {
    while decimals > 0 && size.is_multiple_of(10) {
        size /= 10;
        decimals -= 1;
    }
    let mut buffer = [b'0'; 24];
    let mut start = buffer.len();
    let mut written = 0;
    // One digit at least before the point.
    while size > 0 || written <= decimals {
        if written == decimals && decimals > 0 {
            start -= 1;
            buffer[start] = b'.';
        }
        start -= 1;
        buffer[start] = b'0' + (size % 10) as u8;
        size /= 10;
        written += 1;
    }
    out.extend_from_slice(&buffer[start..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_as_short_as_its_decimals_allow() {
        for (value, decimals, text) in [
            (0.0, 4, "0"),
            (-0.0, 4, "0"),
            (-0.00001, 4, "0"),
            (1.5, 4, "1.5"),
            (0.05, 4, "0.05"),
            (10.0, 4, "10"),
            (100.0, 0, "100"),
            (-2.12345, 4, "-2.1235"),
            (1e7, 4, "10000000"),
            (1e12, 9, "1000000000000"),
            (0.00004, 5, "0.00004"),
            (9_007_199_254_740_991.0, 0, "9007199254740991"),
        ] {
            let mut out = Vec::new();
            write_number(value, decimals, &mut out);
            assert_eq!(String::from_utf8_lossy(&out), text);
        }
    }
}
