use super::*;
use skein::{Facts, Micron, Reader, Tag};

const SQUARE: &str = "\
(<layer> 0.2 )
(<edge> outer )
G1 X0.36 Y0.36 Z0.4
M101
G1 X19.64 Y0.36 Z0.4
G1 X19.64 Y19.64 Z0.4
G1 X0.36 Y19.64 Z0.4
G1 X0.36 Y0.36 Z0.4
M103
(</edge>)
(</layer>)";

fn layers(count: usize) -> Skein {
    let mut reader = Reader::default();
    let lines = || SQUARE.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect();
    let layers = std::iter::repeat_with(lines).take(count).map(|lines| Layer { lines }).collect();
    let head = vec![Line::Close(Tag::ExtruderInitialization)];
    let mut skein = Skein { head, layers, ..Skein::default() };
    skein.state(&Facts { bead_width: Some(Micron(720)), ..Facts::default() }).expect("facts");
    skein
}

/// Start of the wall of each layer.
fn starts(stage: &Jitter, skein: Skein) -> Vec<(i32, i32)> {
    let skein = stage.craft(skein, &mut Notes::default()).expect("jitter");
    let start = |layer: &Layer| layer.lines.iter().find_map(Line::as_move).map(|step| (step.to.x, step.to.y));
    skein.layers.iter().filter_map(start).collect()
}

/// stages_tests.md J1.
#[test]
fn j1_the_golden_sequence() {
    let stage = Jitter::default();
    for (layer, wanted) in [0.618034, 0.236068, 0.854102, 0.472136, 0.090170].into_iter().enumerate() {
        assert!((stage.share(layer) - wanted).abs() < 1e-9, "{layer}");
    }
}

/// stages_tests.md J3 (J2 is its defect D13): shifts of 0.17, -0.3801 and 0.5099.
#[test]
fn j3_seams_lie_on_both_sides_of_where_they_were() {
    assert_eq!(starts(&Jitter::default(), layers(3)), [(530, 360), (360, 740), (870, 360)]);
}

/// stages_tests.md J4.
#[test]
fn j4_the_wall_stays_the_same_wall() {
    for seams in [Seams::Golden, Seams::Random, Seams::Around] {
        let stage = Jitter { seams, ..Jitter::default() };
        let skein = stage.craft(layers(7), &mut Notes::default()).expect("jitter");
        for layer in &skein.layers {
            let steps: Vec<_> = layer.lines.iter().filter_map(Line::as_move).map(|step| step.to).collect();
            assert_eq!(steps.first(), steps.last(), "closed");
            let corners = [(360, 360), (19_640, 360), (19_640, 19_640), (360, 19_640)];
            assert!(corners.iter().all(|corner| steps.iter().any(|to| (to.x, to.y) == *corner)));
            let length: f64 = steps.windows(2).map(|pair| skein::Move::to(pair[1]).length(pair[0])).sum();
            assert!((length - 4.0 * 19_280.0).abs() < 1e-6);
        }
    }
}

/// stages_tests.md J5.
#[test]
fn j5_no_spread_changes_nothing_and_says_so() {
    let mut notes = Notes::default();
    let stage = Jitter { over_bead_width: Ratio(0), ..Jitter::default() };
    assert_eq!(stage.craft(layers(2), &mut notes), Ok(layers(2)));
    assert!(!notes.is_empty());
}

/// stages_tests.md J6, and open walls, which have no seam.
#[test]
fn j6_infill_stays_and_so_do_open_walls() {
    let infill = "(<layer> 0.2 )\n(<infill>)\nG1 X2 Y2 Z0.4\nM101\nG1 X9 Y2 Z0.4\nG1 X9 Y3 Z0.4\nG1 X2 Y2 Z0.4\nM103\n(</infill>)\n(</layer>)";
    let open = SQUARE.replace("G1 X0.36 Y0.36 Z0.4\nM103", "M103");
    assert_ne!(open, SQUARE);
    for text in [infill, &open] {
        let mut skein = layers(0);
        for _ in 0..3 {
            let mut reader = Reader::default();
            let lines = text.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect();
            skein.layers.push(Layer { lines });
        }
        assert_eq!(Jitter::default().craft(skein.clone(), &mut Notes::default()), Ok(skein));
    }
}
