use crate::{Raft, SupportChoice, boundary};
use shape::plane::boolean::common;
use shape::plane::offset;
use skein::{Angle, Feature, Line, Micron, Notes, Nozzle, Point, Ratio, Ring, Skein, Stage};

/// What the rows of the acceptance list have in common: h 0.4, w 0.72, 16 mm/s.
const FINE: &str = "(<layerHeight> 0.4 </layerHeight>)\n(<beadSection> rectangle </beadSection>)\n\
                    (<operatingFeedRatePerSecond> 16.0 </operatingFeedRatePerSecond>)\n\
                    (<travelFeedRatePerSecond> 20.0 </travelFeedRatePerSecond>)\n\
                    (<orbitalFeedRatePerSecond> 8.0 </orbitalFeedRatePerSecond>)\n\
                    (<edgeWidth> 0.72 </edgeWidth>)\n";

/// Boxes of a layer: least and greatest x and y in mm; a box with the corners the other way round is a hole.
type Boxes<'a> = &'a [[f64; 4]];

fn ring(&[left, front, right, back]: &[f64; 4]) -> Ring {
    let point = |x: f64, y: f64| Point::new((x * 1000.0).round() as i32, (y * 1000.0).round() as i32);
    Ring(vec![point(left, front), point(right, front), point(right, back), point(left, back)])
}

/// A hole in place of a box.
fn hole([left, front, right, back]: [f64; 4]) -> [f64; 4] {
    [right, front, left, back]
}

/// A skein of layers of boxes, each with a bead along its outline.
fn skein(facts: &str, layers: &[Boxes<'_>]) -> Skein {
    let mut text = format!("(<extruderInitialization>)\n{facts}(</extruderInitialization>)\n(<crafting>)\n");
    for (index, boxes) in layers.iter().enumerate() {
        let z = 0.4 * index as f64 + 0.2;
        text.push_str(&format!("(<layer> {z:.1} )\n"));
        for rectangle in *boxes {
            text.push_str("(<nestedRing>)\n(<boundaryPerimeter>)\n");
            let corners: Vec<String> = ring(rectangle)
                .0
                .iter()
                .map(|point| format!("X{} Y{}", Micron(point.x), Micron(point.y)))
                .collect();
            for corner in &corners {
                text.push_str(&format!("(<boundaryPoint> {corner} Z{z:.1} </boundaryPoint>)\n"));
            }
            text.push_str("(</boundaryPerimeter>)\n(<edge> outer )\n");
            let z = z + 0.2;
            text.push_str(&format!("G1 {} Z{z:.1} F1200.0\nM101\n", corners[0]));
            for (index, corner) in corners[1..].iter().chain(&corners[..1]).enumerate() {
                let feed = if index == 0 { " F960.0" } else { "" };
                text.push_str(&format!("G1 {corner} Z{z:.1}{feed}\n"));
            }
            text.push_str("M103\n(</edge>)\n(<infill>)\n(</infill>)\n(</nestedRing>)\n");
        }
        text.push_str("(</layer>)\n");
    }
    text.push_str("(</crafting>)\nM103\n");
    Skein::read(text.as_bytes()).expect("a skein")
}

fn craft_with(raft: &Raft, skein: Skein) -> (Skein, Notes) {
    let mut notes = Notes::default();
    let made = raft.craft(skein, &mut notes).expect("raft");
    made.verify().expect("lawful");
    assert_eq!(Skein::read(&made.write()).as_ref(), Ok(&made), "reading undoes writing");
    (made, notes)
}

fn craft(raft: &Raft, skein: Skein) -> Skein {
    craft_with(raft, skein).0
}

fn ratio(value: f64) -> Ratio {
    Ratio::from_f64(value).expect("a ratio")
}

/// The raft of 2010.
fn late() -> Raft {
    Raft {
        base_layers: 1,
        base_thickness: ratio(2.0),
        base_feed: ratio(1.0),
        base_nozzle_lift: ratio(0.4),
        interface_layers: 2,
        interface_density: ratio(0.5),
        interface_nozzle_lift: ratio(0.45),
        margin: ratio(3.0 / 0.72),
        ..Raft::default()
    }
}

/// Its support: columns that reach 3.24 mm beyond what they hold, with middles 1.44 mm from the wall.
fn support(choice: SupportChoice) -> Raft {
    Raft {
        base_layers: 0,
        support: choice,
        support_minimum_angle: Angle(60_000),
        support_gap: ratio(1.5),
        support_margin: ratio(4.5),
        support_base_layers: 0,
        ..Raft::default()
    }
}

const CUBE: Boxes<'static> = &[[0.0, 0.0, 20.0, 20.0]];
const STEM: Boxes<'static> = &[[-5.0, -5.0, 5.0, 5.0]];
const CAP: Boxes<'static> = &[[-12.0, -12.0, 12.0, 12.0]];

/// A square column up to 6 mm, and a cap on it up to 10 mm.
fn mushroom() -> Vec<Boxes<'static>> {
    [vec![STEM; 15], vec![CAP; 10]].concat()
}

