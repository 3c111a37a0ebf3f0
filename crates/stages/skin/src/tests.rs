use super::*;
use skein::{Facts, Micron, Section};

const SQUARE: [(f64, f64); 4] = [(0.36, 0.36), (19.64, 0.36), (19.64, 19.64), (0.36, 19.64)];

fn lay(points: &[(f64, f64)], z: f64) -> String {
    let mut text = String::new();
    for (index, (x, y)) in points.iter().enumerate() {
        text += &format!("G1 X{x} Y{y} Z{z}{}\n", if index == 0 { " F1200" } else { " F960" });
        text += if index == 0 { "M101\n" } else { "" };
    }
    text + "M103\n"
}

/// Layers of an edge, a loop and an infill on each of two islands, h = 0.4 and w = 0.72.
fn print(layers: u32) -> Skein {
    let closed = |by: f64, x: f64| -> Vec<_> {
        let corner = |at: f64| if at < 10.0 { at + by } else { at - by };
        SQUARE.iter().chain(&SQUARE[..1]).map(|(a, b)| (corner(*a) + x, corner(*b))).collect()
    };
    let mut text = String::from("(</extruderInitialization>)\n");
    for layer in 1..=layers {
        let z = f64::from(layer * 2) / 5.0 - 0.2;
        text += &format!("(<layer> {z:.1} )\n");
        for x in [0.0, 40.0] {
            text += &format!(
                "(<nestedRing>)\n(<loop> outer )\n{}(</loop>)\n(<edge> outer )\n{}(</edge>)\n(<infill>)\n{}(</infill>)\n(</nestedRing>)\n",
                lay(&closed(0.72, x), z),
                lay(&closed(0.0, x), z),
                lay(&[(2.0 + x, 2.0), (18.0 + x, 2.0), (18.0 + x, 2.72), (2.0 + x, 2.72)], z)
            );
        }
        text += "(</layer>)\n";
    }
    let mut skein = Skein::read(text.as_bytes()).expect("a skein");
    let facts = Facts {
        bead_width: Some(Micron(720)),
        layer_height: Some(Micron(400)),
        infill_width: Some(Micron(720)),
        bead_section: Some(Section::Rectangle),
        ..Facts::default()
    };
    skein.state(&facts).expect("facts");
    skein
}

fn craft(stage: &Skin, skein: Skein) -> Skein {
    let skein = stage.craft(skein, &mut Notes::default()).expect("skin");
    assert_eq!(skein.verify(), Ok(()));
    skein
}

/// A bead: what for, at what height, with what flow, its length in microns and where it starts.
type Laid = (Feature, i32, i32, f64, (i32, i32));

/// Every bead of a layer.
fn beads(skein: &Skein, layer: usize) -> Vec<Laid> {
    let mut nozzle = skein.nozzles()[layer];
    let mut beads = Vec::new();
    for span in spans(&skein.layers[layer].lines, false) {
        if let Span::Thread(lines) = span {
            let thread = Thread::read(lines, &nozzle).expect("a thread");
            let flow = thread.stretches[0].flow.0;
            let start = (thread.start.x, thread.start.y);
            beads.push((nozzle.feature(), thread.start.z, flow, thread.length(), start));
        }
        span.lines().iter().for_each(|line| nozzle.follow(line));
    }
    beads
}

fn clay(skein: &Skein, layer: usize) -> f64 {
    beads(skein, layer).iter().map(|(_, _, flow, length, _)| f64::from(*flow) * length).sum()
}

/// stages_tests.md SN1: half the flow at each of two heights; the start is cut by a quarter of a width.
#[test]
fn sn1_a_wall_in_two_heights() {
    let stage = Skin { clip_over_bead_width: Ratio(250_000), ..Skin::default() };
    let done = craft(&stage, print(3));
    let edges: Vec<_> =
        beads(&done, 1).into_iter().filter(|bead| matches!(bead.0, Feature::Edge(_))).collect();
    assert_eq!(edges.iter().map(|bead| bead.1).collect::<Vec<_>>(), [400, 400, 600, 600]);
    assert!(edges.iter().all(|bead| bead.2 == 500_000));
    assert_eq!(edges[0].4, (540, 360));
    // The lowest layer stays.
    assert_eq!(done.layers[0], print(3).layers[0]);
}

/// stages_tests.md SN2.
#[test]
fn sn2_infill_only_on_the_topmost_layer() {
    let done = craft(&Skin::default(), print(3));
    let infills = |layer| beads(&done, layer).iter().filter(|bead| bead.0 == Feature::Infill).count();
    assert_eq!([infills(0), infills(1), infills(2)], [2, 2, 4]);
}

#[test]
fn what_lies_lower_comes_first() {
    let done = craft(&Skin::default(), print(2));
    let heights: Vec<i32> = beads(&done, 1).iter().map(|bead| bead.1).collect();
    assert_eq!(heights, [400, 400, 400, 400, 600, 600, 600, 600, 600, 600]);
}

#[test]
fn the_clay_of_every_layer_stays() {
    for vertical in 1..=3 {
        for horizontal in 1..=3 {
            let stage = Skin {
                vertical_wall_divisions: vertical,
                horizontal_wall_divisions: horizontal,
                vertical_infill_divisions: vertical,
                horizontal_infill_divisions: horizontal,
                ..Skin::default()
            };
            let done = craft(&stage, print(3));
            for layer in 0..3 {
                let (before, after) = (clay(&print(3), layer), clay(&done, layer));
                assert!((before - after).abs() < 1e-4 * before, "{vertical} {horizontal}: {before} {after}");
            }
        }
    }
}

