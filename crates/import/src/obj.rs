//! Wavefront OBJ: a line for each vertex and each polygon.

use crate::error::{ErrorKind, ImportError, Place, quoted};
use crate::number::{Decimal, whole};
use crate::polygon::Cutter;
use crate::weld::Facets;
use crate::words::{self, is_space};
use crate::{Format, Part, Report, Unit};
use shape::{Point3, TriangleMesh};

/// Whether one of the first lines that say something is a vertex or a face.
pub(crate) fn looks_like_obj(text: &[u8]) -> bool {
    let lines = text.split(|byte| matches!(byte, b'\n' | b'\r'));
    let mut words = lines.map(|line| line.split(|byte| is_space(*byte)).filter(|word| !word.is_empty()));
    words.by_ref().take(10_000).any(|mut line| match line.next() {
        Some(b"v") => (0..3).all(|_| line.next().is_some_and(|word| Decimal::read(word).is_ok())),
        Some(b"f") => (0..3).all(|_| line.next().is_some_and(|word| index(word).is_some())),
        _ => false,
    })
}

/// Reads an OBJ: polygons of any size, indices from either end, groups and objects as one part. Textures, normals,
/// colours and materials are of no use to clay.
pub(crate) fn read(bytes: &[u8], unit: Unit) -> Result<Part, ImportError> {
    let mut reader = Reader {
        text: bytes,
        at: if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 },
        unit,
        vertices: Vec::new(),
        triangles: Vec::new(),
        cutter: Cutter::default(),
        corners: Vec::new(),
        ahead: Vec::new(),
        objects: 0,
        curves: 0,
        report: Report { format: Format::Obj, unit, ..Report::default() },
    };
    reader.file()?;
    let Reader { vertices, triangles, cutter, objects, curves, mut report, .. } = reader;
    if triangles.is_empty() && curves > 0 {
        let message = format!("the file has {curves} free-form curves and surfaces and no faces");
        let hint = "convert them to polygons in the program that drew them and export again";
        return Err(ImportError::new(ErrorKind::NoFacets, Place::File, message, hint));
    }
    if curves > 0 {
        report.remarks.push(format!("{curves} free-form curves and surfaces were left out"));
    }
    report.crossed = cutter.crossed;
    report.solids = objects.max(1);
    Ok(Part::new(Facets::welded(&vertices, triangles).mesh(unit)?, report))
}

struct Reader<'a> {
    text: &'a [u8],
    at: usize,
    unit: Unit,
    vertices: Vec<Point3>,
    triangles: Vec<[u32; 3]>,
    cutter: Cutter,
    /// Of the polygon that is being read.
    corners: Vec<u32>,
    /// Polygons that name vertices which come later, each with where it stands.
    ahead: Vec<(usize, Vec<u32>)>,
    objects: usize,
    curves: usize,
    report: Report,
}

impl<'a> Reader<'a> {
    fn file(&mut self) -> Result<(), ImportError> {
        while self.at < self.text.len() {
            let start = self.at;
            match self.word().unwrap_or_default() {
                b"v" => self.vertex()?,
                b"f" | b"fo" => self.face(start)?,
                b"o" => self.objects += 1,
                b"" | b"vn" | b"vt" | b"vp" | b"g" | b"s" | b"usemtl" | b"mtllib" | b"l" | b"p" | b"lod"
                | b"usemap" | b"maplib" | b"bevel" | b"c_interp" | b"d_interp" | b"shadow_obj"
                | b"trace_obj" | b"mg" | b"end" | b"parm" | b"trim" | b"hole" | b"scrv" | b"sp" | b"deg"
                | b"bmat" | b"step" | b"con" => {}
                b"curv" | b"curv2" | b"surf" | b"cstype" => self.curves += 1,
                word if word.starts_with(b"#") => {}
                _ => self.report.ignored_lines += 1,
            }
            self.skip_line();
        }
        for (start, corners) in std::mem::take(&mut self.ahead) {
            if let Some(bad) = corners.iter().find(|corner| **corner as usize >= self.vertices.len()) {
                return Err(ImportError::no_vertex(
                    self.place(start),
                    u64::from(*bad) + 1,
                    self.vertices.len(),
                ));
            }
            self.cutter.cut(&corners, &self.vertices, &mut self.triangles);
        }
        Ok(())
    }