/// The moves of one kind of bead on a layer, as from and to in mm, with height.
fn beads(lines: &[Line], wanted: Feature) -> Vec<[f64; 5]> {
    let mut nozzle = Nozzle::default();
    let mut beads = Vec::new();
    for line in lines {
        let from = nozzle.at;
        nozzle.follow(line);
        if let (true, Some(from), Some(step)) =
            (nozzle.on && nozzle.feature() == wanted, from, line.as_move())
        {
            let mm = |microns: i32| Micron(microns).mm();
            beads.push([mm(from.x), mm(from.y), mm(step.to.x), mm(step.to.y), mm(step.to.z)]);
        }
    }
    beads
}

/// The rows of a zig-zag along x: y, least x and greatest x.
fn rows(beads: &[[f64; 5]]) -> Vec<(f64, f64, f64)> {
    let mut rows: Vec<(f64, f64, f64)> = beads
        .iter()
        .filter(|bead| bead[1] == bead[3])
        .map(|bead| (bead[1], bead[0].min(bead[2]), bead[0].max(bead[2])))
        .collect();
    rows.sort_by(|one, other| one.partial_cmp(other).expect("numbers"));
    rows
}

fn heights(skein: &Skein) -> Vec<f64> {
    let first = |lines: &[Line]| lines.iter().find_map(Line::as_move).map(|step| Micron(step.to.z).mm());
    skein.layers.iter().filter_map(|layer| first(&layer.lines)).collect()
}

fn close(one: f64, other: f64) -> bool {
    (one - other).abs() < 0.0101
}

#[test]
fn r1_the_heights_of_base_interface_and_part() {
    let made = craft(&late(), skein(FINE, &[CUBE, CUBE]));
    assert_eq!(heights(&made), [0.72, 1.18, 1.58, 2.0, 2.4]);
    // What a layer says of itself agrees with where it lies.
    let facts = made.facts().expect("facts");
    let tops: Vec<f64> =
        made.layers.iter().map(|layer| layer.nozzle_z(&facts).expect("a height").mm()).collect();
    assert_eq!(tops, [0.8, 1.2, 1.6, 2.0, 2.4]);
}

#[test]
fn r2_the_base_is_thick_and_slow_and_runs_along_y() {
    let made = craft(&late(), skein(FINE, &[CUBE]));
    let lines = &made.layers[0].lines;
    let beads = beads(lines, Feature::Raft);
    let mut columns: Vec<f64> = beads.iter().filter(|bead| bead[0] == bead[2]).map(|bead| bead[0]).collect();
    columns.sort_by(f64::total_cmp);
    columns.dedup();
    // Rows 2.88 apart as near as fits the 24.96 mm between the outermost middles: nine steps of 2.773.
    assert!(columns.windows(2).all(|pair| (pair[1] - pair[0] - 24.96 / 9.0).abs() < 0.002), "{columns:?}");
    // The clay reaches 3.2 mm beyond the part; a middle is half of 1.44 mm inside.
    let ends = |index: usize| {
        let all = || beads.iter().flat_map(move |bead| [bead[index], bead[index + 2]]);
        (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max))
    };
    for (low, high) in [ends(0), ends(1)] {
        assert!(close(low, -2.48) && close(high, 22.48), "{low} {high}");
    }
    let feeds: Vec<u32> =
        lines.iter().filter_map(Line::as_move).filter_map(|step| step.feed).map(|feed| feed.get()).collect();
    assert_eq!(feeds, [1_200_000, 240_000]);
    // 1.44 × 0.8 is twice 0.72 × 0.8; around the beads, not before them (D28).
    let flows: Vec<Line> =
        lines.iter().filter(|line| matches!(line, Line::Flow(_) | Line::On)).cloned().collect();
    assert_eq!(flows, [Line::Flow(ratio(2.0)), Line::On, Line::Flow(Ratio::ONE)]);
}

