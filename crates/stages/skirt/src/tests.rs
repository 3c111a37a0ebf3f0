use crate::Skirt;
use crate::hull::hull;
use shape::plane::Ring;
use skein::{Feature, Line, Micron, Notes, Nozzle, Point, Ratio, Skein, Stage};

/// What the rows of the acceptance list have in common: h 0.4, w 0.72.
const FINE: &str = "(<layerHeight> 0.4 </layerHeight>)\n(<beadSection> rectangle </beadSection>)\n\
                    (<operatingFeedRatePerSecond> 16.0 </operatingFeedRatePerSecond>)\n\
                    (<travelFeedRatePerSecond> 20.0 </travelFeedRatePerSecond>)\n\
                    (<edgeWidth> 0.72 </edgeWidth>)\n";

/// Least and greatest x and y of a box in mm.
type Box2 = [f64; 4];

fn corners([left, front, right, back]: Box2) -> [(f64, f64); 4] {
    [(left, front), (right, front), (right, back), (left, back)]
}

/// A skein of layers of outlines, each with a bead half a bead inside, the first bead with a speed of its own.
fn skein(facts: &str, layers: &[&[Vec<(f64, f64)>]]) -> Skein {
    let mut text = format!("(<extruderInitialization>)\n{facts}(</extruderInitialization>)\n(<crafting>)\n");
    for (index, outlines) in layers.iter().enumerate() {
        let z = 0.4 * index as f64 + 0.2;
        text.push_str(&format!("(<layer> {z:.1} )\n"));
        for outline in *outlines {
            text.push_str("(<nestedRing>)\n(<boundaryPerimeter>)\n");
            for (x, y) in outline {
                text.push_str(&format!("(<boundaryPoint> X{x:.3} Y{y:.3} Z{z:.1} </boundaryPoint>)\n"));
            }
            text.push_str("(</boundaryPerimeter>)\n(<edge> outer )\n");
            let z = z + 0.2;
            for (index, (x, y)) in outline.iter().enumerate() {
                let word = ["G1 ", "M101\nG1 "][usize::from(index == 1)];
                let feed = [" F1200.0", " F480.0"].get(index).copied().unwrap_or("");
                text.push_str(&format!("{word}X{x:.3} Y{y:.3} Z{z:.1}{feed}\n"));
            }
            text.push_str("M103\n(</edge>)\n(</nestedRing>)\n");
        }
        text.push_str("(</layer>)\n");
    }
    text.push_str("(</crafting>)\nM103\n");
    Skein::read(text.as_bytes()).expect("a skein")
}

fn square(left: f64, front: f64, right: f64, back: f64) -> Vec<(f64, f64)> {
    corners([left, front, right, back]).to_vec()
}

fn craft_with(skirt: &Skirt, skein: Skein) -> (Skein, Notes) {
    let mut notes = Notes::default();
    let made = skirt.craft(skein, &mut notes).expect("skirt");
    made.verify().expect("lawful");
    assert_eq!(Skein::read(&made.write()).as_ref(), Ok(&made), "reading undoes writing");
    (made, notes)
}

fn craft(skirt: &Skirt, skein: Skein) -> Skein {
    craft_with(skirt, skein).0
}

fn ratio(value: f64) -> Ratio {
    Ratio::from_f64(value).expect("a ratio")
}

/// One loop, whatever it holds, ending where it began. The rows measure their gap from the outline to the middle of a bead
/// that would lie beside the skirt's on the inside; ours is free room, one bead less.
fn plain() -> Skirt {
    Skirt { gap: ratio(4.0), minimum_volume: 0, into_part: false, ..Skirt::default() }
}

/// The beads of skirt and brim on a layer, each as its places in mm.
fn threads(lines: &[Line]) -> Vec<Vec<(f64, f64)>> {
    let mut nozzle = Nozzle::default();
    let mut threads: Vec<Vec<(f64, f64)>> = Vec::new();
    for line in lines {
        let at = |nozzle: &Nozzle| nozzle.at.map(|at| (Micron(at.x).mm(), Micron(at.y).mm()));
        if *line == Line::On && nozzle.feature() == Feature::Skirt {
            threads.push(at(&nozzle).into_iter().collect());
        }
        nozzle.follow(line);
        if nozzle.on && nozzle.feature() == Feature::Skirt && line.as_move().is_some() {
            threads.last_mut().expect("a thread").extend(at(&nozzle));
        }
    }
    threads
}

