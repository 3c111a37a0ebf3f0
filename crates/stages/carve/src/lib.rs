#![doc = include_str!("../README.md")]

mod bridge;
mod drawn;
mod gaps;
mod loops;
mod planes;
mod plate;

use loops::{How, Layer};
use planes::Slab;
use rayon::prelude::*;
use shape::solid::{Sections, planes_over_undersides};
use shape::{Bounds, Point, Point3, Ring, TriangleMesh};
use skein::{
    Bead, Choice, Direction, Error, Facts, Machine, Micron, Notes, RotatedLoopLayer, Section, Settings,
    Slices,
};
use std::borrow::Cow;

pub use plate::Rotation;

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
    /// How many of the lowest layers are left out, to print the upper part of a pot alone.
    #[setting(default = 0, min = 0, max = 1000000)]
    pub skip_lowest: u32,
    /// How many of the topmost layers are left out.
    #[setting(default = 0, min = 0, max = 1000000)]
    pub skip_topmost: u32,
    /// Where the part is put before it is cut.
    #[setting(default = Place::Bed)]
    pub place: Place,
    /// How the part is turned before it is put there: about x, then about y, then about z, each counter-clockwise seen
    /// from the end of the axis.
    #[setting(default = Rotation::default(), min = -360.0, max = 360.0, unit = "degrees")]
    pub rotate: Rotation,
    /// How far apart several parts stand on the bed.
    #[setting(default = 10.0, min = 0.0, max = 1000.0, unit = "mm")]
    pub part_gap: Micron,
    /// What the surface of the part is.
    #[setting(default = Surface::Solid)]
    pub surface: Surface,
    /// How many beads thick the wall is when `surface` is "wall".
    #[setting(default = 1, min = 1, max = 20)]
    pub wall_beads: u32,
    /// Whether a mesh that is open or disagrees with itself is repaired before it is cut: cracks and T-junctions closed,
    /// duplicate faces left out, flipped ones turned over, holes closed. Each repair is reported; a sound mesh is never
    /// changed.
    #[setting(default = true)]
    pub repair: bool,
    /// The widest gap in an open outline that is closed with a straight line, and the widest hole in the mesh that is
    /// closed although it is not flat.
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
    /// Just where its file has it: what lies below the bed is cut off.
    File,
}

/// What the surface of a part is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Surface {
    /// The outside of a solid.
    Solid,
    /// A skin without thickness: a wall is laid with the skin in its middle.
    Wall,
}

impl Carve {
    /// The craft word.
    pub const NAME: &'static str = "carve";

    /// Cuts the part.
    ///
    /// # Errors
    /// When there is nothing to print, or the part does not fit the machine.
    pub fn carve(&self, part: &TriangleMesh, machine: &Machine, notes: &mut Notes) -> Result<Slices, Error> {
        self.carve_all(std::slice::from_ref(part), machine, notes)
    }

    /// Puts several parts side by side on the bed and cuts them.
    ///
    /// # Errors
    /// When there is nothing to print, or the parts do not fit the machine.
    pub fn carve_all(
        &self,
        parts: &[TriangleMesh],
        machine: &Machine,
        notes: &mut Notes,
    ) -> Result<Slices, Error> {
        self.check_bead(machine, notes)?;
        let mut mesh = self.plate(parts, machine, notes)?;
        let spot = self.spot(mesh.bounds(), machine, notes)?;
        let corners = mesh.vertices.iter().map(|corner| Point::new(corner.x, corner.y));
        plate::fits(corners, spot.shift, &spot.bounds, machine)?;
        let slabs = planes::slabs(Micron(spot.bounds.max.z), self.first_layer_height, self.layer_height)?;
        let slabs = self.kept(slabs)?;
        // The part is cut where it lies and its loops are moved: a million vertices need not be.
        let planes: Vec<i32> = slabs.iter().map(|slab| slab.middle.0 - spot.shift.z).collect();
        let mut cut = self.cut(&mesh, &planes, spot.shift);
        // Only where shells meet, or enclose nothing, does it matter which way each of them is turned.
        let doubtful =
            cut.iter().any(|layer| layer.crossed) || cut.iter().all(|layer| layer.loops.is_empty());
        if self.repair
            && doubtful
            && let Some(turned) = self.reconsidered(&mesh, notes)
        {
            mesh = Cow::Owned(turned);
            cut = self.cut(&mesh, &planes, spot.shift);
        }
        let slices = self.slices(&slabs, cut, spot.bounds, machine, notes)?;
        Ok(if self.find_bridges { self.with_bridges(slices, &mesh, &planes) } else { slices })
    }

