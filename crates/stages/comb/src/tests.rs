use super::*;
use proptest::prelude::*;
use skein::{Mark, Reader, Ring, Tag};

const WIDTH: i32 = 720;

fn ring(points: &[(f64, f64)]) -> Ring {
    let um = |mm: f64| (mm * 1000.0).round() as i32;
    Ring(points.iter().map(|(x, y)| Point::new(um(*x), um(*y))).collect())
}

fn square(low: (f64, f64), high: (f64, f64)) -> Ring {
    ring(&[low, (high.0, low.1), high, (low.0, high.1)])
}

fn stage(jump: f64) -> Comb {
    let widths = Ratio::from_f64(jump / 0.72).expect("a ratio");
    Comb { running_jump_space_over_bead_width: widths, ..Comb::default() }
}

/// A layer at z 0.4 with outlines and two beads of no length, which a travel joins.
fn layer(outlines: &[Ring], from: Point3, to: Point3) -> Skein {
    let mut lines = vec![Line::Layer(Micron(200))];
    for outline in outlines {
        lines.push(Line::Open(Tag::BoundaryPerimeter));
        let points = outline.0.iter().map(|at| Point3 { x: at.x, y: at.y, z: 200 });
        lines.extend(points.map(|at| Line::Point(Mark::Boundary, at)));
        lines.push(Line::Close(Tag::BoundaryPerimeter));
    }
    for at in [from, to] {
        lines.extend([Line::Move(Move::to(at)), Line::On, Line::Move(Move::to(at)), Line::Off]);
    }
    lines.push(Line::Close(Tag::Layer));
    let head = vec![Line::Close(Tag::ExtruderInitialization)];
    let mut skein = Skein { head, layers: vec![Layer { lines }], ..Skein::default() };
    skein.state(&Facts { bead_width: Some(Micron(WIDTH)), ..Facts::default() }).expect("facts");
    skein
}

/// The way of the nozzle between two places, with both of them.
fn way3(stage: &Comb, outlines: &[Ring], from: Point3, to: Point3) -> Vec<Point3> {
    let skein = stage.craft(layer(outlines, from, to), &mut Notes::default()).expect("comb");
    assert_eq!(skein.verify(), Ok(()));
    let steps: Vec<Point3> = skein.lines().filter_map(Line::as_move).map(|step| step.to).collect();
    steps[1..steps.len() - 1].to_vec()
}

fn way(stage: &Comb, outlines: &[Ring], from: (f64, f64), to: (f64, f64)) -> Vec<(f64, f64)> {
    let at = |place: (f64, f64)| {
        let at = ring(&[place]).0[0];
        Point3 { x: at.x, y: at.y, z: 400 }
    };
    let mm = |microns: i32| f64::from(microns) / 1000.0;
    way3(stage, outlines, at(from), at(to)).iter().map(|at| (mm(at.x), mm(at.y))).collect()
}

fn plate() -> [Ring; 2] {
    [square((0.0, 0.0), (40.0, 40.0)), square((15.0, 15.0), (25.0, 25.0)).reversed()]
}

fn two_squares() -> [Ring; 2] {
    [square((0.0, 0.0), (10.0, 10.0)), square((30.0, 0.0), (40.0, 10.0))]
}

fn u_shape() -> Ring {
    ring(&[
        (0.0, 0.0),
        (40.0, 0.0),
        (40.0, 40.0),
        (30.0, 40.0),
        (30.0, 10.0),
        (10.0, 10.0),
        (10.0, 40.0),
        (0.0, 40.0),
    ])
}

/// stages_tests.md B1.
#[test]
fn b1_around_a_hole() {
    assert_eq!(
        way(&stage(0.0), &plate(), (6.0, 18.0), (35.0, 18.0)),
        [(6.0, 18.0), (14.64, 14.64), (25.36, 14.64), (35.0, 18.0)]
    );
}

/// stages_tests.md B2; the original stays on the straight line, whose jump is 0.35 mm longer.
#[test]
fn b2_across_the_narrowest_gap() {
    assert_eq!(
        way(&stage(0.0), &two_squares(), (3.0, 2.0), (35.0, 8.0)),
        [(3.0, 2.0), (10.0, 7.063), (30.0, 7.063), (35.0, 8.0)]
    );
}

