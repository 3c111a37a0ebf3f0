//! The laws of a spiral, on pots made from formulas.

use crate::Coil;
use proptest::prelude::*;
use shape::plane::offset;
use skein::{Line, Notes, Nozzle, Point, Point3, Ring, Settings, Skein, Stage};
use std::f64::consts::TAU;
use std::fmt::Write;

const WIDTH: f64 = 3000.0;
const HEIGHT: i32 = 1500;

/// A pot by its outline at each height.
#[derive(Clone, Copy, Debug)]
struct Pot {
    radius: f64,
    /// Depth of the lobes as a share of the radius, and how many.
    lobes: (f64, u32),
    /// Turns of the form per layer.
    twist: f64,
    /// How far each layer reaches over the one below, mm.
    flare: f64,
    /// How far each layer is moved, mm.
    lean: f64,
    square: bool,
    layers: usize,
    base: usize,
    walls: usize,
}

const CYLINDER: Pot = Pot {
    radius: 30.0,
    lobes: (0.0, 0),
    twist: 0.0,
    flare: 0.0,
    lean: 0.0,
    square: false,
    layers: 12,
    base: 2,
    walls: 1,
};

impl Pot {
    fn outline(&self, layer: usize) -> Ring {
        let up = layer as f64;
        let radius = (self.radius + self.flare * up) * 1000.0;
        let count = if self.square { 4 } else { 120 };
        let corner = |step: usize| {
            let angle = TAU * step as f64 / count as f64;
            let lobe = 1.0 + self.lobes.0 * libm::cos(angle * f64::from(self.lobes.1));
            let turned = angle + TAU * self.twist * up;
            let at = |cosine: f64| (radius * lobe * cosine).round() as i32;
            Point::new(at(libm::cos(turned)) + (self.lean * up * 1000.0) as i32, at(libm::sin(turned)))
        };
        Ring((0..count).map(corner).collect())
    }

    /// The pot as fill would lay it: its walls, and as much infill as a base takes.
    fn skein(&self) -> Skein {
        let mut text = include_str!("../../../../tests/case-header.gcode").to_owned();
        for layer in 0..self.layers {
            let outline = self.outline(layer);
            let (middle, top) = (0.75 + 1.5 * layer as f64, 1.5 * (layer + 1) as f64);
            let _ = writeln!(text, "(<layer> {middle} )\n(<nestedRing>)\n(<boundaryPerimeter>)");
            for at in &outline.0 {
                let (x, y) = mm(*at);
                let _ = writeln!(text, "(<boundaryPoint> X{x} Y{y} Z{middle} </boundaryPoint>)");
            }
            text.push_str("(</boundaryPerimeter>)\n");
            for wall in 0..self.walls {
                let rings = offset(std::slice::from_ref(&outline), -WIDTH * (wall as f64 + 0.5));
                let tag = if wall == 0 { "edge" } else { "loop" };
                for ring in rings {
                    let _ = writeln!(text, "(<{tag}> outer )");
                    thread(&mut text, ring.0.iter().chain(ring.0.first()), top);
                    let _ = writeln!(text, "(</{tag}>)");
                }
            }
            if layer < self.base {
                text.push_str("(<infill>)\n");
                // Only its length counts.
                let far = (outline.area() * 1e6 / WIDTH).round() as i32;
                thread(&mut text, &[Point::new(0, 0), Point::new(far, 0)], top);
                text.push_str("(</infill>)\n");
            }
            text.push_str("(</nestedRing>)\n(</layer>)\n");
        }
        text.push_str("(</crafting>)\n");
        Skein::read(text.as_bytes()).expect("a skein")
    }
}

fn mm(at: Point) -> (f64, f64) {
    (f64::from(at.x) / 1000.0, f64::from(at.y) / 1000.0)
}

fn thread<'a>(text: &mut String, points: impl IntoIterator<Item = &'a Point>, z: f64) {
    for (index, at) in points.into_iter().enumerate() {
        let (x, y) = mm(*at);
        let _ = writeln!(text, "G1 X{x} Y{y} Z{z}{}", if index == 0 { "\nM101" } else { "" });
    }
    text.push_str("M103\n");
}

/// A straight piece of bead.
#[derive(Clone, Copy, Debug)]
struct Piece {
    from: Point3,
    to: Point3,
    flow: f64,
}

impl Piece {
    fn length(&self) -> f64 {
        flat(self.from).distance(flat(self.to))
    }

