#![doc = include_str!("../README.md")]

mod bridge;
mod loops;
mod planes;

use rayon::prelude::*;
use shape::solid::{Sections, planes_over_undersides};
use shape::{Bounds, Point, Point3, Ring, TriangleMesh};
use skein::{
    Bead, BedShape, Choice, Direction, Error, Facts, Machine, Micron, Notes, RotatedLoopLayer, Section,
    Settings, Slices,
};

/// Cuts a part into layers.
#[derive(Clone, Debug, Settings)]
pub struct Carve {
    /// How high a layer is. Half the nozzle is a good start: lower layers press the clay and show less, higher ones
    /// print faster and stand less well.
    #[setting(default = 1.5, min = 0.05, max = 100.0, unit = "mm")]
    pub layer_height: Micron,
    /// How high the first layer is. Lower than the others presses the clay onto the bed.
    #[setting(default = 1.2, min = 0.05, max = 100.0, unit = "mm")]
    pub first_layer_height: Micron,
    /// How wide a bead is laid. A little more than the nozzle presses it against its neighbours.
    #[setting(default = 3.2, min = 0.1, max = 200.0, unit = "mm")]
    pub bead_width: Micron,
    /// The form of a bead's cross-section: how much clay one millimetre of bead takes, and how far apart neighbours
    /// lie so that they fill the room between them.
    #[setting(default = Section::Rectangle)]
    pub bead_section: Section,
    /// Where the part is put before it is cut.
    #[setting(default = Place::Bed)]
    pub place: Place,
    /// The widest gap in an open outline that is closed with a straight line.
    #[setting(default = 10.0, min = 0.0, max = 1000.0, unit = "mm")]
    pub close_gaps: Micron,
    /// Whether layers that span a gap are recognised, so that their infill runs across it.
    #[setting(default = true)]
    pub find_bridges: bool,
}

/// Where the part is put before it is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Place {
    /// On the middle of the bed, standing on it.
    Bed,
    /// Where its file has it; only its height is brought down to the bed.
    Keep,
}

impl Carve {
    /// The craft word.
    pub const NAME: &'static str = "carve";

    /// Cuts the part.
    ///
    /// # Errors
    /// When there is nothing to print, or the part does not fit the machine.
    pub fn carve(&self, mesh: &TriangleMesh, machine: &Machine, notes: &mut Notes) -> Result<Slices, Error> {
        self.check_bead(machine, notes)?;
        let Bounds { min, max } = mesh.bounds();
        let slabs = planes::slabs(Micron(max.z - min.z), self.first_layer_height, self.layer_height)?;
        let shift = self.shift(min, max, machine);
        let bounds = Bounds { min: moved(min, shift), max: moved(max, shift) };
        fits(&bounds, machine)?;
        fits_round_bed(mesh, shift, machine)?;
        // The part is cut where it lies and its loops are moved: a million vertices need not be.
        let planes: Vec<i32> = slabs.iter().map(|slab| slab.middle.0 + min.z).collect();
        let sections = Sections::new(mesh, &planes);
        let tolerance = (self.bead_width.um() / 100.0).min(SIMPLIFY);
        let cut: Vec<(Vec<Ring>, Notes)> = (0..slabs.len())
            .into_par_iter()
            .map(|layer| {
                let mut remarks = Notes::default();
                let loops = loops::of_chains(
                    sections.at(layer),
                    self.close_gaps.um(),
                    tolerance,
                    layer,
                    &mut remarks,
                );
                (loops.into_iter().map(|ring| slid(ring, shift)).collect(), remarks)
            })
            .collect();
        let mut slices = Slices { facts: self.facts(machine), bounds, ..Slices::default() };
        let mut empty = 0;
        for (slab, (loops, remarks)) in slabs.iter().zip(cut) {
            notes.append(remarks);
            empty += usize::from(loops.is_empty());
            let thickness = (slab.height != self.layer_height).then_some(slab.height);
            slices.layers.push(RotatedLoopLayer { z: slab.middle, thickness, rotation: None, loops });
        }
        if empty == slices.layers.len() {
            return Err(Error::new("the part has no volume: no layer has an outline")
                .hint("a surface of one skin cannot be printed as a solid; give it a thickness"));
        }
        if self.find_bridges {
            self.find_bridges(&mut slices, mesh, &planes);
        }
        Ok(slices)
    }

