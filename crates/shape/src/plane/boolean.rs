//! Exact booleans of regions in whole microns, by the crate `i_overlay`.
//!
//! Slower than [`offset`](super::offset) and never wrong: it serves what is rare.

use super::{Point, Ring};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;

/// What lies inside more counter-clockwise loops than clockwise ones.
pub fn positive(loops: &[Ring]) -> Vec<Ring> {
    apply(loops, &[], OverlayRule::Subject, FillRule::Positive)
}

/// What does not lie inside as many counter-clockwise loops as clockwise ones.
pub fn nonzero(loops: &[Ring]) -> Vec<Ring> {
    apply(loops, &[], OverlayRule::Subject, FillRule::NonZero)
}

/// What lies inside an odd number of loops.
pub fn even_odd(loops: &[Ring]) -> Vec<Ring> {
    apply(loops, &[], OverlayRule::Subject, FillRule::EvenOdd)
}

/// What lies in the first region and not in the second.
pub fn difference(region: &[Ring], without: &[Ring]) -> Vec<Ring> {
    apply(region, without, OverlayRule::Difference, FillRule::Positive)
}

/// What lies in both regions.
pub fn common(region: &[Ring], other: &[Ring]) -> Vec<Ring> {
    apply(region, other, OverlayRule::Intersect, FillRule::Positive)
}

fn apply(subject: &[Ring], clip: &[Ring], rule: OverlayRule, fill: FillRule) -> Vec<Ring> {
    let mut overlay: Overlay<i32> = Overlay::new(subject.iter().chain(clip).map(|ring| ring.0.len()).sum());
    for (rings, kind) in [(subject, ShapeType::Subject), (clip, ShapeType::Clip)] {
        for ring in rings {
            overlay.add_path_iter(ring.0.iter().map(|point| IntPoint::new(point.x, point.y)), kind);
        }
    }
    let shapes = overlay.overlay(rule, fill);
    shapes
        .into_iter()
        .flatten()
        .map(|contour| Ring(contour.into_iter().map(|point| Point::new(point.x, point.y)).collect()))
        .collect()
}
