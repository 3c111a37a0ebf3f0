//! The machine: modes, origins, limits, extruders, odd programs.

use emulate::motion::MotionProfile;
use emulate::{Action, Arc, Commands, Extruder, Machine, Operation};
use gcode::{Centre, Flavor, Turn};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_4;

const SQUARE: &[u8] = include_bytes!("data/a_square.gcode");

fn machine() -> Machine {
    let motion = MotionProfile { max_acceleration: Some(500.0), ..MotionProfile::default() };
    Machine { motion, ..Machine::default() }
}

fn emulated(text: &str) -> Operation<'static> {
    let text: &'static str = text.to_owned().leak();
    machine().process(Commands::read(text.as_bytes()).steps).expect("a sound machine")
}

fn end(text: &str) -> [f64; 3] {
    let operation = emulated(text);
    operation.process_data().iter().last().expect("a row").at
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{found} is not {expected}");
}

#[test]
fn arcs_have_the_length_and_tangents_of_the_closed_forms() {
    let cases = include_str!("data/unit_cases.jsonl");
    let cases = cases.lines().map(|line| serde_json::from_str::<serde_json::Value>(line).expect("JSON"));
    let mut count = 0;
    for case in cases.filter(|case| case["case"] == "arc") {
        let point = |key: &str| [0, 1, 2].map(|axis| case[key][axis].as_f64().expect("a number"));
        let word = |letter: &str| case["words"][letter].as_f64();
        let (around, centre) = match word("R") {
            Some(radius) => ([radius, 0.0], Centre::Radius),
            None => ([word("I").unwrap_or(0.0), word("J").unwrap_or(0.0)], Centre::Offset),
        };
        let clockwise = case["clockwise"] == true;
        let turn = Turn { clockwise, centre, ..Turn::default() };
        let (arc, _) = Arc::new(point("start"), point("end"), around, turn).expect("an arc");
        near(arc.length(), case["length"].as_f64().expect("a number"));
        near(arc.speed_limit(500.0), case["v_centripetal"].as_f64().expect("a number"));
        for (part, key) in [(0.0, "tangent_in"), (1.0, "tangent_out")] {
            for (found, expected) in arc.tangent(part).iter().zip(point(key)) {
                assert!((found - expected).abs() < 1e-9, "{case}");
            }
        }
        count += 1;
    }
    assert_eq!(count, 6);
}

#[test]
fn an_arc_that_cannot_be_is_a_straight_move_and_is_told() {
    for (text, why) in [
        ("G2 X0 Y0 R5 F600\n", "anywhere"),
        ("G2 X100 R5 F600\n", "too far apart"),
        ("G2 X10 Y0 I3 J3 F600\n", "off its circle"),
    ] {
        let operation = emulated(text);
        let told: Vec<String> = operation.diagnostics().list().iter().map(ToString::to_string).collect();
        assert!(told.iter().any(|told| told.contains(why) && told.contains("line 1")), "{text}: {told:?}");
        assert!(operation.total_time().is_finite());
    }
}

#[test]
fn a_full_circle_has_the_bounds_of_a_circle() {
    let operation = emulated("G1 X40 Y-30 F600\nG3 I-10\n");
    let bounds = operation.bounds().expect("it moves");
    near(bounds.min[0], 0.0);
    near(bounds.min[1], -40.0);
    near(bounds.max[1], 0.0);
    near(operation.process_data().step_distance()[1], 62.83185307179586);
}

#[test]
fn an_operation_that_nobody_processed_has_no_figures() {
    let operation = Operation::unprocessed(Commands::read(SQUARE).steps);
    assert!(operation.process_data().is_empty() && !operation.commands().is_empty());
    assert_eq!((operation.bounds(), operation.statistics()), (None, None));
    assert!(operation.at_time(1.0).is_none());
    let processed = machine().process(operation.commands().to_vec()).expect("sound");
    assert!(processed.bounds().is_some() && processed.statistics().is_some());
}

