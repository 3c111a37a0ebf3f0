//! The acceptance rows of inset (stages_tests.md §4).

use crate::{ExactWall, Inset, ThinWalls};
use skein::{Direction, Feature, Line, Notes, Nozzle, Point, Ratio, Ring, Side, Skein, Stage, Tag, boundary};
use std::fmt::Write;

const WIDTH: f64 = 720.0;

const HEAD: &str = "(<extruderInitialization>)\n(<layerHeight> 0.4 </layerHeight>)\n\
                    (<beadSection> rectangle </beadSection>)\n(<edgeWidth> 0.72 </edgeWidth>)\n\
                    (</extruderInitialization>)\n(<crafting>)\n";

fn layer(outlines: &[Ring], bridges: bool) -> Skein {
    let mut text = format!("{HEAD}(<layer> 0.2 )\n");
    text.push_str(if bridges { "(<bridgeRotation> (1+0j) )\n" } else { "" });
    for ring in outlines {
        text.push_str("(<nestedRing>)\n(<boundaryPerimeter>)\n");
        for point in &ring.0 {
            let (x, y) = (f64::from(point.x) / 1000.0, f64::from(point.y) / 1000.0);
            let _ = writeln!(text, "(<boundaryPoint> X{x:.3} Y{y:.3} Z0.2 </boundaryPoint>)");
        }
        text.push_str("(</boundaryPerimeter>)\n(</nestedRing>)\n");
    }
    text.push_str(if bridges { "(</bridgeRotation>)\n" } else { "" });
    text.push_str("(</layer>)\n(</crafting>)\n");
    Skein::read(text.as_bytes()).expect("a skein")
}

/// A bead: what it is for, its points, the flow on the way to each.
type Bead = (Feature, Vec<Point>, Vec<f64>);

fn craft(inset: &Inset, skein: Skein) -> (Vec<Bead>, Skein, Notes) {
    let mut notes = Notes::default();
    let skein = inset.craft(skein, &mut notes).expect("inset");
    skein.verify().expect("lawful skein");
    let mut nozzle = Nozzle::default();
    let mut beads: Vec<Bead> = Vec::new();
    for line in &skein.layers[0].lines {
        if let (Line::On, Some(at)) = (line, nozzle.at) {
            beads.push((nozzle.feature(), vec![Point::new(at.x, at.y)], Vec::new()));
        }
        if let (true, Some(step), Some((_, points, flows))) = (nozzle.on, line.as_move(), beads.last_mut()) {
            points.push(Point::new(step.to.x, step.to.y));
            flows.push(nozzle.flow.f64());
        }
        nozzle.follow(line);
    }
    (beads, skein, notes)
}

fn laid(inset: &Inset, outlines: &[Ring]) -> Vec<Bead> {
    craft(inset, layer(outlines, false)).0
}

fn polygon(points: &[(i32, i32)]) -> Ring {
    Ring(points.iter().map(|(x, y)| Point::new(*x, *y)).collect())
}

fn cube() -> Vec<Ring> {
    vec![polygon(&[(0, 0), (20_000, 0), (20_000, 20_000), (0, 20_000)])]
}

fn tube(outer: f64, inner: f64) -> Vec<Ring> {
    let circle = |radius: f64| {
        let point = |corner: i32| {
            let angle = std::f64::consts::TAU * f64::from(corner) / 48.0;
            Point::new((radius * angle.cos()).round() as i32, (radius * angle.sin()).round() as i32)
        };
        Ring((0..48).map(point).collect())
    };
    vec![circle(outer), circle(inner).reversed()]
}

fn share(value: f64) -> Ratio {
    Ratio::from_f64(value).expect("a share")
}

/// The least and the greatest distance of a bead's points from the origin.
fn radii(bead: &Bead) -> (f64, f64) {
    let radii = bead.1.iter().map(|point| f64::from(point.x).hypot(f64::from(point.y)));
    radii.fold((f64::INFINITY, 0.0), |(low, high), radius| (low.min(radius), high.max(radius)))
}

/// All of a bead lies at this radius; the corners of a 48-gon stand 0.2 % out over the middles of its sides.
fn assert_radius(bead: &Bead, radius: f64) {
    let (low, high) = radii(bead);
    assert!(low > 0.9975 * radius - 10.0 && high < 1.0025 * radius + 10.0, "{low} … {high} is not {radius}");
}

#[test]
fn n1_n7_the_wall_of_a_cube_is_a_square_and_its_outline_stays() {
    let (beads, skein, notes) = craft(&Inset::default(), layer(&cube(), false));
    let wall = polygon(&[(360, 360), (19_640, 360), (19_640, 19_640), (360, 19_640), (360, 360)]);
    assert_eq!(beads.len(), 1);
    assert_eq!((beads[0].0, &beads[0].1), (Feature::Edge(Side::Outer), &wall.0));
    assert_eq!(boundary(&skein.layers[0].lines), cube());
    assert!(notes.is_empty());
}

