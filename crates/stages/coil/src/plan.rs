//! What becomes of each layer, and where each turn begins.

use crate::base::Rings;
use crate::lane::Lane;
use crate::lay::{Course, Thread};
use crate::source::{Source, Wall};
use crate::texture::Waves;
use crate::track::{Spot, Track, between, distance, point};
use crate::turn::Turn;
use crate::{Base, Coil};
use rayon::prelude::*;
use shape::plane::offset;
use skein::{Feature, Line, Notes, Side};

/// What becomes of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It stays as fill laid it.
    Layered,
    /// A layer of the base: one thread.
    Base {
        /// From the middle to the rim, not from the rim to the middle.
        outwards: bool,
        /// The layer below is of the same base, so the thread comes from there.
        goes_on: bool,
    },
    /// The lowest turn of a wall without a base: flat on the bed.
    Flat,
    /// A turn of the spiral.
    Turn {
        /// It climbs from a flat layer, so its gap grows from nothing.
        first: bool,
        /// It ends the wall, so the rim is laid level behind it.
        last: bool,
    },
}

/// What becomes of all layers.
pub struct Plan<'a> {
    coil: &'a Coil,
    sources: &'a [Source],
    /// The role of each layer.
    pub roles: Vec<Role>,
    lanes: Vec<Option<Lane>>,
    bases: Vec<Option<(Rings, Vec<Spot>)>>,
}

impl<'a> Plan<'a> {
    /// Decides what each layer becomes, and says why one stays as it is.
    pub fn new(coil: &'a Coil, sources: &'a [Source], notes: &mut Notes) -> Self {
        let floors = floors(sources);
        let rings: Vec<Option<Rings>> =
            sources.par_iter().zip(&floors).map(|(source, floor)| rings(coil, source, *floor)).collect();
        let mut roles = roles(coil, sources, &rings, &floors, notes);
        let anchors = anchors(sources, &roles);
        let lanes: Vec<Option<Lane>> = sources
            .par_iter()
            .zip(&anchors)
            .enumerate()
            .map(|(index, (source, anchor))| lane(coil, source, index, anchor.as_ref()?))
            .collect();
        finish(&mut roles);
        let bases = bases(sources, &roles, &lanes, rings);
        Self { coil, sources, roles, lanes, bases }
    }

    /// The lines of a layer that does not stay as it is.
    pub fn write(&self, index: usize) -> (Vec<Line>, Notes) {
        let mut notes = Notes::default();
        let source = &self.sources[index];
        let lines = match self.roles[index] {
            Role::Layered => Vec::new(),
            Role::Base { goes_on, .. } => source.write(Feature::Infill, self.base(index, goes_on)),
            Role::Flat | Role::Turn { .. } => {
                if source.filled {
                    notes.layer(index, "what fill laid inside the wall is left out");
                }
                source.write(Feature::Edge(Side::Outer), self.wall(index, &mut notes))
            }
        };
        (lines, notes)
    }

    fn below(&self, index: usize) -> Option<(&Source, Role)> {
        let below = index.checked_sub(1)?;
        Some((&self.sources[below], self.roles[below]))
    }

    /// Whether the thread of a layer goes on in the next.
    fn goes_on(&self, index: usize) -> bool {
        match (self.roles[index], self.roles.get(index + 1)) {
            (Role::Base { .. }, Some(Role::Base { goes_on, .. })) => *goes_on,
            (Role::Base { .. } | Role::Flat, Some(Role::Turn { .. })) => true,
            (Role::Turn { last, .. }, _) => !last,
            _ => false,
        }
    }

