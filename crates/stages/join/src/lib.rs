#![doc = include_str!("../README.md")]

mod absorb;
mod fence;
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

use grid::Side;
use rayon::prelude::*;
use report::Report;
use shape::plane::Bounds;
use sheet::{Island, Path, Plan, Sheet};
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

/// How many layers are prepared together.
const BATCH: usize = 64;

impl Stage for Join {
    const NAME: &'static str = "join";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        let nozzles = skein.nozzles();
        let spacings = skein
            .layers
            .iter()
            .enumerate()
            .map(|(index, layer)| {
                let height = layer.height(&facts).map_err(|error| error.in_layer(index))?;
                Ok(facts.bead()?.of_height(height).spacing().um().max(1.0))
            })
            .collect::<Result<Vec<f64>, Error>>()?;
        let sheets = std::mem::take(&mut skein.layers)
            .into_par_iter()
            .zip(nozzles.par_windows(2))
            .enumerate()
            .map(|(index, (layer, nozzles))| {
                let z = layer.nozzle_z(&facts)?.0;
                let sheet = Sheet::read(layer, z, &nozzles[0], &nozzles[1]);
                let mut sheet = sheet.map_err(|error| error.in_layer(index))?;
                for island in &mut sheet.islands {
                    island.strands = absorb::absorb(std::mem::take(&mut island.strands), spacings[index]);
                }
                Ok(sheet)
            })
            .collect::<Result<Vec<Sheet>, Error>>()?;
        let left = sheets.iter().filter(|sheet| sheet.kept.is_some()).count();
        if left > 0 {
            notes.say(format!(
                "{left} layers stay as they are: clay goes on from layer to layer there already"
            ));
        }
        let plans = self.plan(&sheets, &spacings);
        let report = Report::new(&sheets, &plans, spacings.first().copied().unwrap_or(1.0));
        report.say(self, notes)?;
        // What is written anew begins and ends with beads of the nominal section, except beside what stays.
        let is_new = |index: usize| sheets.get(index).is_some_and(|sheet| sheet.kept.is_none());
        let flows: Vec<(Ratio, Ratio)> = (0..sheets.len())
            .map(|index| {
                let first = index.checked_sub(1).is_some_and(is_new);
                let entering = if first { Ratio::ONE } else { nozzles[index].flow };
                let leaving = if is_new(index + 1) { Ratio::ONE } else { nozzles[index + 1].flow };
                (entering, leaving)
            })
            .collect();
        skein.layers = sheets
            .into_par_iter()
            .enumerate()
            .map(|(index, sheet)| {
                let goes_on = plans.get(index + 1).is_some_and(Plan::flows_on);
                Layer { lines: sheet.write(&plans[index], flows[index], goes_on) }
            })
            .collect();
        Ok(skein)
    }
}

impl Join {
    /// The order of the islands of every layer, and their paths. Where a layer begins depends on where the one before
    /// ended.
    fn plan<'a>(&self, sheets: &'a [Sheet], spacings: &[f64]) -> Vec<Plan> {
        let mut here: Option<Point> = None;
        let mut plans: Vec<Plan> = Vec::with_capacity(sheets.len());
        // What lies beside what is found side by side while the layers below are planned, for so many at a time that it takes
        // little room.
        let mut batches = sheets.chunks(BATCH).zip(spacings.chunks(BATCH)).peekable();
        let weave = |batch: Option<&(&'a [Sheet], &[f64])>| -> Vec<Vec<Weave<'a>>> {
            let (sheets, spacings) = batch.copied().unwrap_or_default();
            sheets.par_iter().zip(spacings).map(|(sheet, spacing)| sheet.weaves(*spacing)).collect()
        };
        let mut weaves = weave(batches.peek());
        while let Some((sheets, spacings)) = batches.next() {
            let next = batches.peek();
            let plan = || {
                for ((sheet, weaves), spacing) in sheets.iter().zip(weaves).zip(spacings) {
                    let plan = self.plan_layer(sheet, weaves, *spacing, &mut here, plans.last());
                    plans.push(plan);
                }
            };
            ((), weaves) = rayon::join(plan, || weave(next));
        }
        plans
    }

    /// The same for a layer; `here` is where the layer below has ended, and then where this one does.
    fn plan_layer(
        &self,
        sheet: &Sheet,
        weaves: Vec<Weave>,
        spacing: f64,
        here: &mut Option<Point>,
        below: Option<&Plan>,
    ) -> Plan {
        if let Some(end) = sheet.kept {
            *here = end.or(*here);
            return Plan::default();
        }
        let boxes: Vec<Bounds> = sheet.islands.iter().map(Island::bounds).collect();
        let order = order::order(here.unwrap_or(self.seam_place), &boxes);
        let mut plan = Plan { order, paths: Vec::with_capacity(boxes.len()) };
        let rise = if self.through_layers { spacing } else { 0.0 };
        let before = *here;
        let mut weaves: Vec<Option<Weave>> = weaves.into_iter().map(Some).collect();
        for index in &plan.order {
            let Some(weave) = weaves[*index].take() else { continue };
            let paths = self.join(&sheet.islands[*index], weave, spacing, rise, *here);
            *here = paths.last().map(Path::closed_end).or(*here);
            plan.paths.push(paths);
        }
        if let (true, Some(before), Some(first)) =
            (self.through_layers, before, plan.paths.iter_mut().flatten().next())
        {
            // Nothing flows through a layer without beads.
            first.flows_on = before.distance(first.start) <= tree::REACH * spacing
                && below.is_some_and(|below| below.paths.iter().any(|paths| !paths.is_empty()));
        }
        plan
    }

    /// The threads of an island.
    fn join(&self, island: &Island, weave: Weave, spacing: f64, rise: f64, here: Option<Point>) -> Vec<Path> {
        let start = self.start(island, spacing, here);
        let trees = weave.trees(start);
        let mut paths: Vec<Path> = trees.iter().map(|tree| walk::path(&island.strands, tree, rise)).collect();
        // The greatest is first, at the seam; the others follow from its end.
        if paths.len() > 2 {
            let boxes: Vec<Bounds> = paths[1..].iter().map(|path| (path.start, path.start)).collect();
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
    fn bounds(&self) -> Bounds {
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
