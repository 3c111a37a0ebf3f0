//! One unbroken bead and the island it lies on.

use crate::map::Map;
use shape::plane::MiddleLine;
use skein::{Bead, Feature, Micron, Point, Ratio, Ring, Side};

/// One unbroken bead.
#[derive(Clone, Debug, PartialEq)]
pub struct Strand {
    /// What it is for.
    pub feature: Feature,
    /// Its corners; a closed one does not repeat its first.
    pub points: Vec<Point>,
    /// The share of a nominal bead's section on each stretch; one where nothing is said.
    pub flows: Vec<Ratio>,
    /// Whether it ends where it starts.
    pub closed: bool,
}

/// An island of a layer: an outside with the holes in it, and everything laid on it.
#[derive(Clone, Debug, Default)]
pub struct Island {
    /// The outlines, as indices into those of the layer, the outside first.
    pub outlines: Vec<usize>,
    /// What is laid, in order once it has been put in order.
    pub strands: Vec<Strand>,
}

impl Strand {
    /// A bead along a middle line: as much clay on each stretch as there is room.
    pub fn middle(line: MiddleLine, bead: &Bead) -> Self {
        let flows = line.widths.windows(2).map(|pair| share(bead, f64::midpoint(pair[0], pair[1]))).collect();
        Self { feature: Feature::Middle, points: line.points, flows, closed: false }
    }

    /// The other way round.
    pub fn reverse(&mut self) {
        self.points.reverse();
        self.flows.reverse();
    }
}

/// The share of a nominal bead that fills a room of some width in microns; in hundredths, which is finer than any ram
/// and keeps lines few.
pub fn share(bead: &Bead, room: f64) -> Ratio {
    let area = room / 1000.0 * bead.height.mm();
    Ratio::from_f64((area / bead.area() * 100.0).round() / 100.0).unwrap_or(Ratio::ONE)
}

/// The bead's room beside its neighbours, in microns.
pub fn spacing(bead: &Bead) -> f64 {
    bead.spacing().um().max(Micron(1).um())
}

/// Puts every strand on the island it lies on.
pub fn sort_into_islands(outlines: &[Ring], strands: Vec<Strand>) -> Vec<Island> {
    let (outsides, holes): (Vec<usize>, Vec<usize>) =
        (0..outlines.len()).partition(|index| Side::of(&outlines[*index]) == Side::Outer);
    let mut islands: Vec<Island> =
        outsides.iter().map(|index| Island { outlines: vec![*index], strands: Vec::new() }).collect();
    if islands.is_empty() {
        islands.push(Island { outlines: holes, strands });
        return islands;
    }
    let map = Map::new(outlines, &outsides);
    for hole in holes {
        let home = map.home(&outlines[hole].0);
        islands[home].outlines.push(hole);
    }
    for strand in strands {
        let home = map.home(&strand.points);
        islands[home].strands.push(strand);
    }
    islands
}
