//! Where a thread has been, and which way it went there.
//!
//! A table that grows up to a size that holds several turns of any pot. From then on a place that another one has pushed
//! out is only one that is not found any more. So the memory is bounded for any thread, and what is found depends on
//! nothing but the thread.

/// Slots of the table, at first and at most; powers of two.
const FEWEST_SLOTS: usize = 1 << 8;
const MOST_SLOTS: usize = 1 << 14;
/// A turn is longer than so many cells.
const SHORTEST_TURN: f64 = 6.0;
/// The cosine of the angle within which two threads go the same way, 60°.
const SAME_WAY: f64 = 0.5;
/// A thread lies right on another when it is no farther beside it than this, in cells.
const ON_TRACK: f64 = 0.25;
/// A cell and those around it.
const AROUND: [(i32, i32); 9] =
    [(0, 0), (1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];

/// A thread at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Look {
    /// Where, mm.
    pub(crate) place: (f64, f64),
    /// Which way it goes, of length 1.
    pub(crate) heading: (f64, f64),
    /// How high, mm.
    pub(crate) height: f64,
    /// What it rises in a millimetre of its way in XY.
    pub(crate) slope: f64,
    /// The way in XY that it has come, mm.
    pub(crate) way: f64,
}

impl Look {
    /// The thread farther on, mm.
    pub(crate) fn ahead(&self, by: f64) -> Self {
        let place = (self.place.0 + self.heading.0 * by, self.place.1 + self.heading.1 * by);
        Self { place, height: self.height + self.slope * by, way: self.way + by, ..*self }
    }

    /// How high the thread is where it passes `place`, a little before or behind.
    pub(crate) fn height_abreast_of(&self, place: (f64, f64)) -> f64 {
        let ahead = (place.0 - self.place.0, place.1 - self.place.1);
        self.height + self.slope * dot(ahead, self.heading)
    }

    /// How far to the left of the thread `place` lies, mm.
    fn beside(&self, place: (f64, f64)) -> f64 {
        let ahead = (place.0 - self.place.0, place.1 - self.place.1);
        dot(ahead, (-self.heading.1, self.heading.0))
    }
}

/// The places where a thread was looked at, the last one of each cell and quarter of the compass.
#[derive(Clone, Debug)]
pub(crate) struct Trail {
    cell: f64,
    slots: Vec<Option<(Key, Look)>>,
    /// How many of them were ever filled.
    filled: usize,
    /// The way of the last look: none was longer.
    way: f64,
}

/// A cell, and the quarter of the compass in which the thread goes through it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Key {
    column: i32,
    row: i32,
    quarter: (bool, bool),
}

impl Trail {
    /// Nowhere yet. What lies farther apart than `cell`, mm, is not the same place.
    pub(crate) fn new(cell: f64) -> Self {
        Self { cell, slots: Vec::new(), filled: 0, way: 0.0 }
    }

    /// What lies farther apart is not the same place, mm.
    pub(crate) fn cell(&self) -> f64 {
        self.cell
    }

    /// A way that no look has come yet, mm, for a thread that begins.
    pub(crate) fn unknown_way(&self) -> f64 {
        self.way + self.cell
    }

    /// Keeps a look. A cell that the thread has not left since the last one keeps that, so that in the next turn
    /// something is found as soon as the thread comes to the cell.
    pub(crate) fn keep(&mut self, look: &Look) {
        self.way = look.way;
        if self.filled * 4 >= self.slots.len() && self.slots.len() < MOST_SLOTS {
            self.grow();
        }
        self.put(self.key(look.place, quarter(look.heading)), look);
    }

    fn grow(&mut self) {
        let size = (self.slots.len() * 2).clamp(FEWEST_SLOTS, MOST_SLOTS);
        let old = std::mem::replace(&mut self.slots, vec![None; size]);
        self.filled = 0;
        for (key, look) in old.into_iter().flatten() {
            self.put(key, &look);
        }
    }

