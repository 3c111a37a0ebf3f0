//! What the summary says: counted from the skein before it becomes G-code.

use rayon::prelude::*;
use skein::{Error, Facts, Feed, Layer, Line, Point3, Skein};

/// Lengths, clay and time of a print.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figures {
    /// Layers with a bead in them.
    pub layers: usize,
    /// Beads: from where clay begins to flow to where it stops.
    pub threads: usize,
    /// Runs of moves without clay.
    pub travels: usize,
    /// The length of all beads.
    pub extruded_mm: f64,
    /// The length of all travels.
    pub travel_mm: f64,
    /// The wet clay.
    pub volume_mm3: f64,
    /// Its mass.
    pub mass_g: f64,
    /// How long the machine takes for the finished file; before there is one, length over speed.
    pub time_s: f64,
}

impl Figures {
    /// Counts a skein. `flow` multiplies all clay; `density` is in g/cm³.
    ///
    /// # Errors
    /// When the header lacks a fact.
    pub fn of(skein: &Skein, flow: f64, density: f64) -> Result<Self, Error> {
        if skein.layers.is_empty() {
            return Ok(Self::default());
        }
        let facts = skein.facts()?;
        let mut state = State::start();
        skein.head.iter().for_each(|line| state.follow(line));
        // What each layer leaves behind, so that all can be counted side by side.
        let left: Vec<State> = skein.layers.par_iter().map(State::after).collect();
        let mut before = Vec::with_capacity(left.len());
        for after in left {
            before.push(state);
            state = state.then(after);
        }
        let parts: Vec<Result<Self, Error>> = skein
            .layers
            .par_iter()
            .zip(before)
            .map(|(layer, state)| Self::of_layer(layer, state, &facts))
            .collect();
        let mut sum = Self::default();
        // One after the other, so that the sums do not depend on the number of threads.
        for part in parts {
            sum.add(part?);
        }
        sum.volume_mm3 *= flow;
        sum.mass_g = sum.volume_mm3 / 1000.0 * density;
        Ok(sum)
    }

    fn of_layer(layer: &Layer, mut state: State, facts: &Facts) -> Result<Self, Error> {
        let mut figures = Self::default();
        let mut area = None;
        for line in &layer.lines {
            if let Some(step) = line.as_move() {
                let feed = step.feed.or(state.feed);
                let length = state.at.map_or(0.0, |from| line.length(from)) / 1000.0;
                if state.on == Some(true) {
                    let area = match area {
                        Some(area) => area,
                        None => *area.insert(facts.bead()?.of_height(layer.height(facts)?).area()),
                    };
                    figures.extruded_mm += length;
                    figures.volume_mm3 += length * area * state.flow.unwrap_or(1.0);
                } else {
                    figures.travel_mm += length;
                    if state.travelling != Some(true) {
                        figures.travels += 1;
                    }
                }
                if let Some(feed) = feed {
                    figures.time_s += length * 60_000.0 / f64::from(feed.get());
                }
            }
            figures.threads += usize::from(matches!(line, Line::On));
            state.follow(line);
        }
        figures.layers = usize::from(figures.extruded_mm > 0.0);
        Ok(figures)
    }

    fn add(&mut self, other: Self) {
        self.layers += other.layers;
        self.threads += other.threads;
        self.travels += other.travels;
        self.extruded_mm += other.extruded_mm;
        self.travel_mm += other.travel_mm;
        self.volume_mm3 += other.volume_mm3;
        self.time_s += other.time_s;
    }
}

/// What the nozzle is doing, as far as the lines seen so far say it. (The view [`skein::Nozzle`] knows no "not said
/// yet", which the layers side by side need.)
#[derive(Clone, Copy, Default)]
struct State {
    at: Option<Point3>,
    feed: Option<Feed>,
    on: Option<bool>,
    flow: Option<f64>,
    travelling: Option<bool>,
}

impl State {
    fn start() -> Self {
        Self { on: Some(false), flow: Some(1.0), travelling: Some(false), ..Self::default() }
    }

    fn after(layer: &Layer) -> Self {
        let mut state = Self::default();
        layer.lines.iter().for_each(|line| state.follow(line));
        state
    }

    #[inline]
    fn follow(&mut self, line: &Line) {
        if let Some(step) = line.as_move() {
            self.at = Some(step.to);
            self.feed = step.feed.or(self.feed);
            self.travelling = self.on.map(|on| !on);
            return;
        }
        match line {
            Line::On => self.on = Some(true),
            Line::Off => self.on = Some(false),
            Line::Flow(flow) => self.flow = Some(flow.f64()),
            _ => {}
        }
    }

    /// The state after both.
    fn then(self, after: Self) -> Self {
        let moved_as_before = after.at.and(self.on).map(|on| !on);
        Self {
            at: after.at.or(self.at),
            feed: after.feed.or(self.feed),
            on: after.on.or(self.on),
            flow: after.flow.or(self.flow),
            travelling: after.travelling.or(moved_as_before).or(self.travelling),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::TINY;

    #[test]
    fn a_square_of_two_layers_is_counted() {
        let skein = Skein::read(TINY.as_bytes()).expect("a skein");
        let figures = Figures::of(&skein, 1.0, 2.0).expect("facts are there");
        assert_eq!((figures.layers, figures.threads, figures.travels), (2, 2, 2));
        assert!((figures.extruded_mm - 160.0).abs() < 1e-9);
        // 3 mm wide, 1.5 mm high, rectangular.
        assert!((figures.volume_mm3 - 160.0 * 4.5).abs() < 1e-9, "{figures:?}");
        assert!((figures.mass_g - 1.44).abs() < 1e-9);
        assert!((figures.travel_mm - 1.5).abs() < 1e-9, "{figures:?}");
    }
}