    fn middle(&self) -> [f64; 3] {
        let mean = |a: i32, b: i32| f64::midpoint(f64::from(a), f64::from(b));
        [mean(self.from.x, self.to.x), mean(self.from.y, self.to.y), mean(self.from.z, self.to.z)]
    }
}

fn flat(at: Point3) -> Point {
    Point::new(at.x, at.y)
}

/// The pieces of each layer; the rim turn, where there is one, stands behind the last.
fn turns(skein: &Skein) -> Vec<Vec<Piece>> {
    let mut nozzle = Nozzle::default();
    let mut turns: Vec<Vec<Piece>> = Vec::new();
    for layer in &skein.layers {
        turns.push(Vec::new());
        for line in &layer.lines {
            let before = nozzle;
            nozzle.follow(line);
            if let (true, Some(from), Some(step)) = (before.on, before.at, line.as_move()) {
                let piece = Piece { from, to: step.to, flow: before.flow.f64() };
                turns.last_mut().expect("a layer").push(piece);
            }
        }
    }
    let rim = turns.last_mut().expect("a layer");
    let top = rim.last().expect("a bead").to.z;
    let level = rim.iter().position(|piece| piece.from.z == top).expect("a rim");
    let rim = rim.split_off(level);
    turns.push(rim);
    turns
}

/// The nearest place of a turn, seen from above: how far away it is, and how high.
fn nearest(turn: &[Piece], at: [f64; 3]) -> (f64, f64) {
    turn.iter()
        .map(|piece| {
            let (from, to) = (piece.from, piece.to);
            let along = [f64::from(to.x - from.x), f64::from(to.y - from.y)];
            let square = (along[0] * along[0] + along[1] * along[1]).max(1e-9);
            let dot = (at[0] - f64::from(from.x)) * along[0] + (at[1] - f64::from(from.y)) * along[1];
            let share = (dot / square).clamp(0.0, 1.0);
            let gap = libm::hypot(
                f64::from(from.x) + along[0] * share - at[0],
                f64::from(from.y) + along[1] * share - at[1],
            );
            (gap, f64::from(from.z) + f64::from(to.z - from.z) * share)
        })
        .min_by(|one, other| one.0.total_cmp(&other.0))
        .expect("a bead")
}

fn wound(pot: &Pot, coil: &Coil) -> (Skein, Notes) {
    let mut notes = Notes::default();
    let skein = coil.craft(pot.skein(), &mut notes).expect("a spiral");
    skein.verify().expect("the laws of a skein");
    (skein, notes)
}

/// One thread from the first layer to the rim, and it never goes down.
fn is_one_rising_thread(skein: &Skein) {
    let lines = || skein.lines();
    assert_eq!(lines().filter(|line| **line == Line::On).count(), 1);
    assert_eq!(lines().filter(|line| **line == Line::Off).count(), 1);
    let heights: Vec<i32> = lines().filter_map(Line::as_move).map(|step| step.to.z).collect();
    assert!(heights.windows(2).all(|pair| pair[0] <= pair[1]), "{heights:?}");
}

/// The clay of every turn fills the gap below it; the gap is measured, not taken from the flow.
fn fills_every_gap(turns: &[Vec<Piece>], notes: &Notes, base: usize) {
    for (index, turn) in turns.iter().enumerate().skip(base) {
        // What hangs out as far as to the next bead is over two heights at once.
        if is_told(turns, notes, index) {
            continue;
        }
        let (mut clay, mut room) = (0.0, 0.0);
        for piece in turn {
            let middle = piece.middle();
            let (aside, below) = match index {
                _ if index == base => (0.0, f64::from(HEIGHT) * base as f64),
                _ => nearest(&turns[index - 1], middle),
            };
            if aside > WIDTH / 3.0 {
                continue;
            }
            clay += piece.length() * piece.flow * f64::from(HEIGHT);
            room += piece.length() * (middle[2] - below);
        }
        assert!((clay / room - 1.0).abs() < 0.02, "turn {index} has {clay} for {room}");
    }
}

/// Whether two pieces cross, seen from above. With a seam that moves on, the end of a turn lies on its own beginning:
/// that is a layer lower.
fn cross(one: &Piece, other: &Piece) -> bool {
    if (one.middle()[2] - other.middle()[2]).abs() > 0.9 * f64::from(HEIGHT) {
        return false;
    }
    let side = |a: Point3, b: Point3, c: Point3| shape::plane::cross(flat(a), flat(b), flat(c)).signum();
    side(one.from, one.to, other.from) * side(one.from, one.to, other.to) < 0
        && side(other.from, other.to, one.from) * side(other.from, other.to, one.to) < 0
}

