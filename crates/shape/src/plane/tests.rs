use super::*;
use proptest::prelude::*;

fn ring(points: &[(i32, i32)]) -> Ring {
    Ring(points.iter().map(|(x, y)| Point::new(*x, *y)).collect())
}

fn square(low: i32, high: i32) -> Ring {
    ring(&[(low, low), (high, low), (high, high), (low, high)])
}

fn area(region: &[Ring]) -> f64 {
    region.iter().map(Ring::area).sum()
}

/// A star with wavy, uneven rays: convex and concave, wide and narrow.
fn star(seed: u64, points: usize, size: f64) -> Ring {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1u32 << 31)
    };
    let points = (0..points)
        .map(|index| {
            let angle = index as f64 / points as f64 * std::f64::consts::TAU;
            let radius = size * (0.15 + random());
            Point::new((radius * libm::cos(angle)) as i32, (radius * libm::sin(angle)) as i32)
        })
        .collect();
    Ring(points)
}

/// A smooth, lobed outline with many small sides and a little noise, like a scan's.
fn blob(seed: u64, points: usize, size: f64) -> Ring {
    let mut state = seed | 1;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1u32 << 31)
    };
    let waves: Vec<(f64, f64, f64)> = (1..7)
        .map(|wave| (f64::from(wave), 0.35 * random() / f64::from(wave).sqrt(), random() * 6.3))
        .collect();
    let noise = 0.01 * random();
    let points = (0..points)
        .map(|index| {
            let angle = index as f64 / points as f64 * std::f64::consts::TAU;
            let wave: f64 =
                waves.iter().map(|(count, high, turn)| high * libm::cos(count * angle + turn)).sum();
            let radius = size * (0.3 + (0.8 + wave).abs() + noise * random());
            Point::new((radius * libm::cos(angle)) as i32, (radius * libm::sin(angle)) as i32)
        })
        .collect();
    Ring(points)
}

#[test]
fn a_square_shrinks_and_grows_by_the_distance() {
    assert_eq!(offset(&[square(0, 20_000)], -360.0), vec![square(360, 19_640)]);
    assert_eq!(offset(&[square(0, 20_000)], 500.0), vec![square(-500, 20_500)]);
}

#[test]
fn a_hole_grows_while_its_outside_shrinks() {
    let region = [square(0, 20_000), square(5_000, 15_000).reversed()];
    let shrunk = offset(&region, -1_000.0);
    assert_eq!(area(&shrunk), 18.0 * 18.0 - 12.0 * 12.0);
    assert_eq!(offset(&region, -3_000.0), vec![]);
}

#[test]
fn what_is_too_narrow_vanishes() {
    assert_eq!(offset(&[square(0, 1_000)], -501.0), vec![]);
    let triangle = ring(&[(0, 0), (10_000, 0), (5_000, 8_000)]);
    assert_eq!(offset(&[triangle], -4_000.0), vec![]);
}

#[test]
fn a_dumb_bell_parts_at_its_neck() {
    let bell = ring(&[
        (0, 0),
        (10_000, 0),
        (10_000, 4_550),
        (16_000, 4_550),
        (16_000, 0),
        (26_000, 0),
        (26_000, 10_000),
        (16_000, 10_000),
        (16_000, 5_450),
        (10_000, 5_450),
        (10_000, 10_000),
        (0, 10_000),
    ]);
    let parts = offset(&[bell], -500.0);
    assert_eq!(parts.len(), 2);
    assert!((area(&parts) - 162.0).abs() < 0.01, "{}", area(&parts));
}

#[test]
fn a_neck_as_wide_as_the_distance_allows_does_no_harm() {
    let bell = ring(&[
        (0, 0),
        (10_000, 0),
        (10_000, 4_500),
        (16_000, 4_500),
        (16_000, 0),
        (26_000, 0),
        (26_000, 10_000),
        (16_000, 10_000),
        (16_000, 5_500),
        (10_000, 5_500),
        (10_000, 10_000),
        (0, 10_000),
    ]);
    assert!((area(&offset(&[bell], -500.0)) - 162.0).abs() < 0.01);
}

