//! Whether the print is over.

use gcode::{Code, Line};

/// What ends a print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// The motors are off: nobody knows where the nozzle is.
    MotorsOff,
    /// The program is over: the machine reads no further.
    Program,
    /// Z was homed behind printing.
    Homed,
}

impl End {
    /// The end that `line` makes of a print that has begun.
    pub(crate) fn of(line: &Line) -> Option<Self> {
        let words = &line.words;
        let has_words = words.iter().next().is_some() || words.has_bare();
        let named = |letter| words.has(letter) || words.is_bare(letter);
        let command = line.command?;
        if command == Code::m(84) || command == Code::m(18) {
            // With S it is a time to wait for, and E alone is no axis of the nozzle.
            let axes = !has_words || [b'X', b'Y', b'Z'].into_iter().any(named);
            (axes && !named(b'S')).then_some(Self::MotorsOff)
        } else if command == Code::m(2) || command == Code::m(30) {
            // With words behind it `M30` deletes a file.
            (!has_words).then_some(Self::Program)
        } else if command == Code::g(28) {
            (named(b'Z') || ![b'X', b'Y'].into_iter().any(named)).then_some(Self::Homed)
        } else {
            None
        }
    }

    /// What was done, for a sentence.
    pub(crate) fn said(self) -> &'static str {
        match self {
            Self::MotorsOff => "after the motors were switched off",
            Self::Program => "after the program has ended",
            Self::Homed => "after Z was homed with the pot standing there",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_ends_a_print_and_what_does_not() {
        let end = |text: &str| End::of(&Line::of(text.as_bytes()));
        for text in ["M84", "M18", "M84 X Y E", "m84 ; done"] {
            assert_eq!(end(text), Some(End::MotorsOff), "{text}");
        }
        for text in ["M84 S60", "M84 E", "M30 POT.GCO", "G28 X", "G28 X0 Y0", "M0", "G1 Z50", ""] {
            assert_eq!(end(text), None, "{text}");
        }
        assert_eq!(end("M2"), Some(End::Program));
        assert_eq!(end("M30"), Some(End::Program));
        assert_eq!(end("G28"), Some(End::Homed));
        assert_eq!(end("G28 Z0"), Some(End::Homed));
    }
}
