//! Tables, event series, VTK.

use emulate::motion::{JunctionModel, MotionProfile};
use emulate::{
    AdditiveOperation, AdditivePart, Bead, CellData, Column, Commands, EventField, EventOptions, EventSeries,
    Machine, PolyData, Shape, Table,
};

const SQUARE: &[u8] = include_bytes!("data/a_square.gcode");
const VASE: &[u8] = include_bytes!("data/b_vase.gcode");
const BEAD: Bead = Bead { width: 6.0, height: 2.0, shape: Shape::Rectangle, density: 1.9 };

fn machine(junction: JunctionModel) -> Machine {
    let motion = MotionProfile { max_acceleration: Some(500.0), junction, ..MotionProfile::default() };
    Machine { motion, obeys_limits: false, ..Machine::default() }
}

fn emulated(text: &[u8]) -> AdditiveOperation<'_> {
    machine(JunctionModel::Grbl).process_additive(Commands::read(text).steps).expect("a sound machine")
}

fn rows(text: &str) -> Vec<[f64; 5]> {
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    text.lines()
        .map(|line| line.split(',').map(number).collect::<Vec<_>>().try_into().expect("five cells"))
        .collect()
}

#[test]
fn event_series_are_those_of_py_gcode_decode() {
    for (name, text, events) in [
        ("a_square", SQUARE, include_str!("data/a_square_events.csv")),
        ("b_vase", VASE, include_str!("data/b_vase_events.csv")),
        ("e_zigzag", include_bytes!("data/e_zigzag.gcode"), include_str!("data/e_zigzag_events.csv")),
    ] {
        let machine = machine(JunctionModel::PyGCodeDecode);
        let operation = machine.process_additive(Commands::read(text).steps).expect("sound");
        let series = EventSeries::new(&operation, &EventOptions::default());
        let ours = rows(&series.to_rows());
        // It writes rows for moves of the extruder alone, at one place, and for phases without time; ours has none.
        let theirs = rows(events);
        let mut rest = theirs.as_slice();
        for row in &ours {
            let at = |found: &[f64; 5]| {
                (0..4).all(|cell| (found[cell] - row[cell]).abs() < 2e-8) && found[4] == row[4]
            };
            let place = rest.iter().position(at);
            assert!(place.is_some(), "{name}: no row {row:?} in {:?}", &rest[..rest.len().min(4)]);
            rest = &rest[place.map_or(0, |place| place + 1)..];
        }
        assert!(ours.len() * 10 >= theirs.len() * 9, "{name}: {} of {} rows", ours.len(), theirs.len());
        assert_eq!((ours[0][0], ours[ours.len() - 1][4]), (0.0, 0.0), "{name}");
    }
}

#[test]
fn the_events_of_modes_are_those_of_the_oracle_where_it_can_be_followed() {
    let operation = emulated(include_bytes!("data/f_modes.gcode"));
    let series = EventSeries::new(&operation, &EventOptions::default());
    // pyGCodeDecode up to the first move behind which it takes `G92` for a move.
    let ours = rows(&series.to_rows());
    let at = |time: f64| ours.iter().find(|row| (row[0] - time).abs() < 2e-8);
    for theirs in &rows(include_str!("data/f_modes_events.csv"))[..3] {
        let found = at(theirs[0]).unwrap_or_else(|| panic!("no row at {} in {ours:?}", theirs[0]));
        assert!((0..5).all(|cell| (found[cell] - theirs[cell]).abs() < 2e-8), "{found:?} {theirs:?}");
    }
    // The other planner all the way: a row at each change of acceleration, and no other.
    let mut expected = vec![0.0];
    let mut start = 0.0;
    for line in include_str!("data/f_modes_moves.csv").lines().skip(1) {
        let cell: Vec<f64> = line.split(',').map(|cell| cell.parse().expect("a number")).collect();
        let [_, _, entry, peak, exit, time] = cell[..] else { panic!("six cells: {line}") };
        let phases = [(peak - entry) / 500.0, time - (peak - exit) / 500.0, time];
        expected.extend(phases.map(|since| start + since));
        start += time;
    }
    let near = |a: f64, b: f64| (a - b).abs() < 1e-7;
    expected.dedup_by(|late, early| near(*late, *early));
    assert_eq!(series.len(), expected.len(), "{:?} {expected:?}", series.time);
    assert!(series.time.iter().zip(&expected).all(|(&found, &wanted)| near(found, wanted)));
    let end = series.at[series.len() - 1];
    assert!([20.0, -10.0, 0.0].iter().zip(end).all(|(wanted, found)| (wanted - found).abs() < 1e-9));
}

