//! Takes the pressure off the clay in front of a travel and puts it on again behind: E words of their own, before the
//! metering counts them.

use crate::Dimension;
use crate::outlines::Outlines;
use rayon::prelude::*;
use skein::{EUnit, Error, Extrusion, Facts, Feed, Layer, Line, Move, Nozzle, Pen, Point, Ratio, Skein};

/// What is drawn back and pushed in, in the machine's unit of E.
pub(crate) struct Relief<'a> {
    settings: &'a Dimension,
    /// Hundred-thousandths of E per mm³.
    per_mm3: f64,
    /// The least step of an E word in hundred-thousandths.
    step: i64,
}

/// More steps than this no E word of its own can be.
const LIMIT: f64 = 1e12;

/// A travel from one bead to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Gap {
    /// Its length in microns.
    length: f64,
    /// Whether it crosses an outline: then what drops falls beside the clay.
    leaves: bool,
    /// Whether the next bead begins in the clay.
    inside: bool,
    /// No bead has been before, or none comes after.
    open: bool,
}

/// The travels of a layer: before its first bead, between its beads, behind its last. Without a bead all is before.
struct Gaps {
    before: Gap,
    between: Vec<Gap>,
    behind: Option<Gap>,
    /// Whether a bead begins behind the first of them.
    begins: bool,
}

impl Gap {
    /// This travel and the one that goes on from it.
    fn and(self, next: Self) -> Self {
        Self {
            length: self.length + next.length,
            leaves: self.leaves || next.leaves,
            inside: next.inside,
            open: self.open || next.open,
        }
    }

    /// A travel that has no other end.
    fn open() -> Self {
        Self { open: true, ..Self::default() }
    }
}

impl Gaps {
    fn of(lines: &[Line], mut nozzle: Nozzle) -> Self {
        let outlines = Outlines::of(lines);
        let mut gaps = Self { before: Gap::default(), between: Vec::new(), behind: None, begins: false };
        let mut beads = nozzle.on;
        let mut gap = Gap::default();
        for line in lines {
            let was = nozzle;
            nozzle.follow(line);
            match (was.at, line.as_move()) {
                (Some(from), Some(step)) if !was.on => {
                    gap.length += line.length(from);
                    let (from, to) = (Point::new(from.x, from.y), Point::new(step.to.x, step.to.y));
                    gap.leaves = gap.leaves || outlines.crossed(from, to);
                }
                _ => {}
            }
            if nozzle.on && !was.on {
                gap.inside = nozzle.at.is_some_and(|at| outlines.hold(Point::new(at.x, at.y)));
                let done = std::mem::take(&mut gap);
                if beads {
                    gaps.between.push(done);
                } else {
                    (gaps.before, gaps.begins, beads) = (done, true, true);
                }
            }
        }
        match beads {
            true if nozzle.on => {}
            true => gaps.behind = Some(gap),
            false => gaps.before = gap,
        }
        gaps
    }
}

impl<'a> Relief<'a> {
    /// Nothing when the settings ask for nothing.
    pub(crate) fn new(settings: &'a Dimension, facts: &Facts, step: i64) -> Result<Option<Self>, Error> {
        let volumes = [settings.retraction_volume, settings.restart_extra_volume, settings.prime_volume];
        if volumes.iter().all(|volume| volume.0 == 0) {
            return Ok(None);
        }
        let unit: EUnit = facts.e_unit()?;
        let per_mm3 = unit.per_mm3(facts.bead()?.area()) * settings.flow.f64() * 1e5;
        Ok(Some(Self { settings, per_mm3, step }))
    }

    /// Writes the E words into every layer.
    pub(crate) fn write(&self, skein: &mut Skein) -> Result<(), Error> {
        let nozzles = skein.nozzles();
        let gaps: Vec<Gaps> = skein
            .layers
            .par_iter()
            .zip(&nozzles)
            .map(|(layer, nozzle)| Gaps::of(&layer.lines, *nozzle))
            .collect();
        let shares = self.shares(&gaps);
        skein.each(|index, layer| {
            layer.lines = self.layer(layer, &nozzles[index], &shares[index])?;
            Ok(())
        })
    }

