#![doc = include_str!("../README.md")]

mod absorb;
mod grid;
mod order;
mod report;
mod sheet;
mod strand;
#[cfg(test)]
mod tests;
mod tree;
mod visit;
mod walk;

use rayon::prelude::*;
use grid::Side;
use report::Report;
use sheet::{Island, Path, Sheet};
use skein::{Choice, Error, Layer, Notes, Point, Ratio, Settings, Skein, Stage};
use tree::{Start, Weave};

/// Makes one thread of everything that is laid on an island.
#[derive(Clone, Debug, Settings)]
pub struct Join {
    /// Where the thread of an island begins, and where its walls are joined.
    #[setting(default = Seam::Nearest)]
    pub seam: Seam,
    /// The place that the seam is nearest to, when `seam` is "aligned".
    #[setting(default = Point::new(0, 0), min = -100000.0, max = 100000.0, unit = "mm")]
    pub seam_place: Point,
    /// Whether clay flows on while the nozzle rises, where the next layer begins within a bead or two of where this one
    /// ends. Then a part of one island is one thread. Not for several copies of a part (`multiply`).
    #[setting(default = false)]
    pub through_layers: bool,
    /// How many times at most clay may stop before the end. A part that needs more is refused, with the first place.
    /// 1000000 is any number.
    #[setting(default = 1000000, min = 0, max = 1000000)]
    pub max_interruptions: u32,
}

/// Where the thread of an island begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Seam {
    /// Near to where the thread before has ended: the shortest travels.
    Nearest,
    /// Nearest to `seam_place`: all seams above each other.
    Aligned,
    /// At the back: where y is greatest.
    Behind,
}

impl Stage for Join {
    const NAME: &'static str = "join";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        let nozzles = skein.nozzles();
        if nozzles.iter().any(|nozzle| nozzle.on) {
            notes.say("clay goes on from layer to layer already, as coil has it: everything stays as it is");
            return Ok(skein);
        }
        let spacings = skein
            .layers
            .iter()
            .enumerate()
            .map(|(index, layer)| {
                let height = layer.height(&facts).map_err(|error| error.in_layer(index))?;
                Ok(facts.bead()?.of_height(height).spacing().um().max(1.0))
            })
            .collect::<Result<Vec<f64>, Error>>()?;
        let mut sheets = std::mem::take(&mut skein.layers)
            .into_par_iter()
            .zip(&nozzles)
            .enumerate()
            .map(|(index, (layer, entering))| {
                let z = layer.nozzle_z(&facts)?.0;
                let mut sheet = Sheet::read(layer, z, entering).map_err(|error| error.in_layer(index))?;
                for island in &mut sheet.islands {
                    island.strands = absorb::absorb(std::mem::take(&mut island.strands), spacings[index]);
                }
                Ok(sheet)
            })
            .collect::<Result<Vec<Sheet>, Error>>()?;
        let paths = self.plan(&mut sheets, &spacings);
        let report = Report::new(&sheets, &paths, spacings.first().copied().unwrap_or(1.0));
        report.say(self, notes)?;
        let last = sheets.len().saturating_sub(1);
        let (first_flow, last_flow) = match (nozzles.first(), nozzles.last()) {
            (Some(first), Some(last)) => (first.flow, last.flow),
            _ => (Ratio::ONE, Ratio::ONE),
        };
        skein.layers = sheets
            .into_par_iter()
            .enumerate()
            .map(|(index, sheet)| {
                let entering = if index == 0 { first_flow } else { Ratio::ONE };
                let leaving = if index == last { last_flow } else { Ratio::ONE };
                let goes_on = paths.get(index + 1).is_some_and(|next| flows_on(next));
                Layer { lines: sheet.write(&paths[index], entering, leaving, goes_on) }
            })
            .collect();
        Ok(skein)
    }
}

/// Whether the first thread of a layer comes from the layer below.
fn flows_on(paths: &[Vec<Path>]) -> bool {
    paths.iter().flatten().next().is_some_and(|first| first.flows_on)
}

