//! Waiting: above the print, or around it.

use crate::{Cool, SHORTEST_ORBIT, Times, Waiting};
use shape::plane::offset;
use skein::{Error, Facts, Feed, Line, Move, Pen, Point, Point3, Ring, Skein, boundary};

/// Where the nozzle waits before each layer.
pub(crate) struct Orbits {
    waiting: Waiting,
    /// How high it waits before each layer.
    heights: Vec<i32>,
    /// Around what it goes before each layer; only where it goes around.
    rings: Vec<Option<Ring>>,
    orbital: Option<Feed>,
    travel: Option<Feed>,
}

impl Orbits {
    pub(crate) fn new(cool: &Cool, skein: &Skein, facts: &Facts, times: &[Times]) -> Result<Self, Error> {
        let count = skein.layers.len();
        if cool.waiting == Waiting::SlowDown {
            return Ok(Self {
                waiting: cool.waiting,
                heights: Vec::new(),
                rings: Vec::new(),
                orbital: None,
                travel: None,
            });
        }
        let clearance = (facts.layer_height()?.um() * cool.clearance.f64()).round() as i32;
        let heights = skein.highest().iter().take(count).map(|top| top.unwrap_or(0) + clearance).collect();
        let around = |index: usize| {
            let below = index.checked_sub(1)?;
            let due = cool.waiting == Waiting::Orbit && cool.missing(&times[index]) > SHORTEST_ORBIT;
            due.then(|| cool.around(&skein.layers[below].lines)).flatten()
        };
        Ok(Self {
            waiting: cool.waiting,
            heights,
            rings: (0..count).map(around).collect(),
            orbital: Some(facts.orbital_feed()?),
            travel: Some(facts.travel_feed()?),
        })
    }

    /// Waits so many seconds with the clay off.
    pub(crate) fn wait(&self, index: usize, seconds: f64, pen: &mut Pen) {
        let Some(from) = pen.nozzle().at else { return };
        let z = self.heights[index].max(from.z);
        match &self.rings[index] {
            Some(ring) => self.circle(ring, z, seconds, pen),
            None if self.waiting == Waiting::Dwell => {
                pen.go(Point3 { z, ..from }, self.travel);
                pen.push(Line::Verbatim(format!("G4 P{}", (seconds * 1000.0).round() as u64).into()));
            }
            None => {}
        }
    }

    /// Around and around, from the corner that is nearest.
    fn circle(&self, ring: &Ring, z: i32, seconds: f64, pen: &mut Pen) {
        let (Some(from), Some(orbital)) = (pen.nozzle().at, self.orbital) else { return };
        let up = |at: &Point| Point3 { x: at.x, y: at.y, z };
        let nearest = (0..ring.0.len())
            .min_by_key(|index| Move::to(up(&ring.0[*index])).length(from) as u64)
            .unwrap_or_default();
        pen.go(Point3 { z, ..from }, self.travel);
        let mut left = seconds * orbital.mm_per_s() * 1000.0;
        for at in ring.0.iter().cycle().skip(nearest).map(up) {
            let length = pen.nozzle().at.map_or(0.0, |from| Move::to(at).length(from));
            pen.go(at, Some(orbital));
            left -= length;
            if left <= 0.0 {
                break;
            }
        }
    }
}

impl Cool {
    /// The way around the largest island of a layer: its outline outset, or a square around its middle if that is small.
    fn around(&self, lines: &[Line]) -> Option<Ring> {
        let largest = boundary(lines).into_iter().max_by_key(Ring::area2)?;
        let side = 2 * i64::from(self.minimum_orbital_radius.0);
        let outset = offset(std::slice::from_ref(&largest), self.orbital_outset.um());
        let outset = outset.into_iter().max_by_key(Ring::area2).unwrap_or(largest);
        if outset.area2() / 2 >= i128::from(side) * i128::from(side) {
            return Some(outset);
        }
        let axis = |of: fn(&Point) -> i32| {
            let low = outset.0.iter().map(of).min()?;
            Some(i32::midpoint(low, outset.0.iter().map(of).max()?))
        };
        let (x, y, r) = (axis(|at| at.x)?, axis(|at| at.y)?, self.minimum_orbital_radius.0);
        Some(Ring([(-r, -r), (r, -r), (r, r), (-r, r)].map(|(dx, dy)| Point::new(x + dx, y + dy)).into()))
    }
}