    /// For each layer the share of the relief around each travel, in order: nothing for the start of the print. A
    /// travel that goes on in the next layers is one.
    fn shares(&self, gaps: &[Gaps]) -> Vec<Vec<Option<f64>>> {
        let mut shares: Vec<Vec<Option<f64>>> =
            gaps.iter().map(|gaps| gaps.between.iter().map(|gap| Some(self.share(*gap))).collect()).collect();
        // The travel that has not come to a bead yet, and the layer where it began.
        let mut open: Option<(Option<usize>, Gap)> = Some((None, Gap::default()));
        for (index, layer) in gaps.iter().enumerate() {
            open = open.map(|(from, gap)| (from, gap.and(layer.before)));
            if layer.begins
                && let Some((from, gap)) = open.take()
            {
                let share = self.share(gap);
                shares[index].insert(0, from.map(|_| share));
                if let Some(from) = from {
                    shares[from].push(Some(share));
                }
            }
            if let Some(behind) = layer.behind {
                open = Some((Some(index), behind));
            }
        }
        if let Some((Some(from), gap)) = open {
            shares[from].push(Some(self.share(gap.and(Gap::open()))));
        }
        shares
    }

    /// How much of the relief a travel wants: all when it leaves the clay, else by its length, from none at the least
    /// travel to all at twice that.
    fn share(&self, gap: Gap) -> f64 {
        let least = self.settings.minimum_travel.um();
        match gap {
            Gap { open: true, .. } | Gap { leaves: true, .. } => 1.0,
            Gap { inside: true, .. } if !self.settings.retract_within_island => 0.0,
            Gap { length, .. } if length <= least => 0.0,
            Gap { length, .. } => ((length - least) / least.max(f64::MIN_POSITIVE)).min(1.0),
        }
    }

    /// The lines of a layer with their reliefs; `shares` are those of its travels, in order.
    fn layer(
        &self,
        layer: &mut Layer,
        entering: &Nozzle,
        shares: &[Option<f64>],
    ) -> Result<Vec<Line>, Error> {
        let mut was = *entering;
        let mut pen = Pen::new(entering, layer.lines.len() * 5 / 4);
        // A travel has its relief in front and its restart behind. The one that leads into the layer has only the
        // latter here.
        let mut restarts = shares.iter();
        let leading = usize::from(!entering.on);
        let mut reliefs = shares.iter().skip(leading);
        let settings = self.settings;
        for line in std::mem::take(&mut layer.lines) {
            match line {
                Line::On if !was.on => match restarts.next() {
                    Some(Some(share)) => {
                        let extra = self.amount(settings.restart_extra_volume, *share)?;
                        let amount = self.amount(settings.retraction_volume, *share)? + extra;
                        self.push(&mut pen, &was, amount, settings.restart_speed);
                    }
                    Some(None) => {
                        let prime = self.amount(settings.prime_volume, 1.0)?;
                        self.push(&mut pen, &was, prime, settings.restart_speed);
                    }
                    None => {}
                },
                Line::Off if was.on => {
                    if let Some(Some(share)) = reliefs.next() {
                        let amount = self.amount(settings.retraction_volume, *share)?;
                        self.push(&mut pen, &was, -amount, settings.retraction_speed);
                    }
                }
                _ => {}
            }
            pen.pass(line.clone(), &was);
            was.follow(&line);
        }
        Ok(pen.finish(&was))
    }

    /// A share of a volume in hundred-thousandths of E.
    fn amount(&self, volume: Ratio, share: f64) -> Result<i64, Error> {
        let steps = volume.f64() * share * self.per_mm3 / self.step as f64;
        unit::round_within(steps, LIMIT).map(|steps| steps * self.step).ok_or_else(|| {
            Error::new(format!("{volume} mm³ are more than an E word can say")).hint("look at `e_unit`")
        })
    }

    /// An E word where the nozzle stands. A skein without speeds is not given the one of a relief.
    fn push(&self, pen: &mut Pen, was: &Nozzle, amount: i64, speed: Ratio) {
        let (Some(at), Some(extrusion)) = (was.at, Extrusion::new(amount)) else { return };
        if amount == 0 {
            return;
        }
        // Whole microns a minute are what an F word can say; a ram that is slower takes the least of them.
        let speed = (speed.f64() * self.per_mm3 / 1e5).max(1.0 / 60_000.0);
        let feed = was.feed.and_then(|_| Feed::from_mm_per_s(speed));
        pen.step(Move { extrusion: Some(extrusion), feed, ..Move::to(at) });
    }
}
