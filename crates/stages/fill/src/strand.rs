//! One unbroken bead and the island it lies on.

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
    let outsides: Vec<usize> =
        (0..outlines.len()).filter(|index| Side::of(&outlines[*index]) == Side::Outer).collect();
    let mut islands: Vec<Island> =
        outsides.iter().map(|index| Island { outlines: vec![*index], strands: Vec::new() }).collect();
    if islands.is_empty() {
        islands.push(Island::default());
    }
    let areas: Vec<i128> = outsides.iter().map(|index| outlines[*index].area2()).collect();
    let boxes: Vec<(Point, Point)> =
        outsides.iter().map(|index| outlines[*index].bounds().unwrap_or_default()).collect();
    // The smallest outside that holds the point: islands may lie in holes of others.
    let home = |point: Option<&Point>| match (outsides.len(), point) {
        (0 | 1, _) | (_, None) => 0,
        (_, Some(point)) => (0..outsides.len())
            .filter(|island| {
                let (low, high) = boxes[*island];
                let near = (low.x..=high.x).contains(&point.x) && (low.y..=high.y).contains(&point.y);
                near && outlines[outsides[*island]].contains(*point)
            })
            .min_by_key(|island| areas[*island])
            .unwrap_or(0),
    };
    for (index, outline) in outlines.iter().enumerate() {
        if Side::of(outline) == Side::Inner {
            islands[home(outline.0.first())].outlines.push(index);
        }
    }
    for strand in strands {
        islands[home(strand.points.first())].strands.push(strand);
    }
    islands
}
