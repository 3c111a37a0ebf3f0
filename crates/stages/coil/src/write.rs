//! The lines of the layers that are wound.

use crate::lane::Lane;
use crate::lay::{Step, Thread};
use crate::plan::{Plan, Role};
use crate::source::{Source, Wall};
use crate::thin::thinned;
use crate::track::{Spot, between, distance, point};
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
        let Some(first) = steps.first() else { return Vec::new() };
        match self.below(index).filter(|_| goes_on) {
            Some((below, _)) => {
                let (bead, bottom) = (source.bead.spacing().um(), f64::from(below.top));
                let end =
                    self.bases[index - 1].as_ref().and_then(|way| way.last()).map_or(first.at, |it| it.0);
                if distance(end, first.at) > bead / 2.0 {
                    // Where the layers do not quite lie above each other it climbs on its way there.
                    let from = Step { at: end, height: bottom, ..*first };
                    steps.insert(0, from);
                } else {
                    steps = ramp(&steps, bead, bottom);
                }
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
        let steps = self.steps(index, lane, turn, wall);
        // What comes from a base or a turn is there already; over layers the thread begins here.
        if !index.checked_sub(1).is_some_and(|below| self.goes_on(below)) {
            let height = steps.first().map_or(f64::from(source.top), |step| step.height);
            thread.travel(lane.start(), height as i32);
            thread.start();
        }
        self.supported(index, lane, turn, notes);
        thread.lay(&thinned(&steps, tolerance), &source.bead);
        if self.goes_on(index) {
            return thread.finish();
        }
        if matches!(self.roles[index], Role::Turn { .. }) {
            let rim = thinned(&rim(lane, turn, source, wall.pitch), tolerance);
            thread.lay(&rim, &source.bead);
            thread.stop();
            for _ in 0..self.coil.rim_turns {
                rim.iter().skip(1).for_each(|step| thread.travel(step.at, source.top));
            }
        } else {
            thread.stop();
        }
        thread.finish()
    }

    /// The way of a turn with its heights, and with the gap that it finds below.
    fn steps(&self, index: usize, lane: &Lane, turn: &Turn, wall: &Wall) -> Vec<Step> {
        let source = &self.sources[index];
        let height = source.bead.height.um();
        let (Role::Turn { first, .. }, Some((below, _))) = (self.roles[index], self.below(index)) else {
            return Step::level(&lane.whole(), f64::from(source.top), height, wall.pitch);
        };
        // What is below a turn has not risen to where that one begins, but where it ends.
        let mut share_below = if first { None } else { self.turns[index - 1].as_ref().map(Turn::shares) };
        let start = f64::from(below.top);
        let rise = f64::from(source.top) - start;
        let step = |corner: &Corner| {
            let risen = share_below.as_mut().map_or(1.0, |share| share(corner.low));
            let up = rise * corner.share;
            let gap = up + below.bead.height.um() * (1.0 - risen);
            Step { at: corner.at, height: start + up, gap, width: wall.pitch }
        };
        turn.corners.iter().map(step).collect()
    }

    /// Says where a turn finds no clay below it.
    fn supported(&self, index: usize, lane: &Lane, turn: &Turn, notes: &mut Notes) {
        let (Role::Turn { first, last }, Some((below, role))) = (self.roles[index], self.below(index)) else {
            return;
        };
        if !first {
            if turn.reach.0 > self.sources[index].bead.width.um() / 2.0 {
                notes.spot(index, point(turn.reach.1), OVERHANG);
                // The next turn begins on this outline, while what is below it there began on the one below.
                if !last {
                    notes.spot(index + 1, point(turn.reach.1), OVERHANG);
                }
            }
            return;
        }
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

const OVERHANG: &str = "the turn reaches more than half a bead over the one below: it may sag";

/// A turn keeps no corner nearer to a straight line than half a hundredth of a bead.
const FINENESS: f64 = 200.0;

/// The steps of a layer of the base that comes from the one below: it climbs over one bead, with all of its clay, so that
/// none is missing and the nozzle never stands.
fn ramp(steps: &[Step], length: f64, bottom: f64) -> Vec<Step> {
    let Some(first) = steps.first() else { return Vec::new() };
    let mut left = length;
    let mut ramp = vec![Step { height: bottom, ..*first }];
    for (index, side) in steps.windows(2).enumerate() {
        let far = distance(side[0].at, side[1].at);
        if far > left {
            ramp.push(Step { at: between(side[0].at, side[1].at, left / far), ..side[1] });
            ramp.extend(&steps[index + 1..]);
            return ramp;
        }
        left -= far;
    }
    ramp.extend(steps.last());
    ramp
}

/// The steps of the level turn behind the last: it fills what that one has left open below its end.
fn rim(lane: &Lane, turn: &Turn, source: &Source, width: f64) -> Vec<Step> {
    let mut share = turn.shares();
    let (height, gap) = (f64::from(source.top), source.bead.height.um());
    let step = |(place, at): (usize, &Spot)| {
        let gap = gap * (1.0 - share(place as f64));
        Step { at: *at, height, gap, width }
    };
    lane.whole().iter().enumerate().map(step).collect()
}