/// No bead of a turn crosses another of it.
fn crosses_nothing(turns: &[Vec<Piece>]) {
    for (index, turn) in turns.iter().enumerate() {
        for (first, one) in turn.iter().enumerate() {
            let other = turn[first + 1..].iter().find(|other| cross(one, other));
            assert!(other.is_none(), "turn {index}: {one:?} crosses {other:?}");
        }
    }
}

/// Whether the notes say that a turn hangs.
fn is_told(turns: &[Vec<Piece>], notes: &Notes, index: usize) -> bool {
    // The rim is laid on the last layer.
    let layer = index.min(turns.len() - 2);
    notes.iter().any(|note| note.layer == Some(layer) && note.text.contains("sag"))
}

/// Every place of a turn has clay below it within half a bead, or the layer is named.
fn lies_on_clay(turns: &[Vec<Piece>], notes: &Notes, base: usize) {
    for index in base + 1..turns.len() {
        let hangs =
            turns[index].iter().any(|piece| nearest(&turns[index - 1], piece.middle()).0 > WIDTH / 2.0);
        assert!(!hangs || is_told(turns, notes, index), "turn {index} hangs and nobody says so");
    }
}

fn pots() -> impl Strategy<Value = Pot> {
    let form = (32.0..60.0_f64, 0.0..0.15_f64, 3..8_u32, -0.004..0.004_f64);
    let slope = (-0.8..0.86_f64, -0.86..0.86_f64, any::<bool>());
    (form, slope, 3..9_usize, 0..3_usize, 1..4_usize).prop_map(
        |((radius, deep, lobes, twist), (flare, lean, square), turns, base, walls)| {
            // Where a form narrows by much there is no room for three beads and their seam.
            let radius = if square { radius * 1.4 } else { radius };
            let lobes = if square { (0.0, 0) } else { (deep, lobes) };
            // A wall of several beads that leans by much rests on two of them at once, at two heights.
            let (flare, lean) = (flare / walls as f64, lean / walls as f64);
            Pot { radius, lobes, twist, flare, lean, square, layers: turns + base, base, walls }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn every_pot_keeps_the_laws_of_a_spiral(pot in pots()) {
        let (skein, notes) = wound(&pot, &Coil::default());
        let turns = turns(&skein);
        // Without a base the lowest turn lies flat on the bed.
        let flat = pot.base.max(1);
        is_one_rising_thread(&skein);
        fills_every_gap(&turns, &notes, flat);
        crosses_nothing(&turns);
        lies_on_clay(&turns, &notes, flat);
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
            assert!((height - f64::from(HEIGHT) * so_far / length).abs() <= 2.0, "{height} µm at {so_far}");
            assert!(piece.length() > 0.0, "the nozzle climbs where it stands");
        }
        assert_eq!(turn.last().map(|piece| piece.to.z), Some(bottom + HEIGHT));
    }
}

#[test]
fn the_base_fills_its_disc_and_ends_where_the_wall_begins() {
    let (skein, _) = wound(&CYLINDER, &Coil::default());
    let turns = turns(&skein);
    let disc = CYLINDER.outline(0).area() * 1e6;
    for layer in &turns[..2] {
        let clay: f64 = layer.iter().map(|piece| piece.length() * piece.flow * WIDTH).sum();
        assert!((clay / disc - 1.0).abs() < 0.02, "{clay} on {disc}");
        // No void in the middle.
        assert!(nearest(layer, [0.0, 0.0, 0.0]).0 < WIDTH * 0.55);
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
            let rings: f64 = (0..walls).map(|wall| TAU * (30_000.0 - WIDTH * (wall as f64 + 0.5))).sum();
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
    assert!(behind.iter().all(|at| at.z == 12 * HEIGHT));
    let length: f64 = behind.windows(2).map(|pair| flat(pair[0]).distance(flat(pair[1]))).sum();
    assert!(length > 1.95 * TAU * 28_500.0, "{length}");
}

#[test]
fn hollow_and_empty_layers_pass() {
    let empty = b"(</crafting>)\n";
    let header = include_bytes!("../../../../tests/case-header.gcode");
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
    let inside = offset(&[CYLINDER.outline(0)], -WIDTH);
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
        let up = 2 * HEIGHT;
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
        assert_eq!(layer.z().0, index as i32 * HEIGHT + HEIGHT / 2);
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
