//! What the data of a PLY file is made into, however it is stored.

use super::header::Element;
use crate::error::{ImportError, Place};
use crate::polygon::Cutter;
use crate::{ErrorKind, Unit};
use shape::{Point3, TriangleMesh};

/// The vertices and triangles so far.
pub(super) struct Records {
    pub(super) unit: Unit,
    pub(super) vertices: Vec<Point3>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) cutter: Cutter,
    /// Faces that come before their vertices, and where they stand.
    ahead: Vec<(Vec<u32>, Place)>,
    /// Whether all vertices have been read.
    complete: bool,
}

impl Records {
    pub(super) fn new(unit: Unit) -> Self {
        Self {
            unit,
            vertices: Vec::new(),
            triangles: Vec::new(),
            cutter: Cutter::default(),
            ahead: Vec::new(),
            complete: false,
        }
    }

    /// Makes room for an element of which no more can be present than so many.
    ///
    /// # Errors
    /// When there are too many, or they have no place in space.
    pub(super) fn begin(&mut self, element: &Element, most: usize) -> Result<(), ImportError> {
        let count = usize::try_from(element.count).unwrap_or(usize::MAX);
        if count.min(most) > TriangleMesh::MOST_TRIANGLES {
            return Err(ImportError::too_large(count));
        }
        match element.name.as_str() {
            "vertex" => {
                let has = |axis: usize| {
                    element.properties.iter().any(|one| one.role == super::header::Role::Coordinate(axis))
                };
                if !(has(0) && has(1) && has(2)) {
                    return Err(ImportError::syntax(Place::File, "a vertex has no x, y and z"));
                }
                self.vertices.reserve(count.min(most));
            }
            "face" => self.triangles.reserve(count.min(most)),
            _ => {}
        }
        Ok(())
    }

    /// All records of an element were read.
    pub(super) fn end(&mut self, element: &Element) {
        self.complete |= element.name == "vertex";
    }

    /// A face with its corners.
    #[inline]
    pub(super) fn face(&mut self, corners: &[u32], place: impl FnOnce() -> Place) -> Result<(), ImportError> {
        let count = self.vertices.len();
        if corners.iter().any(|corner| *corner as usize >= count) {
            return self.face_ahead(corners, place());
        }
        match corners {
            [a, b, c] => self.triangles.push([*a, *b, *c]),
            [_, _, _, ..] => self.cutter.cut(corners, &self.vertices, &mut self.triangles),
            _ => return Err(few(corners.len(), place())),
        }
        Ok(())
    }

    #[cold]
    fn face_ahead(&mut self, corners: &[u32], place: Place) -> Result<(), ImportError> {
        if let Some(bad) = corners.iter().find(|corner| **corner as usize >= self.vertices.len())
            && self.complete
        {
            return Err(ImportError::no_vertex(place, bad, self.vertices.len()));
        }
        if corners.len() < 3 {
            return Err(few(corners.len(), place));
        }
        self.ahead.push((corners.to_vec(), place));
        Ok(())
    }

    /// A strip of triangles, of which every second one is turned over.
    pub(super) fn strip(&mut self, corners: &[i64], place: impl Fn() -> Place) -> Result<(), ImportError> {
        for strip in corners.split(|corner| *corner < 0) {
            for (index, corners) in strip.windows(3).enumerate() {
                let [Some(a), Some(b), Some(c)] =
                    [0, 1, 2].map(|at| corners.get(at).and_then(|corner| u32::try_from(*corner).ok()))
                else {
                    let count = self.vertices.len();
                    return Err(ImportError::no_vertex(place(), corners.iter().max().unwrap_or(&0), count));
                };
                // A corner given twice turns a strip around without a triangle.
                if a == b || b == c || a == c {
                    continue;
                }
                self.face(&if index % 2 == 0 { [a, b, c] } else { [b, a, c] }, &place)?;
            }
        }
        Ok(())
    }

    /// Cuts what waited for its vertices.
    pub(super) fn finished(mut self) -> Result<Self, ImportError> {
        self.complete = true;
        for (corners, place) in std::mem::take(&mut self.ahead) {
            self.face(&corners, || place)?;
        }
        Ok(self)
    }
}

#[cold]
fn few(corners: usize, place: Place) -> ImportError {
    let message = format!("a face has {corners} corners, fewer than three");
    ImportError::new(ErrorKind::NotATriangle, place, message, "the file is damaged; export it again")
}
