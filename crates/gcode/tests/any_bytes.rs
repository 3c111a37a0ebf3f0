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

/// Lines that are plain and lines that nearly are.
fn nearly_plain() -> impl Strategy<Value = String> {
    let number = prop_oneof![
        4 => "-?[0-9]{1,4}[.][0-9]{1,5}",
        2 => "[0-9]{1,8}",
        1 => "[-+]{0,2}[0-9]{0,18}[.]?[0-9]{0,18}",
    ];
    let word = (prop_oneof![8 => "[A-Z]", 1 => "[a-z;*(%]"], number, prop_oneof![9 => "", 1 => "[ \t\r.é]"]);
    let words = prop::collection::vec(word, 0..6);
    (prop_oneof![4 => "G1", 1 => "[gGMN][0-9]{0,2}"], words).prop_map(|(mut line, words)| {
        for (letter, number, odd) in words {
            line.extend([" ", &letter, &number, &odd]);
        }
        line
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn a_plain_line_is_the_line_that_is_read(
        before in nearly_plain(),
        text in nearly_plain(),
        rest in "(|\nG1 X1 Y2 Z3 E4 F5\n|G1 X\n|[^\n]{0,9})",
    ) {
        let whole = format!("{text}\n{rest}");
        let mut line = Line::of(before.as_bytes());
        if let Some(length) = line.read_plain(whole.as_bytes()) {
            prop_assert_eq!(length, text.len() + 1);
            prop_assert_eq!(&line, &Line::of(text.as_bytes()));
        }
        prop_assert_eq!(line.read_plain(text.as_bytes()), None, "it has no end");
        line.read(text.as_bytes());
        prop_assert_eq!(line, Line::of(text.as_bytes()));
    }

    #[test]
    fn any_bytes_are_no_plain_line_that_is_not_read_so(
        text in prop::collection::vec(prop::sample::select(&b"GXYE019.- \n\xb0\x00"[..]), 0..30),
    ) {
        let text = [b"G1 X", &text[..], b"\n"].concat();
        let mut line = Line::default();
        if let Some(length) = line.read_plain(&text) {
            prop_assert_eq!(Some(line), lines(&text).next().map(Line::of));
            prop_assert_eq!(Some(length - 1), text.iter().position(|&byte| byte == b'\n'));
        }
    }

    #[test]
    fn numbers_are_the_nearest_doubles_whatever_follows(
        digits in "-?[0-9]{0,8}[.]?[0-9]{0,6}",
        rest in prop::collection::vec(any::<u8>(), 0..9),
    ) {
        prop_assume!(!matches!(rest.first(), Some(b'0'..=b'9' | b'.')));
        let expected: Option<f64> = digits.parse().ok();
        let text = [digits.as_bytes(), &rest].concat();
        let sign_alone = digits.is_empty() && matches!(rest.first(), Some(b'-' | b'+'));
        prop_assume!(!sign_alone);
        let found = read_number(&text, 0);
        prop_assert_eq!(found.map(|(value, _)| value.to_bits()), expected.map(f64::to_bits));
        prop_assert!(found.is_none_or(|(_, end)| end == digits.len()));
    }
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