#[test]
fn overlapping_loops_are_united() {
    let region = united(&[square(0, 10_000), square(5_000, 15_000)]);
    assert_eq!(region.len(), 1);
    assert_eq!(area(&region), 175.0);
    assert_eq!(area(&united(&[square(0, 10_000), square(2_000, 3_000)])), 100.0);
    assert_eq!(area(&united(&[square(0, 10_000), square(2_000, 3_000).reversed()])), 99.0);
}

#[test]
fn shared_sides_fall_back_to_the_exact_kernel() {
    let one = square(0, 10_000);
    let other = ring(&[(10_000, 0), (20_000, 0), (20_000, 10_000), (10_000, 10_000)]);
    assert_eq!(area(&united(&[one.clone(), other])), 200.0);
    assert_eq!(area(&united(&[one.clone(), one])), 100.0);
}

/// A rounded box whose small corner sides are all swallowed must keep its long ones.
#[test]
fn a_rounded_corner_shrinks_to_a_sharp_one() {
    let corner = |x: f64, y: f64, from: f64| {
        (0..=6).map(move |step| {
            let angle = (from + 15.0 * f64::from(step)).to_radians();
            ((x + 1_000.0 * libm::cos(angle)).round() as i32, (y + 1_000.0 * libm::sin(angle)).round() as i32)
        })
    };
    let points: Vec<(i32, i32)> = corner(19_000.0, 19_000.0, 0.0)
        .chain(corner(1_000.0, 19_000.0, 90.0))
        .chain(corner(1_000.0, 1_000.0, 180.0))
        .chain(corner(19_000.0, 1_000.0, 270.0))
        .collect();
    let shrunk = offset(&[ring(&points)], -3_000.0);
    assert_eq!(shrunk.len(), 1);
    assert!((area(&shrunk) - 196.0).abs() < 0.01, "{shrunk:?}");
}

