//! Looks through a file for the part: where it begins and ends, how large it is, where its middle lies.

use gcode::Line;
use skein::Error;

use crate::machine::{Act, EPSILON_Z, Machine, Move, Point};
use crate::tape::{raw_lines, split_bom};

/// What a file prints. Lines are counted from 0.
#[derive(Clone, Debug)]
pub(crate) struct Survey {
    /// The line with which the nozzle comes to the part: its last travel before the first bead.
    pub(crate) lead: usize,
    /// The last line that prints.
    pub(crate) last: usize,
    /// The middle in X and Y of what is printed above the first height, where there is neither skirt nor brim.
    pub(crate) centre: [f64; 2],
    /// The lowest and the highest place of the nozzle while it prints, mm.
    pub(crate) bottom: f64,
    pub(crate) top: f64,
    /// The feed of the last travel, or of the last move that has one, mm/min.
    pub(crate) travel_feed: Option<f64>,
}

/// Extents.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) low: Point,
    pub(crate) high: Point,
}

impl Extent {
    pub(crate) const NONE: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    pub(crate) fn add(&mut self, point: Point) {
        for (axis, place) in point.into_iter().enumerate() {
            self.low[axis] = self.low[axis].min(place);
            self.high[axis] = self.high[axis].max(place);
        }
    }

    pub(crate) fn add_all(&mut self, other: &Self) {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
    }

    fn is_empty(&self) -> bool {
        self.low[0] > self.high[0]
    }

    /// Adds all of a move.
    pub(crate) fn add_move(&mut self, step: &Move) {
        self.add(step.from);
        self.add(step.to);
        if let Some(arc) = &step.arc {
            let [a, b] = arc.plane.axes();
            for [on_a, on_b] in arc.extremes() {
                let mut point = step.from;
                (point[a], point[b]) = (on_a, on_b);
                self.add(point);
            }
        }
    }

    /// The middle in X and Y.
    pub(crate) fn middle(&self) -> [f64; 2] {
        [f64::midpoint(self.low[0], self.high[0]), f64::midpoint(self.low[1], self.high[1])]
    }

    fn is_apart(&self, other: &Self) -> bool {
        (0..2).any(|axis| self.high[axis] < other.low[axis] || other.high[axis] < self.low[axis])
    }
}

/// Printing without a break.
#[derive(Clone, Copy, Debug)]
struct Thread {
    lead: usize,
    last: usize,
    extent: Extent,
    /// The height of its lowest bead, and the extents of what lies above that.
    low: f64,
    above: Extent,
}

impl Thread {
    fn new(lead: usize) -> Self {
        Self { lead, last: lead, extent: Extent::NONE, low: f64::INFINITY, above: Extent::NONE }
    }

    fn add(&mut self, index: usize, step: &Move) {
        let height = step.to[2];
        if height < self.low - EPSILON_Z {
            self.above = self.extent;
            self.low = height;
        } else if height > self.low + EPSILON_Z {
            self.above.add_move(step);
        }
        self.extent.add_move(step);
        self.last = index;
    }
}

impl Survey {
    /// Looks through `text`.
    ///
    /// # Errors
    /// When nothing is printed.
    pub(crate) fn of(text: &[u8]) -> Result<Self, Error> {
        let (threads, travel_feed) = threads(text);
        let (Some(first), Some(last)) = (first_of_part(&threads), threads.last()) else {
            return Err(Error::new("nothing is printed in this file")
                .hint("give it a G-code file whose moves have E words"));
        };
        let part = || threads.iter().skip_while(|thread| thread.last < first.last);
        let lowest = part().map(|thread| thread.low).fold(f64::INFINITY, f64::min);
        let (mut extent, mut above) = (Extent::NONE, Extent::NONE);
        for thread in part() {
            extent.add_all(&thread.extent);
            let is_higher = thread.low > lowest + EPSILON_Z;
            above.add_all(if is_higher { &thread.extent } else { &thread.above });
        }
        let centre = if above.is_empty() { extent.middle() } else { above.middle() };
        Ok(Self {
            lead: first.lead,
            last: last.last,
            centre,
            bottom: extent.low[2],
            top: extent.high[2],
            travel_feed,
        })
    }
}

/// The threads in order, and the feed of the last travel.
fn threads(text: &[u8]) -> (Vec<Thread>, Option<f64>) {
    let mut machine = Machine::new();
    let mut line = Line::default();
    let mut threads: Vec<Thread> = Vec::new();
    let mut open = false;
    // The last travel in XY, or else in Z, since the last bead.
    let mut lead: Option<(usize, bool)> = None;
    let mut travel_feed = None;
    for (index, raw) in raw_lines(split_bom(text).1).enumerate() {
        line.read(raw.text);
        match machine.obey(&line) {
            Act::Move(step) if step.prints() => {
                if !open {
                    let lead = lead.map_or(index, |(lead, _)| lead);
                    threads.push(Thread::new(lead));
                    open = true;
                }
                if let Some(thread) = threads.last_mut() {
                    thread.add(index, &step);
                }
                lead = None;
                travel_feed = travel_feed.or(step.feed);
            }
            Act::Move(step) if step.travels() => {
                open = false;
                if step.goes || lead.is_none_or(|(_, goes)| !goes) {
                    lead = Some((index, step.goes));
                }
                travel_feed = step.feed.filter(|_| step.goes).or(travel_feed);
            }
            Act::Home => {
                open = false;
                lead = None;
            }
            Act::Move(_) | Act::Other => {}
        }
    }
    (threads, travel_feed)
}

/// The first thread that is no purge line: those lie beside everything that comes after them, and what comes after is
/// built up.
fn first_of_part(threads: &[Thread]) -> Option<&Thread> {
    let mut behind: Vec<Extent> = Vec::with_capacity(threads.len());
    let mut extent = Extent::NONE;
    for thread in threads.iter().rev() {
        behind.push(extent);
        extent.add_all(&thread.extent);
    }
    threads.iter().zip(behind.iter().rev()).find_map(|(thread, behind)| {
        let is_built_up = behind.high[2] - behind.low[2] > EPSILON_Z;
        let is_purge = is_built_up && thread.extent.is_apart(behind);
        (!is_purge).then_some(thread)
    })
}
