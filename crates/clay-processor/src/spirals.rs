//! Tells spirals from layers in printing that is not interrupted.
//!
//! Whether a climb is a spiral is known only at its end, so its lines are grouped into layers in the meantime, and
//! those layers are taken back if it is one.

use crate::habits::Count;
use crate::helix::Helix;
use crate::layers::{Group, Layers, Mark};
use crate::motion::{EPSILON_Z, Move};
use crate::report::{Pitch, Run};
use crate::trail::Trail;

/// A spiral may stay at one height for so long, mm: Z is written with two or three decimals, so in a gentle climb some
/// lines repeat the one before.
pub(crate) const LONGEST_FLAT: f64 = 2.0;

/// How wide a bead lies if nobody says it, and the finest that is told apart from its neighbour, mm.
const BEAD: f64 = 2.0;
const FINEST: f64 = 1.0;
/// A thread lies on itself if its middle lies no farther beside it than so many beads. Two walls of one pot do not.
const BESIDE: f64 = 0.75;

/// The spirals and layers found so far.
#[derive(Clone, Debug)]
pub(crate) struct Spirals {
    pub(crate) found: Vec<Run>,
    /// How each of them climbs.
    pub(crate) pitches: Vec<Pitch>,
    pub(crate) layers: Layers,
    /// Lines in spirals whose Z stays, and settings of the position; for the notes.
    pub(crate) rounded: Count,
    pub(crate) resets: Count,
    climb: Option<Climb>,
    trail: Trail,
}

/// Lines from one change of Z to the last.
#[derive(Clone, Debug)]
struct Climb {
    before: Mark,
    first: usize,
    last: usize,
    height: Option<f64>,
    rise: f64,
    helix: Helix,
    slopes: usize,
    rounded: Count,
    resets: Count,
    /// Flat lines since the last change of Z: part of the climb if another change follows soon.
    flats: Option<Group>,
    flat_length: f64,
    flat_resets: Count,
}

impl Spirals {
    /// None yet, of beads of this width, mm.
    pub(crate) fn new(bead_width: Option<f64>) -> Self {
        Self {
            found: Vec::new(),
            pitches: Vec::new(),
            layers: Layers::default(),
            rounded: Count::default(),
            resets: Count::default(),
            climb: None,
            trail: Trail::new(BESIDE * bead_width.unwrap_or(BEAD).max(FINEST)),
        }
    }

    /// A line printed at one height. Returns whether it goes on with a layer.
    #[inline(always)]
    pub(crate) fn flat(&mut self, index: usize, step: &Move) -> bool {
        let goes_on = self.layers.flat(index, step.to);
        if self.climb.is_some() {
            self.flat_in_climb(index, step);
        }
        goes_on
    }

    #[cold]
    fn flat_in_climb(&mut self, index: usize, step: &Move) {
        if let Some(climb) = &mut self.climb {
            let height = step.to;
            let flats = climb.flats.get_or_insert(Group { height, first: index, last: index, lines: 0 });
            flats.last = index;
            flats.lines += 1;
            climb.flat_length += step.flat_length();
            if climb.flat_length > LONGEST_FLAT {
                self.interrupt();
            } else {
                climb.helix.go_on(&mut self.trail, index, step);
            }
        }
    }

    /// A line printed up or down. Returns the rise of a turn that it completes.
    #[inline]
    pub(crate) fn slope(&mut self, index: usize, step: &Move) -> Option<f64> {
        let turn = match &mut self.climb {
            Some(climb) => climb.go_on(&mut self.trail, index, step),
            None => {
                self.climb = Some(Climb::new(self.layers.mark(), &mut self.trail, index, step));
                None
            }
        };
        self.layers.slope(index, step.to);
        turn
    }

    /// The position is set anew.
    pub(crate) fn reset(&mut self, index: usize) {
        if let Some(climb) = &mut self.climb {
            climb.flat_resets.add(index);
        }
    }

    /// The height is called otherwise from now on: what comes at the same number is another layer.
    pub(crate) fn rename(&mut self) {
        self.interrupt();
        self.layers.end();
    }

    /// The printing stops, or has become flat: a climb ends.
    #[inline(always)]
    pub(crate) fn interrupt(&mut self) {
        if self.climb.is_some() {
            self.end_climb();
        }
    }

    #[cold]
    fn end_climb(&mut self) {
        if let Some(climb) = self.climb.take()
            && climb.slopes >= 2
            && climb.rise > EPSILON_Z
        {
            self.take_back(climb);
        }
    }

    /// The climb is a spiral, not layers.
    fn take_back(&mut self, climb: Climb) {
        self.layers.return_to(climb.before);
        self.layers.end();
        if let Some(flats) = climb.flats {
            self.layers.start(flats);
        }
        self.rounded.add_all(&climb.rounded);
        self.resets.add_all(&climb.resets);
        self.pitches.push(climb.helix.pitch(&self.trail));
        self.found.push(Run { start_index: climb.first, end_index: climb.last, height: climb.height });
    }