fn bounds(points: &[(f64, f64)]) -> Box2 {
    let start = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    points.iter().fold(start, |[left, front, right, back], (x, y)| {
        [left.min(*x), front.min(*y), right.max(*x), back.max(*y)]
    })
}

fn length(points: &[(f64, f64)]) -> f64 {
    points.windows(2).map(|pair| (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1)).sum()
}

fn assert_box(points: &[(f64, f64)], wanted: Box2) {
    let found = bounds(points);
    assert!(found.iter().zip(wanted).all(|(one, other)| (one - other).abs() < 0.01), "{found:?} {wanted:?}");
}

#[test]
fn sk1_one_loop_around_a_square_on_the_first_layer() {
    let ten = [square(0.0, 0.0, 10.0, 10.0)];
    let made = craft(&plain(), skein(FINE, &[&ten, &ten]));
    let loops = threads(&made.layers[0].lines);
    assert_eq!(loops.len(), 1);
    assert_box(&loops[0], [-3.24, -3.24, 13.24, 13.24]);
    assert!((length(&loops[0]) - 4.0 * 16.48).abs() < 0.01, "corners are not cut");
    assert!(threads(&made.layers[1].lines).is_empty());
    // The gap by its own name: the free room between the part and the clay.
    let near = craft(&Skirt { gap: ratio(3.0), ..plain() }, skein(FINE, &[&ten]));
    assert_box(&threads(&near.layers[0].lines)[0], [-2.52, -2.52, 12.52, 12.52]);
}

#[test]
fn sk2_of_two_loops_the_outer_comes_first_without_a_stop_between() {
    let made = craft(&Skirt { loops: 2, ..plain() }, skein(FINE, &[&[square(0.0, 0.0, 10.0, 10.0)]]));
    let loops = threads(&made.layers[0].lines);
    assert_eq!(loops.len(), 1);
    let (outer, inner) = loops[0].split_at(loops[0].len() / 2);
    assert_box(outer, [-3.96, -3.96, 13.96, 13.96]);
    assert_box(inner, [-3.24, -3.24, 13.24, 13.24]);
}

#[test]
fn sk3_a_brim_lies_against_the_part_on_the_first_layer() {
    let ten = [square(0.0, 0.0, 10.0, 10.0)];
    let brim = Skirt { loops: 0, brim_lines: 2, ..plain() };
    let made = craft(&brim, skein(FINE, &[&ten, &ten]));
    let loops = threads(&made.layers[0].lines);
    let (outer, inner) = loops[0].split_at(loops[0].len() / 2);
    assert_box(outer, [-1.08, -1.08, 11.08, 11.08]);
    assert_box(inner, [-0.36, -0.36, 10.36, 10.36]);
    assert!(threads(&made.layers[1].lines).is_empty());
    // A skirt keeps its gap from the brim.
    let both = craft(&Skirt { loops: 1, gap: ratio(1.0), ..brim }, skein(FINE, &[&ten]));
    assert_box(&threads(&both.layers[0].lines)[0], [-2.52, -2.52, 12.52, 12.52]);
}

#[test]
fn sk4_one_convex_loop_around_two_islands_with_exact_corners() {
    let islands = [square(0.0, 0.0, 10.0, 10.0), square(30.0, 0.0, 40.0, 10.0)];
    let made = craft(&plain(), skein(FINE, &[&islands]));
    let loops = threads(&made.layers[0].lines);
    assert_eq!(loops.len(), 1);
    assert_box(&loops[0], [-3.24, -3.24, 43.24, 13.24]);
    assert!((length(&loops[0]) - 2.0 * (46.48 + 16.48)).abs() < 0.01);
    // Along the outline there is one around each.
    let apart = craft(&Skirt { convex: false, ..plain() }, skein(FINE, &[&islands]));
    let loops = threads(&apart.layers[0].lines);
    assert_eq!(loops.len(), 2);
    // The part begins at (0, 0), so the loop around that island is the last.
    assert_box(&loops[0], [26.76, -3.24, 43.24, 13.24]);
    assert_box(&loops[1], [-3.24, -3.24, 13.24, 13.24]);
}

