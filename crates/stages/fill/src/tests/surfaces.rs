//! What is seen from above or below.

use super::{Bead, CELLS, WIDTH, degrees, infill, inset, laid, rectangle, sparse, square};
use crate::{Fill, Pattern};
use skein::{Direction, Ring};

/// A roof that leans 45° from vertical: closed by solid rings without an angle, by its walls alone with 60°.
#[test]
fn what_leans_less_than_the_surrounding_angle_is_no_surface() {
    let layers: Vec<(Vec<Ring>, Option<Direction>)> = (0..30)
        .map(|layer| {
            (vec![rectangle((layer * 400, layer * 400), (60_000 - layer * 400, 60_000 - layer * 400))], None)
        })
        .collect();
    let length = |angle: f64| {
        let fill = Fill {
            surrounding_angle: degrees(angle),
            base_layers: 4,
            top_layers: 4,
            ..sparse(0.1, Pattern::Line)
        };
        let layers = laid(&fill, inset(&layers));
        infill(&layers[15]).iter().map(|bead| bead.length()).sum::<f64>()
    };
    assert!(length(0.0) > 1.05 * length(60.0), "{} {}", length(0.0), length(60.0));
    assert!((length(60.0) - length(80.0)).abs() < 1e-9);
}

/// Cells leave out what is solid, and end at it.
#[test]
fn cells_leave_room_for_surfaces() {
    // A step: the upper half is smaller, so a part of layer 5 is seen from above.
    let (wide, narrow) = (vec![square(60_000)], vec![rectangle((0, 0), (30_000, 60_000))]);
    let layers: Vec<_> =
        (0..12).map(|layer| (if layer < 6 { wide.clone() } else { narrow.clone() }, None)).collect();
    for pattern in CELLS {
        let fill = Fill { base_layers: 1, top_layers: 1, ..sparse(0.2, pattern) };
        let layer = &laid(&fill, inset(&layers))[5];
        // The share of clay between two x, in pieces of a tenth of a millimetre.
        let share = |low: f64, high: f64| -> f64 {
            let mut clay = 0.0;
            for (from, to, _) in infill(layer).into_iter().flat_map(Bead::stretches) {
                let count = (from.distance(to) / 100.0).ceil().max(1.0);
                for piece in 0..count as i32 {
                    let x = f64::from(from.x) + f64::from(to.x - from.x) * (f64::from(piece) + 0.5) / count;
                    clay += if (low..high).contains(&x) { from.distance(to) / count * WIDTH } else { 0.0 };
                }
            }
            clay / (high - low) / 57_840.0
        };
        let (left, right) = (share(2_000.0, 27_000.0), share(31_000.0, 58_000.0));
        assert!((0.1..0.35).contains(&left), "{pattern:?}: sparse {left}");
        assert!((0.9..1.1).contains(&right), "{pattern:?}: solid {right}");
    }
}