    pub(crate) fn finish(&mut self) {
        self.interrupt();
        self.layers.end();
    }
}

impl Climb {
    fn new(before: Mark, trail: &mut Trail, index: usize, step: &Move) -> Self {
        let mut helix = Helix::new(trail);
        helix.go_on(trail, index, step);
        Self {
            before,
            first: index,
            last: index,
            height: step.to,
            rise: step.climb,
            helix,
            slopes: 1,
            rounded: Count::default(),
            resets: Count::default(),
            flats: None,
            flat_length: 0.0,
            flat_resets: Count::default(),
        }
    }

    #[inline]
    fn go_on(&mut self, trail: &mut Trail, index: usize, step: &Move) -> Option<f64> {
        self.last = index;
        self.rise += step.climb;
        self.slopes += 1;
        if let Some(flats) = self.flats.take() {
            self.rounded.add_all(&Count { count: flats.lines, first: flats.first });
            self.flat_length = 0.0;
        }
        self.resets.add_all(&self.flat_resets);
        self.flat_resets = Count::default();
        self.helix.go_on(trail, index, step)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// What printing does, in half millimetres of way and whole millimetres of height.
    #[derive(Clone, Copy, Debug, PartialEq)]
    enum Event {
        Flat(u8),
        Slope(i8),
        Travel,
    }

    fn events() -> impl Strategy<Value = Vec<Event>> {
        let event = prop_oneof![
            5 => (1_u8..6).prop_map(Event::Flat),
            4 => prop::sample::select(vec![-1_i8, 1, 2]).prop_map(Event::Slope),
            1 => Just(Event::Travel),
        ];
        prop::collection::vec(event, 0..40)
    }

    fn length(event: &Event) -> u8 {
        if let Event::Flat(length) = *event { length } else { 0 }
    }

    /// The definition, read twice over a whole file: first the spirals, then the layers of what is left.
    fn by_definition(events: &[Event], heights: &[i32]) -> (Vec<[usize; 2]>, Vec<[usize; 2]>) {
        let slopes: Vec<usize> =
            (0..events.len()).filter(|&i| matches!(events[i], Event::Slope(_))).collect();
        let joined = |pair: &[usize]| {
            let between = &events[pair[0] + 1..pair[1]];
            !between.contains(&Event::Travel) && between.iter().map(length).sum::<u8>() <= 4
        };
        let mut spirals = Vec::new();
        for part in slopes.chunk_by(|&a, &b| joined(&[a, b])) {
            let (first, last) = (part[0], part[part.len() - 1]);
            let start = if first == 0 { 0 } else { heights[first - 1] };
            if part.len() >= 2 && heights[last] > start {
                spirals.push([first, last]);
            }
        }
        let mut layers: Vec<Vec<usize>> = vec![Vec::new()];
        for (index, event) in events.iter().enumerate() {
            if spirals.iter().any(|&[first, last]| first <= index && index <= last) {
                layers.push(Vec::new());
                continue;
            }
            if *event == Event::Travel {
                continue;
            }
            let goes_on = layers
                .last()
                .and_then(|layer| layer.last())
                .is_some_and(|&last| heights[last] == heights[index] && matches!(event, Event::Flat(_)));
            if !goes_on {
                layers.push(Vec::new());
            }
            if let Some(layer) = layers.last_mut() {
                layer.push(index);
            }
        }
        let layers =
            layers.iter().filter(|layer| layer.len() >= 2).map(|layer| [layer[0], layer[layer.len() - 1]]);
        (spirals, layers.collect())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn line_by_line_finds_what_the_definition_says(events in events()) {
            let mut spirals = Spirals::new(None);
            let mut height = 0;
            let mut heights = Vec::new();
            for (index, event) in events.iter().enumerate() {
                if let Event::Slope(rise) = event {
                    height += i32::from(*rise);
                }
                heights.push(height);
                let at = Some(f64::from(height));
                match *event {
                    Event::Flat(length) => {
                        spirals.flat(index, &Move::made_up(f64::from(length) / 2.0, 0.0, at));
                    }
                    Event::Slope(rise) => {
                        spirals.slope(index, &Move::made_up(1.0, f64::from(rise), at));
                    }
                    Event::Travel => spirals.interrupt(),
                }
            }
            spirals.finish();
            let ends = |runs: &[Run]| runs.iter().map(|run| [run.start_index, run.end_index]).collect::<Vec<_>>();
            prop_assert_eq!(
                (ends(&spirals.found), ends(&spirals.layers.found)),
                by_definition(&events, &heights)
            );
        }
    }
}
