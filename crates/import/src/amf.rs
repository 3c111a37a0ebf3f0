//! AMF (ISO/ASTM 52915): objects of volumes over common vertices, and constellations that place them.

use crate::error::{ImportError, Place, quoted};
use crate::number::Decimal;
use crate::package::Package;
use crate::scene::{Object, Placed, Placement, Scene, coordinate};
use crate::xml::{self, Element, Visitor};
use crate::{FileUnit, Format, Part, Report, Unit};

/// Reads an AMF as plain XML.
pub(crate) fn read(bytes: &[u8], unit: FileUnit) -> Result<Part, ImportError> {
    let mut reader = Amf::new(unit);
    xml::walk(bytes, u64::MAX, None, &mut reader)?;
    reader.part()
}

/// Reads an AMF in an archive.
pub(crate) fn package(package: &mut Package<'_>, name: &str, unit: FileUnit) -> Result<Part, ImportError> {
    let mut reader = Amf::new(unit);
    package.walk(name, &mut reader)?;
    reader.part()
}

struct Amf {
    wanted: FileUnit,
    unit: Unit,
    scene: Scene,
    /// The object or constellation that is being read.
    object: Option<(String, Object)>,
    /// The text since the last tag.
    text: String,
    /// Of the vertex that is being read.
    point: [f64; 3],
    /// Of the triangle that is being read.
    corners: [String; 3],
    instance: Option<Instance>,
    /// Triangles with sides that are meant to be round.
    curved: usize,
    volumes: usize,
}

/// An object in a constellation: scaled, turned around x, y and z in this order, and moved.
struct Instance {
    object: String,
    shift: [f64; 3],
    degrees: [f64; 3],
    scale: [f64; 3],
}

impl Amf {
    fn new(wanted: FileUnit) -> Self {
        Self {
            wanted,
            unit: wanted.or(None),
            scene: Scene::default(),
            object: None,
            text: String::new(),
            point: [0.0; 3],
            corners: Default::default(),
            instance: None,
            curved: 0,
            volumes: 0,
        }
    }

    fn part(mut self) -> Result<Part, ImportError> {
        self.scene.roots = self.scene.tops();
        let mut remarks = Vec::new();
        if self.curved > 0 {
            remarks.push(format!(
                "{} edges and vertices say how they are curved: they were read as straight",
                self.curved
            ));
        }
        let report = Report {
            format: Format::Amf,
            unit: self.unit,
            solids: self.volumes.max(1),
            remarks,
            ..Report::default()
        };
        let unit = self.unit;
        Ok(Part::new(self.scene.facets()?.mesh(unit)?, report))
    }

    /// The text as a plain number.
    fn number(&self) -> Result<f64, ImportError> {
        let text = self.text.trim_ascii();
        Decimal::read(text.as_bytes()).map(Decimal::plain).map_err(|_| {
            ImportError::syntax(Place::File, format!("`{}` is no number", quoted(text.as_bytes())))
        })
    }

    fn coordinate(&mut self, axis: usize) -> Result<(), ImportError> {
        let value = coordinate(&self.text, self.unit)?;
        if let Some(place) = self.point.get_mut(axis) {
            *place = value;
        }
        Ok(())
    }

    fn corner(&mut self, index: usize) {
        if let Some(corner) = self.corners.get_mut(index) {
            corner.clone_from(&self.text);
        }
    }

    /// Changes a number of the instance that is being read.
    fn instance(
        &mut self,
        axes: std::ops::Range<usize>,
        list: fn(&mut Instance) -> &mut [f64; 3],
        value: f64,
    ) {
        let list = self.instance.as_mut().map(list);
        for number in list.and_then(|list| list.get_mut(axes)).unwrap_or_default() {
            *number = value;
        }
    }
}

