//! Event series for Abaqus: when the tool is where, and whether material comes out.
//!
//! A row's field holds from its time to that of the next row, and between two rows the tool moves at a constant speed.
//! So a row stands wherever acceleration changes, and in between where a ramp would be off by too much.

use crate::error::Error;
use crate::operation::AdditiveOperation;
use crate::part::CHORD_TOLERANCE;
use std::io::Write;

/// The field of a row besides time and place.
#[derive(Clone, Debug, PartialEq)]
pub enum EventField {
    /// 1 while material comes out, else 0.
    Active,
    /// This power while material comes out, else 0.
    Power(f64),
    /// The section of the bead, mm² (in the unit of length, squared); 0 while nothing comes out.
    BeadArea,
}

impl EventField {
    /// The name of the type that Abaqus has for it.
    const fn abaqus_type(&self) -> &'static str {
        match self {
            Self::Active => "ABQ_AM_MaterialDeposition",
            Self::Power(_) => "ABQ_AM_PowerMagnitude",
            Self::BeadArea => "CLAYFORGE_BeadArea",
        }
    }
}

/// What an event series is to say.
#[derive(Clone, Debug, PartialEq)]
pub struct EventOptions {
    /// The fields, in order.
    pub fields: Vec<EventField>,
    /// How far a straight line between two rows may be off within a ramp, mm; 0 puts rows only where acceleration
    /// changes.
    pub max_position_error: f64,
    /// How far the chords of an arc may lie beside it, mm.
    pub chord_tolerance: f64,
    /// Added to all times, s.
    pub time_offset: f64,
    /// The unit of length, in units for each mm: 0.001 for metres.
    pub unit: f64,
}

impl Default for EventOptions {
    fn default() -> Self {
        Self {
            fields: vec![EventField::Active],
            max_position_error: 0.0,
            chord_tolerance: CHORD_TOLERANCE,
            time_offset: 0.0,
            unit: 1.0,
        }
    }
}

/// Rows of time, place and fields; times grow from row to row.
///
/// ```
/// use emulate::{EventOptions, EventSeries, Machine, Commands};
///
/// let program = Commands::read(b"M83\nG1 X10 E1 F600\nG1 X20\n");
/// let operation = Machine::default().process_additive(program.steps)?;
/// let series = EventSeries::new(&operation, &EventOptions::default());
/// assert_eq!(series.to_rows(), "0,0,0,0,1\n1,10,0,0,0\n2,20,0,0,0\n");
/// # Ok::<(), emulate::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EventSeries {
    /// Times, s.
    pub time: Vec<f64>,
    /// Places.
    pub at: Vec<[f64; 3]>,
    /// The names and values of the fields.
    pub fields: Vec<(&'static str, Vec<f64>)>,
}

impl EventSeries {
    /// The event series of an operation.
    pub fn new(operation: &AdditiveOperation<'_>, options: &EventOptions) -> Self {
        let process = operation.process_data();
        let fields = options.fields.iter().map(|field| (field.abaqus_type(), Vec::new())).collect();
        let mut series = Self { fields, ..Self::default() };
        let values = |index: usize| -> Vec<f64> {
            // A prime counts, as in pyGCodeDecode: E grows.
            let on = operation.delta_volume()[index] > 0.0;
            let value = |field: &EventField| match field {
                _ if !on => 0.0,
                EventField::Active => 1.0,
                EventField::Power(power) => *power,
                EventField::BeadArea => operation.bead_area(index) * options.unit * options.unit,
            };
            options.fields.iter().map(value).collect()
        };
        let mut row = |time: f64, at: [f64; 3], values: &[f64]| {
            let time = time + options.time_offset;
            let at = at.map(|side| side * options.unit);
            // Of two rows at one time the later counts; what is nearer than the sums are exact is one time.
            if series.time.last().is_some_and(|&last| last >= time - 1e-13 * time.abs().max(1.0)) {
                if let Some(last) = series.at.last_mut() {
                    *last = at;
                }
                for ((_, column), &value) in series.fields.iter_mut().zip(values) {
                    if let Some(last) = column.last_mut() {
                        *last = value;
                    }
                }
                return;
            }
            series.time.push(time);
            series.at.push(at);
            for ((_, column), &value) in series.fields.iter_mut().zip(values) {
                column.push(value);
            }
        };
        for index in 0..process.len() {
            let start = process.start_time(index);
            if process.duration(index) <= 0.0 {
                continue;
            }
            let values = values(index);
            row(start, process.start(index), &values);
            if !process.action[index].is_path() {
                continue;
            }
            for time in stops(process, index, options) {
                let way = process.phases(index).at(time).distance;
                row(start + time, process.point(index, way), &values);
            }
        }
        if let Some(end) = process.elapsed_time.last().filter(|&&end| end > 0.0) {
            row(*end, process.end(process.len() - 1), &vec![0.0; options.fields.len()]);
        }
        series
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.time.len()
    }

