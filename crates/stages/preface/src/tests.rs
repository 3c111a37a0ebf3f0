use crate::Preface;
use skein::{
    Direction, EUnit, Facts, Line, Micron, Point, Ring, RotatedLoopLayer, Section, Signature, Skein, Slices,
    Tag,
};

fn square(half: i32) -> Ring {
    Ring([(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| Point::new(x, y)).to_vec())
}

fn hole(half: i32) -> Ring {
    Ring(square(half).0.into_iter().rev().collect())
}

/// Two layers, the first 1.2 mm high, the second 1.5 mm.
fn slices(loops: &[Ring]) -> Slices {
    let facts = Facts {
        layer_height: Some(Micron(1500)),
        first_layer_height: Some(Micron(1200)),
        nozzle: Some(Micron(3000)),
        e_unit: Some(EUnit::Mm3),
        bead_section: Some(Section::Rectangle),
        infill_width: Some(Micron(3000)),
        bead_width: Some(Micron(3200)),
        ..Facts::default()
    };
    let layer = |z, thickness| RotatedLoopLayer { z, thickness, rotation: None, loops: loops.to_vec() };
    Slices {
        facts,
        layers: vec![layer(Micron(600), Some(Micron(1200))), layer(Micron(1950), Some(Micron(1500)))],
        ..Slices::default()
    }
}

fn craft(preface: &Preface, slices: &Slices) -> Skein {
    let skein = preface.craft(slices).expect("sound slices");
    skein.verify().expect("lawful skein");
    assert_eq!(Skein::read(&skein.write()).as_ref(), Ok(&skein), "reading undoes writing");
    skein
}

fn text(skein: &Skein) -> String {
    String::from_utf8(skein.write()).expect("text")
}

#[test]
fn p1_a_layer_has_each_corner_once_and_its_own_height_only_when_unusual() {
    let skein = craft(&Preface::default(), &slices(&[square(10_000)]));
    let count = |layer: usize| {
        skein.layers[layer].lines.iter().filter(|line| matches!(line, Line::Point(..))).count()
    };
    assert_eq!((count(0), count(1)), (4, 4));
    assert_eq!(skein.layers[0].lines[..2], [Line::Layer(Micron(600)), Line::Thickness(Micron(1200))]);
    assert_eq!(skein.layers[1].lines[..2], [Line::Layer(Micron(1950)), Line::Open(Tag::NestedRing)]);
    assert!(skein.lines().all(|line| line.as_move().is_none()), "preface moves nothing");
}

#[test]
fn p2_the_header_says_absolute_and_millimetres_and_never_goes_home() {
    let text_of = |preface: &Preface| text(&craft(preface, &slices(&[])));
    let all = text_of(&Preface::default());
    assert!(all.contains("\nG90\nG21\n") && !all.contains("G28"), "{all}");
    let none =
        Preface { set_positioning_to_absolute: false, set_units_to_millimeters: false, ..Preface::default() };
    assert!(!text_of(&none).contains("\nG"));
}

#[test]
fn p3_a_note_is_one_line_and_no_note_is_none() {
    let preface = Preface { meta: " vase 7 ".to_owned(), ..Preface::default() };
    assert_eq!(text(&craft(&preface, &slices(&[]))).matches("(<meta> vase 7 </meta>)\n").count(), 1);
    assert!(!text(&craft(&Preface::default(), &slices(&[]))).contains("meta"));
    let broken = Preface { meta: "two\nlines".to_owned(), ..Preface::default() };
    assert_eq!(
        broken.craft(&slices(&[])).expect_err("a line break").to_string(),
        "meta = \"two\\nlines\" cannot stand in a header tag"
    );
}

#[test]
fn p4_a_ring_is_two_outlines() {
    let skein = craft(&Preface::default(), &slices(&[square(15_000), hole(8_000)]));
    for layer in &skein.layers {
        assert_eq!(layer.lines.iter().filter(|line| **line == Line::Open(Tag::NestedRing)).count(), 2);
    }
}

#[test]
fn p5_the_stages_of_the_drawing_are_handed_on_with_their_settings() {
    let mut slices = slices(&[]);
    for stage in ["carve", "scale", "bottom"] {
        slices.done.push(Signature {
            stage: stage.to_owned(),
            settings: vec![("step".to_owned(), "1.5".to_owned())],
        });
    }
    let skein = craft(&Preface::default(), &slices);
    assert!(["carve", "scale", "bottom"].iter().all(|stage| skein.has_done(stage)));
    assert!(!skein.has_done("preface"), "the pipeline signs");
    assert!(text(&skein).contains(
        "(<edgeWidth> 3.2 </edgeWidth>)\n(<settings>)\n(<setting> carve step 1.5 </setting>)\n\
         (<setting> scale step 1.5 </setting>)\n(<setting> bottom step 1.5 </setting>)\n(</settings>)\n\
         (<procedureName> carve </procedureName>)\n(<procedureName> scale </procedureName>)\n\
         (<procedureName> bottom </procedureName>)\n(</extruderInitialization>)\n(<crafting>)\n"
    ));
}

#[test]
fn p6_two_runs_are_equal_to_the_byte() {
    let slices = slices(&[square(15_000), hole(8_000)]);
    assert_eq!(craft(&Preface::default(), &slices).write(), craft(&Preface::default(), &slices).write());
}

#[test]
fn the_facts_come_through() {
    let slices = slices(&[]);
    let facts = craft(&Preface::default(), &slices).facts().expect("facts");
    assert_eq!(facts, Facts { decimals: Some(3), ..slices.facts });
    let bare = Slices::default();
    assert_eq!(
        Preface::default().craft(&bare).expect_err("no facts").to_string(),
        "the header has no `layerHeight`"
    );
}

#[test]
fn a_bridge_block_wraps_the_outlines_of_its_layer() {
    let mut slices = slices(&[square(10_000)]);
    slices.layers[1].rotation = Some(Direction::X);
    let skein = craft(&Preface::default(), &slices);
    let lines = &skein.layers[1].lines;
    assert_eq!(lines[1], Line::Rotation(Tag::BridgeRotation, Direction::X));
    assert_eq!(lines[lines.len() - 2..], [Line::Close(Tag::BridgeRotation), Line::Close(Tag::Layer)]);
}