#[test]
fn r3_the_interface_crosses_it() {
    let made = craft(&late(), skein(FINE, &[CUBE]));
    let lines = &made.layers[1].lines;
    let rows = rows(&beads(lines, Feature::Raft));
    // 1.44 apart as near as fits 25.68 mm: eighteen steps.
    assert!(rows.windows(2).all(|pair| (pair[1].0 - pair[0].0 - 25.68 / 18.0).abs() < 0.002), "{rows:?}");
    assert!(rows.iter().all(|(_, left, right)| close(*left, -2.84) && close(*right, 22.84)), "{rows:?}");
    let feeds: Vec<u32> =
        lines.iter().filter_map(Line::as_move).filter_map(|step| step.feed).map(|feed| feed.get()).collect();
    assert_eq!(feeds, [1_200_000, 960_000]);
    assert!(!lines.iter().any(|line| matches!(line, Line::Flow(_) | Line::Thickness(_))));
    // The second crosses the first.
    let next = beads(&made.layers[2].lines, Feature::Raft);
    assert!(next.iter().filter(|bead| bead[0] == bead[2]).count() > next.len() / 3);
}

#[test]
fn r4_the_outset_grows_with_the_part() {
    assert!((late().outset(Micron(720), 20_000.0) - 3200.0).abs() < 0.01);
}

const HOT: &str = "(<heaters> nozzle </heaters>)\n(<coolingRate> 3.0 </coolingRate>)\n\
                   (<heatingRate> 10.0 </heatingRate>)\n(<baseTemperature> 200.0 </baseTemperature>)\n\
                   (<interfaceTemperature> 200.0 </interfaceTemperature>)\n\
                   (<objectFirstLayerInfillTemperature> 195.0 </objectFirstLayerInfillTemperature>)\n\
                   (<objectFirstLayerPerimeterTemperature> 220.0 </objectFirstLayerPerimeterTemperature>)\n\
                   (<objectNextLayersTemperature> 230.0 </objectNextLayersTemperature>)\n\
                   (<supportLayersTemperature> 205.0 </supportLayersTemperature>)\n\
                   (<supportedLayersTemperature> 235.0 </supportedLayersTemperature>)\n";

fn temperatures(lines: &[Line]) -> Vec<&str> {
    lines
        .iter()
        .filter_map(|line| match line {
            Line::Verbatim(text) => text.strip_prefix("M104 S"),
            _ => None,
        })
        .collect()
}

#[test]
fn r5_temperatures_in_order() {
    let made = craft(&late(), skein(&format!("{FINE}{HOT}"), &[CUBE, CUBE, CUBE]));
    let all: Vec<&str> = made.layers.iter().flat_map(|layer| temperatures(&layer.lines)).collect();
    assert_eq!(all, ["200.0", "220.0", "195.0", "230.0"]);
    // 25 to 200 °C at 10 °C a second takes 17.5 s: at 8 mm/s 140 mm around the raft before it begins.
    let before = made.layers[0].lines.split(|line| *line == Line::On).next().expect("lines");
    let orbit: Vec<_> = before.iter().filter_map(Line::as_move).collect();
    let way: f64 = orbit.windows(2).take(orbit.len() - 2).map(|pair| pair[1].length(pair[0].to)).sum();
    assert!((140_000.0..175_000.0).contains(&way), "{way}");
    assert_eq!(orbit[0].feed.map(|feed| feed.get()), Some(480_000));
}

#[test]
fn r5_before_support_its_temperature_and_behind_it_that_of_supported_layers() {
    let hot = skein(&format!("{FINE}{HOT}"), &mushroom());
    let made = craft(&support(SupportChoice::Everywhere), hot);
    assert_eq!(temperatures(&made.layers[3].lines), ["205.0", "235.0"]);
    assert_eq!(temperatures(&made.layers[0].lines), ["205.0", "220.0", "195.0"]);
    // No support on the cap, so the next layers' own.
    assert_eq!(temperatures(&made.layers[15].lines), ["230.0"]);
    assert!(temperatures(&made.layers[16].lines).is_empty());
}