    /// Whether nothing happens.
    pub fn is_empty(&self) -> bool {
        self.time.is_empty()
    }

    /// The bare rows: `time,x,y,z,field`.
    pub fn to_rows(&self) -> String {
        use std::fmt::Write;
        let mut text = String::new();
        for index in 0..self.len() {
            let [x, y, z] = self.at[index].map(tidy);
            // Writing to a string cannot fail.
            let _ = write!(text, "{},{x},{y},{z}", self.time[index]);
            for (_, column) in &self.fields {
                let _ = write!(text, ",{}", column[index]);
            }
            text.push('\n');
        }
        text
    }

    /// The rows with the keywords of an Abaqus input file, one series a field.
    pub fn to_inp(&self) -> String {
        use std::fmt::Write;
        let mut text = String::new();
        for (name, column) in &self.fields {
            let _ = writeln!(text, "*EVENT SERIES TYPE, NAME=\"{name}\", FIELDS=1");
            let _ = writeln!(text, "*EVENT SERIES, NAME=\"{name}_1\", TYPE=\"{name}\"");
            for ((time, at), value) in self.time.iter().zip(&self.at).zip(column) {
                let [x, y, z] = at.map(tidy);
                let _ = writeln!(text, "{time},{x},{y},{z},{value}");
            }
        }
        text
    }

    /// Writes the bare rows.
    ///
    /// # Errors
    /// When `out` does not take them.
    pub fn write(&self, mut out: impl Write) -> Result<(), Error> {
        Ok(out.write_all(self.to_rows().as_bytes())?)
    }
}

/// Places are printed to a hundred-millionth, as pyGCodeDecode prints them; more would be rounding.
fn tidy(value: f64) -> f64 {
    // Adding 0 makes a negative zero plain.
    (value * 1e8).round() / 1e8 + 0.0
}

/// The times within a move, after its start, at which it needs a row; the last is its end without being one.
fn stops(process: &crate::ProcessData, index: usize, options: &EventOptions) -> Vec<f64> {
    let phases = process.phases(index);
    let mut stops = Vec::new();
    let mut start = 0.0;
    for phase in phases.iter() {
        let end = start + phase.time;
        let steepest = phase.acceleration.abs().max((phase.acceleration + phase.jerk * phase.time).abs());
        // A parabola leaves its chord by a·T²/8.
        let parts = match options.max_position_error {
            error if error > 0.0 => (phase.time * (steepest / (8.0 * error)).sqrt()).ceil(),
            _ => 1.0,
        };
        let curve = process.arc(index).map_or(1.0, |arc| {
            let (from, to) = (phases.at(start).distance, phases.at(end).distance);
            (arc.chords(options.chord_tolerance) as f64 * (to - from) / process.step_distance()[index]).ceil()
        });
        // More rows than this say nothing more; and a cast of a float to an integer holds at the ends of its range.
        let parts = parts.max(curve).clamp(1.0, 1e6) as usize;
        stops.extend((1..=parts).map(|part| start + phase.time * part as f64 / parts as f64));
        start = end;
    }
    stops.pop();
    stops
}
