//! What the tests of fill have in common. The acceptance rows of stages_tests.md §5 are in `rows`.

mod layers;
mod patterns;
mod room;
mod rows;
mod surfaces;

use crate::{Fill, Pattern, Start};
use shape::plane::offset;
use skein::{Angle, Direction, Feature, Line, Notes, Nozzle, Point, Ratio, Ring, Side, Skein, Stage};
use std::fmt::Write;

/// A bead as on the rows: 0.72 mm wide, 0.4 mm high.
const WIDTH: f64 = 720.0;

const HEAD: &str = "(<extruderInitialization>)\n(<layerHeight> 0.4 </layerHeight>)\n\
                    (<beadSection> rectangle </beadSection>)\n(<edgeWidth> 0.72 </edgeWidth>)\n\
                    (</extruderInitialization>)\n(<crafting>)\n";

/// A bead as it was laid.
#[derive(Clone, Debug, PartialEq)]
struct Bead {
    feature: Feature,
    /// The points, each with the flow of the stretch that leads to it.
    points: Vec<(Point, f64)>,
}

impl Bead {
    fn stretches(&self) -> impl Iterator<Item = (Point, Point, f64)> + '_ {
        self.points.windows(2).map(|pair| (pair[0].0, pair[1].0, pair[1].1))
    }

    /// In millimetres.
    fn length(&self) -> f64 {
        self.stretches().map(|(from, to, _)| from.distance(to) / 1000.0).sum()
    }
}

fn rectangle(low: (i32, i32), high: (i32, i32)) -> Ring {
    Ring(
        [(low.0, low.1), (high.0, low.1), (high.0, high.1), (low.0, high.1)]
            .map(|(x, y)| Point::new(x, y))
            .to_vec(),
    )
}

fn square(side: i32) -> Ring {
    rectangle((0, 0), (side, side))
}

/// Layers as inset leaves them.
fn inset(layers: &[(Vec<Ring>, Option<Direction>)]) -> Skein {
    let mut text = HEAD.to_owned();
    for (index, (outlines, bridge)) in layers.iter().enumerate() {
        let z = 0.2 + 0.4 * index as f64;
        let _ = writeln!(text, "(<layer> {z:.1} )");
        if let Some(direction) = bridge {
            let _ = writeln!(text, "(<bridgeRotation> {direction} )");
        }
        for ring in outlines {
            text.push_str("(<nestedRing>)\n(<boundaryPerimeter>)\n");
            for point in &ring.0 {
                let (x, y) = (f64::from(point.x) / 1000.0, f64::from(point.y) / 1000.0);
                let _ = writeln!(text, "(<boundaryPoint> X{x:.3} Y{y:.3} Z{z:.1} </boundaryPoint>)");
            }
            text.push_str("(</boundaryPerimeter>)\n(</nestedRing>)\n");
        }
        for ring in offset(outlines, -WIDTH / 2.0) {
            let side = if Side::of(&ring) == Side::Outer { "outer" } else { "inner" };
            let _ = writeln!(text, "(<edge> {side} )");
            for (index, point) in ring.0.iter().chain(ring.0.first()).enumerate() {
                let (x, y) = (f64::from(point.x) / 1000.0, f64::from(point.y) / 1000.0);
                let _ = writeln!(text, "G1 X{x:.3} Y{y:.3} Z{:.1}", z + 0.2);
                if index == 0 {
                    text.push_str("M101\n");
                }
            }
            text.push_str("M103\n(</edge>)\n");
        }
        if bridge.is_some() {
            text.push_str("(</bridgeRotation>)\n");
        }
        text.push_str("(</layer>)\n");
    }
    text.push_str("(</crafting>)\n");
    Skein::read(text.as_bytes()).expect("a skein")
}

/// So many equal layers.
fn stack(outlines: &[Ring], count: usize) -> Skein {
    inset(&vec![(outlines.to_vec(), None); count])
}

fn craft(fill: &Fill, skein: Skein) -> (Skein, Notes) {
    let mut notes = Notes::default();
    let filled = fill.craft(skein, &mut notes).expect("fill");
    filled.verify().expect("lawful skein");
    assert_eq!(Skein::read(&filled.write()).as_ref(), Ok(&filled), "reading undoes writing");
    (filled, notes)
}