impl Join {
    /// The paths of every layer, island by island; the islands are put in order. Where a layer begins depends on where the
    /// one before ended.
    fn plan(&self, sheets: &mut [Sheet], spacings: &[f64]) -> Vec<Vec<Vec<Path>>> {
        let mut here: Option<Point> = None;
        let mut layers: Vec<Vec<Vec<Path>>> = Vec::with_capacity(sheets.len());
        for (sheet, spacing) in sheets.iter_mut().zip(spacings) {
            let from = here.unwrap_or(self.seam_place);
            let boxes: Vec<(Point, Point)> = sheet.islands.iter().map(Island::bounds).collect();
            let mut islands: Vec<Option<Island>> =
                std::mem::take(&mut sheet.islands).into_iter().map(Some).collect();
            sheet.islands =
                order::order(from, &boxes).into_iter().filter_map(|index| islands[index].take()).collect();
            let rise = if self.through_layers { *spacing } else { 0.0 };
            let before = here;
            let mut layer: Vec<Vec<Path>> = Vec::with_capacity(sheet.islands.len());
            for island in &sheet.islands {
                let paths = self.join(island, *spacing, rise, here);
                here = paths.last().map(Path::closed_end).or(here);
                layer.push(paths);
            }
            if let (true, Some(before), Some(first)) =
                (self.through_layers, before, layer.iter_mut().flatten().next())
            {
                let near = before.distance(first.start) <= tree::REACH * spacing;
                // Nothing flows through a layer without beads.
                first.flows_on =
                    near && layers.last().is_some_and(|below| below.iter().any(|paths| !paths.is_empty()));
            }
            layers.push(layer);
        }
        layers
    }

    /// The threads of an island.
    fn join(&self, island: &Island, spacing: f64, rise: f64, here: Option<Point>) -> Vec<Path> {
        let start = self.start(island, spacing, here);
        let trees = Weave::new(&island.strands, &island.outlines, spacing).trees(start);
        let mut paths: Vec<Path> = trees.iter().map(|tree| walk::path(&island.strands, tree, rise)).collect();
        // The greatest is first, at the seam; the others follow from its end.
        if paths.len() > 2 {
            let boxes: Vec<(Point, Point)> = paths[1..].iter().map(|path| (path.start, path.start)).collect();
            let order = order::order(paths[0].closed_end(), &boxes);
            let mut others: Vec<Option<Path>> = paths.drain(1..).map(Some).collect();
            paths.extend(order.into_iter().filter_map(|index| others[index].take()));
        }
        paths
    }

    /// Where the thread of an island begins. It must be there when that is what was asked for, or when clay flows on from
    /// where the thread before has ended.
    fn start(&self, island: &Island, spacing: f64, here: Option<Point>) -> Start {
        let place = match self.seam {
            Seam::Nearest => here.unwrap_or(self.seam_place),
            Seam::Aligned => self.seam_place,
            Seam::Behind => island.back().or(here).unwrap_or(self.seam_place),
        };
        let flows = || {
            let reach = tree::REACH * spacing;
            self.through_layers && here.is_some_and(|here| island.is_near(here, reach))
        };
        Start { place, fixed: self.seam != Seam::Nearest || flows() }
    }
}

impl Island {
    /// Whether one of its walls is near a place.
    fn is_near(&self, place: Point, reach: f64) -> bool {
        let walls = self.strands.iter().filter(|strand| strand.closed);
        let mut sides = walls.flat_map(|strand| strand.sides());
        sides.any(|(start, from, to)| Side { owner: 0, start, from, to }.nearest(place).1 <= reach)
    }

    /// The box around its beads.
    fn bounds(&self) -> (Point, Point) {
        let mut points = self.strands.iter().flat_map(|strand| strand.points());
        let first = points.next().copied().unwrap_or_default();
        points.fold((first, first), |(low, high), point| {
            (
                Point::new(low.x.min(point.x), low.y.min(point.y)),
                Point::new(high.x.max(point.x), high.y.max(point.y)),
            )
        })
    }

    /// Its hindmost place.
    fn back(&self) -> Option<Point> {
        let points = self.strands.iter().flat_map(|strand| strand.points());
        points.copied().max_by_key(|point| (point.y, point.x))
    }
}
