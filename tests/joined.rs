//! Stages that work on threads also work on those that join has made of many beads, and interrupt none of them.

use crate::support::{clay, example, prism, stl};
use clayforge::{Document, Event, Notes, slice};
use rayon::prelude::*;
use skein::{Layer, Line};

/// What a stage does with a joined thread.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Work {
    /// It changes it.
    Changes,
    /// It cannot, and says so.
    Says,
}

/// The stages that take threads apart.
const STAGES: &[(&str, Work)] = &[
    ("clip", Work::Says),
    ("dwindle", Work::Changes),
    ("fillet", Work::Changes),
    ("jitter", Work::Says),
    ("oozebane", Work::Changes),
    ("skin", Work::Says),
    ("smooth", Work::Changes),
    ("splodge", Work::Changes),
    ("stretch", Work::Changes),
];

/// The layers behind the stage before the one named and behind itself, and what was said.
fn around(stage: &'static str, part: &[u8], through: &str) -> ([Vec<Layer>; 2], Notes) {
    let active = format!("{stage}.active");
    let profile = clay(&[("join.through_layers", through), (&active, "true"), ("machine.lag", "1")]);
    let mut layers = [Vec::new(), Vec::new()];
    let mut found = false;
    let mut watch = |event: Event<'_>| {
        if let Event::Done { name, document: Document::Skein(skein), .. } = event {
            if !found {
                layers.swap(0, 1);
                layers[1].clone_from(&skein.layers);
            }
            found |= name == stage;
        }
        Ok(())
    };
    let sliced = slice(part, &profile, None, &mut watch, &mut |_| Ok(()))
        .unwrap_or_else(|error| panic!("{stage}: {error}"));
    (layers, sliced.notes)
}

fn starts(layers: &[Layer]) -> usize {
    layers.iter().flat_map(|layer| &layer.lines).filter(|line| **line == Line::On).count()
}

#[test]
fn stages_that_work_on_threads_work_on_joined_ones() {
    // Only a wedge has an infill that can be smoothed.
    let wedge = stl(&prism(&[[0.0, 0.0], [120.0, 0.0], [0.0, 40.0]], 0.0, 6.0));
    let parts = [("cup", example("cup")), ("vase", example("vase")), ("wedge", wedge)];
    let jobs = parts.iter().flat_map(|part| ["false", "true"].map(|through| (part, through)));
    let jobs: Vec<_> = jobs.flat_map(|job| STAGES.iter().map(move |stage| (job, stage))).collect();
    jobs.into_par_iter().for_each(|(((name, part), through), (stage, work))| {
        let ([before, after], notes) = around(stage, part, through);
        let what = format!("{name}, through {through}: {stage}");
        assert_eq!(starts(&before), starts(&after), "{what} interrupts a thread");
        let changed = before != after;
        match work {
            Work::Changes => {
                assert!(changed || (*stage == "smooth" && *name != "wedge"), "{what} does nothing")
            }
            Work::Says => {
                let said = notes.iter().any(|note| note.stage == *stage && note.text.contains("`join`"));
                assert!(said, "{what} says nothing");
            }
        }
    });
}
