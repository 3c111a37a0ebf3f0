#![doc = include_str!("../README.md")]

mod orbit;
mod pace;
#[cfg(test)]
mod tests;

use orbit::Orbits;
use pace::{Times, held, temperatures};
use rayon::prelude::*;
use skein::{
    Choice, Error, Feed, Layer, Line, Micron, Notes, Nozzle, Pen, Ratio, Settings, Skein, Stage, Tag,
};

/// Gives small layers time to stiffen.
#[derive(Clone, Debug, Settings)]
pub struct Cool {
    /// What a layer does that would be done too soon.
    #[setting(default = Waiting::SlowDown)]
    pub waiting: Waiting,
    /// The least time for a layer. Wet clay carries the next bead after a while in the air; a small layer comes back to
    /// the same spot before that.
    #[setting(default = 20.0, min = 0.0, max = 1000.0, unit = "s")]
    pub minimum_layer_time: Ratio,
    /// The slowest that a bead is laid. Below that the flow becomes uneven, and the layer is done sooner than it should.
    #[setting(default = 10.0, min = 0.001, max = 1000.0, unit = "mm/s")]
    pub minimum_feed: Feed,
    /// How far above the print the nozzle waits, in layer heights.
    #[setting(default = 3.0, min = 0.0, max = 1000.0)]
    pub clearance: Ratio,
    /// How far outside the part the nozzle goes around while it waits.
    #[setting(default = 2.0, min = 0.0, max = 1000.0, unit = "mm")]
    pub orbital_outset: Micron,
    /// Half the side of the smallest square in which it goes around.
    #[setting(default = 10.0, min = 0.1, max = 1000.0, unit = "mm")]
    pub minimum_orbital_radius: Micron,
    /// How much cooler the nozzle becomes on a layer that takes no time at all, on machines that heat it.
    #[setting(default = 2.0, min = 0.0, max = 100.0, unit = "°C")]
    pub maximum_cool: Ratio,
    /// How much cooler the nozzle becomes at least on a layer that bridges a gap, on machines that heat it.
    #[setting(default = 1.0, min = 0.0, max = 100.0, unit = "°C")]
    pub bridge_cool: Ratio,
    /// Whether the fan blows from the first layer to the last: M106 at the beginning, M107 at the end.
    #[setting(default = false)]
    pub fan: bool,
    /// Lines before each wait.
    #[setting(default = "")]
    pub start: String,
    /// Lines after each wait.
    #[setting(default = "")]
    pub end: String,
}

/// What a layer does that would be done too soon.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Waiting {
    /// Its beads are laid more slowly.
    SlowDown,
    /// The nozzle stands above the print before the layer begins (G4).
    Dwell,
    /// The nozzle goes around the part before the layer begins.
    Orbit,
}

/// A wait shorter than this is not worth a way around (stages.md §6.13), in seconds.
const SHORTEST_ORBIT: f64 = 1.5;

impl Stage for Cool {
    const NAME: &'static str = "cool";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        let nozzles = skein.nozzles();
        let times: Vec<Times> = skein
            .layers
            .par_iter()
            .zip(&nozzles)
            .map(|(layer, nozzle)| Times::of(&layer.lines, *nozzle))
            .collect();
        let plan = Plan {
            cool: self,
            heated: temperatures(&skein, &facts),
            orbits: Orbits::new(self, &skein, &facts, &times)?,
            times,
            nozzles,
        };
        self.blow(&mut skein, notes);
        skein.rewrite(notes, |index, layer, notes| plan.layer(index, layer, notes))
    }
}

impl Cool {
    /// How long a layer must wait: what is missing of its least time, in seconds.
    fn missing(&self, times: &Times) -> f64 {
        if times.laying == 0.0 { 0.0 } else { (self.minimum_layer_time.f64() - times.all).max(0.0) }
    }

    fn blow(&self, skein: &mut Skein, notes: &mut Notes) {
        if self.fan {
            let crafting = skein.head.iter().position(|line| *line == Line::Open(Tag::Crafting));
            let index = crafting.map_or(skein.head.len(), |index| index + 1);
            skein.head.insert(index, Line::Verbatim("M106".into()));
            if skein.tail.is_empty() {
                notes.say("the print has no end at which the fan could be switched off");
            } else {
                skein.tail.push(Line::Verbatim("M107".into()));
            }
        }
    }
}

