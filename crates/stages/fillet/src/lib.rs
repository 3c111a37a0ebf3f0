#![doc = include_str!("../README.md")]

mod corner;
#[cfg(test)]
mod tests;

use corner::Corner;
use skein::{
    Arc, Center, Choice, Error, Facts, Feed, Layer, Line, Micron, Move, Notes, Nozzle, Pen, Point3, Ratio,
    Settings, Skein, Span, Stage, Stretch, Thread, along, spans,
};

/// Rounds the corners of the beads.
#[derive(Clone, Debug, Settings)]
pub struct Fillet {
    /// What a corner becomes.
    #[setting(default = Procedure::ArcSegment)]
    pub procedure: Procedure,
    /// How far before and behind the corner the rounding begins and ends, in bead widths. More keeps the clay flowing
    /// more evenly and makes the corners of the part rounder.
    #[setting(default = 0.35, min = 0.0, max = 5.0)]
    pub radius_over_bead_width: Ratio,
    /// The speed in a corner, as a share.
    #[setting(default = 1.0, min = 0.05, max = 2.0)]
    pub corner_feed: Ratio,
    /// Whether the corner's speed lies between the speeds of its two sides; otherwise it is that of the second.
    #[setting(default = true)]
    pub intermediate_feed: bool,
    /// How long before and behind a travel that turns back on itself the nozzle is slowed to half, in bead widths.
    /// Below 0.1 it is not.
    #[setting(default = 0.5, min = 0.0, max = 100.0)]
    pub reversal_slowdown_over_bead_width: Ratio,
}

/// What a corner becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Procedure {
    /// One line that cuts it off.
    Bevel,
    /// An arc made of short lines: works on every firmware.
    ArcSegment,
    /// An arc (G2, G3) that says where its centre is.
    ArcPoint,
    /// An arc (G2, G3) that says its radius.
    ArcRadius,
}

impl Stage for Fillet {
    const NAME: &'static str = "fillet";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let tool = self.tool(&skein.facts()?)?;
        if tool.cut < 0.2 * tool.width {
            notes.say("a rounding of less than 0.2 bead widths changes nothing");
            return Ok(skein);
        }
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, _| Ok(tool.layer(layer, &nozzles[index])))
    }
}

impl Fillet {
    fn tool(&self, facts: &Facts) -> Result<Tool<'_>, Error> {
        let width = facts.bead_width()?.um();
        Ok(Tool { fillet: self, width, cut: width * self.radius_over_bead_width.f64() })
    }
}

/// The stage in microns.
struct Tool<'a> {
    fillet: &'a Fillet,
    width: f64,
    /// How much of each side of a corner is cut off.
    cut: f64,
}

/// The longest part of a side that its corner may take: two corners and something between them (stages.md §6.21).
const SHARE: f64 = 0.333;