#[test]
fn the_series_of_a_whole_print_ends_when_the_oracle_does() {
    let text = include_bytes!("data/p_tile.gcode");
    for (junction, end) in
        [(JunctionModel::Grbl, 1168.825047846), (JunctionModel::PyGCodeDecode, 1168.870466695)]
    {
        let operation = machine(junction).process_additive(Commands::read(text).steps).expect("sound");
        let series = EventSeries::new(&operation, &EventOptions::default());
        assert!((series.time.last().expect("a row") - end).abs() < 1e-8);
        assert!(series.time.windows(2).all(|pair| pair[0] < pair[1]), "times grow");
    }
}

#[test]
fn the_field_over_the_way_is_the_way_of_the_deposits() {
    let operation = emulated(SQUARE);
    let options = EventOptions {
        fields: vec![EventField::Active, EventField::Power(150.0), EventField::BeadArea],
        max_position_error: 0.01,
        ..EventOptions::default()
    };
    let series = EventSeries::new(&operation, &options);
    let way = |index: usize| {
        let (from, to) = (series.at[index], series.at[index + 1]);
        (0..3).map(|axis| (to[axis] - from[axis]).powi(2)).sum::<f64>().sqrt()
    };
    let over = |field: usize| -> f64 {
        (0..series.len() - 1).map(|index| way(index) * series.fields[field].1[index]).sum()
    };
    assert!((over(0) - 1200.0).abs() < 1e-9);
    assert!((over(1) - 1200.0 * 150.0).abs() < 1e-6);
    assert!((over(2) - operation.volume()).abs() < 1e-9);
    assert_eq!(series.to_inp().matches("*EVENT SERIES TYPE").count(), 3);
    // Between two rows the tool is where the straight line says.
    for index in 0..series.len() - 1 {
        let middle = 0.5 * (series.time[index] + series.time[index + 1]);
        let at = operation.at_time(middle).expect("there are steps").at;
        for (axis, found) in at.into_iter().enumerate() {
            let line = 0.5 * (series.at[index][axis] + series.at[index + 1][axis]);
            assert!((found - line).abs() < 0.01 + 1e-9, "{middle}: {found} {line}");
        }
    }
}

#[test]
fn metres_and_a_later_start() {
    let operation = emulated(b"M83\nG1 X10 E1 F600\nG1 X20\n");
    let options = EventOptions { unit: 0.001, time_offset: 5.0, ..EventOptions::default() };
    let series = EventSeries::new(&operation, &options);
    assert_eq!(series.time[0], 5.0);
    assert!((series.at[series.len() - 1][0] - 0.02).abs() < 1e-12);
}

#[test]
fn a_table_reads_back_to_the_bit() {
    let operation = emulated(VASE);
    let part = AdditivePart::new(&operation, BEAD, [0.0, 0.0, 1.0]).expect("a sound bead");
    for table in [Table::of_part(&part), Table::of_segments(&part), Table::of_layers(&part)] {
        let mut bytes = Vec::new();
        table.write_csv(&mut bytes).expect("memory takes all");
        let text = String::from_utf8(bytes).expect("text");
        let mut lines = text.lines();
        let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
        assert_eq!(names, table.columns().iter().map(|(name, _)| *name).collect::<Vec<_>>());
        let mut count = 0;
        for (row, line) in lines.enumerate() {
            for (cell, (name, column)) in line.split(',').zip(table.columns()) {
                match column {
                    Column::Word(words) => assert_eq!(cell, words[row]),
                    _ => assert_eq!(cell.parse::<f64>().ok(), column.number(row), "{name} in row {row}"),
                }
                assert_ne!(cell, "NaN");
            }
            count += 1;
        }
        assert_eq!(count, table.len());
    }
}

