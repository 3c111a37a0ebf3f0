#![doc = include_str!("../README.md")]

#[cfg(test)]
mod tests;
mod way;

use skein::{
    Error, Feature, Layer, Line, Notes, Nozzle, Pen, Point3, Ratio, Settings, Side, Skein, Span, Stage,
    Thread, spans,
};
use way::Way;

/// Makes curves larger by what clay pulls them in.
#[derive(Clone, Debug, Settings)]
pub struct Stretch {
    /// How far the outermost wall goes outwards at most, in bead widths. More where round pots come out too small.
    #[setting(default = 0.1, min = 0.0, max = 1.0)]
    pub outer_over_bead_width: Ratio,
    /// The same for the wall around a hole, which comes out too small more than the outside does.
    #[setting(default = 0.32, min = 0.0, max = 1.0)]
    pub inner_over_bead_width: Ratio,
    /// The same for walls inside the outermost.
    #[setting(default = 0.11, min = 0.0, max = 1.0)]
    pub loop_over_bead_width: Ratio,
    /// The same for all other beads.
    #[setting(default = 0.0, min = 0.0, max = 1.0)]
    pub path_over_bead_width: Ratio,
    /// How far before and behind a point is looked for how the bead bends, in bead widths.
    #[setting(default = 2.0, min = 0.1, max = 100.0)]
    pub from_distance_over_bead_width: Ratio,
    /// A point whose neighbours are further away than this many bead widths is the corner of straight sides and stays
    /// on them; nearer than a third of it, it goes all the way.
    #[setting(default = 5.0, min = 0.0, max = 100.0)]
    pub cross_limit_over_bead_width: Ratio,
}

/// The share of the bend that is made up for (stages.md §6.14).
const STRENGTH: f64 = 0.8;

impl Stage for Stretch {
    const NAME: &'static str = "stretch";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let width = skein.facts()?.bead_width()?.um();
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, _| Ok(self.layer(layer, &nozzles[index], width)))
    }
}

impl Stretch {
    fn layer(&self, layer: Layer, entering: &Nozzle, width: f64) -> Vec<Line> {
        let mut was = *entering;
        let mut pen = Pen::new(entering, layer.lines.len() + 16);
        for span in spans(&layer.lines) {
            let most = width * self.most(was.feature);
            let thread = match span {
                Span::Thread(lines) if most > 0.0 => Thread::read(lines, &was),
                _ => None,
            };
            // A thread without a bend stays as it was written.
            let stretched = thread.and_then(|thread| {
                Some(self.stretched(&thread, most, width)).filter(|stretched| *stretched != thread)
            });
            if let Some(stretched) = &stretched {
                pen.arrive(stretched.start);
                pen.thread(stretched);
            }
            for line in span.lines() {
                if stretched.is_none() {
                    pen.pass(line.clone(), &was);
                }
                was.follow(line);
            }
        }
        pen.finish(&was)
    }

    fn most(&self, feature: Feature) -> f64 {
        match feature {
            Feature::Edge(Side::Outer) => self.outer_over_bead_width,
            Feature::Edge(Side::Inner) => self.inner_over_bead_width,
            Feature::Loop(_) => self.loop_over_bead_width,
            _ => self.path_over_bead_width,
        }
        .f64()
    }

    /// The thread with each of its points moved towards the outside of the bend that it lies on. A closed thread stays
    /// closed, since its two ends are one point; the ends of an open one stay.
    fn stretched(&self, thread: &Thread, most: f64, width: f64) -> Thread {
        let way = Way::new(thread);
        let limit = self.cross_limit_over_bead_width.f64() * width;
        let bends = way.bends(self.from_distance_over_bead_width.f64() * width);
        let moved: Vec<Point3> = bends
            .iter()
            .enumerate()
            .map(|(index, bend)| {
                let (before, behind) = way.neighbours(index);
                let bend = (bend.0 * STRENGTH, bend.1 * STRENGTH);
                let bend = limited(limited(bend, before, limit), behind, limit);
                let shift = most / libm::hypot(bend.0, bend.1).max(1.0);
                let at = way.point(index);
                Point3 { x: step(at.x, bend.0 * shift), y: step(at.y, bend.1 * shift), ..at }
            })
            .collect();
        let mut stretched = thread.clone();
        let Some(first) = moved.first() else { return stretched };
        stretched.start = *first;
        // The last point of a closed thread is its first.
        let ends = moved.iter().skip(1).chain(std::iter::once(first));
        for (piece, to) in stretched.stretches.iter_mut().zip(ends) {
            piece.step.to = *to;
        }
        stretched
    }
}

/// A shift without the part across a side that is too long for it; `side` leads to the neighbour.
fn limited(shift: (f64, f64), side: (f64, f64), limit: f64) -> (f64, f64) {
    let length = libm::hypot(side.0, side.1);
    if length <= limit / 3.0 {
        return shift;
    }
    let kept = ((limit - length) / (limit * 2.0 / 3.0)).max(0.0);
    let along = (side.0 / length, side.1 / length);
    let part = shift.0 * along.0 + shift.1 * along.1;
    let straight = (along.0 * part, along.1 * part);
    (straight.0 + (shift.0 - straight.0) * kept, straight.1 + (shift.1 - straight.1) * kept)
}

/// A coordinate a little further on; it cannot leave what a coordinate can be.
fn step(from: i32, by: f64) -> i32 {
    from.saturating_add(by.round() as i32)
}