#[test]
fn walls_side_by_side_keep_their_places_and_their_sense() {
    let stage = Skin { vertical_wall_divisions: 1, horizontal_wall_divisions: 2, ..Skin::default() };
    let done = craft(&stage, print(2));
    let edges: Vec<_> =
        beads(&done, 1).into_iter().filter(|bead| matches!(bead.0, Feature::Edge(_))).collect();
    assert_eq!(edges.iter().map(|bead| bead.4).collect::<Vec<_>>()[..2], [(540, 540), (180, 180)]);
}

/// The infill beads of the topmost layer of a print of two.
fn top_infill(stage: &Skin) -> Vec<Thread> {
    let done = craft(stage, print(2));
    let mut nozzle = done.nozzles()[1];
    let mut threads = Vec::new();
    for span in spans(&done.layers[1].lines, false) {
        if let (Span::Thread(lines), Feature::Infill) = (span, nozzle.feature()) {
            threads.push(Thread::read(lines, &nozzle).expect("a thread"));
        }
        span.lines().iter().for_each(|line| nozzle.follow(line));
    }
    threads
}

#[test]
fn infill_side_by_side_goes_there_and_back_around_where_it_lay() {
    let stage = |horizontal| Skin {
        vertical_wall_divisions: 1,
        vertical_infill_divisions: 1,
        horizontal_infill_divisions: horizontal,
        ..Skin::default()
    };
    // Two rows 0.72 apart become four, 0.36 apart, and of three the one in the middle stays.
    for (count, threads, heights) in
        [(2, 2, vec![1820, 2180, 2540, 2900]), (3, 4, vec![1760, 2000, 2240, 2480, 2720, 2960])]
    {
        let infill = top_infill(&stage(count));
        assert_eq!(infill.len(), threads);
        let mut rows: Vec<i32> = Vec::new();
        for (from, piece) in infill.iter().flat_map(Thread::pieces) {
            let to = piece.step.to;
            if from.y == to.y && (from.x - to.x).abs() > 14_000 {
                rows.push(from.y);
            }
            assert!(from.x.min(to.x) >= 2000 && from.x % 40_000 <= 18_000 + 720, "{from:?}");
        }
        rows.sort_unstable();
        rows.dedup();
        assert!(heights.iter().all(|height| rows.contains(height)), "{rows:?}");
        let flow = infill[0].stretches[0].flow.f64();
        assert!((flow * f64::from(count) - 1.0).abs() < 0.1, "{flow}");
    }
}

#[test]
fn what_is_too_short_for_beads_side_by_side_stays_and_is_said() {
    let text = String::from_utf8(print(1).write()).expect("text");
    let cut = text.find("(<infill>)").expect("an infill");
    let short = "(<infill>)\nG1 X2 Y2 Z0.4 F1200\nM101\nG1 X2.2 Y2 Z0.4 F960\nM103\n(</infill>)\n(</nestedRing>)\n(</layer>)\n";
    let skein = Skein::read(format!("{}{short}", &text[..cut]).as_bytes()).expect("a skein");
    let stage = Skin {
        layers_from: 0,
        vertical_wall_divisions: 1,
        vertical_infill_divisions: 1,
        horizontal_infill_divisions: 2,
        ..Skin::default()
    };
    let mut notes = Notes::default();
    assert_eq!(beads(&stage.craft(skein.clone(), &mut notes).expect("skin"), 0), beads(&skein, 0));
    assert!(!notes.is_empty());
}

#[test]
fn the_way_to_lower_infill_can_lead_over_the_layer() {
    let highest_travels = |hop| {
        let stage = Skin { hop_when_extruding_infill: hop, ..Skin::default() };
        let done = craft(&stage, print(2));
        let mut was = done.nozzles()[1];
        let mut lower = Vec::new();
        for line in &done.layers[1].lines {
            let before = was;
            was.follow(line);
            if let (false, Some(from), Some(to)) = (was.on, before.at, line.as_move().map(|step| step.to))
                && to.z == 400
                && was.feature() == Feature::Infill
            {
                lower.push((from.z, from.x != to.x || from.y != to.y));
            }
        }
        lower
    };
    assert_eq!(highest_travels(false), [(400, true), (400, true)]);
    assert_eq!(
        highest_travels(true),
        [(600, false), (600, false)],
        "straight down from the height of the layer"
    );
}

#[test]
fn no_division_changes_nothing() {
    let stage = Skin { vertical_wall_divisions: 1, vertical_infill_divisions: 1, ..Skin::default() };
    assert_eq!(craft(&stage, print(3)), print(3));
}

#[test]
fn a_layer_that_a_bead_leads_into_stays() {
    let text = String::from_utf8(print(2).write()).expect("text");
    let (first, second) = text.split_at(text.rfind("(<layer>").expect("a layer"));
    let cut = first.rfind("M103\n").expect("a stop");
    let joined = format!("{}{}{second}", &first[..cut], &first[cut + 5..]);
    let joined = joined.replacen("(<layer> 0.6 )\n", "(<layer> 0.6 )\nM103\n", 1);
    let skein = Skein::read(joined.as_bytes()).expect("a skein");
    assert_eq!(skein.verify(), Ok(()));
    assert_eq!(craft(&Skin::default(), skein.clone()), skein);
}
