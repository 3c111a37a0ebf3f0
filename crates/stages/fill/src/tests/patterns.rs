//! The laws of the patterns.

use super::{
    Bead, CELLS, WIDTH, beads, craft, degrees, distance_to, infill, laid, ratio, sparse, square, stack, star,
    turns,
};
use crate::{Fill, Pattern};
use proptest::prelude::*;
use skein::{Angle, Point, Ring};

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