const CLAY: &str = "(<layerHeight> 1.5 </layerHeight>)\n(<beadSection> stadium </beadSection>)\n\
                    (<operatingFeedRatePerSecond> 30.0 </operatingFeedRatePerSecond>)\n\
                    (<travelFeedRatePerSecond> 60.0 </travelFeedRatePerSecond>)\n\
                    (<edgeWidth> 3.3 </edgeWidth>)\n";

#[test]
fn sk5_as_many_loops_as_the_volume_needs() {
    let pot = [square(0.0, 0.0, 60.0, 60.0)];
    let made = craft(&Skirt { minimum_volume: 5000, ..plain() }, skein(CLAY, &[&pot]));
    let total: f64 = threads(&made.layers[0].lines).iter().map(|points| length(points)).sum();
    // And no more than one loop, of at most 500 mm, beyond.
    assert!((1119.3..1620.0).contains(&total), "{total}");
    let fewer = craft(&Skirt { minimum_volume: 100, ..plain() }, skein(CLAY, &[&pot]));
    let least: f64 = threads(&fewer.layers[0].lines).iter().map(|points| length(points)).sum();
    assert!(least < 400.0, "{least}");
}

#[test]
fn a_skirt_stays_on_the_bed_and_says_what_it_could_not_do() {
    let ten = [square(30.0, 30.0, 40.0, 40.0)];
    for bed in ["rectangle 0.0 0.0 70.0 70.0", "ellipse 0.0 0.0 70.0 70.0"] {
        let facts = format!("{FINE}(<bed> {bed} </bed>)\n");
        let (made, notes) = craft_with(&Skirt { minimum_volume: 5000, ..plain() }, skein(&facts, &[&ten]));
        let loops = threads(&made.layers[0].lines);
        assert!(loops[0].len() > 50);
        let far = if bed.starts_with('r') {
            bounds(&loops[0])[0]
        } else {
            let far = |(x, y): &(f64, f64)| (x - 35.0).hypot(y - 35.0);
            35.0 - loops[0].iter().map(far).fold(0.0, f64::max)
        };
        assert!((0.36..2.0).contains(&far), "{far}");
        assert!(notes.summary()[0].contains("the bed has room for"), "{:?}", notes.summary());
    }
    let facts = format!("{FINE}(<bed> rectangle 29.0 29.0 41.0 41.0 </bed>)\n");
    let before = skein(&facts, &[&ten]);
    let (made, notes) = craft_with(&plain(), before.clone());
    assert_eq!(made, before);
    assert!(notes.summary()[0].contains("no room for a skirt"), "{:?}", notes.summary());
}

#[test]
fn clay_flows_on_into_the_part() {
    let ten = [square(0.0, 0.0, 10.0, 10.0)];
    let before = skein(FINE, &[&ten, &ten]);
    let made = craft(&Skirt { into_part: true, ..plain() }, before.clone());
    let lines = &made.layers[0].lines;
    let count = |wanted: &Line| lines.iter().filter(|line| *line == wanted).count();
    assert_eq!((count(&Line::On), count(&Line::Off)), (1, 1));
    // The skirt ends next to where the part begins, and the last bead of its block goes there.
    let skirt = &threads(lines)[0];
    assert_eq!(skirt.last(), Some(&(0.0, 0.0)));
    assert!(length(&skirt[skirt.len() - 2..]) < 4.6);
    // Speeds: the travel, the skirt as slow as the part's first bead, which says its own.
    let feeds: Vec<u32> = lines
        .iter()
        .filter_map(Line::as_move)
        .filter_map(|step| step.feed)
        .map(|feed| feed.get() / 1000)
        .collect();
    assert_eq!(feeds, [1200, 480, 480]);
    assert_eq!(made.layers[1], before.layers[1]);
    // Every bead of the part is still there.
    let part = |skein: &Skein| {
        let mut nozzle = Nozzle::default();
        let mut beads = Vec::new();
        for line in skein.lines() {
            let from = nozzle.at;
            nozzle.follow(line);
            if nozzle.on && nozzle.feature() != Feature::Skirt && line.as_move().is_some() {
                beads.push((from, nozzle.at, nozzle.feed));
            }
        }
        beads
    };
    assert_eq!(part(&made), part(&before));
}

