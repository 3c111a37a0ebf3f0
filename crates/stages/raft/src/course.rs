//! The layers of the raft.

use crate::Raft;
use crate::bed::Bed;
use crate::heat::Heat;
use crate::lay::{Rates, Rows, Threads, feed, in_order, zigzag};
use crate::support::Support;
use shape::plane::boolean::positive;
use shape::plane::offset;
use skein::{
    Bead, Error, Facts, Feature, Layer, Line, Micron, Notes, Nozzle, Point, Point3, Ratio, Ring, Tag,
};

/// A layer of the raft.
pub(crate) struct Course {
    kind: Kind,
    /// How many lie below it.
    number: usize,
    /// The heights of what the part would have stood on, of the foot of this layer and of its top.
    floor: i32,
    foot: i32,
    height: Micron,
    /// Where the middles of its beads may go.
    region: Vec<Ring>,
    /// The settings of its kind.
    make: Make,
}

/// What a layer of the raft is for.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Base,
    Interface,
}

/// How the layers of one kind are made.
#[derive(Clone, Copy)]
struct Make {
    thickness: f64,
    density: f64,
    feed: f64,
    flow: f64,
    lift: f64,
}

impl Raft {
    fn make(&self, kind: Kind) -> Make {
        let [thickness, density, feed, flow, lift] = match kind {
            Kind::Base => [
                self.base_thickness,
                self.base_density,
                self.base_feed,
                self.base_flow,
                self.base_nozzle_lift,
            ],
            Kind::Interface => [
                self.interface_thickness,
                self.interface_density,
                self.interface_feed,
                self.interface_flow,
                self.interface_nozzle_lift,
            ],
        }
        .map(Ratio::f64);
        Make { thickness, density, feed, flow, lift }
    }

    /// How far the raft reaches beyond a part of this length, in microns.
    pub(crate) fn outset(&self, width: Micron, length: f64) -> f64 {
        self.margin.f64() * width.um() + self.additional_margin_over_length.f64() / 100.0 * length
    }
}

impl Course {
    /// The layers of the raft from the bed up.
    pub(crate) fn stack(
        raft: &Raft,
        first: &Layer,
        outlines: &[Vec<Ring>],
        support: Option<&Support>,
        facts: &Facts,
        bed: &Bed,
        notes: &mut Notes,
    ) -> Result<Vec<Self>, Error> {
        let kinds = std::iter::repeat_n(Kind::Base, raft.base_layers as usize)
            .chain(std::iter::repeat_n(Kind::Interface, raft.interface_layers as usize));
        let floor = first.nozzle_z(facts)?.0 - first.height(facts)?.0;
        let outset = raft.outset(facts.bead_width()?, longer_side(outlines));
        let mut under = outlines.first().cloned().unwrap_or_default();
        under.extend(thin_parts(first, facts)?);
        under.extend(support.into_iter().flat_map(|support| support.region.iter().cloned()));
        let under = positive(&under);
        if under.is_empty() && raft.base_layers + raft.interface_layers > 0 {
            notes.say("the first layer is empty, so there is nothing to lay a raft under");
            return Ok(Vec::new());
        }
        let mut stack: Vec<Self> = Vec::new();
        let mut cut = false;
        for (number, kind) in kinds.enumerate() {
            let make = raft.make(kind);
            let height = Micron::from_mm(facts.layer_height()?.mm() * make.thickness)
                .filter(|height| height.0 > 0)
                .ok_or_else(|| Error::new("a layer of the raft has no height"))?;
            let region = match stack.last() {
                Some(below) if below.kind == kind => below.region.clone(),
                _ => {
                    let half = facts.bead_width()?.um() * make.thickness / 2.0;
                    let (region, less) = bed.part_of(offset(&under, (outset - half).max(0.0)));
                    cut |= less;
                    region
                }
            };
            let foot = stack.last().map_or(floor, |below| below.foot + below.height.0);
            Micron::from_places(i64::from(foot) + i64::from(height.0))
                .ok_or_else(|| Error::new("the raft is higher than a kilometre"))?;
            stack.push(Self { kind, number, floor, foot, height, region, make });
        }
        if cut {
            notes.say("the raft is cut off where the bed ends");
        }
        Ok(stack)
    }

