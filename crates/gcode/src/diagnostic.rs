//! What is wrong with a program, and where.

use std::borrow::Cow;
use std::fmt;

/// A problem and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// The line of the file, counted from one.
    pub line: u32,
    /// The byte of the line, counted from one; 0 if the line as a whole is meant.
    pub column: u32,
    /// What is so.
    pub kind: Problem,
}

/// What can be wrong.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// Text that is neither word nor remark.
    Unreadable,
    /// A letter without a readable number.
    NoNumber(u8),
    /// A decimal comma. The value is not used.
    Comma(u8),
    /// A number beyond what a machine can reach. The value is not used.
    OutOfRange(u8),
    /// A number without a letter.
    NoLetter,
    /// A letter twice. The last counts.
    Repeated(u8),
    /// A word that its command has no use for.
    Unused(u8),
    /// The checksum is not that of the line.
    WrongChecksum {
        /// What stands behind the `*`.
        given: u32,
        /// What it should be.
        computed: u8,
    },
    /// A `*` without a number behind it.
    NoChecksum,
    /// A `(` within a remark.
    NestedRemark,
    /// A `(` that nothing closes on its line.
    OpenRemark,
    /// A zero byte in a line.
    NulByte,
    /// A line longer than the limit, in bytes. It is skipped.
    LineTooLong(u32),
    /// More lines than can be counted. The rest is skipped.
    TooManyLines,
    /// Words of axes, and no motion to use them.
    NoMotion,
    /// Two codes of which only one can be obeyed on a line. The last counts.
    Conflict {
        /// What is obeyed.
        used: u16,
        /// What is not.
        dropped: u16,
    },
    /// A feed that is not positive. The old one is kept.
    NoFeed,
    /// A dwell without a duration, or with a negative one.
    NoDuration,
    /// An arc without centre and radius.
    NoCentre,
    /// More words than a command can hold.
    TooMuch,
    /// What the dialect of the file does not have.
    NotInFlavor(Cow<'static, str>),
    /// What the preprocessor cannot do, or must not.
    Preprocess(Cow<'static, str>),
    /// What cannot be said in the dialect that is written.
    Unsayable(Cow<'static, str>),
    /// What the machine has to say.
    Machine(Cow<'static, str>),
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable => f.write_str("neither a word nor a remark"),
            Self::NoNumber(letter) => write!(f, "{} has no readable number", char::from(*letter)),
            Self::Comma(letter) => {
                write!(f, "{} has a decimal comma; write a point", char::from(*letter))
            }
            Self::OutOfRange(letter) => {
                write!(f, "{} is larger than any machine", char::from(*letter))
            }
            Self::NoLetter => f.write_str("a number without a letter"),
            Self::Repeated(letter) => write!(f, "{} stands twice; the last counts", char::from(*letter)),
            Self::Unused(letter) => write!(f, "nothing uses the word {}", char::from(*letter)),
            Self::WrongChecksum { given, computed } => {
                write!(f, "the checksum is {given}, and {computed} for this line; the line may be damaged")
            }
            Self::NoChecksum => f.write_str("a `*` without a checksum"),
            Self::NestedRemark => f.write_str("a `(` within a remark"),
            Self::OpenRemark => f.write_str("a `(` that nothing closes"),
            Self::NulByte => f.write_str("a zero byte"),
            Self::LineTooLong(limit) => write!(f, "a line longer than {limit} bytes, skipped"),
            Self::TooManyLines => f.write_str("more lines than can be counted; the rest is skipped"),
            Self::NoMotion => f.write_str("axes without a motion code"),
            Self::Conflict { used, dropped } => {
                write!(f, "G{} and G{} on one line; the last counts", Tenths(*dropped), Tenths(*used))
            }
            Self::NoFeed => f.write_str("a feed must be positive; the old one is kept"),
            Self::NoDuration => f.write_str("a dwell without a duration"),
            Self::NoCentre => f.write_str("an arc without centre or radius"),
            Self::TooMuch => f.write_str("more words than a command can hold"),
            Self::NotInFlavor(text)
            | Self::Preprocess(text)
            | Self::Unsayable(text)
            | Self::Machine(text) => f.write_str(text),
        }
    }
}

/// A code in tenths, as it is written: 921 is `92.1`.
pub(crate) struct Tenths(pub u16);

impl fmt::Display for Tenths {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 % 10 {
            0 => write!(f, "{}", self.0 / 10),
            rest => write!(f, "{}.{rest}", self.0 / 10),
        }
    }
}

impl fmt::Display for Diagnostic {
    /// `line 3, column 5: what is so`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.column {
            0 => write!(f, "line {}: {}", self.line, self.kind),
            column => write!(f, "line {}, column {column}: {}", self.line, self.kind),
        }
    }
}

impl std::error::Error for Diagnostic {}

/// The diagnostics of a program: the first thousand, and how many there were.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    count: u64,
}

impl Diagnostics {
    /// How many are kept; a file in the wrong dialect has one a line.
    pub const KEPT: usize = 1000;

    /// Adds one.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.count = self.count.saturating_add(1);
        if self.list.len() < Self::KEPT {
            self.list.push(diagnostic);
        }
    }

    /// Adds those of `other`.
    pub fn append(&mut self, other: Self) {
        let dropped = other.count.saturating_sub(other.list.len() as u64);
        other.list.into_iter().for_each(|diagnostic| self.push(diagnostic));
        self.count = self.count.saturating_add(dropped);
    }

    /// Those that are kept, in the order in which they were found.
    pub fn list(&self) -> &[Diagnostic] {
        &self.list
    }

    /// How many there were.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Whether there were none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
}
