//! Where each turn begins.
//!
//! A wall of two or three beads is cut open there and linked, and that takes room: where an inner bead runs into a tip, as
//! behind a lobe, it lies deeper than a bead below the outer one, and the links would run over each other. So the seam
//! moves on from turn to turn as far as there is room, and back from there.

use crate::Coil;
use crate::base::Floor;
use crate::lane::{Lane, Links};
use crate::plan::Role;
use crate::source::{Source, Wall};
use crate::track::{Spot, Track};
use std::cmp::Ordering;

/// Where a turn begins.
#[derive(Clone, Copy, Debug)]
pub struct Seam {
    /// The place on its outermost bead where the seam would be if it did not move on.
    pub anchor: Spot,
    /// How far it has moved on from there, in steps, and which way it goes.
    steps: i32,
    forth: bool,
    /// How long a step is, in microns.
    step: f64,
    /// The links of its lane, where there are any.
    links: Option<Links>,
}

impl Seam {
    fn at(anchor: Spot) -> Self {
        // The first step leads to the anchor itself.
        Self { anchor, steps: -1, forth: true, step: 0.0, links: None }
    }

    /// The length along the outermost bead.
    pub fn on(&self, outermost: &Track) -> f64 {
        outermost.nearest(self.anchor) + self.step * f64::from(self.steps)
    }

    /// The next one, on the wall above: of a step on, a step back and none the first that has room and leaves each link within
    /// half a bead over the one below, else the one that comes nearest to that. Only where the spiral begins it may lie
    /// further away: a turn whose seam leaps would run into its own beginning.
    fn next(self, wall: &Wall, step: f64) -> Option<Self> {
        let tracks: Vec<Track> = wall.beads.iter().filter_map(Track::new).collect();
        let outermost = tracks.first()?;
        let from = outermost.nearest(self.anchor);
        let anchor = outermost.at(from);
        if tracks.len() == 1 {
            return Some(Self { anchor, step: 0.0, links: None, ..self });
        }
        let here = Self { anchor, step, ..self };
        let opened = |seam: Self, from: f64| {
            let place = from + seam.step * f64::from(seam.steps);
            let links = Lane::new(&tracks, place, wall.pitch)?.links();
            let moved = self.links.map_or(0.0, |below| links.furthest_from(&below));
            let seam = Self { links: Some(links), ..seam };
            Some(Opened { seam, lacks_room: !links.have_room(wall.pitch), moved })
        };
        let on = |by: i32, forth: bool| Self { steps: here.steps.saturating_add(by), forth, ..here };
        let way = if here.forth { 1 } else { -1 };
        let mut best: Option<Opened> = None;
        for seam in [on(way, here.forth), on(-way, !here.forth), here] {
            let Some(next) = opened(seam, from) else { continue };
            if !next.lacks_room && next.moved <= wall.pitch / 2.0 {
                return Some(next.seam);
            }
            if best.as_ref().is_none_or(|best| next.order(best).is_lt()) {
                best = Some(next);
            }
        }
        let best = best.unwrap_or(Opened { seam: on(way, here.forth), lacks_room: true, moved: 0.0 });
        if self.links.is_some() || !best.lacks_room {
            return Some(best.seam);
        }
        let away = |beads: f64| {
            let place = from + here.step * f64::from(here.steps) + beads * wall.pitch;
            opened(Self { anchor: outermost.at(place), steps: 0, ..here }, place)
                .filter(|next| !next.lacks_room)
        };
        let mut beads = (1..=FURTHEST).flat_map(|beads| [f64::from(beads), -f64::from(beads)]);
        Some(beads.find_map(away).unwrap_or(best).seam)
    }
}

/// A seam whose links are known.
struct Opened {
    seam: Seam,
    lacks_room: bool,
    /// How far they lie from those below at most, in microns.
    moved: f64,
}

impl Opened {
    fn order(&self, other: &Self) -> Ordering {
        self.lacks_room.cmp(&other.lacks_room).then(self.moved.total_cmp(&other.moved))
    }
}

/// Where there is no room for a seam it is looked for so many beads to either side.
const FURTHEST: i32 = 16;

/// The seam of each wall.
pub fn seams(coil: &Coil, sources: &[Source], roles: &[Role], made: &[Option<Floor>]) -> Vec<Option<Seam>> {
    let mut seams: Vec<Option<Seam>> = Vec::with_capacity(sources.len());
    for (index, (source, role)) in sources.iter().zip(roles).enumerate() {
        let before = match role {
            Role::Turn { first: false, .. } => seams.last().copied().flatten(),
            Role::Turn { first: true, .. } | Role::Flat => match (seams.last(), index.checked_sub(1)) {
                (Some(Some(below)), _) => Some(*below),
                (_, Some(below)) if matches!(roles[below], Role::Base { .. }) => Some(Seam::at(
                    made[below].as_ref().map_or(source.start, |floor| floor.seam(source.start)),
                )),
                _ => Some(Seam::at(source.start)),
            },
            Role::Base { .. } | Role::Layered => None,
        };
        let next = |(before, wall): (Seam, &Wall)| before.next(wall, coil.seam_step.f64() * wall.pitch);
        seams.push(before.zip(source.wall.as_ref().ok()).and_then(next));
    }
    seams
}
