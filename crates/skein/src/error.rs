use std::fmt;

/// Why a document, a setting or a file was refused: what, where, why, and what helps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The stage or the file that is talking; filled in by whoever runs the stage.
    pub what: String,
    /// Where in its *input*.
    pub place: Place,
    /// What is so, in words for a potter.
    pub message: String,
    /// What helps.
    pub hint: Option<String>,
}

/// A place in the input of a stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The input as a whole.
    Whole,
    /// A line, counted from one.
    Line(usize),
    /// A layer, counted from zero at the bottom.
    Layer(usize),
    /// A line and a column, counted from one.
    Text {
        /// Line.
        line: usize,
        /// Column, in characters.
        column: usize,
    },
    /// Anything else, spelled out.
    At(String),
}

impl Error {
    /// An error about the input as a whole.
    pub fn new(message: impl Into<String>) -> Self {
        Self { what: String::new(), place: Place::Whole, message: message.into(), hint: None }
    }

    /// An error in the line with this index (counted from zero).
    pub fn line(index: usize, message: impl Into<String>) -> Self {
        Self::new(message).at(Place::Line(index + 1))
    }

    /// An error in a layer.
    pub fn layer(index: usize, message: impl Into<String>) -> Self {
        Self::new(message).at(Place::Layer(index))
    }

    /// The same error at a place.
    pub fn at(mut self, place: Place) -> Self {
        self.place = place;
        self
    }

    /// The same error, about a layer unless it knows a nearer place.
    pub fn in_layer(self, index: usize) -> Self {
        if self.place == Place::Whole { self.at(Place::Layer(index)) } else { self }
    }

    /// The same error with advice.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// The same error, said by `what`, unless somebody further in has already spoken.
    pub fn said_by(mut self, what: &str) -> Self {
        if self.what.is_empty() {
            self.what = what.to_owned();
        }
        self
    }
}

impl fmt::Display for Error {
    /// `what: where: why`, without the hint.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.what.is_empty() {
            write!(f, "{}: ", self.what)?;
        }
        match &self.place {
            Place::Whole => {}
            Place::Line(line) => write!(f, "line {line}: ")?,
            Place::Layer(layer) => write!(f, "layer {layer}: ")?,
            Place::Text { line, column } => write!(f, "{line}:{column}: ")?,
            Place::At(place) => write!(f, "{place}: ")?,
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}