#[test]
fn a_machine_without_a_hot_nozzle_hears_no_temperature() {
    let cold = HOT.replace("<heaters> nozzle", "<heaters> bed chamber");
    let made = craft(&late(), skein(&format!("{FINE}{cold}"), &mushroom()));
    assert!(made.lines().all(|line| !matches!(line, Line::Verbatim(text) if text.starts_with("M1"))));
}

#[test]
fn r6_without_layers_of_a_raft_nothing_changes() {
    let plain = skein(FINE, &[CUBE, CUBE]);
    let none = Raft { base_layers: 0, ..Raft::default() };
    assert_eq!(craft(&none, plain.clone()), plain);
    // Nor does it need to know the speed.
    let still = skein("(<layerHeight> 0.4 </layerHeight>)\n", &[CUBE]);
    assert_eq!(craft(&none, still.clone()), still);
}

#[test]
fn the_lift_of_the_part_raises_it_all() {
    let lifted = Raft { object_nozzle_lift: ratio(1.0), ..late() };
    let made = craft(&lifted, skein(FINE, &[CUBE, CUBE]));
    assert_eq!(heights(&made)[3..], [2.2, 2.6]);
    assert_eq!(made.layers[3].z(), Micron(2000));
}

#[test]
fn r7_a_cap_stands_on_zigzags_beside_its_stem() {
    let made = craft(&support(SupportChoice::Everywhere), skein(FINE, &mushroom()));
    for layer in &made.layers[..15] {
        let rows = rows(&beads(&layer.lines, Feature::Support));
        // 0.72 / 0.5 apart, on the same lines on every layer.
        assert!(rows.iter().all(|(y, ..)| close((y / 1.44).round() * 1.44, *y)), "{rows:?}");
        let (first, last) = (rows[0].0, rows[rows.len() - 1].0);
        assert!(first <= -11.52 && last >= 11.52 && first >= -15.25, "{first} {last}");
        for (y, left, right) in rows {
            if y.abs() < 6.44 {
                let beside = if left < 0.0 { (left, right) } else { (-right, -left) };
                assert!(close(beside.0, -15.24) && close(beside.1, -6.44), "{y}: {left} {right}");
            } else {
                assert!(close(left, -15.24) && close(right, 15.24), "{y}: {left} {right}");
            }
        }
    }
    for layer in &made.layers[15..] {
        assert!(beads(&layer.lines, Feature::Support).is_empty());
    }
}

#[test]
fn r8_over_nothing_but_the_bed_exterior_only_is_the_same() {
    let of = |choice| craft(&support(choice), skein(FINE, &mushroom()));
    let (everywhere, exterior) = (of(SupportChoice::Everywhere), of(SupportChoice::ExteriorOnly));
    let length = |skein: &Skein| -> f64 {
        let all = skein.layers.iter().flat_map(|layer| beads(&layer.lines, Feature::Support));
        all.map(|bead| (bead[2] - bead[0]).hypot(bead[3] - bead[1])).sum()
    };
    assert!(length(&everywhere) > 0.0);
    assert!((length(&everywhere) - length(&exterior)).abs() < 1.0);
}

#[test]
fn r9_a_recess_under_a_plate_is_filled_everywhere_but_not_from_outside() {
    let block: Boxes<'_> = &[[-20.0, -20.0, 20.0, 20.0]];
    let walls: Boxes<'_> = &[[-20.0, -20.0, 20.0, 20.0], hole([-10.0, -10.0, 10.0, 10.0])];
    let table = [vec![block; 5], vec![walls; 5], vec![block; 3]].concat();
    let beads_of = |choice| -> Vec<usize> {
        let made = craft(&support(choice), skein(FINE, &table));
        made.layers.iter().map(|layer| beads(&layer.lines, Feature::Support).len()).collect()
    };
    let everywhere = beads_of(SupportChoice::Everywhere);
    assert!(everywhere.iter().enumerate().all(|(index, count)| (5..10).contains(&index) == (*count > 0)));
    assert!(beads_of(SupportChoice::ExteriorOnly).iter().all(|count| *count == 0));
}

