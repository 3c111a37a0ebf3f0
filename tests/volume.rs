//! What the stages do to the clay of each layer: it stays as it is, unless changing it is what the stage is for.

use crate::everything::everything;
use crate::support::{clay, cuboid, example, meshes, stl};
use clayforge::{Document, Event, Profile, STAGES, slice};
use rayon::prelude::*;
use skein::{Feature, Line, Ring, Skein, Value, boundary};
use std::collections::{BTreeMap, BTreeSet};

/// The clay that lies at one height.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Clay {
    /// What the part is made of, in mm³.
    part: f64,
    /// What lies beside it and below it: skirt, raft and support, in mm³.
    beside: f64,
    /// What the outlines hold, in mm³.
    room: f64,
    /// The nominal section of a bead, in mm².
    section: f64,
    threads: usize,
    moves: usize,
}

/// The clay of every layer by its height, from the lowest up.
fn clays(skein: &Skein) -> Vec<Clay> {
    let facts = skein.facts().expect("facts");
    let bead = facts.bead().expect("a bead");
    let mut clays: BTreeMap<i32, Clay> = BTreeMap::new();
    for (layer, mut nozzle) in skein.layers.iter().zip(skein.nozzles()) {
        let clay = clays.entry(layer.z().0).or_default();
        clay.section = bead.of_height(layer.height(&facts).expect("a height")).area();
        let rings = boundary(&layer.lines);
        let area: f64 = rings.iter().map(Ring::area).sum();
        clay.room += area * layer.height(&facts).expect("a height").mm();
        for line in &layer.lines {
            if let (true, Some(from), Some(_)) = (nozzle.on, nozzle.at, line.as_move()) {
                let volume = line.length(from) / 1000.0 * clay.section * nozzle.flow.f64();
                match nozzle.feature() {
                    Feature::Skirt | Feature::Raft | Feature::Support => clay.beside += volume,
                    _ => clay.part += volume,
                }
                clay.moves += 1;
            }
            clay.threads += usize::from(*line == Line::On);
            nozzle.follow(line);
        }
    }
    clays.into_values().collect()
}

/// The clay behind every stage of a slicing.
fn of_every_stage(name: &str, part: &[u8], profile: &Profile) -> Vec<(&'static str, Vec<Clay>)> {
    let mut found = Vec::new();
    let mut watch = |event: Event<'_>| {
        if let Event::Done { name, document: Document::Skein(skein), .. } = event {
            found.push((name, clays(skein)));
        }
        Ok(())
    };
    slice(part, profile, None, &mut watch, &mut |_| Ok(())).unwrap_or_else(|error| panic!("{name}: {error}"));
    found
}

/// How much clay of a layer a stage may take or add.
#[derive(Clone, Copy, Default)]
struct Most {
    /// Of the clay of the layer.
    share: f64,
    /// Millimetres of bead for each thread.
    thread: f64,
    /// Millimetres of bead for each move.
    step: f64,
    /// Millimetres of bead once in the whole print.
    once: f64,
    /// Of the room inside the outlines.
    room: f64,
}

const NOTHING: Most = Most { share: 0.0, thread: 0.0, step: 0.0, once: 0.0, room: 0.0 };

/// The width of the beads, in mm.
const WIDTH: f64 = 3.2;

/// The greatest flow that fill gives a bead.
const FULLEST: f64 = 1.34;

/// The stages that change the clay of the layers, at their defaults and with beads of 3.2 by 1.5 mm: what they take at
/// most, what they add at most, and why.
#[rustfmt::skip]
const CHANGES: &[(&str, Most, Most, &str)] = &[
    ("inset", NOTHING, Most { room: FULLEST, ..NOTHING }, "lays the outermost wall; in a thin part it lies twice"),
    ("fill", Most { share: FULLEST - 1.0, ..NOTHING }, Most { room: 1.05, ..NOTHING },
        "lays the inner walls and the infill; walls that face each other share their clay"),
    ("clip", Most { thread: WIDTH, ..NOTHING }, NOTHING, "ends each wall half a width early on either side"),
    ("stretch", NOTHING, Most { thread: std::f64::consts::TAU * 0.32 * WIDTH, ..NOTHING },
        "a wall round a hole is laid up to 0.32 widths further out"),
    ("oozebane", Most { thread: 6.0, ..NOTHING }, Most { thread: 3.0, once: 15.0, ..NOTHING },
        "stops up to 6 mm before the end and starts up to 3 mm, the first time 15 mm, before the beginning"),
    ("dwindle", Most { thread: (20.0 + 150.0 / 2.0) / (WIDTH * 1.5), ..NOTHING }, NOTHING,
        "leaves the pent-up 20 mm³ out, and half of the last 150 mm³"),
    ("splodge", NOTHING, Most { thread: 3.01, once: 30.0, ..NOTHING }, "lays 3 mm of bead more at each start, 30 mm at the first"),
    ("fillet", Most { step: 2.0 * 0.35 * WIDTH, ..NOTHING }, NOTHING, "cuts corners 0.35 widths before and behind them"),
];

impl Most {
    fn of(&self, clay: &Clay) -> f64 {
        let beads = self.thread * clay.threads as f64 + self.step * clay.moves as f64 + self.once;
        self.share * (clay.part + clay.beside) + self.room * clay.room + beads * clay.section * FULLEST
    }
}

