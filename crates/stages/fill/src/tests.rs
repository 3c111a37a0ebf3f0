//! The acceptance rows of fill (stages_tests.md §5) and the laws of its patterns.
//!
//! Where a row's number comes from the seed's own bead spacing (0.6 at a width of 0.72) it is held with ours (the bead's
//! area over its height), as the comment at the test says.

use crate::{Fill, Pattern, Start, ThreadSequence};
use proptest::prelude::*;
use shape::plane::offset;
use skein::{
    Angle, Direction, Feature, Line, Mark, Notes, Nozzle, Point, Ratio, Ring, Side, Skein, Stage, Tag,
};
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

#[test]
fn l1_inner_walls_lie_one_spacing_apart() {
    // The original mixes two widths (1.02 and 1.62); ours are 0.36 + n · 0.72.
    for beads in laid(&original(), stack(&[square(20_000)], 25)) {
        let mut walls: Vec<i32> = beads
            .iter()
            .filter(|bead| bead.feature.is_wall())
            .map(|bead| bead.points[0].0.x.min(20_000 - bead.points[0].0.x))
            .collect();
        walls.sort_unstable();
        let expected = [360, 1080, 1800];
        assert_eq!(walls, expected[..walls.len()]);
    }
}

#[test]
fn l2_solid_layers_have_more_walls_by_turns() {
    let counts: Vec<usize> =
        laid(&original(), stack(&[square(20_000)], 25)).iter().map(|beads| loops(beads)).collect();
    assert_eq!(counts[..3], [1, 2, 1]);
    assert!(counts[3..22].iter().all(|count| *count == 1), "{counts:?}");
    assert_eq!(counts[22..], [2, 1, 2]);
    assert_eq!(counts.iter().sum::<usize>(), 28);
}

#[test]
fn l3_the_first_layer_has_an_order_of_its_own() {
    let order = |beads: &[Bead]| {
        let letter = |bead: &Bead| match bead.feature {
            Feature::Edge(_) => 'p',
            Feature::Loop(_) => 'l',
            _ => 'i',
        };
        let mut order: String = beads.iter().map(letter).collect();
        let mut last = None;
        order.retain(|letter| last.replace(letter) != Some(letter));
        order
    };
    let sequences = [
        (ThreadSequence::LoopsPerimeterInfill, "lpi"),
        (ThreadSequence::LoopsInfillPerimeter, "lip"),
        (ThreadSequence::InfillLoopsPerimeter, "ilp"),
        (ThreadSequence::InfillPerimeterLoops, "ipl"),
        (ThreadSequence::PerimeterLoopsInfill, "pli"),
        (ThreadSequence::PerimeterInfillLoops, "pil"),
    ];
    for (thread_sequence, wanted) in sequences {
        let fill = Fill { thread_sequence, ..original() };
        let layers = laid(&fill, stack(&[square(20_000)], 9));
        assert_eq!(order(&layers[0]), "pli");
        assert!(layers[1..].iter().all(|layer| order(layer) == wanted), "{thread_sequence:?}");
        let fill = Fill { first_layer_sequence: thread_sequence, ..original() };
        assert_eq!(order(&laid(&fill, stack(&[square(20_000)], 9))[0]), wanted);
    }
}

#[test]
fn l4_l5_solid_infill_ends_inside_the_walls_and_fills_the_room() {
    let layers = laid(&original(), stack(&[square(20_000)], 25));
    // A spacing less 0.15 of a bead inside the last wall; the original with its own spacing: 1.53 and 2.13.
    for (layer, reach) in [(0, 1080 + 612), (1, 1800 + 612)] {
        let infill = infill(&layers[layer]);
        for (point, _) in infill.iter().flat_map(|bead| &bead.points) {
            let inside = |value: i32| (reach - 1..=20_001 - reach).contains(&value);
            assert!(inside(point.x) && inside(point.y), "{point:?}");
        }
        // 509.6 and 441.9 mm at a spacing of 0.6 are the room; at ours the same room takes 0.6 / 0.72 of it.
        let clay: f64 = infill
            .iter()
            .flat_map(|bead| bead.stretches())
            .map(|(a, b, flow)| a.distance(b) * flow * WIDTH)
            .sum();
        let room = f64::from(20_000 - 2 * (reach - 360 + 108)).powi(2);
        assert!((clay / room - 1.0).abs() < 0.02, "{}", clay / room);
    }
}

