//! Laws of the documents: reading undoes writing, and a view leaves nothing out.
//!
//! The numbers F1 to F12 are those of the format examples of the specification.

use clayforge::{Profile, Source, only_built_in};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use shape::{Bounds, Point, Point3, Ring};
use skein::{
    Arc, BedArea, BedShape, Center, Choice, EUnit, Facts, Field, Heaters, Kind, Line, Mark, Move, Reader,
    RotatedLoopLayer, Section, Setting, Settings, Side, Signature, Skein, Slices, Span, Tag, Value, spans,
};
use std::collections::BTreeMap;
use std::fmt::{Debug, Display};
use std::str::FromStr;
use unit::{Angle, Celsius, Direction, Extrusion, Feed, Micron, Ratio};

// What can exist.

fn coordinate() -> impl Strategy<Value = i32> {
    // Small numbers, round numbers and the ends of the range, so that every way to print one is met.
    prop_oneof![
        -2000..2000i32,
        (-200..200i32).prop_map(|mm| mm * 1000),
        -Micron::LIMIT..=Micron::LIMIT,
        Just(Micron::LIMIT),
        Just(-Micron::LIMIT),
    ]
}

fn length() -> impl Strategy<Value = Micron> {
    (1..=Micron::LIMIT).prop_map(Micron)
}

fn point() -> impl Strategy<Value = Point> {
    (coordinate(), coordinate()).prop_map(|(x, y)| Point::new(x, y))
}

fn place() -> impl Strategy<Value = Point3> {
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| Point3 { x, y, z })
}

fn feed() -> impl Strategy<Value = Feed> {
    (1..=Feed::LIMIT).prop_map(|feed| Feed::new(feed).expect("within the limit"))
}

fn extrusion() -> impl Strategy<Value = Extrusion> {
    let amount =
        prop_oneof![-1_000_000..1_000_000i64, i64::MIN + 1..=i64::MAX, Just(i64::MAX), Just(i64::MIN + 1)];
    amount.prop_map(|amount| Extrusion::new(amount).expect("only the least has no room"))
}

fn direction() -> impl Strategy<Value = Direction> {
    (-1_000_000..=1_000_000i32, -1_000_000..=1_000_000i32).prop_map(|(x, y)| Direction { x, y })
}

fn tag() -> impl Strategy<Value = Tag> {
    prop::sample::select(Tag::ALL.to_vec())
}

/// A text without a line break, much like a line of a skein, but not always one.
fn text() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        prop::sample::select(vec![
            "G1",
            "G1 ",
            "G2 ",
            "I1",
            "(<alterationDeleteThisPrefix/>)",
            "X1",
            "Y-2.5",
            "Z.5",
            "F60",
            "E1",
            "M101",
            "M103",
            "M108 S",
            "(<",
            "</",
            ">)",
            ">",
            ")",
            "layer",
            "edge",
            "thickness",
            "boundaryPoint",
            "infill",
            "setting",
            " outer ",
            " 1.5 ",
            ";",
            "(note)",
            " ",
            "\t",
            "\u{a0}",
            "\u{2028}",
            "\u{b}",
        ])
        .prop_map(str::to_owned),
        "[ -~äß…]{0,8}",
    ];
    vec(piece, 0..8).prop_map(|pieces| pieces.concat())
}

