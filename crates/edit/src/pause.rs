//! A stop on the way.

use clay_processor::process;
use gcode::Line;
use skein::Error;

use crate::machine::{Act, EPSILON_Z, Machine, Move};
use crate::survey::Survey;
use crate::tape::{line_end, raw_lines, split_bom};
use crate::writer::Writer;
use crate::{Edited, amount, said};

/// Stops between two beads: lifts, goes aside, waits, presses clay until it flows, and comes back to where it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Pause {
    /// When.
    pub at: At,
    /// How far the nozzle rises, mm.
    pub lift: f64,
    /// Where it waits; over the part if nothing is said.
    pub park: Option<[f64; 2]>,
    /// E that is pressed before it comes back, in the unit of the file.
    pub prime: f64,
    /// E that is drawn back before it rises, in the unit of the file.
    pub relieve: f64,
    /// The command that waits.
    pub wait: String,
}

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum At {
    /// Before the first bead above this height, mm.
    Height(f64),
    /// Before the spiral.
    Base,
}

impl Default for Pause {
    fn default() -> Self {
        Self { at: At::Base, lift: 20.0, park: None, prime: 0.0, relieve: 0.0, wait: "M0".to_owned() }
    }
}

impl Pause {
    pub(crate) fn apply(&self, text: &[u8]) -> Result<Edited, Error> {
        amount("the lift", self.lift, 1000.0)?;
        amount("the prime", self.prime, 1e6)?;
        amount("the relief", self.relieve, 1e6)?;
        if self.park.is_some_and(|place| place.iter().any(|number| !number.is_finite())) {
            return Err(Error::new("the place to park at is no number").hint("give X and Y in mm"));
        }
        if self.park.is_some() && self.lift == 0.0 {
            return Err(Error::new("the nozzle would be dragged through the clay to where it parks")
                .hint("give a lift of some mm"));
        }
        let wait = Line::of(self.wait.as_bytes());
        let moves = matches!(Machine::new().obey(&wait), Act::Move(_) | Act::Home);
        if wait.command.is_none() || moves || self.wait.contains(['\r', '\n']) {
            return Err(Error::new(format!("`{}` is no command that waits", self.wait))
                .hint("M0 waits for a button, G4 S60 for a minute, M25 stops reading from the card"));
        }
        let survey = Survey::of(text)?;
        let stop = self.last_before(text, &survey)?;

        let (bom, body) = split_bom(text);
        let mut writer = Writer::new(text.len(), line_end(text));
        writer.out.extend_from_slice(bom);
        let mut line = Line::default();
        let mut height = 0.0;
        for (index, raw) in raw_lines(body).enumerate() {
            line.read(raw.text);
            let before = (index == stop).then(|| writer.machine.clone());
            writer.keep(raw, &line);
            if let Some(mut before) = before
                && let Act::Move(step) = before.obey(&line)
            {
                height = step.to[2];
                self.draw(&mut writer, &step, survey.travel_feed)
                    .map_err(|error| error.at(skein::Place::Line(index + 1)))?;
            }
        }
        let place = self.park.map_or_else(|| "above the part".to_owned(), |[x, y]| format!("at X{x} Y{y}"));
        let sentence = format!(
            "{} behind the beads up to Z{height:.3}: lift {} mm, wait {place}, press E{}",
            self.wait, self.lift, self.prime
        );
        Ok(said(writer.out, &[sentence]))
    }

    /// The last line that prints before the stop.
    fn last_before(&self, text: &[u8], survey: &Survey) -> Result<usize, Error> {
        let limit = match self.at {
            At::Height(height) => {
                let lowest = survey.bottom;
                if !(height >= lowest - EPSILON_Z && height < survey.top - EPSILON_Z) {
                    let message = format!(
                        "nothing is printed above Z{height} or nothing up to there: the part goes from Z{lowest:.3} to Z{:.3}",
                        survey.top
                    );
                    return Err(Error::new(message).hint("give a height within the part"));
                }
                Stop::Above(height)
            }
            At::Base => {
                let spirals = process(text).machine.spirals;
                let spiral = spirals.first().ok_or_else(|| {
                    Error::new("the file has no spiral, so it is not known where the base ends")
                        .hint("give a height instead")
                })?;
                Stop::Line(spiral.start_index)
            }
        };
        let mut machine = Machine::new();
        let mut line = Line::default();
        let mut last = None;
        for (index, raw) in raw_lines(split_bom(text).1).enumerate() {
            line.read(raw.text);
            let Act::Move(step) = machine.obey(&line) else { continue };
            let is_beyond = match limit {
                Stop::Above(height) => {
                    index >= survey.lead && step.prints() && step.to[2] > height + EPSILON_Z
                }
                Stop::Line(first) => index >= first,
            };
            if is_beyond {
                break;
            }
            if index >= survey.lead && step.prints() {
                last = Some(index);
            }
        }
        last.ok_or_else(|| {
            Error::new("nothing is printed before the stop")
                .hint("a spiral without a base has no pause behind it")
        })
    }

    /// Writes the stop, behind the bead `was`.
    fn draw(&self, writer: &mut Writer, was: &Move, travel_feed: Option<f64>) -> Result<(), Error> {
        if !was.known.iter().all(|&known| known) {
            return Err(Error::new("the place of the nozzle is not known here, so it could not come back")
                .hint("the file must name X, Y and Z once before, with G90"));
        }
        let unit = writer.machine.scale();
        let (feed, e) = (was.feed, writer.machine.e_word() * unit);
        // Clay is pressed as fast as the bead was.
        let way = was.length([1.0; 3]);
        let ram_feed = feed.map(|feed| if way > 0.0 { feed * was.clay / way } else { feed });
        writer.end_line();
        writer.insert("; edit pause");
        if self.relieve > 0.0 {
            writer.draw([None; 3], -self.relieve * unit, ram_feed);
        }
        let [x, y, z] = was.to;
        writer.draw([None, None, Some(z + self.lift)], 0.0, travel_feed);
        if let Some([park_x, park_y]) = self.park {
            writer.draw([Some(park_x), Some(park_y), None], 0.0, travel_feed);
        }
        writer.insert(&self.wait);
        if self.prime + self.relieve > 0.0 {
            writer.draw([None; 3], (self.prime + self.relieve) * unit, ram_feed);
        }
        if self.park.is_some() {
            writer.draw([Some(x), Some(y), None], 0.0, travel_feed);
        }
        writer.draw([None, None, Some(z)], 0.0, travel_feed);
        writer.draw([None; 3], 0.0, feed);
        if self.prime > 0.0 || self.relieve > 0.0 {
            writer.call_e(e);
        }
        writer.insert("; edit pause: end");
        Ok(())
    }
}

/// Where to stop looking.
enum Stop {
    Above(f64),
    Line(usize),
}
