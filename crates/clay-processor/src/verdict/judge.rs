//! Takes moves and commands and hands them to the rules.

use gcode::{Line, Words};

use super::ending::End;
use super::findings::Findings;
use super::firmware::Control;
use super::ground::Ground;
use super::layer_height::LayerHeight;
use super::limits::Limits;
use super::pump::Pump;
use super::repeats::Repeats;
use super::room;
use super::rule::{Rule, Verdict};
use super::{text, tower};
use crate::breaks::Breaks;
use crate::motion::{Class, EPSILON_Z, Motion, Move};
use crate::report::{Interruptions, Model, Pitch};

/// A bead that hangs over so many cells of the map hangs in the air: less is an overhang, or a corner.
const HANGING: f64 = 4.0;

/// Judges a file while it goes by.
#[derive(Clone, Debug)]
pub(crate) struct Judge {
    limits: Limits,
    findings: Findings,
    breaks: Breaks,
    control: Control,
    ground: Ground,
    pump: Pump,
    repeats: Repeats,
    /// Where the nozzle is, from the end stops.
    at: Option<(f64, f64)>,
    layer: LayerHeight,
    /// Clay has been laid.
    printed: bool,
    /// The highest clay, and the last, as far as heights are known.
    highest: Option<f64>,
    last: Option<f64>,
    over: Option<End>,
    /// The first end that clay was laid behind.
    overrun: Option<End>,
    hanging: Hanging,
    spot: Option<Spot>,
    /// `G92` has called the height otherwise amid the print: the heights of layers cannot be compared any more.
    renamed: bool,
}

/// Where clay was laid last. Fine curves lay many strokes into one cell of the map, and only the first of them finds
/// anything new there.
#[derive(Clone, Copy, Debug)]
struct Spot {
    cell: (usize, usize),
    altitude: f64,
    hangs: bool,
}

/// A bead with nothing below it.
#[derive(Clone, Copy, Debug, Default)]
struct Hanging {
    first: usize,
    height: f64,
    length: f64,
}

impl Judge {
    pub(crate) fn new(limits: Limits, e_follows_g90: bool) -> Self {
        let known = limits.layers.map(|layers| layers.rest.max(layers.first));
        Self {
            limits,
            findings: Findings::default(),
            breaks: Breaks::default(),
            control: Control::new(&limits, e_follows_g90),
            ground: Ground::new(limits.bead_width),
            pump: Pump::new(&limits),
            repeats: Repeats::default(),
            at: None,
            layer: LayerHeight::new(known),
            printed: false,
            highest: None,
            last: None,
            over: None,
            overrun: None,
            hanging: Hanging::default(),
            spot: None,
            renamed: false,
        }
    }

    /// A move, behind which the printer is as `motion` says.
    #[inline(always)]
    pub(crate) fn take(&mut self, index: usize, step: &Move, motion: &Motion, words: &Words) {
        if let Some(feed) = words.get(b'F')
            && feed > 0.0
        {
            self.pump.set_feed(feed * motion.scale());
        }
        let place = motion.place();
        match step.class {
            Class::Flat | Class::Slope => self.print(index, step, motion, place),
            Class::Travel | Class::DiagonalTravel | Class::Vertical => {
                self.travel(index, step, motion, place)
            }
            Class::Prime => self.prime(index, step),
            Class::Still => {}
        }
        self.at = place;
    }

    /// A line that moves nothing, behind which the printer is as `motion` says.
    pub(crate) fn command(&mut self, index: usize, line: &Line, motion: &Motion) {
        self.control.command(&mut self.findings, index, line, motion);
        if self.printed {
            self.over = self.over.or(End::of(line));
        }
        // Homing and `G92` move nothing that a way could be drawn to.
        self.at = motion.place();
    }

    /// The height is called otherwise from now on.
    pub(crate) fn rename(&mut self) {
        self.renamed |= self.printed;
    }

