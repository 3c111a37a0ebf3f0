//! Writes the pieces of all layers in a new order: each as a layer of its own, reached at a safe height.

use crate::order::{Order, Step};
use crate::pieces::{Part, Pieces};
use skein::{Layer, Line, Micron, Move, Nozzle, Pen, Point, Point3};

/// The layers in their new order. What stands before the islands of a layer comes with the first of its pieces, what
/// stands behind them with the last; `nozzles` are those in front of the old layers and behind the last.
pub fn layers(
    old: &[Layer],
    pieces: &[Pieces],
    order: &Order,
    nozzles: &[Nozzle],
    height: Micron,
) -> Vec<Layer> {
    let mut waiting: Vec<usize> = pieces.iter().map(|layer| layer.islands.len()).collect();
    let mut writer = Writer {
        pieces,
        nozzle: nozzles.first().copied().unwrap_or_default(),
        highest: i32::MIN,
        tolerance: height.0 / 10,
        last: None,
    };
    let mut new: Vec<Layer> = Vec::new();
    let mut groups = order.groups().peekable();
    while let Some(steps) = groups.next() {
        let layer = steps[0].layer;
        let first = waiting[layer] == pieces[layer].islands.len();
        waiting[layer] -= steps.iter().filter(|step| step.island.is_some()).count();
        let last = waiting[layer] == 0;
        let pen = writer.group(&old[layer].lines, steps, first, last);
        let lines = match nozzles.last() {
            Some(end) if groups.peek().is_none() => pen.finish(end),
            _ => {
                let now = *pen.nozzle();
                pen.finish(&now)
            }
        };
        new.push(Layer { lines });
    }
    new
}

/// What is known while writing.
struct Writer<'a> {
    pieces: &'a [Pieces],
    nozzle: Nozzle,
    /// The highest place that has a bead.
    highest: i32,
    /// What is lower by less than this is as high.
    tolerance: i32,
    /// The island that was written last, with its layer.
    last: Option<(usize, usize)>,
}

impl Writer<'_> {
    /// Writes some islands of a layer.
    fn group(&mut self, lines: &[Line], steps: &[Step], first: bool, last: bool) -> Pen {
        let layer = steps[0].layer;
        let mut pen = Pen::new(&self.nozzle, lines.len());
        for piece in &self.pieces[layer].pieces {
            let step = |number: usize| steps.iter().find(|step| step.island == Some(number));
            let mut step = match piece.part {
                Part::Frame => None,
                Part::Opening if first => None,
                Part::Ending if last => None,
                Part::Opening | Part::Ending => continue,
                Part::Island(number) => match step(number) {
                    Some(step) => Some(step),
                    None => continue,
                },
            };
            let mut was = piece.was;
            for line in &lines[piece.lines.clone()] {
                if let (Line::Move(travel), false) = (line, pen.nozzle().on)
                    && let Some(step) = step.take()
                {
                    self.approach(&mut pen, Move { feed: travel.feed.or(was.feed), ..*travel }, step);
                }
                pen.pass(line.clone(), &was);
                was.follow(line);
                if let (true, Some(step)) = (pen.nozzle().on, line.as_move()) {
                    self.highest = self.highest.max(step.to.z);
                }
            }
            if let Part::Island(number) = piece.part {
                self.last = Some((layer, number));
            }
        }
        self.nozzle = *pen.nozzle();
        pen
    }

    /// Goes to an island above everything that stands: up, across, and down. Nothing of that where the straight way is
    /// over the island that the nozzle climbs, or nothing is higher.
    fn approach(&self, pen: &mut Pen, travel: Move, step: &Step) {
        let Some(from) = pen.nozzle().at else { return };
        let to = travel.to;
        let stays_on = |(layer, island): (usize, usize)| {
            let footprint = &self.pieces[layer].islands[island].footprint;
            footprint.is_clear(Point::new(from.x, from.y), Point::new(to.x, to.y))
        };
        let own = step.island.map(|island| (step.layer, island));
        if step.climbs && (self.last.is_some_and(stays_on) || own.is_some_and(stays_on)) {
            return;
        }
        for at in [from, to] {
            if at.z + self.tolerance < self.highest {
                pen.go(Point3 { z: self.highest, ..at }, travel.feed);
            }
        }
    }
}
