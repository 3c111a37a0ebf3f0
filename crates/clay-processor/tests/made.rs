//! Prints made from numbers are recognised as what they are.

use std::f64::consts::TAU;
use std::fmt::Write;

use clay_processor::{Rule, process};
use proptest::prelude::*;

/// The outline of a pot: a lobed ring, so that its turns are no circles and its bends go both ways. It leans and twists.
#[derive(Clone, Copy, Debug)]
struct Pot {
    radius: f64,
    lobes: u32,
    depth: f64,
    corners: usize,
    clockwise: bool,
    /// To the side, mm in a turn.
    lean: f64,
    /// As far as the outline goes along itself at its middle radius, mm in a turn.
    twist: f64,
}

fn pot() -> impl Strategy<Value = Pot> {
    let outline = (15.0..60.0, 2_u32..7, 0.0..0.35, 40_usize..160, any::<bool>());
    (outline, 0.0..0.5, 0.0..0.5).prop_map(|((radius, lobes, depth, corners, clockwise), lean, twist)| Pot {
        radius,
        lobes,
        depth,
        corners,
        clockwise,
        lean,
        twist,
    })
}

impl Pot {
    /// A corner of its base, leant and twisted by so many turns.
    fn corner_above(&self, step: usize, turns: f64) -> (f64, f64) {
        let turn = TAU * (step % self.corners) as f64 / self.corners as f64;
        let angle = if self.clockwise { -turn } else { turn };
        let radius = self.radius * (1.0 + self.depth * (f64::from(self.lobes) * angle).cos());
        let angle = angle + self.twist / self.radius * turns;
        (100.0 + self.lean * turns + radius * angle.cos(), 100.0 + radius * angle.sin())
    }

    fn corner(&self, step: usize) -> (f64, f64) {
        self.corner_above(step, 0.0)
    }

    /// A spiral that begins at `pitch`, each of whose turns rises as it is told.
    fn spiral(&self, pen: &mut Pen, pitch: f64, rises: &[f64]) {
        pen.travel(self.corner(0), pitch);
        let mut z = pitch;
        for (turn, rise) in rises.iter().enumerate() {
            for step in 1..=self.corners {
                z += rise / self.corners as f64;
                let turns = turn as f64 + step as f64 / self.corners as f64;
                pen.lay(self.corner_above(step, turns), Some(z));
            }
        }
    }
}

/// How a program writes its moves.
#[derive(Clone, Copy, Debug)]
struct Hand {
    relative_e: bool,
    /// Z on every line.
    repeats_z: bool,
    rapid: bool,
}

fn hand() -> impl Strategy<Value = Hand> {
    (any::<bool>(), any::<bool>(), any::<bool>()).prop_map(|(relative_e, repeats_z, rapid)| Hand {
        relative_e,
        repeats_z,
        rapid,
    })
}

/// Writes G-code and counts E.
struct Pen {
    text: String,
    hand: Hand,
    e: f64,
}

impl Pen {
    fn new(hand: Hand) -> Self {
        let mode = if hand.relative_e { "M83" } else { "M82" };
        Self { text: format!("G28\nG21\nG90\n{mode}\nM302 P1\nG92 E0\n"), hand, e: 0.0 }
    }

    fn travel(&mut self, (x, y): (f64, f64), z: f64) {
        let word = if self.hand.rapid { "G0" } else { "G1" };
        let _ = writeln!(self.text, "{word} X{x:.3} Y{y:.3} Z{z:.3} F3000");
    }

    fn lay(&mut self, (x, y): (f64, f64), z: Option<f64>) {
        self.e = if self.hand.relative_e { 1.0 } else { self.e + 1.0 };
        let z = z.map_or_else(String::new, |z| format!(" Z{z:.3}"));
        let _ = writeln!(self.text, "G1 X{x:.3} Y{y:.3}{z} E{:.5} F1200", self.e);
    }

