//! Writes a report for scripts.

use std::fmt::{self, Display, Formatter, Write};

use crate::report::{Interruptions, Model, Report, Run};
use crate::verdict::{Severity, Verdict};

/// The report as `clayforge check --json` prints it: one object with `letter`, `machine`, `notes`, `interruptions`,
/// `verdicts` and `ok`, without a line end. What is unknown is `null`.
///
/// ```
/// let json = clay_processor::to_json(&clay_processor::process(b"; a cup\nG1 Z1.50\n"));
/// assert!(json.contains(r#""vertical_movement_without_extrusion": [{"index": 1, "from": null, "to": 1.5}]"#));
/// ```
pub fn to_json(report: &Report) -> String {
    json(report).to_string()
}

/// What [`to_json`] makes, piece by piece: the text of a large file's report is larger than the report.
pub fn json(report: &Report) -> impl Display + '_ {
    struct Json<'a>(&'a Report);
    impl Display for Json<'_> {
        fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
            let report = self.0;
            out.write_str(r#"{"letter": "#)?;
            model(out, &report.letter)?;
            out.write_str(r#", "machine": "#)?;
            model(out, &report.machine)?;
            out.write_str(r#", "notes": "#)?;
            list(out, &report.notes, |out, note| quoted(out, &note.text))?;
            out.write_str(r#", "interruptions": "#)?;
            interruptions(out, &report.interruptions)?;
            out.write_str(r#", "verdicts": "#)?;
            list(out, &report.verdicts, verdict)?;
            write!(out, r#", "ok": {}}}"#, report.ok())
        }
    }
    Json(report)
}

fn model(out: &mut Formatter<'_>, model: &Model) -> fmt::Result {
    write!(
        out,
        r#"{{"first_part_comments_end": {}, "last_part_comments_start": {}, "max_height": {}, "layers": "#,
        Index(model.first_part_comments_end),
        Index(model.last_part_comments_start),
        Number(Some(model.max_height)),
    )?;
    list(out, &model.layers, run)?;
    out.write_str(r#", "spirals": "#)?;
    list(out, &model.spirals, run)?;
    out.write_str(r#", "horizontal_movement_without_extrusion": "#)?;
    list(out, &model.horizontal_movement_without_extrusion, |out, travel| {
        write!(out, r#"{{"index": {}, "height": {}}}"#, travel.index, Number(travel.height))
    })?;
    out.write_str(r#", "vertical_movement_without_extrusion": "#)?;
    list(out, &model.vertical_movement_without_extrusion, |out, lift| {
        let (from, to) = (Number(lift.from), Number(lift.to));
        write!(out, r#"{{"index": {}, "from": {from}, "to": {to}}}"#, lift.index)
    })?;
    out.write_str(r#", "diagonal_movement_without_extrusion": "#)?;
    list(out, &model.diagonal_movement_without_extrusion, |out, travel| {
        write!(out, r#"{{"index": {}}}"#, travel.index)
    })?;
    out.write_char('}')
}

fn run(out: &mut Formatter<'_>, run: &Run) -> fmt::Result {
    let height = Number(run.height);
    write!(
        out,
        r#"{{"start_index": {}, "end_index": {}, "height": {height}}}"#,
        run.start_index, run.end_index
    )
}

fn interruptions(out: &mut Formatter<'_>, breaks: &Interruptions) -> fmt::Result {
    write!(
        out,
        r#"{{"count": {}, "length": {}, "longest": {}, "longest_index": {}, "open_air": "#,
        breaks.count,
        Number(Some(breaks.length)),
        Number(Some(breaks.longest)),
        Index(breaks.longest_index),
    )?;
    list(out, &breaks.open_air, |out, crossing| {
        let length = Number(Some(crossing.length));
        write!(out, r#"{{"index": {}, "length": {length}}}"#, crossing.index)
    })?;
    out.write_char('}')
}

fn verdict(out: &mut Formatter<'_>, verdict: &Verdict) -> fmt::Result {
    let severity = match verdict.severity {
        Severity::Forbids => "forbids",
        Severity::Warns => "warns",
    };
    let place = verdict.place;
    write!(
        out,
        r#"{{"rule": "{}", "severity": "{severity}", "index": {}, "layer": {}, "height": {}, "count": {}, "text": "#,
        verdict.rule.name(),
        Index(place.map(|place| place.index)),
        Index(place.and_then(|place| place.layer)),
        Number(place.and_then(|place| place.height)),
        verdict.count,
    )?;
    quoted(out, &verdict.text)?;
    out.write_char('}')
}

fn list<T>(
    out: &mut Formatter<'_>,
    items: &[T],
    each: impl Fn(&mut Formatter<'_>, &T) -> fmt::Result,
) -> fmt::Result {
    out.write_char('[')?;
    for (index, item) in items.iter().enumerate() {
        if index > 0 {
            out.write_str(", ")?;
        }
        each(out, item)?;
    }
    out.write_char(']')
}

/// A line, or null.
struct Index(Option<usize>);

impl Display for Index {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(index) => write!(out, "{index}"),
            None => out.write_str("null"),
        }
    }
}

/// The shortest text of a length, or null. Sums of relative moves end in digits of rounding, far below what a printer
/// knows; they are dropped.
struct Number(Option<f64>);

impl Display for Number {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        const FINEST: f64 = 1e9;
        const LARGEST: f64 = 1e6;
        let Some(value) = self.0.filter(|value| value.is_finite()) else { return out.write_str("null") };
        let value = if value.abs() < LARGEST { (value * FINEST).round() / FINEST } else { value };
        // A minus before a zero means nothing.
        write!(out, "{}", value + 0.0)
    }
}

fn quoted(out: &mut Formatter<'_>, text: &str) -> fmt::Result {
    out.write_char('"')?;
    for letter in text.chars() {
        match letter {
            '"' | '\\' => write!(out, "\\{letter}")?,
            control if control < ' ' => write!(out, "\\u{:04x}", u32::from(control))?,
            letter => out.write_char(letter)?,
        }
    }
    out.write_char('"')
}