#[test]
fn n2_a_ring_has_an_outer_and_an_inner_wall() {
    let beads = laid(&Inset::default(), &tube(15_000.0, 8_000.0));
    assert_eq!(beads.len(), 2);
    assert_eq!((beads[0].0, beads[1].0), (Feature::Edge(Side::Outer), Feature::Edge(Side::Inner)));
    assert_radius(&beads[0], 14_640.0);
    assert_radius(&beads[1], 8_360.0);
}

/// Of a wall 0.8 thick the original lays one side alone. One bead takes all of its clay here, on the middle or on the side
/// that is wanted.
#[test]
fn n3_n4_a_thin_ring_is_one_bead_whose_exact_side_can_be_chosen() {
    let ring = tube(15_000.0, 14_200.0);
    for (exact_wall, radius) in
        [(ExactWall::Neither, 14_600.0), (ExactWall::Hole, 14_560.0), (ExactWall::Outside, 14_640.0)]
    {
        let inset = Inset { overlap_removal_width: share(0.6), exact_wall, ..Inset::default() };
        let beads = laid(&inset, &ring);
        assert_eq!(beads.len(), 1, "{exact_wall:?}");
        assert_eq!(beads[0].0, Feature::Middle);
        assert_radius(&beads[0], radius);
        let clay: f64 = beads[0]
            .1
            .windows(2)
            .zip(&beads[0].2)
            .map(|(pair, flow)| pair[0].distance(pair[1]) * flow * WIDTH)
            .sum();
        let wanted: f64 = ring.iter().map(Ring::area).sum::<f64>() * 1e6;
        assert!((clay / wanted - 1.0).abs() < 0.03, "{}", clay / wanted);
    }
}

#[test]
fn n5_a_smaller_width_leaves_both_walls() {
    for width in [0.0, 0.1] {
        let inset = Inset { overlap_removal_width: share(width), ..Inset::default() };
        let beads = laid(&inset, &tube(15_000.0, 14_200.0));
        assert_eq!(beads.len(), 2, "{width}");
        assert_radius(&beads[0], 14_640.0);
        assert_radius(&beads[1], 14_560.0);
    }
}

#[test]
fn n6_a_strip_thinner_than_a_bead_is_a_bead_or_a_note() {
    let strip = [polygon(&[(0, 0), (20_000, 0), (20_000, 500), (0, 500)])];
    let beads = laid(&Inset::default(), &strip);
    assert_eq!(beads.len(), 1);
    assert!(beads[0].1.iter().all(|point| (point.y - 250).abs() <= 1));
    let inset = Inset { thin_walls: ThinWalls::Report, ..Inset::default() };
    let (beads, _, notes) = craft(&inset, layer(&strip, false));
    assert!(beads.is_empty() && notes.summary().len() == 1);
}

#[test]
fn n8_the_direction_of_a_bridge_stays_behind_the_layer_and_its_walls_can_be_of_another_width() {
    let inset = Inset { bridge_width: share(0.5), ..Inset::default() };
    let (beads, skein, _) = craft(&inset, layer(&cube(), true));
    assert_eq!(skein.layers[0].lines[1], Line::Rotation(Tag::BridgeRotation, Direction::X));
    assert_eq!(beads[0].1[0], Point::new(180, 180));
    assert_eq!(laid(&inset, &cube())[0].1[0], Point::new(360, 360), "only on bridges");
}

#[test]
fn n9_walls_do_not_overlap_in_a_neck_and_no_crumb_is_laid() {
    let dumb_bell = [polygon(&[
        (0, 0),
        (10_000, 0),
        (10_000, 4_550),
        (16_000, 4_550),
        (16_000, 0),
        (26_000, 0),
        (26_000, 10_000),
        (16_000, 10_000),
        (16_000, 5_450),
        (10_000, 5_450),
        (10_000, 10_000),
        (0, 10_000),
    ])];
    let inset = Inset { overlap_removal_width: share(0.6), ..Inset::default() };
    let beads = laid(&inset, &dumb_bell);
    let walls = beads.iter().filter(|bead| bead.0.is_wall()).count();
    assert_eq!((walls, beads.len()), (2, 3));
    for (feature, points, _) in &beads {
        let length: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        assert!(length > 3.0 * WIDTH, "{length}");
        let in_neck = points.iter().filter(|point| (10_500..15_500).contains(&point.x)).count();
        assert!(in_neck == 0 || *feature == Feature::Middle);
    }
}

#[test]
fn no_line_heats() {
    let (_, skein, _) = craft(&Inset::default(), layer(&cube(), false));
    let text = String::from_utf8(skein.write()).expect("text");
    assert!(!text.contains("M104") && !text.contains("M105"));
}

#[test]
fn a_strip_without_a_hole_has_no_exact_side() {
    let strip = [polygon(&[(0, 0), (20_000, 0), (20_000, 900), (0, 900)])];
    let of = |exact_wall| {
        laid(&Inset { overlap_removal_width: share(0.6), exact_wall, ..Inset::default() }, &strip)
    };
    assert_eq!(of(ExactWall::Hole), of(ExactWall::Neither));
    assert_eq!(of(ExactWall::Outside), of(ExactWall::Neither));
}
