//! Parts: segments, layers, paths, questions about place and time.

use emulate::motion::MotionProfile;
use emulate::{
    Action, AdditiveOperation, AdditivePart, Bead, Bounds, Commands, Extruder, Machine, SegmentKind, Shape,
};
use proptest::prelude::*;

const SQUARE: &[u8] = include_bytes!("data/a_square.gcode");
const VASE: &[u8] = include_bytes!("data/b_vase.gcode");
const ARCS: &[u8] = include_bytes!("data/d_arcs.gcode");
const UP: [f64; 3] = [0.0, 0.0, 1.0];
const BEAD: Bead = Bead { width: 6.0, height: 2.0, shape: Shape::Rectangle, density: 1.9 };

fn machine() -> Machine {
    Machine {
        motion: MotionProfile { max_acceleration: Some(500.0), ..MotionProfile::default() },
        ..Machine::default()
    }
}

fn emulated(text: &[u8]) -> AdditiveOperation<'_> {
    machine().process_additive(Commands::read(text).steps).expect("a sound machine")
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{found} is not {expected}");
}

#[test]
fn a_square_tower_has_three_layers_of_one_closed_path() {
    let operation = emulated(SQUARE);
    let part = AdditivePart::new(&operation, BEAD, UP).expect("a sound bead");
    assert_eq!(part.n_layers(), 3);
    near(part.deposition_length(), 1200.0);
    near(part.volume(), 14_400.0);
    near(part.mass(), 27.36);
    near(part.extruded_volume(), 60.0);
    let paths: Vec<_> = part.deposition_paths().collect();
    assert_eq!(paths.len(), 3);
    for (layer, path) in paths.iter().enumerate() {
        assert_eq!((path.layer, path.points.len()), (layer, 5));
        assert_eq!(path.points[0], path.points[4]);
        assert_eq!(path.points[1], [100.0, 0.0, 2.0 * (layer as f64 + 1.0)]);
    }
}

#[test]
fn segments_alternate_and_cover_every_motion_once() {
    for text in [SQUARE, VASE, ARCS] {
        let operation = emulated(text);
        let part = AdditivePart::new(&operation, BEAD, UP).expect("a sound bead");
        let process = operation.process_data();
        let mut covered = vec![0; process.len()];
        for segment in part.segments() {
            assert!(segment.start < segment.end);
            covered[segment.start..segment.end].iter_mut().for_each(|count| *count += 1);
        }
        for (index, count) in covered.into_iter().enumerate() {
            let moves = process.action()[index] != Action::Nothing;
            assert!(count == 1 || (count == 0 && !moves), "entry {index} is in {count} segments");
        }
        for pair in part.segments().windows(2) {
            assert_ne!((pair[0].kind, pair[0].layer), (pair[1].kind, pair[1].layer));
            assert_eq!(pair[0].to, pair[1].from);
            assert!(pair[0].end <= pair[1].start && pair[0].end_time <= pair[1].start_time);
        }
    }
}

#[test]
fn remarks_do_not_break_a_path_and_tools_do() {
    let operation = emulated(b"M83\nG1 X10 E1 F600\n; half way\nM117 half\nG1 X20 E1\nT1\nG1 X30 E1\n");
    let part = AdditivePart::new(&operation, BEAD, UP).expect("a sound bead");
    let rows: Vec<_> = part.segments().iter().map(|row| (row.start, row.end, row.tool)).collect();
    assert_eq!(rows, [(1, 5, 0), (6, 7, 1)]);
}

#[test]
fn layer_times_add_up_to_all_but_the_beginning() {
    for text in [SQUARE, VASE] {
        let operation = emulated(text);
        let part = AdditivePart::new(&operation, BEAD, UP).expect("a sound bead");
        let sum: f64 = part.layers().iter().map(|layer| layer.time).sum();
        near(sum, operation.total_time() - part.layers()[0].start_time);
    }
}

#[test]
fn the_layers_of_a_square_have_their_figures() {
    let operation = emulated(SQUARE);
    let part = AdditivePart::new(&operation, BEAD, UP).expect("a sound bead");
    let layers = part.layers();
    assert_eq!(layers.len(), 3);
    for layer in layers {
        near(layer.deposition_length, 400.0);
        near(layer.volume, 20.0);
        near(layer.mean_speed(), 400.0 / layer.deposition_time);
    }
    assert_eq!(
        part.layer(1).map(|row| row.kind).collect::<Vec<_>>(),
        [SegmentKind::Pause, SegmentKind::Travel, SegmentKind::Deposition]
    );
    assert_eq!(part.layer(3).count(), 0);
}

#[test]
fn a_spiral_has_a_layer_for_each_height_of_its_bead() {
    let operation = emulated(VASE);
    let part = AdditivePart::new(&operation, BEAD, UP).expect("a sound bead");
    assert_eq!(part.n_layers(), 5);
    let lengths: Vec<f64> = part.layers().iter().map(|layer| layer.deposition_length).collect();
    for length in &lengths {
        assert!((length / lengths[0] - 1.0).abs() < 0.02, "{lengths:?}");
    }
}

/// The program with every place turned about X.
fn tilted(text: &[u8], degrees: f64) -> Vec<u8> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut at = [0.0; 3];
    let text = String::from_utf8(text.to_vec()).expect("text");
    let line = |line: &str| {
        if !line.starts_with("G1") {
            return line.to_owned();
        }
        let mut rest = String::new();
        for word in line.split(' ').skip(1) {
            match ("XYZ".find(&word[..1]), word[1..].parse::<f64>()) {
                (Some(axis), Ok(value)) => at[axis] = value,
                _ => rest += &format!(" {word}"),
            }
        }
        let [x, y, z] = at;
        format!("G1 X{x:.9} Y{:.9} Z{:.9}{rest}", y * cos - z * sin, y * sin + z * cos)
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n").into_bytes()
}

