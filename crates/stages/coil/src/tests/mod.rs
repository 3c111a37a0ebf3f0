//! The laws of a spiral, on pots made from formulas.

mod floors;
mod found;
mod measure;
mod pot;

use crate::Coil;
use measure::{Piece, below, do_cross, flat, is_one_rising_thread, is_told, nearest, turns};
use pot::{CYLINDER, Pot, pots};
use proptest::prelude::*;
use shape::plane::offset;
use skein::{Line, Notes, Point3, Settings, Skein, Stage};
use std::f64::consts::TAU;

fn wound(pot: &Pot, coil: &Coil) -> (Skein, Notes) {
    let mut notes = Notes::default();
    let skein = coil.craft(pot.skein(), &mut notes).expect("a spiral");
    skein.verify().expect("the laws of a skein");
    (skein, notes)
}

/// The clay of every turn, and of every eighth of it, fills the gap below it; the gap is measured, not taken from the flow.
fn fills_every_gap(turns: &[Vec<Piece>], pot: &Pot) {
    // Without a base the lowest turn lies flat on the bed.
    let flat = pot.base.max(1);
    let thread = turns[flat..].concat();
    for (index, turn) in turns.iter().enumerate().skip(flat) {
        let mut eighths = [[0.0, 0.0]; 8];
        for piece in turn.iter().flat_map(|piece| piece.cut(pot.width)) {
            let below = match index == flat {
                true => f64::from(pot.height) * flat as f64,
                false => below(&thread, &piece).expect("a turn below").1,
            };
            let [clay, room] = &mut eighths[(piece.turn.fract() * 8.0) as usize];
            *clay += piece.length() * piece.flow * f64::from(pot.height);
            *room += piece.length() * (piece.middle()[2] - below);
        }
        let [clay, room] = eighths.iter().fold([0.0, 0.0], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
        assert!((clay / room - 1.0).abs() < 0.02, "turn {index} has {} of its gap", clay / room);
        for (eighth, [clay, room_here]) in eighths.iter().enumerate() {
            assert!(
                (clay - room_here).abs() < 0.03 * room / 8.0,
                "turn {index}, {eighth}/8: {clay} for {room_here}"
            );
        }
    }
}

/// No bead of a turn crosses another of it, from such a layer on.
fn crosses_nothing(turns: &[Vec<Piece>], pot: &Pot, skipped: usize) {
    let (left, right) =
        (|piece: &Piece| piece.from.x.min(piece.to.x), |piece: &Piece| piece.from.x.max(piece.to.x));
    for (index, turn) in turns.iter().enumerate().skip(skipped) {
        let mut pieces: Vec<&Piece> = turn.iter().collect();
        pieces.sort_by_key(|piece| left(piece));
        for (first, one) in pieces.iter().enumerate() {
            let near = pieces[first + 1..].iter().take_while(|other| left(other) <= right(one));
            let other = near.into_iter().find(|other| do_cross(one, other, f64::from(pot.height)));
            assert!(other.is_none(), "turn {index}: {one:?} crosses {other:?}");
        }
    }
}

/// Every place of a turn has clay below it within half a bead, or the layer is named.
fn lies_on_clay(turns: &[Vec<Piece>], notes: &Notes, pot: &Pot) {
    for index in pot.base.max(1) + 1..turns.len() {
        let far = |piece: &&Piece| nearest(&turns[index - 1], piece.middle()).0 > pot.width / 2.0;
        let hangs = turns[index].iter().find(far);
        assert!(
            hangs.is_none() || is_told(turns, notes, index),
            "turn {index} hangs and nobody says so: {hangs:?}"
        );
    }
}

/// All laws of a spiral that lies on clay.
fn keeps_the_laws(pot: &Pot) {
    let (skein, notes) = wound(pot, &Coil::default());
    let turns = turns(&skein);
    is_one_rising_thread(&skein);
    fills_every_gap(&turns, pot);
    crosses_nothing(&turns, pot, pot.base);
    lies_on_clay(&turns, &notes, pot);
}

/// The laws of a spiral of which parts may hang.
fn tells_what_hangs(pot: &Pot) {
    let (skein, notes) = wound(pot, &Coil::default());
    let turns = turns(&skein);
    is_one_rising_thread(&skein);
    crosses_nothing(&turns, pot, pot.base);
    lies_on_clay(&turns, &notes, pot);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// A wall that leans by 30\u{b0} is moved by 0.577 of its height.
    #[test]
    fn every_pot_keeps_the_laws_of_a_spiral(pot in pots(0.577)) {
        keeps_the_laws(&pot);
    }

    #[test]
    fn what_hangs_is_told(pot in pots(2.0)) {
        tells_what_hangs(&pot);
    }
}

/// CO2, our own spiral mode: one thread above the base, as high as it is long, one layer for each turn, and no place
/// where it has two heights. (CO1 is the wire that the seed winds round a part: its tool stays outside, so nothing of
/// its figures holds for clay.)
#[test]
fn co2_the_height_is_linear_in_the_length() {
    let (skein, _) = wound(&CYLINDER, &Coil::default());
    is_one_rising_thread(&skein);
    let turns = turns(&skein);
    for turn in &turns[2..12] {
        let length: f64 = turn.iter().map(Piece::length).sum();
        let bottom = turn[0].from.z;
        let mut so_far = 0.0;
        for piece in turn {
            so_far += piece.length();
            let height = f64::from(piece.to.z - bottom);
            assert!(
                (height - f64::from(CYLINDER.height) * so_far / length).abs() <= 2.0,
                "{height} µm at {so_far}"
            );
            assert!(piece.length() > 0.0, "the nozzle climbs where it stands");
        }
        assert_eq!(turn.last().map(|piece| piece.to.z), Some(bottom + CYLINDER.height));
    }
}

#[test]
fn the_base_fills_its_disc_and_ends_where_the_wall_begins() {
    let (skein, _) = wound(&CYLINDER, &Coil::default());
    let turns = turns(&skein);
    let disc = CYLINDER.outline(0).area() * 1e6;
    for layer in &turns[..2] {
        let clay: f64 = layer.iter().map(|piece| piece.length() * piece.flow * CYLINDER.width).sum();
        assert!((clay / disc - 1.0).abs() < 0.02, "{clay} on {disc}");
        // No void in the middle.
        assert!(nearest(layer, [0.0, 0.0, 0.0]).0 < CYLINDER.width * 0.55);
    }
    assert_eq!(turns[1].last().map(|piece| piece.to), turns[2].first().map(|piece| piece.from));
}

#[test]
fn a_wall_of_two_or_three_beads_is_one_loop_without_a_hole_at_the_seam() {
    for walls in [2, 3] {
        let pot = Pot { walls, ..CYLINDER };
        let (skein, _) = wound(&pot, &Coil { seam_step: skein::Ratio(0), ..Coil::default() });
        for turn in &turns(&skein)[3..12] {
            let length: f64 = turn.iter().map(Piece::length).sum();
            let rings: f64 =
                (0..walls).map(|wall| TAU * (30_000.0 - CYLINDER.width * (wall as f64 + 0.5))).sum();
            assert!((length / rings - 1.0).abs() < 0.005, "{length} in place of {rings}");
        }
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let pot = Pot { lobes: (0.1, 5), twist: 0.005, walls: 2, layers: 40, ..CYLINDER };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| wound(&pot, &Coil::default()).0.write())
    };
    assert_eq!(with(1), with(4));
}

