use crate::Unit;
use std::fmt;

/// Why a file was refused: one sentence on what is so and where, and one on what helps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImportError {
    /// What is wrong, for programs.
    pub kind: ErrorKind,
    /// Where it is wrong.
    pub place: Place,
    /// What is wrong, for people, without the place.
    pub message: String,
    /// What helps.
    pub hint: String,
}

/// The kinds of trouble with a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// No bytes at all.
    Empty,
    /// A file of another kind: a picture, an archive, a web page, a drawing of another program.
    Foreign,
    /// None of the forms that are known.
    Unknown,
    /// The end is missing.
    Truncated,
    /// More data than the header promises, and no telling what it is.
    WrongCount,
    /// A word, tag or record where another belongs.
    Syntax,
    /// A facet with other than three corners, where the format has no others.
    NotATriangle,
    /// A coordinate that is no number or infinite.
    NotFinite,
    /// A coordinate beyond a kilometre.
    TooFar,
    /// A facet, an object or a part of the package that is not there.
    Missing,
    /// A file without facets, or a drawing without shapes.
    NoFacets,
    /// A drawing that says nowhere how high a layer is.
    NoHeight,
    /// Facets without an area only.
    NoArea,
    /// More than a part may have, or more than a file of its size can hold in earnest.
    TooLarge,
}

/// A place in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    File,
    /// A byte, counted from zero.
    Byte(usize),
    /// A line of a text file, counted from one.
    Line(usize),
    /// A facet of a binary file, counted from one, and the byte where its record starts.
    Facet {
        /// The number of the facet.
        number: usize,
        /// The first byte of its record.
        byte: usize,
    },
    /// A line of a file inside an archive, counted from one.
    Entry {
        /// The name of the file inside.
        name: String,
        /// The line.
        line: usize,
    },
}

impl ImportError {
    pub(crate) fn new(
        kind: ErrorKind,
        place: Place,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Self {
        Self { kind, place, message: message.into(), hint: hint.into() }
    }

    pub(crate) fn empty() -> Self {
        Self::new(ErrorKind::Empty, Place::File, "the file is empty", "save or download it again")
    }

    pub(crate) fn not_finite(place: Place, written: &str) -> Self {
        let message = format!("a coordinate is `{written}`, which is no place");
        let hint = "repair the model in the program that made it and export it again";
        Self::new(ErrorKind::NotFinite, place, message, hint)
    }

    pub(crate) fn too_far(place: Place, written: &str, unit: Unit) -> Self {
        let message = match unit {
            Unit::Millimetre => format!("a coordinate is {written} mm, more than 1000000 mm from the origin"),
            other => format!(
                "a coordinate is {written}, in {} more than a kilometre from the origin",
                other.plural()
            ),
        };
        let hint = "check the units of the export, and that the model lies near the origin; \
                    --set import.unit says in which unit a file is read";
        Self::new(ErrorKind::TooFar, place, message, hint)
    }

    pub(crate) fn no_facets(place: Place) -> Self {
        let hint = "was anything selected when it was exported?";
        Self::new(ErrorKind::NoFacets, place, "there are no facets in the file", hint)
    }

    pub(crate) fn no_area(facets: usize, unit: Unit) -> Self {
        let message = format!("no facet has an area; there are {facets}");
        let hint = format!(
            "the file was read in {}; if it was drawn in metres or inches: --set import.unit=m or inch",
            unit.plural()
        );
        Self::new(ErrorKind::NoArea, Place::File, message, hint)
    }

    pub(crate) fn too_large(facets: usize) -> Self {
        let message = format!(
            "{facets} facets are more than the {} a part may have",
            shape::TriangleMesh::MOST_TRIANGLES
        );
        let hint = "export the model with a coarser mesh";
        Self::new(ErrorKind::TooLarge, Place::File, message, hint)
    }

    /// A corner of a facet that names a vertex which the file does not have.
    pub(crate) fn no_vertex(place: Place, written: impl fmt::Display, vertices: usize) -> Self {
        let message = format!("a face has the vertex {written}, and there are {vertices} vertices");
        Self::new(ErrorKind::Missing, place, message, "the file is damaged; export or download it again")
    }

    pub(crate) fn truncated(place: Place, what: impl fmt::Display) -> Self {
        let hint = "the end of the file is missing; export, copy or download it again";
        Self::new(ErrorKind::Truncated, place, format!("truncated: {what}"), hint)
    }

    pub(crate) fn syntax(place: Place, message: impl Into<String>) -> Self {
        let hint = "the file is damaged or of an unknown dialect; export the model again, or as binary STL";
        Self::new(ErrorKind::Syntax, place, message, hint)
    }
}

impl fmt::Display for ImportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match &self.place {
            Place::File => Ok(()),
            Place::Byte(byte) => write!(f, " (byte {byte})"),
            Place::Line(line) => write!(f, " (line {line})"),
            Place::Facet { number, byte } => write!(f, " (facet {number}, byte {byte})"),
            Place::Entry { name, line } => write!(f, " ({name}, line {line})"),
        }
    }
}

impl std::error::Error for ImportError {}

impl From<ImportError> for skein::Error {
    fn from(error: ImportError) -> Self {
        let place = match error.place {
            Place::File => skein::Place::Whole,
            Place::Byte(byte) => skein::Place::At(format!("byte {byte}")),
            Place::Line(line) => skein::Place::Line(line),
            Place::Facet { number, byte } => skein::Place::At(format!("facet {number} (byte {byte})")),
            Place::Entry { name, line } => skein::Place::At(format!("{name}, line {line}")),
        };
        Self::new(error.message).at(place).hint(error.hint)
    }
}

/// The user's own text, in a length that fits a message.
pub(crate) fn quoted(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(word.get(..40).unwrap_or(word));
    text.chars().map(|letter| if letter.is_control() { '\u{fffd}' } else { letter }).collect()
}