#[test]
fn l6_sparse_layers_hold_their_share_by_turns_in_two_directions() {
    // The original: 142.4 and 164.5 mm at 0.6 between beads; its first and last lines are always laid and its sparse
    // infill is therefore nearer to 0.3. Ours is the share asked for and the ways along the wall.
    for beads in &laid(&original(), stack(&[square(20_000)], 25))[3..22] {
        let length: f64 = infill(beads).iter().map(|bead| bead.length()).sum();
        let share = length * 0.72 / 17.0f64.powi(2);
        assert!((0.18..0.30).contains(&share), "{share}");
    }
}

#[test]
fn l7_lines_run_at_45_and_135_degrees() {
    for (index, beads) in laid(&original(), stack(&[square(20_000)], 25)).iter().enumerate() {
        // What is level or upright runs along a wall.
        let along = |(from, to, _): &(Point, Point, f64)| {
            from.distance(*to) > 3000.0 && from.x != to.x && from.y != to.y
        };
        let long: Vec<_> = infill(beads).into_iter().flat_map(Bead::stretches).filter(along).collect();
        assert!(long.len() > 3, "layer {index}");
        for (from, to, _) in long {
            let (x, y) = from.delta(to);
            let across = if index % 2 == 0 { x - y } else { x + y };
            assert!(across.abs() <= 3, "layer {index}: {from:?} {to:?}");
        }
    }
}

#[test]
fn l8_sparse_lines_are_the_nearest_to_the_share() {
    // The original picks of its lines k those nearest to n / share; ours lie at n / share.
    let picked = [
        (0.2, vec![0, 5, 10, 15, 20, 25, 30]),
        (0.35, vec![0, 3, 6, 9, 11, 14, 17, 20, 23, 26, 29, 31]),
        (0.3, vec![0, 3, 7, 10, 13, 17, 20, 23, 27, 30]),
        (0.5, (0..16).map(|k| 2 * k).collect::<Vec<i32>>()),
    ];
    for (share, wanted) in picked {
        let fill = Fill { walls: 0, begin_rotation: Angle(0), ..sparse(share, Pattern::Line) };
        let part = rectangle((-1000, -1000), (30_000, 23_000));
        let beads = laid(&fill, stack(&[part], 1)).remove(0);
        let mut rows: Vec<i32> = infill(&beads)
            .into_iter()
            .flat_map(Bead::stretches)
            .filter(|(from, to, _)| from.y == to.y)
            .map(|(from, ..)| (f64::from(from.y) / WIDTH).round() as i32)
            .collect();
        rows.sort_unstable();
        rows.dedup();
        rows.retain(|row| *row >= 0);
        let wanted: Vec<i32> = wanted.into_iter().filter(|row| *row <= 31).collect();
        assert_eq!(rows, wanted[..rows.len()], "{share}");
        assert!(wanted.len() - rows.len() <= 1, "{share}");
    }
}

#[test]
fn l9_the_direction_turns_after_a_repeat() {
    let fill = Fill {
        begin_rotation: degrees(30.0),
        odd_layer_extra_rotation: degrees(60.0),
        begin_rotation_repeat: 2,
        ..Fill::default()
    };
    let said = |line: &Line| match line {
        Line::Rotation(Tag::Rotation, direction) => Some(*direction),
        _ => None,
    };
    let (skein, _) = craft(&fill, stack(&[square(20_000)], 6));
    let directions: Vec<Direction> = skein.lines().filter_map(said).collect();
    let wanted = [30.0, 30.0, 90.0, 30.0, 30.0, 90.0].map(|angle| degrees(angle).direction());
    assert_eq!(directions, wanted);
}

#[test]
fn l10_a_bridge_has_no_inner_walls_and_lines_along_it() {
    let slab = rectangle((0, 0), (30_000, 10_000));
    let mut layers = vec![(vec![slab], None); 9];
    layers[4].1 = Some(Direction::X);
    let laid = laid(&original(), inset(&layers));
    assert_eq!(loops(&laid[4]), 0);
    let infill = infill(&laid[4]);
    let long: Vec<_> = infill
        .iter()
        .flat_map(|bead| bead.stretches())
        .filter(|(from, to, _)| from.distance(*to) > 5000.0)
        .collect();
    assert!(!long.is_empty());
    for (from, to, _) in long {
        assert_eq!(from.y, to.y);
        // From wall to wall: the original from 0.93 to 29.07.
        assert_eq!((from.x.min(to.x), from.x.max(to.x)), (360 + 612, 30_000 - 972));
    }
}