#[test]
fn the_statistics_of_a_square() {
    let operation = machine().process_additive(Commands::read(SQUARE).steps).expect("sound");
    let all = operation.statistics().expect("it is processed");
    assert!((all.total_time - 27.030550090).abs() < 1e-8);
    assert!((all.time_lost - 0.930550090).abs() < 1e-8);
    near(all.dwell_time, 1.5);
    near(all.deposition_length, 1200.0);
    near(all.path_length, 1206.0);
    near(all.travel_length, 6.0);
    near(all.max_speed, 50.0);
    assert_eq!(all.count(gcode::CommandKind::Dwell), 2);
    assert_eq!(all.kinds.iter().sum::<usize>(), operation.commands().len());
}

#[test]
fn places_are_what_modes_and_origins_make_of_words() {
    for (text, expected) in [
        ("G1 X10 F600\nG91\nG1 X5 Y2\n", [15.0, 2.0, 0.0]),
        ("G1 X10 F600\nG92 X0\nG1 X5\n", [15.0, 0.0, 0.0]),
        ("G1 X10 F600\nG92 X3\nG92.1\nG1 X5\n", [5.0, 0.0, 0.0]),
        ("G20\nG1 X1 F60\nG21\nG1 Y1\n", [25.4, 1.0, 0.0]),
        ("G10 L2 P2 X100 Y50\nG55\nG1 X1 Y1 F600\n", [101.0, 51.0, 0.0]),
        ("G10 L2 P2 X100\nG55\nG1 X1 F600\nG53 G0 X7\nG54\nG1 Y1\n", [7.0, 1.0, 0.0]),
        ("G1 X10 Y10 Z10 F600\nG28 X\n", [0.0, 10.0, 10.0]),
        ("G1 X10 Y10 Z10 F600\nG28\nG1 X1\n", [1.0, 0.0, 0.0]),
    ] {
        // G10 and G53 are of GRBL and RS274.
        let flavor = Flavor::named("rs274").expect("built in");
        let operation = machine().process(Commands::read_as(text.as_bytes(), flavor).steps).expect("sound");
        let found = operation.process_data().iter().last().expect("a row").at;
        for axis in 0..3 {
            assert!((found[axis] - expected[axis]).abs() < 1e-9, "{text}: {found:?}");
        }
    }
}

#[test]
fn every_extruder_counts_its_own_way() {
    let area = |diameter: f64| FRAC_PI_4 * diameter * diameter;
    for (extruder, text, volume) in [
        (Extruder::Filament { diameter: 1.75 }, "M83\nG1 X10 E2 F600\n", 2.0 * area(1.75)),
        (Extruder::Filament { diameter: 2.85 }, "M83\nG1 X10 E2 F600\n", 2.0 * area(2.85)),
        (Extruder::Piston { diameter: 60.0 }, "G1 X10 E2 F600\nG1 X20 E3\n", 3.0 * area(60.0)),
        (Extruder::Volume, "M83\nG1 X10 E2 F600\n", 2.0),
        (Extruder::Unit { mm3: 7.5 }, "M83\nG1 X10 E2 F600\n", 15.0),
        (Extruder::Filament { diameter: 1.75 }, "M200 D1.75\nM83\nG1 X10 E2 F600\n", 2.0),
        (Extruder::Volume, "M221 S50\nM83\nG1 X10 E2 F600\n", 1.0),
    ] {
        let machine = Machine { extruder, ..machine() };
        let operation = machine.process_additive(Commands::read(text.as_bytes()).steps).expect("sound");
        near(operation.volume(), volume);
        let process = operation.process_data();
        for index in 0..process.len() {
            let whole = operation.bead_area(index) * process.step_distance()[index];
            if process.action()[index] == Action::Deposit {
                near(whole, operation.delta_volume()[index]);
            }
        }
    }
}

#[test]
fn a_screw_lays_by_time() {
    let flavor = Flavor::named("cincinnati").expect("built in");
    let text = b"M3 S60\nG1 X10 Y0 F600\nG4 P2\nM5\nG1 X0 Y0\n";
    let machine = Machine {
        extruder: Extruder::Screw { mm3_per_revolution: 5.0 },
        flavor: flavor.clone(),
        ..Machine::default()
    };
    let operation = machine.process_additive(Commands::read_as(text, flavor).steps).expect("sound");
    // Ten inches at ten inches a second, and two seconds at rest, at one turn a second.
    near(operation.volume(), 5.0 * (1.0 + 2.0));
    near(operation.total_time(), 4.0);
}

