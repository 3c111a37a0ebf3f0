//! Archives: a 3MF file is a ZIP archive with a model in it, and an AMF file may be in one.

use crate::error::{ErrorKind, ImportError, Place, quoted};
use crate::xml::{self, Visitor};
use crate::{FileUnit, Part, amf, threemf};
use std::io::{BufReader, Cursor};
use zip::ZipArchive;
use zip::result::ZipError;

/// Whether the bytes begin like a ZIP archive, with a file or, when it is empty, with its end.
pub(crate) fn is_archive(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

/// Reads an archive, whichever it is.
pub(crate) fn read(bytes: &[u8], unit: FileUnit) -> Result<Part, ImportError> {
    let mut package = Package::open(bytes)?;
    let ends = |name: &String, with: &str| name.to_ascii_lowercase().ends_with(with);
    if package.names.iter().any(|name| ends(name, ".model")) {
        return threemf::package(&mut package, unit);
    }
    if let Some(name) = package.names.iter().find(|name| ends(name, ".amf")).cloned() {
        return amf::package(&mut package, &name, unit);
    }
    Err(foreign(&package.names))
}

/// Says what an archive is in which there is no part.
fn foreign(names: &[String]) -> ImportError {
    let has = |wanted: &str| names.iter().any(|name| name == wanted);
    let (what, hint) = if has("Document.xml") && has("GuiDocument.xml") {
        ("this is a FreeCAD document".to_owned(), "export the part as STL or 3MF")
    } else if has("[Content_Types].xml") {
        (
            "this is a document of an office program".to_owned(),
            "a part is needed, as STL, 3MF, OBJ, PLY or AMF",
        )
    } else {
        let some: Vec<String> =
            names.iter().take(3).map(|name| format!("`{}`", quoted(name.as_bytes()))).collect();
        let more = if names.len() > some.len() { " and more" } else { "" };
        let inside = if some.is_empty() { "nothing".to_owned() } else { some.join(", ") + more };
        (
            format!("this is a ZIP archive with {inside} in it, neither 3MF nor AMF"),
            "unpack it and give the file inside",
        )
    };
    ImportError::new(ErrorKind::Foreign, Place::File, what, hint)
}

/// An open archive.
pub(crate) struct Package<'a> {
    archive: ZipArchive<Cursor<&'a [u8]>>,
    pub(crate) names: Vec<String>,
    /// How many bytes may still be unpacked.
    left: u64,
}

/// What a small archive may unpack to, and how much more a larger one for each of its bytes. Meshes as XML shrink to
/// a tenth; a bomb to a thousandth.
const LEAST_ROOM: u64 = 64 << 20;
const MOST_RATIO: u64 = 100;

impl<'a> Package<'a> {
    fn open(bytes: &'a [u8]) -> Result<Self, ImportError> {
        let archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error))?;
        let names = archive.file_names().filter_map(Result::ok).map(|name| name.into_owned()).collect();
        Ok(Self { archive, names, left: LEAST_ROOM + MOST_RATIO * bytes.len() as u64 })
    }

    /// Walks through an XML file of the archive, whose path may start with a slash and differ in case.
    pub(crate) fn walk(&mut self, path: &str, visitor: &mut impl Visitor) -> Result<(), ImportError> {
        let wanted = path.trim_start_matches('/');
        let name = self.names.iter().find(|name| *name == wanted);
        let name = name.or_else(|| self.names.iter().find(|name| name.eq_ignore_ascii_case(wanted))).cloned();
        let Some(name) = name else {
            let message = format!("the archive has no `{}`", quoted(path.as_bytes()));
            return Err(ImportError::new(ErrorKind::Missing, Place::File, message, "export the model again"));
        };
        let file = self.archive.by_name(&name).map_err(|error| damaged(&error))?;
        let size = file.size();
        xml::walk(BufReader::with_capacity(1 << 16, file), self.left, Some(&name), visitor)?;
        self.left = self.left.saturating_sub(size);
        Ok(())
    }
}

fn damaged(error: &ZipError) -> ImportError {
    match error {
        ZipError::UnsupportedArchive(why) => ImportError::new(
            ErrorKind::Foreign,
            Place::File,
            format!("the archive is packed in a way that is not read: {why}"),
            "pack it without a password, with the usual compression (deflate)",
        ),
        error => ImportError::new(
            ErrorKind::Truncated,
            Place::File,
            format!("the archive is damaged or cut short: {error}"),
            "copy or download it again",
        ),
    }
}
