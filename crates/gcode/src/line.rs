//! One line: blank, comment or code, and what the code says.

use crate::token::{Token, Tokens};
use crate::word::{Code, Words};

/// What a line is to the reader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// Neither code nor a remark.
    #[default]
    Blank,
    /// A remark, or the `%` that begins and ends a tape, and no code.
    Comment,
    /// Anything else, readable or not.
    Code,
}

/// A line as it was read. Made once and read again for every line of a text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// What the line is.
    pub kind: Kind,
    /// The first word, if it is a letter with a number; `N10` before it is skipped.
    pub command: Option<Code>,
    /// The words after the command. A line without a command has no words.
    pub words: Words,
    /// Whether something was skipped that is neither word nor remark.
    pub unreadable: bool,
}

impl Line {
    /// The line that `text` spells. `text` has no line end; [`lines`](crate::lines()) cuts it so.
    pub fn of(text: &[u8]) -> Self {
        let mut line = Self::default();
        line.read(text);
        line
    }

    /// Becomes the line that `text` spells.
    #[inline]
    pub fn read(&mut self, text: &[u8]) {
        self.kind = Kind::Blank;
        self.command = None;
        self.unreadable = false;
        self.words.clear();

        // Nearly all that is no move is a comment, and is told by its first byte.
        if text.first() == Some(&b';') {
            return self.kind = Kind::Comment;
        }
        let mut tokens = Tokens::new(text);
        if let Some((letter, value)) = tokens.plain_word()
            && letter != b'N'
            && let Some(command) = Code::new(letter, value)
        {
            self.kind = Kind::Code;
            self.command = Some(command);
            return self.read_words(tokens);
        }
        self.read_odd(text);
    }

    /// Reads a line that does not begin with a plain command.
    fn read_odd(&mut self, text: &[u8]) {
        let mut tokens = Tokens::new(text);
        let mut remarked = false;
        while let Some(token) = tokens.next() {
            match token {
                Token::Remark { .. } => remarked = true,
                Token::Checksum { .. } => {}
                Token::Word { letter: b'N', value: Some(_), .. } if self.kind == Kind::Blank => {
                    self.kind = Kind::Code
                }
                Token::Word { letter, value: Some(value), .. } => {
                    self.kind = Kind::Code;
                    self.command = Code::new(letter, value);
                    if self.command.is_some() {
                        return self.read_words(tokens);
                    }
                    return self.unreadable = true;
                }
                Token::Other { start, end }
                    if text.get(start..end) == Some(b"%") && only_remarks(tokens.clone()) =>
                {
                    remarked = true;
                }
                Token::Word { .. } | Token::Other { .. } => {
                    self.kind = Kind::Code;
                    return self.unreadable = true;
                }
            }
        }
        if remarked && self.kind == Kind::Blank {
            self.kind = Kind::Comment;
        }
    }

    #[inline]
    fn read_words(&mut self, mut tokens: Tokens<'_>) {
        // Nearly every word is a letter with its number right behind it.
        while let Some((letter, value)) = tokens.plain_word() {
            self.words.put(letter, value);
        }
        if !tokens.is_done() {
            self.read_odd_words(tokens);
        }
    }

    #[cold]
    fn read_odd_words(&mut self, tokens: Tokens<'_>) {
        for token in tokens {
            match token {
                Token::Word { letter, value: Some(value), .. } => self.words.put(letter, value),
                Token::Word { letter, value: None, .. } => self.words.put_bare(letter),
                Token::Other { .. } => self.unreadable = true,
                Token::Remark { .. } | Token::Checksum { .. } => {}
            }
        }
    }
}

/// Whether nothing of the code is left, so that a `%` stands alone.
#[cold]
fn only_remarks(mut tokens: Tokens<'_>) -> bool {
    tokens.all(|token| matches!(token, Token::Remark { .. } | Token::Checksum { .. }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(text: &str) -> Kind {
        Line::of(text.as_bytes()).kind
    }

    #[test]
    fn blank_comment_or_code() {
        assert_eq!(kind(""), Kind::Blank);
        assert_eq!(kind(" \t\r"), Kind::Blank);
        assert_eq!(kind("*71"), Kind::Blank);
        assert_eq!(kind(";"), Kind::Comment);
        assert_eq!(kind("  ; a"), Kind::Comment);
        assert_eq!(kind("(a)"), Kind::Comment);
        assert_eq!(kind("(a"), Kind::Comment);
        assert_eq!(kind("*71 ; a"), Kind::Comment);
        assert_eq!(kind(" % "), Kind::Comment);
        assert_eq!(kind("% ; a"), Kind::Comment);
        assert_eq!(kind("%%"), Kind::Code);
        assert_eq!(kind("% 5"), Kind::Code);
        assert_eq!(kind("N5"), Kind::Code);
        assert_eq!(kind("N5 ; a"), Kind::Code);
        assert_eq!(kind("G"), Kind::Code);
        assert_eq!(kind("é"), Kind::Code);
        assert_eq!(kind("START_PRINT BED=5"), Kind::Code);
    }

    #[test]
    fn the_first_word_is_the_command() {
        for text in
            ["G1", "g1", "G01", "G1.0", "G 1", "G+1", "N7 G1", "n7g1*12", "(a) G1", "G1(a)", "G1X", "g1 ;"]
        {
            assert_eq!(Line::of(text.as_bytes()).command, Some(Code::g(1)), "{text}");
        }
        for text in ["", ";G1", "(G1)", "/G1", "START G1", "G", "G.", "G1.00001", "G99999999999", "N1 N2 G1"]
        {
            assert_ne!(Line::of(text.as_bytes()).command, Some(Code::g(1)), "{text}");
        }
        assert_eq!(Line::of(b"G91.1").command, Code::new(b'G', 91.1));
        assert_ne!(Line::of(b"G91.1").command, Some(Code::g(91)));
        assert_eq!(Line::of(b"G10 X1").command, Some(Code::g(10)));
        assert_eq!(Line::of(b"T-1").command, Code::new(b'T', -1.0));
    }

    #[test]
    fn words_follow_the_command() {
        let line = Line::of(b"G1x-.5Y3. Z +2 e (why) 4 Y9 F;S1");
        let words: Vec<_> = line.words.iter().collect();
        assert_eq!(words, [(b'E', 4.0), (b'X', -0.5), (b'Y', 3.0), (b'Z', 2.0)]);
        assert!(line.words.is_bare(b'F'));
        assert!(!line.unreadable);
    }

    #[test]
    fn what_cannot_be_read_is_skipped_and_told() {
        let line = Line::of(b"G1 X1.2.3 Y-- Z5 \xff E1*9 F7");
        assert_eq!(line.words.get(b'X'), Some(1.2));
        assert_eq!(line.words.get(b'Y'), None);
        assert!(line.words.is_bare(b'Y'));
        assert_eq!(line.words.get(b'Z'), Some(5.0));
        assert_eq!(line.words.get(b'E'), Some(1.0));
        assert_eq!(line.words.get(b'F'), None, "a checksum ends the code");
        assert!(line.unreadable);
    }

    #[test]
    fn a_line_read_again_forgets_the_last() {
        let mut line = Line::of(b"G1 X1 Y E? Z4");
        line.read(b"G0 Z5");
        assert_eq!(line, Line::of(b"G0 Z5"));
        line.read(b"");
        assert_eq!(line, Line::default());
    }
}
