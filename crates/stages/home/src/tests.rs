use super::*;
use skein::{Facts, Micron, Reader, Tag};

fn layers() -> Skein {
    let mut reader = Reader::default();
    let mut layer = |z: f64| {
        let text =
            format!("(<layer> {z} )\nG1 X0 Y0 Z{z}\nM101\nG1 X20 Y0 Z{z}\nM103\nG1 X0 Y0 Z{z}\n(</layer>)");
        Layer { lines: text.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect() }
    };
    let layers = [0.4, 0.8, 1.2].map(&mut layer).into();
    let head = vec![Line::Close(Tag::ExtruderInitialization)];
    let mut skein = Skein { head, layers, ..Skein::default() };
    let facts = Facts {
        layer_height: Some(Micron(400)),
        bead_width: Some(Micron(720)),
        travel_feed: Feed::from_mm_per_s(20.0),
        ..Facts::default()
    };
    skein.state(&facts).expect("facts");
    skein
}

/// stages_tests.md E1.
#[test]
fn e1_without_lines_nothing_happens() {
    assert_eq!(Home::default().craft(layers(), &mut Notes::default()), Ok(layers()));
}

/// stages_tests.md E2 and E3: the way of the second layer begins where the first has ended.
#[test]
fn e2_e3_before_every_layer_but_the_first_and_at_the_highest_place() {
    let home = Home { lines: "G28".to_owned(), clearance: Ratio(0), ..Home::default() };
    let skein = home.craft(layers(), &mut Notes::default()).expect("home");
    let pasted = Line::Pasted("G28".into());
    let at: Vec<Option<usize>> =
        skein.layers.iter().map(|layer| layer.lines.iter().position(|line| *line == pasted)).collect();
    assert_eq!(at[0], None);
    for (layer, top) in [(1, 400), (2, 800)] {
        let index = at[layer].expect("homed");
        let lines = &skein.layers[layer].lines;
        let near = |line: Option<&Line>| line.and_then(Line::as_move).map(|step| step.to.z);
        assert_eq!(near(lines[..index].iter().rev().find(|line| line.as_move().is_some())), Some(top));
        assert_eq!(near(lines[index..].iter().find(|line| line.as_move().is_some())), Some(top));
    }
}