    fn base(&self, index: usize, goes_on: bool) -> Vec<Line> {
        let Some((rings, way)) = &self.bases[index] else { return Vec::new() };
        let source = &self.sources[index];
        let height = source.bead.height.um();
        let width = rings.pitch / self.coil.base_spacing.f64() * self.coil.base_flow.f64();
        let course =
            Course { heights: (source.top, source.top), gaps: (height, height), width, bead: source.bead };
        let mut thread = Thread::default();
        let Some(first) = way.first() else { return Vec::new() };
        match self.below(index).filter(|_| goes_on) {
            // Over one bead it climbs from the layer below, with all of its clay: none is missing and no nozzle stands.
            Some((below, _)) => {
                let rest = behind(way, rings.pitch);
                let ramp = [*first, rest.first().copied().unwrap_or(*first)];
                thread.lay(&ramp, Course { heights: (below.top, source.top), ..course });
                thread.lay(&rest, course);
            }
            None => {
                thread.travel(*first, source.top);
                thread.start();
                thread.lay(way, course);
            }
        }
        if !self.goes_on(index) {
            thread.stop();
        }
        thread.finish()
    }

    fn wall(&self, index: usize, notes: &mut Notes) -> Vec<Line> {
        let source = &self.sources[index];
        let (Some(lane), Ok(wall)) = (&self.lanes[index], &source.wall) else { return Vec::new() };
        let height = source.bead.height.um();
        let tolerance = source.bead.width.um() / FINENESS;
        let flat = Turn::flat(lane).thinned(tolerance).way;
        let level = Course {
            heights: (source.top, source.top),
            gaps: (height, height),
            width: wall.pitch,
            bead: source.bead,
        };
        let mut thread = Thread::default();
        let (first, last) = match self.roles[index] {
            Role::Turn { first, last } => (first, last),
            _ => {
                thread.travel(lane.start(), source.top);
                thread.start();
                thread.lay(&flat, level);
                if !self.goes_on(index) {
                    thread.stop();
                }
                return thread.finish();
            }
        };
        let bottom = self.below(index).map_or(source.top - source.bead.height.0, |(below, _)| below.top);
        let climb = (bottom, source.top);
        if first {
            // What comes from a base or a flat turn is there already; over layers the thread begins here.
            match self.below(index) {
                Some((_, Role::Layered | Role::Turn { .. })) | None => {
                    thread.travel(lane.start(), bottom);
                    thread.start();
                }
                _ => {}
            }
            self.grounded(index, &flat, notes);
            thread.lay(&flat, Course { heights: climb, gaps: (0.0, height), ..level });
        } else if let (Some(below), Some((source_below, _))) = (&self.lanes[index - 1], self.below(index)) {
            let turn = Turn::blended(below, lane, source.bead.width.um() / 2.0).thinned(tolerance);
            if turn.reach.0 > source.bead.width.um() / 2.0 {
                notes.spot(index, point(turn.reach.1), OVERHANG);
                // The next turn begins on this outline, while what is below it there began on the one below.
                if !last {
                    notes.spot(index + 1, point(turn.reach.1), OVERHANG);
                }
            }
            let gaps = (source_below.bead.height.um(), height);
            thread.lay(&turn.way, Course { heights: climb, gaps, ..level });
        }
        if last {
            thread.lay(&flat, Course { gaps: (height, 0.0), ..level });
            thread.stop();
            for _ in 0..self.coil.rim_turns {
                flat.iter().skip(1).for_each(|at| thread.travel(*at, source.top));
            }
        }
        thread.finish()
    }

    /// Says where the first turn of a wall finds no clay below it.
    fn grounded(&self, index: usize, way: &[Spot], notes: &mut Notes) {
        let Some((below, role)) = self.below(index) else { return };
        let half = self.sources[index].bead.width.um() / 2.0;
        let beads = match (role, &below.wall) {
            (Role::Turn { .. } | Role::Flat, Ok(wall)) => &wall.beads,
            _ => &below.outlines,
        };
        let beads: Vec<Track> = beads.iter().filter_map(Track::new).collect();
        let filled = matches!(role, Role::Base { .. } | Role::Layered);
        let near = |at: &Spot| beads.iter().any(|bead| distance(bead.at(bead.nearest(*at)), *at) <= half);
        let ground = |at: &&Spot| (filled && below.holds(point(**at))) || near(at);
        if let Some(at) = way.iter().find(|at| !ground(at)) {
            notes.spot(index, point(*at), OVERHANG);
        }
    }
}

