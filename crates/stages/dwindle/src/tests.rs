use super::*;
use skein::{Micron, Point3, Section};

/// The rows speak of a section of 0.72 · 0.4 · 0.82; a rectangle has no 0.82, so both volumes are larger by it.
fn stage(slow_feed: bool) -> Dwindle {
    let volume = |value: f64| Ratio::from_f64(value / 0.82).expect("a volume");
    Dwindle {
        pent_up_volume: OrLag::Is(volume(0.4)),
        slowdown_volume: OrLag::Is(volume(5.0)),
        end_rate: Ratio(500_000),
        slowdown_steps: 3,
        slow_feed,
    }
}

fn dwindled(slow_feed: bool, thread: Thread) -> Thread {
    let stage = stage(slow_feed);
    stage.relief(&Facts::default(), BEAD).expect("volumes").dwindled(thread, BEAD)
}

const BEAD: Bead = Bead { width: Micron(720), height: Micron(400), section: Section::Rectangle };

fn thread(mm: i32) -> Thread {
    let to = Point3 { x: mm * 1000, y: 0, z: 200 };
    let step = Move { feed: Feed::new(960_000), ..Move::to(to) };
    let start = Point3 { x: 0, ..to };
    Thread { start, stretches: vec![Stretch { step, flow: Ratio::ONE, block: None }] }
}

/// stages_tests.md DW1: its flows are shares of 210, since M108 is a share here; and what it does to flow and feed at
/// once is done to the one or to the other.
#[test]
fn dw1_the_end_of_a_bead_in_three_steps() {
    let steps = |slow_feed: bool| dwindled(slow_feed, thread(20)).stretches;
    for (piece, end) in steps(false).iter().zip([6_667, 13_333, 20_000]) {
        assert!((piece.step.to.x - end).abs() <= 1, "a cut is rounded to the micron: {piece:?}");
    }
    for (piece, wanted) in steps(false).iter().zip([172.64, 142.23, 111.81]) {
        assert!((piece.flow.f64() * 210.0 - wanted).abs() < 0.01, "{piece:?}");
        assert_eq!(piece.step.feed, Feed::new(960_000));
    }
    for (piece, wanted) in steps(true).iter().zip([857.856, 706.7136, 555.5712]) {
        let feed = piece.step.feed.expect("a feed").mm_per_s() * 60.0;
        assert!((feed - wanted).abs() < 0.01, "{feed} {wanted}");
        assert!((piece.flow.f64() - 0.92).abs() < 1e-6);
    }
}

/// stages_tests.md DW2.
#[test]
fn dw2_a_long_bead_is_full_until_its_end() {
    let pieces = dwindled(false, thread(100)).stretches;
    assert_eq!(pieces.len(), 4);
    assert_eq!((pieces[0].flow, (pieces[0].step.to.x + 50) / 100), (Ratio::ONE, 788));
}

#[test]
fn a_bead_without_clay_or_length_stays() {
    let mut still = thread(0);
    assert_eq!(dwindled(false, still.clone()).end(), still.end());
    still.stretches[0].flow = Ratio(0);
    assert_eq!(dwindled(false, still.clone()).stretches.len(), 1);
}

/// Seven times what is pent up at the speed of the beads, unless oozebane has seen to it.
#[test]
fn what_is_pent_up_follows_from_the_lag() {
    let mut facts = Facts {
        stop_lag: Ratio::from_f64(0.5),
        operating_feed: Feed::from_mm_per_s(20.0),
        ..Facts::default()
    };
    let stage = Dwindle::default();
    let relief = stage.relief(&facts, BEAD).expect("a lag");
    let volume = 0.5 * 20.0 * 0.72 * 0.4;
    assert!((relief.pent_up - volume).abs() < 1e-9 && (relief.slowdown - 7.0 * volume).abs() < 1e-9);
    facts.made_up(End::Stop, 10_000.0);
    assert!(stage.relief(&facts, BEAD).expect("no lag").slowdown <= 0.0);
    assert!(stage.relief(&Facts::default(), BEAD).is_err());
}
