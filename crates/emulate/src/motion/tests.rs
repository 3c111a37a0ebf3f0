//! The planner against the closed forms of `tests/data/unit_cases.jsonl`, and its laws.

use super::*;
use proptest::prelude::*;
use serde_json::Value;

const CASES: &str = include_str!("../../tests/data/unit_cases.jsonl");

fn cases(kind: &str) -> Vec<Value> {
    let all = CASES.lines().map(|line| serde_json::from_str::<Value>(line).expect("a case is JSON"));
    let found: Vec<Value> = all.filter(|case| case["case"] == kind).collect();
    assert!(!found.is_empty(), "no case of {kind}");
    found
}

fn number(case: &Value, key: &str) -> f64 {
    case[key].as_f64().unwrap_or_else(|| panic!("{case} has no {key}"))
}

#[track_caller]
fn near(found: f64, expected: f64) {
    let off = (found - expected).abs() / expected.abs().max(1e-3);
    assert!(off < 1e-9, "{found} is not {expected}");
}

/// Two moves with a turn between them.
fn turn(degrees: f64, acceleration: f64, deviation: f64) -> Moves {
    let angle = degrees.to_radians();
    let corner = [1.0, 0.0, 0.0];
    let end = [1.0 + angle.cos(), angle.sin(), 0.0];
    [Move::line([0.0; 3], corner, 1e9), Move::line(corner, end, 1e9)]
        .into_iter()
        .map(|step| step.limited(acceleration, deviation))
        .collect()
}

/// The square of the speed between two moves.
fn corner(model: JunctionModel, moves: &Moves) -> f64 {
    model.speed_squared(&moves.get(0), &moves.get(1))
}

#[test]
fn corners_are_as_fast_as_the_formula_says() {
    for case in cases("junction") {
        let (degrees, deviation) = (number(&case, "turn_deg"), number(&case, "jd"));
        let moves = turn(degrees, number(&case, "acc"), deviation);
        let speed = |model: JunctionModel| corner(model, &moves).sqrt();
        let found = speed(JunctionModel::Grbl);
        let expected = number(&case, "v");
        // The cosine of a turn of a thousandth of a degree has few digits left.
        let tolerance = if degrees < 0.1 { 1e-6 } else { 1e-9 };
        assert!((found / expected - 1.0).abs() < tolerance, "{degrees}: {found} is not {expected}");
        let klipper = speed(JunctionModel::Klipper);
        let lower = expected.min(number(&case, "klipper_cap_1mm"));
        assert!((klipper / lower - 1.0).abs() < tolerance, "{degrees}: {klipper} is not {lower}");
    }
}

#[test]
fn a_way_straight_back_is_a_full_stop_and_straight_on_costs_nothing() {
    for model in [JunctionModel::Grbl, JunctionModel::MarlinSmall, JunctionModel::PyGCodeDecode] {
        assert_eq!(corner(model, &turn(180.0, 500.0, 0.05)), 0.0, "{model:?}");
    }
    assert!(corner(JunctionModel::Klipper, &turn(180.0, 500.0, 0.05)) < 1e-9);
    for model in [JunctionModel::Grbl, JunctionModel::Klipper, JunctionModel::None] {
        assert_eq!(corner(model, &turn(0.0, 500.0, 0.05)), f64::INFINITY, "{model:?}");
    }
    assert_eq!(corner(JunctionModel::FullStop, &turn(0.0, 500.0, 0.05)), 0.0);
}

#[test]
fn classic_jerk_limits_the_jump_of_each_axis() {
    let speed = |degrees: f64| {
        let mut moves = turn(degrees, 500.0, 0.0);
        moves.target = vec![40.0, 50.0];
        corner(JunctionModel::ClassicJerk([8.0, 8.0, 0.4, 5.0]), &moves).sqrt()
    };
    near(speed(0.0), 40.0);
    // At a right angle each axis jumps by the whole speed.
    near(speed(90.0), 8.0);
    // Straight back an axis counts once.
    near(speed(180.0), 8.0);
}