#[test]
fn the_columns_of_every_kind_of_process() {
    let program = Commands::read(b"G1 X10 E1 F600\n");
    let additive = machine(JunctionModel::Grbl).process_additive(program.steps).expect("sound");
    assert!(Table::of_additive(&additive).column("bead_area").is_some());
    let flavor = gcode::Flavor::named("grbl").expect("built in");
    let milling = Commands::read_as(b"M3 S6000\nG1 X0 Z-2 F600\nG1 X10\nM5\nG1 X20\n", flavor);
    let mill = Machine { cutter: Some(3.0), ..machine(JunctionModel::Grbl) };
    let subtractive = mill.process_subtractive(milling.steps).expect("sound");
    let table = Table::of_subtractive(&subtractive);
    let last = table.len() - 1;
    assert_eq!(table.column("removed_volume").and_then(|column| column.number(last)), Some(60.0));
    assert_eq!(table.column("spindle_rpm").and_then(|column| column.number(2)), Some(6000.0));
}

#[test]
fn cells_have_the_data_of_their_steps() {
    let operation = emulated(SQUARE);
    let part = AdditivePart::new(&operation, BEAD, [0.0, 0.0, 1.0]).expect("a sound bead");
    let temperature: Vec<f64> = (0..12).map(f64::from).collect();
    let mesh = PolyData::of(&part, &[("temperature", &temperature)]).expect("as many as cells");
    assert_eq!((mesh.cells(), mesh.points.len()), (12, 15));
    for name in ["feed_rate", "elapsed_time", "deposited_volume", "layer_time", "bead_area", "line"] {
        assert!(mesh.data(name).is_some(), "{name}");
    }
    assert_eq!(mesh.data("layer"), Some(&CellData::I32(vec![0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2])));
    assert_eq!(mesh.data("temperature"), Some(&CellData::F64(temperature)));
    let Some(CellData::U32(lines)) = mesh.data("line") else { panic!("lines are whole numbers") };
    assert_eq!(lines[..5], [9, 10, 11, 12, 15]);
}

#[test]
fn scalars_that_do_not_fit_are_refused() {
    let operation = emulated(SQUARE);
    let part = AdditivePart::new(&operation, BEAD, [0.0, 0.0, 1.0]).expect("a sound bead");
    let refused = |name: &str, count: usize| {
        PolyData::of(&part, &[(name, &vec![0.0; count])]).expect_err("refused").message
    };
    let wrong = refused("heat", 7);
    assert!(wrong.contains('7') && wrong.contains("12"), "{wrong}");
    assert!(refused("layer", 12).contains("already"));
    assert!(refused("two words", 12).contains("no name"));
    assert!(refused("a\"/><b", 12).contains("no name"));
}

#[test]
fn the_legacy_file_is_made_as_the_format_says() {
    let operation = emulated(b"M83\nG1 X10 E1 F600\n");
    let part = AdditivePart::new(&operation, BEAD, [0.0, 0.0, 1.0]).expect("a sound bead");
    let mesh = PolyData::of(&part, &[]).expect("no scalars");
    let mut file = Vec::new();
    mesh.write_vtk(&mut file).expect("memory takes all");
    let head = b"# vtk DataFile Version 3.0\nclayforge\nBINARY\nDATASET POLYDATA\nPOINTS 2 float\n";
    let points = [0f32, 0.0, 0.0, 10.0, 0.0, 0.0].map(f32::to_be_bytes).concat();
    let lines = [2i32, 0, 1].map(i32::to_be_bytes).concat();
    let expected =
        [&head[..], &points, b"\nLINES 1 3\n", &lines, b"\nCELL_DATA 1\nSCALARS feed_rate float 1\n"]
            .concat();
    assert_eq!(&file[..expected.len()], expected);
}

#[test]
fn a_part_without_deposits_is_a_file_all_the_same() {
    let operation = emulated(b"G1 X10 F600\n");
    let part = AdditivePart::new(&operation, BEAD, [0.0, 0.0, 1.0]).expect("a sound bead");
    let mesh = PolyData::of(&part, &[]).expect("no scalars");
    let mut file = Vec::new();
    mesh.write_vtk(&mut file).expect("memory takes all");
    let text = String::from_utf8_lossy(&file);
    // VTK 9.7 refuses `LINES 0 0`.
    assert!(
        text.contains("POINTS 0 float") && text.contains("CELL_DATA 0") && !text.contains("LINES"),
        "{text}"
    );
}