    fn put(&mut self, key: Key, look: &Look) {
        let since = look.way - self.shortest_turn();
        let [one, other] = self.slots_of(key).map(|slot| self.slots.get(slot).copied().flatten());
        let is_other = match (one, other) {
            (Some((found, _)), _) if found == key => false,
            (_, Some((found, _))) if found == key => true,
            // The older one goes.
            (Some((_, one)), Some((_, other))) => other.way < one.way,
            (one, _) => one.is_some(),
        };
        let kept = if is_other { other } else { one };
        if kept.is_none_or(|(found, before)| found != key || before.way <= since) {
            self.filled += usize::from(kept.is_none());
            let [one, other] = self.slots_of(key);
            if let Some(slot) = self.slots.get_mut(if is_other { other } else { one }) {
                *slot = Some((key, *look));
            }
        }
    }

    /// A key may stand in either of two slots.
    fn slots_of(&self, key: Key) -> [usize; 2] {
        // Without slots it is none of them.
        let slot = key.mixed() & self.slots.len().wrapping_sub(1);
        [slot, slot ^ 1]
    }

    /// The nearest place beside `here` where the thread went the same way a turn ago or earlier, but not before it had
    /// come the way `since`.
    pub(crate) fn nearest(&self, here: &Look, since: f64) -> Option<&Look> {
        let own = quarter(here.heading);
        let mut nearest: Option<(f64, &Look)> = None;
        for cell in self.cells_around(here) {
            for quarter in [own, quarter_beside(here.heading)] {
                let Some(look) = self.earlier(Key { quarter, ..cell }, here, since) else { continue };
                let squared = squared(look.place, here.place);
                if squared <= self.cell * self.cell
                    && dot(look.heading, here.heading) > SAME_WAY
                    && nearest.is_none_or(|(least, _)| squared < least)
                {
                    nearest = Some((squared, look));
                }
            }
            // Most threads lie right on themselves, and nothing can be nearer.
            if nearest.is_some_and(|(_, look)| look.beside(here.place).abs() < ON_TRACK * self.cell) {
                break;
            }
        }
        nearest.map(|(_, look)| look)
    }

    /// How high the thread has come at most in the cells around `here` a turn ago or earlier, whichever way it went, but
    /// not before it had come the way `since`.
    pub(crate) fn highest(&self, here: &Look, since: f64) -> Option<f64> {
        let quarters = [(false, false), (false, true), (true, false), (true, true)];
        self.cells_around(here)
            .flat_map(|cell| quarters.map(|quarter| Key { quarter, ..cell }))
            .filter_map(|key| self.earlier(key, here, since))
            .map(|look| look.height_abreast_of(here.place))
            .reduce(f64::max)
    }

    /// The cell of a look, and those around it.
    fn cells_around(&self, look: &Look) -> impl Iterator<Item = Key> + use<> {
        let middle = self.key(look.place, quarter(look.heading));
        AROUND.iter().map(move |(x, y)| Key {
            column: middle.column.saturating_add(*x),
            row: middle.row.saturating_add(*y),
            ..middle
        })
    }

    /// What is kept for a cell from a turn before `here` or earlier.
    fn earlier(&self, key: Key, here: &Look, since: f64) -> Option<&Look> {
        let slots = self.slots_of(key).into_iter().filter_map(|slot| self.slots.get(slot)?.as_ref());
        let (_, look) = slots.into_iter().find(|(found, _)| *found == key)?;
        let until = here.way - self.shortest_turn();
        (look.way >= since && look.way <= until).then_some(look)
    }

    /// A turn is no shorter; a thread that is at the same place again sooner has only wriggled.
    fn shortest_turn(&self) -> f64 {
        SHORTEST_TURN * self.cell
    }

    fn key(&self, (x, y): (f64, f64), quarter: (bool, bool)) -> Key {
        Key { column: floor(x / self.cell), row: floor(y / self.cell), quarter }
    }
}