impl Tool<'_> {
    fn layer(&self, layer: Layer, entering: &Nozzle) -> Vec<Line> {
        let mut was = *entering;
        let mut pen = Pen::new(entering, layer.lines.len() * 2);
        for span in spans(&layer.lines, entering.on) {
            let lines = span.lines();
            let thread = match span {
                Span::Thread(_) => Thread::read(lines, &was),
                _ => None,
            };
            match (thread, span) {
                (Some(thread), _) => {
                    lines.iter().for_each(|line| was.follow(line));
                    self.thread(&mut pen, &thread);
                    pen.end(&was);
                }
                (None, Span::Travel(_)) => self.travel(&mut pen, lines, &mut was),
                (None, _) => pen.pass_all(lines, &mut was),
            }
        }
        pen.finish(&was)
    }

    /// Lays a thread with its corners rounded; its two ends stay where they are.
    fn thread(&self, pen: &mut Pen, thread: &Thread) {
        let pieces: Vec<(Point3, &Stretch)> = thread.pieces().collect();
        for (index, (from, stretch)) in pieces.iter().enumerate() {
            pen.start(stretch);
            let next = pieces.get(index + 1).map(|(_, next)| *next);
            match next.and_then(|next| Some((self.corner(*from, stretch, next)?, next))) {
                Some((corner, next)) => self.round(pen, stretch, &corner, next),
                None => pen.step(stretch.step),
            }
        }
    }

    /// The corner between two pieces, if it can be rounded. A piece that says what it pushes is left alone.
    fn corner(&self, from: Point3, stretch: &Stretch, next: &Stretch) -> Option<Corner> {
        if stretch.step.extrusion.is_some() || next.step.extrusion.is_some() {
            return None;
        }
        let at = stretch.step.to;
        let sides = [stretch.step.length(from), next.step.length(at)];
        if sides.iter().any(|side| side * SHARE < 0.1 * self.width) {
            return None;
        }
        let cut = sides.iter().fold(self.cut, |cut, side| cut.min(side * SHARE));
        Corner::new(from, at, next.step.to, cut)
    }

    fn round(&self, pen: &mut Pen, stretch: &Stretch, corner: &Corner, next: &Stretch) {
        pen.step(Move { to: corner.before, ..stretch.step });
        let feed = self.corner_feed(stretch.step.feed, next.step.feed);
        pen.ready(next);
        let (i, j) = corner.center;
        let center = match self.fillet.procedure {
            Procedure::Bevel => return pen.go(corner.after, feed),
            Procedure::ArcSegment => {
                let segments = corner.segments(self.width);
                return corner.chords(segments).for_each(|at| pen.go(at, feed));
            }
            Procedure::ArcPoint => Center::Offset { i: Micron(i), j: Micron(j) },
            Procedure::ArcRadius => Center::Radius(Micron(corner.radius.round() as i32)),
        };
        let feed = feed.filter(|feed| pen.nozzle().feed != Some(*feed));
        let step = Move { feed, ..Move::to(corner.after) };
        pen.push(Line::Arc(Box::new(Arc { step, center, clockwise: corner.clockwise })));
    }

    fn corner_feed(&self, before: Option<Feed>, after: Option<Feed>) -> Option<Feed> {
        let after = after?.mm_per_s();
        let before = before.map_or(after, Feed::mm_per_s);
        let usual = if self.fillet.intermediate_feed { (before + after) / 2.0 } else { after };
        Feed::from_mm_per_s(usual * self.fillet.corner_feed.f64())
    }

    /// Travels keep their corners: nothing is laid there. Where one turns back on itself the machine is spared a jolt.
    fn travel(&self, pen: &mut Pen, lines: &[Line], was: &mut Nozzle) {
        let slow = self.width * self.fillet.reversal_slowdown_over_bead_width.f64();
        for (index, line) in lines.iter().enumerate() {
            let before = *was;
            was.follow(line);
            let (Some(from), Some(feed), Line::Move(step)) = (before.at, was.feed, line) else {
                pen.pass(line.clone(), &before);
                continue;
            };
            let next = lines.get(index + 1).and_then(Line::as_move).map(|next| next.to);
            let half = Feed::from_mm_per_s(feed.mm_per_s() / 2.0);
            let turns = |from: Point3, at: Point3, to: Point3| {
                slow >= 0.1 * self.width && corner::turns_back(from, at, to, 2.0 * slow)
            };
            let came_back = pen.nozzle().at == Some(from)
                && index > 0
                && nozzle_before(lines, index).is_some_and(|start| turns(start, from, step.to));
            if came_back {
                pen.go(along(from, step.to, slow), half);
            }
            if next.is_some_and(|next| turns(from, step.to, next)) {
                pen.go(along(step.to, from, slow), Some(feed));
                pen.go(step.to, half);
            } else if came_back {
                pen.step(Move { feed: Some(feed), ..*step });
            } else {
                pen.pass(line.clone(), &before);
            }
        }
    }
}

/// Where the move before this one began, when it is known from the lines of the travel themselves.
fn nozzle_before(lines: &[Line], index: usize) -> Option<Point3> {
    index.checked_sub(2).and_then(|index| lines[index].as_move()).map(|step| step.to)
}
