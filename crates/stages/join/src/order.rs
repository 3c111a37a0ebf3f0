//! In which order the islands of a layer are printed.

use shape::plane::{Bounds, Boxes, gap2};
use skein::Point;

/// How often all pairs of islands are looked at for a shorter order.
const ROUNDS: usize = 8;
/// With more islands than this only neighbours in the order are looked at, so that the work stays linear.
const WINDOW: usize = 32;

/// The order in which boxes are visited from a place, with short ways: always the nearest one, then stretches of the order
/// are turned round as long as that makes the ways shorter.
pub fn order(from: Point, boxes: &[Bounds]) -> Vec<usize> {
    let mut left = Boxes::new(boxes.to_vec());
    let mut order = Vec::with_capacity(boxes.len());
    let mut here = (from, from);
    while let Some(next) = left.nearest(here) {
        left.take(next);
        here = boxes[next];
        order.push(next);
    }
    shorten(from, boxes, &mut order);
    order
}

fn shorten(from: Point, boxes: &[Bounds], order: &mut [usize]) {
    let root = |square: i64| (square as f64).sqrt();
    for _ in 0..ROUNDS {
        let mut shorter = false;
        for first in 0..order.len() {
            for last in first + 1..order.len().min(first + WINDOW) {
                let before = if first == 0 { (from, from) } else { boxes[order[first - 1]] };
                let way = |one: usize, other: usize| {
                    let after = order
                        .get(last + 1)
                        .map_or(0.0, |after| root(gap2(boxes[order[other]], boxes[*after])));
                    root(gap2(before, boxes[order[one]])) + after
                };
                if way(last, first) + 1.0 < way(first, last) {
                    order[first..=last].reverse();
                    shorter = true;
                }
            }
        }
        if !shorter {
            break;
        }
    }
}
