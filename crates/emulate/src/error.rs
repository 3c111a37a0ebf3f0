//! Why an emulation, a table or a picture was refused.

use crate::motion::MotionError;
use std::fmt;

/// What, where, why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The line of the program, counted from one, if one is meant.
    pub line: Option<u32>,
    /// What is so.
    pub message: String,
    /// What helps.
    pub hint: Option<String>,
}

impl Error {
    /// An error about the whole.
    pub fn new(message: impl Into<String>) -> Self {
        Self { line: None, message: message.into(), hint: None }
    }

    /// The same error with advice.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// What a planner has to say about the move of a line.
    pub(crate) fn of_motion(error: MotionError, line: Option<u32>) -> Self {
        Self { line, message: error.message, hint: None }
    }
}

impl From<MotionError> for Error {
    fn from(error: MotionError) -> Self {
        Self::new(error.to_string())
    }
}

impl From<std::io::Error> for Error {
    fn from(error: std::io::Error) -> Self {
        Self::new(error.to_string())
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}
