//! The snippets of the specification, with the results that it gives for both models.

use clay_processor::{Model, Report, Rule, Run, process, to_json};
use serde_json::{Value, json};

#[test]
fn every_snippet_has_the_specified_results() {
    let snippets: Vec<Value> =
        serde_json::from_str(include_str!("snippets.json")).expect("snippets.json is JSON");
    assert_eq!(snippets.len(), 22);
    for snippet in &snippets {
        let name = &snippet["name"];
        let text = snippet["gcode"].as_str().expect("a snippet has G-code");
        let report = process(text.as_bytes());
        assert_eq!(in_short(&report.letter), snippet["L"], "{name} by the letter:\n{text}");
        assert_eq!(in_short(&report.machine), snippet["M"], "{name} by the machine:\n{text}");

        let crlf = process(text.replace('\n', "\r\n").as_bytes());
        assert_eq!(crlf, report, "{name} with CR and LF");
    }
}

#[test]
fn a_note_explains_every_difference_and_nothing_else() {
    let snippets: Vec<Value> =
        serde_json::from_str(include_str!("snippets.json")).expect("snippets.json is JSON");
    for snippet in &snippets {
        let name = snippet["name"].as_str().unwrap_or_default();
        let report = process(snippet["gcode"].as_str().unwrap_or_default().as_bytes());
        let habits: Vec<String> = report.notes.iter().map(|note| format!("{:?}", note.habit)).collect();
        let expected: &[&str] = match name {
            "S01" => &["LeadingTravel"],
            "S05" => &["RapidLayerChange", "RepeatedPosition"],
            "S07" => &["RelativeZ"],
            "S08" => &["ResetInSpiral"],
            "S14" => &["LeadingTravel", "Hop"],
            "S15" => &["Parking", "RelativeZ"],
            "S17" => &["RoundedZ"],
            "S18" => &["RepeatedZ", "SilentE"],
            "S20" => &["LeadingTravel", "SilentE"],
            _ => &[],
        };
        assert_eq!(habits, expected, "{name}: {:#?}", report.notes);
    }
}

#[test]
fn the_json_of_a_report_has_the_agreed_shape() {
    let report = process(b"; \"a\\cup\"\nG0 X0 Y0\nG1 Z1.5\nG1 X10 E1\nG1 X0 E2\nG0 X5 Z2\n; end\n");
    let found: Value = serde_json::from_str(&to_json(&report)).expect("the report is JSON");
    let model = json!({
        "first_part_comments_end": 0,
        "last_part_comments_start": 6,
        "max_height": 2,
        "layers": [{"start_index": 3, "end_index": 4, "height": 1.5}],
        "spirals": [],
        "horizontal_movement_without_extrusion": [{"index": 1, "height": null}],
        "vertical_movement_without_extrusion": [{"index": 2, "from": null, "to": 1.5}],
        "diagonal_movement_without_extrusion": [{"index": 5}],
    });
    let mut machine = model.clone();
    machine["max_height"] = json!(1.5);
    let object = found.as_object().expect("an object");
    assert_eq!(
        object.keys().collect::<Vec<_>>(),
        ["interruptions", "letter", "machine", "notes", "ok", "verdicts"]
    );
    let parts = ["letter", "machine", "notes", "ok"].map(|key| found[key].clone());
    assert_eq!(parts, [model, machine, json!([]), json!(true)]);
    let breaks = json!({"count": 0, "length": 0, "longest": 0, "longest_index": null, "open_air": []});
    assert_eq!(found["interruptions"], breaks);
    let verdict = &found["verdicts"][0];
    assert_eq!(verdict["rule"], json!("cold_extrusion"), "{found:#}");
    assert_eq!(verdict["severity"], json!("warns"));
    let place = ["index", "layer", "height", "count"].map(|key| verdict[key].clone());
    assert_eq!(place, [json!(3), json!(0), json!(1.5), json!(1)]);
    assert!(
        verdict["text"].as_str().is_some_and(|text| text.starts_with("line 4 (layer 1, z 1.5): E moves"))
    );
}

#[test]
fn the_json_of_a_long_sum_is_short() {
    let report = process(b"G91\nM83\nG92 Z0\nG1 Z0.1\nG1 Z0.2\nG1 X1 E1\nG1 X1 E1\n");
    assert_ne!(report.machine.layers[0].height, Some(0.3), "the case has lost its point");
    assert!(to_json(&report).contains(r#""height": 0.3}"#));
}

#[test]
fn an_empty_file_prints_nothing() {
    for text in ["", "\u{feff}"] {
        let report = process(text.as_bytes());
        assert_eq!(report.verdicts[0].rule, Rule::NothingPrinted);
        assert_eq!(Report { verdicts: Vec::new(), ..report }, Report::default());
    }
    assert_eq!(process(b"\n\n").lines, 2);
    assert_eq!(process(b"\n\n").letter.first_part_comments_end, None);
}

/// A model as the snippets write it.
fn in_short(model: &Model) -> Value {
    let runs = |runs: &[Run]| -> Vec<Value> {
        runs.iter().map(|run| json!([run.start_index, run.end_index, run.height])).collect()
    };
    let horizontal = &model.horizontal_movement_without_extrusion;
    let vertical = &model.vertical_movement_without_extrusion;
    let diagonal = &model.diagonal_movement_without_extrusion;
    json!({
        "first": model.first_part_comments_end,
        "last": model.last_part_comments_start,
        "layers": runs(&model.layers),
        "spirals": runs(&model.spirals),
        "h": horizontal.iter().map(|travel| json!([travel.index, travel.height])).collect::<Vec<_>>(),
        "v": vertical.iter().map(|lift| json!([lift.index, lift.from, lift.to])).collect::<Vec<_>>(),
        "d": diagonal.iter().map(|travel| travel.index).collect::<Vec<_>>(),
    })
}
