//! What every edit promises, on prints of many dialects.

mod support;

use clay_processor::process;
use edit::{
    At, Axes, Base, Clean, Edit, HEATERS, Nozzle, Pause, Rim, Scale, Section, Size, Speed, apply_all,
};
use proptest::prelude::*;
use support::{beads, pot, steps};

fn edited(edit: Edit, text: &[u8]) -> Vec<u8> {
    edit.apply(text).unwrap_or_else(|error| panic!("{error}\n{}", String::from_utf8_lossy(text))).text
}

fn scale(by: f64, axes: Axes, bead: bool) -> Edit {
    Edit::Scale(Scale { size: Size::Factor(by), axes, bead })
}

fn speed(by: f64) -> Edit {
    Edit::Speed(Speed { bottom: by, top: by, travels: false })
}

fn nozzle(old: f64, new: f64) -> Edit {
    Edit::Nozzle(Nozzle { old, new, section: Section::Rectangle, spread: 1.2, layer: None })
}

fn rim(turns: u32, rise: f64, flow: f64) -> Edit {
    Edit::Rim(Rim { turns, rise, flow })
}

/// The text without what edits say in it.
fn unsigned(text: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(text);
    let lines =
        text.split_inclusive('\n').filter(|line| !line.starts_with("; edit") && !line.starts_with(";   "));
    lines.collect::<String>().into_bytes()
}

fn near(a: f64, b: f64, share: f64) -> bool {
    (a - b).abs() <= share * a.abs().max(b.abs()).max(1e-9)
}

/// Whether two texts move alike, within printed decimals.
fn assert_same_motion(a: &[u8], b: &[u8]) {
    let (a, b) = (steps(a), steps(b));
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(&b) {
        for axis in 0..3 {
            assert!((a.to[axis] - b.to[axis]).abs() < 1e-3, "{a:?} {b:?}");
        }
        assert!((a.clay - b.clay).abs() < 1e-3 && (a.feed - b.feed).abs() < 0.1, "{a:?} {b:?}");
    }
}

