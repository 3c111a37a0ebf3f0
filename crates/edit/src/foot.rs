//! The base of a file: what it prints before its spiral.

use clay_processor::process;
use gcode::Line;
use skein::Error;

use crate::machine::{Act, EPSILON_Z, Machine};
use crate::survey::{Extent, Survey};
use crate::tape::{raw_lines, split_bom};

/// A base that can be put under another pot.
pub(crate) struct Foot {
    pub(crate) survey: Survey,
    /// Its last line that prints.
    pub(crate) last: usize,
    /// Its highest bead, mm.
    pub(crate) top: f64,
    /// The extents of what it prints there.
    pub(crate) top_layer: Extent,
    /// E for each mm of path and mm of height.
    pub(crate) density: f64,
}

impl Foot {
    /// The base of `text`: what it prints before its spiral, or before the first bead above `limit`.
    ///
    /// # Errors
    /// When nothing is printed before the spiral, or lines are numbered.
    pub(crate) fn of(text: &[u8], limit: Option<f64>) -> Result<Self, Error> {
        let survey = Survey::of(text)?;
        let spirals = process(text).machine.spirals;
        let end = spirals.first().map_or(usize::MAX, |spiral| spiral.start_index);
        let is_above = |height: f64| limit.is_some_and(|limit| height > limit + EPSILON_Z);

        let mut machine = Machine::new();
        let mut line = Line::default();
        let mut last = None;
        let (mut clay, mut length) = (0.0, 0.0);
        let mut heights: Vec<f64> = Vec::new();
        let mut top_layer = Extent::NONE;
        for (index, raw) in raw_lines(split_bom(text).1).enumerate().take_while(|(index, _)| *index < end) {
            line.read(raw.text);
            let Act::Move(step) = machine.obey(&line) else { continue };
            if index < survey.lead || !step.prints() {
                continue;
            }
            if is_above(step.to[2]) {
                break;
            }
            if matches!(raw.text.trim_ascii_start().first(), Some(b'N' | b'n')) {
                return Err(Error::line(
                    index,
                    "its lines are numbered, which cannot be mixed with another file",
                )
                .hint("take a file without line numbers"));
            }
            last = Some(index);
            clay += step.clay;
            length += step.length([1.0; 3]);
            let height = step.to[2];
            let highest = heights.last().copied();
            if highest.is_none_or(|highest| height > highest + EPSILON_Z) {
                heights.push(height);
                top_layer = Extent::NONE;
            }
            if heights.last().is_some_and(|highest| height > highest - EPSILON_Z) {
                top_layer.add_move(&step);
            }
        }
        let (Some(last), Some(&top)) = (last, heights.last()) else {
            return Err(Error::new(
                "it prints nothing before its spiral or up to that height, so it has no base",
            )
            .hint("take a file whose pot has bottom layers"));
        };
        let layer = top / heights.len() as f64;
        Ok(Self { survey, last, top, top_layer, density: clay / length / layer })
    }
}
