use super::*;
use skein::{Facts, Heaters};

/// A layer of one bead of 40 mm around a square of 10 mm (2.5 s at F960).
fn square(z: f64, travel: &str) -> String {
    format!(
        "(<layer> {z} )\n{travel}M101\nG1 X10 Y0 Z{z} F960\nG1 X10 Y10 Z{z}\nG1 X0 Y10 Z{z}\nG1 X0 Y0 Z{z}\nM103\n\
         (</layer>)\n"
    )
}

fn skein(head: &str, text: &str) -> Skein {
    let head = format!(
        "(<layerHeight> 0.4 </layerHeight>)\n(<heaters> nozzle </heaters>)\n\
         (<orbitalFeedRatePerSecond> 8.0 </orbitalFeedRatePerSecond>)\n\
         (<travelFeedRatePerSecond> 20.0 </travelFeedRatePerSecond>)\n\
         (<edgeWidth> 0.72 </edgeWidth>)\n(</extruderInitialization>)\n(<crafting>)\n{head}"
    );
    Skein::read(format!("{head}{text}(</crafting>)\n").as_bytes()).expect("a skein")
}

fn cool(least: f64, floor: f64) -> Cool {
    Cool {
        minimum_layer_time: Ratio::from_f64(least).expect("a time"),
        minimum_feed: Feed::from_mm_per_s(floor).expect("a feed"),
        maximum_cool: Ratio(0),
        bridge_cool: Ratio(0),
        ..Cool::default()
    }
}

fn lines(stage: &Cool, skein: Skein) -> Vec<String> {
    let skein = stage.craft(skein, &mut Notes::default()).expect("cool");
    assert_eq!(skein.verify(), Ok(()));
    String::from_utf8(skein.write()).expect("text").lines().map(str::to_owned).collect()
}

fn feeds(stage: &Cool, skein: Skein) -> Vec<u32> {
    let skein = stage.craft(skein, &mut Notes::default()).expect("cool");
    skein.lines().filter_map(Line::as_move).filter_map(|step| step.feed).map(Feed::get).collect()
}

const START: &str = "G1 X0 Y0 Z0.2 F1200\n";

/// stages_tests.md O1, O3 and O4.
#[test]
fn o1_o3_o4_a_short_layer_is_slowed_down_to_a_floor() {
    let layer = || skein(START, &square(0.2, ""));
    assert_eq!(feeds(&cool(10.0, 1.0), layer())[1], 240_000);
    assert_eq!(feeds(&cool(10.0, 15.0), layer())[1], 900_000);
    assert_eq!(Ok(layer()), cool(2.5, 1.0).craft(layer(), &mut Notes::default()));
}

/// stages_tests.md O2, O8 and O9: the travel is part of the time and keeps its speed.
#[test]
fn o2_o8_o9_the_rise_counts_and_is_not_slowed() {
    let rise = "G1 X0 Y0 Z0.6 F1200\n";
    let print = skein(START, &square(0.6, rise));
    assert_eq!(feeds(&cool(10.0, 1.0), print.clone())[1..], [1_200_000, 240_481]);
    let slowed = cool(10.0, 1.0).craft(print, &mut Notes::default()).expect("cool");
    let times = Times::of(&slowed.layers[0].lines, slowed.nozzles()[0]);
    assert!((times.all - 10.0).abs() < 0.001, "{times:?}");
}

/// stages_tests.md O5, with its height above the top of the print.
#[test]
fn o5_around_the_layer_below() {
    let mut outline = String::from("(<boundaryPerimeter>)\n");
    for (x, y) in [(0, 0), (20, 0), (20, 20), (0, 20)] {
        outline += &format!("(<boundaryPoint> X{x} Y{y} Z0.2 </boundaryPoint>)\n");
    }
    outline += "(</boundaryPerimeter>)\n";
    let layer = |z: f64| square(z, "").replace("M101", &format!("{outline}G1 X0 Y0 Z{z}\nM101"));
    let stage = Cool { waiting: Waiting::Orbit, clearance: Ratio(1_000_000), ..cool(10.0, 1.0) };
    let made = lines(&stage, skein(START, &(layer(0.2) + &layer(0.6))));
    let second = made.iter().position(|line| line == "(<layer> 0.6 )").expect("a layer");
    assert!(!made[..second].iter().any(|line| line.contains("F480")), "none before the first layer");
    assert_eq!(
        made[second + 1..second + 5],
        [
            "G1 X0.0 Y0.0 Z0.6 F1200.0",
            "G1 X-2.0 Y-2.0 Z0.6 F480.0",
            "G1 X22.0 Y-2.0 Z0.6",
            "G1 X22.0 Y22.0 Z0.6"
        ]
    );
    assert!(made[second..].iter().any(|line| line.contains("F960")), "beads keep their speed");
}

/// stages_tests.md O6 and O7.
#[test]
fn o6_o7_a_heated_nozzle_is_a_little_cooler() {
    let stage = Cool { maximum_cool: Ratio(2_000_000), bridge_cool: Ratio(1_000_000), ..cool(10.0, 1.0) };
    let hot = "M104 S200.0\n";
    let made = lines(&stage, skein(&format!("{hot}{START}"), &square(0.2, "")));
    let at = |wanted: &str| made.iter().position(|line| line == wanted).expect("a temperature");
    assert_eq!(made[at("M104 S198.5") - 1], "(<layer> 0.2 )");
    assert_eq!(made[at("(</layer>)") - 1], "M104 S200.0");
    let bridge =
        square(0.2, "(<bridgeRotation> (1+0j) )\n").replace("(</layer>)", "(</bridgeRotation>)\n(</layer>)");
    let long = Cool { minimum_layer_time: Ratio(1_000_000), ..stage.clone() };
    assert!(lines(&long, skein(&format!("{hot}{START}"), &bridge)).contains(&"M104 S199.0".to_owned()));
    let mut unheated = skein(&format!("{hot}{START}"), &square(0.2, ""));
    let facts = Facts { heaters: Some(Heaters::default()), ..Facts::default() };
    unheated.state(&facts).expect("facts");
    assert!(!lines(&stage, unheated).iter().any(|line| line.contains("S198")));
}

/// stages_tests.md O10.
#[test]
fn o10_every_bead_is_slowed_by_the_same_share() {
    let text = square(0.2, "").replace("G1 X10 Y10 Z0.2", "G1 X10 Y10 Z0.2 F1920");
    let fast = feeds(&cool(10.0, 1.0), skein(START, &text));
    assert_eq!(fast[2], 2 * fast[1]);
}

#[test]
fn a_dwell_is_above_the_print_and_as_long_as_is_missing() {
    let stage = Cool { waiting: Waiting::Dwell, clearance: Ratio(2_000_000), ..cool(10.0, 1.0) };
    let made = lines(&stage, skein(START, &(square(0.2, "") + &square(0.2, ""))));
    let dwell = made.iter().position(|line| line == "G4 P7500").expect("a dwell");
    assert_eq!(made[dwell - 1], "G1 X0.0 Y0.0 Z1.0 F1200.0");
}

/// As in alteration, found by the fuzz target `stages`.
#[test]
fn the_fan_of_a_print_that_was_cut_off_stays_on_with_a_note() {
    let mut cut = skein(START, &square(0.2, ""));
    cut.tail.clear();
    let mut notes = Notes::default();
    let done = Cool { fan: true, ..cool(2.5, 1.0) }.craft(cut, &mut notes).expect("cool");
    assert_eq!((done.verify(), done.tail.len()), (Ok(()), 0));
    assert!(notes.iter().any(|note| note.text.contains("no end")), "{notes:?}");
}