    fn lines(&self) -> usize {
        self.text.lines().count()
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_spiral_is_one_spiral_with_its_turns_and_its_pitch(
        pot in pot(), hand in hand(), turns in 2_usize..12, pitch in 0.4_f64..3.0,
    ) {
        let mut pen = Pen::new(hand);
        let first = pen.lines() + 1;
        pot.spiral(&mut pen, pitch, &vec![pitch; turns]);
        let last = pen.lines() - 1;
        let report = process(pen.text.as_bytes());
        let ends: Vec<_> = report.machine.spirals.iter().map(|run| (run.start_index, run.end_index)).collect();
        prop_assert_eq!(ends, [(first, last)]);
        prop_assert!(report.machine.layers.is_empty());
        prop_assert_eq!(report.interruptions.count, 0);
        let found = report.pitches[0];
        prop_assert!((found.turns - turns as f64).abs() < 0.02 * turns as f64, "{:?}", found);
        prop_assert!((found.rise.expect("whole turns") / pitch - 1.0).abs() < 0.02, "{:?}", found);
        prop_assert!(report.verdicts.iter().all(|verdict| verdict.rule == Rule::InAir), "{:?}", report.verdicts);
    }

    #[test]
    fn a_turn_that_rises_too_much_is_found(
        pot in pot(), hand in hand(), turns in 6_usize..12, odd in 1_usize..5, more in 1.8_f64..2.6,
        pitch in 0.6_f64..3.0,
    ) {
        let mut rises = vec![pitch; turns];
        rises[odd] *= more;
        let mut pen = Pen::new(hand);
        let first = pen.lines() + 1;
        pot.spiral(&mut pen, pitch, &rises);
        let report = process(pen.text.as_bytes());
        let found = report.pitches[0];
        prop_assert!((found.rise.expect("whole turns") / pitch - 1.0).abs() < 0.02, "{:?}", found);
        let steepest = found.steepest.expect("it lies above itself");
        // Its whole rise is reached in one place, and what counts is more than a corner.
        prop_assert!((steepest.rise / (pitch * more) - 1.0).abs() < 0.15, "{:?}", found);
        let turn = (steepest.index - first) / pot.corners;
        prop_assert!(turn == odd || turn == odd + 1, "in turn {turn}: {:?}", found);
        let verdict = report.verdicts.iter().find(|verdict| verdict.rule == Rule::SpiralPitch);
        let place = verdict.expect("the potter is told").place.expect("where");
        prop_assert_eq!(place.index, steepest.index);
    }

    #[test]
    fn layers_are_layers_and_breaks_are_counted(
        pot in pot(), hand in hand(), layers in 1_usize..8, height in 0.4_f64..3.0,
        breaks in prop::collection::vec(3_usize..30, 0..6),
    ) {
        let mut pen = Pen::new(hand);
        let (mut expected, mut runs) = (0, Vec::new());
        for layer in 1..=layers {
            let z = (height * layer as f64 * 1000.0).round() / 1000.0;
            pen.travel(pot.corner(0), z);
            expected += usize::from(layer > 1);
            let first = pen.lines();
            for step in 1..=pot.corners {
                pen.lay(pot.corner(step), hand.repeats_z.then_some(z));
                // Up, and down to the same place: a break without a way across.
                if step < pot.corners && breaks.contains(&step) {
                    pen.travel(pot.corner(step), z + 2.0);
                    pen.travel(pot.corner(step), z);
                    expected += 1;
                }
            }
            runs.push((first, pen.lines() - 1, z));
        }
        let report = process(pen.text.as_bytes());
        let found: Vec<_> = report
            .machine
            .layers
            .iter()
            .map(|run| (run.start_index, run.end_index, run.height.expect("it is known")))
            .collect();
        prop_assert_eq!(found, runs);
        prop_assert!(report.machine.spirals.is_empty());
        prop_assert_eq!(report.interruptions.count, expected);
        let hops = (expected + 1 - layers) as f64 * 4.0;
        let between = (layers - 1) as f64 * height;
        prop_assert!((report.interruptions.length - hops - between).abs() < 0.01 * (layers as f64));
        let forbids: Vec<_> = report.verdicts.iter().filter(|verdict| verdict.rule < Rule::TravelOutside).collect();
        prop_assert!(forbids.is_empty(), "{:?}", forbids);
    }
}