    /// Settings that contradict each other are refused, doubtful ones reported.
    fn check_bead(&self, machine: &Machine, notes: &mut Notes) -> Result<(), Error> {
        let high = self.layer_height.max(self.first_layer_height);
        if self.bead_section == Section::Stadium && self.bead_width < high {
            return Err(Error::new(format!(
                "a stadium bead {} mm wide cannot be {high} mm high",
                self.bead_width
            ))
            .hint(
                "set carve.bead_width higher, carve.layer_height lower, or carve.bead_section = \"ellipse\"",
            ));
        }
        if self.bead_width.0 > 3 * machine.nozzle.0 {
            notes.say(format!(
                "a bead of {} mm is wide for a nozzle of {} mm",
                self.bead_width, machine.nozzle
            ));
        }
        if self.layer_height > machine.nozzle {
            notes.say(format!(
                "layers of {} mm are not pressed by a nozzle of {} mm",
                self.layer_height, machine.nozzle
            ));
        }
        Ok(())
    }

    fn facts(&self, machine: &Machine) -> Facts {
        let bead = Bead { width: self.bead_width, height: self.layer_height, section: self.bead_section };
        Facts {
            decimals: Some(Micron::PLACES),
            layer_height: Some(self.layer_height),
            first_layer_height: Some(self.first_layer_height),
            nozzle: Some(machine.nozzle),
            e_unit: Some(machine.e_unit),
            heaters: Some(machine.heaters),
            bed: Some(machine.area()),
            bead_section: Some(self.bead_section),
            infill_width: Some(bead.spacing()),
            bead_width: Some(self.bead_width),
            ..Facts::default()
        }
    }

    /// How far the part moves to where it is printed.
    fn shift(&self, min: Point3, max: Point3, machine: &Machine) -> Point3 {
        let (x, y) = match self.place {
            Place::Keep => (0, 0),
            Place::Bed => {
                let (left, front) = machine.least();
                let middle = |low: i32, high: i32| ((i64::from(low) + i64::from(high)).div_euclid(2)) as i32;
                (
                    left + machine.bed.x.0 / 2 - middle(min.x, max.x),
                    front + machine.bed.y.0 / 2 - middle(min.y, max.y),
                )
            }
        };
        Point3 { x, y, z: -min.z }
    }

    fn find_bridges(&self, slices: &mut Slices, mesh: &TriangleMesh, planes: &[i32]) {
        let reach = bridge::REACH * self.bead_width.um();
        let candidates = planes_over_undersides(mesh, planes, reach / self.layer_height.um());
        let directions: Vec<Option<Direction>> = (0..slices.layers.len())
            .into_par_iter()
            .map(|index| {
                let below = slices.layers.get(index.checked_sub(1)?)?;
                if !candidates[index] || below.loops.is_empty() {
                    return None;
                }
                bridge::direction(&slices.layers[index].loops, &below.loops, self.bead_width.um())
            })
            .collect();
        for (layer, rotation) in slices.layers.iter_mut().zip(directions) {
            layer.rotation = rotation;
        }
    }
}

/// Corners of the mesh nearer than this to a straight side are dropped: a hundredth of a bead, but never more than
/// five microns, which no nozzle of a millimetre can show.
const SIMPLIFY: f64 = 5.0;

fn moved(point: Point3, by: Point3) -> Point3 {
    Point3 { x: point.x + by.x, y: point.y + by.y, z: point.z + by.z }
}

fn slid(mut ring: Ring, by: Point3) -> Ring {
    for point in &mut ring.0 {
        *point = Point::new(point.x + by.x, point.y + by.y);
    }
    ring
}

/// Whether the part has its place on the machine.
fn fits(bounds: &Bounds, machine: &Machine) -> Result<(), Error> {
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
        .hint("carve.place = \"bed\" puts it on the middle of the bed"));
    }
    Ok(())
}

/// Whether every corner of the part lies on an elliptic bed.
fn fits_round_bed(mesh: &TriangleMesh, shift: Point3, machine: &Machine) -> Result<(), Error> {
    if machine.shape == BedShape::Rectangle {
        return Ok(());
    }
    let (left, front) = machine.least();
    let (half_x, half_y) = (machine.bed.x.um() / 2.0, machine.bed.y.um() / 2.0);
    let beside = mesh.vertices.iter().find(|vertex| {
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

#[cfg(test)]
mod tests;
