#![doc = include_str!("../README.md")]

mod ramp;
#[cfg(test)]
mod tests;

use ramp::Ramp;
use skein::{
    Choice, End, Error, Facts, Feed, Layer, Line, Micron, Move, Notes, Nozzle, OrLag, Pen, Settings, Skein,
    Span, Stage, Thread, along, spans,
};

/// Stops the clay before the end of a bead and starts it before the beginning.
#[derive(Clone, Debug, Settings)]
pub struct Oozebane {
    /// How long before its end a bead's clay is stopped. What is pent up lays the rest. With "lag" it is the way that the
    /// nozzle makes, as fast as it is there, while the clay lags behind.
    #[setting(default = OrLag::Lag, min = 0.0, max = 1000.0, unit = "mm")]
    pub early_shutdown_distance: OrLag<Micron>,
    /// How long before its beginning a bead's clay is started after a long travel; after a short one it is less.
    #[setting(default = OrLag::Lag, min = 0.0, max = 1000.0, unit = "mm")]
    pub early_startup_maximum_distance: OrLag<Micron>,
    /// After a travel of this length the clay is started 63 % of the largest distance before. With "lag" it is the way
    /// that the nozzle travels while the clay lags behind: so fast the pressure falls.
    #[setting(default = OrLag::Lag, min = 0.001, max = 100000.0, unit = "mm")]
    pub early_startup_distance_constant: OrLag<Micron>,
    /// How long before its beginning the clay of the very first bead is started.
    #[setting(default = OrLag::Lag, min = 0.0, max = 1000.0, unit = "mm")]
    pub first_early_startup_distance: OrLag<Micron>,
    /// Over what way behind its beginning a bead comes up to its speed.
    #[setting(default = 3.0, min = 0.0, max = 1000.0, unit = "mm")]
    pub after_startup_distance: Micron,
    /// After travels shorter than this the start is slowed less; 0 is never.
    #[setting(default = 0.0, min = 0.0, max = 1000.0, unit = "mm")]
    pub minimum_distance_for_early_startup: Micron,
    /// Before travels shorter than this the clay is stopped less early; 0 is never.
    #[setting(default = 0.0, min = 0.0, max = 1000.0, unit = "mm")]
    pub minimum_distance_for_early_shutdown: Micron,
    /// In how many steps the speed changes.
    #[setting(default = 3, min = 1, max = 100)]
    pub slowdown_startup_steps: u32,
    /// What else happens at both ends.
    #[setting(default = Ends::Even)]
    pub ends: Ends,
}

/// What happens at the ends of a bead beside the early start and stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Ends {
    /// Nothing: the nozzle moves evenly, as clay likes it.
    Even,
    /// The nozzle is slower behind the start and before the end, in steps.
    Slow,
}

impl Stage for Oozebane {
    const NAME: &'static str = "oozebane";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let mut facts = skein.facts()?;
        let valve = self.valve(&facts)?;
        facts.made_up(End::Start, valve.early);
        facts.made_up(End::Stop, valve.off);
        skein.state(&facts)?;
        let nozzles = skein.nozzles();
        let first = skein.layers.iter().position(|layer| layer.lines.contains(&Line::On));
        let ways: Vec<Ways> = skein
            .layers
            .iter()
            .zip(&nozzles)
            .map(|(layer, nozzle)| Ways::of(&layer.lines, *nozzle))
            .collect();
        // The travel behind the last bead of a layer goes on to the first bead of the next one that has any.
        let mut behind = vec![f64::INFINITY; ways.len()];
        let mut next = f64::INFINITY;
        for (index, way) in ways.iter().enumerate().rev() {
            behind[index] = next;
            next = if way.beads { way.before } else { next + way.before };
        }
        let mut ahead = vec![0.0; ways.len()];
        let mut so_far = 0.0;
        for (index, way) in ways.iter().enumerate() {
            ahead[index] = so_far;
            so_far = if way.beads { way.behind } else { so_far + way.before };
        }
        skein.rewrite(notes, |index, layer, _| {
            let ends = Travels { ahead: ahead[index], behind: behind[index], first: first == Some(index) };
            Ok(valve.layer(layer, &nozzles[index], ends))
        })
    }
}

impl Oozebane {
    fn valve(&self, facts: &Facts) -> Result<Valve<'_>, Error> {
        let laying = || facts.operating_feed();
        Ok(Valve {
            oozebane: self,
            operating: facts.operating_feed,
            off: self.early_shutdown_distance.way(facts, End::Stop, laying())?,
            early: self.early_startup_maximum_distance.way(facts, End::Start, laying())?,
            first_early: self.first_early_startup_distance.way(facts, End::Start, laying())?,
            decay: self.early_startup_distance_constant.way(facts, End::Start, facts.travel_feed())?,
        })
    }
}

/// How far a layer travels before its first bead and behind its last, in microns. Without a bead all is before.
struct Ways {
    before: f64,
    behind: f64,
    beads: bool,
}

impl Ways {
    fn of(lines: &[Line], mut nozzle: Nozzle) -> Self {
        let mut ways = Self { before: 0.0, behind: 0.0, beads: nozzle.on };
        for line in lines {
            let (from, on) = (nozzle.at, nozzle.on);
            nozzle.follow(line);
            ways.beads |= nozzle.on;
            if nozzle.on {
                ways.behind = 0.0;
            } else if let (Some(from), false) = (from, on) {
                *(if ways.beads { &mut ways.behind } else { &mut ways.before }) += line.length(from);
            }
        }
        ways
    }
}