#[test]
fn a_first_bead_with_the_speed_of_its_travel_keeps_it() {
    let ten = skein(FINE, &[&[square(0.0, 0.0, 10.0, 10.0)]]);
    let text = String::from_utf8(ten.write())
        .expect("text")
        .replace(" F480.0", "")
        .replace("M103\n(</edge>)", "G1 X0.0 Y0.0 Z0.4 F300.0\nM103\n(</edge>)");
    let made = craft(&Skirt { into_part: true, ..plain() }, Skein::read(text.as_bytes()).expect("a skein"));
    let lines = &made.layers[0].lines;
    let part = lines.iter().position(|line| *line == Line::Close(skein::Tag::Skirt)).expect("a skirt");
    let feeds: Vec<Option<u32>> = lines[part..]
        .iter()
        .filter_map(Line::as_move)
        .map(|step| step.feed.map(|feed| feed.get() / 1000))
        .collect();
    assert_eq!(feeds, [Some(1200), None, None, Some(300)]);
}

#[test]
fn a_part_that_begins_far_away_or_behind_foreign_lines_begins_with_a_stop() {
    let skirt = Skirt { into_part: true, gap: ratio(0.5), ..plain() };
    // A bay in which the part begins.
    let bay = vec![(20.0, 15.0), (40.0, 40.0), (0.0, 40.0), (0.0, 0.0), (40.0, 0.0)];
    let (made, notes) = craft_with(&skirt, skein(FINE, &[std::slice::from_ref(&bay)]));
    assert_eq!(made.layers[0].lines.iter().filter(|line| **line == Line::On).count(), 2);
    assert!(notes.summary()[0].contains("too far from the skirt"), "{:?}", notes.summary());
    let ten = skein(FINE, &[&[square(0.0, 0.0, 10.0, 10.0)]]);
    let text = String::from_utf8(ten.write()).expect("text").replacen("M101", "G4 P500\nM101", 1);
    let made = craft(&skirt, Skein::read(text.as_bytes()).expect("a skein"));
    assert_eq!(made.layers[0].lines.iter().filter(|line| **line == Line::On).count(), 2);
}

#[test]
fn one_brim_is_on_the_way_into_the_part() {
    let skirt = Skirt { into_part: true, brim_lines: 3, ..plain() };
    let made = craft(&skirt, skein(FINE, &[&[square(0.0, 0.0, 10.0, 10.0)]]));
    let lines = &made.layers[0].lines;
    assert_eq!(lines.iter().filter(|line| **line == Line::On).count(), 1);
}

#[test]
fn higher_layers_have_one_line_and_brims_as_many_layers_as_wanted() {
    let ten = [square(0.0, 0.0, 10.0, 10.0)];
    let skirt = Skirt { loops: 3, layers: 2, brim_lines: 2, brim_layers: 3, ..plain() };
    let made = craft(&skirt, skein(FINE, &[&ten, &ten, &ten, &ten]));
    let boxes: Vec<f64> = made
        .layers
        .iter()
        .map(|layer| threads(&layer.lines).iter().map(|points| length(points)).sum())
        .collect();
    // Loops at 5.5, 4.5 + …: what matters is how many there are.
    let (skirt, brim) = (4.0 * (10.0 + 2.0 * (1.44 + 3.24)), 4.0 * (10.72 + 12.16));
    assert!((boxes[1] - skirt + 8.0 * 0.72 - brim).abs() < 8.0, "{boxes:?}");
    assert!(
        boxes[0] > boxes[1] + 1.9 * skirt && (boxes[2] - brim).abs() < 2.0 && boxes[3] == 0.0,
        "{boxes:?}"
    );
}

