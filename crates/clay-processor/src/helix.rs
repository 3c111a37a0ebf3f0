//! How often a climb goes round, and how much higher it is then.
//!
//! A turn is the way from a place to where the thread next passes above it, in the same direction. The direction tells
//! the two sides of a thin part from each other, and no axis is needed: the outline may be of any form, lean, and twist.
//! How much the thread turns its head says less, because from one island to the next and around a tip half a turn is
//! lost or won by chance.

use crate::motion::Move;
use crate::report::{Pitch, Steep};
use crate::trail::{Look, Trail};

/// Places that are kept lie so far apart, and those that are looked down from, in cells.
const STRIDE: f64 = 1.0;
const PACE: f64 = 3.0;
/// One move is looked at in so many places at most.
const MOST_LOOKS: f64 = 1024.0;
/// Threads so many usual turns apart are no neighbours: one of them is laid in the air.
const NEIGHBOURS: f64 = 3.0;
/// What is so for less than this way is no more than a corner, in cells.
const STRETCH: f64 = 4.0;
/// A turn that rises so many times as much as usual is looked at twice.
const STEEP: f64 = 1.25;

/// A climb that goes on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Helix {
    /// Where it is and how high, from its beginning, and what way the trail has come.
    at: (f64, f64),
    risen: f64,
    way: f64,
    /// The way at the last look, and at the last one down.
    looked: Option<f64>,
    looked_down: f64,
    /// The end of the last move.
    end: Option<(Steep, Look)>,
    /// The way where the climb began, and the turn that goes on.
    begin: f64,
    turn: f64,
    turns: Turns,
    stretch: Option<Stretch>,
    steepest: Option<Steep>,
}

/// A piece of the way in which the thread lies above itself.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    begin: f64,
    /// The least that it rises in a turn there.
    least: Steep,
}

impl Helix {
    /// A climb that begins with a new piece of the trail.
    pub(crate) fn new(trail: &Trail) -> Self {
        let way = trail.unknown_way();
        Self { way, begin: way, turn: way, looked_down: way, ..Self::default() }
    }

    /// The climb goes on with the move at `index`. Returns the rise of a turn that it completes.
    #[inline]
    pub(crate) fn go_on(&mut self, trail: &mut Trail, index: usize, step: &Move) -> Option<f64> {
        let turns = self.turns.all.len();
        let place = Steep { rise: 0.0, index, height: step.to };
        match step.arc {
            None => self.go_straight(trail, place, step.by, step.rise),
            Some(arc) => {
                let points: Vec<(f64, f64)> = arc.points(self.at, step.by).collect();
                let rise = step.rise / points.len().max(1) as f64;
                for (x, y) in points {
                    self.go_straight(trail, place, (x - self.at.0, y - self.at.1), rise);
                }
            }
        }
        self.turns.all.get(turns).map(|turn| turn.rise)
    }

    /// What is known of it at its end.
    pub(crate) fn pitch(mut self, trail: &Trail) -> Pitch {
        if let Some((place, end)) = self.end {
            self.look_down(trail, place, &end);
        }
        let measured = self.turns.all.len();
        let rise = self.turns.usual().filter(|rise| *rise > 0.0);
        // Where islands end and walls lean much it does not come back above itself, but goes on rising.
        let turns = rise.map_or(0.0, |rise| self.risen / rise);
        let top = self.end.and_then(|(place, _)| place.height);
        Pitch { turns, rise, measured, steepest: self.steepest, top }
    }

    fn go_straight(&mut self, trail: &mut Trail, place: Steep, by: (f64, f64), rise: f64) {
        let length = (by.0 * by.0 + by.1 * by.1).sqrt();
        if length > 0.0 {
            let heading = (by.0 / length, by.1 / length);
            let start =
                Look { place: self.at, heading, height: self.risen, slope: rise / length, way: self.way };
            self.look_along(trail, place, &start, length);
            self.end = Some((place, start.ahead(length)));
        }
        self.at = (self.at.0 + by.0, self.at.1 + by.1);
        self.risen += rise;
        self.way += length;
    }

