use crate::Join;
use crate::absorb::absorb;
use crate::strand::Strand;
use crate::tree::{Start, Weave};
use crate::walk;
use proptest::prelude::*;
use skein::{Feature, Line, Notes, Nozzle, Point, Ratio, Ring, Side, Skein, Span, Stage, spans};

const SPACING: f64 = 3000.0;

fn ring(points: &[(i32, i32)], side: Side) -> Strand {
    let corner = |(x, y): &(i32, i32)| Point::new(*x, *y);
    let closed: Vec<Point> = points.iter().chain(points.first()).map(corner).collect();
    let flows = vec![Ratio::ONE; points.len()];
    Strand::new(Feature::Edge(side), closed, &flows).expect("a ring")
}

fn square(low: i32, high: i32) -> Strand {
    ring(&[(low, low), (high, low), (high, high), (low, high)], Side::Outer)
}

fn open(points: &[(i32, i32)]) -> Strand {
    let points: Vec<Point> = points.iter().map(|(x, y)| Point::new(*x, *y)).collect();
    let flows = vec![Ratio::ONE; points.len() - 1];
    Strand::new(Feature::Infill, points, &flows).expect("a strand")
}

fn outline(low: i32, high: i32) -> Ring {
    Ring(vec![Point::new(low, low), Point::new(high, low), Point::new(high, high), Point::new(low, high)])
}

/// Length times flow of all paths.
fn clay(paths: &[crate::sheet::Path]) -> f64 {
    let mut sum = 0.0;
    for path in paths {
        let mut from = path.start;
        for step in path.steps.iter().chain(&path.closing) {
            sum += from.distance(step.to) * step.flow;
            from = step.to;
        }
    }
    sum
}

fn join(strands: &[Strand], outlines: &[Ring]) -> Vec<crate::sheet::Path> {
    let trees = Weave::new(strands, outlines, SPACING).trees(Start { place: Point::new(0, 0), fixed: true });
    trees.iter().map(|tree| walk::path(strands, tree, 0.0)).collect()
}

fn total(strands: &[Strand]) -> f64 {
    strands.iter().map(|strand| strand.length() * strand.mean_flow()).sum()
}

#[test]
fn walls_inside_each_other_are_one_thread_that_ends_where_it_begins() {
    let strands = [square(1500, 58500), square(4500, 55500), square(7500, 52500)];
    let paths = join(&strands, &[outline(0, 60000)]);
    assert_eq!(paths.len(), 1);
    assert_eq!(paths[0].start, paths[0].end());
    assert!((clay(&paths) / total(&strands) - 1.0).abs() < 1e-6, "{} {}", clay(&paths), total(&strands));
}

#[test]
fn the_two_steps_of_a_rung_are_half_beads_half_a_bead_apart() {
    let strands = [square(1500, 58500), square(4500, 55500)];
    let paths = join(&strands, &[outline(0, 60000)]);
    let length: f64 = {
        let mut from = paths[0].start;
        let mut sum = 0.0;
        for step in &paths[0].steps {
            sum += from.distance(step.to);
            from = step.to;
        }
        sum
    };
    // Both walls leave out half a bead; two steps are a bead long each.
    assert!((length - (4.0 * 57000.0 + 4.0 * 51000.0) - SPACING).abs() < 1.0);
    let halves = paths[0].steps.iter().filter(|step| (step.flow - 0.5).abs() < 1e-9).count();
    assert_eq!(halves, 2);
    assert!(
        paths[0].steps.iter().all(|step| (step.flow - 1.0).abs() < 1e-9 || (step.flow - 0.5).abs() < 1e-9)
    );
    assert!((clay(&paths) - total(&strands)).abs() < 1.0);
}

#[test]
fn the_longest_open_strand_comes_last_and_once_and_others_are_gone_over_twice() {
    let strands = [
        square(1500, 58500),
        open(&[(4500, 4500), (4500, 55500), (20000, 55500), (20000, 4500)]),
        open(&[(40000, 4500), (40000, 55500)]),
    ];
    let paths = join(&strands, &[outline(0, 60000)]);
    assert_eq!(paths.len(), 1);
    assert_eq!(paths[0].end(), Point::new(20000, 4500));
    assert!((clay(&paths) / total(&strands) - 1.0).abs() < 1e-3, "{} {}", clay(&paths), total(&strands));
    // Two half beads, half a bead apart.
    for lane in [40750, 39250] {
        let ends = |step: &&crate::sheet::Step| step.to.x == lane && step.to.y == 55500;
        let there = paths[0].steps.iter().find(ends).expect("a lane");
        assert!(there.flow < 0.5 && there.flow > 0.4, "{}", there.flow);
    }
}

