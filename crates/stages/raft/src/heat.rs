//! The temperature of the nozzle, for machines that heat it.

use crate::support::Support;
use shape::plane::offset;
use skein::{Celsius, Error, Facts, Feed, Layer, Line, Move, Point, Point3, Reader, Ring, Tag};

/// What the temperatures of a print are, and which one the nozzle has.
pub(crate) struct Heat {
    pub(crate) base: Celsius,
    pub(crate) interface: Celsius,
    infill: Celsius,
    perimeter: Celsius,
    next: Celsius,
    support: Celsius,
    supported: Celsius,
    heating: f64,
    cooling: f64,
    orbital: Feed,
    now: Celsius,
}

/// The steps of the temperature at the beginning of a layer.
#[derive(Clone, Default)]
pub(crate) struct Steps {
    /// Before its support.
    pub(crate) before: Vec<Line>,
    /// Behind it, before the part; without support all there is.
    pub(crate) after: Vec<Line>,
}

/// What the nozzle has before anybody heats it.
const ROOM: Celsius = Celsius(25_000);

/// Shorter waits than this are not worth going around for, in seconds (stages.md §6.7).
const LEAST_WAIT: f64 = 1.5;

/// No nozzle takes longer than this, in seconds; rates that say so are mistaken.
const MOST_WAIT: f64 = 600.0;

impl Heat {
    /// `None` unless the machine heats its nozzle and the header has the temperatures.
    pub(crate) fn new(facts: &Facts) -> Result<Option<Self>, Error> {
        if !facts.heaters.is_some_and(|heaters| heaters.nozzle) || facts.base_temperature.is_none() {
            return Ok(None);
        }
        Ok(Some(Self {
            base: facts.base_temperature()?,
            interface: facts.interface_temperature()?,
            infill: facts.first_layer_infill_temperature()?,
            perimeter: facts.first_layer_perimeter_temperature()?,
            next: facts.next_layers_temperature()?,
            support: facts.support_temperature()?,
            supported: facts.supported_temperature()?,
            heating: facts.heating_rate()?.degrees(),
            cooling: facts.cooling_rate()?.degrees(),
            orbital: facts.orbital_feed()?,
            now: ROOM,
        }))
    }

    /// The lines that bring the nozzle to a temperature: the command, and then as many rounds around the largest of some
    /// loops as it takes to get there.
    pub(crate) fn to(&mut self, wanted: Celsius, loops: &[Ring], z: i32, facts: &Facts) -> Vec<Line> {
        let change = wanted.degrees() - self.now.degrees();
        let Some(command) = self.say(wanted) else { return Vec::new() };
        let rate = if change > 0.0 { self.heating } else { self.cooling };
        let wait = if rate > 0.0 { (change.abs() / rate).min(MOST_WAIT) } else { 0.0 };
        let mut lines = vec![command];
        if wait > LEAST_WAIT {
            let width = facts.bead_width.map_or(0.0, |width| width.um());
            let around = offset(loops, width).into_iter().max_by_key(Ring::area2);
            let way = wait * self.orbital.mm_per_s() * 1000.0;
            lines.extend(around.iter().flat_map(|ring| orbit(ring, way, z, self.orbital)));
        }
        lines
    }

    /// The command alone, if the temperature is another one.
    fn say(&mut self, wanted: Celsius) -> Option<Line> {
        if std::mem::replace(&mut self.now, wanted) == wanted {
            return None;
        }
        // A command reads back as it is written; it has no bracket and no line break.
        Reader::default().line(format!("M104 S{wanted}").as_bytes()).ok()
    }

    /// The steps at the beginning of every layer of the part.
    pub(crate) fn object(
        &mut self,
        layers: &[Layer],
        outlines: &[Vec<Ring>],
        supports: &[Support],
        facts: &Facts,
    ) -> Result<Vec<Steps>, Error> {
        let mut all = Vec::with_capacity(layers.len());
        for (index, layer) in layers.iter().enumerate() {
            let z = layer.nozzle_z(facts)?.0;
            let support = &supports[index];
            let mut steps = Steps::default();
            if !support.threads.is_empty() {
                steps.before = self.to(self.support, &support.region, z, facts);
            }
            let part = match (index, support.threads.is_empty()) {
                (0, _) => self.perimeter,
                (_, true) => self.next,
                (_, false) => self.supported,
            };
            steps.after = self.to(part, &outlines[index], z, facts);
            if index == 0 {
                // The first layer ends with what its last bead is.
                self.now = last_of(layer).map_or(self.perimeter, |tag| self.of(tag));
            }
            all.push(steps);
        }
        Ok(all)
    }

    fn of(&self, tag: Tag) -> Celsius {
        if matches!(tag, Tag::Edge | Tag::Loop) { self.perimeter } else { self.infill }
    }

    /// The first layer of the part with a step where walls and infill take turns.
    pub(crate) fn first_layer(&mut self, lines: Vec<Line>) -> Result<Vec<Line>, Error> {
        self.now = self.perimeter;
        let mut written = Vec::with_capacity(lines.len() + 2);
        for line in lines {
            if let Some(tag) = bead_tag(&line) {
                written.extend(self.say(self.of(tag)));
            }
            written.push(line);
        }
        Ok(written)
    }
}

/// The block of a bead of the part that a line opens.
fn bead_tag(line: &Line) -> Option<Tag> {
    match line {
        Line::Wall(tag, _) | Line::Open(tag @ (Tag::Infill | Tag::Middle)) => Some(*tag),
        _ => None,
    }
}

fn last_of(layer: &Layer) -> Option<Tag> {
    layer.lines.iter().rev().find_map(bead_tag)
}

/// Moves around a ring, again and again, for so many microns.
fn orbit(ring: &Ring, way: f64, z: i32, feed: Feed) -> Vec<Line> {
    let step = |at: Point, feed| Line::Move(Move { feed, ..Move::to(Point3 { x: at.x, y: at.y, z }) });
    let Some(&first) = ring.0.first() else { return Vec::new() };
    let mut lines = vec![step(first, Some(feed))];
    let (round, mut left) = (ring.length(), way);
    if round <= 0.0 {
        return Vec::new();
    }
    while left > 0.0 {
        for (from, to) in ring.segments() {
            if left <= 0.0 {
                break;
            }
            left -= from.distance(to);
            lines.push(step(to, None));
        }
    }
    lines
}
