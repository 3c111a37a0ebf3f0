//! The lines of the layers that are wound.

use crate::lane::Lane;
use crate::lay::{Step, Thread};
use crate::plan::{Plan, Role};
use crate::source::{Source, Wall};
use crate::thin::thinned;
use crate::track::{Spot, between, distance, point, square};
use crate::turn::{Corner, Turn};
use shape::plane::{offset, outside};
use skein::{Feature, Line, Notes, Ring, Side};

impl Plan<'_> {
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

    fn base(&self, index: usize, goes_on: bool) -> Vec<Line> {
        let Some(way) = &self.bases[index] else { return Vec::new() };
        let source = &self.sources[index];
        let flow = self.coil.base_flow.f64();
        let level = |(at, width): &(Spot, f64)| Step {
            at: *at,
            height: f64::from(source.top),
            gap: source.bead.height.um(),
            width: width * flow,
        };
        let mut steps: Vec<Step> = way.iter().map(level).collect();
        let mut thread = Thread::default();
        let Some(first) = steps.first().copied() else { return Vec::new() };
        let between_tops = |other: &Source| f64::midpoint(f64::from(other.top), first.height);
        let (mut from, mut to) = (first.height, first.height);
        match self.below(index).filter(|_| goes_on) {
            Some((below, _)) => {
                from = between_tops(below);
                // Where the layers do not quite lie above each other it comes from where the one below has ended.
                let end =
                    self.bases[index - 1].as_ref().and_then(|way| way.last()).map_or(first.at, |it| it.0);
                if distance(end, first.at) > 1.0 {
                    steps.insert(0, Step { at: end, ..first });
                }
            }
            None => {
                thread.travel(first.at, source.top);
                thread.start();
            }
        }
        if let (Some(Role::Base { goes_on: true, .. }), Some(above)) =
            (self.roles.get(index + 1), self.sources.get(index + 1))
        {
            to = between_tops(above);
        }
        let steps = climbing(&steps, CLIMB / 2.0 * source.bead.spacing().um(), from, to);
        thread.lay(&steps, &source.bead);
        if !self.goes_on(index) {
            thread.stop();
        }
        thread.finish()
    }

    fn wall(&self, index: usize, notes: &mut Notes) -> Vec<Line> {
        let source = &self.sources[index];
        let (Some(lane), Some(turn), Ok(wall)) = (&self.lanes[index], &self.turns[index], &source.wall)
        else {
            return Vec::new();
        };
        let tolerance = source.bead.width.um() / FINENESS;
        let mut thread = Thread::default();
        let mut hanging = Hanging::new(source.bead.width.um());
        let steps = self.steps(index, lane, turn, wall, &mut hanging);
        // What comes from a base or a turn is there already; over layers the thread begins here.
        if !index.checked_sub(1).is_some_and(|below| self.goes_on(below)) {
            let height = steps.first().map_or(f64::from(source.top), |step| step.height);
            thread.travel(lane.start(), height as i32);
            thread.start();
        }
        self.supported(index, lane, notes);
        thread.lay(&sparse(&steps, tolerance, COARSER), &source.bead);
        if !self.goes_on(index) && matches!(self.roles[index], Role::Turn { .. }) {
            let rim = thinned(&rim(lane, turn, source, wall.pitch, &mut hanging), tolerance);
            thread.lay(&rim, &source.bead);
            thread.stop();
            for _ in 0..self.coil.rim_turns {
                rim.iter().skip(1).for_each(|step| thread.travel(step.at, source.top));
            }
        } else if !self.goes_on(index) {
            thread.stop();
        }
        if let Some(at) = hanging.most() {
            notes.spot(index, point(at), OVERHANG);
        }
        thread.finish()
    }

    /// The way of a turn with its heights, and with the gap that it finds below.
    fn steps(&self, index: usize, lane: &Lane, turn: &Turn, wall: &Wall, hanging: &mut Hanging) -> Vec<Step> {
        let source = &self.sources[index];
        let height = source.bead.height.um();
        let (Role::Turn { first, .. }, Some((below, _))) = (self.roles[index], self.below(index)) else {
            return Step::level(&lane.whole(), f64::from(source.top), height, wall.pitch);
        };
        // What is below a turn has not risen to where that one begins, but where it ends.
        let turn_below = if first { None } else { self.turns[index - 1].as_ref() };
        if let Some(below) = turn_below {
            let mut above = turn.above();
            below.corners.iter().for_each(|corner| hanging.see(above(corner.high).1, corner.at));
        }
        let mut turn_below = turn_below.map(Turn::over);
        let start = f64::from(below.top);
        let rise = f64::from(source.top) - start;
        let step = |corner: &Corner| {
            let (risen, on) = turn_below.as_mut().map_or((1.0, corner.at), |over| over(corner.low));
            hanging.see(corner.at, on);
            let up = rise * corner.share;
            let gap = up + below.bead.height.um() * (1.0 - risen);
            Step { at: corner.at, height: start + up, gap, width: wall.pitch }
        };
        turn.corners.iter().map(step).collect()
    }

    /// Says when a turn that begins on a flat layer finds no clay below it.
    fn supported(&self, index: usize, lane: &Lane, notes: &mut Notes) {
        let (Role::Turn { first: true, .. }, Some((below, role))) = (self.roles[index], self.below(index))
        else {
            return;
        };
        let mut clay = below.outlines.clone();
        if let (Role::Turn { .. } | Role::Flat, Ok(Wall { beads, pitch, full: true })) = (role, &below.wall) {
            let inside = beads.last().map(|bead| offset(std::slice::from_ref(bead), -pitch / 2.0));
            clay.extend(inside.unwrap_or_default().into_iter().map(Ring::reversed));
        }
        let way = Ring(lane.whole().into_iter().map(point).collect());
        if !outside(&[way], &clay).is_empty() {
            notes.layer(index, OVERHANG);
        }
    }
}