    #[inline(always)]
    fn print(&mut self, index: usize, step: &Move, motion: &Motion, place: Option<(f64, f64)>) {
        self.printed = true;
        self.breaks.print(self.ground.cell());
        self.control.push(&mut self.findings, index, step);
        self.pump.print(&mut self.findings, index, step);
        if let Some(end) = self.over {
            self.overrun(index, step, end);
        }
        let Some(altitude) = motion.altitude() else {
            return self.findings.add(Rule::UnknownHeight, index, None, 0.0);
        };
        self.rise(index, step, altitude);
        let Some(to) = place else { return self.look(index, true, None, altitude) };
        let Some(from) = self.at else {
            self.ground.lay(to, altitude, self.layer.same());
            return self.look(index, true, Some(to), altitude);
        };
        match step.arc {
            None => self.stroke(index, step.class, from, to, altitude),
            Some(arc) => {
                let mut start = from;
                for point in arc.points(from, step.by) {
                    self.stroke(index, step.class, start, point, altitude);
                    start = point;
                }
            }
        }
        if step.class == Class::Flat {
            self.repeats.stroke(&mut self.findings, index, altitude, from, to, step.squared());
        }
    }

    /// Clay is laid straight from one place to another.
    #[inline(always)]
    fn stroke(&mut self, index: usize, class: Class, from: (f64, f64), to: (f64, f64), altitude: f64) {
        self.look(index, true, Some(to), altitude);
        let length = (to.0 - from.0, to.1 - from.1);
        if let Some(spot) = self.spot
            && self.ground.is_short(from, to)
            && (altitude - spot.altitude).abs() <= EPSILON_Z
            && self.ground.cell_of(to) == Some(spot.cell)
        {
            if spot.hangs {
                self.hang(index, altitude, length.0.hypot(length.1));
            }
            return;
        }
        let same = self.layer.same();
        let mut before = 0.0;
        for (place, share) in self.ground.along(from, to) {
            if class == Class::Flat
                && let Some(top) = self.ground.top(place).filter(|top| *top > altitude + same)
            {
                self.findings.add(Rule::IntoClay, index, Some(altitude), top - altitude);
            }
            let hangs = self.hangs(place, altitude);
            if hangs {
                self.hang(index, altitude, (share - before) * length.0.hypot(length.1));
            } else {
                self.stop_hanging();
            }
            before = share;
            self.ground.lay(place, altitude, same);
            self.spot = self.ground.cell_of(place).map(|cell| Spot { cell, altitude, hangs });
        }
    }

    /// Whether clay that is laid here falls.
    #[inline]
    fn hangs(&self, place: (f64, f64), altitude: f64) -> bool {
        let Some(deep) = self.layer.air_below(altitude) else { return false };
        let same = self.layer.same();
        let falls = |below: Option<f64>| below.is_none_or(|below| below < deep);
        falls(self.ground.below(place, altitude, same))
            && falls(self.ground.below_near(place, altitude, same))
    }

    #[inline(always)]
    fn look(&mut self, index: usize, prints: bool, place: Option<(f64, f64)>, altitude: f64) {
        room::look(self.limits.bed.as_ref(), &mut self.findings, index, prints, place, Some(altitude));
    }

    /// Keeps the highest clay, and what a layer's height is as far as the file shows it.
    #[inline(always)]
    fn rise(&mut self, index: usize, step: &Move, altitude: f64) {
        self.last = Some(altitude);
        if self.layer.may_rise(step, altitude) {
            self.climb(index, step, altitude);
        }
    }

    #[inline(never)]
    fn climb(&mut self, index: usize, step: &Move, altitude: f64) {
        let rise = self.highest.map_or(0.0, |highest| altitude - highest);
        self.highest = Some(self.highest.map_or(altitude, |highest| highest.max(altitude)));
        if self.layer.is_lifted(rise) {
            self.layer.skip_to(altitude);
            self.findings.add(Rule::LiftedOff, index, step.to, rise);
        } else {
            self.layer.rise(step, altitude);
        }
    }

    /// A spiral has come round and lies so much higher.
    pub(crate) fn turn(&mut self, rise: f64) {
        self.layer.turn(rise);
    }

    #[cold]
    fn overrun(&mut self, index: usize, step: &Move, end: End) {
        self.overrun.get_or_insert(end);
        self.findings.add(Rule::AfterEnd, index, step.to, 0.0);
    }

