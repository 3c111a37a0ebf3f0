//! The acceptance rows of widen (stages_tests.md §3).

use crate::Widen;
use skein::{Direction, Line, Notes, Point, Ring, Skein, Stage, Tag, boundary};
use std::fmt::Write;

const HEAD: &str = "(<extruderInitialization>)\n(<layerHeight> 0.4 </layerHeight>)\n\
                    (<beadSection> rectangle </beadSection>)\n(<edgeWidth> 0.72 </edgeWidth>)\n\
                    (</extruderInitialization>)\n(<crafting>)\n";

fn layer(outlines: &[Ring], before: &str, after: &str) -> Skein {
    let mut text = format!("{HEAD}(<layer> 0.2 )\n{before}");
    for ring in outlines {
        text.push_str("(<nestedRing>)\n(<boundaryPerimeter>)\n");
        for point in &ring.0 {
            let (x, y) = (f64::from(point.x) / 1000.0, f64::from(point.y) / 1000.0);
            let _ = writeln!(text, "(<boundaryPoint> X{x:.3} Y{y:.3} Z0.2 </boundaryPoint>)");
        }
        text.push_str("(</boundaryPerimeter>)\n(</nestedRing>)\n");
    }
    let _ = write!(text, "{after}(</layer>)\n(</crafting>)\n");
    Skein::read(text.as_bytes()).expect("a skein")
}

fn craft(skein: Skein) -> (Skein, Notes) {
    let mut notes = Notes::default();
    let skein = Widen::default().craft(skein, &mut notes).expect("widen");
    skein.verify().expect("lawful skein");
    (skein, notes)
}

fn widened(outlines: &[Ring]) -> Vec<Ring> {
    boundary(&craft(layer(outlines, "", "")).0.layers[0].lines)
}

fn unchanged(outlines: &[Ring]) {
    let before = layer(outlines, "", "");
    let (after, notes) = craft(before.clone());
    assert_eq!(before, after);
    assert!(notes.is_empty());
}

fn square(x: (i32, i32), y: (i32, i32)) -> Ring {
    Ring([(x.0, y.0), (x.1, y.0), (x.1, y.1), (x.0, y.1)].map(|(x, y)| Point::new(x, y)).to_vec())
}

fn circle(radius: f64) -> Ring {
    let point = |corner: i32| {
        let angle = std::f64::consts::TAU * f64::from(corner) / 48.0;
        Point::new((radius * angle.cos()).round() as i32, (radius * angle.sin()).round() as i32)
    };
    Ring((0..48).map(point).collect())
}

fn tube(outer: f64, inner: f64) -> Vec<Ring> {
    vec![circle(outer), circle(inner).reversed()]
}

fn radius(point: &Point) -> f64 {
    f64::from(point.x).hypot(f64::from(point.y))
}

/// How far a place is from a ring.
fn distance(place: Point, ring: &Ring) -> f64 {
    let to = |(from, to): (Point, Point)| {
        let ((x, y), (u, v)) = (from.delta(to), from.delta(place));
        let share = ((x * u + y * v) as f64 / (x * x + y * y) as f64).clamp(0.0, 1.0);
        (u as f64 - share * x as f64).hypot(v as f64 - share * y as f64)
    };
    ring.segments().map(to).fold(f64::INFINITY, f64::min)
}

#[test]
fn w1_the_outside_of_a_thin_wall_moves_and_the_hole_does_not() {
    let rings = widened(&tube(15_000.0, 14_200.0));
    assert_eq!(rings.len(), 2);
    assert_eq!(rings[0], circle(14_200.0).reversed());
    for point in &rings[1].0 {
        assert!((radius(point) - 15_640.0).abs() < 40.0, "{}", radius(point));
    }
    // The corners of a 48-gon stand out by 0.2 % over its sides.
    for (from, to) in rings[1].segments() {
        let middle = Point::new(i32::midpoint(from.x, to.x), i32::midpoint(from.y, to.y));
        assert!((radius(&middle) - 15_640.0).abs() < 40.0);
    }
}

#[test]
fn w3_a_thick_wall_stays_to_the_byte() {
    unchanged(&tube(15_000.0, 8_000.0));
    unchanged(&[circle(15_000.0)]);
    unchanged(&[]);
}

#[test]
fn w4_the_outside_bulges_where_a_hole_is_near_and_nowhere_else() {
    let hole = square((17_000, 22_000), (500, 5_500)).reversed();
    let rings = widened(&[square((0, 40_000), (0, 40_000)), hole.clone()]);
    assert_eq!(rings.len(), 2);
    let outside = &rings[1];
    for corner in [(0, 0), (40_000, 0), (40_000, 40_000), (0, 40_000)] {
        assert!(outside.0.contains(&Point::new(corner.0, corner.1)), "{corner:?}");
    }
    let nearest = outside.segments().flat_map(|(from, to)| {
        (0..=100).map(move |step| {
            let at =
                |from: i32, to: i32| from + (f64::from(to - from) * f64::from(step) / 100.0).round() as i32;
            Point::new(at(from.x, to.x), at(from.y, to.y))
        })
    });
    let least = nearest.map(|place| distance(place, &hole)).fold(f64::INFINITY, f64::min);
    assert!((1438.0..1442.0).contains(&least), "{least}");
}

#[test]
fn w5_an_island_in_a_hole_stays() {
    let hole = square((1_000, 19_000), (1_000, 19_000)).reversed();
    let (island, its_hole) =
        (square((5_000, 15_000), (5_000, 15_000)), square((5_500, 14_500), (5_500, 14_500)).reversed());
    let rings = widened(&[square((0, 20_000), (0, 20_000)), hole.clone(), island.clone(), its_hole.clone()]);
    assert_eq!(rings.len(), 4);
    for kept in [&hole, &island, &its_hole] {
        assert!(rings.contains(kept));
    }
    assert_eq!(rings[3].bounds(), Some((Point::new(-440, -440), Point::new(20_440, 20_440))));
}

#[test]
fn w6_what_is_no_outline_stays_where_it_is() {
    let direction = Direction::X;
    let (skein, notes) = craft(layer(
        &tube(15_000.0, 14_200.0),
        &format!("(<bridgeRotation> {direction} )\n"),
        "M7 ; the potter turns the wheel\n(</bridgeRotation>)\n",
    ));
    let lines = &skein.layers[0].lines;
    assert_eq!(lines[1], Line::Rotation(Tag::BridgeRotation, direction));
    assert_eq!(lines[lines.len() - 2], Line::Close(Tag::BridgeRotation));
    assert!(matches!(lines[lines.len() - 3], Line::Verbatim(_)));
    assert_eq!(notes.summary().len(), 1);
}

#[test]
fn a_neighbour_that_is_run_into_becomes_one_with_the_part() {
    let mut outlines = tube(15_000.0, 14_200.0);
    outlines.push(square((15_300, 25_000), (-5_000, 5_000)));
    let rings = widened(&outlines);
    assert_eq!(rings.len(), 2);
    let area: f64 = rings.iter().map(Ring::area).sum();
    let apart: f64 = widened(&tube(15_000.0, 14_200.0)).iter().map(Ring::area).sum();
    assert!(area < apart + 97.0 && area > apart + 90.0, "{area} {apart}");
}
