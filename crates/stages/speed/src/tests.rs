use crate::Speed;
use skein::{Feed, Notes, Ratio, Skein, Stage};

const HEAD: &str = "(<extruderInitialization>)\n(<layerHeight> 1.5 </layerHeight>)\n(<edgeWidth> 3.0 </edgeWidth>)\n\
                    (</extruderInitialization>)\n(<crafting>)\n";

fn craft(speed: &Speed, body: &str) -> Skein {
    let skein = Skein::read(format!("{HEAD}{body}(</crafting>)\n").as_bytes()).expect("a skein");
    let skein = speed.craft(skein, &mut Notes::default()).expect("speed");
    skein.verify().expect("lawful skein");
    skein
}

/// The feed of each move, in mm/min.
fn feeds(speed: &Speed, body: &str) -> Vec<Option<u32>> {
    let skein = craft(speed, body);
    skein
        .lines()
        .filter_map(|line| line.as_move().map(|step| step.feed.map(|feed| feed.get() / 1000)))
        .collect()
}

fn per_s(feed: f64) -> Feed {
    Feed::from_mm_per_s(feed).expect("a feed")
}

fn share(share: f64) -> Ratio {
    Ratio::from_f64(share).expect("a share")
}

/// A wall and a row of infill.
fn layer(z: &str) -> String {
    format!(
        "(<layer> {z} )\n(<edge> outer )\nG1 X0.0 Y0.0 Z{z}\nM101\nG1 X9.0 Y0.0 Z{z}\nG1 X9.0 Y9.0 Z{z}\nM103\n(</edge>)\n\
         (<infill>)\nG1 X1.0 Y1.0 Z{z}\nM101\nG1 X8.0 Y1.0 Z{z}\nM103\n(</infill>)\n(</layer>)\n"
    )
}

#[test]
fn s1_s2_the_first_layer_is_slower_and_travels_are_not() {
    let speed =
        Speed { feed: per_s(16.0), travel_feed: per_s(16.0), first_layer: share(0.4), ..Speed::default() };
    let body = layer("0.75") + &layer("2.25");
    let first = [Some(960), Some(384), None, Some(960), Some(384)];
    // Beads and travels are equally fast above, but each kind says so once.
    let later = [Some(960), Some(960), None, None, None];
    assert_eq!(feeds(&speed, &body), [first, later].concat());
}

#[test]
fn s3_walls_infill_and_bridges_have_their_own_speeds() {
    let speed =
        Speed { first_layer: share(0.5), perimeter: share(0.5), bridge: share(0.8), ..Speed::default() };
    let bridge = layer("3.75")
        .replace("(<edge> outer )", "(<bridgeRotation> (1+0j) )\n(<edge> outer )")
        .replace("(</layer>)", "(</bridgeRotation>)\n(</layer>)");
    let body = layer("0.75") + &layer("2.25") + &bridge;
    let expected = [
        [Some(3600), Some(450), None, Some(3600), Some(900)],
        [Some(3600), Some(900), None, Some(3600), Some(1800)],
        [Some(3600), Some(720), None, Some(3600), Some(1440)],
    ];
    assert_eq!(feeds(&speed, &body), expected.concat());
}

#[test]
fn s4_a_move_with_its_own_feed_keeps_it_and_the_next_one_does_not_inherit_it() {
    let body = layer("0.75").replace("G1 X9.0 Y0.0 Z0.75", "G1 X9.0 Y0.0 Z0.75 F123");
    assert_eq!(feeds(&Speed::default(), &body), [Some(3600), Some(123), Some(900), Some(3600), Some(900)]);
}

#[test]
fn s5_the_header_says_both_speeds_above_the_bead_width() {
    let skein = craft(&Speed::default(), &layer("0.75"));
    let text = String::from_utf8(skein.write()).expect("text");
    assert!(text.contains(
        "(<operatingFeedRatePerSecond> 30.0 </operatingFeedRatePerSecond>)\n\
         (<travelFeedRatePerSecond> 60.0 </travelFeedRatePerSecond>)\n(<edgeWidth>"
    ));
}

#[test]
fn a_second_run_changes_nothing() {
    let once = craft(&Speed::default(), &(layer("0.75") + &layer("2.25")));
    let twice = Speed::default().craft(once.clone(), &mut Notes::default()).expect("speed");
    assert_eq!(once, twice);
}

#[test]
fn shares_are_rounded_once() {
    let speed = Speed {
        feed: per_s(0.1),
        first_layer: share(0.333333),
        perimeter: share(0.333333),
        ..Speed::default()
    };
    // 6000 µm/min · 0.333333² = 666.6653 µm/min; rounding after each factor would give 666.
    let skein = craft(&speed, &layer("0.75"));
    let bead = skein.layers[0].lines[4].as_move().and_then(|step| step.feed);
    assert_eq!(bead.map(Feed::get), Some(667));
}