/// stages_tests.md B3.
#[test]
fn b3_a_run_up_on_either_side() {
    assert_eq!(
        way(&stage(2.0), &two_squares(), (3.0, 2.0), (35.0, 8.0)),
        [(3.0, 2.0), (7.28, 7.063), (32.72, 7.063), (35.0, 8.0)]
    );
}

/// stages_tests.md B4.
#[test]
fn b4_around_a_slot() {
    assert_eq!(
        way(&stage(2.0), &[u_shape()], (6.0, 35.0), (35.0, 35.0)),
        [(6.0, 35.0), (9.64, 9.64), (30.36, 9.64), (35.0, 35.0)]
    );
}

/// stages_tests.md B5.
#[test]
fn b5_what_crosses_no_outline_stays() {
    assert_eq!(way(&stage(2.0), &plate(), (6.0, 5.0), (35.0, 8.0)), [(6.0, 5.0), (35.0, 8.0)]);
    let places = [Point3 { x: 6000, y: 5000, z: 400 }, Point3 { x: 35_000, y: 8000, z: 400 }];
    let skein = layer(&plate(), places[0], places[1]);
    assert_eq!(stage(2.0).craft(skein.clone(), &mut Notes::default()), Ok(skein));
}

/// stages_tests.md B6: no bead between the outlines, here as in all these tests, and the outlines in either order.
#[test]
fn b6_outlines_end_with_their_blocks() {
    let mut squares = two_squares();
    let straight = way(&stage(0.0), &squares, (3.0, 2.0), (35.0, 8.0));
    squares.reverse();
    assert_eq!(way(&stage(0.0), &squares, (3.0, 2.0), (35.0, 8.0)), straight);
}

/// stages_tests.md B7.
#[test]
fn b7_way_points_lie_at_the_higher_end() {
    for (low, high) in [(100, 400), (400, 100)] {
        let from = Point3 { x: 6000, y: 18_000, z: low };
        let to = Point3 { x: 35_000, y: 18_000, z: high };
        let heights: Vec<i32> = way3(&stage(0.0), &plate(), from, to).iter().map(|at| at.z).collect();
        assert_eq!(heights, [low, 400, 400, high]);
    }
}

#[test]
fn a_detour_must_be_worth_its_open_air() {
    let slot = [u_shape()];
    let travel = |price: f64| {
        let stage = Comb { detour_over_open_air: Ratio::from_f64(price).expect("a ratio"), ..stage(0.0) };
        way(&stage, &slot, (6.0, 35.0), (35.0, 35.0)).len()
    };
    // The straight way is 29 mm with 20 of open air, the way around 72.
    assert_eq!([travel(0.0), travel(2.1), travel(2.3)], [2, 2, 4]);
}

#[test]
fn a_narrow_wall_is_followed_in_its_middle() {
    // A frame 0.6 mm wide: less than a bead.
    let frame = [square((0.0, 0.0), (40.0, 40.0)), square((0.6, 0.6), (39.4, 39.4)).reversed()];
    let way = way(&stage(2.0), &frame, (0.3, 20.0), (20.0, 0.3));
    assert_eq!(way, [(0.3, 20.0), (0.3, 0.3), (20.0, 0.3)]);
}

#[test]
fn what_flies_above_the_layer_or_parks_is_meant() {
    let mut reader = Reader::default();
    let mut skein =
        layer(&plate(), Point3 { x: 6000, y: 18_000, z: 400 }, Point3 { x: 35_000, y: 18_000, z: 400 });
    let lines = &mut skein.layers[0].lines;
    let travel = lines.iter().rposition(|line| *line == Line::On).expect("a bead") - 1;
    let flight = ["G1 X6 Y18 Z5", "G1 X35 Y18 Z5"].map(|line| reader.line(line.as_bytes()).expect("a line"));
    lines.splice(travel..travel, flight);
    let park = reader.line(b"G1 X6 Y18 Z0.4").expect("a line");
    lines.insert(lines.len() - 1, park);
    assert_eq!(stage(2.0).craft(skein.clone(), &mut Notes::default()), Ok(skein));
}

