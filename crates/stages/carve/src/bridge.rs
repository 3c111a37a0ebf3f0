//! Which layers span a gap, and along which direction (stages.md §5.6).

use shape::Ring;
use shape::plane::{offset, outside};
use skein::Direction;

/// How far an outline must stand out over the layer below, in bead widths, to hang over a gap.
///
/// The seed has 1.875 layer heights, with beads 1.8 heights wide. A bead falls into a gap by its width, so that is what
/// counts; with flat layers the seed's measure sees a bridge in every gentle slope.
pub const REACH: f64 = 1.875 / 1.8;

/// The direction in which a layer bridges a gap, or `None`.
///
/// The outline, set in by 0.83 bead widths, hangs over where it leaves the outline below, set in likewise and out again
/// by [`REACH`]. Each such part counts by its vector squared over its length: squaring doubles the angle, so opposite
/// directions add up and perpendicular ones cancel. Less than 0.42 widths in sum is no bridge.
pub fn direction(layer: &[Ring], below: &[Ring], width: f64) -> Option<Direction> {
    let inner = offset(layer, -1.5 / 1.8 * width);
    let held = offset(&offset(below, -1.5 / 1.8 * width), REACH * width);
    let (mut x, mut y) = (0.0, 0.0);
    for (along, across) in outside(&inner, &held) {
        let length = (along * along + across * across).sqrt();
        if length > 0.0 {
            x += (along * along - across * across) / length;
            y += 2.0 * along * across / length;
        }
    }
    if (x * x + y * y).sqrt() < 0.75 / 1.8 * width {
        return None;
    }
    Direction::from_vector(x, y).map(Direction::half)
}
