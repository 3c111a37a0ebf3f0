//! Writes a report for scripts.

use std::fmt::Write;

use crate::report::{Model, Report, Run};

/// The report as `clayforge check --json` prints it: one object with `letter`, `machine`, `notes` and `ok`, without a
/// line end. What is unknown is `null`.
///
/// ```
/// let json = clay_processor::to_json(&clay_processor::process(b"; a cup\nG1 Z1.50\n"));
/// assert!(json.contains(r#""vertical_movement_without_extrusion": [{"index": 1, "from": null, "to": 1.5}]"#));
/// ```
pub fn to_json(report: &Report) -> String {
    let letter = model(&report.letter);
    let machine = model(&report.machine);
    let notes = list(report.notes.iter().map(|note| quoted(&note.text)));
    format!(r#"{{"letter": {letter}, "machine": {machine}, "notes": {notes}, "ok": {}}}"#, report.ok)
}

fn model(model: &Model) -> String {
    let horizontal = model
        .horizontal_movement_without_extrusion
        .iter()
        .map(|travel| format!(r#"{{"index": {}, "height": {}}}"#, travel.index, number(travel.height)));
    let vertical = model.vertical_movement_without_extrusion.iter().map(|lift| {
        format!(r#"{{"index": {}, "from": {}, "to": {}}}"#, lift.index, number(lift.from), number(lift.to))
    });
    let diagonal = model
        .diagonal_movement_without_extrusion
        .iter()
        .map(|travel| format!(r#"{{"index": {}}}"#, travel.index));
    let members = [
        ("first_part_comments_end", index(model.first_part_comments_end)),
        ("last_part_comments_start", index(model.last_part_comments_start)),
        ("max_height", number(Some(model.max_height))),
        ("layers", list(model.layers.iter().map(run))),
        ("spirals", list(model.spirals.iter().map(run))),
        ("horizontal_movement_without_extrusion", list(horizontal)),
        ("vertical_movement_without_extrusion", list(vertical)),
        ("diagonal_movement_without_extrusion", list(diagonal)),
    ];
    let members: Vec<String> = members.iter().map(|(name, value)| format!(r#""{name}": {value}"#)).collect();
    format!("{{{}}}", members.join(", "))
}

fn run(run: &Run) -> String {
    let height = number(run.height);
    format!(r#"{{"start_index": {}, "end_index": {}, "height": {height}}}"#, run.start_index, run.end_index)
}

fn list(items: impl Iterator<Item = String>) -> String {
    let mut text = String::from("[");
    for (index, item) in items.enumerate() {
        if index > 0 {
            text.push_str(", ");
        }
        text.push_str(&item);
    }
    text.push(']');
    text
}

fn index(index: Option<usize>) -> String {
    index.map_or_else(|| String::from("null"), |index| index.to_string())
}

/// The shortest text of a length. Sums of relative moves end in digits of rounding, far below what a printer knows;
/// they are dropped.
fn number(value: Option<f64>) -> String {
    const FINEST: f64 = 1e9;
    const LARGEST: f64 = 1e6;
    let Some(value) = value.filter(|value| value.is_finite()) else { return String::from("null") };
    let value = if value.abs() < LARGEST { (value * FINEST).round() / FINEST } else { value };
    // A zero has no sign here.
    if value == 0.0 { String::from("0") } else { value.to_string() }
}

fn quoted(text: &str) -> String {
    let mut quoted = String::with_capacity(text.len() + 2);
    quoted.push('"');
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            control if control < ' ' => {
                // Writing to a string cannot fail.
                let _ = write!(quoted, "\\u{:04x}", u32::from(control));
            }
            letter => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}
