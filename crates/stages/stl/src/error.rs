use std::fmt;

/// Why a file was refused: one sentence on what is so and where, and one on what helps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StlError {
    /// What is wrong, for programs.
    pub kind: StlErrorKind,
    /// Where it is wrong.
    pub place: Place,
    /// What is wrong, for people, without the place.
    pub message: String,
    /// What helps.
    pub hint: &'static str,
}

/// The kinds of trouble with an STL file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StlErrorKind {
    /// No bytes at all.
    Empty,
    /// A file of another kind: a picture, an archive, a web page.
    Foreign,
    /// Neither text nor long enough for a binary file.
    NotStl,
    /// The end is missing.
    Truncated,
    /// More data than the header promises, and no telling what it is.
    WrongCount,
    /// A text file with a word where another belongs.
    Syntax,
    /// A facet with other than three corners.
    NotATriangle,
    /// A coordinate that is no number or infinite.
    NotFinite,
    /// A coordinate beyond a kilometre.
    TooFar,
    /// A file without facets.
    NoFacets,
    /// Facets without an area only.
    NoArea,
    /// More facets than a mesh may have.
    TooLarge,
}

/// A place in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
}

impl StlError {
    pub(crate) fn new(
        kind: StlErrorKind,
        place: Place,
        message: impl Into<String>,
        hint: &'static str,
    ) -> Self {
        Self { kind, place, message: message.into(), hint }
    }

    pub(crate) fn not_finite(place: Place, written: &str) -> Self {
        let message = format!("a coordinate is `{written}`, which is no place");
        Self::new(
            StlErrorKind::NotFinite,
            place,
            message,
            "repair the model in the program that made it and export it again",
        )
    }

    pub(crate) fn too_far(place: Place, written: &str) -> Self {
        let message = format!("a coordinate is {written} mm, more than 1000000 mm from the origin");
        Self::new(
            StlErrorKind::TooFar,
            place,
            message,
            "an STL is read in millimetres; check the units of the export, and that the model lies near the origin",
        )
    }

    pub(crate) fn no_facets(place: Place) -> Self {
        Self::new(
            StlErrorKind::NoFacets,
            place,
            "there are no facets in the file",
            "was anything selected when it was exported?",
        )
    }

    pub(crate) fn no_area(facets: usize) -> Self {
        let message = format!("no facet has an area; there are {facets}");
        Self::new(
            StlErrorKind::NoArea,
            Place::File,
            message,
            "an STL is read in millimetres; was the model exported in metres or inches?",
        )
    }

    pub(crate) fn too_large(facets: usize) -> Self {
        let message = format!(
            "{facets} facets are more than the {} a part may have",
            shape::TriangleMesh::MOST_TRIANGLES
        );
        Self::new(StlErrorKind::TooLarge, Place::File, message, "export the model with a coarser mesh")
    }
}

impl fmt::Display for StlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match self.place {
            Place::File => Ok(()),
            Place::Byte(byte) => write!(f, " (byte {byte})"),
            Place::Line(line) => write!(f, " (line {line})"),
            Place::Facet { number, byte } => write!(f, " (facet {number}, byte {byte})"),
        }
    }
}

impl std::error::Error for StlError {}

/// Names a file of another kind by how it starts.
pub(crate) fn foreign(bytes: &[u8]) -> Option<StlError> {
    const CONVERT: &str = "export the model as STL";
    const UNPACK: &str = "unpack it and give the STL inside; a 3MF file must be exported as STL";
    const STARTS: &[(&[u8], &str, &str)] = &[
        (b"\x89PNG", "a PNG picture", CONVERT),
        (b"\xff\xd8\xff", "a JPEG picture", CONVERT),
        (b"GIF8", "a GIF picture", CONVERT),
        (b"%PDF", "a PDF document", CONVERT),
        (b"PK\x03\x04", "a ZIP archive (or a 3MF file)", UNPACK),
        (b"\x1f\x8b", "a gzip archive", UNPACK),
        (b"7z\xbc\xaf", "a 7z archive", UNPACK),
        (b"Rar!", "a RAR archive", UNPACK),
        (b"glTF", "a glTF model", CONVERT),
        (b"ply\n", "a PLY model", CONVERT),
        (b"ply\r", "a PLY model", CONVERT),
        (b"\xff\xfe", "text in UTF-16", "save it as plain text (UTF-8), or as binary STL"),
        (b"\xfe\xff", "text in UTF-16", "save it as plain text (UTF-8), or as binary STL"),
        (b"\x7fELF", "a program", CONVERT),
    ];
    const PAGES: &[(&[u8], &str, &str)] = &[
        (b"<!doctype", "a web page", "download the file itself, not the page that shows it"),
        (b"<html", "a web page", "download the file itself, not the page that shows it"),
        (b"<?xml", "an XML file", CONVERT),
        (b"<svg", "an SVG picture", CONVERT),
    ];
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let page = PAGES
        .iter()
        .find(|(start, ..)| text.get(..start.len()).is_some_and(|text| text.eq_ignore_ascii_case(start)));
    let (_, name, hint) = STARTS.iter().find(|(start, ..)| bytes.starts_with(start)).or(page)?;
    Some(StlError::new(StlErrorKind::Foreign, Place::Byte(0), format!("this is {name}, not an STL"), hint))
}