#[test]
fn a_sharp_reflex_corner_keeps_its_distance() {
    // A slot as narrow as a hair, pointing inwards.
    let slot = ring(&[
        (0, 0),
        (20_000, 0),
        (20_000, 20_000),
        (10_100, 20_000),
        (10_000, 10_000),
        (9_900, 20_000),
        (0, 20_000),
    ]);
    let tip = Point::new(10_000, 10_000);
    for part in offset(&[slot], -1_000.0) {
        for (from, to) in part.segments() {
            let (along, reach) = (from.delta(to), from.delta(tip));
            let share = (along.0 * reach.0 + along.1 * reach.1) as f64
                / (along.0 * along.0 + along.1 * along.1) as f64;
            let share = share.clamp(0.0, 1.0);
            let gap =
                (reach.0 as f64 - share * along.0 as f64).hypot(reach.1 as f64 - share * along.1 as f64);
            assert!(gap > 998.0, "{gap}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    /// The exact kernel, given the same raw curve rounded to microns, covers the same area up to that rounding.
    #[test]
    fn it_agrees_with_the_exact_kernel(seed in any::<u64>(), points in 5usize..160, share in -0.6f64..0.3) {
        let region = [if seed % 2 == 0 { star(seed, points, 30_000.0) } else { blob(seed, points, 30_000.0) }];
        let distance = share * 30_000.0;
        let ours = offset(&region, distance);
        let raw = offset::raw_for_test(&region, distance);
        let exact = boolean::positive(&raw);
        let slack = 2e-3 * ours.iter().chain(&exact).map(Ring::length).sum::<f64>() / 1000.0 + 1e-3;
        prop_assert!((area(&ours) - area(&exact)).abs() <= slack, "{} {} {}", area(&ours), area(&exact), slack);
    }

    /// Shrinking twice is shrinking once by the sum, up to the corners that are cut.
    #[test]
    fn shrinking_never_leaves_the_region(seed in any::<u64>(), points in 5usize..160, share in 0.01f64..0.6) {
        let region = [if seed % 2 == 0 { star(seed, points, 30_000.0) } else { blob(seed, points, 30_000.0) }];
        let shrunk = offset(&region, -share * 30_000.0);
        let outside = boolean::difference(&shrunk, &region);
        prop_assert!(area(&outside) < 1e-2, "{}", area(&outside));
    }
}

#[test]
fn a_strip_thinner_than_a_bead_gets_one_line_on_its_middle() {
    let strip = [ring(&[(0, 0), (20_000, 0), (20_000, 500), (0, 500)])];
    let lines = thin_parts(&strip, &offset_with_loss(&strip, -360.0), 720.0);
    assert_eq!(lines.len(), 1, "{lines:?}");
    let line = &lines[0];
    assert!(line.points.iter().all(|point| (point.y - 250).abs() < 30), "{line:?}");
    assert!(line.widths.iter().all(|width| (width - 500.0).abs() < 40.0), "{line:?}");
    let length: f64 = line.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    assert!(length > 19_000.0, "{length}");
}

#[test]
fn a_ring_wall_thinner_than_a_bead_gets_one_closed_line() {
    let circle = |radius: f64| {
        Ring(
            (0..48)
                .map(|index| {
                    let angle = std::f64::consts::TAU * f64::from(index) / 48.0;
                    Point::new((radius * libm::cos(angle)) as i32, (radius * libm::sin(angle)) as i32)
                })
                .collect(),
        )
    };
    let wall = [circle(15_000.0), circle(14_400.0).reversed()];
    let lines = thin_parts(&wall, &offset_with_loss(&wall, -360.0), 720.0);
    assert_eq!(lines.len(), 1);
    assert_eq!(lines[0].points.first(), lines[0].points.last());
    let radii: Vec<f64> = lines[0].points.iter().map(|point| point.distance(Point::default())).collect();
    assert!(radii.iter().all(|radius| (14_550.0..14_750.0).contains(radius)), "{radii:?}");
}

#[test]
fn a_peg_thinner_than_a_bead_gets_a_ring_half_as_large_that_fills_it() {
    let peg = [square(0, 600)];
    let lines = thin_parts(&peg, &offset_with_loss(&peg, -360.0), 720.0);
    assert_eq!(lines.len(), 1);
    assert!((lines[0].area() - 360_000.0).abs() < 2_000.0, "{lines:?}");
    let mut corners = lines[0].points.clone();
    assert_eq!(corners.pop().as_ref(), corners.first());
    corners.sort_unstable();
    assert_eq!(corners, [(150, 150), (150, 450), (450, 150), (450, 450)].map(|(x, y)| Point::new(x, y)));
}

#[test]
fn a_peg_too_thin_for_a_ring_gets_a_dab() {
    let peg = [square(0, 400)];
    let lines = thin_parts(&peg, &offset_with_loss(&peg, -360.0), 720.0);
    assert_eq!((lines.len(), lines[0].points.len()), (1, 2));
    assert!((lines[0].area() - 160_000.0).abs() < 2_000.0, "{lines:?}");
}

#[test]
fn a_line_is_cut_where_it_becomes_too_narrow() {
    let points = [0, 1_000, 2_000, 3_000].map(|x| Point::new(x, 0)).to_vec();
    let line = MiddleLine { points, widths: vec![100.0, 500.0, 500.0, 0.0] };
    let parts = line.wider_than(300.0);
    let cut = MiddleLine {
        points: [500, 1_000, 2_000, 2_400].map(|x| Point::new(x, 0)).to_vec(),
        widths: vec![300.0, 500.0, 500.0, 300.0],
    };
    assert_eq!(parts, [cut]);
    assert_eq!(line.wider_than(600.0), []);
    assert_eq!(line.wider_than(0.0), std::slice::from_ref(&line));
}

#[test]
fn a_solid_square_has_no_thin_part() {
    let region = [square(0, 20_000)];
    assert_eq!(thin_parts(&region, &offset_with_loss(&region, -360.0), 720.0), vec![]);
}

#[test]
fn a_fin_on_a_block_gets_a_line() {
    let fin = [ring(&[
        (0, 0),
        (10_000, 0),
        (10_000, 4_800),
        (16_000, 4_800),
        (16_000, 5_200),
        (10_000, 5_200),
        (10_000, 10_000),
        (0, 10_000),
    ])];
    let lines = thin_parts(&fin, &offset_with_loss(&fin, -360.0), 720.0);
    assert_eq!(lines.len(), 1, "{lines:?}");
    assert!(lines[0].points.iter().all(|point| (point.y - 5_000).abs() < 60), "{lines:?}");
}

mod hatching {
    use super::*;
    use crate::plane::hatch::{Hatch, Run};

    #[test]
    fn a_square_becomes_one_zig_zag() {
        let region = [square(1_000, 9_000)];
        let hatch = Hatch::new(&region, (1.0, 0.0), 1_000.0);
        let threads = hatch.threads(hatch.rows(), 3_000.0);
        assert_eq!(threads.len(), 1);
        let length: f64 = threads[0].windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        // Rows at 1 … 8 mm, eight millimetres long each, seven joints of one millimetre.
        assert_eq!(length, 8.0 * 8_000.0 + 7.0 * 1_000.0);
    }

    fn circle(radius: f64) -> Ring {
        let corner = |index: i32| {
            let angle = std::f64::consts::TAU * f64::from(index) / 90.0;
            Point::new((radius * libm::cos(angle)) as i32, (radius * libm::sin(angle)) as i32)
        };
        Ring((0..90).map(corner).collect())
    }

    #[test]
    fn rows_fill_a_round_region_to_its_border() {
        let (inside, ends) = ([circle(9_500.0)], [circle(9_750.0)]);
        for direction in [(1.0, 0.0), (0.6, 0.8)] {
            let runs = Hatch::fitted_to(&inside, &ends, direction, 1_000.0).filled(250.0);
            let area: f64 = runs.iter().map(Run::area).sum();
            let room = circle(10_000.0).area() * 1e6;
            assert!((area / room - 1.0).abs() < 0.03, "{direction:?}: {}", area / room);
            // The thread begins and ends in the segments over the first and the last row.
            let beside = runs[1..].iter().map(Run::area).sum::<f64>() / room;
            assert!(beside < 0.01, "{direction:?}: {beside}");
            let ends = [runs[0].points[0], runs[0].points[runs[0].points.len() - 1]];
            for end in ends {
                assert!((8_000.0..9_950.0).contains(&end.distance(Point::default())), "{end:?}");
            }
            assert!(runs[0].widths.iter().all(|width| (50.0..1_100.0).contains(width)), "{direction:?}");
        }
    }

    #[test]
    fn a_hole_is_gone_round() {
        let region = [square(0, 20_000), square(6_000, 14_000).reversed()];
        let hatch = Hatch::new(&region, (0.6, 0.8), 1_000.0);
        let threads = hatch.threads(hatch.rows(), 5_000.0);
        assert!(threads.len() <= 4, "{}", threads.len());
        let hole = square(6_100, 13_900);
        assert!(threads.iter().flatten().all(|point| !hole.contains(*point)));
    }
}

/// The distance from a point to the nearest side of a ring, in microns.
fn gap(ring: &Ring, point: Point) -> f64 {
    let to_side = |(from, to): (Point, Point)| {
        let (along, reach) = (from.delta(to), from.delta(point));
        let (along, reach) = ((along.0 as f64, along.1 as f64), (reach.0 as f64, reach.1 as f64));
        let length2 = along.0 * along.0 + along.1 * along.1;
        let share = ((along.0 * reach.0 + along.1 * reach.1) / length2).clamp(0.0, 1.0);
        ((reach.0 - share * along.0).powi(2) + (reach.1 - share * along.1).powi(2)).sqrt()
    };
    ring.segments().map(to_side).fold(f64::INFINITY, f64::min)
}

#[test]
fn simplifying_keeps_the_corners_of_a_square_with_points_on_its_sides() {
    let mut points: Vec<(i32, i32)> = (0..10).map(|step| (step * 100, step % 2)).collect();
    points.extend([(1_000, 0), (1_000, 1_000), (500, 1_001), (0, 1_000)]);
    assert_eq!(
        simplified(&ring(&points), 3.0),
        Some(ring(&[(0, 0), (1_000, 0), (1_000, 1_000), (0, 1_000)]))
    );
}

proptest! {
    #[test]
    fn simplifying_moves_no_outline_by_more_than_the_tolerance(seed in any::<u64>(), points in 4usize..200, tolerance in 1.0f64..500.0) {
        let before = star(seed, points, 5_000.0);
        if let Some(after) = simplified(&before, tolerance) {
            for point in &before.0 {
                prop_assert!(gap(&after, *point) <= tolerance + 1.0, "{} {}", gap(&after, *point), tolerance);
            }
        }
    }
}

mod clipped {
    use crate::plane::clip::{Line, Thread, threads};
    use crate::plane::{Point, Ring};
    use proptest::prelude::*;

    fn ring(points: &[(i32, i32)]) -> Ring {
        Ring(points.iter().map(|(x, y)| Point::new(*x, *y)).collect())
    }

    fn line(points: &[(f64, f64)]) -> Line {
        Line { points: points.to_vec(), closed: false }
    }

    fn length(thread: &Thread) -> f64 {
        thread.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }

    #[test]
    fn lines_are_joined_along_the_outline_and_not_across_a_hole() {
        let region = [
            ring(&[(0, 0), (100, 0), (100, 100), (0, 100)]),
            ring(&[(40, 40), (40, 60), (60, 60), (60, 40)]),
        ];
        let level = |y: f64| line(&[(-10.0, y), (110.0, y)]);
        let lines = [level(20.0), level(50.0), level(80.0)];
        // Each end is joined once: the middle line's with one neighbour's on either side, and its two parts round the hole.
        let found = threads(&lines, &region, 45.0, 1.0);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((length(&found[0]) - (100.0 + 100.0 + 2.0 * 40.0 + 2.0 * 30.0 + 40.0)).abs() < 1e-9);
        assert_eq!(threads(&lines, &region, 35.0, 1.0).len(), 2);
        let apart = threads(&lines, &region, 5.0, 1.0);
        assert_eq!(apart.len(), 4);
    }

    #[test]
    fn a_line_through_corners_is_neither_lost_nor_longer() {
        let diamond = [ring(&[(-50, 0), (0, -50), (50, 0), (0, 50)])];
        let square = [ring(&[(0, 0), (100, 0), (100, 100), (0, 100)])];
        let across = threads(&[line(&[(-90.0, 0.0), (90.0, 0.0)])], &diamond, 0.0, 1.0);
        assert_eq!(across.iter().map(length).sum::<f64>(), 100.0);
        let diagonal = threads(&[line(&[(-9.0, -9.0), (109.0, 109.0)])], &square, 0.0, 1.0);
        assert!((diagonal.iter().map(length).sum::<f64>() - 100.0 * 2f64.sqrt()).abs() < 1e-9);
        let beside = threads(&[line(&[(-90.0, 50.0), (90.0, 50.0)])], &diamond, 0.0, 1.0);
        assert!(beside.is_empty(), "it only touches the tip: {beside:?}");
    }

    #[test]
    fn a_closed_line_stays_whole_or_becomes_arcs() {
        let square = [ring(&[(0, 0), (100, 0), (100, 100), (0, 100)])];
        let box_at = |x: f64| Line {
            points: vec![(x, 20.0), (x + 30.0, 20.0), (x + 30.0, 50.0), (x, 50.0)],
            closed: true,
        };
        let found = threads(&[box_at(10.0)], &square, 0.0, 1.0);
        assert_eq!(found.len(), 1);
        assert!(found[0].closed && found[0].points.len() == 4);
        let found = threads(&[box_at(-10.0)], &square, 0.0, 1.0);
        assert_eq!(found[0].points, [(0, 20), (20, 20), (20, 50), (0, 50)].map(|(x, y)| Point::new(x, y)));
        assert!(threads(&[box_at(300.0)], &square, 0.0, 1.0).is_empty());
        assert!(threads(&[box_at(0.0)], &[], 0.0, 1.0).is_empty());
    }

    proptest! {
        /// On a grid as coarse as this nearly every line goes through corners and along sides: what comes out lies in the
        /// region, and without joints it is no longer than what of the lines does.
        #[test]
        fn nothing_leaves_the_region(
            tops in prop::collection::vec(3..12i32, 6),
            path in prop::collection::vec((-1..13i32, -1..13i32), 2..8),
        ) {
            // Steps of different height, side by side.
            let mut points = vec![(12, 0), (0, 0)];
            points.splice(0..0, tops.iter().enumerate().flat_map(|(index, top)| {
                let left = 2 * index as i32;
                [(left, *top), (left + 2, *top)]
            }));
            points.reverse();
            let scaled: Vec<(i32, i32)> = points.iter().map(|(x, y)| (x * 10, y * 10)).collect();
            let region = [ring(&scaled)];
            prop_assert!(region[0].area2() > 0);
            let begin = [(-50.0, -50.0)];
            let way: Vec<(f64, f64)> =
                begin.into_iter().chain(path.iter().map(|(x, y)| (f64::from(x * 10), f64::from(y * 10)))).chain([(-50.0, 200.0)]).collect();
            let inside = |x: f64, y: f64| {
                (-1.0..=121.0).contains(&x) && y >= -1.0 && {
                    let column = |x: f64| tops[((x / 20.0).floor() as usize).min(5)];
                    y <= f64::from(column((x - 1.0).max(0.0)).max(column(x + 1.0))) * 10.0 + 1.0
                }
            };
            for thread in threads(&[line(&way)], &region, 0.0, 0.5) {
                for pair in thread.points.windows(2) {
                    for step in 0..=50 {
                        let share = f64::from(step) / 50.0;
                        let at = |from: i32, to: i32| f64::from(from) + f64::from(to - from) * share;
                        let (x, y) = (at(pair[0].x, pair[1].x), at(pair[0].y, pair[1].y));
                        prop_assert!(inside(x, y), "{x} {y} of {pair:?}");
                    }
                }
            }
        }
    }
}

mod growing {
    use super::*;

    /// Random numbers from 0 to 1, the same for the same seed.
    fn dice(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed | 1;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1u32 << 31)
        }
    }

    /// Beads crosswise and side by side: islands, bays and holes with corners of every kind.
    fn beads(seed: u64, count: usize) -> Vec<Ring> {
        let mut random = dice(seed);
        let mut at = || Point::new((random() * 30_000.0) as i32, (random() * 30_000.0) as i32);
        let ways: Vec<(Point, Point)> = (0..count).map(|_| (at(), at())).collect();
        let half = 150.0 + random() * 1_500.0;
        let beads: Vec<Ring> = ways.iter().filter_map(|(from, to)| Ring::around(*from, *to, half)).collect();
        boolean::positive(&beads)
    }

    /// A comb with teeth of random height.
    fn comb(seed: u64, count: usize) -> Vec<Ring> {
        let mut random = dice(seed);
        let (tooth, bay) = (200.0 + random() * 2_000.0, 200.0 + random() * 4_000.0);
        let mut points = Vec::new();
        let mut x = 0.0;
        for _ in 0..count {
            let (low, high) = (500.0 + random() * 4_000.0, 6_000.0 + random() * 24_000.0);
            for (dx, y) in [(0.0, low), (0.0, high), (tooth, high), (tooth, low)] {
                points.push(((x + dx) as i32, y as i32));
            }
            x += tooth + bay;
        }
        points.extend([((x - bay) as i32, 0), (0, 0)]);
        points.reverse();
        vec![ring(&points)]
    }

    /// A strip wound round itself.
    fn spiral(seed: u64, count: usize) -> Vec<Ring> {
        let mut random = dice(seed);
        let (step, wide) = (random() * 3_000.0 + 500.0, 0.2 + 0.6 * random());
        let corners = 3.0 + (random() * 30.0).floor();
        let place = |index: usize, aside: f64| {
            let angle = index as f64 / corners * std::f64::consts::TAU;
            let radius = step * (index as f64 / corners + aside + 0.3);
            ((radius * libm::cos(angle)) as i32, (radius * libm::sin(angle)) as i32)
        };
        let outside = (0..count).map(|index| place(index, wide));
        let points: Vec<_> = outside.chain((0..count).rev().map(|index| place(index, 0.0))).collect();
        boolean::positive(&[ring(&points)])
    }

    fn region(kind: u8, seed: u64, count: usize) -> Vec<Ring> {
        match kind {
            0 => beads(seed, 1 + count / 4),
            1 => comb(seed, 1 + count / 6),
            2 => spiral(seed, count),
            3 => vec![star(seed, count, 30_000.0)],
            _ => vec![blob(seed, count, 30_000.0)],
        }
    }

    fn holds(region: &[Ring], point: Point) -> bool {
        region.iter().filter(|ring| ring.contains(point)).count() % 2 == 1
    }

    /// Two teeth of one height: their offset sides lie on each other, and the way round the whole comb and the way
    /// round what is covered twice come out as one loop. It must not be taken for what is covered twice all along.
    #[test]
    fn teeth_side_by_side_are_not_lost() {
        let region = comb(8_416_678_272_292_370_578, 6);
        let grown = offset(&region, 12_627.76706928578);
        let exact = boolean::positive(&offset::raw_for_test(&region, 12_627.76706928578));
        assert_eq!(grown.len(), 1);
        assert!((area(&grown) - area(&exact)).abs() < 0.5, "{} {}", area(&grown), area(&exact));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        /// What is nearer than the distance is covered, what is farther than a sharp corner reaches is not.
        #[test]
        fn it_covers_what_is_near(kind in 0u8..5, seed in any::<u64>(), count in 4usize..120, share in 0.01f64..4.0) {
            let region = region(kind, seed, count);
            let distance = share * share * 3_000.0;
            let grown = offset(&region, distance);
            let raw = offset::raw_for_test(&region, distance);
            let exact = boolean::positive(&raw);
            // What rounding to microns can make out.
            let slack = 2e-3 * grown.iter().chain(&exact).map(Ring::length).sum::<f64>() / 1000.0 + 1e-3;
            let mut random = dice(seed);
            let far = 40_000.0 + 3.0 * distance;
            prop_assert!((area(&grown) - area(&exact)).abs() <= slack, "{} {} {}", area(&grown), area(&exact), slack);
            for _ in 0..40 {
                let place = Point::new(((random() - 0.5) * far) as i32, ((random() - 0.5) * far) as i32);
                let away = match holds(&region, place) {
                    true => 0.0,
                    false => region.iter().map(|ring| gap(ring, place)).fold(f64::INFINITY, f64::min),
                };
                if away < distance - 5.0 {
                    prop_assert!(holds(&grown, place), "{place:?} {away} {distance}");
                }
                if away > distance * 1.415 + 5.0 {
                    prop_assert!(!holds(&grown, place), "{place:?} {away} {distance}");
                }
            }
        }
    }
}