fn line() -> impl Strategy<Value = Line> {
    let side = prop::sample::select(vec![Side::Outer, Side::Inner]);
    prop_oneof![
        8 => (place(), option::of(feed()), option::of(extrusion()))
            .prop_map(|(to, feed, extrusion)| Line::Move(Move { to, feed, extrusion })),
        2 => (place(), option::of(feed()), option::of(extrusion()), any::<bool>(), center())
            .prop_map(|(to, feed, extrusion, clockwise, center)| {
                Line::Arc(Box::new(Arc { step: Move { to, feed, extrusion }, center, clockwise }))
            }),
        2 => (prop::sample::select(vec![Mark::Boundary, Mark::Infill]), place())
            .prop_map(|(mark, at)| Line::Point(mark, at)),
        2 => Just(Line::On),
        2 => Just(Line::Off),
        1 => any::<i32>().prop_map(|flow| Line::Flow(Ratio(flow))),
        1 => coordinate().prop_map(|z| Line::Layer(Micron(z))),
        1 => length().prop_map(Line::Thickness),
        1 => (prop::sample::select(vec![Tag::Edge, Tag::Loop]), side).prop_map(|(tag, side)| Line::Wall(tag, side)),
        1 => (prop::sample::select(vec![Tag::Rotation, Tag::BridgeRotation]), direction())
            .prop_map(|(tag, direction)| Line::Rotation(tag, direction)),
        1 => tag().prop_map(Line::Open),
        1 => tag().prop_map(Line::Close),
        2 => ("[a-zA-Z_0-9]{1,12}", text()).prop_filter_map("a value that is refused", |(name, value)| {
            Line::value(&name, &value).ok()
        }),
        // Free text can only come from the reader.
        2 => text().prop_filter_map("a line with a meaning of its own", |text| {
            Reader::default().line(text.as_bytes()).ok().filter(|line| *line != Line::Verbatim("".into()))
        }),
    ]
}

fn center() -> impl Strategy<Value = Center> {
    let micron = || coordinate().prop_map(Micron);
    prop_oneof![
        (micron(), micron()).prop_map(|(i, j)| Center::Offset { i, j }),
        micron().prop_map(Center::Radius)
    ]
}

fn skein() -> impl Strategy<Value = Skein> {
    (vec(line(), 0..20), vec(line(), 0..80)).prop_map(|(head, body)| {
        let end = Line::Close(Tag::ExtruderInitialization);
        // The header ends before the first layer.
        let head =
            head.into_iter().filter(|line| !matches!(line, Line::Layer(_) | Line::Close(Tag::Crafting)));
        Skein::from_lines(head.chain([end]).chain(body))
    })
}

fn e_unit() -> impl Strategy<Value = EUnit> {
    prop_oneof![
        Just(EUnit::Mm3),
        length().prop_map(EUnit::Ram),
        length().prop_map(EUnit::Filament),
        (1..=i32::MAX).prop_map(EUnit::PerMm),
    ]
}

fn bed() -> impl Strategy<Value = BedArea> {
    let shape = prop::sample::select(BedShape::ALL);
    (place(), length(), length(), shape).prop_map(|(low, x, y, shape)| {
        // Within what a coordinate can be.
        let low = Point::new(low.x.min(Micron::LIMIT / 2), low.y.min(Micron::LIMIT / 2));
        let high = Point::new(low.x + x.0.min(Micron::LIMIT / 2), low.y + y.0.min(Micron::LIMIT / 2));
        BedArea { low, high, shape }
    })
}

fn facts() -> impl Strategy<Value = Facts> {
    // Whatever a profile says: a setting has no more decimals than the header.
    let value = prop_oneof![0.001..1000.0, 0.001..f64::from(Feed::LIMIT / 60_000)];
    let speed = value.prop_map(|value| Setting::read(&Value::Number(value)).expect("within the limit"));
    let lengths = (
        option::of(length()),
        option::of(length()),
        option::of(length()),
        option::of(length()),
        option::of(length()),
    );
    let rest = (
        option::of(Just(3u32)),
        option::of(e_unit()),
        option::of(prop::sample::select(Section::ALL)),
        option::of(speed.clone()),
        option::of(speed.clone()),
        option::of(speed.clone()),
        option::of(speed),
        option::of((any::<bool>(), any::<bool>(), any::<bool>())),
    );
    let celsius = || option::of((-10_000_000..=10_000_000).prop_map(Celsius));
    let nozzle = [(); 9].map(|()| celsius());
    let lag = [(); 2].map(|()| option::of((0..=60_000_000).prop_map(Ratio)));
    (lengths, rest, option::of(bed()), nozzle, lag).prop_map(|(lengths, rest, bed, nozzle, lag)| Facts {
        bed,
        start_lag: lag[0],
        stop_lag: lag[1],
        cooling_rate: nozzle[0],
        heating_rate: nozzle[1],
        base_temperature: nozzle[2],
        interface_temperature: nozzle[3],
        first_layer_infill_temperature: nozzle[4],
        first_layer_perimeter_temperature: nozzle[5],
        next_layers_temperature: nozzle[6],
        support_temperature: nozzle[7],
        supported_temperature: nozzle[8],
        layer_height: lengths.0,
        first_layer_height: lengths.1,
        nozzle: lengths.2,
        infill_width: lengths.3,
        bead_width: lengths.4,
        decimals: rest.0,
        e_unit: rest.1,
        bead_section: rest.2,
        operating_feed: rest.3,
        travel_feed: rest.4,
        z_feed: rest.5,
        orbital_feed: rest.6,
        heaters: rest.7.map(|(nozzle, bed, chamber)| Heaters { nozzle, bed, chamber }),
    })
}