#[test]
fn trapezoids_and_s_curves_take_as_long_as_the_formulas_say() {
    for case in cases("trapezoid") {
        let mut task = Task {
            length: number(&case, "d"),
            entry: number(&case, "v0"),
            exit: number(&case, "v1"),
            target: number(&case, "vmax"),
            acceleration: number(&case, "acc"),
        };
        let found = ProfileType::default().timing(&task);
        near(found.time, number(&case, "time"));
        near(found.peak, number(&case, "v_peak"));
        let jerk = number(&case, "jerk");
        let found = ProfileType::SCurve { jerk }.timing(&task);
        match case["scurve_time"].as_f64() {
            Some(time) => {
                near(found.time, time);
                near(found.peak, number(&case, "scurve_v_peak"));
                assert!(!found.limit_exceeded);
            }
            // The change of speed does not fit: as long as an even ramp.
            None => {
                near(found.time, 2.0 * task.length / (task.entry + task.exit));
                assert!(found.limit_exceeded);
            }
        }
        task.acceleration = f64::INFINITY;
        near(ProfileType::default().timing(&task).time, task.length / task.target);
    }
}

#[test]
fn s_curves_from_rest_to_rest() {
    for case in cases("scurve_rest_to_rest_no_vmax") {
        let acceleration = number(&case, "acc");
        let task = Task { length: number(&case, "d"), entry: 0.0, exit: 0.0, target: 1e9, acceleration };
        let found = ProfileType::SCurve { jerk: number(&case, "jerk") }.timing(&task);
        near(found.time, number(&case, "time"));
        near(found.peak, number(&case, "v_peak"));
    }
}

#[test]
fn the_reach_of_an_s_curve() {
    for case in cases("reach") {
        let (from, way) = (number(&case, "v0"), number(&case, "d"));
        let (acceleration, jerk) = (number(&case, "acc"), number(&case, "jerk"));
        near(scurve::reach(from, way, acceleration, jerk), number(&case, "v1_scurve"));
    }
}

#[test]
fn a_chain_of_three_million_short_moves_is_one_triangle() {
    let case = &cases("chain")[0];
    let planner = MotionProfile { max_acceleration: Some(500.0), ..MotionProfile::default() };
    for count in [number(case, "n") as usize, 3_000_000] {
        let side = 150.0 / count as f64;
        let mut run = Planner::default();
        let mut time = 0.0;
        let mut sum = |(): (), step: &Step, _: f64| time += step.timing.time;
        for index in 0..count {
            let at = |index: usize| [index as f64 * side, 0.0, 0.0];
            let step = planner.limit(Move::line(at(index), at(index + 1), 1000.0));
            run.push(&planner, &step, (), &mut sum).expect("a sound move");
        }
        run.stop(&planner, &mut sum).expect("a sound move");
        assert!((time - number(case, "time")).abs() < 1e-8, "{count}: {time}");
    }
}

#[test]
fn ramps_over_fixed_parts_of_the_way() {
    let task = Task { length: 100.0, entry: 0.0, exit: 0.0, target: 50.0, acceleration: 500.0 };
    let quarters = ProfileType::Trapezoid(Ramps::QUARTERS);
    near(quarters.timing(&task).time, 3.0);
    near(quarters.phases(&task, 50.0).time(), 3.0);
    let ramp = Task { entry: 20.0, exit: 30.0, ..task };
    near(ProfileType::LinearRamp.timing(&ramp).time, 4.0);
    near(ProfileType::LinearRamp.timing(&task).time, 2.1);
    near(ProfileType::ConstantVelocity.timing(&task).time, 2.0);
}