impl Key {
    /// Cells that follow each other get slots that have nothing to do with each other: else one piece of the way could
    /// push out another. Odd constants with evenly spread bits: 2⁶⁴ over the golden ratio, and a prime.
    fn mixed(self) -> usize {
        let place = u64::from(self.column as u32) << 32 | u64::from(self.row as u32);
        let quarter = u64::from(self.quarter.0) << 1 | u64::from(self.quarter.1);
        let mixed = (place ^ quarter << 30).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let mixed = (mixed ^ mixed >> 32).wrapping_mul(0xD6E8_FEB8_6659_FD93);
        (mixed ^ mixed >> 32) as usize
    }
}

/// What is out of reach is kept at the border, where nothing is printed. A cast is faster than rounding.
fn floor(value: f64) -> i32 {
    let whole = value as i32;
    if f64::from(whole) > value { whole.saturating_sub(1) } else { whole }
}

fn quarter((x, y): (f64, f64)) -> (bool, bool) {
    (x >= 0.0, y >= 0.0)
}

/// The quarter that a heading lies nearest to beside its own: rounding turns it across.
fn quarter_beside((x, y): (f64, f64)) -> (bool, bool) {
    if x.abs() < y.abs() { (x < 0.0, y >= 0.0) } else { (x >= 0.0, y < 0.0) }
}

fn squared(a: (f64, f64), b: (f64, f64)) -> f64 {
    let (x, y) = (a.0 - b.0, a.1 - b.1);
    x * x + y * y
}

fn dot(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.0 * b.0 + a.1 * b.1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A thread from the origin along X, to and fro on `length` mm, that rises by 1 mm each time.
    fn to_and_fro(length: f64, times: usize) -> (Trail, f64) {
        let mut trail = Trail::new(1.5);
        let mut way = trail.unknown_way();
        for time in 0..times {
            let goes = time % 2 == 0;
            let (start, x) = if goes { (0.0, 1.0) } else { (length, -1.0) };
            let heading = (x, 0.0);
            let look = Look { place: (start, 0.0), heading, height: time as f64, slope: 1.0 / length, way };
            for step in 0..=(length as u32) {
                trail.keep(&look.ahead(f64::from(step)));
            }
            way += length;
        }
        (trail, way)
    }

    #[test]
    fn what_goes_the_same_way_is_found_and_what_is_highest() {
        let (trail, way) = to_and_fro(40.0, 2);
        let here = Look { place: (20.2, 0.5), heading: (1.0, 0.0), height: 2.5, slope: 0.0, way: way + 20.0 };
        let height = |look: &Look| (look.height_abreast_of(here.place) * 1000.0).round();
        assert_eq!(trail.nearest(&here, 0.0).map(height), Some(505.0));
        let back = Look { heading: (-1.0, 0.01), ..here };
        assert_eq!(trail.nearest(&back, 0.0).map(height), Some(1495.0));
        assert_eq!(trail.highest(&here, 0.0).map(|height| (height * 1000.0).round()), Some(1495.0));
        assert_eq!(trail.nearest(&here, way), None, "before this thread began");
        let beside = Look { place: (20.2, 1.8), ..here };
        assert_eq!(trail.nearest(&beside, 0.0), None, "another wall");
        let early = Look { way: way - 55.0, ..here };
        assert_eq!(trail.nearest(&early, 0.0), None, "no turn in between");
    }

    #[test]
    fn it_does_not_grow_for_ever() {
        let mut trail = Trail::new(1.5);
        let look = Look { place: (0.0, 0.0), heading: (0.6, 0.8), height: 0.0, slope: 0.0, way: 0.0 };
        for step in 0..200_000 {
            trail.keep(&look.ahead(f64::from(step) * 2.0));
        }
        assert_eq!(trail.slots.len(), MOST_SLOTS);
        for place in [(f64::NAN, 0.0), (f64::INFINITY, -1e300)] {
            trail.keep(&Look { place, ..look });
            assert_eq!(trail.nearest(&Look { place, ..look }, 0.0), None);
        }
    }
}
