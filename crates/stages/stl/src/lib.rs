#![doc = include_str!("../README.md")]

mod binary;
mod error;
mod text;
mod weld;

pub use error::{Place, StlError, StlErrorKind};

use shape::TriangleMesh;

/// Reads the bytes of an STL file, text or binary.
///
/// ```
/// let error = stl::read(b"").unwrap_err();
/// assert_eq!(error.to_string(), "the file is empty");
/// ```
pub fn read(bytes: &[u8]) -> Result<Import, StlError> {
    if bytes.is_empty() {
        return Err(StlError::new(
            StlErrorKind::Empty,
            Place::File,
            "the file is empty",
            "save or download it again",
        ));
    }
    if binary::has_exact_length(bytes) {
        return binary::read(bytes);
    }
    if let Some(error) = error::foreign(bytes) {
        return Err(error);
    }
    if text::looks_like_text(bytes) { text::read(bytes) } else { binary::read(bytes) }
}

/// A part as it was read, and what is worth knowing about the reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Import {
    /// The part, where the file has it: it is not moved.
    pub mesh: TriangleMesh,
    /// What was found and what was repaired.
    pub report: Report,
}

/// The two kinds of STL.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Words and decimal numbers.
    #[default]
    Text,
    /// Records of fifty bytes.
    Binary,
}

/// What the reader found and what it repaired.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Text or binary.
    pub format: Format,
    /// Facets in the file.
    pub facets: usize,
    /// Facets left out because two of their corners are the same point in whole microns.
    pub degenerate: usize,
    /// What a binary file promises, when it is not what it holds.
    pub promised: Option<u32>,
    /// Bytes after the last facet of a binary file.
    pub trailing: usize,
    /// Numbers of a text file written with a comma.
    pub decimal_commas: usize,
    /// Lines of a text file, outside of facets, that mean nothing to an STL reader.
    pub ignored_lines: usize,
    /// Solids of a text file; a binary file is always one.
    pub solids: usize,
}

impl Report {
    /// The repairs as sentences, one for each kind; none for a file that needed none.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.degenerate > 0 {
            notes.push(format!(
                "{} of {} facets have no area and were left out",
                self.degenerate, self.facets
            ));
        }
        if let Some(promised) = self.promised {
            notes.push(format!(
                "the header promises {promised} facets, the file holds {}: all were read",
                self.facets
            ));
        }
        if self.trailing > 0 {
            notes.push(format!("{} bytes after the last facet were ignored", self.trailing));
        }
        if self.decimal_commas > 0 {
            notes.push(format!("{} numbers with a decimal comma were read as decimals", self.decimal_commas));
        }
        if self.ignored_lines > 0 {
            notes.push(format!(
                "{} lines between the facets were not understood and ignored",
                self.ignored_lines
            ));
        }
        notes
    }
}