impl Visitor for Amf {
    fn open(&mut self, element: Element<'_>) -> Result<(), ImportError> {
        self.text.clear();
        match element.name {
            "amf" => {
                let own = element.get("unit").map(|word| {
                    Unit::of_word(&word).ok_or_else(|| {
                        let message = format!("`{}` is no unit", quoted(word.as_bytes()));
                        ImportError::syntax(Place::File, message)
                    })
                });
                self.unit = self.wanted.or(own.transpose()?);
            }
            "object" | "constellation" => {
                let name = element.get("id").unwrap_or_else(|| format!(" {}", self.scene.objects.len()));
                self.object = Some((name, Object::default()));
            }
            "instance" => {
                let object = element
                    .get("objectid")
                    .ok_or_else(|| ImportError::syntax(Place::File, "an instance has no `objectid`"))?;
                let (shift, degrees, scale) = ([0.0; 3], [0.0; 3], [1.0; 3]);
                self.instance = Some(Instance { object, shift, degrees, scale });
            }
            "triangle" => self.corners.iter_mut().for_each(String::clear),
            "volume" => self.volumes += 1,
            "normal" | "edge" => self.curved += 1,
            _ => {}
        }
        Ok(())
    }

    fn text(&mut self, text: &str) {
        self.text.push_str(text);
    }

    fn close(&mut self, name: &str) -> Result<(), ImportError> {
        match name {
            "x" => self.coordinate(0)?,
            "y" => self.coordinate(1)?,
            "z" => self.coordinate(2)?,
            "v1" => self.corner(0),
            "v2" => self.corner(1),
            "v3" => self.corner(2),
            "coordinates" => {
                if let Some((_, object)) = &mut self.object {
                    object.vertices.push(self.point);
                }
                self.point = [0.0; 3];
            }
            "triangle" => {
                if let Some((_, object)) = &mut self.object {
                    object.triangle(self.corners.each_ref().map(String::as_str))?;
                }
            }
            "deltax" | "deltay" | "deltaz" if self.instance.is_some() => {
                let shift = coordinate(&self.text, self.unit)?;
                let axis = axis(name);
                self.instance(axis..axis + 1, |instance| &mut instance.shift, shift);
            }
            "rx" | "ry" | "rz" if self.instance.is_some() => {
                let degrees = self.number()?;
                let axis = axis(name);
                self.instance(axis..axis + 1, |instance| &mut instance.degrees, degrees);
            }
            "scalex" | "scaley" | "scalez" if self.instance.is_some() => {
                let scale = self.number()?;
                let axis = axis(name);
                self.instance(axis..axis + 1, |instance| &mut instance.scale, scale);
            }
            "scale" if self.instance.is_some() => {
                let scale = self.number()?;
                self.instance(0..3, |instance| &mut instance.scale, scale);
            }
            "instance" => {
                if let (Some(instance), Some((_, object))) = (self.instance.take(), &mut self.object) {
                    object.parts.push(instance.placed());
                }
            }
            "object" | "constellation" => {
                if let Some((name, object)) = self.object.take()
                    && self.scene.objects.insert(name.clone(), object).is_some()
                {
                    let message = format!("two objects have the name `{}`", quoted(name.as_bytes()));
                    return Err(ImportError::syntax(Place::File, message));
                }
            }
            _ => {}
        }
        self.text.clear();
        Ok(())
    }
}

/// The axis that is the last letter of a name.
fn axis(name: &str) -> usize {
    match name.as_bytes().last() {
        Some(b'x') => 0,
        Some(b'y') => 1,
        _ => 2,
    }
}

impl Instance {
    fn placed(self) -> Placed {
        let [x, y, z] = self.scale;
        let scaled = Placement { rows: [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], ..Placement::HERE };
        let turned = [0, 1, 2].into_iter().zip(self.degrees).fold(scaled, |placement, (axis, degrees)| {
            if degrees == 0.0 { placement } else { placement.then(&turn(axis, degrees)) }
        });
        let at = turned.then(&Placement { shift: self.shift, ..Placement::HERE });
        Placed { object: self.object, at }
    }
}

/// A turn around an axis, counter-clockwise when one looks against it.
fn turn(axis: usize, degrees: f64) -> Placement {
    // Quarter turns are exact.
    let (sine, cosine) = match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        degrees => (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians())),
    };
    let rows = match axis {
        0 => [[1.0, 0.0, 0.0], [0.0, cosine, sine], [0.0, -sine, cosine]],
        1 => [[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]],
        _ => [[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]],
    };
    Placement { rows, ..Placement::HERE }
}
