//! Cuts a text into lines, whatever ends them.

/// The first line of `text` and what is behind it. LF, CR, CR LF and LF CR end a line, each once.
pub(crate) fn cut_line(text: &[u8]) -> (&[u8], &[u8]) {
    let Some(end) = find_end(text) else { return (text, &[]) };
    let (line, rest) = text.split_at(end);
    let rest = match rest {
        [b'\r', b'\n', rest @ ..] => rest,
        [b'\n', rest @ ..] => behind_stray_cr(rest),
        [_, rest @ ..] => rest,
        [] => rest,
    };
    (line, rest)
}

/// What is behind the CR of an LF CR; a CR LF is a line end of its own.
#[inline(always)]
pub(crate) fn behind_stray_cr(rest: &[u8]) -> &[u8] {
    match rest {
        [b'\r', after @ ..] if after.first() != Some(&b'\n') => after,
        _ => rest,
    }
}

/// Where the first LF or CR stands. Looks at eight bytes at a time, as [`find_byte`](crate::find_byte) does.
fn find_end(text: &[u8]) -> Option<usize> {
    const ONES: u64 = 0x0101_0101_0101_0101;
    const HIGHS: u64 = ONES << 7;
    const LINE_FEEDS: u64 = ONES * b'\n' as u64;
    const RETURNS: u64 = ONES * b'\r' as u64;
    let zeros = |bytes: u64| bytes.wrapping_sub(ONES) & !bytes & HIGHS;
    let (eights, tail) = text.as_chunks::<8>();
    for (number, eight) in eights.iter().enumerate() {
        let bytes = u64::from_le_bytes(*eight);
        let ends = zeros(bytes ^ LINE_FEEDS) | zeros(bytes ^ RETURNS);
        if ends != 0 {
            return Some(number * 8 + ends.trailing_zeros() as usize / 8);
        }
    }
    let index = tail.iter().position(|byte| matches!(byte, b'\n' | b'\r'))?;
    Some(eights.len() * 8 + index)
}

/// How many bytes of `block` are whole lines, so that the rest belongs to what is read next. A CR at the very end may
/// be half a line end.
///
/// ```
/// assert_eq!(gcode::whole_lines(b"G1 X5\nG1 X"), 6);
/// assert_eq!(gcode::whole_lines(b"G1 X5\r\nG1\r"), 7);
/// ```
pub fn whole_lines(block: &[u8]) -> usize {
    let sure = block.strip_suffix(b"\r").unwrap_or(block);
    sure.iter().rposition(|byte| matches!(byte, b'\n' | b'\r')).map_or(0, |index| index + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_end_counts_once() {
        let cut = |text: &'static str| {
            let mut rest = text.as_bytes();
            let mut lines = Vec::new();
            while !rest.is_empty() {
                let (line, behind) = cut_line(rest);
                lines.push(str::from_utf8(line).expect("text"));
                rest = behind;
            }
            lines
        };
        assert_eq!(cut("a\nb"), ["a", "b"]);
        assert_eq!(cut("a\r\nb\r\n"), ["a", "b"]);
        assert_eq!(cut("a\rb\r"), ["a", "b"]);
        assert_eq!(cut("a\n\rb\n\r"), ["a", "b"]);
        assert_eq!(cut("a\n\nb"), ["a", "", "b"]);
        assert_eq!(cut("a\r\rb"), ["a", "", "b"]);
        assert_eq!(cut("a\n\r\nb"), ["a", "", "b"]);
        assert_eq!(cut("0123456789abcdef\r0123456"), ["0123456789abcdef", "0123456"]);
    }
}
