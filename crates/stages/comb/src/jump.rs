//! From island to island: across the narrowest gap near by, with a run-up on either side.

use crate::outlines::Crossing;
use crate::path::{Guide, moved, unit};
use skein::Point;

/// So many sides of an outline may be walked in search of the narrowest place.
const STEPS: usize = 64;

impl Guide {
    /// The same way with better jumps, where there are better ones.
    pub(crate) fn jumps(&mut self, way: &[Point]) -> Vec<Point> {
        let mut better: Vec<Point> = way.first().copied().into_iter().collect();
        let mut crossings = Vec::new();
        for pair in way.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            self.outlines.crossings(from, to, &mut crossings);
            let mut here = from;
            for gap in crossings.windows(2).filter(|gap| !gap[0].enters && gap[1].enters) {
                if let Some(jump) = self.jump(here, (from, to), gap) {
                    better.extend(jump);
                    here = jump[1];
                }
            }
            better.push(to);
        }
        better.dedup();
        better
    }

    /// Where to leave and where to arrive, when that is cheaper than where the straight way does.
    fn jump(&mut self, here: Point, (from, to): (Point, Point), gap: &[Crossing]) -> Option<[Point; 2]> {
        let (leave, arrive) = self.narrowest(from, to, gap);
        let direction = unit(leave, arrive)?;
        if self.cost(&[here, leave, arrive, to]) >= self.cost(&[here, to]) {
            return None;
        }
        let back = (-direction.0, -direction.1);
        Some([self.run_up(here, leave, back), self.run_up(to, arrive, direction)])
    }

    /// The two sides of a gap, moved along their outlines until they come no nearer to each other.
    fn narrowest(&self, from: Point, to: Point, gap: &[Crossing]) -> (Point, Point) {
        let direction = unit(from, to).unwrap_or_default();
        let at = |crossing: &Crossing| moved(from, direction, from.distance(to) * crossing.share);
        let (mut leave, mut arrive) = (at(&gap[0]), at(&gap[1]));
        let (mut leave_side, mut arrive_side) = (gap[0].side, gap[1].side);
        for _ in 0..STEPS {
            let before = leave.distance(arrive);
            (leave, leave_side) = self.nearest(leave_side, arrive);
            (arrive, arrive_side) = self.nearest(arrive_side, leave);
            if leave.distance(arrive) + 1.0 > before {
                break;
            }
        }
        (leave, arrive)
    }

    /// The place nearest to a point on a side of an outline and on its two neighbours.
    fn nearest(&self, side: usize, to: Point) -> (Point, usize) {
        let ring = self.outlines.ring(self.outlines.side(side).ring);
        let previous = if side == ring.start { ring.end - 1 } else { side - 1 };
        let next = if side + 1 == ring.end { ring.start } else { side + 1 };
        let nearest = |side: usize| {
            let side = self.outlines.side(side);
            let (x, y) = side.from.delta(side.to);
            let (px, py) = side.from.delta(to);
            let length = side.from.distance(side.to);
            let along = (x as f64 * px as f64 + y as f64 * py as f64) / length.max(1.0);
            moved(side.from, unit(side.from, side.to).unwrap_or_default(), along.clamp(0.0, length))
        };
        let mut best = (nearest(side), side);
        for other in [previous, next] {
            let place = nearest(other);
            if place.distance2(to) < best.0.distance2(to) {
                best = (place, other);
            }
        }
        best
    }

    /// Where the straight run begins that leads to a jump: as far back from the edge as there is clay, but no further than
    /// the place is away that the nozzle comes from, so that it never runs to and fro for long.
    fn run_up(&mut self, here: Point, edge: Point, back: (f64, f64)) -> Point {
        let longest = self.measures.run_up.min(here.distance(edge));
        let margin = self.measures.margin;
        [1.0, 0.5, 0.25]
            .into_iter()
            .filter(|_| longest > 0.0)
            .map(|share| longest * share)
            .find(|length| {
                let start = moved(edge, back, *length);
                self.open_air(&[here, start]) < 1.0
                    && self.open_air(&[moved(edge, back, length + margin), edge]) < 1.0
            })
            .map_or(edge, |length| moved(edge, back, length))
    }
}
