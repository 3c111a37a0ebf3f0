//! Laws that hold for every file.

use clay_processor::{Bed, Firmware, LayerHeights, Limits, Options, Processor, process, to_json};
use gcode::lines;
use proptest::prelude::*;

/// Lines that mean something to the models, with odd bytes in between.
fn text() -> impl Strategy<Value = Vec<u8>> {
    let word = prop_oneof![
        8 => "[XYZE]-?[0-3]([.][0-9]{1,3})?",
        1 => "[XYZEIJRF]-?[0-9]{0,30}[.]?[0-9]{0,3}",
        1 => prop::sample::select(vec![";Z1", "(E)", "*7", "%", "Z", "é"]).prop_map(String::from),
    ];
    let command = prop::sample::select(vec![
        "G1", "G1", "G1", "g1", "G0", "G2", "G3", "G28", "G92", "G91", "G90", "M82", "M83", "G20", "G21", "",
        "N5 G1", "M106", "M84", "M302", "M104", "M2",
    ]);
    let line = (command, prop::collection::vec(word, 0..5)).prop_map(|(command, words)| {
        let mut line = String::from(command);
        for word in words {
            line.push(' ');
            line.push_str(&word);
        }
        line.into_bytes()
    });
    let any_line = prop_oneof![9 => line, 1 => prop::collection::vec(any::<u8>(), 0..20)];
    prop::collection::vec(any_line, 0..60).prop_map(|lines| lines.join(&b'\n'))
}

/// A printer so small that most lines break a rule.
const TINY: Limits = Limits {
    bed: Some(Bed { least: (0.0, 0.0), greatest: (2.0, 2.0), round: true, height: 2.0 }),
    layers: Some(LayerHeights { first: 1.0, rest: 0.5 }),
    bead_width: Some(0.5),
    e_per_mm3: Some(1.0),
    max_e_speed: Some(1.0),
    max_flow: Some(0.5),
    heated: Some(false),
    firmware: Some(Firmware::Marlin),
    longest_e: Some(1.0),
};

proptest! {
    #[test]
    fn any_file_is_judged(text in text()) {
        let mut processor = Processor::new(Options { limits: TINY, ..Options::default() });
        processor.push(&text);
        let report = processor.finish();
        let lines = report.lines;
        for verdict in &report.verdicts {
            prop_assert!(verdict.place.is_none_or(|place| place.index < lines), "{:?}", verdict);
            prop_assert!(verdict.count >= 1 && verdict.count <= lines.max(1), "{:?}", verdict);
            prop_assert!(!verdict.text.contains("NaN") && !verdict.text.contains("inf "), "{:?}", verdict);
        }
        let sorted = report.verdicts.is_sorted_by_key(|verdict| (verdict.severity, verdict.rule));
        prop_assert!(sorted, "{:?}", report.verdicts);
        prop_assert_eq!(report.pitches.len(), report.machine.spirals.len());
    }

    #[test]
    fn any_file_has_a_report(text in text()) {
        let report = process(&text);
        prop_assert_eq!(report.lines, lines(&text).count());
        let json: serde_json::Value = serde_json::from_str(&to_json(&report)).expect("the report is JSON");
        prop_assert_eq!(json["letter"]["layers"].as_array().map(Vec::len), Some(report.letter.layers.len()));
    }

    #[test]
    fn any_bytes_have_a_report(text in prop::collection::vec(any::<u8>(), 0..300)) {
        prop_assert_eq!(process(&text).lines, lines(&text).count());
    }

    #[test]
    fn the_cuts_between_pieces_do_not_matter(text in text(), cuts in prop::collection::vec(0.0..1.0, 0..8)) {
        let mut cuts: Vec<usize> = cuts.iter().map(|cut: &f64| (cut * text.len() as f64) as usize).collect();
        cuts.sort_unstable();
        let mut pieces = Processor::new(Options::default());
        let mut start = 0;
        for end in cuts.into_iter().chain([text.len()]) {
            pieces.push(&text[start..end]);
            start = end;
        }
        let mut by_line = Processor::default();
        for line in lines(&text) {
            by_line.feed_line(line);
        }
        let whole = process(&text);
        prop_assert_eq!(&pieces.finish(), &whole);
        prop_assert_eq!(&by_line.finish(), &whole);
    }

    #[test]
    fn runs_are_in_order_and_apart(text in text()) {
        let report = process(&text);
        for model in [&report.letter, &report.machine] {
            for runs in [&model.layers, &model.spirals] {
                prop_assert!(runs.iter().all(|run| run.start_index < run.end_index));
                prop_assert!(runs.windows(2).all(|pair| pair[0].end_index < pair[1].start_index));
            }
            for layer in &model.layers {
                let apart = |spiral: &clay_processor::Run| {
                    spiral.end_index < layer.start_index || layer.end_index < spiral.start_index
                };
                prop_assert!(model.spirals.iter().all(apart));
            }
        }
    }

    #[test]
    fn models_that_differ_have_a_note(text in text()) {
        let report = process(&text);
        let (mut letter, mut machine) = (report.letter, report.machine);
        letter.max_height = 0.0;
        machine.max_height = 0.0;
        prop_assert!(letter == machine || !report.notes.is_empty());
    }
}
