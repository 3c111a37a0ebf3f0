//! The data of a PLY as text: the numbers of a record, one after the other; where the lines break does not matter.

use super::header::{Element, Header, Property, Role};
use super::records::Records;
use crate::error::{ImportError, Place, quoted};
use crate::number::{Decimal, whole};
use crate::words::{self, is_space};
use shape::Point3;

/// Reads the data; returns where it ends.
pub(super) fn read(bytes: &[u8], header: &Header, records: &mut Records) -> Result<usize, ImportError> {
    let mut reader = Reader { text: bytes, at: header.end, corners: Vec::new(), strip: Vec::new() };
    for element in &header.elements {
        if element.properties.is_empty() {
            continue;
        }
        // Every number has a digit and something between it and the next.
        let most = (bytes.len() - reader.at) / 2 / element.properties.len() + 1;
        records.begin(element, most)?;
        for number in 0..element.count {
            reader.record(element, number, records)?;
        }
        records.end(element);
    }
    Ok(reader.at)
}

struct Reader<'a> {
    text: &'a [u8],
    at: usize,
    /// Of the face that is being read.
    corners: Vec<u32>,
    strip: Vec<i64>,
}

impl<'a> Reader<'a> {
    fn record(&mut self, element: &Element, number: u64, records: &mut Records) -> Result<(), ImportError> {
        let start = self.at;
        let text = self.text;
        // The record begins behind the break that ends the one before.
        let place = || {
            let blanks = text.get(start..).unwrap_or_default().iter().take_while(|byte| is_space(**byte));
            Place::Line(words::line(text, start + blanks.count()))
        };
        let mut point = [0; 3];
        let mut coordinates = false;
        for property in &element.properties {
            let Property { role, count, .. } = *property;
            let length = match count {
                None => 1,
                Some(_) => self.integer(element, number)?,
            };
            if length < 0 {
                return Err(ImportError::syntax(place(), format!("a list has {length} entries")));
            }
            match role {
                Role::Coordinate(axis) => {
                    let word = self.word().ok_or_else(|| self.ends_in(element, number))?;
                    let micron = Decimal::read(word).and_then(|number| number.microns(records.unit));
                    let micron = micron.map_err(|trouble| {
                        let needs = "a vertex needs three";
                        words::no_coordinate(trouble, place(), word, records.unit, needs)
                    })?;
                    coordinates = true;
                    if let Some(coordinate) = point.get_mut(axis) {
                        *coordinate = micron;
                    }
                }
                Role::Corners => {
                    self.corners.clear();
                    for _ in 0..length {
                        let corner = self.integer(element, number)?;
                        let corner = u32::try_from(corner)
                            .map_err(|_| ImportError::no_vertex(place(), corner, records.vertices.len()))?;
                        self.corners.push(corner);
                    }
                    records.face(&self.corners, place)?;
                }
                Role::Strips => {
                    self.strip.clear();
                    for _ in 0..length {
                        let corner = self.integer(element, number)?;
                        self.strip.push(corner);
                    }
                    records.strip(&self.strip, place)?;
                }
                Role::Other => {
                    for _ in 0..length {
                        self.word().ok_or_else(|| self.ends_in(element, number))?;
                    }
                }
            }
        }
        if coordinates {
            let [x, y, z] = point;
            records.vertices.push(Point3 { x, y, z });
        }
        Ok(())
    }

    #[inline]
    fn word(&mut self) -> Option<&'a [u8]> {
        let rest = self.text.get(self.at..)?;
        let start = rest.iter().position(|byte| !is_space(*byte))?;
        let rest = rest.get(start..)?;
        let length = rest.iter().position(|byte| is_space(*byte)).unwrap_or(rest.len());
        self.at += start + length;
        rest.get(..length)
    }

    #[inline]
    fn integer(&mut self, element: &Element, number: u64) -> Result<i64, ImportError> {
        let Some(word) = self.word() else { return Err(self.ends_in(element, number)) };
        whole(word).ok_or_else(|| {
            let place = Place::Line(words::line(self.text, self.at));
            let message = format!("`{}` is no whole number, as the corners of a face are", quoted(word));
            ImportError::syntax(place, message)
        })
    }

    #[cold]
    fn ends_in(&self, element: &Element, number: u64) -> ImportError {
        let Element { name, count, .. } = element;
        let what = format!("the header promises {count} records of `{name}`, {number} are whole");
        ImportError::truncated(Place::Line(words::line(self.text, self.text.len())), what)
    }
}