    /// How much higher its top is than what the part would have stood on.
    pub(crate) fn rise(&self) -> i32 {
        self.foot + self.height.0 - self.floor
    }

    /// The height of the nozzle.
    fn nozzle_z(&self) -> i32 {
        self.foot + (self.height.um() * (0.5 + self.make.lift) + 0.5) as i32
    }

    /// The step of the temperature before it.
    pub(crate) fn heat(&self, heat: &mut Heat, facts: &Facts) -> Vec<Line> {
        let wanted = match self.kind {
            Kind::Base => heat.base,
            Kind::Interface => heat.interface,
        };
        heat.to(wanted, &self.region, self.nozzle_z(), facts)
    }

    /// Its lines.
    pub(crate) fn layer(&self, steps: Vec<Line>, rates: Rates, facts: &Facts) -> Result<Layer, Error> {
        let Make { thickness, density, flow, .. } = self.make;
        let usual = facts.bead()?;
        // A bead of the same form, larger in both directions; flow is told as a share of one that is only higher.
        let width = Micron::from_mm(usual.width.mm() * thickness)
            .filter(|width| width.0 > 0)
            .ok_or_else(|| Error::new("a bead of the raft has no width"))?;
        let bead = Bead { width, ..usual }.of_height(self.height);
        let share = bead.area() / usual.of_height(self.height).area() * flow;
        let flow = Ratio::from_f64(share).ok_or_else(|| Error::new("a bead of the raft has no flow"))?;
        // Each crosses the one below; the first goes along y.
        let direction = if self.number.is_multiple_of(2) { (0.0, 1.0) } else { (1.0, 0.0) };
        let step = bead.spacing().um().max(1.0) / density;
        let threads = zigzag(&self.region, direction, step, Rows::Fitted);
        // As much clay a second as a usual bead at the usual feed.
        let feed = feed(rates.feed.mm_per_s() * self.make.feed / (thickness * thickness))?;
        let lay = Threads { z: self.nozzle_z(), rates: Rates { feed, ..rates }, flow, around: Ratio::ONE };
        let mut lines = vec![Line::Layer(Micron(self.foot + self.height.0 / 2))];
        if self.height != facts.layer_height()? {
            lines.push(Line::Thickness(self.height));
        }
        lines.extend(steps);
        lines.push(Line::Open(Tag::Raft));
        lay.write(in_order(threads, Some(Point::new(0, 0))), &mut lines);
        lines.push(Line::Close(Tag::Raft));
        lines.push(Line::Close(Tag::Layer));
        Ok(Layer { lines })
    }
}

/// What beads on the middle of thin parts cover: they are as wide as the nozzle can lay, wider perhaps than the outline.
fn thin_parts(layer: &Layer, facts: &Facts) -> Result<Vec<Ring>, Error> {
    let bead = facts.bead()?.of_height(layer.height(facts)?);
    let mut nozzle = Nozzle::default();
    let mut parts = Vec::new();
    for line in &layer.lines {
        let from = nozzle.at;
        nozzle.follow(line);
        if let (true, Some(from), Some(step)) =
            (nozzle.on && nozzle.feature() == Feature::Middle, from, line.as_move())
        {
            let width = bead.section.width(bead.area() * nozzle.flow.f64(), bead.height.mm()) * 1000.0;
            let flat = |at: Point3| Point::new(at.x, at.y);
            parts.extend(Ring::around(flat(from), flat(step.to), width / 2.0));
        }
    }
    Ok(parts)
}

/// The longer side of the box around all layers, in microns.
fn longer_side(outlines: &[Vec<Ring>]) -> f64 {
    let corners = outlines.iter().flatten().filter_map(Ring::bounds);
    let all = corners.reduce(|(low, high), (least, most)| {
        (
            Point::new(low.x.min(least.x), low.y.min(least.y)),
            Point::new(high.x.max(most.x), high.y.max(most.y)),
        )
    });
    all.map_or(0.0, |(low, high)| {
        let (x, y) = low.delta(high);
        x.max(y) as f64
    })
}
