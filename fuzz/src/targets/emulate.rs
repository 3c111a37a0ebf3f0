//! The emulator.

use super::{Target, gcode, size};
use ::emulate::motion::ProfileType;
use ::emulate::{AdditivePart, Bead, Commands, EventOptions, EventSeries, Machine, PolyData, Table};
use ::gcode::{Flavor, Limits, Preprocessor};
use clayforge::Profile;

pub(super) const TARGET: Target = Target {
    name: "emulate",
    law: "whatever a program says, time goes forward and every number is one",
    run,
    dictionary: gcode::WORDS,
    most: 8_192,
};

/// See the target `gcode`.
const LIMITS: Limits = Limits {
    lines: 2_000,
    bytes: 1 << 18,
    steps: 20_000,
    turns: 2_000,
    idle: 1_000,
    depth: 50,
    variables: 1_000,
};
fn run(bytes: &[u8]) -> String {
    let flavor = Flavor::detect(bytes).flavor;
    let program = match Preprocessor::new(flavor).with_limits(LIMITS).run(bytes) {
        Ok(program) => program,
        Err(fault) => return fault.kind.to_string(),
    };
    let motions = [
        ProfileType::default(),
        ProfileType::SCurve { jerk: 5000.0 },
        ProfileType::ConstantVelocity,
        ProfileType::LinearRamp,
        ProfileType::SCurveStrict { jerk: 5000.0 },
    ];
    let motions = motions.map(|motion| emulated(&program, flavor, motion));
    motions.join(", ")
}

fn emulated(program: &::gcode::Program<'_>, flavor: &Flavor, motion: ProfileType) -> String {
    let Commands { steps, .. } = Commands::of(program, flavor);
    let mut machine: Machine = Profile::default().emulator();
    machine.flavor = flavor.clone();
    machine.motion.profile = motion;
    let operation = match machine.process_additive(steps) {
        Ok(operation) => operation,
        Err(error) => return error.message,
    };
    let times = operation.process_data().elapsed_time();
    assert!(times.iter().all(|time| time.is_finite()), "a time is no number");
    assert!(times.windows(2).all(|pair| pair[0] <= pair[1]), "time goes backwards");
    assert!(operation.volume().is_finite(), "the volume is {}", operation.volume());
    let bead = Bead::estimated(&operation, Bead::default());
    let part = match AdditivePart::new(&operation, bead, [0.0, 0.0, 1.0]) {
        Ok(part) => part,
        Err(error) => return error.message,
    };
    assert!(part.mass().is_finite(), "the mass is {}", part.mass());
    let mut table = Vec::new();
    let written = Table::of_part(&part).write_csv(&mut table).is_ok();
    let events = EventSeries::new(&operation, &EventOptions::default()).to_rows();
    let drawn = PolyData::of(&part, &[]).is_ok();
    format!("{written} {drawn} {} {} {}", size(table.len()), size(events.len()), size(part.n_layers()))
}
