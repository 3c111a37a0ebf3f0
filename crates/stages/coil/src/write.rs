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
        match self.below(index).filter(|_| goes_on) {
            Some((below, _)) => {
                let end =
                    self.bases[index - 1].as_ref().and_then(|way| way.last()).map_or(first.at, |it| it.0);
                steps.insert(0, Step { at: end, ..first });
                steps = ramp(&steps, source.bead.spacing().um(), f64::from(below.top));
            }
            None => {
                thread.travel(first.at, source.top);
                thread.start();
            }
        }
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
            hanging.see_all(turn, below);
        }
        let mut turn_below = turn_below.map(Turn::over);
        let start = f64::from(below.top);
        let rise = f64::from(source.top) - start;
        let step = |corner: &Corner| {
            let risen = turn_below.as_mut().map_or(1.0, |over| over(corner.low).0);
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

    /// A turn over another: at the corners of both, for between them both are straight. A place of a turn lies no further from
    /// the lane between the two than that turn reaches, so most need not be looked at.
    fn see_all(&mut self, turn: &Turn, below: &Turn) {
        let reach = turn.reach + below.reach;
        if reach * reach > self.least {
            let (mut above, mut over) = (turn.above(), below.over());
            below.corners.iter().for_each(|corner| self.see(above(corner.high).1, corner.at));
            turn.corners.iter().for_each(|corner| self.see(corner.at, over(corner.low).1));
        }
    }

    /// The rim over the last turn.
    fn see_rim(&mut self, way: &[Spot], turn: &Turn) {
        if turn.reach * turn.reach > self.least {
            for corner in &turn.corners {
                let (place, part) = (corner.high as usize, corner.high.fract());
                if let (Some(from), to) = (way.get(place), way.get(place + 1)) {
                    self.see(between(*from, *to.unwrap_or(from), part), corner.at);
                }
            }
            let mut over = turn.over();
            way.iter().enumerate().for_each(|(place, at)| self.see(*at, over(place as f64).1));
        }
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

/// The steps of a layer of the base that comes from the one below: it climbs on one straight line about a bead long, for who
/// reads the letters only takes two for a spiral, and with all the clay of the way that the line stands for: up to the top
/// of the layer there is room for it, and the nozzle never stands.
///
/// The line is as long as the way along which it leads, but where that turns back it goes on until it is away from its
/// beginning, or as far away as it comes.
fn ramp(steps: &[Step], bead: f64, bottom: f64) -> Vec<Step> {
    let Some(first) = steps.first() else { return Vec::new() };
    let mut best: (f64, Option<(usize, Step)>) = (0.0, None);
    let (mut way, mut clay) = (0.0, 0.0);
    for (index, side) in steps.windows(2).enumerate() {
        let far = distance(side[0].at, side[1].at);
        let parts = (far / bead * LOOKS).ceil().max(1.0);
        for part in 1..=parts as usize {
            way += far / parts;
            clay += far / parts * side[1].width;
            let at = between(side[0].at, side[1].at, part as f64 / parts);
            let away = distance(first.at, at);
            if away > best.0 {
                best = (away, Some((index, Step { at, width: clay / away, ..side[1] })));
            }
            let enough = way >= bead * (1.0 - 0.5 / LOOKS) && away >= LEAST_AWAY * bead;
            if enough || way >= LONGEST_RAMP * bead {
                return risen(steps, bottom, best.1);
            }
        }
    }
    risen(steps, bottom, best.1)
}

/// The steps with those before a place replaced by one line to there, from another height.
fn risen(steps: &[Step], bottom: f64, line: Option<(usize, Step)>) -> Vec<Step> {
    let (Some(first), Some((index, to))) = (steps.first(), line) else { return steps.to_vec() };
    let mut risen = vec![Step { height: bottom, ..*first }, to];
    risen.extend(&steps[index + 1..]);
    risen
}

/// The end of the line is looked for at so many places on a bead's length of the way.
const LOOKS: f64 = 16.0;

/// It lies so many beads away from its beginning, ...
const LEAST_AWAY: f64 = 0.75;

/// ... or is the furthest place on so many beads of the way.
const LONGEST_RAMP: f64 = 3.0;

/// The steps of the level turn behind the last: it fills what that one has left open below its end.
fn rim(lane: &Lane, turn: &Turn, source: &Source, width: f64, hanging: &mut Hanging) -> Vec<Step> {
    let way = lane.whole();
    hanging.see_rim(&way, turn);
    let mut over = turn.over();
    let (height, gap) = (f64::from(source.top), source.bead.height.um());
    let step = |(place, at): (usize, &Spot)| {
        let gap = gap * (1.0 - over(place as f64).0);
        Step { at: *at, height, gap, width }
    };
    way.iter().enumerate().map(step).collect()
}
