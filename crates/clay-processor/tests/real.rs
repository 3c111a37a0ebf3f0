//! Files as PrusaSlicer 2.5, Slic3r 1.3 and CuraEngine 4.13 wrote them for `examples/pair.stl` and `examples/vase.stl`,
//! cut after a few layers: the layers are those that the files' own remarks and Z lines name.

use std::fs;
use std::path::Path;

use clay_processor::{Report, Rule, Severity, process};

fn read(name: &str) -> (String, Report) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/real").join(name);
    let text = fs::read_to_string(path).expect("a file of `tests/real`");
    let report = process(text.as_bytes());
    (text, report)
}

/// The heights of the layers as the file itself names them.
fn named(text: &str) -> Vec<f64> {
    let number = |text: &str| text.parse::<f64>().expect("a height");
    let lines: Vec<&str> = text.lines().collect();
    if lines.iter().any(|line| line.starts_with(";LAYER_COUNT:")) {
        // Cura: `;Layer height: 1.5` and `;LAYER:n`, counted from 0.
        let height = lines.iter().find_map(|line| line.strip_prefix(";Layer height: ")).map(number);
        let layers = lines.iter().filter_map(|line| line.strip_prefix(";LAYER:")).map(number);
        layers.map(|layer| (layer + 1.0) * height.expect("it says its layer height")).collect()
    } else if lines.contains(&";LAYER_CHANGE") {
        // PrusaSlicer: `;Z:1.5` behind `;LAYER_CHANGE`.
        lines.iter().filter_map(|line| line.strip_prefix(";Z:")).map(number).collect()
    } else {
        // Slic3r says nothing; a layer begins with a Z on a line of its own, behind the lift of the start.
        let alone = lines.iter().filter(|line| line.starts_with("G1 Z") && line.contains(" F7800"));
        alone.filter_map(|line| line.split([' ', 'Z']).nth(2)).map(number).collect()
    }
}

#[test]
fn the_layers_of_planar_files_are_those_they_name() {
    for name in [
        "prusa-2.5-pair.gcode",
        "prusa-2.5-pair-hops.gcode",
        "slic3r-1.3-pair.gcode",
        "cura-4.13-pair.gcode",
        "cura-4.13-pair-hops.gcode",
    ] {
        let (text, report) = read(name);
        let found: Vec<f64> = report.machine.layers.iter().filter_map(|layer| layer.height).collect();
        assert_eq!(found, named(&text), "{name}");
        assert_eq!(found.len(), 3, "{name}: the case has lost its point");
        assert!(report.machine.spirals.is_empty(), "{name}");
        // Two parts beside each other.
        assert!(report.interruptions.count >= 3, "{name}: {:?}", report.interruptions);
        judged(name, &report);
    }
}

#[test]
fn the_spiral_of_a_vase_stands_on_its_base() {
    for name in ["prusa-2.5-vase.gcode", "slic3r-1.3-vase.gcode", "cura-4.13-vase.gcode"] {
        let (text, report) = read(name);
        let named = named(&text);
        let base: Vec<f64> = report.machine.layers.iter().filter_map(|layer| layer.height).collect();
        assert_eq!(base, named[..base.len()], "{name}: {:?}", report.machine.layers);
        assert_eq!(report.machine.spirals.len(), 1, "{name}");
        let (spiral, pitch) = (report.machine.spirals[0], report.pitches[0]);
        let step = named[named.len() - 1] - named[named.len() - 2];
        let floor = base[base.len() - 1];
        let start = spiral.height.expect("it is known") - floor;
        assert!(start > 0.0 && start < step, "{name}: {start}");
        // A layer is a turn. PrusaSlicer says where it ends, the others where it begins.
        let top = pitch.top.expect("it is known");
        let begins = if name.starts_with("prusa") { 0.0 } else { step };
        assert!((top - named[named.len() - 1] - begins).abs() < 0.01, "{name}: {top}");
        assert!((pitch.turns - (top - floor) / step).abs() < 0.35, "{name}: {pitch:?}");
        assert!((pitch.rise.expect("whole turns") / step - 1.0).abs() < 0.05, "{name}: {pitch:?}");
        judged(name, &report);
    }
}

/// Nothing forbids them, and what is said of them is true.
#[track_caller]
fn judged(name: &str, report: &Report) {
    let may = [Rule::Heats, Rule::Interrupted, Rule::ColdExtrusion, Rule::InAir, Rule::OpenAir];
    for verdict in &report.verdicts {
        assert_eq!(verdict.severity, Severity::Warns, "{name}: {verdict:?}");
        assert!(may.contains(&verdict.rule), "{name}: {verdict:?}");
    }
    assert!(report.verdicts.iter().any(|verdict| verdict.rule == Rule::ColdExtrusion), "{name}");
}