#[test]
fn l11_a_bridge_changes_nothing_on_other_layers() {
    let slab = vec![square(20_000)];
    let mut layers = vec![(slab.clone(), None); 9];
    let without = laid(&original(), inset(&layers));
    layers[4].1 = Some(Direction::X);
    let with = laid(&original(), inset(&layers));
    for layer in [0, 1, 2, 3, 5] {
        assert_eq!(infill(&without[layer]).len(), infill(&with[layer]).len());
        let points = |beads: &[Bead]| {
            let mut points: Vec<Point> =
                infill(beads).into_iter().flat_map(|bead| &bead.points).map(|(point, _)| *point).collect();
            points.sort_unstable();
            points
        };
        assert_eq!(points(&without[layer]), points(&with[layer]), "layer {layer}");
    }
}

#[test]
fn l12_diaphragms_are_solid_again_and_again() {
    let fill = Fill { diaphragm_period: 10, diaphragm_thickness: 1, ..original() };
    let layers = laid(&fill, stack(&[square(20_000)], 25));
    let solid: Vec<usize> = (0..25)
        .filter(|layer| infill(&layers[*layer]).iter().map(|bead| bead.length()).sum::<f64>() > 250.0)
        .collect();
    assert_eq!(solid, [0, 1, 2, 10, 20, 22, 23, 24]);
}

#[test]
fn l13_without_surfaces_and_density_there_are_only_walls() {
    let fill = Fill { base_layers: 0, top_layers: 0, density: Ratio(0), ..original() };
    assert!(laid(&fill, stack(&[square(20_000)], 5)).iter().all(|beads| infill(beads).is_empty()));
}

#[test]
fn l14_an_island_is_finished_before_the_next_and_the_lowest_corner_comes_first() {
    let two = [rectangle((30_000, 0), (40_000, 10_000)), rectangle((0, 0), (10_000, 10_000))];
    for beads in laid(&original(), stack(&two, 25)) {
        let islands: Vec<bool> = beads.iter().map(|bead| bead.points[0].0.x > 20_000).collect();
        assert!(!islands[0], "begins at the lowest x + y");
        assert_eq!(islands.windows(2).filter(|pair| pair[0] != pair[1]).count(), 1);
    }
}

proptest! {
    /// L16: a solid layer holds as much clay as it is large, whatever its walls are.
    #[test]
    fn l16_a_solid_layer_holds_its_own_volume(
        wide in 8_000..40_000i32, deep in 8_000..40_000i32, walls in 1..4u32, turn in 0..180i32, overlap in 0..30i32,
    ) {
        let fill = Fill {
            walls,
            begin_rotation: Angle(turn * 1000),
            overlap: Ratio(overlap * 10_000),
            density: Ratio::ONE,
            ..Fill::default()
        };
        let beads = laid(&fill, stack(&[rectangle((0, 0), (wide, deep))], 1)).remove(0);
        let clay: f64 = beads.iter().flat_map(Bead::stretches).map(|(a, b, flow)| a.distance(b) * flow * WIDTH).sum();
        let share = clay / (f64::from(wide) * f64::from(deep));
        prop_assert!((0.95..1.10).contains(&share), "{share}");
    }
}

const CELLS: [Pattern; 4] =
    [Pattern::Rectangular, Pattern::Hexagonal, Pattern::Circular, Pattern::Concentric];

#[test]
fn every_pattern_lays_its_density() {
    let side = 250_000;
    for pattern in [&CELLS[..], &[Pattern::Line]].concat() {
        for density in [0.2, 0.45, 0.75] {
            let beads = laid(&sparse(density, pattern), stack(&[square(side)], 1)).remove(0);
            let length: f64 = infill(&beads).iter().map(|bead| bead.length()).sum();
            // What the wall leaves.
            let share = length * 0.72 / (f64::from(side) / 1000.0 - 1.44).powi(2);
            assert!((share / density - 1.0).abs() < 0.05, "{pattern:?} {density}: {share}");
        }
    }
}

#[test]
fn where_cells_have_no_room_lines_are_laid_and_it_is_said() {
    for pattern in &CELLS[..3] {
        let (skein, notes) = craft(&sparse(0.97, *pattern), stack(&[square(20_000)], 2));
        assert_eq!(notes.summary().len(), 1, "{pattern:?}");
        let lines = craft(&sparse(0.97, Pattern::Line), stack(&[square(20_000)], 2)).0;
        assert_eq!(beads(&skein), beads(&lines));
    }
}