#[test]
fn no_step_crosses_an_outline() {
    // Two walls as near as beads, with a slot between.
    let strands = [
        square(1500, 20000),
        ring(&[(23000, 1500), (40000, 1500), (40000, 20000), (23000, 20000)], Side::Outer),
    ];
    let slot = Ring(vec![
        Point::new(21400, -5000),
        Point::new(21600, -5000),
        Point::new(21600, 90000),
        Point::new(21400, 90000),
    ]);
    assert_eq!(join(&strands, &[slot]).len(), 2);
    assert_eq!(join(&strands, &[]).len(), 1);
}

#[test]
fn a_seam_that_may_be_anywhere_lays_nothing_in_halves() {
    let strands =
        [square(1500, 58500), open(&[(4500, 40000), (55500, 40000), (55500, 43000), (4500, 43000)])];
    let outlines = [outline(0, 60000)];
    let trees =
        Weave::new(&strands, &outlines, SPACING).trees(Start { place: Point::new(0, 0), fixed: false });
    let paths: Vec<_> = trees.iter().map(|tree| walk::path(&strands, tree, 0.0)).collect();
    assert_eq!(paths.len(), 1);
    assert!(paths[0].steps.iter().all(|step| step.flow > 0.9), "{:?}", paths[0].steps);
    assert!((clay(&paths) / total(&strands) - 1.0).abs() < 1e-3);
}

#[test]
fn infill_far_apart_at_the_wall_halves_the_shorter_way() {
    // The wall between its ends is shorter than it is.
    let strands = [
        square(1500, 88500),
        open(&[(4500, 85500), (4500, 4500), (85500, 4500), (85500, 85500), (7500, 85500), (7500, 8000)]),
        open(&[(20000, 4500), (20000, 55500), (32000, 55500), (32000, 4500)]),
    ];
    let paths = join(&strands, &[outline(0, 90000)]);
    assert_eq!(paths.len(), 1);
    assert!((clay(&paths) / total(&strands) - 1.0).abs() < 2e-2, "{} {}", clay(&paths), total(&strands));
    let mut from = paths[0].start;
    let mut halves = 0.0;
    for step in &paths[0].steps {
        if step.flow < 0.7 && step.feature == Feature::Infill {
            halves += from.distance(step.to);
        }
        from = step.to;
    }
    assert_eq!(halves, 0.0);
}

#[test]
fn walls_with_an_empty_space_between_them_are_bridged() {
    let strands = [square(1500, 88500), square(10500, 79500)];
    let paths = join(&strands, &[outline(0, 90000)]);
    assert_eq!(paths.len(), 1);
    assert!((clay(&paths) / total(&strands) - 1.0).abs() < 1e-3);
    let far = [square(1500, 88500), square(13000, 77000)];
    assert_eq!(join(&far, &[outline(0, 90000)]).len(), 2);
}

fn thin(points: &[(i32, i32)], flow: f64) -> Strand {
    let points: Vec<Point> = points.iter().map(|(x, y)| Point::new(*x, *y)).collect();
    let flows = vec![flow; points.len() - 1];
    Strand::measured(Feature::Middle, points, flows, false).expect("a strand")
}

#[test]
fn a_thin_gap_makes_its_walls_wider_and_moves_them() {
    // Two walls with room for four tenths of a bead between them.
    let strands = vec![square(1500, 88500), square(5700, 84300), thin(&[(3600, 10000), (3600, 70000)], 0.4)];
    let before = total(&strands);
    let absorbed = absorb(strands, SPACING);
    assert_eq!(absorbed.len(), 2);
    assert!((total(&absorbed) / before - 1.0).abs() < 1e-3, "{} {before}", total(&absorbed));
    // Both move towards the gap, by a quarter of what it holds.
    assert!(absorbed[0].points().iter().any(|point| (point.x - 1800).abs() <= 1), "{:?}", absorbed[0]);
    assert!(absorbed[1].points().iter().any(|point| (point.x - 5400).abs() <= 1), "{:?}", absorbed[1]);
}