#[test]
fn what_was_drawn_back_is_not_deposited_twice() {
    let text = b"M83\nG1 X10 E1 F600\nG1 E-3\nG1 X20\nG1 E3\nG1 X30 E1\n";
    let operation = machine().process_additive(Commands::read(text).steps).expect("sound");
    near(operation.volume(), 2.0);
    near(operation.delta_volume().iter().sum(), 2.0);
    let deposited = operation.deposited_volume();
    assert!(deposited.windows(2).all(|pair| pair[0] <= pair[1]));
}

#[test]
fn limits_of_the_file_hold_from_their_line_on() {
    let operation = emulated("G1 X100 F3000\nG4 P0\nM204 T2000 P2000\nG1 X0\n");
    let process = operation.process_data();
    near(process.duration(0), 2.0 + 50.0 / 500.0);
    near(process.duration(3), 2.0 + 50.0 / 2000.0);
    let mut deaf = machine();
    deaf.obeys_limits = false;
    let steps = Commands::read(b"M204 T2000 P2000\nM203 X10\nG1 X100 F3000\n").steps;
    near(deaf.process(steps).expect("sound").total_time(), 2.1);
    let slow = emulated("M203 X10\nG1 X100 F3000\n");
    near(slow.total_time(), 10.0 + 10.0 / 500.0);
}

#[test]
fn klipper_smooths_short_moves_from_the_line_that_says_so() {
    let flavor = Flavor::named("klipper").expect("built in");
    let text = b"G1 X1.5 F6000\nG4 P0\nSET_VELOCITY_LIMIT MINIMUM_CRUISE_RATIO=0.5\nG1 X0\nG4 P0\n\
        SET_VELOCITY_LIMIT ACCEL_TO_DECEL=125\nG1 X1.5\nG1 E1.5\nG4 P0\nSET_VELOCITY_LIMIT MINIMUM_CRUISE_RATIO=0\nG1 X0\n";
    let machine = Machine { flavor: flavor.clone(), ..machine() };
    let operation = machine.process(Commands::read_as(text, flavor).steps).expect("sound");
    let process = operation.process_data();
    // A triangle, from rest to rest; and a ramp up, so much of the way at one speed, and a ramp down.
    let triangle = 2.0 * (1.5f64 / 500.0).sqrt();
    let smooth = |virtual_acceleration: f64| {
        let speed = (virtual_acceleration * 1.5).sqrt();
        2.0 * speed / 500.0 + (1.5 - speed * speed / 500.0) / speed
    };
    near(process.duration(0), triangle);
    near(process.duration(3), smooth(250.0));
    near(process.duration(6), smooth(125.0));
    // What the extruder does alone shakes nothing.
    near(process.duration(7), triangle);
    near(process.duration(10), triangle);
}

#[test]
fn limits_can_be_read_from_firmware() {
    let flavor = Flavor::named("grbl").expect("built in");
    let settings = Commands::read_as(b"$11=0.02\n$110=3000\n$120=250\n$121=250\n$122=50\n", flavor);
    let machine = Machine::from_firmware(&settings.steps, flavor);
    near(machine.limits.axis_speed[0], 50.0);
    near(machine.limits.axis_acceleration[2], 50.0);
    let move_up = Commands::read_as(b"G1 Z10 F6000\n", flavor);
    // It never gets to its feed: 2·√(d/a).
    near(machine.process(move_up.steps).expect("sound").total_time(), 2.0 * (10.0f64 / 50.0).sqrt());
    let dump = Commands::read(b"M201 X900\nM203 E5\nM204 P300 T400 R500\nM205 J0.03\n");
    let marlin = Machine::from_firmware(&dump.steps, &Flavor::default());
    assert_eq!((marlin.limits.print, marlin.limits.travel, marlin.limits.retract), (300.0, 400.0, 500.0));
    assert_eq!((marlin.limits.axis_acceleration[0], marlin.limits.axis_speed[3]), (900.0, 5.0));
}

#[test]
fn a_slow_pump_slows_the_nozzle_down() {
    let mut machine = machine();
    machine.limits.axis_speed[3] = 0.5;
    let operation = machine.process(Commands::read(b"M83\nG1 X100 E10 F6000\n").steps).expect("sound");
    // A tenth of E for each millimetre.
    near(operation.process_data().speed_peak()[1], 5.0);
}