/// What lies around a bead, or around the beads of a layer.
struct Travels {
    /// The travel that leads to the bead; of a layer, the part of it that the layers below have. In microns.
    ahead: f64,
    /// The travel that follows it; of a layer, the part that the layers above have.
    behind: f64,
    /// Whether it is the first of all.
    first: bool,
}

/// The stage at work, in microns.
struct Valve<'a> {
    oozebane: &'a Oozebane,
    operating: Option<Feed>,
    /// How long before the end of a bead the clay stops.
    off: f64,
    /// How long before its beginning it starts after a long travel.
    early: f64,
    /// The same for the first of all beads.
    first_early: f64,
    /// The travel after which it starts 63 % of that before.
    decay: f64,
}

impl Valve<'_> {
    fn layer(&self, layer: Layer, entering: &Nozzle, around: Travels) -> Vec<Line> {
        let spans: Vec<Span<'_>> = spans(&layer.lines, entering.on).collect();
        let after = self.after(&spans, entering, around.behind);
        let mut was = *entering;
        let mut pen = Pen::new(entering, layer.lines.len() * 3 / 2);
        let mut travelled = around.ahead;
        let mut first = around.first;
        for (span, behind) in spans.iter().zip(after) {
            let thread = match span {
                Span::Thread(lines) => Thread::read(lines, &was),
                _ => None,
            };
            let before = was;
            match thread {
                Some(thread) => {
                    span.lines().iter().for_each(|line| was.follow(line));
                    let travels = Travels { ahead: travelled, behind, first };
                    self.thread(&mut pen, &thread, &travels, [&before, &was]);
                }
                None => pen.pass_all(span.lines(), &mut was),
            }
            match span {
                Span::Thread(_) => (travelled, first) = (0.0, false),
                _ => travelled += before.way(span.lines()),
            }
        }
        pen.finish(&was)
    }

    /// For each span, how far it is from its end to the next bead, in microns.
    fn after(&self, spans: &[Span<'_>], entering: &Nozzle, behind: f64) -> Vec<f64> {
        let mut nozzle = *entering;
        let lengths: Vec<f64> = spans
            .iter()
            .map(|span| {
                let length = if matches!(span, Span::Thread(_)) { 0.0 } else { nozzle.way(span.lines()) };
                span.lines().iter().for_each(|line| nozzle.follow(line));
                length
            })
            .collect();
        let mut next = behind;
        let mut after = vec![0.0; spans.len()];
        for (index, span) in spans.iter().enumerate().rev() {
            after[index] = next;
            next = if matches!(span, Span::Thread(_)) { 0.0 } else { next + lengths[index] };
        }
        after
    }

    /// Lays a thread between two travels. Where clay flows already in front of it or goes on behind it, that end stays.
    fn thread(&self, pen: &mut Pen, thread: &Thread, travels: &Travels, [before, behind]: [&Nozzle; 2]) {
        let oozebane = self.oozebane;
        let feed = thread.stretches.first().and_then(|piece| piece.step.feed);
        let speed = |feed: Option<Feed>| feed.map_or(1.0, Feed::mm_per_s);
        // A faster bead needs its clay sooner.
        let ratio = self.operating.map_or(1.0, |usual| speed(feed.or(Some(usual))) / usual.mm_per_s());
        let share = |way: f64, least: Micron| if least.0 > 0 { (way / least.um()).min(1.0) } else { 1.0 };
        let (start, stop) = (
            share(travels.ahead, oozebane.minimum_distance_for_early_startup),
            share(travels.behind, oozebane.minimum_distance_for_early_shutdown),
        );
        let length = thread.length();
        // What follows is a time; a distance that is set stays one.
        let lag = if oozebane.early_shutdown_distance == OrLag::Lag { ratio } else { 1.0 };
        let off = if behind.on { 0.0 } else { self.off * stop * lag };
        let up = oozebane.after_startup_distance.um() * start * ratio;
        if !before.on {
            self.start_early(pen, thread, travels, ratio);
        }
        let steps = f64::from(oozebane.slowdown_startup_steps);
        let slow = oozebane.ends == Ends::Slow;
        let rising = if slow && !before.on && length > 1.03 * (off + up) {
            Ramp::up((start * steps) as u32, up)
        } else {
            Ramp::none()
        };
        let (laid, left) = if off > 0.0 && length > off {
            thread.clone().split(length - off)
        } else {
            (thread.clone(), nothing(thread))
        };
        rising.lay(pen, laid);
        if !behind.on {
            pen.off();
        }
        let falling = if slow { Ramp::down((stop * steps) as u32, off) } else { Ramp::none() };
        falling.run(pen, left);
        pen.end(behind);
    }

    /// Starts the clay on the travel that has just been written, before the thread begins.
    fn start_early(&self, pen: &mut Pen, thread: &Thread, travels: &Travels, ratio: f64) {
        let early = if travels.first {
            self.first_early
        } else if self.decay > 0.0 {
            self.early * (1.0 - libm::exp(-travels.ahead / self.decay))
        } else {
            self.early
        };
        let early = early * ratio;
        let Some(first) = thread.stretches.first() else { return };
        // Where the nozzle comes down to the bead, clay that flows already would pile up in front of it.
        let level = pen.nozzle().at.is_some_and(|at| pen.came_from().is_some_and(|from| from.z == at.z));
        if early >= 1.0
            && level
            && let Some((from, travel)) = pen.take_travel()
        {
            let length = Move::to(travel.to).length(from);
            let on = along(travel.to, from, early.min(length));
            pen.step(Move { to: on, ..travel });
            pen.start(first);
            pen.go(travel.to, first.step.feed.or(self.operating));
        }
    }
}

/// The empty end of a thread.
fn nothing(thread: &Thread) -> Thread {
    Thread { start: thread.end(), stretches: Vec::new() }
}