#[test]
fn what_is_too_wide_or_alone_is_laid() {
    let wide = vec![square(1500, 88500), square(7200, 82800), thin(&[(4350, 10000), (4350, 70000)], 0.9)];
    assert_eq!(absorb(wide.clone(), SPACING), wide);
    let alone = vec![square(1500, 88500), thin(&[(40000, 10000), (40000, 70000)], 0.4)];
    assert_eq!(absorb(alone.clone(), SPACING), alone);
}

/// The skein of a layer of squares inside each other and bars across, as fill would write it.
fn skein(layers: usize, size: i32, walls: i32, bars: &[i32]) -> Skein {
    let mut text = String::from(
        "(<extruderInitialization>)\n(<layerHeight> 1.5 </layerHeight>)\n(<firstLayerHeight> 1.5 </firstLayerHeight>)\n\
         (<beadSection> rectangle </beadSection>)\n(<infillWidth> 3.0 </infillWidth>)\n(<edgeWidth> 3.0 </edgeWidth>)\n\
         (</extruderInitialization>)\n(<crafting>)\n",
    );
    for layer in 0..layers {
        let z = layer as f64 * 1.5 + 1.5;
        text += &format!("(<layer> {} )\n(<nestedRing>)\n(<boundaryPerimeter>)\n", z - 0.75);
        for (x, y) in [(0, 0), (size, 0), (size, size), (0, size)] {
            text += &format!("(<boundaryPoint> X{x} Y{y} Z{} </boundaryPoint>)\n", z - 0.75);
        }
        text += "(</boundaryPerimeter>)\n";
        for wall in 0..walls {
            let (low, high) = (1.5 + 3.0 * f64::from(wall), f64::from(size) - 1.5 - 3.0 * f64::from(wall));
            let tag = if wall == 0 { "edge" } else { "loop" };
            text += &format!("(<{tag}> outer )\nG1 X{low} Y{low} Z{z}\nM101\n");
            for (x, y) in [(high, low), (high, high), (low, high), (low, low)] {
                text += &format!("G1 X{x} Y{y} Z{z}\n");
            }
            text += &format!("M103\n(</{tag}>)\n");
        }
        let inside = 1.5 + 3.0 * f64::from(walls);
        for bar in bars {
            let x = inside + f64::from(*bar);
            text += &format!(
                "(<infill>)\nG1 X{x} Y{inside} Z{z}\nM101\nG1 X{x} Y{} Z{z}\nM103\n(</infill>)\n",
                f64::from(size) - inside
            );
        }
        text += "(</nestedRing>)\n(</layer>)\n";
    }
    text += "(</crafting>)\n";
    Skein::read(text.as_bytes()).expect("a skein")
}

fn clay_of(lines: &[Line], nozzle: &mut Nozzle) -> f64 {
    let mut sum = 0.0;
    for line in lines {
        if let (Some(step), Some(from), true) = (line.as_move(), nozzle.at, nozzle.on) {
            sum += step.length(from) * nozzle.flow.f64();
        }
        nozzle.follow(line);
    }
    sum
}

fn starts(skein: &Skein) -> usize {
    let mut nozzle = Nozzle::default();
    let mut starts = 0;
    for line in skein.lines() {
        starts += usize::from(*line == Line::On && !nozzle.on);
        nozzle.follow(line);
    }
    starts
}

#[test]
fn a_part_of_one_island_is_one_thread_when_clay_flows_through_the_rise() {
    let stage = Join { through_layers: true, max_interruptions: 0, ..Join::default() };
    let joined = stage.craft(skein(20, 60, 2, &[]), &mut Notes::default()).expect("joined");
    joined.verify().expect("the laws");
    assert_eq!(starts(&joined), 1);
    let (mut before, mut after) = (Nozzle::default(), Nozzle::default());
    let old: f64 = skein(20, 60, 2, &[]).layers.iter().map(|layer| clay_of(&layer.lines, &mut before)).sum();
    let new: f64 = joined.layers.iter().map(|layer| clay_of(&layer.lines, &mut after)).sum();
    assert!((new / old - 1.0).abs() < 0.002, "{new} {old}");
}