#[test]
fn a_tilted_part_has_the_same_layers_across_its_own_normal() {
    let (sin, cos) = 30f64.to_radians().sin_cos();
    for (text, layers) in [(SQUARE, 3), (VASE, 5)] {
        let text = tilted(text, 30.0);
        let operation = emulated(&text);
        let part = AdditivePart::new(&operation, BEAD, [0.0, -sin, cos]).expect("a sound bead");
        assert_eq!(part.n_layers(), layers);
    }
}

#[test]
fn what_makes_no_part_is_refused() {
    let operation = emulated(SQUARE);
    let flat = Bead { height: 0.0, ..BEAD };
    assert!(AdditivePart::new(&operation, flat, UP).expect_err("refused").message.contains("bead"));
    assert!(AdditivePart::new(&operation, BEAD, [0.0; 3]).expect_err("refused").message.contains("normal"));
    let nothing = emulated(b"");
    let part = AdditivePart::new(&nothing, BEAD, UP).expect("an empty part is a part");
    assert_eq!((part.n_layers(), part.segments().len(), part.volume()), (0, 0, 0.0));
    assert!(part.at_time(1.0).is_none());
}

#[test]
fn a_bead_can_be_estimated_from_a_file() {
    let machine = Machine { extruder: Extruder::Volume, ..machine() };
    let bead = |text: &'static [u8]| {
        let operation = machine.process_additive(Commands::read(text).steps).expect("sound");
        Bead::estimated(&operation, Bead::default())
    };
    near(bead(SQUARE).height, 2.0);
    near(bead(SQUARE).width, 0.025);
    near(bead(VASE).height, 2.0);
    assert_eq!(bead(b"G1 X10 F600\n"), Bead::default());
}

#[test]
fn deposits_of_an_arc_lie_on_it() {
    let operation = emulated(b"M83\nG1 X20 F600\nG3 X20 Y40 J20 E5\n");
    let part = AdditivePart::new(&operation, BEAD, UP).expect("a sound bead");
    let path = part.deposition_paths().next().expect("a path");
    assert!(path.points.len() > 20);
    for point in &path.points {
        near((point[0] - 20.0).hypot(point[1] - 20.0), 20.0);
    }
    for pair in path.points.windows(2) {
        let middle = [0, 1].map(|axis| 0.5 * (pair[0][axis] + pair[1][axis]));
        let inside = 20.0 - (middle[0] - 20.0).hypot(middle[1] - 20.0);
        assert!(inside < 0.01, "{inside}");
    }
    let bounds = operation.bounds().expect("it moves");
    near(bounds.max[0], 40.0);
}

#[test]
fn the_moves_of_a_box_are_found() {
    let operation = emulated(SQUARE);
    let part = AdditivePart::new(&operation, BEAD, UP).expect("a sound bead");
    let corner = Bounds { min: [99.0, 99.0, 3.5], max: [101.0, 101.0, 4.5] };
    let process = operation.process_data();
    let found: Vec<u32> = part.in_box(corner).map(|index| process.line()[index]).collect();
    assert_eq!(found, [16, 17]);
    assert_eq!(part.in_box(Bounds::point([50.0, 50.0, 2.0])).count(), 0);
}

#[test]
fn at_the_end_of_every_step_the_machine_is_where_it_should_be() {
    for text in [SQUARE, VASE, ARCS] {
        let operation = emulated(text);
        let process = operation.process_data();
        for index in 0..process.len() {
            if process.duration(index) <= 0.0 {
                continue;
            }
            let end = process.elapsed_time()[index];
            let before = operation.at_time(end - 1e-9 * end).expect("there are steps");
            for axis in 0..3 {
                let off = before.at[axis] - process.coordinate(axis)[index];
                assert!(off.abs() < 1e-5, "entry {index} is off by {off}");
            }
        }
        let beyond = operation.at_time(1e9).expect("there are steps");
        assert_eq!(beyond.at, process.get(process.len() - 1).expect("the last").at);
        assert_eq!(operation.at_time(-1.0), operation.at_time(0.0));
    }
}

proptest! {
    #[test]
    fn the_speed_adds_up_to_the_way(share in 0.0..1.0f64) {
        for text in [SQUARE, ARCS] {
            let operation = emulated(text);
            let end = share * operation.total_time();
            let steps = 20_000;
            let step = end / f64::from(steps);
            let speed = |part: i32| {
                operation.at_time((f64::from(part) + 0.5) * step).expect("there are steps").state.speed
            };
            let sum: f64 = (0..steps).map(speed).sum::<f64>() * step;
            let way = operation.at_time(end).expect("there are steps").distance;
            prop_assert!((sum - way).abs() < 0.01 + 1e-3 * way, "{sum} {way}");
        }
    }

    #[test]
    fn a_time_is_found_as_by_looking_at_every_step(share in 0.0..1.0f64) {
        let operation = emulated(VASE);
        let process = operation.process_data();
        let time = share * operation.total_time();
        let brute = process.elapsed_time().iter().position(|&end| end > time).unwrap_or(process.len() - 1);
        let part = AdditivePart::new(&operation, BEAD, UP).expect("a sound bead");
        let (moment, segment) = part.at_time(time).expect("there are steps");
        prop_assert_eq!(moment.index, brute);
        if let Some(segment) = segment {
            prop_assert!((segment.start..segment.end).contains(&brute));
        }
    }
}
