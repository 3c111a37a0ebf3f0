//! Zig-zags over a region, and the lines that lay them.

use shape::plane::hatch::Hatch;
use shape::plane::islands;
use skein::{Error, Feed, Line, Move, Point, Point3, Ratio, Ring};

/// How fast clay is laid and travelled.
#[derive(Clone, Copy)]
pub(crate) struct Rates {
    pub(crate) feed: Feed,
    pub(crate) travel: Feed,
}

/// A speed in mm/s.
///
/// # Errors
/// When no machine can move at it.
pub(crate) fn feed(mm_per_s: f64) -> Result<Feed, Error> {
    Feed::from_mm_per_s(mm_per_s).ok_or_else(|| {
        Error::new(format!("a bead at {mm_per_s} mm/s has no speed a machine can move at"))
            .hint("bring the shares of the feed closer to one")
    })
}

/// How the rows of a hatch lie.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Rows {
    /// Evenly from one side of each island to the other.
    Fitted,
    /// On the same lines on every layer, so that they stand on each other.
    Aligned,
}

/// How far a joint between two rows may go, in distances of rows.
const REACH: f64 = 4.0;

/// Threads to and fro over each island of a region.
pub(crate) fn zigzag(region: &[Ring], direction: (f64, f64), step: f64, rows: Rows) -> Vec<Vec<Point>> {
    let mut threads = Vec::new();
    for island in islands(region) {
        let mut hatch = match rows {
            Rows::Fitted => Hatch::fitted(&island, direction, step),
            Rows::Aligned => Hatch::new(&island, direction, step),
        };
        if hatch.rows().iter().next().is_none() {
            // Between two rows there is room for one of its own.
            hatch = Hatch::fitted(&island, direction, step);
        }
        threads.extend(hatch.threads(hatch.rows(), REACH * step));
    }
    threads.retain(|points| points.len() > 1);
    threads
}

/// How long a thread is, in microns.
pub(crate) fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// Threads one after the other, each the nearest to where the one before has ended, and turned so that it begins there.
pub(crate) fn in_order(mut left: Vec<Vec<Point>>, from: Option<Point>) -> Vec<Vec<Point>> {
    let mut ordered: Vec<Vec<Point>> = Vec::with_capacity(left.len());
    let mut here = from.or_else(|| left.first().and_then(|points| points.first().copied()));
    while let Some(at) = here {
        let ends = |points: &Vec<Point>| {
            let distance = |end: Option<&Point>| end.map_or(i64::MAX, |end| at.distance2(*end));
            (distance(points.first()), distance(points.last()))
        };
        let nearest = left.iter().map(ends).enumerate().min_by_key(|(_, (first, last))| *first.min(last));
        let Some((index, (first, last))) = nearest else { break };
        let mut points = left.swap_remove(index);
        if last < first {
            points.reverse();
        }
        here = points.last().copied();
        ordered.push(points);
    }
    ordered
}

/// How threads become lines.
pub(crate) struct Threads {
    /// How high the nozzle stands.
    pub(crate) z: i32,
    pub(crate) rates: Rates,
    /// The share of the nominal section that flows.
    pub(crate) flow: Ratio,
    /// The share that flows before and behind them.
    pub(crate) around: Ratio,
}

impl Threads {
    pub(crate) fn write(&self, threads: Vec<Vec<Point>>, lines: &mut Vec<Line>) {
        let step = |point: Point, feed: Option<Feed>| {
            Line::Move(Move { feed, ..Move::to(Point3 { x: point.x, y: point.y, z: self.z }) })
        };
        // The flow is set around the threads, not before and back before they are laid.
        if self.flow != self.around {
            lines.push(Line::Flow(self.flow));
        }
        for points in threads {
            let mut points = points.into_iter();
            lines.extend(points.next().map(|first| step(first, Some(self.rates.travel))));
            lines.push(Line::On);
            lines.extend(points.next().map(|second| step(second, Some(self.rates.feed))));
            lines.extend(points.map(|point| step(point, None)));
            lines.push(Line::Off);
        }
        if self.flow != self.around {
            lines.push(Line::Flow(self.around));
        }
    }
}
