//! What a PLY file says about itself before its data.

use crate::error::{ImportError, Place, quoted};
use crate::words::{self, is_space};

/// How numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    Binary(Endian),
}

/// The order of the bytes of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Endian {
    Little,
    Big,
}

/// The types of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Type {
    fn of_word(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// How many bytes it takes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

/// What a property is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// A coordinate of a vertex: 0, 1, 2 for x, y, z.
    Coordinate(usize),
    /// The corners of a face.
    Corners,
    /// The corners of strips of triangles, with −1 between strips.
    Strips,
    /// Of no use to clay: colours, normals, confidence.
    Other,
}

/// A property of an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Property {
    pub(super) role: Role,
    pub(super) kind: Type,
    /// The type of the count, when the property is a list.
    pub(super) count: Option<Type>,
}

/// A kind of records, and how many of them there are.
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// The fewest bytes that one record can take in a binary file.
    pub(super) fn least_size(&self) -> usize {
        self.properties.iter().map(|property| property.count.unwrap_or(property.kind).size()).sum()
    }
}

/// Everything before the data.
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the data begins.
    pub(super) end: usize,
}

impl Header {
    pub(super) fn has(&self, name: &str) -> bool {
        self.elements.iter().any(|element| element.name == name)
    }

    pub(super) fn read(bytes: &[u8]) -> Result<Self, ImportError> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut at = 0;
        loop {
            let rest = bytes.get(at..).filter(|rest| !rest.is_empty());
            let Some(rest) = rest else {
                let place = Place::Line(words::line(bytes, bytes.len()));
                return Err(ImportError::truncated(place, "the header has no `end_header`"));
            };
            let length = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
            let line = rest.get(..length).unwrap_or_default();
            let refuse = |message: String| ImportError::syntax(Place::Line(words::line(bytes, at)), message);
            let mut words = line.split(|byte| is_space(*byte)).filter(|word| !word.is_empty());
            // A carriage return and a line feed are one break, above all before binary data.
            let next = at
                + length
                + if rest.get(length..).is_some_and(|end| end.starts_with(b"\r\n")) { 2 } else { 1 };
            match words.next() {
                Some(b"format") => {
                    encoding = Some(match words.next() {
                        Some(b"ascii") => Encoding::Text,
                        Some(b"binary_little_endian") => Encoding::Binary(Endian::Little),
                        Some(b"binary_big_endian") => Encoding::Binary(Endian::Big),
                        word => {
                            let word = quoted(word.unwrap_or_default());
                            return Err(refuse(format!("`{word}` is no format of PLY")));
                        }
                    });
                }
                Some(b"element") => elements.push(element(&mut words).ok_or_else(|| {
                    refuse(format!("`{}` is no element with a name and a count", quoted(line)))
                })?),
                Some(b"property") => {
                    let Some(element) = elements.last_mut() else {
                        return Err(refuse("a property stands before the first element".to_owned()));
                    };
                    let property = property(&element.name, &mut words);
                    element
                        .properties
                        .push(property.ok_or_else(|| refuse(format!("`{}` is no property", quoted(line))))?);
                }
                Some(b"end_header") => {
                    let Some(encoding) = encoding else {
                        return Err(refuse("the header has no `format`".to_owned()));
                    };
                    let end = next.min(bytes.len());
                    return Ok(Self { encoding, elements, end });
                }
                Some(b"comment" | b"obj_info") | None => {}
                Some(word) if at == 0 || word.eq_ignore_ascii_case(b"ply") => {}
                Some(word) => {
                    return Err(refuse(format!("`{}` does not belong in the header", quoted(word))));
                }
            }
            at = next;
        }
    }
}

fn element<'a>(words: &mut impl Iterator<Item = &'a [u8]>) -> Option<Element> {
    let name = String::from_utf8_lossy(words.next()?).into_owned();
    let count = words.next().and_then(crate::number::whole).and_then(|count| u64::try_from(count).ok())?;
    Some(Element { name, count, properties: Vec::new() })
}

fn property<'a>(element: &str, words: &mut impl Iterator<Item = &'a [u8]>) -> Option<Property> {
    let first = words.next()?;
    let (count, kind) = match first {
        b"list" => (Some(Type::of_word(words.next()?)?), Type::of_word(words.next()?)?),
        word => (None, Type::of_word(word)?),
    };
    let name = words.next()?;
    let role = match (element, count, name) {
        ("vertex", None, b"x") => Role::Coordinate(0),
        ("vertex", None, b"y") => Role::Coordinate(1),
        ("vertex", None, b"z") => Role::Coordinate(2),
        ("face", Some(_), b"vertex_indices" | b"vertex_index") => Role::Corners,
        ("tristrips", Some(_), b"vertex_indices" | b"vertex_index") => Role::Strips,
        _ => Role::Other,
    };
    Some(Property { role, kind, count })
}