/// The cells of a layer stand on those below: the middle of every long stretch lies on a bead of the layer below.
#[test]
fn cells_stand_on_cells() {
    for pattern in &CELLS[..3] {
        let layers = laid(&sparse(0.2, *pattern), stack(&[square(100_000)], 4));
        for pair in layers.windows(2) {
            let below: Vec<(Point, Point, f64)> =
                infill(&pair[0]).into_iter().flat_map(Bead::stretches).collect();
            for (from, to, _) in infill(&pair[1]).into_iter().flat_map(Bead::stretches) {
                let middle = (
                    f64::midpoint(f64::from(from.x), f64::from(to.x)),
                    f64::midpoint(f64::from(from.y), f64::from(to.y)),
                );
                let at_wall = |value: f64| !(3000.0..97_000.0).contains(&value);
                if from.distance(to) < 1500.0 || at_wall(middle.0) || at_wall(middle.1) {
                    continue;
                }
                let nearest =
                    below.iter().map(|stretch| distance_to(middle, *stretch)).fold(f64::INFINITY, f64::min);
                // Half the room between two lines that run side by side, and the chords of a circle.
                assert!(nearest < 0.5 * WIDTH, "{pattern:?}: {nearest} at {middle:?}");
            }
        }
    }
}

/// Meetings that open and close again: the cells stay where they are, and a whole band holds the clay that was asked for.
#[test]
fn an_accordion_opens_its_meetings_in_the_middle_of_a_band() {
    let side = 250_000;
    for (band, at_end, at_middle) in [(4, 0.0, 0.5), (5, 0.4, 0.1), (1, 0.3, 0.8)] {
        let fill = Fill {
            junction_band: band,
            junction_separation_at_end: ratio(at_end),
            junction_separation_at_middle: ratio(at_middle),
            base_layers: 0,
            top_layers: 0,
            ..sparse(0.3, Pattern::Rectangular)
        };
        let layers = laid(&fill, stack(&[square(side)], 2 * band as usize));
        let share = |beads: &[Bead]| {
            let length: f64 = infill(beads).iter().map(|bead| bead.length()).sum();
            length * 0.72 / (f64::from(side) / 1000.0 - 1.44).powi(2)
        };
        let shares: Vec<f64> = layers.iter().map(|beads| share(beads)).collect();
        let mean = shares.iter().sum::<f64>() / shares.len() as f64;
        assert!((mean / 0.3 - 1.0).abs() < 0.05, "{band}: {mean}");
        let middle = band as usize / 2;
        // Open meetings are short cuts.
        assert_eq!(shares[0] > shares[middle], at_end < at_middle && middle > 0, "{shares:?}");
        for (layer, share) in shares.iter().enumerate() {
            let same = shares[layer % band as usize];
            assert!((share / same - 1.0).abs() < 0.01, "bands are alike: {shares:?}");
        }
    }
}

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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// No infill bead leaves the room between the walls, however the part is formed: no line crosses a hole.
    #[test]
    fn no_line_leaves_the_walls(
        spikes in prop::collection::vec(15_000..50_000i32, 12),
        hole in 2_000..12_000i32,
        density in 0.1..0.8f64,
        turn in 0..180i32,
        pattern in 0..5usize,
        sharpest in 0..60i32,
    ) {
        let pattern = [Pattern::Line, Pattern::Rectangular, Pattern::Hexagonal, Pattern::Circular, Pattern::Concentric][pattern];
        let fill = Fill {
            begin_rotation: Angle(turn * 1000),
            sharpest_angle: Angle(sharpest * 1000),
            ..sparse(density, pattern)
        };
        let part = star(&spikes, hole);
        let beads = laid(&fill, stack(&part, 1)).remove(0);
        for (from, to, _) in infill(&beads).into_iter().flat_map(Bead::stretches) {
            let steps = (from.distance(to) / 300.0).ceil().max(1.0) as i32;
            for step in 0..=steps {
                let share = f64::from(step) / f64::from(steps);
                let at = |from: i32, to: i32| (f64::from(from) + f64::from(to - from) * share).round() as i32;
                let place = Point::new(at(from.x, to.x), at(from.y, to.y));
                let inside = part.iter().filter(|ring| ring.contains(place)).count() % 2 == 1;
                let spot = (f64::from(place.x), f64::from(place.y));
                let sides = part.iter().flat_map(Ring::segments);
                let near = sides.map(|(a, b)| distance_to(spot, (a, b, 1.0))).fold(f64::INFINITY, f64::min);
                // A bead's middle keeps a bead and a half from the outline, but for rounding.
                prop_assert!(inside && near > 1.5 * WIDTH - 20.0, "{pattern:?}: {near} at {place:?} from {from:?} to {to:?}");
            }
        }
    }
}