fn slices() -> impl Strategy<Value = Slices> {
    let ring = || vec(point(), 3..9).prop_map(Ring);
    let layer = (coordinate(), option::of(length()), option::of(direction()), vec(ring(), 0..4)).prop_map(
        |(z, thickness, rotation, loops)| RotatedLoopLayer { z: Micron(z), thickness, rotation, loops },
    );
    let done = prop::collection::btree_map("[a-z]{1,8}", vec(("[a-z_]{1,8}", "[ -~äß…]{0,12}"), 0..4), 0..3)
        .prop_map(|done: BTreeMap<String, Vec<(String, String)>>| {
            done.into_iter().map(|(stage, settings)| Signature { stage, settings }).collect::<Vec<_>>()
        });
    (facts(), place(), place(), done, vec(layer, 0..6)).prop_map(|(facts, min, max, done, layers)| Slices {
        facts,
        bounds: Bounds { min, max },
        done,
        layers,
    })
}

fn written(line: &Line) -> Vec<u8> {
    let mut text = Vec::new();
    line.write(&mut text);
    text
}

// The laws.

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]

    #[test]
    fn a_line_is_read_as_it_was_written(line in line()) {
        let text = written(&line);
        prop_assert!(!text.iter().any(|byte| matches!(byte, b'\n' | b'\r')), "a line break in {:?}", line);
        let read = Reader::default().line(&text);
        prop_assert_eq!(read.as_ref(), Ok(&line), "{}", String::from_utf8_lossy(&text));
    }

    #[test]
    fn whatever_the_reader_takes_it_takes_again(text in text()) {
        if let Ok(line) = Reader::default().line(text.as_bytes()) {
            let again = written(&line);
            prop_assert_eq!(Reader::default().line(&again), Ok(line), "{:?}", String::from_utf8_lossy(&again));
        }
    }

    #[test]
    fn no_bytes_make_the_readers_panic(bytes in vec(any::<u8>(), 0..300)) {
        let _ = Reader::default().line(&bytes);
        let _ = Skein::read(&bytes);
        let _ = Slices::read(&bytes);
    }

    #[test]
    fn micron_is_read_as_it_was_written(value in coordinate().prop_map(Micron)) {
        number_law(value, Micron::PLACES)?;
        prop_assert_eq!(Micron::from_mm(value.mm()), Some(value));
    }

    #[test]
    fn ratio_is_read_as_it_was_written(value in any::<i32>().prop_map(Ratio)) {
        number_law(value, Ratio::PLACES)?;
    }

    #[test]
    fn a_temperature_is_read_as_it_was_written(value in (-10_000_000..=10_000_000).prop_map(Celsius)) {
        number_law(value, Celsius::PLACES)?;
    }

    #[test]
    fn feed_is_read_as_it_was_written(value in feed()) {
        number_law(value, Feed::PLACES)?;
        prop_assert_eq!(Feed::from_mm_per_s(value.mm_per_s()), Some(value));
    }

    #[test]
    fn extrusion_is_read_as_it_was_written(value in extrusion()) {
        number_law(value, Extrusion::PLACES)?;
    }

    #[test]
    fn direction_is_read_as_it_was_written(value in direction()) {
        prop_assert_eq!(value.to_string().parse(), Ok(value), "{}", value);
    }

    #[test]
    fn angle_comes_back_through_the_door_of_floats(value in (-1_000_000_000..=1_000_000_000i32).prop_map(Angle)) {
        prop_assert_eq!(Angle::from_degrees(value.degrees()), Some(value));
    }

    #[test]
    fn spans_end_to_end_are_all_lines(lines in vec(line(), 0..60), mut flowing in any::<bool>()) {
        let together: Vec<&Line> = spans(&lines, flowing)
            .flat_map(|span| match span {
                Span::Thread(lines) | Span::Travel(lines) => lines.iter().collect::<Vec<_>>(),
                Span::Other(line) => vec![line],
            })
            .collect();
        prop_assert_eq!(together, lines.iter().collect::<Vec<_>>());
        for span in spans(&lines, flowing) {
            match span {
                Span::Thread(lines) => {
                    prop_assert!(flowing || lines[0] == Line::On);
                    let (last, before) = lines.split_last().expect("a line");
                    prop_assert!(!before.contains(&Line::Off));
                    flowing = *last != Line::Off;
                }
                Span::Travel(lines) => {
                    prop_assert!(!flowing && lines.iter().all(|line| line.as_move().is_some()));
                }
                Span::Other(line) => prop_assert!(!matches!(line, Line::Move(_) | Line::On)),
            }
        }
    }

    #[test]
    fn head_layers_and_tail_are_all_lines(lines in vec(line(), 0..80)) {
        let skein = Skein::from_lines(lines.clone());
        prop_assert_eq!(skein.lines().cloned().collect::<Vec<_>>(), lines);
        let again = Skein::from_lines(skein.lines().cloned());
        prop_assert_eq!(again, skein);
    }

    #[test]
    fn a_skein_is_read_as_it_was_written(skein in skein()) {
        let text = skein.write();
        let read = Skein::read(&text);
        prop_assert_eq!(read.as_ref(), Ok(&skein));
        prop_assert_eq!(text.iter().filter(|byte| **byte == b'\n').count(), skein.lines().count());
    }

    /// F12.
    #[test]
    fn f12_line_ends_make_no_difference(skein in skein()) {
        let text = String::from_utf8(skein.write()).expect("text");
        for ends in ["\r\n", "\r", "\n\n", " \n"] {
            let other = text.replace('\n', ends);
            let read = Skein::read(other.as_bytes());
            prop_assert_eq!(read.as_ref(), Ok(&skein), "{:?}", ends);
        }
        prop_assert_eq!(Skein::read(text.trim_end_matches('\n').as_bytes()), Ok(skein));
    }

    #[test]
    fn slices_are_read_as_they_were_written(slices in slices()) {
        let text = slices.write();
        let read = Slices::read(&text);
        prop_assert_eq!(read.as_ref(), Ok(&slices), "{}", String::from_utf8_lossy(&text));
    }

    #[test]
    fn facts_are_taken_as_they_were_stated(facts in facts()) {
        let mut taken = Facts::default();
        for (tag, value) in facts.tags() {
            prop_assert_eq!(taken.take(tag, &value), Ok(true), "{} = {}", tag, value);
        }
        prop_assert_eq!(&taken, &facts);
        let mut skein = Skein::from_lines([Line::Close(Tag::ExtruderInitialization)]);
        skein.state(&facts).expect("facts can stand in a header");
        let again = Skein::read(&skein.write()).expect("a skein");
        prop_assert_eq!(again.facts(), Ok(facts));
    }
}

