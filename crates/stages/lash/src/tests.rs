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

/// While an axis takes up its play nothing is laid: the clay is that of the way of the nozzle.
#[test]
fn clay_goes_by_the_way_of_the_nozzle() {
    let text = "G1 X0 Y0 Z0.2\nM108 S0.8\nM101\nG1 X10 Y0 Z0.2\nG1 X20 Y0 Z0.2\nG1 X10 Y0 Z0.2\nM108 S0.5\nG1 X0 Y0 Z0.2\nM103";
    let mut reader = Reader::default();
    let lines: Vec<Line> = text.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect();
    let clay = |lines: &[Line]| {
        let mut nozzle = Nozzle::default();
        let mut clay = Vec::new();
        for line in lines {
            if let (true, Some(from), Some(_)) = (nozzle.on, nozzle.at, line.as_move()) {
                clay.push((line.length(from) * nozzle.flow.f64()).round());
            }
            nozzle.follow(line);
        }
        (clay, nozzle.flow)
    };
    let skein = Skein { layers: vec![Layer { lines: lines.clone() }], ..Skein::default() };
    let lash = Lash { x_backlash: Micron(500), ..Lash::default() };
    let done = lash.craft(skein, &mut Notes::default()).expect("lash");
    assert_eq!(clay(&done.layers[0].lines), clay(&lines));
    assert_eq!(clay(&lines).0, [8000.0, 8000.0, 8000.0, 5000.0]);
    let none = Lash { x_backlash: Micron(0), y_backlash: Micron(0) };
    let skein = Skein { layers: vec![Layer { lines }], ..Skein::default() };
    assert_eq!(none.craft(skein.clone(), &mut Notes::default()), Ok(skein));
}
