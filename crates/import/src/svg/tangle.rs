//! Whether outlines cross so often that nobody can have drawn them: every crossing becomes a corner.

use shape::plane::cross;
use shape::{Point, Ring};

/// How many crossings are made into corners: they take about a gigabyte.
const MOST: u64 = 5_000_000;
/// How many pairs of sides are looked at.
const LOOKS: u64 = 16_384;
/// How many of them must cross before it is no chance.
const ENOUGH: u64 = 8;

/// Guesses from some pairs of sides, always the same ones, whether all of them cross too often.
pub(super) fn is_tangled<'a>(rings: impl Iterator<Item = &'a Ring>) -> bool {
    let sides: Vec<(Point, Point)> = rings.flat_map(Ring::segments).collect();
    let pairs = (sides.len() as u64).saturating_mul(sides.len() as u64) / 2;
    if pairs <= MOST {
        return false;
    }
    // A linear congruential generator (Knuth's MMIX), of which the upper bits are the good ones.
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        sides[(state >> 33) as usize % sides.len()]
    };
    let crossing = (0..LOOKS).filter(|_| do_cross(next(), next())).count() as u64;
    crossing >= ENOUGH && u128::from(crossing) * u128::from(pairs) > u128::from(MOST) * u128::from(LOOKS)
}

fn do_cross((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    let on_both_sides = |one: i128, other: i128| one.signum() * other.signum() < 0;
    on_both_sides(cross(a, b, c), cross(a, b, d)) && on_both_sides(cross(c, d, a), cross(c, d, b))
}
