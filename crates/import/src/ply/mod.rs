//! PLY, the polygon format of Stanford: a header that says what follows, then records as text or binary.

mod binary;
mod header;
mod records;
mod text;

use crate::error::{ErrorKind, ImportError, Place};
use crate::weld::Facets;
use crate::{Format, Part, Report, Unit};
use header::{Encoding, Header};
use records::Records;

/// Reads a PLY of any encoding: polygons and strips of triangles, with any other elements and properties between
/// them.
pub(crate) fn read(bytes: &[u8], unit: Unit) -> Result<Part, ImportError> {
    let header = Header::read(bytes)?;
    if !header.has("vertex") {
        return Err(ImportError::syntax(Place::File, "the header has no element `vertex`"));
    }
    if !header.has("face") && !header.has("tristrips") {
        let message = "the file is a cloud of points: it has no faces";
        let hint = "make a surface of it first, in the program of the scanner or in MeshLab";
        return Err(ImportError::new(ErrorKind::NoFacets, Place::File, message, hint));
    }
    let mut records = Records::new(unit);
    let end = match header.encoding {
        Encoding::Text => text::read(bytes, &header, &mut records)?,
        Encoding::Binary(endian) => binary::read(bytes, &header, endian, &mut records)?,
    };
    let rest = bytes.get(end..).unwrap_or_default();
    let Records { vertices, triangles, cutter, .. } = records.finished()?;
    let report = Report {
        format: Format::Ply,
        unit,
        trailing: if rest.iter().all(u8::is_ascii_whitespace) { 0 } else { rest.len() },
        crossed: cutter.crossed,
        solids: 1,
        ..Report::default()
    };
    Ok(Part::new(Facets::welded(&vertices, triangles).mesh(unit)?, report))
}