#[test]
fn numbers_that_make_no_sense_are_refused() {
    let refused = |planner: MotionProfile| planner.check().expect_err("refused").message;
    let with =
        |acceleration| MotionProfile { max_acceleration: Some(acceleration), ..MotionProfile::default() };
    assert!(refused(with(0.0)).contains("acceleration"));
    assert!(refused(with(f64::NAN)).contains("acceleration"));
    let bent = MotionProfile { junction_deviation: -1.0, ..MotionProfile::default() };
    assert!(refused(bent).contains("junction deviation"));
    let still = MotionProfile { profile: ProfileType::SCurve { jerk: 0.0 }, ..MotionProfile::default() };
    assert!(refused(still).contains("jerk"));
    let long = Ramps::DistanceLimited { accelerate: 0.7, decelerate: 0.7 };
    assert!(
        refused(MotionProfile { profile: ProfileType::Trapezoid(long), ..MotionProfile::default() })
            .contains("parts")
    );
    let moves: Moves = [Move::line([0.0; 3], [1.0, 0.0, 0.0], 0.0)].into_iter().collect();
    assert_eq!(MotionProfile::default().plan(&moves).expect_err("refused").index, Some(0));
}

/// Rules that ask for nonsense.
struct Nonsense(f64);

impl MachineConstraints for Nonsense {
    fn apply(&self, _: &Moves, target: &mut [f64], _: &mut [f64]) {
        target[1] = self.0;
    }
}

#[test]
fn rules_that_make_no_speed_are_an_error_that_names_the_move() {
    for speed in [f64::NAN, -1.0, f64::INFINITY, 0.0] {
        let planner = MotionProfile {
            max_acceleration: Some(500.0),
            constraints: Some(Arc::new(Nonsense(speed))),
            ..MotionProfile::default()
        };
        let error = planner.plan(&turn(30.0, 500.0, 0.05)).expect_err("refused");
        assert_eq!(error.index, Some(1), "{error}");
    }
}

prop_compose! {
    /// A walk through the plane with any speeds.
    fn walk()(steps in prop::collection::vec((-5.0..5.0f64, -5.0..5.0f64, 1.0..100.0f64), 1..60)) -> Moves {
        let mut at = [0.0; 3];
        steps
            .into_iter()
            .filter(|(x, y, _)| x.abs() + y.abs() > 1e-3)
            .map(|(x, y, speed)| {
                let to = [at[0] + x, at[1] + y, 0.0];
                let step = Move::line(at, to, speed).limited(500.0, 0.05);
                at = to;
                step
            })
            .collect()
    }
}

fn planner(profile: ProfileType) -> MotionProfile {
    MotionProfile {
        max_acceleration: Some(500.0),
        junction_deviation: 0.05,
        profile,
        ..MotionProfile::default()
    }
}