/// Line ends stay, numbers count, checksums hold.
fn assert_sound(text: &[u8], crlf: bool) {
    let mut last: Option<u64> = None;
    for line in text.split_inclusive(|&byte| byte == b'\n') {
        assert_eq!(line.ends_with(b"\r\n"), crlf, "{}", String::from_utf8_lossy(line));
        let line = String::from_utf8_lossy(line);
        let Some((code, sum)) = line.trim_end().rsplit_once('*') else { continue };
        assert_eq!(code.bytes().fold(0, |sum, byte| sum ^ byte).to_string(), sum, "{line}");
        let number: u64 =
            code[1..].split(' ').next().and_then(|number| number.parse().ok()).expect("a number");
        assert!(last.is_none_or(|last| number == last + 1), "{line} comes behind {last:?}");
        last = Some(number);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn scaling_scales_the_path_and_the_clay(pot in pot(), by in prop::sample::select(vec![0.5, 2.0, 0.73, 1.31])) {
        let text = pot.text().into_bytes();
        let (length, clay) = beads(&text);
        let old = process(&text).machine;
        for (bead, power) in [(false, 2), (true, 3)] {
            let small = edited(scale(by, Axes::Xyz, bead), &text);
            let (new_length, new_clay) = beads(&small);
            prop_assert!(near(new_length, length * by, 1e-6), "{new_length} {length}");
            prop_assert!(near(new_clay, clay * by.powi(power), 1e-6), "{new_clay} {clay}");
            let new = process(&small).machine;
            prop_assert_eq!(new.layers.len(), old.layers.len());
            prop_assert_eq!(new.spirals.len(), old.spirals.len());
            prop_assert!(near(new.max_height, old.max_height * by, 1e-5));
            assert_sound(&small, pot.dialect.crlf);
        }
    }

    #[test]
    fn scaling_in_z_keeps_the_plan(pot in pot(), by in prop::sample::select(vec![0.5, 2.0, 1.31])) {
        let text = pot.text().into_bytes();
        let taller = edited(scale(by, Axes::Z, false), &text);
        for (a, b) in steps(&text).iter().zip(steps(&taller)) {
            prop_assert!((a.to[0] - b.to[0]).abs() < 1e-3 && (a.to[1] - b.to[1]).abs() < 1e-3);
            if a.prints() {
                prop_assert!((a.to[2] * by - b.to[2]).abs() < 1e-3);
                let grown = b.clay / b.length / (a.clay / a.length);
                prop_assert!(near(grown, by, 1e-3), "{grown}");
            }
        }
    }

    #[test]
    fn an_edit_and_its_inverse_move_as_before(pot in pot(), by in prop::sample::select(vec![0.5, 0.8, 1.31])) {
        let text = pot.text().into_bytes();
        for (there, back) in [
            (scale(by, Axes::Xyz, false), scale(1.0 / by, Axes::Xyz, false)),
            (scale(by, Axes::Z, false), scale(1.0 / by, Axes::Z, false)),
            (speed(by), speed(1.0 / by)),
            (nozzle(2.0, 3.0), nozzle(3.0, 2.0)),
        ] {
            let both = apply_all(&text, &[there, back]).unwrap_or_else(|error| panic!("{error}"));
            let mut both = steps(&both.text);
            let mut before = steps(&text);
            // The end code keeps its distance to a larger part and has no reason to come nearer to a smaller one.
            let last = before.iter().rposition(|step| step.prints()).expect("it prints");
            both.truncate(last + 1);
            before.truncate(last + 1);
            prop_assert_eq!(both.len(), before.len());
            for (a, b) in both.iter().zip(&before) {
                let places = (0..3).all(|axis| (a.to[axis] - b.to[axis]).abs() < 1e-3);
                prop_assert!(places && (a.clay - b.clay).abs() < 1e-3 && (a.feed - b.feed).abs() < 0.1, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn what_changes_nothing_changes_no_byte(pot in pot()) {
        let text = pot.text().into_bytes();
        for edit in [scale(1.0, Axes::Xyz, false), speed(1.0), nozzle(3.0, 3.0)] {
            prop_assert_eq!(unsigned(&edited(edit, &text)), text.clone());
        }
    }

    #[test]
    fn speed_changes_the_feed_of_beads_and_of_nothing_else(pot in pot(), top in 0.3_f64..1.5) {
        let text = pot.text().into_bytes();
        let slow = edited(Edit::Speed(Speed { bottom: 1.0, top, travels: false }), &text);
        let (old, new) = (steps(&text), steps(&slow));
        prop_assert_eq!(old.len(), new.len());
        let heights = || old.iter().filter(|step| step.prints()).map(|step| step.to[2]);
        let (low, high) = (heights().fold(f64::MAX, f64::min), heights().fold(f64::MIN, f64::max));
        for (a, b) in old.iter().zip(&new) {
            let share = ((a.to[2] - low) / (high - low)).clamp(0.0, 1.0);
            let wanted = if a.prints() { 1.0 + (top - 1.0) * share } else { 1.0 };
            prop_assert!((b.feed / a.feed - wanted).abs() < 0.002, "{a:?} {b:?} {wanted}");
            prop_assert!((a.clay - b.clay).abs() < 1e-6 && a.to == b.to);
        }
        assert_sound(&slow, pot.dialect.crlf);
    }

    #[test]
    fn a_base_is_never_driven_into(pot in pot(), other in pot(), far in -200_i32..200) {
        let pot = support::Pot { dialect: support::Dialect { spiral: true, ..pot.dialect }, ..pot };
        let mut other = other;
        other.centre[0] += f64::from(far);
        other.radius = pot.radius + 1.0;
        other.dialect.numbered = false;
        let (text, base) = (pot.text().into_bytes(), other.text().into_bytes());
        // E goes with the section of the bead.
        let ratio = pot.flow / pot.layer / (other.flow / other.layer);
        let edit = Edit::Base(Base { other: base.clone(), height: None, e_factor: Some(ratio), lift: 5.0 });
        let joined = edited(edit, &text);
        assert_sound(&joined, pot.dialect.crlf);

        let all = steps(&joined);
        let printed: Vec<usize> = (0..all.len()).filter(|&index| all[index].prints()).collect();
        let base_top = if other.dialect.spiral { 2.0 } else { 6.0 } * other.layer;
        let spiral = steps(&text).iter().filter(|step| step.prints()).count() - if pot.dialect.arcs { 8 } else { 96 };
        let first = printed[printed.len() - spiral];
        let start = all[first].from;
        prop_assert!((start[2] - base_top).abs() < 2e-3, "it starts at {start:?} on {base_top}");
        for step in &all[first..] {
            prop_assert!(step.from[2] > base_top - 2e-3 && step.to[2] > base_top - 2e-3, "{step:?}");
        }
        let behind = printed[printed.len() - spiral - 1];
        for step in &all[behind + 1..first] {
            let flat = (step.to[0] - step.from[0]).hypot(step.to[1] - step.from[1]);
            prop_assert!(step.from[2].min(step.to[2]) > base_top - 2e-3, "{step:?}");
            prop_assert!(flat <= 1.5 || step.to[2] > base_top + 4.9, "{step:?} crosses the clay");
        }
        // The middle of the base lies under the middle of the spiral, and the clay of both is there.
        let xs = || printed[..printed.len() - spiral].iter().map(|&index| all[index].to[0]);
        let middle = f64::midpoint(xs().fold(f64::MAX, f64::min), xs().fold(f64::MIN, f64::max));
        prop_assert!((middle - pot.centre[0]).abs() < 0.6, "{middle} {:?}", pot.centre);
        let clay = |steps: &[support::Step]| steps.iter().filter(|step| step.prints()).map(|step| step.clay).sum::<f64>();
        let old = steps(&text);
        let old_printed: Vec<usize> = (0..old.len()).filter(|&index| old[index].prints()).collect();
        let kept = clay(&old[old_printed[old_printed.len() - spiral]..]);
        prop_assert!(near(clay(&all[first..]), kept, 1e-4));
    }

    #[test]
    fn a_rim_repeats_the_last_turn(pot in pot(), turns in 1_u32..4, rise in prop::sample::select(vec![0.0, 0.5])) {
        let text = pot.text().into_bytes();
        let more = edited(rim(turns, rise, 1.0), &text);
        assert_sound(&more, pot.dialect.crlf);
        let (old, new) = (process(&text), process(&more));
        let top = old.machine.max_height;
        prop_assert!((new.machine.max_height - top - rise * f64::from(turns)).abs() < 2e-3);
        let (length, _) = beads(&text);
        // Chords are a little shorter than arcs; a spiral's turn is as long as its plan.
        let grown = steps(&more).iter().filter(|step| step.prints()).map(|step| {
            (step.to[0] - step.from[0]).hypot(step.to[1] - step.from[1])
        }).sum::<f64>();
        prop_assert!(pot.dialect.arcs || grown > length + f64::from(turns) * 6.2 * pot.radius, "{grown} {length}");
        let before = steps(&text).iter().filter(|step| step.prints()).count();
        let lowest = steps(&more).iter().filter(|step| step.prints()).skip(before).map(|step| step.to[2]).fold(f64::MAX, f64::min);
        prop_assert!(lowest > top + rise - 2e-3, "{lowest} {top}");
    }

    #[test]
    fn a_pause_comes_back_to_where_it_was(pot in pot(), park: bool) {
        let text = pot.text().into_bytes();
        let height = pot.layer * 2.5;
        let pause = Pause {
            at: At::Height(height),
            park: park.then_some([1.0, 2.0]),
            prime: 7.0,
            relieve: 3.0,
            ..Pause::default()
        };
        let paused = edited(Edit::Pause(pause), &text);
        assert_sound(&paused, pot.dialect.crlf);
        let (old, new) = (steps(&text), steps(&paused));
        // Without the moves of the pause, the print is what it was.
        let printed = |steps: &[support::Step]| steps.iter().filter(|step| step.prints()).copied().collect::<Vec<_>>();
        let (old, new) = (printed(&old), printed(&new));
        prop_assert_eq!(old.len(), new.len());
        for (a, b) in old.iter().zip(&new) {
            for axis in 0..3 {
                prop_assert!((a.to[axis] - b.to[axis]).abs() < 2e-3 && (a.from[axis] - b.from[axis]).abs() < 2e-3);
            }
            prop_assert!((a.clay - b.clay).abs() < 2e-3 && (a.feed - b.feed).abs() < 0.1, "{a:?} {b:?}");
        }
        prop_assert!(String::from_utf8_lossy(&paused).contains("M0"));
    }

    #[test]
    fn cleaning_takes_out_lines_and_nothing_else(pot in pot()) {
        let pot = support::Pot { dialect: support::Dialect { numbered: false, ..pot.dialect }, ..pot };
        let text = pot.text();
        let clean = Clean { commands: HEATERS.iter().chain(&["m106"]).map(|&name| name.to_owned()).collect() };
        let left = edited(Edit::Clean(clean.clone()), text.as_bytes());
        let wanted: String =
            text.split_inclusive('\n').filter(|line| !line.starts_with("M104") && !line.starts_with("M106")).collect();
        prop_assert_eq!(unsigned(&left), wanted.into_bytes());
        let numbered = support::Pot { dialect: support::Dialect { numbered: true, ..pot.dialect }, ..pot };
        let left = edited(Edit::Clean(clean), numbered.text().as_bytes());
        assert_sound(&left, pot.dialect.crlf);
        assert_same_motion(&left, text.as_bytes());
    }

    #[test]
    fn no_bytes_break_an_edit(text in prop::collection::vec(
        prop_oneof![
            4 => "(G[0-3]|G1|G28|G9[0-2]|M8[23]|G2[01]|G1[789]|g1|N1 G1|M104|G5)( ?[XYZEFIJR]-?[0-9]{0,9}[.]?[0-9]{0,9}){0,5}(\\*[0-9]{1,3})?( ?;a)?",
            1 => "[ -~é]{0,12}",
        ], 0..40), end in prop::sample::select(vec!["\n", "\r\n", "\r"])) {
        let text = text.join(end).into_bytes();
        let other = Base { other: text.clone(), height: None, e_factor: Some(1.0), lift: 5.0 };
        for edit in [
            scale(0.5, Axes::Xyz, true), scale(2.0, Axes::Z, false), speed(0.5), nozzle(1.0, 2.0), rim(2, 1.0, 1.0),
            Edit::Base(other), Edit::Pause(Pause { at: At::Height(1.0), prime: 1.0, ..Pause::default() }),
            Edit::Speed(Speed { bottom: 1.0, top: 0.01, travels: true }),
            Edit::Nozzle(Nozzle { old: 1.0, new: 2.0, section: Section::Stadium, spread: 1.0, layer: None }),
            Edit::Clean(Clean { commands: vec!["M104".to_owned()] }),
        ] {
            // A refusal is as good; what must not be is a panic.
            let _ = edit.apply(&text);
        }
    }
}
