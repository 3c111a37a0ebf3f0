//! The data of a binary PLY.

use super::header::{Element, Endian, Header, Property, Role, Type};
use super::records::Records;
use crate::Unit;
use crate::error::{ImportError, Place};
use crate::number::nearest;
use shape::Point3;

/// Reads the data; returns where it ends.
pub(super) fn read(
    bytes: &[u8],
    header: &Header,
    endian: Endian,
    records: &mut Records,
) -> Result<usize, ImportError> {
    let mut reader = Reader { bytes, at: header.end, endian, corners: Vec::new(), strip: Vec::new() };
    for element in &header.elements {
        // Records without properties take no bytes, however many there are.
        let Some(most) = (bytes.len() - reader.at).checked_div(element.least_size()) else { continue };
        records.begin(element, most)?;
        if element.count > most as u64 {
            return Err(truncated(bytes, element, most));
        }
        match Vertex::of(element, endian, records.unit) {
            Some(vertex) => reader.vertices(element, &vertex, records)?,
            None => {
                for number in 0..element.count {
                    reader.record(element, number, records)?;
                }
            }
        }
        records.end(element);
    }
    Ok(reader.at)
}

#[cold]
fn truncated(bytes: &[u8], element: &Element, present: usize) -> ImportError {
    let Element { name, count, .. } = element;
    let what = format!("the header promises {count} records of `{name}`, at most {present} are present");
    ImportError::truncated(Place::Byte(bytes.len()), what)
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    endian: Endian,
    /// Of the face that is being read.
    corners: Vec<u32>,
    strip: Vec<i64>,
}

impl<'a> Reader<'a> {
    /// Vertices of one size, which nearly all are.
    fn vertices(
        &mut self,
        element: &Element,
        vertex: &Vertex,
        records: &mut Records,
    ) -> Result<(), ImportError> {
        let start = self.at;
        let length = vertex.size.saturating_mul(usize::try_from(element.count).unwrap_or(usize::MAX));
        let data = self.bytes.get(start..start.saturating_add(length)).unwrap_or_default();
        for (index, record) in data.chunks_exact(vertex.size).enumerate() {
            match vertex.point(record) {
                [Some(x), Some(y), Some(z)] => records.vertices.push(Point3 { x, y, z }),
                _ => return Err(vertex.refuse(record, index, start + index * vertex.size)),
            }
        }
        self.at = start + length;
        Ok(())
    }

    /// A record of any form.
    fn record(&mut self, element: &Element, number: u64, records: &mut Records) -> Result<(), ImportError> {
        let start = self.at;
        let place = || Place::Facet { number: (number + 1) as usize, byte: start };
        let mut point = [0; 3];
        let mut coordinates = false;
        for property in &element.properties {
            let Property { role, kind, count } = *property;
            let length = match count {
                None => 1,
                Some(count) => {
                    let length = self.take(count, 1).map(|bytes| integer(count, self.endian, bytes));
                    let length = length.ok_or_else(|| self.ends_in(element, number))?;
                    usize::try_from(length)
                        .map_err(|_| ImportError::syntax(place(), format!("a list has {length} entries")))?
                }
            };
            let endian = self.endian;
            let Some(values) = self.take(kind, length) else { return Err(self.ends_in(element, number)) };
            let integers = values.chunks_exact(kind.size()).map(|value| integer(kind, endian, value));
            match role {
                Role::Coordinate(axis) => {
                    let value = float(kind, endian, values);
                    let micron = nearest(value * records.unit.microns() as f64)
                        .ok_or_else(|| no_place(value, place(), records.unit))?;
                    coordinates = true;
                    if let Some(coordinate) = point.get_mut(axis) {
                        *coordinate = micron;
                    }
                }
                Role::Corners => {
                    self.corners.clear();
                    for corner in integers {
                        let corner = u32::try_from(corner)
                            .map_err(|_| ImportError::no_vertex(place(), corner, records.vertices.len()))?;
                        self.corners.push(corner);
                    }
                    records.face(&self.corners, place)?;
                }
                Role::Strips => {
                    self.strip.clear();
                    self.strip.extend(integers);
                    records.strip(&self.strip, place)?;
                }
                Role::Other => {}
            }
        }
        if coordinates {
            let [x, y, z] = point;
            records.vertices.push(Point3 { x, y, z });
        }
        Ok(())
    }

