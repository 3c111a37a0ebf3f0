//! `clayforge check`.

use crate::args::Check;
use crate::craft::read;
use crate::output::print;
use crate::profile;
use crate::report::{Done, Stop};
use clayforge::clay_processor::{Model, Report, process, to_json};
use serde_json::Value as Json;
use std::fmt::Write;

/// Says what a file is made of.
pub fn run(check: &Check) -> Done {
    let machine = check.profile.as_deref().map(profile::read).transpose()?.map(|profile| profile.machine);
    let text = read(&check.file)?;
    let mut report = process(&text);
    let mut faults = Vec::new();
    if let Some(machine) = &machine {
        let room = machine.bed.z.mm();
        if report.machine.max_height > room {
            faults.push(format!(
                "the print is {} mm high and the printer {room} mm",
                report.machine.max_height
            ));
        }
    }
    if report.machine.layers.is_empty() && report.machine.spirals.is_empty() {
        faults.push("nothing is printed in this file".to_owned());
    }
    report.ok &= faults.is_empty();
    if check.json {
        print(&format!("{}\n", with_faults(&report, &faults)))?;
    } else {
        print(&described(&check.file.display().to_string(), &report, &faults))?;
    }
    if report.ok { Ok(()) } else { Err(Stop::Fault) }
}

/// The report as JSON; what only a caller that knows the printer can find stands among the notes.
fn with_faults(report: &Report, faults: &[String]) -> String {
    let text = to_json(report);
    if faults.is_empty() {
        return text;
    }
    let Ok(Json::Object(mut whole)) = serde_json::from_str(&text) else { return text };
    if let Some(Json::Array(notes)) = whole.get_mut("notes") {
        notes.extend(faults.iter().cloned().map(Json::String));
    }
    Json::Object(whole).to_string()
}

fn described(name: &str, report: &Report, faults: &[String]) -> String {
    let mut text = format!("{name}: {} lines, {} that print\n", report.lines, report.extruding_lines);
    // Writing to a string cannot fail.
    for (who, model) in [("machine", &report.machine), ("letter", &report.letter)] {
        let _ = writeln!(text, "  {who:8} {}", counts(model));
    }
    let gaps = &report.interruptions;
    let _ = writeln!(
        text,
        "  {} breaks in the printing, {:.1} mm in all, the longest {:.1} mm",
        gaps.count, gaps.length, gaps.longest
    );
    for note in &report.notes {
        let _ = writeln!(text, "  note: {}", note.text);
    }
    for fault in faults {
        let _ = writeln!(text, "  fault: {fault}");
    }
    if faults.is_empty() && !report.ok {
        let _ = writeln!(text, "  fault: something is printed at an unknown height, or not above the bed");
    }
    text.push_str(if report.ok { "ok\n" } else { "not ok\n" });
    text
}

fn counts(model: &Model) -> String {
    format!(
        "{} layers, {} spirals, up to {} mm; without extrusion {} moves across, {} up or down, {} aslant",
        model.layers.len(),
        model.spirals.len(),
        model.max_height,
        model.horizontal_movement_without_extrusion.len(),
        model.vertical_movement_without_extrusion.len(),
        model.diagonal_movement_without_extrusion.len()
    )
}