    fn vertex(&mut self) -> Result<(), ImportError> {
        if self.vertices.len() == TriangleMesh::MOST_TRIANGLES {
            return Err(ImportError::too_large(self.vertices.len()));
        }
        let point = Point3 { x: self.coordinate()?, y: self.coordinate()?, z: self.coordinate()? };
        // What may follow is a weight, which polygons have no use for, or a colour.
        self.vertices.push(point);
        Ok(())
    }

    #[inline]
    fn coordinate(&mut self) -> Result<i32, ImportError> {
        let start = self.at;
        let Some(word) = self.word() else {
            if self.is_at_end() {
                return Err(self.ends_early());
            }
            return Err(ImportError::syntax(self.place(start), "a vertex has fewer than three numbers"));
        };
        let number = Decimal::read(word).and_then(|number| Ok((number.microns(self.unit)?, number.comma)));
        match number {
            Ok((microns, comma)) => {
                self.report.decimal_commas += usize::from(comma);
                Ok(microns)
            }
            Err(_) if self.is_at_end() => Err(self.ends_early()),
            Err(trouble) => {
                Err(words::no_coordinate(trouble, self.place(start), word, self.unit, "a vertex needs three"))
            }
        }
    }

    fn face(&mut self, start: usize) -> Result<(), ImportError> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        let mut is_ahead = false;
        while let Some(word) = self.word() {
            let Some(index) = index(word) else {
                if self.is_at_end() {
                    return Err(self.ends_early());
                }
                let message = format!("`{}` is no corner of a face", quoted(word));
                return Err(ImportError::syntax(self.place(start), message));
            };
            let count = self.vertices.len();
            let corner = match index {
                1.. => u32::try_from(index - 1).ok(),
                // Counted back from the last vertex so far.
                ..0 => u32::try_from(count as i64 + index).ok(),
                0 => None,
            };
            let Some(corner) = corner else {
                return Err(ImportError::no_vertex(self.place(start), index, count));
            };
            is_ahead |= corner as usize >= count;
            corners.push(corner);
        }
        if corners.len() < 3 {
            if self.is_at_end() {
                return Err(self.ends_early());
            }
            let message = format!("a face has {} corners, fewer than three", corners.len());
            return Err(ImportError::syntax(self.place(start), message));
        }
        if self.triangles.len() + corners.len() > TriangleMesh::MOST_TRIANGLES {
            return Err(ImportError::too_large(self.triangles.len() + corners.len()));
        }
        if is_ahead {
            self.ahead.push((start, corners));
            return Ok(());
        }
        self.cutter.cut(&corners, &self.vertices, &mut self.triangles);
        self.corners = corners;
        Ok(())
    }

    /// The next word of the line; a backslash at the end of a line joins the next one to it.
    #[inline]
    fn word(&mut self) -> Option<&'a [u8]> {
        let mut rest = self.text.get(self.at..)?;
        loop {
            match rest {
                [b'\n' | b'\r' | b'#', ..] | [] => {
                    // A remark is not skipped here: it is the rest of the line.
                    self.at = self.text.len() - rest.len();
                    return None;
                }
                [b'\\', b'\r', b'\n', tail @ ..] | [b'\\', b'\n' | b'\r', tail @ ..] => rest = tail,
                [byte, tail @ ..] if is_space(*byte) => rest = tail,
                _ => break,
            }
        }
        let start = self.text.len() - rest.len();
        let length = rest.iter().position(|byte| is_space(*byte)).unwrap_or(rest.len());
        // A backslash that ends the line may stand right behind a word.
        let word = rest.get(..length)?;
        let word = word.strip_suffix(b"\\").filter(|word| !word.is_empty()).unwrap_or(word);
        self.at = start + word.len();
        Some(word)
    }

    #[inline]
    fn skip_line(&mut self) {
        let rest = self.text.get(self.at..).unwrap_or_default();
        self.at +=
            rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).map_or(rest.len(), |end| end + 1);
    }

    fn is_at_end(&self) -> bool {
        self.at >= self.text.len()
    }

    fn place(&self, byte: usize) -> Place {
        Place::Line(words::line(self.text, byte))
    }

    #[cold]
    fn ends_early(&self) -> ImportError {
        ImportError::truncated(self.place(self.text.len()), "the text ends inside a line")
    }
}

/// The vertex of a corner like `7`, `7/1`, `7//2` or `-1/-1/-1`: what stands before the first slash.
#[inline]
fn index(word: &[u8]) -> Option<i64> {
    let end = word.iter().position(|byte| *byte == b'/').unwrap_or(word.len());
    word.get(..end).and_then(whole)
}