    fn look_along(&mut self, trail: &mut Trail, place: Steep, start: &Look, length: f64) {
        let stride = STRIDE * trail.cell();
        let looked = self.looked.unwrap_or_else(|| {
            trail.keep(start);
            start.way
        });
        self.looked = Some(looked);
        if start.way + length - looked < stride {
            return;
        }
        let looks = (length / stride).ceil().clamp(1.0, MOST_LOOKS);
        for look in 1..=looks as u32 {
            self.look(trail, place, &start.ahead(length * f64::from(look) / looks));
        }
        self.looked = Some(start.way + length);
    }

    fn look(&mut self, trail: &mut Trail, place: Steep, here: &Look) {
        if here.way - self.looked_down >= PACE * trail.cell() {
            self.looked_down = here.way;
            self.look_down(trail, place, here);
        }
        trail.keep(here);
    }

    fn look_down(&mut self, trail: &Trail, place: Steep, here: &Look) {
        let Some(below) = trail.nearest(here, self.begin) else { return };
        let rise = here.height - below.height_abreast_of(here.place);
        if below.way >= self.turn {
            // The next turn begins where this one ended, up to a pace ago, or on another island.
            let late = (below.way - self.turn).min((PACE + STRIDE) * trail.cell());
            self.turn = here.way - late;
            self.turns.add(Turn { rise, length: here.way - below.way });
        }
        let rise = if self.turns.are_exceeded(STEEP, rise) { self.above_all(trail, here) } else { rise };
        self.measure(trail.cell(), here.way, Steep { rise, ..place });
    }

    /// How far the thread lies above all of itself here. Where walls lean, what went the same way may be some turns
    /// older than what went another.
    fn above_all(&self, trail: &Trail, here: &Look) -> f64 {
        trail.highest(here, self.begin).map_or(0.0, |highest| here.height - highest)
    }

    /// The thread lies so far above itself here.
    fn measure(&mut self, cell: f64, way: f64, here: Steep) {
        if self.turns.all.is_empty() || self.turns.are_exceeded(NEIGHBOURS, here.rise) {
            self.stretch = None;
            return;
        }
        let stretch = self.stretch.get_or_insert(Stretch { begin: way, least: here });
        if here.rise < stretch.least.rise {
            stretch.least = here;
        }
        if way - stretch.begin >= STRETCH * cell {
            let least = stretch.least;
            if self.steepest.is_none_or(|most| least.rise > most.rise) {
                self.steepest = Some(least);
            }
            self.stretch = None;
        }
    }
}

/// The whole turns so far. A turn counts by its length: where a thread goes back a little to go on, it comes back above
/// itself soon, and that is none of its turns.
#[derive(Clone, Debug, Default)]
struct Turns {
    all: Vec<Turn>,
    length: f64,
    /// The rises times the lengths.
    product: f64,
}

#[derive(Clone, Copy, Debug)]
struct Turn {
    rise: f64,
    length: f64,
}

impl Turns {
    fn add(&mut self, turn: Turn) {
        self.length += turn.length;
        self.product += turn.rise * turn.length;
        self.all.push(turn);
    }

    /// Whether `rise` is more than so many turns rise on average.
    fn are_exceeded(&self, turns: f64, rise: f64) -> bool {
        rise * self.length > turns * self.product
    }

    /// What half of them rise at most, and half at least.
    fn usual(&mut self) -> Option<f64> {
        self.all.sort_unstable_by(|one, other| one.rise.total_cmp(&other.rise));
        let mut length = 0.0;
        let turn = self.all.iter().find(|turn| {
            length += turn.length;
            length * 2.0 >= self.length
        });
        turn.map(|turn| turn.rise)
    }
}