#[test]
fn too_many_interruptions_are_refused_with_the_first_place() {
    let stage = Join { max_interruptions: 3, ..Join::default() };
    let error = stage.craft(skein(20, 60, 2, &[]), &mut Notes::default()).expect_err("19 rises");
    assert!(error.message.contains("the first of 19 interruptions"), "{}", error.message);
    assert!(error.hint.as_deref().unwrap_or_default().contains("through_layers"));
    let stage = Join { max_interruptions: 19, ..Join::default() };
    assert!(stage.craft(skein(20, 60, 2, &[]), &mut Notes::default()).is_ok());
}

#[test]
fn what_is_no_bead_stays() {
    let before = skein(2, 60, 2, &[0, 12]);
    let kept = |skein: &Skein| {
        let kept = |line: &&Line| {
            !matches!(line, Line::Move(_) | Line::On | Line::Off | Line::Flow(_) | Line::Wall(..))
                && !matches!(line, Line::Open(skein::Tag::Infill))
                && !matches!(line, Line::Close(skein::Tag::Infill | skein::Tag::Edge | skein::Tag::Loop))
        };
        skein.lines().filter(kept).cloned().collect::<Vec<_>>()
    };
    let wanted = kept(&before);
    let joined = Join::default().craft(before, &mut Notes::default()).expect("joined");
    assert_eq!(kept(&joined), wanted);
}

proptest! {
    #[test]
    fn taking_up_thin_gaps_keeps_the_clay(
        flow in 0.05f64..1.0,
        from in 2000i32..80000,
        length in 100i32..80000,
        slant in -2000i32..2000,
    ) {
        let gap = (flow * SPACING) as i32;
        let (inner, middle) = (4500 + gap, 3000 + gap / 2);
        let strands = vec![
            square(1500, 98500),
            square(inner, 100_000 - inner),
            thin(&[(middle, from), (middle + slant.min(gap / 4), (from + length).min(97000))], flow),
        ];
        let before = total(&strands);
        let absorbed = absorb(strands, SPACING);
        prop_assert!((total(&absorbed) / before - 1.0).abs() < 2e-3, "{} {}", total(&absorbed), before);
        prop_assert!(absorbed.iter().flat_map(Strand::flows).all(|flow| flow < 1.5));
    }

    #[test]
    fn clay_and_outlines_are_kept(
        size in 30i32..90,
        walls in 1i32..5,
        mut bars in proptest::collection::vec(0i32..80, 0..6),
        through in any::<bool>(),
    ) {
        bars.sort_unstable();
        bars.dedup_by(|one, other| (*one - *other).abs() < 3);
        bars.retain(|bar| f64::from(*bar) < f64::from(size) - 3.0 - 6.0 * f64::from(walls));
        let before = skein(3, size, walls, &bars);
        let stage = Join { through_layers: through, ..Join::default() };
        let joined = stage.craft(before.clone(), &mut Notes::default()).expect("joined");
        joined.verify().expect("the laws");
        let again = stage.craft(before.clone(), &mut Notes::default()).expect("joined");
        prop_assert_eq!(&joined, &again);
        let (mut old, mut new) = (Nozzle::default(), Nozzle::default());
        for (before, after) in before.layers.iter().zip(&joined.layers) {
            let flowing = new.on;
            let (old, new) = (clay_of(&before.lines, &mut old), clay_of(&after.lines, &mut new));
            // A rise may lay a bead or two more.
            let most = if through { 2.0 * SPACING } else { old * 2e-3 };
            prop_assert!((new - old).abs() <= most, "{} {}", new, old);
            let threads = spans(&after.lines, flowing).filter(|span| matches!(span, Span::Thread(_))).count();
            prop_assert_eq!(threads, 1);
            for line in &after.lines {
                if let Some(step) = line.as_move() {
                    let inside = |at: i32| (749..=size * 1000 - 749).contains(&at);
                    prop_assert!(inside(step.to.x) && inside(step.to.y));
                }
            }
        }
    }
}
