//! Parts on their way to the bed: turned, repaired, put side by side.

use crate::{Carve, Place, SKIN, Surface};
use mesh::{Repair, Turn};
use shape::{Bounds, Point, Point3, TriangleMesh};
use skein::{Angle, BedShape, Error, Kind, Machine, Micron, Notes, Setting, Value};
use std::borrow::Cow;

/// How a part is turned: about x, then y, then z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rotation(pub Turn);

impl Setting for Rotation {
    const KIND: Kind = Kind::Form("[x, y, z]");

    fn read(value: &Value) -> Result<Self, String> {
        match value {
            Value::List(values) if values.len() == 3 => {
                let angle = |value: &Value| <Angle as Setting>::read(value);
                let (x, y, z) = (angle(&values[0])?, angle(&values[1])?, angle(&values[2])?);
                Ok(Self(Turn { x, y, z }))
            }
            _ => Err("is not of the form [x, y, z]".to_owned()),
        }
    }

    fn show(&self) -> Value {
        Value::List([self.0.x, self.0.y, self.0.z].map(|angle| angle.show()).to_vec())
    }
}

/// Where the plate of parts goes.
pub struct Spot {
    /// How far it moves.
    pub shift: Point3,
    /// The box around what is printed, once it is there.
    pub bounds: Bounds,
}

impl Carve {
    /// All parts as one mesh, turned and repaired; a single sound part is only borrowed.
    pub(crate) fn plate<'a>(
        &self,
        parts: &'a [TriangleMesh],
        machine: &Machine,
        notes: &mut Notes,
    ) -> Result<Cow<'a, TriangleMesh>, Error> {
        let mut ready: Vec<Cow<'a, TriangleMesh>> = Vec::with_capacity(parts.len());
        for part in parts {
            let turned = self.turned(part)?;
            ready.push(if self.repair { self.repaired(turned, notes) } else { turned });
        }
        if ready.len() == 1 {
            return ready.pop().ok_or_else(nothing);
        }
        let bounds: Vec<Bounds> = ready.iter().map(|part| part.bounds()).collect();
        let moves = match self.place {
            Place::Bed => mesh::arranged(&bounds, machine.bed.x.0, machine.bed.y.0, self.part_gap.0)
                .map_err(|mesh::NoRoom { part }| {
                    Error::new(format!(
                        "part {} of {} finds no room on the bed of {} × {} mm",
                        part + 1,
                        parts.len(),
                        machine.bed.x,
                        machine.bed.y
                    ))
                    .hint("print fewer parts at once, set carve.part_gap lower, or turn it with carve.rotate")
                })?,
            // Each stands on the bed for itself.
            Place::Keep => bounds.iter().map(|bounds| Point3 { x: 0, y: 0, z: -bounds.min.z }).collect(),
            Place::File => vec![Point3::default(); parts.len()],
        };
        let faces: usize = ready.iter().map(|part| part.faces.len()).sum();
        if faces > TriangleMesh::MOST_TRIANGLES {
            return Err(Error::new(format!("{faces} faces are too many for one plate"))
                .hint("print fewer parts at once"));
        }
        let moved: Vec<(&TriangleMesh, Point3)> = ready.iter().map(|part| &**part).zip(moves).collect();
        Ok(Cow::Owned(mesh::joined(&moved)))
    }

    fn turned<'a>(&self, part: &'a TriangleMesh) -> Result<Cow<'a, TriangleMesh>, Error> {
        if self.rotate == Rotation::default() {
            return Ok(Cow::Borrowed(part));
        }
        let turned = mesh::turned(part, self.rotate.0).ok_or_else(|| {
            Error::new("the turned part would lie farther than 1 km from the origin")
                .hint("check the unit of its file")
        })?;
        Ok(Cow::Owned(turned))
    }

    /// A part whose every edge has two faces that agree is left alone.
    fn repaired<'a>(&self, part: Cow<'a, TriangleMesh>, notes: &mut Notes) -> Cow<'a, TriangleMesh> {
        if part.flaws.none() || (self.surface == Surface::Wall && part.flaws.alike == 0) {
            return part;
        }
        let (repaired, done) = mesh::repair(&part, self.how_to_repair());
        done.notes().into_iter().for_each(|note| notes.say(note));
        if done.widest_hole > i64::from(self.close_gaps.0) {
            notes.say(format!("so wide a hole may be meant, and the part is printed as a solid; {SKIN}"));
        }
        Cow::Owned(repaired)
    }

    /// The last resort for a mesh that looked sound: every face may be there from both sides, or a shell inside out.
    pub(crate) fn reconsidered(&self, part: &TriangleMesh, notes: &mut Notes) -> Option<TriangleMesh> {
        let (repaired, done) = mesh::repair(part, self.how_to_repair());
        let said = done.notes();
        let changed = done.doubled + done.turned + done.shells_turned > 0;
        if changed {
            said.into_iter().for_each(|note| notes.say(note));
        }
        changed.then_some(repaired)
    }

    fn how_to_repair(&self) -> Repair {
        let widest_hole = if self.surface == Surface::Wall { -1 } else { i64::from(self.close_gaps.0) };
        Repair::for_layers(self.layer_height.0, self.bead_width.0, widest_hole)
    }

    /// Where the plate goes.
    pub(crate) fn spot(&self, part: Bounds, machine: &Machine, notes: &mut Notes) -> Result<Spot, Error> {
        let Bounds { min, max } = part;
        let (x, y) = match self.place {
            Place::Keep | Place::File => (0, 0),
            Place::Bed => {
                let (left, front) = machine.least();
                let middle = |low: i32, high: i32| ((i64::from(low) + i64::from(high)).div_euclid(2)) as i32;
                (
                    left + machine.bed.x.0 / 2 - middle(min.x, max.x),
                    front + machine.bed.y.0 / 2 - middle(min.y, max.y),
                )
            }
        };
        let z = if self.place == Place::File { 0 } else { -min.z };
        if self.place == Place::File {
            if max.z <= 0 {
                return Err(Error::new("the part lies wholly below the bed").hint(DROP));
            }
            if min.z > 0 {
                return Err(
                    Error::new(format!("the part hangs {} mm over the bed", Micron(min.z))).hint(DROP)
                );
            }
            if min.z < 0 {
                notes.say(format!(
                    "the lowest {} mm of the part lie below the bed and are cut off",
                    Micron(-min.z)
                ));
            }
        }
        let shift = Point3 { x, y, z };
        let moved = |point: Point3| Point3 { x: point.x + x, y: point.y + y, z: (point.z + z).max(0) };
        Ok(Spot { shift, bounds: Bounds { min: moved(min), max: moved(max) } })
    }
}

