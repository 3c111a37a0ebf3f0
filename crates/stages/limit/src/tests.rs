use super::*;
use skein::{Facts, Layer, Micron, Reader, Tag};

fn feeds(text: &str) -> Vec<Option<u32>> {
    let mut reader = Reader::default();
    let lines = text.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect();
    let head = vec![Line::Close(Tag::ExtruderInitialization)];
    let mut skein = Skein { head, layers: vec![Layer { lines }], ..Skein::default() };
    let one = Feed::from_mm_per_s(1.0);
    let facts = Facts { z_feed: one, bead_width: Some(Micron(3000)), ..Facts::default() };
    skein.state(&facts).expect("facts");
    let limit = Limit { maximum_initial_feed: one.expect("a feed") };
    let skein = limit.craft(skein, &mut Notes::default()).expect("limit");
    skein.lines().filter_map(Line::as_move).map(|step| step.feed.map(Feed::get)).collect()
}

/// stages_tests.md LI1 to LI3.
#[test]
fn li1_to_li3_first_move_and_steep_moves() {
    assert_eq!(
        feeds("G1 X0 Y0 Z0.2 F1200\nG1 X10 Y0 Z10.2 F1200\nG1 X11 Y0 Z10.7 F600\nG1 X40 Y0 Z10.7"),
        [Some(60_000), Some(84_853), Some(134_164), Some(600_000)],
    );
}

#[test]
fn a_move_that_goes_nowhere_is_left_out_unless_it_pushes() {
    assert_eq!(
        feeds("G1 X0 Y0 Z0.2 F60\nG1 X0 Y0 Z0.2 F30\nG1 X0 Y0 Z0.2 E1\nG1 X9 Y0 Z0.2"),
        [Some(60_000), Some(30_000), None],
    );
}