/// The canonical form of a number is read back, is short, and holds nothing that a simple controller cannot read.
fn number_law<T>(value: T, places: u32) -> Result<(), TestCaseError>
where
    T: Copy + PartialEq + Debug + Display + FromStr,
    T::Err: Debug + PartialEq,
{
    let text = value.to_string();
    prop_assert_eq!(text.parse::<T>(), Ok(value), "{}", text);
    prop_assert!(text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.' || byte == b'-'), "{}", text);
    let (_, decimals) = text.split_once('.').expect("always a decimal point");
    prop_assert!((1..=places as usize).contains(&decimals.len()), "{}", text);
    prop_assert!(decimals.len() == 1 || !decimals.ends_with('0'), "{}", text);
    prop_assert!(text != "-0.0");
    Ok(())
}

// Profiles.

/// Every key that holds numbers, with its bounds.
fn numbers() -> Vec<(String, Field)> {
    let stages = clayforge::STAGES.iter().map(|entry| (entry.name, entry.fields()));
    let sections = stages.chain([("machine", <skein::Machine as Settings>::fields())]);
    let keys = sections.flat_map(|(section, fields)| {
        fields.into_iter().map(move |field| (format!("{section}.{}", field.name), field))
    });
    keys.filter(|(_, field)| matches!(field.kind, Kind::Number | Kind::Count)).collect()
}

#[test]
fn nonsense_is_refused_by_every_setting_with_its_name() {
    let mut profile = Profile::default();
    for (key, field) in numbers() {
        let beyond = [field.min.map(|min| min - 1.0), field.max.map(|max| max + 1.0)];
        let beyond = beyond.into_iter().flatten().map(|number| number.to_string());
        for value in ["nan", "inf", "-inf", "1e308", "\"two\"", "true", "[1]", "{ a = 1 }", ""]
            .map(str::to_owned)
            .into_iter()
            .chain(beyond)
        {
            let error = profile.set(&key, &value).expect_err(&format!("{key} = {value}"));
            assert!(
                error.to_string().contains(&key) && error.hint.is_some(),
                "{key} = {value}: {error} {:?}",
                error.hint
            );
        }
        let mistyped = format!("{key}x");
        let error = profile.set(&mistyped, "1").expect_err(&mistyped);
        assert!(
            error.hint.as_deref().is_some_and(|hint| hint.contains(&key)),
            "{mistyped}: {:?}",
            error.hint
        );
    }
    assert_eq!(profile, Profile::default());
}

#[test]
fn a_profile_that_is_shown_reads_back_with_every_setting_at_its_bounds() {
    for (key, field) in numbers() {
        for bound in [field.min, field.max].into_iter().flatten() {
            let mut profile = Profile::default();
            profile.set(&key, &bound.to_string()).unwrap_or_else(|error| panic!("{error}"));
            let shown = Source { name: "shown".to_owned(), text: profile.show() };
            let read = Profile::read(shown, &only_built_in)
                .unwrap_or_else(|error| panic!("{key} = {bound}: {error}"));
            assert_eq!(read, profile, "{key} = {bound}");
        }
    }
}

// The format examples.

fn read(text: &str) -> Line {
    Reader::default().line(text.as_bytes()).unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[test]
fn f1_a_layer_tag_has_its_height_as_second_word() {
    assert_eq!(read("(<layer> 0.2 )"), Line::Layer(Micron(200)));
}

#[test]
fn f2_remarks_behind_a_move_are_no_words() {
    let step = read("G1 X1.0 Y2.0 Z0.5 (note) ;x");
    assert_eq!(step, Line::Move(Move::to(Point3 { x: 1000, y: 2000, z: 500 })));
}

#[test]
fn f3_a_boundary_point_has_its_place_although_it_starts_with_a_bracket() {
    let line = read("(<boundaryPoint> X1.0 Y2.0 Z0.2 </boundaryPoint>)");
    assert_eq!(line, Line::Point(Mark::Boundary, Point3 { x: 1000, y: 2000, z: 200 }));
}

#[test]
fn f4_a_move_keeps_the_axes_that_it_leaves_out() {
    let mut reader = Reader::default();
    reader.line(b"G1 X1.0 Y2.0 Z0.2 F960.0").expect("a move");
    let line = reader.line(b"G1 X5.0").expect("a move");
    assert_eq!(line, Line::Move(Move::to(Point3 { x: 5000, y: 2000, z: 200 })));
}

#[test]
fn f5_a_number_has_a_point_and_no_exponent() {
    assert_eq!(Micron::from_mm(2.0).expect("short").to_string(), "2.0");
    assert_eq!(Micron::from_mm(0.00001).expect("short").to_string(), "0.0");
    assert_eq!(Micron::from_mm(-0.00001).expect("short").to_string(), "0.0");
    assert_eq!(Micron::from_mm(f64::NAN), None);
}
