//! Text STL, word by word: where the lines break does not matter, except for names, which end with their line.

use crate::error::{ErrorKind, ImportError, Place, quoted};
use crate::number::Decimal;
use crate::weld::{Facets, Welder};
use crate::words::{self, is_space};
use crate::{Format, Part, Report, Unit};
use shape::{Point3, TriangleMesh};

/// Whether the bytes hold a vertex with its three numbers, or at least start like a text STL.
pub(crate) fn looks_like_text(bytes: &[u8]) -> bool {
    let mut words = Words::new(bytes);
    let starts_with_solid =
        words.clone().next().is_some_and(|word| Keyword::of(word.text) == Some(Keyword::Solid));
    // Without a vertex it may still be a text that was cut early; a binary header brings zeros.
    if starts_with_solid && !bytes.iter().take(1024).any(|byte| *byte == 0) {
        return true;
    }
    while let Some(word) = words.next() {
        if Keyword::of(word.text) == Some(Keyword::Vertex) {
            let mut ahead = words.clone();
            if (0..3).all(|_| ahead.next().is_some_and(|word| Decimal::read(word.text).is_ok())) {
                return true;
            }
        }
    }
    false
}

pub(crate) fn read(bytes: &[u8], unit: Unit) -> Result<Part, ImportError> {
    let mut reader = Reader {
        words: Words::new(bytes),
        unit,
        // A facet as text takes 200 bytes and more.
        welder: Welder::new(bytes.len() / 250),
        triangles: Vec::with_capacity(bytes.len() / 250),
        report: Report { format: Format::TextStl, unit, ..Report::default() },
    };
    reader.file()?;
    let Reader { welder, triangles, report, .. } = reader;
    let mesh = Facets { vertices: welder.vertices, triangles }.mesh(unit)?;
    Ok(Part::new(mesh, report))
}

struct Reader<'a> {
    words: Words<'a>,
    unit: Unit,
    welder: Welder,
    triangles: Vec<[u32; 3]>,
    report: Report,
}

/// Where the reader stands between facets.
#[derive(Clone, Copy, PartialEq)]
enum Inside {
    Nothing,
    Solid,
    /// Facets without a `solid` before them, which then need no `endsolid` either.
    Unnamed,
}

impl Reader<'_> {
    fn file(&mut self) -> Result<(), ImportError> {
        let mut inside = Inside::Nothing;
        while let Some(word) = self.words.next() {
            let keyword = Keyword::of(word.text);
            if inside == Inside::Nothing && !word.leads {
                // The name after `endsolid`, with any words in it; in a file of one line, the next solid.
                if keyword != Some(Keyword::Solid) {
                    continue;
                }
                if !self.words.facet_on_this_line() {
                    self.words.skip_line();
                    continue;
                }
            }
            match (keyword, inside) {
                (Some(Keyword::Solid), Inside::Nothing | Inside::Unnamed) => {
                    self.name();
                    self.report.solids += 1;
                    inside = Inside::Solid;
                }
                (Some(Keyword::EndSolid), Inside::Solid) => inside = Inside::Nothing,
                (Some(Keyword::Facet), _) => {
                    if inside == Inside::Nothing {
                        self.report.solids += 1;
                        inside = Inside::Unnamed;
                    }
                    self.facet(word)?;
                }
                (None | Some(Keyword::Normal), _) => {
                    self.report.ignored_lines += 1;
                    self.words.skip_line();
                }
                (Some(Keyword::Solid), Inside::Solid) => {
                    return Err(self.unexpected(word, "the solid before it has no `endsolid`"));
                }
                (Some(Keyword::EndSolid), _) => {
                    return Err(self.unexpected(word, "there is no `solid` before it"));
                }
                (Some(_), _) => return Err(self.unexpected(word, "there is no `facet` before it")),
            }
        }
        if inside == Inside::Solid {
            return Err(self.truncated(format!(
                "the text ends without `endsolid` after {} facets",
                self.triangles.len()
            )));
        }
        Ok(())
    }

    /// A name is the rest of the line; in a file of one line, it ends where the facets begin.
    fn name(&mut self) {
        loop {
            let before = self.words.clone();
            let Some(word) = self.words.next() else { return };
            let ends = match Keyword::of(word.text) {
                _ if word.leads => true,
                Some(Keyword::EndSolid) => true,
                Some(Keyword::Facet) => before.starts_facet(),
                _ => false,
            };
            if ends {
                self.words = before;
                return;
            }
        }
    }

    /// From the word after `facet` to `endfacet`.
    fn facet(&mut self, start: Word) -> Result<(), ImportError> {
        let mut corners = [0u32; 3];
        let mut seen = 0usize;
        loop {
            let Some(word) = self.words.next() else {
                return Err(self.ends_in_facet());
            };
            match Keyword::of(word.text) {
                Some(Keyword::Vertex) => {
                    let point =
                        Point3 { x: self.coordinate()?, y: self.coordinate()?, z: self.coordinate()? };
                    if let Some(corner) = corners.get_mut(seen) {
                        *corner = self.welder.index(point);
                    }
                    seen += 1;
                }
                Some(Keyword::EndFacet) => break,
                Some(Keyword::Normal | Keyword::Outer | Keyword::Loop | Keyword::EndLoop) => {}
                Some(Keyword::Facet | Keyword::Solid | Keyword::EndSolid) => {
                    return Err(self.unexpected(word, "the facet before it has no `endfacet`"));
                }
                // A normal, which is not believed and may be anything.
                None if seen == 0 => {}
                // The last word may have lost its end.
                None if self.words.is_at_end() => return Err(self.ends_in_facet()),
                None => return Err(self.unexpected(word, "a vertex has three numbers")),
            }
        }
        if seen != 3 {
            return Err(ImportError::new(
                ErrorKind::NotATriangle,
                self.words.place(start),
                format!("a facet has {seen} vertices instead of 3"),
                "export the model with triangles only",
            ));
        }
        if self.triangles.len() == TriangleMesh::MOST_TRIANGLES {
            return Err(ImportError::too_large(self.triangles.len() + 1));
        }
        self.triangles.push(corners);
        Ok(())
    }

    #[inline]
    fn coordinate(&mut self) -> Result<i32, ImportError> {
        let Some(word) = self.words.next() else {
            return Err(self.ends_in_facet());
        };
        let number =
            Decimal::read(word.text).and_then(|number| Ok((number.microns(self.unit)?, number.comma)));
        match number {
            Ok((microns, comma)) => {
                self.report.decimal_commas += usize::from(comma);
                Ok(microns)
            }
            // The last word may have lost its end.
            Err(_) if self.words.is_at_end() => Err(self.ends_in_facet()),
            Err(trouble) => {
                let place = self.words.place(word);
                Err(words::no_coordinate(trouble, place, word.text, self.unit, "a vertex needs three"))
            }
        }
    }

    #[cold]
    fn unexpected(&self, word: Word, why: &str) -> ImportError {
        let message = format!("`{}` does not belong here: {why}", quoted(word.text));
        ImportError::new(
            ErrorKind::Syntax,
            self.words.place(word),
            message,
            "export the model again, or as binary STL",
        )
    }

    #[cold]
    fn ends_in_facet(&self) -> ImportError {
        self.truncated(format!("the text ends inside facet {}", self.triangles.len() + 1))
    }

    #[cold]
    fn truncated(&self, what: String) -> ImportError {
        ImportError::truncated(Place::Line(self.words.line(self.words.text.len())), what)
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Keyword {
    Solid,
    EndSolid,
    Facet,
    Normal,
    Outer,
    Loop,
    Vertex,
    EndLoop,
    EndFacet,
}

impl Keyword {
    #[inline]
    fn of(word: &[u8]) -> Option<Self> {
        let (name, keyword): (&[u8], _) = match (word.first().map(u8::to_ascii_lowercase), word.len()) {
            (Some(b'v'), 6) => (b"vertex", Self::Vertex),
            (Some(b'f'), 5) => (b"facet", Self::Facet),
            (Some(b'n'), 6) => (b"normal", Self::Normal),
            (Some(b'o'), 5) => (b"outer", Self::Outer),
            (Some(b'l'), 4) => (b"loop", Self::Loop),
            (Some(b's'), 5) => (b"solid", Self::Solid),
            (Some(b'e'), 7) => (b"endloop", Self::EndLoop),
            // `endsolid` and `endfacet` are equally long.
            (Some(b'e'), 8) if word.get(3).is_some_and(|letter| letter.eq_ignore_ascii_case(&b's')) => {
                (b"endsolid", Self::EndSolid)
            }
            (Some(b'e'), 8) => (b"endfacet", Self::EndFacet),
            _ => return None,
        };
        word.eq_ignore_ascii_case(name).then_some(keyword)
    }
}

/// The words of the text, one after the other.
#[derive(Clone)]
struct Words<'a> {
    text: &'a [u8],
    /// After the byte order mark.
    start: usize,
    at: usize,
}