#[test]
fn odd_words_are_told_and_never_stop_the_machine() {
    for (text, why) in
        [("G1 X10\n", "no feed"), ("G1 X5 U3 F600\n", "U"), ("G10 L2 P99 X1\n", "coordinate system")]
    {
        let operation = emulated(text);
        let told: Vec<String> = operation.diagnostics().list().iter().map(ToString::to_string).collect();
        assert!(told.iter().any(|told| told.contains(why)), "{text}: {told:?}");
    }
    assert_eq!(emulated("").total_time(), 0.0);
    assert_eq!(emulated("G1 X0 Y0 F600\nG1 X0\n").total_time(), 0.0);
}

#[test]
fn a_message_is_no_move() {
    assert_eq!(end("G1 X1 F600\nM117 G1 X5 Printing\n"), [1.0, 0.0, 0.0]);
    assert_eq!(end("n10 g1x10y20*71\n"), [10.0, 20.0, 0.0]);
}

/// A program of moves as words, and its values.
fn program(steps: &[(f64, f64, f64)], mut write: impl FnMut(f64, f64, f64) -> String) -> String {
    let (mut x, mut y) = (0.0, 0.0);
    let mut text = String::from("M83\nG1 F3000\n");
    for &(by_x, by_y, e) in steps {
        x += by_x;
        y += by_y;
        text += &write(x, y, e);
    }
    text
}

fn steps() -> impl Strategy<Value = Vec<(f64, f64, f64)>> {
    let side = (-200..200i32).prop_map(|side| f64::from(side) / 8.0);
    prop::collection::vec((side.clone(), side, 0.0..2.0f64), 1..40)
}

proptest! {
    #[test]
    fn the_way_a_program_is_written_does_not_change_its_time(steps in steps(), angle in 0.0..6.3f64) {
        let plain = program(&steps, |x, y, e| format!("G1 X{x:.6} Y{y:.6} E{e:.5}\n"));
        let time = emulated(&plain).total_time();
        let (sin, cos) = angle.sin_cos();
        let turned = program(&steps, |x, y, e| {
            format!("G1 X{:.12} Y{:.12} E{e:.5}\n", x * cos - y * sin, x * sin + y * cos)
        });
        let shifted = plain.replacen("M83\n", "M83\nG92 X0 Y0\n", 1);
        let inches = program(&steps, |x, y, e| format!("G1 X{:.12} Y{:.12} E{e:.5}\n", x / 25.4, y / 25.4))
            .replacen("G1 F3000\n", "G1 F3000\nG20\n", 1);
        let mut before = (0.0, 0.0);
        let relative = program(&steps, |x, y, e| {
            let text = format!("G1 X{:.6} Y{:.6} E{e:.5}\n", x - before.0, y - before.1);
            before = (x, y);
            text
        })
        .replacen("M83\n", "M83\nG91\n", 1);
        for (how, text) in [("turned", turned), ("shifted", shifted), ("relative", relative)] {
            let found = emulated(&text).total_time();
            prop_assert!((found - time).abs() < 1e-6, "{how}: {found} {time}");
        }
        let found = emulated(&inches).process_data().distance().last().copied();
        let way = emulated(&plain).process_data().distance().last().copied();
        prop_assert!((found.unwrap_or(0.0) - way.unwrap_or(0.0)).abs() < 1e-6);
    }

    #[test]
    fn any_text_gives_one_entry_a_command_and_finite_numbers(text in "(G[0-9]{1,2}|M[0-9]{1,3}|[XYZEFIJRPSTWA]-?[0-9]{1,5}(\\.[0-9]{1,3})?|[ ;\n(){}*$#]){0,80}") {
        for flavor in Flavor::built_in() {
            let commands = Commands::read_as(text.as_bytes(), flavor);
            let machine = Machine { flavor: flavor.clone(), ..machine() };
            let operation = machine.process_additive(commands.steps).expect("the machine is sound");
            prop_assert_eq!(operation.commands().len(), operation.process_data().len());
            for row in operation.process_data().iter() {
                prop_assert!(row.at.iter().all(|value| value.is_finite()));
                prop_assert!(row.elapsed_time.is_finite() && row.duration >= 0.0 && row.distance.is_finite());
            }
            prop_assert!(operation.volume().is_finite());
        }
    }
}