proptest! {
    #[test]
    fn a_second_round_of_passes_changes_nothing_and_the_speeds_are_the_largest(moves in walk()) {
        let planner = planner(ProfileType::default());
        let mut stretch = Stretch::default();
        for index in 0..moves.len() {
            stretch.push(&planner, &moves.get(index)).expect("sound");
        }
        stretch.end(&planner).expect("sound");
        let (caps, once) = (stretch.caps(), stretch.exits().to_vec());
        stretch.set_caps(&once);
        stretch.end(&planner).expect("sound");
        prop_assert_eq!(&once, &stretch.exits().to_vec());
        let reach = |index: usize| 2.0 * moves.acceleration[index] * moves.length[index];
        for index in 0..moves.len() {
            let before = if index == 0 { 0.0 } else { once[index - 1] };
            prop_assert!((once[index] - before).abs() <= reach(index) * (1.0 + 1e-12) + 1e-9);
            let tight = |square: f64, limit: f64| square >= limit - 1e-9 * limit.max(1.0);
            let by_cap = tight(once[index], caps[index]);
            let by_start = tight(once[index], before + reach(index));
            let by_brake =
                index + 1 < moves.len() && tight(once[index], once[index + 1] + reach(index + 1));
            prop_assert!(by_cap || by_start || by_brake, "speed {index} could be larger");
        }
    }

    #[test]
    fn phases_add_up_to_the_move(moves in walk(), jerk in 1e3..1e6f64) {
        for profile in [
            ProfileType::default(),
            ProfileType::Trapezoid(Ramps::QUARTERS),
            ProfileType::LinearRamp,
            ProfileType::SCurve { jerk },
            ProfileType::SCurveStrict { jerk },
        ] {
            let plan = planner(profile).plan(&moves).expect("sound");
            for index in 0..moves.len() {
                let task = Task {
                    length: moves.length[index],
                    entry: plan.entry[index],
                    exit: plan.exit[index],
                    target: moves.target[index],
                    acceleration: 500.0,
                };
                let phases = profile.phases(&task, plan.peak[index]);
                let end = phases.at(f64::INFINITY);
                prop_assert!((phases.time() - plan.time[index]).abs() < 1e-6 * plan.time[index] + 1e-9, "{profile:?}");
                prop_assert!((end.distance - task.length).abs() < 1e-6 * task.length + 1e-9, "{profile:?}");
                prop_assert!((end.speed - task.exit).abs() < 1e-4, "{profile:?} {} {}", end.speed, task.exit);
            }
        }
    }

    #[test]
    fn more_acceleration_or_deviation_is_never_slower_and_a_cap_never_faster(moves in walk(), more in 1.0..5.0f64) {
        let time = |acceleration: f64, deviation: f64, cap: f64| {
            let moves: Moves = (0..moves.len())
                .map(|index| {
                    let step = moves.get(index);
                    Move { target: step.target.min(cap), ..step }.limited(acceleration, deviation)
                })
                .collect();
            planner(ProfileType::default()).plan(&moves).expect("sound").total_time()
        };
        let plain = time(500.0, 0.05, 1e9);
        prop_assert!(time(500.0 * more, 0.05, 1e9) <= plain + 1e-9);
        prop_assert!(time(500.0, 0.05 * more, 1e9) <= plain + 1e-9);
        prop_assert!(time(500.0, 0.05, 100.0 / more) >= plain - 1e-9);
    }

    #[test]
    fn a_straight_move_in_parts_takes_as_long(parts in 1..50usize, length in 0.1..100.0f64, speed in 1.0..200.0f64) {
        let at = |index: usize| [length * index as f64 / parts as f64, 0.0, 0.0];
        let whole: Moves = [Move::line(at(0), at(parts), speed).limited(500.0, 0.05)].into_iter().collect();
        let pieces: Moves = (0..parts)
            .map(|index| Move::line(at(index), at(index + 1), speed).limited(500.0, 0.05))
            .collect();
        let planner = planner(ProfileType::default());
        let time = |moves: &Moves| planner.plan(moves).expect("sound").total_time();
        prop_assert!((time(&whole) - time(&pieces)).abs() < 1e-9);
    }

    #[test]
    fn planned_in_windows_is_planned_as_a_whole(
        moves in walk(),
        rounds in 1..200usize,
        ratio in prop_oneof![Just(0.0), 0.0..0.95f64],
    ) {
        // Long enough that the first moves are settled before the last have come.
        let smoothing = Smoothing::CruiseRatio(ratio);
        let planner = MotionProfile { smoothing, ..planner(ProfileType::default()) };
        let once = || (0..moves.len()).map(|index| planner.limit(moves.get(index)));
        let many = Moves::from_iter((0..rounds).flat_map(|_| once()));
        let whole = planner.plan(&many).expect("sound");
        let mut run = Planner::default();
        let mut steps = Vec::new();
        let mut keep = |index: usize, step: &Step, _: f64| steps.push((index, step.entry, step.exit, step.timing.time));
        for index in 0..many.len() {
            run.push(&planner, &many.get(index), index, &mut keep).expect("sound");
        }
        run.stop(&planner, &mut keep).expect("sound");
        prop_assert_eq!(steps.len(), many.len());
        for (index, &(tag, entry, exit, time)) in steps.iter().enumerate() {
            prop_assert_eq!(tag, index);
            prop_assert_eq!((entry, exit, time), (whole.entry[index], whole.exit[index], whole.time[index]));
        }
    }
}