#[test]
fn layers_without_outlines_beads_or_lines_pass() {
    let from = Point3 { x: 0, y: 0, z: 400 };
    let mut skein = layer(&[], from, Point3 { x: 9000, ..from });
    skein.layers.push(Layer { lines: vec![Line::Layer(Micron(600)), Line::Close(Tag::Layer)] });
    skein.layers.push(
        layer(&[Ring::default(), ring(&[(1.0, 1.0)])], from, Point3 { x: 9000, ..from }).layers.remove(0),
    );
    assert_eq!(stage(2.0).craft(skein.clone(), &mut Notes::default()), Ok(skein));
}

/// The length in open air, in microns, found by asking every ring about many places on the way.
fn sampled(outlines: &[Ring], way: &[Point3]) -> f64 {
    way.windows(2)
        .map(|pair| {
            let length = Move::to(Point3 { z: pair[0].z, ..pair[1] }).length(pair[0]);
            let steps = (length / 20.0).ceil() as i32;
            let open = (0..steps).filter(|step| {
                let share = (f64::from(*step) + 0.5) / f64::from(steps);
                let axis =
                    |a: i32, b: i32| (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as i32;
                let at = Point::new(axis(pair[0].x, pair[1].x), axis(pair[0].y, pair[1].y));
                outlines.iter().filter(|ring| ring.contains(at)).count() % 2 == 0
            });
            open.count() as f64 * length / f64::from(steps.max(1))
        })
        .sum()
}

/// A star with as many corners as there are radii.
fn star(center: (f64, f64), radii: &[f64]) -> Ring {
    let count = radii.len() as f64;
    let corner = |(index, radius): (usize, &f64)| {
        let angle = index as f64 / count * std::f64::consts::TAU;
        (center.0 + radius * angle.cos(), center.1 + radius * angle.sin())
    };
    ring(&radii.iter().enumerate().map(corner).collect::<Vec<_>>())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// stages_tests.md B8: stars with holes like stars, two of them side by side, and travels from anywhere to anywhere.
    #[test]
    fn b8_never_more_open_air_and_never_too_far(
        outsides in prop::collection::vec(prop::collection::vec(9.0..20.0f64, 3..24), 2),
        holes in prop::collection::vec(prop::collection::vec(1.0..4.0f64, 3..24), 2),
        ends in [(-15.0..55.0f64, -15.0..15.0f64), (-15.0..55.0f64, -15.0..15.0f64)],
        jump in 0.0..4.0f64,
        margin in 0.0..2.0f64,
    ) {
        let center = |index: usize| (index as f64 * 41.0, 0.0);
        let mut outlines: Vec<Ring> =
            outsides.iter().enumerate().map(|(index, radii)| star(center(index), radii)).collect();
        outlines.extend(holes.iter().enumerate().map(|(index, radii)| star(center(index), radii).reversed()));
        let [from, to] = ends.map(|end| ring(&[end]).0[0]).map(|at| Point3 { x: at.x, y: at.y, z: 400 });
        let stage = Comb { margin_over_bead_width: Ratio::from_f64(margin).expect("a ratio"), ..stage(jump) };
        let way = way3(&stage, &outlines, from, to);
        let (before, after) = (sampled(&outlines, &[from, to]), sampled(&outlines, &way));
        // The samples know the air of a piece to half of 20 microns at each crossing.
        prop_assert!(after <= before + 200.0, "{before} became {after}: {way:?}");
        let length: f64 = way.windows(2).map(|pair| Move::to(pair[1]).length(pair[0])).sum();
        let straight = Move::to(to).length(from);
        let price = stage.detour_over_open_air.f64();
        let run_ups = 4.0 * (f64::from(WIDTH) + jump * 1000.0) * way.len() as f64;
        prop_assert!(length <= straight + price * (before - after).max(0.0) + run_ups + 1000.0);
    }
}