const DROP: &str = "--drop, or carve.place = \"keep\", lets it down onto the bed";

fn nothing() -> Error {
    Error::new("there is no part to print")
}

/// Whether the part has its place on the machine.
///
/// The corners are those of the part before it is moved.
pub fn fits(
    corners: impl Iterator<Item = Point>,
    shift: Point3,
    bounds: &Bounds,
    machine: &Machine,
) -> Result<(), Error> {
    let (left, front) = machine.least();
    let size = |low: i32, high: i32| Micron(high - low);
    let part = [
        size(bounds.min.x, bounds.max.x),
        size(bounds.min.y, bounds.max.y),
        size(bounds.min.z, bounds.max.z),
    ];
    let bed = [machine.bed.x, machine.bed.y, machine.bed.z];
    if part.iter().zip(bed).any(|(part, bed)| *part > bed) {
        let [x, y, z] = part;
        return Err(Error::new(format!(
            "the part is {x} × {y} × {z} mm, the machine has room for {} × {} × {} mm",
            bed[0], bed[1], bed[2]
        ))
        .hint("scale or turn the part, check the unit of its file, or set machine.bed"));
    }
    let inside = bounds.min.x >= left
        && bounds.min.y >= front
        && bounds.max.x <= left + machine.bed.x.0
        && bounds.max.y <= front + machine.bed.y.0;
    if !inside {
        return Err(Error::new(format!(
            "the part lies at x {}…{}, y {}…{} mm, partly beside the bed",
            Micron(bounds.min.x),
            Micron(bounds.max.x),
            Micron(bounds.min.y),
            Micron(bounds.max.y)
        ))
        .hint("carve.place = \"bed\", or --center, puts it on the middle of the bed"));
    }
    fits_round_bed(corners, shift, machine)
}

/// Whether every corner of the part lies on an elliptic bed.
fn fits_round_bed(
    mut corners: impl Iterator<Item = Point>,
    shift: Point3,
    machine: &Machine,
) -> Result<(), Error> {
    if machine.shape == BedShape::Rectangle {
        return Ok(());
    }
    let (left, front) = machine.least();
    let (half_x, half_y) = (machine.bed.x.um() / 2.0, machine.bed.y.um() / 2.0);
    let beside = corners.find(|vertex| {
        let x = (f64::from(vertex.x + shift.x) - f64::from(left) - half_x) / half_x;
        let y = (f64::from(vertex.y + shift.y) - f64::from(front) - half_y) / half_y;
        x * x + y * y > 1.0
    });
    match beside {
        None => Ok(()),
        Some(vertex) => Err(Error::new(format!(
            "the part reaches x {} y {} mm, beside the round bed of {} × {} mm",
            Micron(vertex.x + shift.x),
            Micron(vertex.y + shift.y),
            machine.bed.x,
            machine.bed.y
        ))
        .hint("scale or turn the part, or set machine.bed")),
    }
}