/// What is to be done in each layer.
struct Plan<'a> {
    cool: &'a Cool,
    times: Vec<Times>,
    nozzles: Vec<Nozzle>,
    /// The temperature that the nozzle has on each layer, where it is heated.
    heated: Vec<Option<f64>>,
    orbits: Orbits,
}

impl Plan<'_> {
    fn layer(&self, index: usize, layer: Layer, notes: &mut Notes) -> Result<Vec<Line>, Error> {
        let cool = self.cool;
        let (times, entering) = (&self.times[index], &self.nozzles[index]);
        let missing = cool.missing(times);
        let cooler = self.cooler(index, missing, &layer);
        // Nothing lies under the first layer that could be soft.
        let waits = missing > 0.0 && index > 0 && cool.waiting != Waiting::SlowDown;
        let share = match cool.waiting {
            Waiting::SlowDown => (times.laying / (missing + times.laying)).min(1.0),
            Waiting::Dwell | Waiting::Orbit => 1.0,
        };
        if cooler.is_none() && !waits && (share >= 1.0 || missing == 0.0) {
            return Ok(layer.lines);
        }
        let mut was = *entering;
        let mut pen = Pen::new(entering, layer.lines.len() + 16);
        let body = layer.heading();
        let mut floored = false;
        for (place, line) in layer.lines.into_iter().enumerate() {
            if place == body {
                cooler.iter().for_each(|(low, _)| pen.push(heat(*low)));
                if waits {
                    self.wait(index, missing, &mut pen);
                }
            }
            if line == Line::Close(Tag::Layer) {
                cooler.iter().for_each(|(_, usual)| pen.push(heat(*usual)));
            }
            let before = was;
            was.follow(&line);
            match (share < 1.0 && before.on, was.feed, line) {
                (true, Some(feed), mut line @ (Line::Move(_) | Line::Arc(_))) => {
                    let (slower, at_floor) = held(feed, share, cool.minimum_feed);
                    floored |= at_floor;
                    if let Some(step) = line.as_move_mut() {
                        step.feed = (pen.nozzle().feed != Some(slower)).then_some(slower);
                    }
                    pen.push(line);
                }
                (_, _, line) => pen.pass(line, &before),
            }
        }
        if floored {
            notes.layer(
                index,
                format!(
                    "is done in less than {} s even at {} mm/s",
                    cool.minimum_layer_time,
                    cool.minimum_feed.mm_per_s()
                ),
            );
        }
        Ok(pen.finish(&was))
    }

    /// The lower temperature of a layer and the usual one, if they differ.
    fn cooler(&self, index: usize, missing: f64, layer: &Layer) -> Option<(f64, f64)> {
        let usual = self.heated[index]?;
        let share = missing / self.cool.minimum_layer_time.f64().max(f64::MIN_POSITIVE);
        let bridge = layer.lines.iter().any(|line| matches!(line, Line::Rotation(Tag::BridgeRotation, _)));
        let least = if bridge { self.cool.bridge_cool.f64() } else { 0.0 };
        let drop = (self.cool.maximum_cool.f64() * share).max(least);
        (drop > 0.0).then_some((usual - drop, usual))
    }

    /// Above the part or around it, until the time is up.
    fn wait(&self, index: usize, missing: f64, pen: &mut Pen) {
        let flowed = pen.nozzle().on;
        let from = pen.nozzle().at;
        pen.off();
        Self::paste(&self.cool.start, pen);
        self.orbits.wait(index, missing, pen);
        Self::paste(&self.cool.end, pen);
        if flowed {
            from.into_iter().for_each(|at| pen.go(at, None));
            pen.on();
        }
    }

    fn paste(lines: &str, pen: &mut Pen) {
        if !lines.trim().is_empty() {
            Line::alteration(lines).into_iter().for_each(|line| pen.push(line));
        }
    }
}

/// `M104 S198.5`
fn heat(degrees: f64) -> Line {
    let mut text = b"M104 S".to_vec();
    unit::decimal::write(&mut text, (degrees * 1000.0).round() as i64, 3);
    Line::Verbatim(String::from_utf8_lossy(&text).into())
}
