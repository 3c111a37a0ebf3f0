//! One turn of the spiral: from the outline below, blended into the one above as it goes round.

use crate::lane::Lane;
use crate::track::{Spot, between, distance, foot, square};

/// The way of one turn.
#[derive(Clone, Debug)]
pub struct Turn {
    /// Its corners; it begins on the lane below and ends on the one above, at the seam.
    pub corners: Vec<Corner>,
    /// How far the lane above lies from the one below at most, and where.
    pub reach: (f64, Spot),
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
    high: f64,
}

impl Turn {
    /// A turn that stays on one lane.
    pub fn flat(lane: &Lane) -> Self {
        let corners = lane.whole();
        let pairs = corners.iter().enumerate().map(|(place, at)| {
            let place = (*at, place as f64);
            (place, place)
        });
        Self::new(pairs.collect(), lane.start())
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
        Self::new(pairs, above.start())
    }

    fn new(pairs: Vec<Pair>, start: Spot) -> Self {
        let mut reach = (0.0, start);
        let mut so_far = 0.0;
        let mut middle = pairs.first().map_or(start, |(low, high)| between(low.0, high.0, 0.5));
        let lengths: Vec<f64> = pairs
            .iter()
            .map(|(low, high)| {
                let far = square(low.0, high.0);
                if far > reach.0 {
                    reach = (far, high.0);
                }
                let next = between(low.0, high.0, 0.5);
                so_far += distance(middle, next);
                middle = next;
                so_far
            })
            .collect();
        let whole = so_far.max(1.0);
        let corner = |((low, high), length): (&Pair, &f64)| {
            let share = length / whole;
            Corner { at: between(low.0, high.0, share), share, low: low.1, high: high.1 }
        };
        let corners = pairs.iter().zip(&lengths).map(corner).collect();
        Self { corners, reach: (reach.0.sqrt(), reach.1) }
    }

    /// How much of the turn is laid when the nozzle is over a place of the lane above; the places must be asked for in their
    /// order.
    pub fn shares(&self) -> impl FnMut(f64) -> f64 + '_ {
        let mut next = 0;
        move |place| {
            while self.corners.get(next).is_some_and(|corner| corner.high < place) {
                next += 1;
            }
            match (next.checked_sub(1).and_then(|before| self.corners.get(before)), self.corners.get(next)) {
                (Some(before), Some(behind)) => {
                    let part = (place - before.high) / (behind.high - before.high);
                    before.share + (behind.share - before.share) * part
                }
                (None, Some(_)) => 0.0,
                (_, None) => 1.0,
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
