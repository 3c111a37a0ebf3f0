//! Cuts a text into lines.

/// The lines of `text`, without their ends: split at LF, one CR before it dropped, a byte order mark ignored. An empty
/// last piece is no line.
pub fn lines(text: &[u8]) -> Lines<'_> {
    Lines { rest: without_bom(text) }
}

/// See [`lines`].
#[derive(Clone, Debug)]
pub struct Lines<'a> {
    rest: &'a [u8],
}

impl<'a> Iterator for Lines<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let end = find_byte(b'\n', self.rest).unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest.get(1..).unwrap_or_default();
        Some(without_cr(line))
    }
}

/// `text` without the UTF-8 byte order mark that some editors put in front.
pub fn without_bom(text: &[u8]) -> &[u8] {
    text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text)
}

/// `line` without one CR at its end.
#[inline]
pub fn without_cr(line: &[u8]) -> &[u8] {
    line.strip_suffix(b"\r").unwrap_or(line)
}

/// Where `byte` first stands in `text`. Looks at eight bytes at a time, since line ends are most of what a reader looks
/// for.
#[inline]
pub fn find_byte(byte: u8, text: &[u8]) -> Option<usize> {
    const ONES: u64 = 0x0101_0101_0101_0101;
    const HIGHS: u64 = 0x8080_8080_8080_8080;
    let wanted = ONES.wrapping_mul(u64::from(byte));
    let (eights, tail) = text.as_chunks::<8>();
    for (number, eight) in eights.iter().enumerate() {
        // A byte that is the wanted one is zero after the xor; the subtraction borrows into its high bit first there.
        let differs = u64::from_le_bytes(*eight) ^ wanted;
        let zeros = differs.wrapping_sub(ONES) & !differs & HIGHS;
        if zeros != 0 {
            return Some(number * 8 + zeros.trailing_zeros() as usize / 8);
        }
    }
    let index = tail.iter().position(|&found| found == byte)?;
    Some(eights.len() * 8 + index)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_at_line_feeds() {
        let cut = |text: &'static str| lines(text.as_bytes()).collect::<Vec<_>>();
        assert!(cut("").is_empty());
        assert!(cut("\u{feff}").is_empty());
        assert_eq!(cut("\n"), [b""]);
        assert_eq!(cut("a"), [b"a"]);
        assert_eq!(cut("a\n\nb\n"), [&b"a"[..], b"", b"b"]);
        assert_eq!(cut("\u{feff}a\r\nb\r\r\nc\rd\r"), [&b"a"[..], b"b\r", b"c\rd"]);
    }

    #[test]
    fn a_byte_is_found_where_it_first_stands() {
        let text: Vec<u8> = (0..=255).collect();
        for start in 0..=32 {
            for byte in 0..=255_u8 {
                let part = &text[start..];
                assert_eq!(find_byte(byte, part), part.iter().position(|&found| found == byte));
            }
        }
        assert_eq!(find_byte(0, &[1, 0, 1, 0]), Some(1));
        assert_eq!(find_byte(1, &[0, 0, 0, 0, 0, 0, 0, 1, 1]), Some(7));
    }
}