/// How far a thread lies from what is below it, seen from above.
struct Hanging {
    /// The furthest that is no overhang, squared.
    least: f64,
    /// The furthest so far, squared, and where.
    most: (f64, Spot),
}

impl Hanging {
    /// For a bead of a width: half of it, less what thinning may move this turn and the one below.
    fn new(width: f64) -> Self {
        let far = width * (0.5 - 2.0 / FINENESS);
        Self { least: far * far, most: (0.0, Spot::default()) }
    }

    fn see(&mut self, at: Spot, on: Spot) {
        let far = square(at, on);
        if far > self.most.0 {
            self.most = (far, at);
        }
    }

    /// The place that lies furthest over, where that is an overhang.
    fn most(&self) -> Option<Spot> {
        (self.most.0 > self.least).then_some(self.most.1)
    }
}

const OVERHANG: &str = "the turn reaches more than half a bead over the one below: it may sag";

/// A turn keeps no corner nearer to a straight line than half a hundredth of a bead.
const FINENESS: f64 = 200.0;

/// Where corners crowd, that may be twice as much so many times: a twenty-fifth of a bead at most.
const COARSER: usize = 3;

/// The steps of a turn without those that it need not have: where it rises by less than two microns from each to the next,
/// with fewer that lie nearer to a straight line, for each must be higher than the one before it.
fn sparse(steps: &[Step], tolerance: f64, coarser: usize) -> Vec<Step> {
    let way = thinned(steps, tolerance);
    let rise = way.last().zip(way.first()).map_or(0.0, |(last, first)| last.height - first.height);
    let crowded = rise > 0.0 && way.len() as f64 > rise / 2.0;
    if crowded && coarser > 0 { sparse(steps, 2.0 * tolerance, coarser - 1) } else { way }
}

/// From one layer of the base to the next it climbs over so many beads, half of them at the end of the lower layer and half
/// at the start of the upper one, so that what the lower has too much the upper has too little.
const CLIMB: f64 = 3.0;

/// A level way that comes from one height and goes to another, each over a length or over half of what there is; the gap
/// below it differs by as much.
fn climbing(steps: &[Step], length: f64, from: f64, to: f64) -> Vec<Step> {
    let Some(first) = steps.first() else { return Vec::new() };
    let sides = || steps.windows(2).map(|side| (side[0], side[1], distance(side[0].at, side[1].at)));
    let whole: f64 = sides().map(|(.., far)| far).sum();
    let length = length.min(whole / 2.0).max(1.0);
    let off = |step: Step, at: f64| {
        let part = |end: f64, far: f64| (end - first.height) * (1.0 - far / length).max(0.0);
        let by = part(from, at) + part(to, whole - at);
        Step { height: step.height + by, gap: step.gap + by, ..step }
    };
    let mut climbing = vec![off(*first, 0.0)];
    let mut at = 0.0;
    for (from, to, far) in sides() {
        for corner in [length, whole - length].into_iter().filter(|corner| at < *corner && *corner < at + far)
        {
            let step = Step { at: between(from.at, to.at, (corner - at) / far), ..to };
            climbing.push(off(step, corner));
        }
        at += far;
        climbing.push(off(to, at));
    }
    climbing
}

/// The steps of the level turn behind the last: it fills what that one has left open below its end.
fn rim(lane: &Lane, turn: &Turn, source: &Source, width: f64, hanging: &mut Hanging) -> Vec<Step> {
    let way = lane.whole();
    for corner in &turn.corners {
        let (place, part) = (corner.high as usize, corner.high.fract());
        if let (Some(from), to) = (way.get(place), way.get(place + 1)) {
            hanging.see(between(*from, *to.unwrap_or(from), part), corner.at);
        }
    }
    let mut over = turn.over();
    let (height, gap) = (f64::from(source.top), source.bead.height.um());
    let step = |(place, at): (usize, &Spot)| {
        let (risen, on) = over(place as f64);
        hanging.see(*at, on);
        let gap = gap * (1.0 - risen);
        Step { at: *at, height, gap, width }
    };
    way.iter().enumerate().map(step).collect()
}
