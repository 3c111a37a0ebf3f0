//! Objects that stand in a file once and in the part as often as they are placed.

use crate::Unit;
use crate::error::{ErrorKind, ImportError, Place, quoted};
use crate::number::{Decimal, PICOMETRES, nearest, whole};
use crate::weld::{Facets, Welder};
use crate::words;
use shape::{Point3, TriangleMesh};
use std::collections::{BTreeMap, BTreeSet};

/// A mesh, other objects placed in it, or both.
#[derive(Default)]
pub(crate) struct Object {
    /// Whole picometres: what is scaled up later keeps its form.
    pub(crate) vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    pub(crate) parts: Vec<Placed>,
}

/// An object at a place.
pub(crate) struct Placed {
    pub(crate) object: String,
    pub(crate) at: Placement,
}

impl Object {
    /// Adds a triangle whose corners are given as words.
    pub(crate) fn triangle(&mut self, corners: [&str; 3]) -> Result<(), ImportError> {
        let mut triangle = [0; 3];
        for (word, corner) in corners.into_iter().zip(&mut triangle) {
            let index = whole(word.trim_ascii().as_bytes()).and_then(|index| u32::try_from(index).ok());
            *corner = index.filter(|index| (*index as usize) < self.vertices.len()).ok_or_else(|| {
                let word = format!("`{}`", quoted(word.as_bytes()));
                ImportError::no_vertex(Place::File, word, self.vertices.len())
            })?;
        }
        if self.triangles.len() == TriangleMesh::MOST_TRIANGLES {
            return Err(ImportError::too_large(self.triangles.len() + 1));
        }
        self.triangles.push(triangle);
        Ok(())
    }
}

/// A coordinate in whole picometres.
pub(crate) fn coordinate(word: &str, unit: Unit) -> Result<f64, ImportError> {
    let word = word.trim_ascii().as_bytes();
    Decimal::read(word)
        .and_then(|number| number.picometres(unit))
        .map_err(|trouble| words::no_coordinate(trouble, Place::File, word, unit, "a vertex needs three"))
}

/// A turn, a scale and a shift: what a point is multiplied with, row by row, and where it then moves, in picometres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    pub(crate) rows: [[f64; 3]; 3],
    pub(crate) shift: [f64; 3],
}

impl Placement {
    /// Where things are.
    pub(crate) const HERE: Self =
        Self { rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], shift: [0.0; 3] };

    /// Without the shift.
    fn turned(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = self.rows;
        let column = |[a, b, c]: [f64; 3]| x * a + y * b + z * c;
        let ([a_x, a_y, a_z], [b_x, b_y, b_z], [c_x, c_y, c_z]) = (a, b, c);
        [column([a_x, b_x, c_x]), column([a_y, b_y, c_y]), column([a_z, b_z, c_z])]
    }

    fn moved(&self, point: [f64; 3]) -> [f64; 3] {
        let ([x, y, z], [to_x, to_y, to_z]) = (self.turned(point), self.shift);
        [x + to_x, y + to_y, z + to_z]
    }

    /// First this, then the other.
    pub(crate) fn then(&self, outer: &Self) -> Self {
        Self { rows: self.rows.map(|row| outer.turned(row)), shift: outer.moved(self.shift) }
    }

    /// Whether it makes a mirror image, in which all triangles are turned over.
    fn mirrors(&self) -> bool {
        let [[a, b, c], [d, e, f], [g, h, i]] = self.rows;
        a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0
    }
}

/// All objects of a file.
#[derive(Default)]
pub(crate) struct Scene {
    pub(crate) objects: BTreeMap<String, Object>,
    /// What is to be printed.
    pub(crate) roots: Vec<Placed>,
}

impl Scene {
    /// The objects that no other has in it, each where it is: what is printed when a file does not say.
    pub(crate) fn tops(&self) -> Vec<Placed> {
        let inner: BTreeSet<&str> =
            self.objects.values().flat_map(|object| &object.parts).map(|part| part.object.as_str()).collect();
        let tops = self.objects.keys().filter(|name| !inner.contains(name.as_str()));
        tops.map(|name| Placed { object: name.clone(), at: Placement::HERE }).collect()
    }

    /// All that is to be printed as one mesh.
    ///
    /// # Errors
    /// When an object is missing or inside itself, lies too far away, or a small file asks for a large part.
    pub(crate) fn facets(self) -> Result<Facets, ImportError> {
        let own: usize = self.objects.values().map(|object| object.triangles.len()).sum();
        let mut build = Build {
            scene: &self,
            welder: Welder::new(own),
            triangles: Vec::with_capacity(own),
            most: own.saturating_add(MOST_COPIED).min(TriangleMesh::MOST_TRIANGLES),
            placed: 0,
        };
        for root in &self.roots {
            build.place(root, &Placement::HERE, 0)?;
        }
        Ok(Facets { vertices: build.welder.vertices, triangles: build.triangles })
    }
}

/// How many triangles a part may have that its file has not: copies of copies can be more than any memory holds.
const MOST_COPIED: usize = 4_000_000;
/// How many objects may be placed.
const MOST_PLACED: usize = 100_000;
/// How deep objects may stand in objects.
const DEEPEST: usize = 64;

struct Build<'a> {
    scene: &'a Scene,
    welder: Welder,
    triangles: Vec<[u32; 3]>,
    most: usize,
    placed: usize,
}

impl Build<'_> {
    fn place(&mut self, placed: &Placed, outer: &Placement, depth: usize) -> Result<(), ImportError> {
        let name = quoted(placed.object.as_bytes());
        let damaged = "the file is damaged; export it again, or as STL";
        let Some(object) = self.scene.objects.get(&placed.object) else {
            let message = format!("the object `{name}` is to be placed, and there is none of this name");
            return Err(ImportError::new(ErrorKind::Missing, Place::File, message, damaged));
        };
        if depth > DEEPEST {
            let message =
                format!("the object `{name}` stands in itself, or more than {DEEPEST} deep in others");
            return Err(ImportError::new(ErrorKind::Syntax, Place::File, message, damaged));
        }
        self.placed += 1;
        if self.placed > MOST_PLACED || self.triangles.len() + object.triangles.len() > self.most {
            let message = format!(
                "the copies of its objects make more than {MOST_PLACED} objects or {MOST_COPIED} facets"
            );
            let hint = "print fewer copies at a time";
            return Err(ImportError::new(ErrorKind::TooLarge, Place::File, message, hint));
        }
        let at = placed.at.then(outer);
        let points: Vec<Point3> = object
            .vertices
            .iter()
            .map(|vertex| {
                let [x, y, z] = at.moved(*vertex).map(|length| nearest(length / PICOMETRES as f64));
                Some(Point3 { x: x?, y: y?, z: z? })
            })
            .collect::<Option<_>>()
            .ok_or_else(|| {
                let message = format!("the object `{name}` is placed more than a kilometre from the origin");
                let hint = "check the unit and the place of the object; --set import.unit overrides the unit";
                ImportError::new(ErrorKind::TooFar, Place::File, message, hint)
            })?;
        let mut indices = vec![0; points.len()];
        self.welder.indices(&points, &mut indices);
        let mirrors = at.mirrors();
        self.triangles.extend(object.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| indices.get(vertex as usize).copied().unwrap_or_default());
            if mirrors { [a, c, b] } else { [a, b, c] }
        }));
        for part in &object.parts {
            self.place(part, &at, depth + 1)?;
        }
        Ok(())
    }
}