#[derive(Clone, Copy)]
struct Word<'a> {
    text: &'a [u8],
    start: usize,
    /// The first of its line.
    leads: bool,
}

impl<'a> Words<'a> {
    fn new(text: &'a [u8]) -> Self {
        let start = if text.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Self { text, start, at: start }
    }

    #[inline]
    fn next(&mut self) -> Option<Word<'a>> {
        let mut leads = self.at == self.start;
        let mut rest = self.text.get(self.at..)?;
        while let Some((byte, tail)) = rest.split_first().filter(|(byte, _)| is_space(**byte)) {
            leads |= matches!(byte, b'\n' | b'\r');
            rest = tail;
        }
        let start = self.text.len() - rest.len();
        let length = rest.iter().position(|byte| is_space(*byte)).unwrap_or(rest.len());
        self.at = start + length;
        let text = rest.get(..length).filter(|text| !text.is_empty())?;
        Some(Word { text, start, leads })
    }

    fn is_at_end(&self) -> bool {
        self.at >= self.text.len()
    }

    /// Whether what follows is a facet and no mere mention of one.
    fn starts_facet(&self) -> bool {
        let mut ahead = self.clone();
        let mut keyword = || ahead.next().map(|word| Keyword::of(word.text));
        if keyword() != Some(Some(Keyword::Facet)) {
            return false;
        }
        match keyword() {
            Some(Some(Keyword::Outer)) => true,
            // After a normal come numbers, whatever they look like, and after three of them a loop.
            Some(Some(Keyword::Normal)) => (0..4).any(|_| keyword() == Some(Some(Keyword::Outer))),
            _ => false,
        }
    }

    /// Whether a facet begins before the line ends.
    fn facet_on_this_line(&self) -> bool {
        let mut ahead = self.clone();
        loop {
            let before = ahead.clone();
            match ahead.next() {
                Some(word) if word.leads => return false,
                Some(word) if Keyword::of(word.text) == Some(Keyword::Facet) && before.starts_facet() => {
                    return true;
                }
                Some(_) => {}
                None => return false,
            }
        }
    }

    fn skip_line(&mut self) {
        let rest = self.text.get(self.at..).unwrap_or_default();
        self.at += rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
    }

    fn line(&self, byte: usize) -> usize {
        words::line(self.text, byte)
    }

    fn place(&self, word: Word) -> Place {
        Place::Line(self.line(word.start))
    }
}