    /// The bytes of so many numbers.
    #[inline]
    fn take(&mut self, kind: Type, count: usize) -> Option<&'a [u8]> {
        let (values, _) = self.bytes.get(self.at..)?.split_at_checked(kind.size().checked_mul(count)?)?;
        self.at += values.len();
        Some(values)
    }

    #[cold]
    fn ends_in(&self, element: &Element, number: u64) -> ImportError {
        let Element { name, count, .. } = element;
        let what = format!("the file ends in record {} of {count} of `{name}`", number + 1);
        ImportError::truncated(Place::Byte(self.bytes.len()), what)
    }
}

/// Where the coordinates of a vertex stand in its record.
struct Vertex {
    size: usize,
    places: [(usize, Type); 3],
    endian: Endian,
    unit: Unit,
}

impl Vertex {
    /// When the element is a vertex and all its records have one size.
    fn of(element: &Element, endian: Endian, unit: Unit) -> Option<Self> {
        if element.name != "vertex" || element.properties.iter().any(|property| property.count.is_some()) {
            return None;
        }
        let mut places = [(0, Type::F32); 3];
        let mut size = 0;
        for property in &element.properties {
            if let Role::Coordinate(axis) = property.role
                && let Some(place) = places.get_mut(axis)
            {
                *place = (size, property.kind);
            }
            size += property.kind.size();
        }
        Some(Self { size, places, endian, unit })
    }

    #[inline]
    fn values(&self, record: &[u8]) -> [f64; 3] {
        self.places.map(|(at, kind)| float(kind, self.endian, record.get(at..).unwrap_or_default()))
    }

    #[inline]
    fn point(&self, record: &[u8]) -> [Option<i32>; 3] {
        let scale = self.unit.microns() as f64;
        self.values(record).map(|value| nearest(value * scale))
    }

    #[cold]
    fn refuse(&self, record: &[u8], index: usize, byte: usize) -> ImportError {
        let scale = self.unit.microns() as f64;
        let values = self.values(record);
        let bad = values.into_iter().find(|value| nearest(value * scale).is_none()).unwrap_or(f64::NAN);
        no_place(bad, Place::Facet { number: index + 1, byte }, self.unit)
    }
}

#[cold]
fn no_place(value: f64, place: Place, unit: Unit) -> ImportError {
    if value.is_finite() {
        ImportError::too_far(place, &format!("{value:e}"), unit)
    } else {
        ImportError::not_finite(place, &value.to_string())
    }
}

/// The number at the start of some bytes; zero when they are too few.
#[inline]
fn float(kind: Type, endian: Endian, bytes: &[u8]) -> f64 {
    match kind {
        Type::F32 => f64::from(f32::from_bits(u32::from_ne_bytes(first(bytes, endian)))),
        Type::F64 => f64::from_bits(u64::from_ne_bytes(first(bytes, endian))),
        _ => integer(kind, endian, bytes) as f64,
    }
}

/// A number that counts or names something; floats do so in few files, and then are whole.
#[inline]
fn integer(kind: Type, endian: Endian, bytes: &[u8]) -> i64 {
    match kind {
        Type::I8 => i64::from(i8::from_ne_bytes(first(bytes, endian))),
        Type::U8 => i64::from(u8::from_ne_bytes(first(bytes, endian))),
        Type::I16 => i64::from(i16::from_ne_bytes(first(bytes, endian))),
        Type::U16 => i64::from(u16::from_ne_bytes(first(bytes, endian))),
        Type::I32 => i64::from(i32::from_ne_bytes(first(bytes, endian))),
        Type::U32 => i64::from(u32::from_ne_bytes(first(bytes, endian))),
        Type::F32 | Type::F64 => float(kind, endian, bytes) as i64,
    }
}

/// The first bytes in the order of this machine; zeros when they are too few.
#[inline]
fn first<const N: usize>(bytes: &[u8], endian: Endian) -> [u8; N] {
    let mut first = bytes.first_chunk::<N>().copied().unwrap_or([0; N]);
    let native = if cfg!(target_endian = "big") { Endian::Big } else { Endian::Little };
    if endian != native {
        first.reverse();
    }
    first
}