const OVERHANG: &str = "the turn reaches more than half a bead over the one below: it may sag";

/// A turn keeps no corner nearer to a straight line than half a hundredth of a bead.
const FINENESS: f64 = 200.0;

/// Which layers are solid: those that fill has made so, and the full ones below a wall that is drawn, for who draws the
/// wall draws the floor, too.
fn floors(sources: &[Source]) -> Vec<bool> {
    let mut drawn = false;
    let mut floors: Vec<bool> = sources
        .iter()
        .rev()
        .map(|source| match &source.wall {
            Ok(wall) if wall.full => source.solid || drawn,
            Ok(_) => {
                drawn = true;
                false
            }
            Err(_) => false,
        })
        .collect();
    floors.reverse();
    floors
}

/// The rings of a layer that may be one of the base.
fn rings(coil: &Coil, source: &Source, floor: bool) -> Option<Rings> {
    let wall = source.wall.as_ref().ok().filter(|_| floor)?;
    Rings::inside(wall.beads.first()?, source.bead.spacing().um() * coil.base_spacing.f64())
}

/// What each layer becomes, but for what the one above must be known.
fn roles(
    coil: &Coil,
    sources: &[Source],
    rings: &[Option<Rings>],
    floors: &[bool],
    notes: &mut Notes,
) -> Vec<Role> {
    let mut roles: Vec<Role> = Vec::with_capacity(sources.len());
    for (index, source) in sources.iter().enumerate() {
        let below = roles.last().copied();
        let wall = match &source.wall {
            Ok(wall) => wall,
            Err(why) => {
                notes.layer(index, format!("it stays as fill laid it: {why}"));
                roles.push(Role::Layered);
                continue;
            }
        };
        let same =
            |index: usize| matches!(&sources[index].wall, Ok(other) if other.beads.len() == wall.beads.len());
        let hollow = |index: usize| matches!(&sources[index].wall, Ok(other) if !other.full);
        let on_hollow = floors[index] && index > 0 && hollow(index - 1);
        let on_turn = matches!(below, Some(Role::Turn { .. } | Role::Flat)) && same(index - 1) && !on_hollow;
        let role = match below {
            // Rings would fall into what is open below; the lines of fill reach across.
            _ if on_hollow && source.solid => {
                notes.layer(index, "it stays as fill laid it: it closes what is open below");
                Role::Layered
            }
            _ if floors[index] && !on_turn => match (&rings[index], coil.base) {
                (_, Base::AsFilled) => Role::Layered,
                (None, _) => {
                    notes.layer(index, "the base stays as fill laid it: it has no single middle to go round");
                    Role::Layered
                }
                (Some(_), Base::InAndOut) => {
                    Role::Base { outwards: true, goes_on: matches!(below, Some(Role::Base { .. })) }
                }
            },
            None => Role::Flat,
            _ => Role::Turn { first: !(on_turn && matches!(below, Some(Role::Turn { .. }))), last: true },
        };
        roles.push(role);
    }
    roles
}

/// What the layers above say of a role: which turn is the last, and which way a layer of the base runs.
fn finish(roles: &mut [Role]) {
    let mut above: Option<Role> = None;
    for role in roles.iter_mut().rev() {
        match role {
            Role::Turn { last, .. } => *last = !matches!(above, Some(Role::Turn { first: false, .. })),
            // The uppermost ends at the rim, where the wall begins; those below by turns.
            Role::Base { outwards, .. } => {
                *outwards = !matches!(above, Some(Role::Base { outwards: true, goes_on: true }));
            }
            Role::Layered | Role::Flat => {}
        }
        above = Some(*role);
    }
}

