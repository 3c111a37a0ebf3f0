use crate::Speed;
use skein::{Feed, Line, Notes, Nozzle, Ratio, Skein, Stage};

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
fn s5_the_header_says_all_speeds_above_the_bead_width() {
    let skein = craft(&Speed::default(), &layer("0.75"));
    let text = String::from_utf8(skein.write()).expect("text");
    assert!(text.contains(
        "(<operatingFeedRatePerSecond> 30.0 </operatingFeedRatePerSecond>)\n\
         (<travelFeedRatePerSecond> 60.0 </travelFeedRatePerSecond>)\n\
         (<orbitalFeedRatePerSecond> 15.0 </orbitalFeedRatePerSecond>)\n\
         (<maximumZFeedRatePerSecond> 10.0 </maximumZFeedRatePerSecond>)\n(<edgeWidth>"
    ));
}

/// The flow of each bead's first move.
fn flows(skein: &Skein) -> Vec<f64> {
    let mut nozzle = Nozzle::default();
    let mut flows = Vec::new();
    let mut starts = false;
    for line in skein.lines() {
        starts |= *line == Line::On;
        if line.as_move().is_some() && std::mem::take(&mut starts) {
            flows.push(nozzle.flow.f64());
        }
        nozzle.follow(line);
    }
    flows
}

/// How often a flow is said.
fn said(skein: &Skein) -> usize {
    skein.lines().filter(|line| matches!(line, Line::Flow(_))).count()
}

/// In the original 105 and 210 of a motor; here a half and the whole of what a bead is made of.
#[test]
fn s6_walls_have_a_flow_of_their_own_and_it_is_said_where_it_changes() {
    let speed = Speed { perimeter_flow: share(0.5), ..Speed::default() };
    let twice = layer("0.75").replace(
        "(<infill>)",
        "(<edge> outer )\nG1 X3.0 Y3.0 Z0.75\nM101\nG1 X6.0 Y3.0 Z0.75\nM103\n(</edge>)\n(<infill>)",
    );
    let skein = craft(&speed, &(twice + &layer("2.25")));
    assert_eq!(flows(&skein), [0.5, 0.5, 1.0, 0.5, 1.0]);
    assert_eq!(said(&skein), 4);
}

#[test]
fn s6_shares_are_on_top_of_what_fill_gave_and_a_layer_leaves_the_flow_as_it_was() {
    let speed = Speed {
        perimeter_flow: share(0.8),
        first_layer_flow: share(1.2),
        first_layer_perimeter_flow: share(1.5),
        bridge_flow: share(0.5),
        ..Speed::default()
    };
    let shared =
        |z: &str| layer(z).replacen("M101", "M101\nM108 S0.5", 1).replacen("M103", "M103\nM108 S1.0", 1);
    let bridge = shared("3.75")
        .replace("(<edge> outer )", "(<bridgeRotation> (1+0j) )\n(<edge> outer )")
        .replace("(</layer>)", "(</bridgeRotation>)\n(</layer>)");
    let skein = craft(&speed, &(shared("0.75") + &shared("2.25") + &bridge));
    assert_eq!(flows(&skein), [0.6, 1.2, 0.4, 1.0, 0.2, 0.5]);
    assert!(skein.nozzles().iter().all(|nozzle| nozzle.flow == Ratio::ONE), "at every layer's start");
}

/// Volume per second is section times feed. The original's wall factor is the ratio of the two sections, 0.7758; so is
/// ours for beads with these shares.
#[test]
fn s8_equally_much_clay_comes_each_second() {
    let (wall, infill) = (0.72 - 0.4 * (1.0 - std::f64::consts::FRAC_PI_4), 0.6 * 0.82);
    let speed = Speed { constant_flow: true, first_layer: Ratio::ONE, feed: per_s(16.0), ..Speed::default() };
    let body = layer("0.75").replacen("M101", &format!("M101\nM108 S{:.6}", wall / infill), 1).replacen(
        "M103",
        "M103\nM108 S1.0",
        1,
    );
    // 16 mm/s · 0.7758 = 744.8 mm/min.
    assert_eq!(feeds(&speed, &body), [Some(3600), Some(744), None, Some(3600), Some(960)]);
    let body = layer("0.75").replacen("M101", "M101\nM108 S0.001", 1);
    assert_eq!(feeds(&speed, &body)[1], Some(3600), "no faster than a travel");
}

#[test]
fn s3_the_first_layer_has_shares_for_walls_infill_and_travels() {
    // SFACT: walls 15, infill 25, travel 50 mm/s, of 60 and 100; above walls 30, infill 60.
    let speed = Speed {
        feed: per_s(60.0),
        travel_feed: per_s(100.0),
        first_layer: share(0.416667),
        first_layer_perimeter: share(1.2),
        first_layer_travel: share(0.5),
        perimeter: share(0.5),
        ..Speed::default()
    };
    let body = layer("0.75") + &layer("2.25");
    let expected = [
        [Some(3000), Some(900), None, Some(3000), Some(1500)],
        [Some(6000), Some(1800), None, Some(6000), Some(3600)],
    ];
    assert_eq!(feeds(&speed, &body), expected.concat());
}

/// S7 of the original is the work of `limit`, which finds the fact here.
#[test]
fn s7_the_fastest_climb_is_stated_for_limit() {
    let speed = Speed { z_feed: per_s(8.0), ..Speed::default() };
    assert_eq!(craft(&speed, &layer("0.75")).facts().expect("facts").z_feed, Some(per_s(8.0)));
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