/// The beads of each layer in order.
fn beads(skein: &Skein) -> Vec<Vec<Bead>> {
    let of_layer = |lines: &[Line]| {
        let mut nozzle = Nozzle::default();
        let mut beads: Vec<Bead> = Vec::new();
        for line in lines {
            if let (Line::On, Some(at)) = (line, nozzle.at) {
                beads.push(Bead { feature: nozzle.feature(), points: vec![(Point::new(at.x, at.y), 1.0)] });
            }
            if let (true, Some(step), Some(bead)) = (nozzle.on, line.as_move(), beads.last_mut()) {
                bead.points.push((Point::new(step.to.x, step.to.y), nozzle.flow.f64()));
            }
            nozzle.follow(line);
        }
        beads
    };
    skein.layers.iter().map(|layer| of_layer(&layer.lines)).collect()
}

fn laid(fill: &Fill, skein: Skein) -> Vec<Vec<Bead>> {
    beads(&craft(fill, skein).0)
}

fn infill(beads: &[Bead]) -> Vec<&Bead> {
    beads.iter().filter(|bead| bead.feature == Feature::Infill).collect()
}

fn loops(beads: &[Bead]) -> usize {
    beads.iter().filter(|bead| matches!(bead.feature, Feature::Loop(_))).count()
}

fn ratio(value: f64) -> Ratio {
    Ratio::from_f64(value).expect("a ratio")
}

fn degrees(value: f64) -> Angle {
    Angle::from_degrees(value).expect("an angle")
}

/// The defaults of the original (SF50).
fn original() -> Fill {
    Fill {
        walls: 1,
        extra_shells_base: 1,
        extra_shells_alternating_solid_layer: 2,
        extra_shells_sparse_layer: 1,
        extra_shells_bridge_layer: 0,
        base_layers: 3,
        top_layers: 3,
        surrounding_angle: degrees(60.0),
        density: ratio(0.2),
        overlap: ratio(0.15),
        sharpest_angle: degrees(30.0),
        start: Start::LowerLeft,
        ..Fill::default()
    }
}

/// Nothing but walls and sparse infill.
fn sparse(density: f64, pattern: Pattern) -> Fill {
    Fill { walls: 1, base_layers: 0, top_layers: 0, density: ratio(density), pattern, ..Fill::default() }
}

/// The ways that a bead's corners turn, from 0° for straight on to 180° for back.
fn turns(bead: &Bead) -> impl Iterator<Item = f64> + '_ {
    bead.points.windows(3).map(|corner| {
        let (x, y) = corner[0].0.delta(corner[1].0);
        let (u, v) = corner[1].0.delta(corner[2].0);
        let (x, y, u, v) = (x as f64, y as f64, u as f64, v as f64);
        (x * v - y * u).atan2(x * u + y * v).to_degrees().abs()
    })
}

const CELLS: [Pattern; 4] =
    [Pattern::Rectangular, Pattern::Hexagonal, Pattern::Circular, Pattern::Concentric];

fn distance_to(place: (f64, f64), (from, to, _): (Point, Point, f64)) -> f64 {
    let (x, y) = from.delta(to);
    let (x, y) = (x as f64, y as f64);
    let (u, v) = (place.0 - f64::from(from.x), place.1 - f64::from(from.y));
    let share = ((x * u + y * v) / (x * x + y * y)).clamp(0.0, 1.0);
    ((u - share * x).powi(2) + (v - share * y).powi(2)).sqrt()
}

/// A star with a hole, its spikes as long as numbers say.
fn star(spikes: &[i32], hole: i32) -> Vec<Ring> {
    let around = |radius: f64, turn: f64| {
        Point::new(
            (60_000.0 + radius * turn.cos()).round() as i32,
            (60_000.0 + radius * turn.sin()).round() as i32,
        )
    };
    let step = std::f64::consts::TAU / spikes.len() as f64;
    let outer = spikes
        .iter()
        .enumerate()
        .map(|(index, spike)| around(f64::from(*spike), index as f64 * step))
        .collect();
    let inner = (0..12).rev().map(|corner| around(f64::from(hole), f64::from(corner) * step)).take(12);
    let inner = Ring(inner.collect());
    if inner.area2() < 0 && spikes.len() == 12 { vec![Ring(outer), inner] } else { vec![Ring(outer)] }
}