#[test]
fn a_thread_turns_no_sharper_than_is_allowed() {
    let part = star(&[50_000, 20_000].repeat(6), 5_000);
    for pattern in [Pattern::Line, Pattern::Rectangular, Pattern::Hexagonal] {
        let sharpest = |angle: f64| {
            let fill = Fill { sharpest_angle: degrees(angle), ..sparse(0.3, pattern) };
            let beads = laid(&fill, stack(&part, 1)).remove(0);
            let turn = infill(&beads).into_iter().flat_map(turns).fold(0.0, f64::max);
            (180.0 - turn, infill(&beads).len())
        };
        let (free, few) = sharpest(0.0);
        let (kept, many) = sharpest(60.0);
        assert!(free < 60.0 && kept >= 59.9, "{pattern:?}: {free} {kept}");
        assert!(many > few, "{pattern:?}");
    }
}

/// A roof that leans 45° from vertical: closed by solid rings without an angle, by its walls alone with 60°.
#[test]
fn what_leans_less_than_the_surrounding_angle_is_no_surface() {
    let layers: Vec<(Vec<Ring>, Option<Direction>)> = (0..30)
        .map(|layer| {
            (vec![rectangle((layer * 400, layer * 400), (60_000 - layer * 400, 60_000 - layer * 400))], None)
        })
        .collect();
    let length = |angle: f64| {
        let fill = Fill {
            surrounding_angle: degrees(angle),
            base_layers: 4,
            top_layers: 4,
            ..sparse(0.1, Pattern::Line)
        };
        let layers = laid(&fill, inset(&layers));
        infill(&layers[15]).iter().map(|bead| bead.length()).sum::<f64>()
    };
    assert!(length(0.0) > 1.05 * length(60.0), "{} {}", length(0.0), length(60.0));
    assert!((length(60.0) - length(80.0)).abs() < 1e-9);
}

/// Cells leave out what is solid, and end at it.
#[test]
fn cells_leave_room_for_surfaces() {
    // A step: the upper half is smaller, so a part of layer 5 is seen from above.
    let (wide, narrow) = (vec![square(60_000)], vec![rectangle((0, 0), (30_000, 60_000))]);
    let layers: Vec<_> =
        (0..12).map(|layer| (if layer < 6 { wide.clone() } else { narrow.clone() }, None)).collect();
    for pattern in CELLS {
        let fill = Fill { base_layers: 1, top_layers: 1, ..sparse(0.2, pattern) };
        let layer = &laid(&fill, inset(&layers))[5];
        // The share of clay between two x, in pieces of a tenth of a millimetre.
        let share = |low: f64, high: f64| -> f64 {
            let mut clay = 0.0;
            for (from, to, _) in infill(layer).into_iter().flat_map(Bead::stretches) {
                let count = (from.distance(to) / 100.0).ceil().max(1.0);
                for piece in 0..count as i32 {
                    let x = f64::from(from.x) + f64::from(to.x - from.x) * (f64::from(piece) + 0.5) / count;
                    clay += if (low..high).contains(&x) { from.distance(to) / count * WIDTH } else { 0.0 };
                }
            }
            clay / (high - low) / 57_840.0
        };
        let (left, right) = (share(2_000.0, 27_000.0), share(31_000.0, 58_000.0));
        assert!((0.1..0.35).contains(&left), "{pattern:?}: sparse {left}");
        assert!((0.9..1.1).contains(&right), "{pattern:?}: solid {right}");
    }
}

#[test]
fn the_rings_of_a_part_without_corners_inwards_are_one_thread() {
    let beads = laid(&sparse(0.3, Pattern::Concentric), stack(&[square(40_000)], 1)).remove(0);
    let infill = infill(&beads);
    assert_eq!(infill.len(), 1);
    // One end is at the middle, the other one on the outermost ring.
    let apart = WIDTH / 0.3;
    let middle = Point::new(20_000, 20_000);
    let ends = [infill[0].points[0].0, infill[0].points[infill[0].points.len() - 1].0];
    let mut ways = ends.map(|end| end.distance(middle));
    ways.sort_by(f64::total_cmp);
    assert!(ways[0] < 2.0 * apart && ways[1] > 15_000.0, "{ways:?}");
}

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
