//! Writes numbers as G-code has them.

use std::io::Write;

/// Appends `value` with at most so many decimals, without zeros at the end, without an exponent, and without a minus
/// before a zero.
pub(super) fn write_number(value: f64, decimals: u8, out: &mut Vec<u8>) {
    let start = out.len();
    // Writing to a vector does not fail.
    let _ = write!(out, "{value:.*}", usize::from(decimals));
    let written = out.get(start..).unwrap_or_default();
    if written.contains(&b'.') {
        let zeros = written.iter().rev().take_while(|&&byte| byte == b'0').count();
        out.truncate(out.len() - zeros);
        out.pop_if(|byte| *byte == b'.');
    }
    if out.get(start..) == Some(b"-0") {
        out.remove(start);
    }
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
            (10.0, 4, "10"),
            (100.0, 0, "100"),
            (-2.12345, 4, "-2.1235"),
            (1e7, 4, "10000000"),
            (0.00004, 5, "0.00004"),
        ] {
            let mut out = Vec::new();
            write_number(value, decimals, &mut out);
            assert_eq!(String::from_utf8_lossy(&out), text);
        }
    }
}
