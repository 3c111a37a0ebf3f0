//! What holds up the overhangs: where it is needed, and where it stands.
//!
//! Regions here hold the middles of beads. An overhang is what of a layer the layer below does not carry; from there a
//! column goes straight down, less whatever part is in its way, and on each layer less what would come too near to a
//! wall.

use crate::bed::Bed;
use crate::lay::{self, Rows, zigzag};
use crate::{Raft, SupportChoice};
use rayon::prelude::*;
use shape::plane::boolean::{common, difference, positive};
use shape::plane::{all_simplified, islands, offset};
use skein::{Bead, Error, Facts, Layer, Notes, Point, Ring};

/// The support of one layer.
#[derive(Clone, Default)]
pub(crate) struct Support {
    /// Where the middles of its beads may go.
    pub(crate) region: Vec<Ring>,
    /// Its beads.
    pub(crate) threads: Vec<Vec<Point>>,
}

/// Half the width, in beads, of an overhang that is mere rounding.
const SLIVER: f64 = 0.005;

/// A column keeps no corner nearer to a straight line than so much of a bead.
const FINENESS: f64 = 50.0;

/// The support of every layer.
pub(crate) fn find(
    raft: &Raft,
    layers: &[Layer],
    outlines: &[Vec<Ring>],
    facts: &Facts,
    bed: &Bed,
    notes: &mut Notes,
) -> Result<Vec<Support>, Error> {
    let site = Site { raft, outlines, width: facts.bead_width()?.um() };
    let overhangs = match raft.support {
        SupportChoice::None => return Ok(vec![Support::default(); layers.len()]),
        SupportChoice::EmptyLayersOnly => Vec::new(),
        _ => site.overhangs(layers),
    };
    let columns = match raft.support {
        SupportChoice::EmptyLayersOnly => site.bridges(),
        _ => site.columns(&overhangs),
    };
    let laid: Vec<Result<(Support, bool), Error>> = columns
        .par_iter()
        .enumerate()
        .map(|(index, column)| {
            let bead = facts.bead()?.of_height(layers[index].height(facts)?);
            Ok(site.lay(index, column, &overhangs, &bead, bed))
        })
        .collect();
    let mut supports = Vec::with_capacity(laid.len());
    for (index, result) in laid.into_iter().enumerate() {
        let (support, lost) = result.map_err(|error| error.in_layer(index))?;
        if lost {
            notes.layer(index, "support shorter than a bead is left out");
        }
        supports.push(support);
    }
    Ok(supports)
}

/// The part and what is wanted under it.
struct Site<'a> {
    raft: &'a Raft,
    outlines: &'a [Vec<Ring>],
    width: f64,
}

