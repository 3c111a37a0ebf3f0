//! What several tests of the crate need, and the tests of the pipeline.

use crate::{Profile, craft};
use skein::Notes;

/// A square of 20 mm in two layers.
pub(crate) const TINY: &str = "\
(<extruderInitialization>)
(<decimalPlacesCarried> 3 </decimalPlacesCarried>)
(<layerHeight> 1.5 </layerHeight>)
(<firstLayerHeight> 1.5 </firstLayerHeight>)
(<nozzleDiameter> 3.0 </nozzleDiameter>)
(<eUnit> mm3 </eUnit>)
(<beadSection> rectangle </beadSection>)
(<infillWidth> 3.0 </infillWidth>)
(<edgeWidth> 3.0 </edgeWidth>)
(<settings>)
(</settings>)
(<procedureName> carve </procedureName>)
(<procedureName> preface </procedureName>)
(</extruderInitialization>)
(<crafting>)
(<layer> 0.75 )
G1 X0.0 Y0.0 Z1.5
(<edge> outer )
M101
G1 X20.0 Y0.0 Z1.5
G1 X20.0 Y20.0 Z1.5
G1 X0.0 Y20.0 Z1.5
G1 X0.0 Y0.0 Z1.5
M103
(</edge>)
(</layer>)
(<layer> 2.25 )
G1 X0.0 Y0.0 Z3.0
(<edge> outer )
M101
G1 X20.0 Y0.0 Z3.0
G1 X20.0 Y20.0 Z3.0
G1 X0.0 Y20.0 Z3.0
G1 X0.0 Y0.0 Z3.0
M103
(</edge>)
(</layer>)
(</crafting>)
";

fn crafted(stage: &str, text: &str, profile: &Profile) -> String {
    let mut out = Vec::new();
    let mut sink = |piece: &[u8]| {
        out.extend_from_slice(piece);
        Ok(())
    };
    craft(stage, text.as_bytes(), profile, &mut Notes::default(), &mut sink)
        .unwrap_or_else(|error| panic!("{stage}: {error}"));
    String::from_utf8(out).expect("text")
}

#[test]
fn a_stage_that_is_switched_off_leaves_the_text_alone() {
    let mut profile = Profile::default();
    // Not even a text that the writer would spell otherwise is touched.
    let odd = TINY.replace("X20.0 ", "X20.000 ");
    for stage in ["inset", "fill", "speed", "dimension"] {
        profile.set(&format!("{stage}.active"), "false").expect("a switch");
        assert_eq!(crafted(stage, &odd, &profile), odd, "{stage}");
    }
}

#[test]
fn a_stage_done_twice_is_done_once() {
    let profile = Profile::default();
    let once = crafted("speed", TINY, &profile);
    assert!(once.contains("(<procedureName> speed </procedureName>)"), "{once}");
    assert!(once.contains("(<setting> speed feed 30 </setting>)"), "{once}");
    assert_eq!(crafted("speed", &once, &profile), once);
    // A stage from one form to another sees what it made itself.
    assert_eq!(crafted("preface", TINY, &profile), TINY);
}

#[test]
fn an_unknown_stage_and_a_wrong_text_are_refused() {
    let profile = Profile::default();
    let mut sink = |_: &[u8]| Ok(());
    let mut notes = Notes::default();
    for (stage, text) in
        [("iron", TINY), ("fill", "no skein"), ("preface", "no drawing"), ("carve", "solid x")]
    {
        assert!(craft(stage, text.as_bytes(), &profile, &mut notes, &mut sink).is_err(), "{stage}");
    }
}