/// What is wrong with the clay behind a stage that works, if anything is; and whether it has changed any.
fn judged(stage: &str, copies: f64, before: &[Clay], after: &[Clay]) -> Result<bool, String> {
    // A raft goes below what was there.
    let lower = after.len().checked_sub(before.len()).ok_or("layers are gone")?;
    let (below, after) = after.split_at(lower);
    if let Some(layer) = below.iter().position(|clay| clay.part > 0.0) {
        return Err(format!("{lower} layers are new, and layer {layer} has clay of the part"));
    }
    let (_, takes, adds, _) =
        CHANGES.iter().find(|(name, ..)| *name == stage).copied().unwrap_or((stage, NOTHING, NOTHING, ""));
    let builds_beside = matches!(stage, "raft" | "skirt");
    let mut changed = lower > 0;
    for (layer, (old, new)) in before.iter().zip(after).enumerate() {
        let all = |clay: &Clay| if builds_beside { clay.part } else { clay.part + clay.beside };
        let more = all(new) - all(old) * copies;
        // Every place is rounded to the micron, and every flow to the millionth.
        let rounding = 2e-3 * (old.moves + new.moves) as f64 * old.section * FULLEST + 1e-5 * all(old);
        changed |= more.abs() > rounding || (builds_beside && new.beside > old.beside);
        if more < -takes.of(old) - rounding || more > adds.of(old) + rounding {
            return Err(format!(
                "layer {layer} has {more:+.2} mm³ of {:.2} mm³; from {old:?} to {new:?}",
                all(old)
            ));
        }
    }
    Ok(changed)
}

/// How many times multiply lays the part.
fn copies(profile: &Profile) -> f64 {
    let count = |key: &str| match profile.get(key) {
        Some((_, Value::Number(count))) => count,
        other => panic!("{key} is {other:?}"),
    };
    count("multiply.columns") * count("multiply.rows")
}

#[test]
fn every_stage_keeps_the_clay_of_each_layer_unless_it_is_there_to_change_it() {
    let strip = stl(&cuboid([0.0; 3], [60.0, 15.0, 4.5]));
    let spec = meshes().into_iter().filter(|(name, _)| ["bridge", "ring"].contains(name));
    let mut parts = vec![("cup", example("cup")), ("pair", example("pair")), ("strip", strip)];
    parts.extend(spec.map(|(name, mesh)| (name, stl(&mesh))));
    // Each stage by itself, then all together. A spiral has a test of its own.
    let single = STAGES.iter().filter(|entry| !entry.active && entry.name != "coil").map(|entry| {
        clay(&[("machine.bed", "[600, 600, 400]"), (&format!("{}.active", entry.name), "true")])
    });
    let profiles: Vec<Profile> =
        single.chain(["clay", "seed"].map(|chain| everything(chain, "coil"))).collect();
    let jobs: Vec<(&(&str, Vec<u8>), &Profile)> =
        parts.iter().flat_map(|part| profiles.iter().map(move |profile| (part, profile))).collect();
    let found: Vec<Result<BTreeSet<&str>, String>> = jobs
        .par_iter()
        .map(|((name, part), profile)| {
            let mut changed = BTreeSet::new();
            for pair in of_every_stage(name, part, profile).windows(2) {
                let ((_, before), (stage, after)) = (&pair[0], &pair[1]);
                let works = profile.station(stage).is_some_and(|station| station.active);
                assert!(works || before == after, "{name}: {stage} is off and changes clay");
                let copies = if *stage == "multiply" { copies(profile) } else { 1.0 };
                let found = if works { judged(stage, copies, before, after) } else { Ok(false) };
                if found.map_err(|why| format!("{name}: {stage}: {why}"))? {
                    changed.insert(*stage);
                }
            }
            Ok(changed)
        })
        .collect();
    let wrong: BTreeSet<&String> = found.iter().filter_map(|found| found.as_ref().err()).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let changed: BTreeSet<&str> = found.into_iter().flatten().flatten().collect();
    let named = CHANGES.iter().map(|(stage, ..)| *stage).chain(["raft", "skirt"]).collect();
    assert_eq!(changed, named, "the stages that change clay are those that may");
}

/// The first turn of a spiral climbs from nothing to a layer, and the rim turn goes down again; between them a layer is a
/// turn. All of them together hold what fill laid of the same walls.
#[test]
fn a_spiral_holds_the_clay_of_the_walls_that_it_winds() {
    for walls in ["1", "2"] {
        let mut profile = Profile::built_in("vase").expect("vase is built in").expect("vase is sound");
        profile.set("fill.walls", walls).unwrap_or_else(|error| panic!("{error}"));
        let run = of_every_stage("vase", &example("vase"), &profile);
        let place = run.iter().position(|(stage, _)| *stage == "coil").expect("the chain has coil");
        let (before, after) = (&run[place - 1].1, &run[place].1);
        let total = |clays: &[Clay]| clays.iter().map(|clay| clay.part).sum::<f64>();
        assert!((total(after) / total(before) - 1.0).abs() < 2e-3, "{} {}", total(before), total(after));
        let shares: Vec<f64> =
            before.iter().zip(after).map(|(before, after)| after.part / before.part).collect();
        let climb = shares.iter().position(|share| (share - 0.5).abs() < 0.01).expect("a first turn");
        for (layer, share) in
            shares[..shares.len() - 1].iter().enumerate().filter(|(layer, _)| *layer != climb)
        {
            // Where the wall leans, a turn is half of this layer's length and half of the next one's.
            assert!((share - 1.0).abs() < 0.015, "{walls} walls, layer {layer}: {share}");
        }
    }
}
