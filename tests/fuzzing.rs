//! A short run of every fuzz target: the seeds, and as many mutations of them as fit into a gate.

use fuzz::{Session, TARGETS, corpus, seeds};
use std::collections::BTreeSet;

/// Inputs of a target beside its seeds; a whole part goes through both chains in the time of a hundred small texts.
fn inputs(target: &str) -> usize {
    match target {
        "chain" | "stages" => 20,
        "emulate" | "edit" | "gcode" => 100,
        _ => 300,
    }
}

fn bytes_of(target: &str) -> Vec<Vec<u8>> {
    let folder = corpus().join(target);
    let seeds = seeds(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    seeds.into_iter().map(|(_, bytes)| bytes).collect()
}

#[test]
fn no_target_breaks_on_its_seeds_and_what_is_made_of_them() {
    let mut found = Vec::new();
    for target in TARGETS {
        let mut session = Session::new(target, bytes_of(target.name), 1);
        let mut findings = session.replay(|_| {});
        findings.extend((0..inputs(target.name)).filter_map(|_| session.step(|_| {})));
        found.extend(findings.into_iter().map(|finding| {
            format!("{}: {}\n{:?}", target.name, finding.message, String::from_utf8_lossy(&finding.input))
        }));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// A seed that is refused at once, like all others, is no help.
#[test]
fn the_seeds_of_a_target_come_to_different_things() {
    for target in TARGETS {
        let seeds = bytes_of(target.name);
        let said: BTreeSet<String> = seeds.iter().map(|seed| (target.run)(seed)).collect();
        assert!(seeds.len() > 1 && said.len() * 2 >= seeds.len(), "{}: {said:?}", target.name);
    }
}

#[test]
fn the_seeds_are_small_and_each_folder_has_a_target() {
    let mut folders: Vec<String> =
        crate::support::folders(&corpus()).iter().map(|path| crate::support::name_of(path)).collect();
    let mut names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
    folders.sort();
    names.sort_unstable();
    assert_eq!(folders, names);
    let size: usize = names.iter().flat_map(|name| bytes_of(name)).map(|seed| seed.len()).sum();
    assert!(size < 300_000, "{size} bytes of seeds");
}
