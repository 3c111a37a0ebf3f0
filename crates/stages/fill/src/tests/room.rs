//! Solid layers leave hardly any room open, whatever the form of the part, and nothing stands out of it.

use super::{Bead, WIDTH, distance_to, laid, rectangle, square, stack};
use crate::{Fill, SolidPattern};
use proptest::prelude::*;
use skein::{Point, Ratio, Ring};

fn solid(pattern: SolidPattern) -> Fill {
    Fill { density: Ratio::ONE, solid_pattern: pattern, ..Fill::default() }
}

/// A round part with two and three bulges.
fn blob(radius: f64, bulges: [f64; 2], turn: f64) -> Ring {
    let corner = |index: i32| {
        let angle = std::f64::consts::TAU * f64::from(index) / 72.0;
        let [two, three] = bulges;
        let radius = radius * (1.0 + two * (2.0 * angle).cos() + three * (3.0 * angle + turn).cos());
        Point::new((radius * angle.cos()) as i32, (radius * angle.sin()) as i32)
    };
    Ring((0..72).map(corner).collect())
}

/// A look at a part on a grid: the share of it that no bead covers, and what beads cover farther outside than a tenth of a
/// bead, as a share of it. And the clay as a share of what fills it.
fn look(part: &[Ring], beads: &[Bead]) -> (f64, f64, f64) {
    let grid = WIDTH / 4.0;
    let stretches: Vec<(Point, Point, f64)> = beads.iter().flat_map(Bead::stretches).collect();
    let bounds = part.iter().filter_map(Ring::bounds).collect::<Vec<_>>();
    let (low, high) =
        bounds.iter().fold((Point::new(0, 0), Point::new(0, 0)), |(low, high), (least, most)| {
            let low = Point::new(low.x.min(least.x), low.y.min(least.y));
            (low, Point::new(high.x.max(most.x), high.y.max(most.y)))
        });
    let (mut all, mut open, mut outside) = (0, 0, 0);
    let steps = |low: i32, high: i32| (f64::from(high - low) / grid) as i32 + 4;
    for column in -4..steps(low.x, high.x) {
        for row in -4..steps(low.y, high.y) {
            let spot = (
                f64::from(low.x) + f64::from(column) * grid + 1.0,
                f64::from(low.y) + f64::from(row) * grid + 1.0,
            );
            let place = Point::new(spot.0 as i32, spot.1 as i32);
            let inside = part.iter().filter(|ring| ring.contains(place)).count() % 2 == 1;
            let covered = stretches.iter().any(|stretch| {
                distance_to(spot, (stretch.0, stretch.1, 1.0)) <= stretch.2 * WIDTH / 2.0 + 5.0
            });
            let sides = || part.iter().flat_map(Ring::segments);
            let far = || sides().all(|(a, b)| distance_to(spot, (a, b, 1.0)) > WIDTH / 10.0);
            all += i32::from(inside);
            open += i32::from(inside && !covered);
            outside += i32::from(!inside && covered && far());
        }
    }
    let clay: f64 = stretches.iter().map(|(a, b, flow)| a.distance(*b) * flow * WIDTH).sum();
    let area: f64 = part.iter().map(Ring::area).sum::<f64>() * 1e6;
    (f64::from(open) / f64::from(all), f64::from(outside) / f64::from(all), clay / area)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn a_round_part_is_filled(
        radius in 3_000.0..9_000.0f64,
        bulges in prop::array::uniform2(0.0..0.25f64),
        turn in 0.0..6.0f64,
        rings: bool,
    ) {
        let part = [blob(radius, bulges, turn)];
        let pattern = if rings { SolidPattern::Concentric } else { SolidPattern::Line };
        let beads = laid(&solid(pattern), stack(&part, 1)).remove(0);
        let (open, outside, clay) = look(&part, &beads);
        prop_assert!(open < 0.04, "open {open}");
        prop_assert!(outside < 0.003, "outside {outside}");
        prop_assert!((clay - 1.0).abs() < 0.03, "clay {clay}");
    }
}

/// Every thickness from one bead to five: the walls share what there is, and what they leave gets a bead of its own.
#[test]
fn a_wall_of_any_thickness_is_filled() {
    for thickness in (750..3_600).step_by(150) {
        let part = [
            square(12_000),
            rectangle((thickness, thickness), (12_000 - thickness, 12_000 - thickness)).reversed(),
        ];
        let beads = laid(&solid(SolidPattern::Concentric), stack(&part, 1)).remove(0);
        let (open, outside, clay) = look(&part, &beads);
        // A corner of a bead is round.
        assert!(open < 0.02, "{thickness}: open {open}");
        assert!(outside < 0.001, "{thickness}: outside {outside}");
        assert!((clay - 1.0).abs() < 0.02, "{thickness}: clay {clay}");
    }
}
