//! What becomes of each layer, and where each turn begins.

use crate::base::Floor;
use crate::lane::Lane;
use crate::seam::{Seam, seams};
use crate::source::{Source, Wall};
use crate::texture::Waves;
use crate::track::{Spot, Track};
use crate::turn::Turn;
use crate::{Base, Coil};
use rayon::prelude::*;
use shape::plane::offset;
use skein::Notes;

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
    /// The settings.
    pub coil: &'a Coil,
    /// The layers as fill left them.
    pub sources: &'a [Source],
    /// The role of each layer.
    pub roles: Vec<Role>,
    /// The closed way of each wall.
    pub lanes: Vec<Option<Lane>>,
    /// The way of each turn, from the lane below to its own.
    pub turns: Vec<Option<Turn>>,
    /// The way of each layer of the base, and how wide the room is for the bead that ends at each corner.
    pub bases: Vec<Option<Vec<(Spot, f64)>>>,
}

impl<'a> Plan<'a> {
    /// Decides what each layer becomes, and says why one stays as it is.
    pub fn new(coil: &'a Coil, sources: &'a [Source], notes: &mut Notes) -> Self {
        let floors = floors(sources);
        let made: Vec<Option<Floor>> =
            sources.par_iter().zip(&floors).map(|(source, floor)| made(coil, source, *floor)).collect();
        let mut roles = roles(coil, sources, &made, &floors, notes);
        let seams = seams(coil, sources, &roles, &made);
        let lanes: Vec<Option<Lane>> = sources
            .par_iter()
            .zip(&seams)
            .enumerate()
            .map(|(index, (source, seam))| lane(coil, source, index, seam.as_ref()?))
            .collect();
        finish(&mut roles);
        let turns = (0..sources.len()).into_par_iter().map(|index| turn(&roles, &lanes, index)).collect();
        let bases = bases(sources, &roles, &lanes, made);
        Self { coil, sources, roles, lanes, turns, bases }
    }

    /// The layer below one, and what becomes of it.
    pub fn below(&self, index: usize) -> Option<(&Source, Role)> {
        let below = index.checked_sub(1)?;
        Some((&self.sources[below], self.roles[below]))
    }

    /// Whether the thread of a layer goes on in the next.
    pub fn goes_on(&self, index: usize) -> bool {
        match (self.roles[index], self.roles.get(index + 1)) {
            (Role::Base { .. }, Some(Role::Base { goes_on, .. })) => *goes_on,
            (Role::Base { .. } | Role::Flat, Some(Role::Turn { .. })) => true,
            (Role::Turn { last, .. }, _) => !last,
            _ => false,
        }
    }
}

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

/// What a layer may be made of that may be one of the base.
fn made(coil: &Coil, source: &Source, floor: bool) -> Option<Floor> {
    let wall = source.wall.as_ref().ok().filter(|_| floor && coil.base != Base::AsFilled)?;
    let spacing = source.bead.spacing().um();
    Floor::inside(wall.beads.first()?, spacing, spacing * coil.base_spacing.f64(), coil.base)
}

/// What each layer becomes, but for what the one above must be known.
fn roles(
    coil: &Coil,
    sources: &[Source],
    made: &[Option<Floor>],
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
            _ if floors[index] && !on_turn => match (&made[index], coil.base) {
                (_, Base::AsFilled) => Role::Layered,
                (None, _) => {
                    notes.layer(index, "the base stays as fill laid it: it has no single middle to go round");
                    Role::Layered
                }
                (Some(floor), base) => {
                    if base == Base::ZigZag && floor.has_rings() {
                        notes.layer(index, "lines would fall apart on it: the base goes round and round");
                    }
                    let alike = |below: &Floor| below.has_rings() == floor.has_rings();
                    let on_base = matches!(below, Some(Role::Base { .. }));
                    let goes_on = on_base && made[index - 1].as_ref().is_some_and(alike);
                    Role::Base { outwards: true, goes_on }
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

/// The closed way of a wall.
fn lane(coil: &Coil, source: &Source, index: usize, seam: &Seam) -> Option<Lane> {
    let wall = source.wall.as_ref().ok()?;
    let waved = if coil.wave_height.0 > 0 { waved(coil, wall, index, seam.anchor) } else { None };
    let wall = waved.as_ref().unwrap_or(wall);
    let tracks: Vec<Track> = wall.beads.iter().filter_map(Track::new).collect();
    Lane::new(&tracks, seam.on(tracks.first()?), wall.pitch)
}

/// The way of a turn: from the lane below, or on its own where it comes from a base or begins anew.
fn turn(roles: &[Role], lanes: &[Option<Lane>], index: usize) -> Option<Turn> {
    let lane = lanes[index].as_ref()?;
    let below = index.checked_sub(1);
    match (roles[index], below.map(|below| roles[below])) {
        (Role::Turn { first: false, .. }, _) | (Role::Turn { .. }, Some(Role::Flat)) => {
            Some(Turn::blended(lanes.get(below?)?.as_ref()?, lane))
        }
        _ => Some(Turn::flat(lane)),
    }
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
    made: Vec<Option<Floor>>,
) -> Vec<Option<Vec<(Spot, f64)>>> {
    let mut above: Option<Spot> = None;
    let mut bases: Vec<Option<Vec<(Spot, f64)>>> = Vec::with_capacity(sources.len());
    let all = sources.iter().zip(roles).zip(lanes).zip(made);
    for (((source, role), lane), floor) in all.rev() {
        let base = match (role, floor) {
            (Role::Base { outwards, .. }, Some(floor)) => {
                Some(floor.thread(above.unwrap_or(source.start), *outwards))
            }
            _ => None,
        };
        above = match (&base, lane) {
            (Some(way), _) => way.first().map(|it| it.0),
            (None, Some(lane)) => Some(lane.start()),
            _ => None,
        };
        bases.push(base);
    }
    bases.reverse();
    bases
}
