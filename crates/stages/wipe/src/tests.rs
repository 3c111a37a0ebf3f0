use super::*;
use skein::{Facts, Micron, Reader, Tag};

fn wipe() -> Wipe {
    let at = |x: i32, y: i32| Point3 { x: x * 1000, y: y * 1000, z: 50_000 };
    Wipe { arrival: at(-70, -50), wipe: at(-70, -70), departure: at(-70, -40), period: 3 }
}

fn layers(count: usize, text: &str) -> Skein {
    let mut reader = Reader::default();
    let lines: Vec<Line> = text.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect();
    let layers = (0..count).map(|_| Layer { lines: lines.clone() }).collect();
    let head = vec![Line::Close(Tag::ExtruderInitialization)];
    let mut skein = Skein { head, layers, ..Skein::default() };
    let facts =
        Facts { bead_width: Some(Micron(720)), travel_feed: Feed::from_mm_per_s(20.0), ..Facts::default() };
    skein.state(&facts).expect("facts");
    skein
}

const LAYER: &str = "(<layer> 0.2 )\nG1 X0 Y50 Z0.2\nM101\nG1 X20 Y50 Z0.2\nM103\n(</layer>)";

fn places(layer: &Layer) -> Vec<(i32, i32, i32)> {
    layer.lines.iter().filter_map(Line::as_move).map(|step| (step.to.x, step.to.y, step.to.z)).collect()
}

/// stages_tests.md V1.
#[test]
fn v1_before_layers_0_3_and_6() {
    let skein = wipe().craft(layers(7, LAYER), &mut Notes::default()).expect("wipe");
    let wiped: Vec<usize> = (0..7).filter(|index| places(&skein.layers[*index]).len() > 2).collect();
    assert_eq!(wiped, [0, 3, 6]);
}

/// stages_tests.md V2 and V3: the lift points of D17 are at the height of the brush.
#[test]
fn v2_v3_the_way_to_the_brush_and_to_the_first_bead() {
    let skein = wipe().craft(layers(1, LAYER), &mut Notes::default()).expect("wipe");
    assert_eq!(
        places(&skein.layers[0])[..6],
        [
            (-70_000, -50_000, 50_000),
            (-70_000, -70_000, 50_000),
            (-70_000, -40_000, 50_000),
            (-69_558, -39_432, 50_000),
            (-442, 49_432, 50_000),
            (0, 50_000, 200),
        ]
    );
}

/// stages_tests.md V4.
#[test]
fn v4_clay_stops_for_the_brush_and_starts_again() {
    let text = "(<layer> 0.2 )\nM101\nG1 X0 Y50 Z0.2\nM103\n(</layer>)";
    let mut skein = layers(1, text);
    skein.head.push(Reader::default().line(b"G1 X0 Y0 Z0.2").expect("a line"));
    skein.layers[0].lines.remove(1);
    skein.head.push(Line::On);
    let skein = wipe().craft(skein, &mut Notes::default()).expect("wipe");
    let lines = &skein.layers[0].lines;
    let (off, on) = (
        lines.iter().position(|line| *line == Line::Off).expect("off"),
        lines.iter().position(|line| *line == Line::On).expect("on"),
    );
    let brush = |line: &Line| line.as_move().is_some_and(|step| step.to == wipe().wipe);
    let brush = lines.iter().position(brush).expect("brush");
    assert!(off < brush && brush < on);
}

#[test]
fn a_brush_in_the_print_is_refused() {
    let inside = Wipe { wipe: Point3 { x: 10_000, y: 50_000, z: 100 }, ..wipe() };
    assert!(inside.craft(layers(1, LAYER), &mut Notes::default()).is_err());
}
