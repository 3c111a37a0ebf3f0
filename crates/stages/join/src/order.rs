//! In which order the islands of a layer are printed.

use skein::Point;

/// How often all pairs of islands are looked at for a shorter order.
const ROUNDS: usize = 8;
/// With more islands than this only neighbours in the order are looked at, so that the work stays linear.
const WINDOW: usize = 32;

/// The order in which boxes are visited from a place, with short ways: always the nearest one, then stretches of the order
/// are turned round as long as that makes the ways shorter.
pub fn order(from: Point, boxes: &[(Point, Point)]) -> Vec<usize> {
    let mut left: Vec<usize> = (0..boxes.len()).collect();
    let mut order = Vec::with_capacity(boxes.len());
    let mut here = (from, from);
    while let Some(place) = (0..left.len()).min_by_key(|place| gap(here, boxes[left[*place]])) {
        let next = left.remove(place);
        here = boxes[next];
        order.push(next);
    }
    shorten(from, boxes, &mut order);
    order
}

fn shorten(from: Point, boxes: &[(Point, Point)], order: &mut [usize]) {
    let root = |square: i64| (square as f64).sqrt();
    for _ in 0..ROUNDS {
        let mut shorter = false;
        for first in 0..order.len() {
            for last in first + 1..order.len().min(first + WINDOW) {
                let before = if first == 0 { (from, from) } else { boxes[order[first - 1]] };
                let way = |one: usize, other: usize| {
                    let after = order
                        .get(last + 1)
                        .map_or(0.0, |after| root(gap(boxes[order[other]], boxes[*after])));
                    root(gap(before, boxes[order[one]])) + after
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

/// How far two boxes are apart, squared.
fn gap(one: (Point, Point), other: (Point, Point)) -> i64 {
    let along = |low: i32, high: i32, other_low: i32, other_high: i32| {
        let gap = i64::from(other_low) - i64::from(high);
        gap.max(i64::from(low) - i64::from(other_high)).max(0)
    };
    let x = along(one.0.x, one.1.x, other.0.x, other.1.x);
    let y = along(one.0.y, one.1.y, other.0.y, other.1.y);
    x * x + y * y
}
