//! A layer of the base: one thread from the rim to the middle or to the far side, or the other way round.

use crate::Base;
use crate::track::{Spot, Track};
use crate::zigzag::Zigzag;
use shape::plane::{offset, simplified};
use skein::Ring;

/// What a layer of the base is made of: the outermost ring, which carries the wall, and what fills it.
#[derive(Clone, Debug)]
pub struct Floor {
    outermost: Track,
    /// How wide its bead is, in microns.
    width: f64,
    inside: Inside,
    /// How far apart the beads inside lie, in microns.
    pitch: f64,
}

#[derive(Clone, Debug)]
enum Inside {
    /// The other rings, the outermost first.
    Rings(Vec<Track>),
    Lines(Zigzag),
}

impl Floor {
    /// The floor within a ring of beads of a width, about `wanted` apart; `None` when it cannot be one thread. Where lines
    /// would fall apart there are rings.
    pub fn inside(outermost: &Ring, width: f64, wanted: f64, base: Base) -> Option<Self> {
        let lines = if base == Base::ZigZag { Zigzag::inside(outermost, width, wanted) } else { None };
        let (inside, pitch) = match lines {
            Some(lines) => {
                let pitch = lines.pitch;
                (Inside::Lines(lines), pitch)
            }
            None => rings(outermost, width, wanted)?,
        };
        Some(Self { outermost: Track::new(outermost)?, width, inside, pitch })
    }

    /// Whether it is made of rings.
    pub fn has_rings(&self) -> bool {
        matches!(self.inside, Inside::Rings(_))
    }

    /// Where the wall above may begin: as near to a place as the floor allows.
    pub fn seam(&self, wanted: Spot) -> Spot {
        match &self.inside {
            Inside::Rings(_) => wanted,
            Inside::Lines(lines) => lines.from(wanted).first().map_or(wanted, |it| it.0),
        }
    }

    /// The thread that ends next to a place: on the outermost ring when it runs outwards, else inside. Each corner has the
    /// width of the room for the bead that ends there.
    ///
    /// It goes along each ring until it is one bead short of where it came onto it, and there straight to the next, so
    /// that neither rings nor links lie nearer to each other than a bead. It is made from its end to its start.
    pub fn thread(&self, end: Spot, outwards: bool) -> Vec<(Spot, f64)> {
        let mut way: Vec<(Spot, f64)> = Vec::new();
        if outwards {
            self.border(end, &mut way);
        }
        match &self.inside {
            Inside::Lines(lines) => way.extend(lines.from(last(&way, end))),
            Inside::Rings(rings) => {
                let mut lay = |ring: &Track, short: f64| {
                    let back = around(ring, short, last(&way, end));
                    way.extend(back.into_iter().map(|at| (at, self.pitch)));
                };
                // The innermost is closed: it is an end of the thread.
                let (innermost, others) = match rings.split_last() {
                    Some((innermost, others)) => (Some(innermost), others),
                    None => (None, &rings[..]),
                };
                if outwards {
                    others.iter().for_each(|ring| lay(ring, self.pitch));
                }
                innermost.into_iter().for_each(|ring| lay(ring, 0.0));
                if !outwards {
                    others.iter().rev().for_each(|ring| lay(ring, self.pitch));
                }
            }
        }
        if !outwards {
            self.border(end, &mut way);
        }
        // Turned round, every side belongs to its other end.
        let widths: Vec<f64> = way.iter().map(|it| it.1).collect();
        way.reverse();
        let behind = widths.iter().rev().take(1).chain(widths.iter().rev());
        way.iter_mut().zip(behind).for_each(|(corner, width)| corner.1 = *width);
        way
    }

    fn border(&self, end: Spot, way: &mut Vec<(Spot, f64)>) {
        let back = around(&self.outermost, self.width, last(way, end));
        way.extend(back.into_iter().map(|at| (at, self.width)));
    }
}

fn last(way: &[(Spot, f64)], end: Spot) -> Spot {
    way.last().map_or(end, |it| it.0)
}

/// The way back around a ring from where it is nearest to a place, until it is so much short of there.
fn around(ring: &Track, short: f64, from: Spot) -> Vec<Spot> {
    let length = (ring.length() - short).max(ring.length() / 2.0);
    ring.way(ring.nearest(from), -length)
}

/// The rings inside the outermost, evenly spread so that the last one closes the middle, and how far apart they lie;
/// `None` when they do not lie one inside the other down to one middle.
fn rings(outermost: &Ring, width: f64, wanted: f64) -> Option<(Inside, f64)> {
    let tolerance = wanted / FINENESS;
    let coarse = nested(simplified(outermost, tolerance)?, wanted, wanted, usize::MAX, tolerance)?;
    let innermost = coarse.last()?;
    let depth = wanted * (coarse.len() as f64 - 1.0) + depth(innermost, wanted, tolerance);
    // The innermost ring lies half a pitch around the middle, so it closes it.
    let room = (depth - width / 2.0).max(0.0);
    let count = (room / wanted).round();
    let pitch = if count > 0.0 { room / count } else { width };
    let rings = nested(outermost.clone(), (width + pitch) / 2.0, pitch, count as usize + 1, tolerance)?;
    // A middle that is a line may vanish within rounding.
    let tracks: Vec<Track> = rings.iter().skip(1).filter_map(Track::new).collect();
    Some((Inside::Rings(tracks), pitch))
}

/// Rings of the base keep no corner nearer to a straight line than this share of their distance: each is made from the
/// one around it, and what they need not follow costs no work.
const FINENESS: f64 = 100.0;

/// Rings one inside the other, the given one first, the second so far inside it and the others so far apart, until there
/// is room for none or there are as many as wanted; `None` where one falls apart.
fn nested(outermost: Ring, first: f64, pitch: f64, most: usize, tolerance: f64) -> Option<Vec<Ring>> {
    let mut rings = vec![outermost];
    while rings.len() < most {
        let distance = if rings.len() == 1 { first } else { pitch };
        let mut inner = offset(&rings[rings.len() - 1..], -distance);
        match (inner.pop(), inner.pop()) {
            (None, _) => break,
            (Some(ring), None) => rings.push(simplified(&ring, tolerance).unwrap_or(ring)),
            _ => return None,
        }
    }
    Some(rings)
}

/// How deep the middle of a ring lies inside it, at most so deep, to a precision: where what is left of it vanishes.
fn depth(ring: &Ring, most: f64, precision: f64) -> f64 {
    let (mut low, mut high) = (0.0, most);
    while high - low > precision {
        let middle = f64::midpoint(low, high);
        if offset(std::slice::from_ref(ring), -middle).is_empty() { high = middle } else { low = middle }
    }
    low
}