#[test]
fn waves_swing_as_far_as_they_are_told_and_the_wall_stays_one_thread() {
    let coil = Coil { wave_height: skein::Micron(2000), waves: 9, ..Coil::default() };
    let (skein, _) = wound(&CYLINDER, &coil);
    is_one_rising_thread(&skein);
    let turns = turns(&skein);
    let radii = turns[6].iter().map(|piece| libm::hypot(f64::from(piece.to.x), f64::from(piece.to.y)));
    let (low, high) =
        radii.fold((f64::MAX, 0.0_f64), |(low, high), radius| (low.min(radius), high.max(radius)));
    assert!((low - 26_500.0).abs() < 60.0 && (high - 30_500.0).abs() < 60.0, "{low} to {high}");
}

#[test]
fn rim_turns_go_round_level_and_without_clay() {
    let (skein, _) = wound(&CYLINDER, &Coil { rim_turns: 2, ..Coil::default() });
    let lines = &skein.layers[11].lines;
    let off = lines.iter().position(|line| *line == Line::Off).expect("an end");
    let behind: Vec<Point3> = lines[off..].iter().filter_map(Line::as_move).map(|step| step.to).collect();
    assert!(behind.iter().all(|at| at.z == 12 * CYLINDER.height));
    let length: f64 = behind.windows(2).map(|pair| flat(pair[0]).distance(flat(pair[1]))).sum();
    assert!(length > 1.95 * TAU * 28_500.0, "{length}");
}

