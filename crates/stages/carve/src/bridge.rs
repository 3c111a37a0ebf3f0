//! Which layers span a gap, and along which direction (stages.md §5.6).

use shape::Ring;
use shape::plane::{offset, outside};
use skein::Direction;

/// How far an outline must stand out over the layer below, in layer heights, to hang over a gap: the seed's 1.875.
pub const REACH: f64 = 1.875;

/// The direction in which a layer bridges a gap, or `None`.
///
/// The outline, set in by 1.5 heights, hangs over where it leaves the outline below, set in likewise and out again by
/// 1.875. Each such part counts by its vector squared over its length: squaring doubles the angle, so opposite
/// directions add up and perpendicular ones cancel. Less than 0.75 heights in sum is no bridge.
pub fn direction(layer: &[Ring], below: &[Ring], height: f64) -> Option<Direction> {
    let inner = offset(layer, -1.5 * height);
    let held = offset(&offset(below, -1.5 * height), REACH * height);
    let (mut x, mut y) = (0.0, 0.0);
    for (along, across) in outside(&inner, &held) {
        let length = (along * along + across * across).sqrt();
        if length > 0.0 {
            x += (along * along - across * across) / length;
            y += 2.0 * along * across / length;
        }
    }
    if (x * x + y * y).sqrt() < 0.75 * height {
        return None;
    }
    Direction::from_vector(x, y).map(Direction::half)
}
