//! What several tests of the crate need, and the tests of the pipeline.

use crate::{Profile, craft, slice};
use skein::{Notes, Slices};
use std::fmt::Write;

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

/// The layers of a part or a drawing, and what was said.
fn carved(part: &[u8], profile: &Profile) -> (Slices, Notes) {
    let mut out = Vec::new();
    let mut sink = |piece: &[u8]| {
        out.extend_from_slice(piece);
        Ok(())
    };
    let sliced = slice(part, profile, Some("carve"), &mut |_| Ok(()), &mut sink).expect("layers");
    (Slices::read(&out).expect("layers"), sliced.notes)
}

/// Layers as another program draws them: a polygon for each loop, in a window that lies elsewhere, y downwards.
fn drawn_elsewhere(slices: &Slices) -> String {
    let mut text =
        String::from("<svg xmlns='http://www.w3.org/2000/svg' width='10in' viewBox='0 0 254 254'>");
    for layer in &slices.layers {
        write!(text, "<g transform='translate(-30,20)' id='z:{}'>", layer.z).expect("text");
        for ring in &layer.loops {
            let point =
                |point: &shape::Point| format!("{},{} ", skein::Micron(point.x), skein::Micron(-point.y));
            let points: String = ring.0.iter().map(point).collect();
            write!(text, "<polygon points='{points}'/>").expect("text");
        }
        text.push_str("</g>");
    }
    text + "</svg>"
}

#[test]
fn layers_drawn_elsewhere_are_those_of_the_part() {
    let profile = Profile::default();
    for (part, tolerance) in [
        (&include_bytes!("../../../examples/cube.stl")[..], 0.0),
        // Corners of round loops may be left out twice, five microns each time.
        (include_bytes!("../../../examples/cup.stl"), 0.01),
    ] {
        let (own, _) = carved(part, &profile);
        let (drawn, notes) = carved(drawn_elsewhere(&own).as_bytes(), &profile);
        assert!(notes.is_empty(), "{:?}", notes.summary());
        assert_eq!(drawn.facts, own.facts);
        assert_eq!(drawn.layers.len(), own.layers.len());
        for (drawn, own) in drawn.layers.iter().zip(&own.layers) {
            assert_eq!((drawn.z, drawn.thickness), (own.z, own.thickness));
            assert_eq!(drawn.loops.len(), own.loops.len());
            for (drawn, own) in drawn.loops.iter().zip(&own.loops) {
                let most = own.length() / 1000.0 * tolerance;
                assert!((drawn.area() - own.area()).abs() <= most, "{} {}", drawn.area(), own.area());
                assert!(tolerance > 0.0 || drawn == own);
            }
        }
    }
}

#[test]
fn a_drawing_of_another_program_goes_through_carve_once() {
    let profile = Profile::default();
    let drawing = "<svg width='99mm'><g z='1'><rect width='40' height='40'/></g>\
        <g z='3'><rect width='40' height='40'/></g></svg>";
    let carved = crafted("carve", drawing, &profile);
    assert_eq!(crafted("carve", &carved, &profile), carved);
    let slices = Slices::read(carved.as_bytes()).expect("layers");
    assert_eq!(slices.facts.layer_height.map(|height| height.mm()), Some(2.0));
    assert_eq!(slices.facts.bead_width.map(|width| width.mm()), Some(3.2));
    let mut sink = |_: &[u8]| Ok(());
    let off_the_bed = drawing.replace("40", "4000");
    let error = craft("carve", off_the_bed.as_bytes(), &profile, &mut Notes::default(), &mut sink);
    assert!(error.expect_err("too large").message.contains("has room for"));
}