#[test]
fn a_skirt_goes_around_raft_and_support_too() {
    let ten = [square(0.0, 0.0, 10.0, 10.0)];
    let text = String::from_utf8(skein(FINE, &[&ten]).write()).expect("text");
    let support = "(<supportLayer>)\nG1 X20.0 Y5.0 Z0.4\nM101\nG1 X30.0 Y5.0 Z0.4\nM103\n(</supportLayer>)\n(<nestedRing>)";
    let with = Skein::read(text.replacen("(<nestedRing>)", support, 1).as_bytes()).expect("a skein");
    // The bead reaches to 30.36.
    assert_box(&threads(&craft(&plain(), with).layers[0].lines)[0], [-3.24, -3.24, 33.6, 13.24]);
    // A raft of double beads: the skirt is as thick.
    let raft = "(<layer> 0.4 )\n(<thickness> 0.8 </thickness>)\n(<raft>)\nM108 S2.0\nG1 X0.0 Y0.0 Z0.8\nM101\n\
                G1 X20.0 Y0.0 Z0.8 F240.0\nG1 X20.0 Y20.0 Z0.8\nM103\nM108 S1.0\n(</raft>)\n(</layer>)\n(<layer>";
    let with = Skein::read(text.replacen("(<layer>", raft, 1).as_bytes()).expect("a skein");
    let made = craft(&Skirt { gap: ratio(1.0), into_part: true, ..plain() }, with);
    let lines = &made.layers[0].lines;
    assert_eq!(lines[3], Line::Flow(ratio(2.0)));
    // From the middles 0.72 of raft, 1.44 of gap and half a bead of 1.44.
    let points = &threads(lines)[0];
    assert!((bounds(points)[2] - 22.88).abs() < 0.01, "{points:?}");
    assert_eq!(lines.iter().filter(|line| **line == Line::On).count(), 1);
}

#[test]
fn what_holds_nothing_passes() {
    for layers in [&[][..], &[&[][..]], &[&[][..], &[]]] {
        let before = skein(FINE, layers);
        let (made, _) = craft_with(&Skirt { brim_lines: 1, ..Skirt::default() }, before.clone());
        assert_eq!(made, before);
    }
    // Outlines of one point and of a line.
    let thin = [vec![(1.0, 1.0)], vec![(1.0, 1.0), (5.0, 1.0)]];
    let before = skein(FINE, &[&thin]);
    assert_eq!(craft(&plain(), before.clone()), before);
    // Neutral settings.
    let ten = skein(FINE, &[&[square(0.0, 0.0, 10.0, 10.0)]]);
    assert_eq!(craft(&Skirt { loops: 0, ..Skirt::default() }, ten.clone()), ten);
}

#[test]
fn the_hull_has_no_corner_too_many() {
    let point = |x, y| Point::new(x, y);
    let square = [(0, 0), (5, 0), (10, 0), (10, 10), (5, 5), (0, 10), (0, 5), (0, 0)];
    let found = hull(square.iter().map(|(x, y)| point(*x, *y)).collect());
    assert_eq!(found, Some(Ring(vec![point(0, 0), point(10, 0), point(10, 10), point(0, 10)])));
    assert_eq!(hull(vec![point(0, 0), point(5, 5), point(9, 9)]), None);
    assert_eq!(hull(vec![point(1, 2)]), None);
    assert_eq!(hull(Vec::new()), None);
}

#[test]
fn bays_that_close_on_the_way_out_are_no_harm() {
    // A comb with narrow and wide teeth, far from whose back the line runs.
    let mut comb = vec![(0.0, 0.0), (60.0, 0.0)];
    for tooth in 0..10 {
        let right = 60.0 - 6.0 * f64::from(tooth);
        let depth = 30.0 + f64::from(tooth * tooth % 7);
        comb.extend([(right, depth), (right - 2.0, depth), (right - 2.5, 5.0), (right - 6.0, 5.0)]);
    }
    let skirt = Skirt { convex: false, gap: ratio(12.0), loops: 3, ..plain() };
    let made = craft(&skirt, skein(FINE, &[&[comb]]));
    let total: f64 = threads(&made.layers[0].lines).iter().map(|points| length(points)).sum();
    assert!((3.0 * 190.0..3.0 * 280.0).contains(&total), "{total}");
}
