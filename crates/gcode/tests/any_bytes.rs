//! Laws of the reader that hold for every text.

use gcode::{Kind, Line, Token, Tokens, lines, read_number};
use proptest::prelude::*;

/// Bytes that mostly look like G-code, so that the odd corners are reached.
fn text() -> impl Strategy<Value = Vec<u8>> {
    let byte = prop_oneof![
        8 => prop::sample::select(&b"GMNXYZEgxFT0123456789.-+ \t;()*%\r\n"[..]),
        1 => any::<u8>(),
    ];
    prop::collection::vec(byte, 0..200)
}

proptest! {
    #[test]
    fn any_text_can_be_read(text in text()) {
        let mut line = Line::default();
        for piece in lines(&text) {
            line.read(piece);
            prop_assert_eq!(&line, &Line::of(piece));
            prop_assert!(line.command.is_none() || line.kind == Kind::Code);
            prop_assert!(line.words.iter().all(|(_, value)| value.is_finite()));
        }
    }

    #[test]
    fn lines_are_the_pieces_between_line_feeds(text in text()) {
        let mut pieces: Vec<&[u8]> = text.split(|&byte| byte == b'\n').collect();
        pieces.pop_if(|piece| piece.is_empty());
        let pieces: Vec<&[u8]> = pieces.iter().map(|piece| piece.strip_suffix(b"\r").unwrap_or(piece)).collect();
        prop_assume!(!text.starts_with(b"\xEF\xBB\xBF"));
        prop_assert_eq!(lines(&text).collect::<Vec<_>>(), pieces);
    }

    #[test]
    fn pieces_stand_in_order_inside_the_line(text in text()) {
        let mut reached = 0;
        for token in Tokens::new(&text) {
            let (Token::Word { start, end, .. }
                | Token::Remark { start, end }
                | Token::Checksum { start, end }
                | Token::Other { start, end }) = token;
            prop_assert!(reached <= start && start < end && end <= text.len());
            reached = end;
        }
    }

    #[test]
    fn numbers_are_the_nearest_doubles(digits in "[-+]?[0-9]{0,12}[.]?[0-9]{0,12}") {
        let expected: Option<f64> = digits.parse().ok();
        let found = read_number(digits.as_bytes(), 0).map(|(value, _)| value);
        prop_assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits));
    }
}
