//! One turn of the spiral: from the outline below, blended into the one above as it goes round.

use crate::lane::Lane;
use crate::track::{Spot, between, distance, foot, square};

/// The way of one turn.
#[derive(Clone, Debug)]
pub struct Turn {
    /// Its corners; it begins on the lane below and ends on the one above, at the seam.
    pub corners: Vec<Corner>,
    /// How far the lane above lies from the one below at most, in microns.
    pub reach: f64,
}

/// A corner of a turn.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// Where it is.
    pub at: Spot,
    /// How much of the turn is laid when the nozzle is there: between 0 and 1, by length.
    pub share: f64,
    /// Its place on the lane below, counted in that lane's corners.
    pub low: f64,
    /// Its place on the lane above, counted in that lane's corners.
    pub high: f64,
}

impl Turn {
    /// A turn that stays on one lane.
    pub fn flat(lane: &Lane) -> Self {
        let corners = lane.whole();
        let pairs = corners.iter().enumerate().map(|(place, at)| {
            let place = (*at, place as f64);
            (place, place)
        });
        Self::new(&pairs.collect::<Vec<Pair>>())
    }

    /// A turn from one lane to the next.
    pub fn blended(below: &Lane, above: &Lane) -> Self {
        let mut pairs: Vec<Pair> = Vec::with_capacity(below.corners() + above.corners() + 1);
        let (mut low, mut high) = (0.0, 0.0);
        for (below, above) in below.arcs.iter().zip(&above.arcs) {
            matched((below, low), (above, high), &mut pairs);
            (low, high) = (low + below.len() as f64, high + above.len() as f64);
        }
        pairs.push(((below.start(), low), (above.start(), high)));
        Self::new(&pairs)
    }

    fn new(pairs: &[Pair]) -> Self {
        let mut so_far = 0.0;
        let mut lengths = Vec::with_capacity(pairs.len());
        let mut before: Option<Spot> = None;
        let mut reach: f64 = 0.0;
        for (low, high) in pairs {
            let middle = between(low.0, high.0, 0.5);
            so_far += before.map_or(0.0, |before| distance(before, middle));
            before = Some(middle);
            lengths.push(so_far);
            reach = reach.max(square(low.0, high.0));
        }
        let whole = so_far.max(1.0);
        let corner = |((low, high), length): (&Pair, &f64)| {
            let share = length / whole;
            Corner { at: between(low.0, high.0, share), share, low: low.1, high: high.1 }
        };
        Self { corners: pairs.iter().zip(&lengths).map(corner).collect(), reach: reach.sqrt() }
    }

    /// How much of the turn is laid when the nozzle is over a place of the lane above, and where it is then; the places must
    /// be asked for in their order.
    pub fn over(&self) -> impl FnMut(f64) -> (f64, Spot) + '_ {
        self.at(|corner| corner.high)
    }

    /// The same for places of the lane below.
    pub fn above(&self) -> impl FnMut(f64) -> (f64, Spot) + '_ {
        self.at(|corner| corner.low)
    }

    fn at(&self, place: impl Fn(&Corner) -> f64) -> impl FnMut(f64) -> (f64, Spot) {
        let mut next = 0;
        move |wanted| {
            while self.corners.get(next).is_some_and(|corner| place(corner) < wanted) {
                next += 1;
            }
            let before = next.checked_sub(1).and_then(|before| self.corners.get(before));
            match (before, self.corners.get(next)) {
                (Some(before), Some(behind)) => {
                    let part = (wanted - place(before)) / (place(behind) - place(before));
                    let share = before.share + (behind.share - before.share) * part;
                    (share, between(before.at, behind.at, part))
                }
                (None, Some(first)) => (0.0, first.at),
                (last, None) => (1.0, last.map(|last| last.at).unwrap_or_default()),
            }
        }
    }
}

/// A place on a lane, and how many of its corners lie before it.
type Place = (Spot, f64);

/// Places on the lane below and on the one above that belong together.
type Pair = (Place, Place);

/// Places of two ways that belong together, in the order of both. Of the two next corners it is always the turn of the
/// one that lies nearer to the other way, and there it finds the foot of its perpendicular.
///
/// Corners find corners, lobes find lobes, and a place never finds one that lies before that of an earlier place.
fn matched((below, from_low): (&[Spot], f64), (above, from_high): (&[Spot], f64), pairs: &mut Vec<Pair>) {
    let (mut below, mut above) = (places(below, from_low), places(above, from_high));
    let (Some(mut low), Some(mut high)) = (below.next(), above.next()) else { return };
    pairs.push((low, high));
    let (mut next_low, mut next_high) = (below.next(), above.next());
    while next_low.is_some() || next_high.is_some() {
        // Of a way that has come to its end, the end goes with all that is left of the other.
        let (a, b) = (next_low.unwrap_or(low), next_high.unwrap_or(high));
        let (on_low, on_high) = (foot(low.0, a.0, b.0), foot(high.0, b.0, a.0));
        let (low_foot, high_foot) = (along(low, a, on_low), along(high, b, on_high));
        let lows_turn = next_low.is_some() && square(a.0, high_foot.0) <= square(b.0, low_foot.0);
        (low, high) = if lows_turn || next_high.is_none() { (a, high_foot) } else { (low_foot, b) };
        if low.1 >= a.1 {
            next_low = below.next();
        }
        if high.1 >= b.1 {
            next_high = above.next();
        }
        pairs.push((low, high));
    }
}

/// The corners of a way as places of a lane on which it begins behind so many corners.
fn places(way: &[Spot], from: f64) -> impl Iterator<Item = Place> + '_ {
    way.iter().enumerate().map(move |(index, at)| (*at, from + index as f64))
}

/// The place at a share of the way between two places of a side.
fn along(from: Place, to: Place, share: f64) -> Place {
    (between(from.0, to.0, share), if share < 1.0 { from.1 + (to.1 - from.1) * share } else { to.1 })
}