#[test]
fn hollow_and_empty_layers_pass() {
    let empty = b"(</crafting>)\n";
    let header = include_bytes!("../../../../../tests/case-header.gcode");
    let skein = Skein::read(&[header.as_slice(), empty].concat()).expect("a skein");
    assert_eq!(Coil::default().craft(skein.clone(), &mut Notes::default()).expect("nothing"), skein);
    let one = Pot { layers: 1, base: 0, ..CYLINDER };
    let (skein, _) = wound(&one, &Coil::default());
    assert_eq!(skein.lines().filter(|line| **line == Line::Off).count(), 1);
}

/// A cup on a foot: a ring, then a floor across it, then the pot.
#[test]
fn a_pot_on_a_foot_ring_has_a_floor() {
    let mut skein = CYLINDER.skein();
    let foot = Pot { base: 0, ..CYLINDER }.skein();
    let inside = offset(&[CYLINDER.outline(0)], -CYLINDER.width);
    for (index, mut layer) in foot.layers.into_iter().take(2).enumerate() {
        let z = layer.z().0;
        let ring = inside[0]
            .0
            .iter()
            .rev()
            .map(|at| Line::Point(skein::Mark::Boundary, Point3 { x: at.x, y: at.y, z }));
        let block = std::iter::once(Line::Open(skein::Tag::BoundaryPerimeter))
            .chain(ring)
            .chain([Line::Close(skein::Tag::BoundaryPerimeter)]);
        let end = layer.lines.iter().position(|line| *line == Line::Close(skein::Tag::BoundaryPerimeter));
        let end = end.expect("an outline") + 1;
        layer.lines.splice(end..end, block);
        skein.layers.insert(index, layer);
    }
    // The pot stands on its foot.
    for (index, layer) in skein.layers.iter_mut().enumerate().skip(2) {
        let up = 2 * CYLINDER.height;
        for line in &mut layer.lines {
            match line {
                Line::Layer(z) => z.0 += up,
                Line::Point(_, at) => at.z += up,
                line => {
                    if let Some(step) = line.as_move_mut() {
                        step.to.z += up;
                    }
                }
            }
        }
        assert_eq!(layer.z().0, index as i32 * CYLINDER.height + CYLINDER.height / 2);
    }
    let before = skein.clone();
    let mut notes = Notes::default();
    let after = Coil::default().craft(skein, &mut notes).expect("a pot");
    after.verify().expect("the laws of a skein");
    // The foot is wound, the first layer of the floor reaches across, the second is wound again and goes on as the wall.
    assert_ne!(after.layers[1], before.layers[1]);
    assert_eq!(after.layers[2], before.layers[2]);
    let infill = |layer: &skein::Layer| layer.lines.contains(&Line::Open(skein::Tag::Infill));
    assert!(infill(&after.layers[3]) && !infill(&after.layers[4]));
    assert!(notes.iter().any(|note| note.layer == Some(2) && note.text.contains("open below")));
}

#[test]
fn settings_have_bounds() {
    let mut coil = Coil::default();
    assert!(Settings::set(&mut coil, "beads", &skein::Value::from(4.0)).is_err());
    assert!(Settings::set(&mut coil, "beads", &skein::Value::from(3.0)).is_ok());
}
