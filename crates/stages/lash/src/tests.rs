use super::*;
use skein::{Layer, Reader};

fn places(text: &str) -> Vec<(i32, i32)> {
    let mut reader = Reader::default();
    let lines = text.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect();
    let skein = Skein { layers: vec![Layer { lines }], ..Skein::default() };
    let skein = Lash::default().craft(skein, &mut Notes::default()).expect("lash");
    skein.lines().filter_map(Line::as_move).map(|step| (step.to.x, step.to.y)).collect()
}

/// stages_tests.md A1, A2 (as meant, D19: no motion is no motion), A3, A4.
#[test]
fn a1_to_a4_the_play_of_each_axis() {
    assert_eq!(
        places("G1 X0 Y50 Z0.2\nG1 X0 Y0 Z0.2\nG1 X20 Y0 Z0.2"),
        [(0, 50_000), (0, -300), (20_200, -300)],
    );
    assert_eq!(
        places("G1 X0 Y0 Z0.2\nG1 X60 Y0 Z0.2\nG1 X60 Y1 Z0.2\nG1 X40 Y1 Z0.2"),
        [(0, 0), (60_200, 0), (60_200, 1300), (39_800, 1300)],
    );
}
