//! What is handed on as it is.

use super::{CELLS, HEAD, craft, inset, laid, original, rectangle, square, stack};
use crate::Fill;
use skein::{Line, Mark, Skein, Tag};
use std::fmt::Write;

#[test]
fn layers_without_a_part_pass_and_the_rest_is_filled() {
    let layers = [(vec![], None), (vec![square(10_000)], None), (vec![], None)];
    for pattern in CELLS {
        let layers = laid(&Fill { pattern, ..Fill::default() }, inset(&layers));
        assert!(layers[0].is_empty() && !layers[1].is_empty() && layers[2].is_empty());
    }
}

#[test]
fn the_outline_is_handed_on() {
    let (skein, _) = craft(&original(), stack(&[square(20_000)], 1));
    assert_eq!(skein.lines().filter(|line| matches!(line, Line::Point(Mark::Boundary, _))).count(), 4);
}

/// Beads on the middle of thin islands stick out at their ends, and some islands have none: every outline stays, with
/// the beads that lie on it.
#[test]
fn no_outline_is_lost() {
    let mut text = format!("{HEAD}(<layer> 0.2 )\n");
    // A frame, a strip inside it, one beside it, and a speck.
    let frame = [rectangle((0, 0), (20_000, 20_000)), rectangle((2_000, 2_000), (18_000, 18_000)).reversed()];
    let strips = [rectangle((9_000, 4_000), (9_500, 14_000)), rectangle((22_000, 0), (22_500, 10_000))];
    let outlines = [&frame[..], &strips, &[rectangle((30_000, 0), (30_100, 100))]].concat();
    for ring in &outlines {
        text.push_str("(<nestedRing>)\n(<boundaryPerimeter>)\n");
        for point in &ring.0 {
            let (x, y) = (f64::from(point.x) / 1000.0, f64::from(point.y) / 1000.0);
            let _ = writeln!(text, "(<boundaryPoint> X{x:.3} Y{y:.3} Z0.2 </boundaryPoint>)");
        }
        text.push_str("(</boundaryPerimeter>)\n(</nestedRing>)\n");
    }
    // From outside their islands up the middle.
    for (x, low) in [(9.25, 3.9), (22.25, -0.1)] {
        let _ = write!(text, "G1 X{x} Y{low} Z0.4\nM101\n");
        for step in 1..=5 {
            let _ = writeln!(text, "G1 X{x} Y{:.1} Z0.4", low + 2.0 * f64::from(step));
        }
        text.push_str("M103\n");
    }
    text.push_str("(</layer>)\n(</crafting>)\n");
    let (filled, _) = craft(&Fill::default(), Skein::read(text.as_bytes()).expect("a skein"));
    let mut islands: Vec<(usize, usize)> = Vec::new();
    for line in &filled.layers[0].lines {
        match (line, islands.last_mut()) {
            (Line::Open(Tag::NestedRing), _) => islands.push((0, 0)),
            (Line::Open(Tag::BoundaryPerimeter), Some((outlines, _))) => *outlines += 1,
            (Line::On, Some((_, beads))) => *beads += 1,
            _ => {}
        }
    }
    islands.sort_unstable();
    assert_eq!(islands, [(1, 0), (1, 1), (1, 1), (2, 0)]);
}
