#![doc = include_str!("../README.md")]

#[cfg(test)]
mod tests;
mod way;

use skein::{
    Error, Feature, Layer, Line, Move, Notes, Nozzle, Point3, Ratio, Settings, Side, Skein, Stage, Thread,
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
        // A thread without a bend stays as it was written.
        layer.rethread(entering, |thread, before, behind| {
            let closed = thread.is_closed() && !before.on && !behind.on;
            Some(self.stretched(thread, closed, width)).filter(|stretched| stretched != thread)
        })
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

    /// The thread with its bends made larger, those of each kind of bead by themselves: where one kind goes over into
    /// another, the thread stays where it is.
    fn stretched(&self, thread: &Thread, closed: bool, width: f64) -> Thread {
        let mut stretched =
            Thread { start: thread.start, stretches: Vec::with_capacity(thread.stretches.len()) };
        let mut start = thread.start;
        let of_one_kind = |one: &skein::Stretch, other: &skein::Stretch| one.block == other.block;
        for run in thread.stretches.chunk_by(of_one_kind) {
            let ends = run.iter().map(|piece| piece.step.to);
            let points: Vec<Point3> = std::iter::once(start).chain(ends).collect();
            start = points[run.len()];
            let closed = closed && run.len() == thread.stretches.len();
            let most = width * run.first().map_or(0.0, |piece| self.most(piece.feature()));
            let points = if most > 0.0 { self.moved(points, closed, most, width) } else { points };
            if closed {
                stretched.start = points[0];
            }
            let moved = run.iter().zip(&points[1..]);
            stretched.stretches.extend(
                moved.map(|(piece, to)| skein::Stretch { step: Move { to: *to, ..piece.step }, ..*piece }),
            );
        }
        stretched
    }

    /// The points of a way, each moved towards the outside of the bend that it lies on, by so much at most. A closed way
    /// stays closed, since its two ends are one point; the ends of an open one stay.
    fn moved(&self, points: Vec<Point3>, closed: bool, most: f64, width: f64) -> Vec<Point3> {
        let way = Way::new(&points, closed);
        let limit = self.cross_limit_over_bead_width.f64() * width;
        let bends = way.bends(self.from_distance_over_bead_width.f64() * width);
        let mut moved: Vec<Point3> = bends
            .iter()
            .zip(&points)
            .enumerate()
            .map(|(index, (bend, at))| {
                let (before, behind) = way.neighbours(index);
                let bend = (bend.0 * STRENGTH, bend.1 * STRENGTH);
                let bend = limited(limited(bend, before, limit), behind, limit);
                let shift = most / libm::hypot(bend.0, bend.1).max(1.0);
                Point3 { x: step(at.x, bend.0 * shift), y: step(at.y, bend.1 * shift), ..*at }
            })
            .collect();
        // The last point of a closed way is its first.
        moved.extend(moved.first().copied().filter(|_| closed));
        moved
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
