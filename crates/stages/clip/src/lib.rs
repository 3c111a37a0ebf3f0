#![doc = include_str!("../README.md")]

mod joint;
#[cfg(test)]
mod tests;

use joint::Ground;
use skein::{
    Error, Feature, Layer, Line, Move, Notes, Nozzle, Pen, Point3, Ratio, Settings, Skein, Span, Stage,
    Stretch, Thread, spans,
};

/// Ends loops early, by what still follows when clay stops.
#[derive(Clone, Debug, Settings)]
pub struct Clip {
    /// How much of a loop is left out at each of its ends, in bead widths. At 0.5 the two ends of the bead just touch;
    /// clay that follows after the stop wants more.
    #[setting(default = 0.5, min = 0.0, max = 100.0)]
    pub over_bead_width: Ratio,
    /// Loops whose ends are nearer than this many bead widths are joined to one thread where nothing is in the way; 0
    /// joins none.
    #[setting(default = 0.0, min = 0.0, max = 1000.0)]
    pub maximum_connection_over_bead_width: Ratio,
}

/// No more of a loop than this share is left out at either end (stages.md §6.12).
const MOST: f64 = 0.3;

impl Stage for Clip {
    const NAME: &'static str = "clip";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let width = skein.facts()?.bead_width()?.um();
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, notes| {
            let mut shears = Shears {
                cut: width * self.over_bead_width.f64(),
                reach: width * self.maximum_connection_over_bead_width.f64(),
                ground: None,
                width,
                joined: 0,
                mixed: false,
            };
            let lines = shears.layer(&layer, &nozzles[index]);
            if shears.joined > 0 {
                notes.layer(index, "loops were joined to one thread");
            }
            if shears.mixed {
                notes.layer(index, "walls that `join` has made one thread with others have no ends to clip");
            }
            Ok(lines)
        })
    }
}

/// The stage in microns, at work on one layer.
struct Shears {
    cut: f64,
    reach: f64,
    width: f64,
    /// What a joint must not cross; looked up when the first joint is tried.
    ground: Option<Ground>,
    joined: usize,
    /// Whether a wall is in one thread with other beads.
    mixed: bool,
}

/// A clipped loop that waits for what comes behind it.
struct Held {
    thread: Thread,
    /// The nozzle behind it.
    end: Nozzle,
    /// The lines behind it so far: its block's end, the next block's beginning, the travel there.
    behind: Vec<(Line, Nozzle)>,
}

impl Shears {
    fn layer(&mut self, layer: &Layer, entering: &Nozzle) -> Vec<Line> {
        let mut was = *entering;
        let mut pen = Pen::new(entering, layer.lines.len() + 16);
        let mut held: Option<Held> = None;
        for span in spans(&layer.lines, entering.on) {
            let mut end = was;
            span.lines().iter().for_each(|line| end.follow(line));
            let clipped = match span {
                Span::Thread(lines) => {
                    let thread = Thread::read(lines, &was);
                    let free = |thread: &Thread| thread.is_wall() && !was.on && !end.on;
                    self.mixed |= thread.as_ref().is_some_and(|thread| thread.has_wall() && !free(thread));
                    thread.filter(free).map(|wall| self.clipped(wall))
                }
                _ => None,
            };
            match (clipped, &mut held) {
                (Some(thread), _) => {
                    held = Some(self.next(layer, &mut pen, held.take(), thread, end));
                }
                (None, Some(waiting)) if self.may_wait(&span) => {
                    let mut at = was;
                    for line in span.lines() {
                        waiting.behind.push((line.clone(), at));
                        at.follow(line);
                    }
                }
                (None, _) => {
                    held.take().into_iter().for_each(|held| lay(&mut pen, held));
                    pen.pass_all(span.lines(), &mut was);
                }
            }
            was = end;
        }
        held.into_iter().for_each(|held| lay(&mut pen, held));
        pen.finish(&was)
    }

    /// A loop without its ends.
    fn clipped(&self, wall: Thread) -> Thread {
        let length = wall.length();
        let cut = self.cut.min(MOST * length);
        if cut == 0.0 { wall } else { wall.split(length - cut).0.split(cut).1 }
    }

    /// Whether a loop can still be joined with what is behind these lines: only a travel, and the change of blocks.
    fn may_wait(&self, span: &Span<'_>) -> bool {
        match span {
            Span::Travel(_) => true,
            Span::Thread(_) => false,
            Span::Other(line) => matches!(line, Line::Wall(..) | Line::Flow(_)) || is_end_of_wall(line),
        }
    }

    /// Joins a loop to the one that waits, or lays that one and lets the new one wait.
    fn next(
        &mut self,
        layer: &Layer,
        pen: &mut Pen,
        held: Option<Held>,
        thread: Thread,
        end: Nozzle,
    ) -> Held {
        let Some(waiting) = held else {
            pen.arrive(thread.start);
            return Held { thread, end, behind: Vec::new() };
        };
        if let Some(joined) = self.joint(layer, &waiting, &thread, end) {
            self.joined += 1;
            // The end of the first block, the beginning of the second and the travel between them are gone.
            return Held { thread: joined, behind: Vec::new(), ..waiting };
        }
        lay(pen, waiting);
        pen.arrive(thread.start);
        Held { thread, end, behind: Vec::new() }
    }

    /// Both loops as one thread, if they are of a kind and nothing lies between their ends.
    fn joint(&mut self, layer: &Layer, waiting: &Held, thread: &Thread, end: Nozzle) -> Option<Thread> {
        let kind = |feature: Feature| std::mem::discriminant(&feature);
        if kind(waiting.end.feature()) != kind(end.feature()) || self.reach == 0.0 {
            return None;
        }
        // A joined thread runs on the way it went.
        let same_sense = turns_left(&waiting.thread) == turns_left(thread);
        let next = if same_sense { thread.clone() } else { thread.clone().reversed() };
        let (from, to) = (waiting.thread.end(), next.start);
        if from.z != to.z || Move::to(to).length(from) >= self.reach {
            return None;
        }
        let ground = self.ground.get_or_insert_with(|| Ground::of(&layer.lines));
        if !ground.is_free(from, to, self.width) {
            return None;
        }
        let last = *waiting.thread.stretches.last()?;
        let step = Move { to, extrusion: None, ..last.step };
        let joint = Thread { start: from, stretches: vec![Stretch { step, ..last }] };
        Some(waiting.thread.clone().join(joint).join(next))
    }
}

fn is_end_of_wall(line: &Line) -> bool {
    matches!(line, Line::Close(skein::Tag::Edge | skein::Tag::Loop))
}

/// Lays a loop and what stood behind it.
fn lay(pen: &mut Pen, held: Held) {
    pen.thread(&held.thread, &held.end);
    for (line, was) in held.behind {
        pen.pass(line, &was);
    }
}

/// Whether a loop runs counter-clockwise, by the sum of its crosswise products.
fn turns_left(thread: &Thread) -> bool {
    let cross = |a: Point3, b: Point3| i128::from(a.x) * i128::from(b.y) - i128::from(b.x) * i128::from(a.y);
    let around: i128 = thread.pieces().map(|(from, piece)| cross(from, piece.step.to)).sum();
    around + cross(thread.end(), thread.start) >= 0
}