    fn hang(&mut self, index: usize, height: f64, length: f64) {
        if self.hanging.length == 0.0 {
            self.hanging = Hanging { first: index, height, length: 0.0 };
        }
        self.hanging.length += length;
    }

    #[inline(always)]
    fn stop_hanging(&mut self) {
        if self.hanging.length > 0.0 {
            let Hanging { first, height, length } = std::mem::take(&mut self.hanging);
            if length > HANGING * self.ground.cell() {
                self.findings.add(Rule::InAir, first, Some(height), length);
            }
        }
    }

    fn travel(&mut self, index: usize, step: &Move, motion: &Motion, place: Option<(f64, f64)>) {
        self.stop_hanging();
        if step.clay != 0.0 {
            self.control.push(&mut self.findings, index, step);
        }
        let altitude = motion.altitude();
        let end = (place, altitude);
        let mut air = 0.0;
        if let (Some(from), Some(to), Some(altitude)) = (self.at, place, altitude) {
            let start = altitude - step.rise;
            let mut way = Way { from, start, rise: step.rise, length: step.length(), done: 0.0 };
            match step.arc {
                None => air += self.fly(index, &mut way, to, 1.0),
                Some(arc) => {
                    let points: Vec<(f64, f64)> = arc.points(from, step.by).collect();
                    let share = 1.0 / points.len().max(1) as f64;
                    for point in points {
                        air += self.fly(index, &mut way, point, share);
                        room::look(
                            self.limits.bed.as_ref(),
                            &mut self.findings,
                            index,
                            false,
                            Some(point),
                            None,
                        );
                    }
                }
            }
        }
        room::look(self.limits.bed.as_ref(), &mut self.findings, index, false, end.0, end.1);
        if self.printed {
            self.breaks.travel(index, step.length(), air);
        }
    }

    /// Goes straight to a place without clay. Returns how far it goes over open air.
    fn fly(&mut self, index: usize, way: &mut Way, to: (f64, f64), share_of_way: f64) -> f64 {
        let Some(last) = self.last else { return 0.0 };
        let deep = self.layer.air_below(last);
        let same = self.layer.same();
        let (mut air, mut before) = (0.0, 0.0);
        for (place, share) in self.ground.along(way.from, to) {
            let altitude = way.start + way.rise * (way.done + share * share_of_way);
            if let Some(top) = self.ground.top(place).filter(|top| *top > altitude + same) {
                self.findings.add(Rule::IntoClay, index, Some(altitude), top - altitude);
            }
            if deep.is_some_and(|deep| self.ground.top_near(place).is_none_or(|top| top < deep)) {
                air += (share - before) * share_of_way * way.length;
            }
            before = share;
        }
        way.from = to;
        way.done += share_of_way;
        air
    }

    fn prime(&mut self, index: usize, step: &Move) {
        self.control.push(&mut self.findings, index, step);
        self.pump.push(&mut self.findings, index, step);
    }

    /// The file is at its end. What is wrong, worst first, and the interruptions.
    pub(crate) fn finish(mut self, machine: &Model, pitches: &[Pitch]) -> (Vec<Verdict>, Interruptions) {
        self.stop_hanging();
        self.repeats.end(&mut self.findings);
        if !self.printed {
            self.findings.add(Rule::NothingPrinted, 0, None, 0.0);
        }
        let found = self.breaks.found;
        if found.count > 0 {
            let at = found.longest_index.unwrap_or(0);
            self.findings.add(Rule::Interrupted, at, None, found.longest);
        }
        for crossing in &found.open_air {
            self.findings.add(Rule::OpenAir, crossing.index, None, crossing.length);
        }
        let usual = if self.renamed {
            None
        } else {
            tower::judge(machine, pitches, &self.limits, &mut self.findings)
        };
        let facts = text::Facts { limits: &self.limits, overrun: self.overrun, breaks: &found, usual };
        (text::verdicts(&self.findings, &facts, machine), found)
    }
}

/// A travel that is followed piece by piece.
struct Way {
    from: (f64, f64),
    start: f64,
    rise: f64,
    length: f64,
    /// The share of it that lies behind.
    done: f64,
}
