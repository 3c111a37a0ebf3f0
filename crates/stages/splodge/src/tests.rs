use super::*;

const TEXT: &str = "\
(<layerHeight> 0.4 </layerHeight>)
(<operatingFeedRatePerSecond> 16.0 </operatingFeedRatePerSecond>)
(<edgeWidth> 0.72 </edgeWidth>)
(</extruderInitialization>)
(<layer> 0.2 )
G1 X0 Y50 Z0.2 F1200
G1 X0 Y0 Z0.2
M101
G1 X20 Y0 Z0.2 F960
M103
G1 X40 Y0 Z0.2 F1200
M101
G1 X60 Y0 Z0.2 F960
M103
(</layer>)
";

fn splodge() -> Splodge {
    let one = Feed::from_mm_per_s(1.0).expect("a feed");
    Splodge {
        initial_feed: one,
        operating_feed: one,
        initial_quantity: Micron(30_000),
        operating_quantity: OrLag::Is(Micron(1_000)),
        initial_lift: Ratio::ONE,
        operating_lift: Ratio::ONE,
    }
}

fn lines(stage: &Splodge) -> Vec<String> {
    let skein = Skein::read(TEXT.as_bytes()).expect("a skein");
    let skein = stage.craft(skein, &mut Notes::default()).expect("splodge");
    assert_eq!(skein.verify(), Ok(()));
    String::from_utf8(skein.write()).expect("text").lines().skip(5).map(str::to_owned).collect()
}

/// stages_tests.md G1, G3 and G5.
#[test]
fn g1_g3_g5_the_first_blob() {
    assert_eq!(
        lines(&splodge())[1..10],
        [
            "G1 X0.0 Y1.875 Z1.4",
            "M108 S16.0",
            "M101",
            "G1 X0.0 Y0.0 Z1.4 F60.0",
            "M108 S0.0",
            "G1 X0.0 Y0.0 Z0.2",
            "M108 S1.0",
            "G1 X20.0 Y0.0 Z0.2 F960.0",
            "M103"
        ]
    );
}

/// stages_tests.md G2 and G6.
#[test]
fn g2_g6_the_later_blobs() {
    let lines = lines(&splodge());
    assert!(lines.contains(&"G1 X39.937 Y0.0 Z1.4 F1200.0".to_owned()), "{lines:?}");
    assert_eq!(lines.iter().filter(|line| *line == "M101").count(), 2);
}

/// stages_tests.md G4.
#[test]
fn g4_too_little_is_no_blob() {
    let none =
        Splodge { initial_quantity: Micron(71), operating_quantity: OrLag::Is(Micron(0)), ..splodge() };
    let skein = Skein::read(TEXT.as_bytes()).expect("a skein");
    assert_eq!(none.craft(skein.clone(), &mut Notes::default()), Ok(skein));
}