#[test]
fn r10_a_leaning_wall_is_held_when_it_leans_more_than_the_angle() {
    // 0.4 mm farther on every layer of 0.4 mm: 45°.
    let lean: Vec<[[f64; 4]; 1]> =
        (0..20).map(|step| [[0.4 * f64::from(step), 0.0, 10.0 + 0.4 * f64::from(step), 10.0]]).collect();
    let layers: Vec<Boxes<'_>> = lean.iter().map(|boxes| &boxes[..]).collect();
    let count = |degrees| {
        let raft = Raft { support_minimum_angle: Angle(degrees), ..support(SupportChoice::Everywhere) };
        let made = craft(&raft, skein(FINE, &layers));
        made.layers.iter().map(|layer| beads(&layer.lines, Feature::Support).len()).sum::<usize>()
    };
    assert_eq!(count(60_000), 0);
    assert_eq!(count(45_000), 0);
    assert!(count(30_000) > 0);
}

#[test]
fn r11_support_never_comes_nearer_to_a_wall_than_its_gap() {
    for (x, y) in [(0.0, 0.0), (100.0, 37.0), (-63.217, 0.411)] {
        let moved = |boxes: Boxes<'_>| -> Vec<[f64; 4]> {
            boxes
                .iter()
                .map(|[left, front, right, back]| [left + x, front + y, right + x, back + y])
                .collect()
        };
        let layers: Vec<Vec<[f64; 4]>> = mushroom().into_iter().map(moved).collect();
        let layers: Vec<Boxes<'_>> = layers.iter().map(|boxes| &boxes[..]).collect();
        for hatch in [false, true] {
            let raft = Raft { support_cross_hatch: hatch, ..support(SupportChoice::Everywhere) };
            let made = craft(&raft, skein(FINE, &layers));
            for layer in &made.layers {
                // A micron or two for the rounding of the middles.
                let guard = offset(&boundary(&layer.lines), 1437.0);
                for bead in beads(&layer.lines, Feature::Support) {
                    let inside = |x: f64, y: f64| {
                        let point = Point::new((x * 1000.0).round() as i32, (y * 1000.0).round() as i32);
                        guard.iter().filter(|ring| ring.contains(point)).count() % 2 == 1
                    };
                    let along = (0..=8).map(|step| f64::from(step) / 8.0);
                    for share in along {
                        let x = bead[0] + (bead[2] - bead[0]) * share;
                        let y = bead[1] + (bead[3] - bead[1]) * share;
                        assert!(!inside(x, y), "{bead:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn r12_without_speed_the_error_names_the_rate() {
    let facts = FINE.replace("operatingFeed", "otherFeed");
    let refused = Raft::default().craft(skein(&facts, &[CUBE]), &mut Notes::default()).expect_err("refused");
    assert!(refused.message.contains("operatingFeedRatePerSecond"), "{refused}");
    assert!(refused.hint.as_deref().is_some_and(|hint| hint.contains("speed")), "{refused:?}");
}

#[test]
fn empty_layers_between_two_that_are_not_get_what_these_have_in_common() {
    let other: Boxes<'_> = &[[5.0, 0.0, 30.0, 20.0]];
    let layers: Vec<Boxes<'_>> = vec![&[], CUBE, &[], &[], other, &[]];
    let made = craft(&support(SupportChoice::EmptyLayersOnly), skein(FINE, &layers));
    let count: Vec<bool> =
        made.layers.iter().map(|layer| !beads(&layer.lines, Feature::Support).is_empty()).collect();
    assert_eq!(count, [false, false, true, true, false, false]);
    for (_, left, right) in rows(&beads(&made.layers[2].lines, Feature::Support)) {
        // Both shrunk by a quarter of a bead.
        assert!(close(left, 5.18) && close(right, 19.82), "{left} {right}");
    }
}

#[test]
fn growing_does_not_lead_through_a_thin_wall() {
    // A cup that becomes wider by 2 mm at once; its wall is 1 mm thick, support reaches 3.24 mm.
    let narrow: Boxes<'_> = &[[-10.0, -10.0, 10.0, 10.0], hole([-9.0, -9.0, 9.0, 9.0])];
    let wide: Boxes<'_> = &[[-12.0, -12.0, 12.0, 12.0], hole([-9.0, -9.0, 9.0, 9.0])];
    let layers = [vec![narrow; 4], vec![wide; 2]].concat();
    let made = craft(&support(SupportChoice::Everywhere), skein(FINE, &layers));
    let beads = beads(&made.layers[0].lines, Feature::Support);
    assert!(!beads.is_empty());
    assert!(beads.iter().all(|bead| bead[0].abs() > 10.0 || bead[1].abs() > 10.0), "{beads:?}");
}

#[test]
fn the_lowest_and_the_highest_layers_of_support_can_be_denser() {
    let raft = Raft {
        support_base_layers: 2,
        support_interface_layers: 3,
        support_density: ratio(0.25),
        interface_density: ratio(1.0),
        ..support(SupportChoice::Everywhere)
    };
    let made = craft(&raft, skein(FINE, &mushroom()));
    let lengths: Vec<f64> = made.layers[..15]
        .iter()
        .map(|layer| {
            rows(&beads(&layer.lines, Feature::Support)).iter().map(|(_, left, right)| right - left).sum()
        })
        .collect();
    for (index, length) in lengths.iter().enumerate() {
        let dense = !(2..12).contains(&index);
        assert_eq!(*length > 2.0 * lengths[5], dense, "{index}: {lengths:?}");
    }
}

#[test]
fn what_stands_at_the_edge_of_the_bed_stays_on_it() {
    let facts = format!("{FINE}(<bed> rectangle 0.0 0.0 20.5 40.0 </bed>)\n");
    let (made, notes) = craft_with(&late(), skein(&facts, &[CUBE]));
    assert!(notes.summary()[0].contains("cut off where the bed ends"), "{:?}", notes.summary());
    for bead in made.layers.iter().flat_map(|layer| beads(&layer.lines, Feature::Raft)) {
        let on_bed = |x: f64, y: f64| (0.36..=20.14).contains(&x) && (0.36..=39.64).contains(&y);
        assert!(on_bed(bead[0], bead[1]) && on_bed(bead[2], bead[3]), "{bead:?}");
    }
}

#[test]
fn moves_keep_their_speed_and_lines_of_the_potter_stand_around_support() {
    let raft = Raft {
        support_start: "M42 P1 S1\n\nM117 support".to_owned(),
        support_end: "M42 P1 S0".to_owned(),
        support_flow: ratio(0.8),
        ..support(SupportChoice::Everywhere)
    };
    let before = skein(FINE, &mushroom());
    let made = craft(&raft, before.clone());
    let pasted = |line: &Line| matches!(line, Line::Pasted(_));
    assert_eq!(made.layers[3].lines.iter().filter(|line| pasted(line)).count(), 3);
    assert!(!made.layers[20].lines.iter().any(pasted));
    // Speed and flow of every bead of the part are what they were.
    let seen = |skein: &Skein| -> Vec<(u32, Ratio)> {
        let mut nozzle = Nozzle::default();
        let mut seen = Vec::new();
        for line in skein.lines() {
            nozzle.follow(line);
            if line.as_move().is_some() && nozzle.on && nozzle.feature() != Feature::Support {
                seen.push((nozzle.feed.expect("a feed").get(), nozzle.flow));
            }
        }
        seen
    };
    assert_eq!(seen(&before), seen(&made));
}

#[test]
fn a_part_of_nothing_and_a_first_layer_of_nothing_pass() {
    let empty = skein(FINE, &[]);
    assert_eq!(craft(&late(), empty.clone()), empty);
    let (made, notes) = craft_with(&late(), skein(FINE, &[&[], CUBE]));
    assert_eq!(made.layers.len(), 2);
    assert!(notes.summary()[0].contains("the first layer is empty"));
    // With support under the part that hangs there is something to stand on.
    let (made, _) =
        craft_with(&Raft { support: SupportChoice::Everywhere, ..late() }, skein(FINE, &[&[], CUBE]));
    assert_eq!(made.layers.len(), 5);
}

#[test]
fn the_number_of_cores_changes_nothing() {
    let on = |cores| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(cores).build().expect("a pool");
        let raft = Raft { support: SupportChoice::ExteriorOnly, ..late() };
        pool.install(|| craft(&raft, skein(FINE, &mushroom())))
    };
    assert_eq!(on(1), on(5));
}

#[test]
fn the_booleans_of_support_are_exact() {
    let both = common(&[ring(&[0.0, 0.0, 10.0, 10.0])], &[ring(&[5.0, -5.0, 20.0, 5.0])]);
    assert_eq!(both.iter().map(Ring::area).sum::<f64>(), 25.0);
}