impl Site<'_> {
    /// For every layer, what of the layer above has to stand on it.
    fn overhangs(&self, layers: &[Layer]) -> Vec<Vec<Ring>> {
        let tangent = libm::tan(self.raft.support_minimum_angle.degrees().to_radians());
        let margin = self.raft.support_margin.f64() * self.width;
        let sliver = SLIVER * self.width;
        (0..self.outlines.len())
            .into_par_iter()
            .map(|index| {
                let Some(above) = self.outlines.get(index + 1).filter(|above| !above.is_empty()) else {
                    return Vec::new();
                };
                let below = &self.outlines[index];
                let rise = f64::from(layers[index + 1].z().0) - f64::from(layers[index].z().0);
                let carried = offset(below, tangent * rise + sliver);
                let hanging = offset(&difference(above, &carried), -sliver);
                if hanging.is_empty() {
                    return hanging;
                }
                let grown = offset(&hanging, sliver + margin);
                on_this_side(difference(&grown, below), &hanging)
            })
            .collect()
    }

    /// For every layer, where support for what is above it stands.
    fn columns(&self, overhangs: &[Vec<Ring>]) -> Vec<Vec<Ring>> {
        let below = (self.raft.support == SupportChoice::ExteriorOnly).then(|| self.shadows());
        let solid = below.as_deref().unwrap_or(self.outlines);
        let mut columns = vec![Vec::new(); overhangs.len()];
        let mut column: Vec<Ring> = Vec::new();
        for index in (0..overhangs.len()).rev() {
            column.extend_from_slice(&overhangs[index]);
            if column.is_empty() {
                continue;
            }
            let free = difference(&column, &solid[index]);
            column = all_simplified(&free, self.width / FINENESS);
            columns[index].clone_from(&column);
        }
        columns
    }

    /// For every layer, all that lies on it or below.
    fn shadows(&self) -> Vec<Vec<Ring>> {
        let mut shadow: Vec<Ring> = Vec::new();
        let grow = |outlines: &Vec<Ring>| {
            let mut both = outlines.clone();
            both.append(&mut shadow);
            shadow = all_simplified(&positive(&both), self.width / FINENESS);
            shadow.clone()
        };
        self.outlines.iter().map(grow).collect()
    }

    /// For every empty layer, what the layers that are not empty next above and below have in common.
    fn bridges(&self) -> Vec<Vec<Ring>> {
        let mut bridges = vec![Vec::new(); self.outlines.len()];
        let full: Vec<usize> =
            (0..self.outlines.len()).filter(|index| !self.outlines[*index].is_empty()).collect();
        for pair in full.windows(2).filter(|pair| pair[1] - pair[0] > 1) {
            let inner = |index: usize| offset(&self.outlines[index], -self.width / 4.0);
            let both = common(&inner(pair[0]), &inner(pair[1]));
            bridges[pair[0] + 1..pair[1]].fill(both);
        }
        bridges
    }

    /// The beads of one layer, and whether some were too short to be laid.
    fn lay(
        &self,
        index: usize,
        column: &[Ring],
        overhangs: &[Vec<Ring>],
        bead: &Bead,
        bed: &Bed,
    ) -> (Support, bool) {
        if column.is_empty() {
            return (Support::default(), false);
        }
        let raft = self.raft;
        let guard = self.width * (raft.support_gap.f64() + 0.5);
        let free = difference(column, &offset(&self.outlines[index], guard));
        let (region, _) = bed.part_of(free);
        let last = overhangs.len().min(index + raft.support_interface_layers as usize);
        let near: Vec<Ring> = overhangs.get(index..last).unwrap_or_default().concat();
        let (dense, sparse) = if index < raft.support_base_layers as usize {
            (region.clone(), Vec::new())
        } else if near.is_empty() {
            (Vec::new(), region.clone())
        } else {
            (common(&region, &near), difference(&region, &near))
        };
        let turned = raft.support_cross_hatch && index % 2 == 1;
        let direction = if turned { (0.0, 1.0) } else { (1.0, 0.0) };
        let spacing = bead.spacing().um().max(1.0);
        let rows =
            |region: &[Ring], density: f64| zigzag(region, direction, spacing / density, Rows::Aligned);
        let mut threads = rows(&sparse, raft.support_density.f64());
        threads.extend(rows(&dense, raft.interface_density.f64()));
        let all = threads.len();
        threads.retain(|points| lay::length(points) >= self.width);
        let lost = threads.len() < all;
        (Support { region, threads }, lost)
    }
}

/// The islands of a grown region that have something of what they have grown from: growing leads through thin walls.
fn on_this_side(grown: Vec<Ring>, core: &[Ring]) -> Vec<Ring> {
    let islands = islands(&grown);
    if islands.len() < 2 {
        return grown;
    }
    let boxes: Vec<_> = core.iter().map(|ring| ring.bounds().unwrap_or_default()).collect();
    let has_some = |island: &Vec<Ring>| {
        let (low, high) = island[0].bounds().unwrap_or_default();
        let near = |(least, most): (Point, Point)| {
            least.x <= high.x && low.x <= most.x && least.y <= high.y && low.y <= most.y
        };
        let near: Vec<Ring> = core
            .iter()
            .zip(&boxes)
            .filter(|(_, corners)| near(**corners))
            .map(|(ring, _)| ring.clone())
            .collect();
        !common(island, &near).is_empty()
    };
    islands.into_iter().filter(has_some).flatten().collect()
}
