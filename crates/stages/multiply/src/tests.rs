use super::*;
use skein::{Facts, Reader, Signature, Value};

const LAYER: &str = "\
(<layer> 0.2 )
(<nestedRing>)
(<boundaryPerimeter>)
(<boundaryPoint> X0 Y0 Z0.2 </boundaryPoint>)
(<boundaryPoint> X20 Y0 Z0.2 </boundaryPoint>)
(<boundaryPoint> X20 Y20 Z0.2 </boundaryPoint>)
(<edge> outer )
G1 X0.36 Y0.36 Z0.4
M101
G1 X19.64 Y0.36 Z0.4
G1 X19.64 Y19.64 Z0.4
G1 X0.36 Y0.36 Z0.4
M103
(</edge>)
(</boundaryPerimeter>)
(</nestedRing>)
(</layer>)";

fn layers(count: usize) -> Skein {
    let mut reader = Reader::default();
    let lines = || LAYER.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect();
    let layers = std::iter::repeat_with(lines).take(count).map(|lines| Layer { lines }).collect();
    let head = vec![Line::Close(Tag::ExtruderInitialization)];
    let mut skein = Skein { head, layers, ..Skein::default() };
    skein.state(&Facts { bead_width: Some(Micron(720)), ..Facts::default() }).expect("facts");
    skein
}

fn multiply(columns: u32, rows: u32, x: i32, y: i32) -> Multiply {
    let separation_over_bead_width = Ratio::from_f64(15.0).expect("a ratio");
    let center = Point::new(x, y);
    Multiply {
        columns,
        rows,
        separation_over_bead_width,
        place: Place::Center,
        center,
        ..Multiply::default()
    }
}

/// Where the thread of each copy starts, layer by layer.
fn starts(stage: &Multiply, count: usize) -> Vec<Vec<(i32, i32)>> {
    let skein = stage.craft(layers(count), &mut Notes::default()).expect("multiply");
    let of = |layer: &Layer| {
        let pairs = layer.lines.windows(2).filter(|pair| pair[1] == Line::On);
        pairs.filter_map(|pair| pair[0].as_move()).map(|step| (step.to.x, step.to.y)).collect()
    };
    skein.layers.iter().map(of).collect()
}

/// stages_tests.md M1, M2 and M6.
#[test]
fn m1_m2_m6_two_rows_of_two() {
    let order = [(-24_680, -24_680), (5_400, -24_680), (5_400, 5_400), (-24_680, 5_400)];
    assert_eq!(starts(&multiply(2, 2, 0, 0), 2), [order, order]);
}

/// stages_tests.md M3.
#[test]
fn m3_one_row_goes_to_and_fro() {
    let starts = starts(&multiply(2, 1, 0, 0), 2);
    assert!(starts[0][0].0 < starts[0][1].0 && starts[1][0].0 > starts[1][1].0);
}

/// stages_tests.md M4.
#[test]
fn m4_one_copy_is_centred() {
    assert_eq!(starts(&multiply(1, 1, 100_000, 100_000), 1), [[(90_360, 90_360)]]);
}

/// stages_tests.md M5.
#[test]
fn m5_one_layer_tag_and_outlines_that_move_along() {
    let skein = multiply(2, 2, 0, 0).craft(layers(2), &mut Notes::default()).expect("multiply");
    assert_eq!(skein.lines().filter(|line| matches!(line, Line::Layer(_))).count(), 2);
    assert_eq!(skein.lines().filter(|line| **line == Line::Close(Tag::Layer)).count(), 2);
    let first: Vec<i32> = skein.layers[0]
        .lines
        .iter()
        .filter_map(|line| match line {
            Line::Point(_, at) => Some(at.x),
            _ => None,
        })
        .step_by(3)
        .collect();
    assert_eq!(first, [-25_040, 5_040, 5_040, -25_040]);
    assert_eq!(skein.verify(), Ok(()));
}

#[test]
fn odd_layers_can_begin_where_the_one_below_has_ended() {
    let stage = Multiply { reverse_odd_layers: true, ..multiply(1, 3, 0, 0) };
    let starts = starts(&stage, 2);
    assert_eq!(starts[0].iter().rev().collect::<Vec<_>>(), starts[1].iter().collect::<Vec<_>>());
}

#[test]
fn more_than_fits_any_machine_is_refused() {
    let stage = Multiply {
        separation_over_bead_width: Ratio::from_f64(1000.0).expect("a ratio"),
        ..multiply(1000, 1000, 0, 0)
    };
    let mut skein = layers(1);
    skein.state(&Facts { bead_width: Some(Micron(100_000)), ..Facts::default() }).expect("facts");
    assert!(stage.craft(skein, &mut Notes::default()).is_err());
}

/// Found by fuzzing: what stands behind the end of a layer was repeated with it.
#[test]
fn the_end_of_a_layer_is_not_repeated() {
    let mut skein = layers(1);
    skein.layers[0].lines.push(Line::Verbatim("(a remark)".into()));
    let skein = multiply(2, 1, 0, 0).craft(skein, &mut Notes::default()).expect("multiply");
    assert_eq!(skein.verify(), Ok(()));
    assert_eq!(skein.layers[0].lines.iter().filter(|line| **line == Line::Off).count(), 2);
}

/// Found by fuzzing: a bead that ends behind the end of its layer was begun again before it had ended.
#[test]
fn a_bead_that_ends_behind_its_layer_is_refused() {
    let mut skein = layers(1);
    skein.layers[0].lines.retain(|line| *line != Line::Off);
    skein.layers[0].lines.push(Line::Off);
    assert_eq!(skein.verify(), Ok(()));
    assert!(multiply(2, 1, 0, 0).craft(skein, &mut Notes::default()).is_err());
}

/// Found by fuzzing: a bead that the last layer leaves open cannot be begun again for the next copy.
#[test]
fn a_bead_that_never_ends_is_refused() {
    let mut skein = layers(1);
    skein.layers[0].lines.retain(|line| *line != Line::Off);
    assert!(multiply(2, 1, 0, 0).craft(skein, &mut Notes::default()).is_err());
}

/// The hint names what makes clay go on, and nothing that is off.
#[test]
fn the_hint_of_a_refusal_names_what_is_on() {
    let signed = |stages: &[(&str, &[(&'static str, Value)])]| {
        let mut skein = layers(1);
        skein.head.insert(0, Line::Close(Tag::Settings));
        skein.layers[0].lines.retain(|line| *line != Line::Off);
        for (stage, settings) in stages {
            skein.sign(&Signature::new(stage, settings)).expect("a signature");
        }
        let error = multiply(2, 1, 0, 0).craft(skein, &mut Notes::default()).expect_err("a refusal");
        error.hint.expect("a hint")
    };
    let through = |on: bool| [("through_layers", Value::from(on))];
    let (on, off) = (through(true), through(false));
    let apart = "print the parts one after the other";
    assert_eq!(signed(&[("join", &off)]), apart);
    assert_eq!(signed(&[("join", &on)]), format!("{apart}, or set `join.through_layers` to false"));
    assert_eq!(signed(&[("coil", &[]), ("join", &off)]), format!("{apart}, or set `coil.active` to false"));
    let both = format!("{apart}, or set `coil.active` and `join.through_layers` to false");
    assert_eq!(signed(&[("coil", &[]), ("join", &on)]), both);
}