/// A place on each wall where its seam would be if it did not move on, and how many turns there are below it.
fn anchors(sources: &[Source], roles: &[Role]) -> Vec<Option<(Spot, usize)>> {
    let mut anchors: Vec<Option<(Spot, usize)>> = Vec::with_capacity(sources.len());
    for (source, role) in sources.iter().zip(roles) {
        let before = match role {
            Role::Turn { first: false, .. } => anchors.last().copied().flatten(),
            Role::Turn { first: true, .. } | Role::Flat => match anchors.last() {
                Some(Some((at, turns))) => Some((*at, *turns)),
                _ => Some((source.start, 0)),
            },
            Role::Base { .. } | Role::Layered => None,
        };
        let outermost = source.wall.as_ref().ok().and_then(|wall| wall.beads.first());
        anchors.push(before.zip(outermost).and_then(|((at, turns), ring)| {
            let track = Track::new(ring)?;
            Some((track.at(track.nearest(at)), turns + 1))
        }));
    }
    anchors
}

/// The way of a turn.
fn lane(coil: &Coil, source: &Source, index: usize, (anchor, turns): &(Spot, usize)) -> Option<Lane> {
    let wall = source.wall.as_ref().ok()?;
    let waved = if coil.wave_height.0 > 0 { waved(coil, wall, index, *anchor) } else { None };
    let wall = waved.as_ref().unwrap_or(wall);
    let tracks: Vec<Track> = wall.beads.iter().filter_map(Track::new).collect();
    let outermost = tracks.first()?;
    let step = if tracks.len() > 1 { coil.seam_step.f64() * wall.pitch * (*turns as f64 - 1.0) } else { 0.0 };
    Lane::new(&tracks, outermost.nearest(*anchor) + step, wall.pitch)
}

/// The wall with waves, if its beads still lie one inside the other.
fn waved(coil: &Coil, wall: &Wall, index: usize, anchor: Spot) -> Option<Wall> {
    let track = Track::new(wall.beads.first()?)?;
    let phase = (coil.wave_step.f64() * index as f64).rem_euclid(1.0);
    let waves = Waves { height: coil.wave_height.um(), count: coil.waves, phase };
    let outermost = waves.across(&track, track.nearest(anchor));
    let mut beads = vec![outermost];
    for bead in 1..wall.beads.len() {
        let inner = offset(std::slice::from_ref(&beads[0]), -wall.pitch * bead as f64);
        beads.push(<[skein::Ring; 1]>::try_from(inner).ok().map(|[ring]| ring)?);
    }
    Some(Wall { beads, ..wall.clone() })
}

/// The threads of the base: each ends where the one above begins, and the uppermost where the wall does.
fn bases(
    sources: &[Source],
    roles: &[Role],
    lanes: &[Option<Lane>],
    rings: Vec<Option<Rings>>,
) -> Vec<Option<(Rings, Vec<Spot>)>> {
    let mut above: Option<Spot> = None;
    let mut bases: Vec<Option<(Rings, Vec<Spot>)>> = Vec::with_capacity(sources.len());
    let all = sources.iter().zip(roles).zip(lanes).zip(rings);
    for (((source, role), lane), rings) in all.rev() {
        let base = match (role, rings) {
            (Role::Base { outwards, .. }, Some(rings)) => {
                let way = rings.thread(above.unwrap_or(source.start), *outwards);
                Some((rings, way))
            }
            _ => None,
        };
        above = match (&base, lane) {
            (Some((_, way)), _) => way.first().copied(),
            (None, Some(lane)) => Some(lane.start()),
            _ => None,
        };
        bases.push(base);
    }
    bases.reverse();
    bases
}

/// What is left of a way behind a length from its start.
fn behind(way: &[Spot], at: f64) -> Vec<Spot> {
    let mut left = at;
    for (index, side) in way.windows(2).enumerate() {
        let length = distance(side[0], side[1]);
        if length > left {
            let mut rest = vec![between(side[0], side[1], left / length)];
            rest.extend_from_slice(&way[index + 1..]);
            return rest;
        }
        left -= length;
    }
    way.last().copied().into_iter().collect()
}
