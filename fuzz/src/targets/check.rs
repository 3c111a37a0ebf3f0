//! The clay processor.

use super::{Target, assert_equal, gcode, size};
use clay_processor::{Options, Processor, process, to_json};

pub(super) const TARGET: Target = Target {
    name: "check",
    law: "any bytes have a report, the same one however they come in pieces",
    run,
    dictionary: gcode::WORDS,
    most: 32_768,
};

fn run(bytes: &[u8]) -> String {
    let report = process(bytes);
    let mut processor = Processor::new(Options::default());
    for piece in bytes.chunks(7) {
        processor.push(piece);
    }
    assert_equal(&to_json(&processor.finish()), &to_json(&report), "in pieces");
    let rules: Vec<String> = report.verdicts.iter().map(|verdict| format!("{:?}", verdict.rule)).collect();
    let model = &report.machine;
    format!("{} {} {}", size(model.layers.len()), size(model.spirals.len()), rules.join(" "))
}