    /// The layers without those that are left out below and above.
    fn kept<T>(&self, mut slabs: Vec<T>) -> Result<Vec<T>, Error> {
        let count = slabs.len();
        let (below, above) = (self.skip_lowest as usize, self.skip_topmost as usize);
        if below.saturating_add(above) >= count {
            return Err(Error::new(format!("of {count} layers none is left"))
                .hint("lower carve.skip_lowest and carve.skip_topmost"));
        }
        slabs.truncate(count - above);
        Ok(slabs.split_off(below))
    }

    /// The loops of every layer, where they are printed.
    fn cut(&self, mesh: &TriangleMesh, planes: &[i32], shift: Point3) -> Vec<Layer> {
        let sections = Sections::new(mesh, planes);
        let bead = Bead { width: self.bead_width, height: self.layer_height, section: self.bead_section };
        // The outermost middles of the beads lie half a width inside, the others a spacing apart.
        let wall = self.bead_width.um() + f64::from(self.wall_beads - 1) * bead.spacing().um();
        let how = How {
            close_gaps: self.close_gaps.um(),
            tolerance: self.tolerance(),
            wall: (self.surface == Surface::Wall).then_some(wall),
        };
        (0..planes.len())
            .into_par_iter()
            .map(|layer| {
                let mut cut = loops::of_chains(sections.at(layer), how, layer);
                cut.loops = cut.loops.into_iter().map(|ring| slid(ring, shift)).collect();
                cut
            })
            .collect()
    }

    /// How near to a straight side a corner must be to be dropped, in microns.
    fn tolerance(&self) -> f64 {
        (self.bead_width.um() / 100.0).min(SIMPLIFY)
    }

    /// The layers as a document.
    fn slices(
        &self,
        slabs: &[Slab],
        cut: Vec<Layer>,
        bounds: Bounds,
        machine: &Machine,
        notes: &mut Notes,
    ) -> Result<Slices, Error> {
        let lost: f64 = cut.iter().map(|layer| layer.lost).sum();
        let kept = || cut.iter().flat_map(|layer| &layer.loops).map(Ring::length).sum::<f64>();
        if lost > 0.0 && lost > kept() {
            let open = cut.iter().filter(|layer| layer.lost > 0.0).count();
            return Err(Error::new(format!(
                "the part is no solid: in {open} of {} layers the outline is open wider than can be closed",
                cut.len()
            ))
            .hint(format!(
                "{SKIN}; or set carve.close_gaps above {} mm, or repair the model in the program that made it",
                self.close_gaps
            )));
        }
        if cut.iter().all(|layer| layer.loops.is_empty()) {
            return Err(Error::new("the part has no volume: no layer has an outline").hint(SKIN));
        }
        let mut slices = Slices { facts: self.facts(machine), bounds, ..Slices::default() };
        for (index, (slab, layer)) in slabs.iter().zip(cut).enumerate() {
            notes.append(layer.notes);
            if layer.loops.is_empty() {
                notes.layer(index, NOTHING_HERE);
            }
            let thickness = (slab.height != self.layer_height).then_some(slab.height);
            slices.layers.push(RotatedLoopLayer {
                z: slab.middle,
                thickness,
                rotation: None,
                loops: layer.loops,
            });
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
            start_lag: Some(machine.lag),
            stop_lag: Some(machine.lag),
            bed: Some(machine.area()),
            bead_section: Some(self.bead_section),
            infill_width: Some(bead.spacing()),
            bead_width: Some(self.bead_width),
            ..Facts::default()
        }
    }

    fn with_bridges(&self, mut slices: Slices, mesh: &TriangleMesh, planes: &[i32]) -> Slices {
        let reach = bridge::REACH * self.bead_width.um();
        let candidates = planes_over_undersides(mesh, planes, reach / self.layer_height.um());
        self.bridged(&mut slices, |index| candidates[index]);
        slices
    }

    /// Looks for bridges in the layers that may have some.
    fn bridged(&self, slices: &mut Slices, may_be: impl Fn(usize) -> bool + Sync) {
        let directions: Vec<Option<Direction>> = (0..slices.layers.len())
            .into_par_iter()
            .map(|index| {
                let below = slices.layers.get(index.checked_sub(1)?)?;
                if !may_be(index) || below.loops.is_empty() {
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

/// What is said of a layer without loops.
const NOTHING_HERE: &str = "nothing of the part is in this layer: what is above has nothing to stand on";

/// What helps when a surface encloses nothing.
const SKIN: &str = "a surface of one skin is printed as a wall with carve.surface = \"wall\"";

fn slid(mut ring: Ring, by: Point3) -> Ring {
    for point in &mut ring.0 {
        *point = Point::new(point.x + by.x, point.y + by.y);
    }
    ring
}

#[cfg(test)]
mod exact;
#[cfg(test)]
mod tests;
