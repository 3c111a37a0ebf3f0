//! All stages at once, on every example and on the parts of the specification, in both chains.
//!
//! That a file can be sliced at all says that it passed our own check: never below the bed, never outside it.

use crate::parts::assert_plain;
use crate::support::{Run, assert_same, clay, craft, example, meshes, sliced, stl};
use clayforge::{Notes, Profile, STAGES};
use rayon::prelude::*;
use skein::{Line, Nozzle, Skein};

/// A part with the settings it is printed with.
#[derive(Clone)]
struct Part {
    name: &'static str,
    stl: Vec<u8>,
    settings: &'static [(&'static str, &'static str)],
}

/// The examples, in few thick layers, and the meshes of the specification.
fn parts() -> Vec<Part> {
    const COARSE: &[(&str, &str)] = &[
        ("machine.nozzle", "5"),
        ("carve.layer_height", "3"),
        ("carve.first_layer_height", "3"),
        ("carve.bead_width", "6"),
    ];
    let examples = ["bowl", "cube", "cup", "pair", "tile", "vase"];
    let examples = examples.map(|name| Part { name, stl: example(name), settings: COARSE });
    let meshes = meshes().into_iter().map(|(name, part)| Part { name, stl: stl(&part), settings: &[] });
    examples.into_iter().chain(meshes).collect()
}

/// A profile in which all stages work but one: a spiral has no copies, so `multiply` and `coil` are never on together.
pub fn everything(chain: &str, but: &str) -> Profile {
    let mut profile =
        clay(&[("chain", chain), ("machine.bed", "[600, 600, 400]"), ("home.lines", "\"G28 X Y\"")]);
    profile.set("multiply.rows", "1").unwrap_or_else(|error| panic!("{error}"));
    for entry in STAGES {
        let active = if entry.name == but { "false" } else { "true" };
        profile.set(&format!("{}.active", entry.name), active).unwrap_or_else(|error| panic!("{error}"));
    }
    profile
}

/// The skein of which the file is made.
fn last_skein(run: &Run) -> Skein {
    let last = run.texts.iter().rev().nth(1).expect("stages before export");
    Skein::read(&last.1).unwrap_or_else(|error| panic!("{}: {error}", last.0))
}

#[test]
fn a_2_all_stages_at_once_make_a_sound_file_of_every_part() {
    // A spiral is wound on pots; on all other parts it stands aside.
    let pots = ["cup", "vase", "cyl", "ring"];
    let hows = |part: &Part| {
        let spiral = pots.contains(&part.name).then_some(("clay", "multiply"));
        [("clay", "coil"), ("seed", "coil")].into_iter().chain(spiral)
    };
    let jobs: Vec<_> =
        parts().into_iter().flat_map(|part| hows(&part).map(move |how| (part.clone(), how))).collect();
    jobs.par_iter().for_each(|(Part { name, stl: part, settings }, (chain, but))| {
        let what = format!("{name}, {chain}, all but {but}");
        let mut profile = everything(chain, but);
        for (key, value) in *settings {
            profile.set(key, value).unwrap_or_else(|error| panic!("{error}"));
        }
        let run = sliced(&what, part, &profile);
        let mut text = part.clone();
        for station in profile.chain().unwrap_or_else(|error| panic!("{what}: {error}")) {
            let stage = station.entry.name;
            text = craft(stage, &text, &profile, &mut Notes::default())
                .unwrap_or_else(|error| panic!("{what}: {stage}: {error}"));
            // What comes before carve is not made text in memory.
            if let Some((_, made)) = run.texts.iter().find(|(name, _)| *name == stage) {
                assert_same(made, &text, &format!("{what}: {stage} as text (+) and in memory (-)"));
                assert_plain(made, &format!("{what}: {stage}"));
            }
        }
        assert_same(run.gcode(), &text, &what);
        let mut nozzle = Nozzle::default();
        for (index, line) in last_skein(&run).lines().enumerate() {
            if let Line::Move(step) = line {
                let pushes = step.extrusion.is_some_and(|amount| amount.get() != 0);
                assert!(nozzle.on || !pushes, "{what}: clay on a travel, line {}: {line:?}", index + 1);
            }
            nozzle.follow(line);
        }
        let report = clayforge::clay_processor::process(run.gcode());
        assert!(report.ok(), "{what}: {:?}", report.verdicts);
    });
}
