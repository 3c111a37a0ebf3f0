//! Finds the nearest of many boxes, and of those that are left when some have been taken away.

use super::Point;
use std::ops::Range;

/// The least and the greatest coordinates of something.
pub type Bounds = (Point, Point);

/// Boxes that can be taken away. The search takes a time that grows with the logarithm of their number where they lie
/// beside each other.
#[derive(Clone, Debug)]
pub struct Boxes {
    boxes: Vec<Bounds>,
    /// The boxes in the order of a balanced tree: the middle of each part is its root.
    order: Vec<usize>,
    /// Where in `order` each box is.
    places: Vec<usize>,
    /// Of the part that each place of `order` is the root of: the box around all, and how many are left.
    parts: Vec<(Bounds, usize)>,
    taken: Vec<bool>,
}

impl Boxes {
    /// Sorts boxes; they are named by their index.
    pub fn new(boxes: Vec<Bounds>) -> Self {
        let count = boxes.len();
        let mut tree = Self {
            order: (0..count).collect(),
            places: vec![0; count],
            parts: boxes.iter().map(|bounds| (*bounds, 0)).collect(),
            taken: vec![false; count],
            boxes,
        };
        tree.sort(0..count, false);
        for (place, index) in tree.order.iter().enumerate() {
            tree.places[*index] = place;
        }
        tree
    }

    /// Sorts a part by x and by y in turn, and measures it.
    fn sort(&mut self, part: Range<usize>, upright: bool) {
        if part.is_empty() {
            return;
        }
        let middle = part.start.midpoint(part.end);
        let boxes = &self.boxes;
        let key = |index: &usize| {
            let (low, high) = boxes[*index];
            let center = if upright {
                i64::from(low.y) + i64::from(high.y)
            } else {
                i64::from(low.x) + i64::from(high.x)
            };
            (center, *index)
        };
        self.order[part.clone()].select_nth_unstable_by_key(middle - part.start, key);
        let mut whole = (self.boxes[self.order[middle]], part.len());
        for side in [part.start..middle, middle + 1..part.end] {
            self.sort(side.clone(), !upright);
            if !side.is_empty() {
                let (low, high) = self.parts[side.start.midpoint(side.end)].0;
                let bounds = &mut whole.0;
                bounds.0 = Point::new(bounds.0.x.min(low.x), bounds.0.y.min(low.y));
                bounds.1 = Point::new(bounds.1.x.max(high.x), bounds.1.y.max(high.y));
            }
        }
        self.parts[middle] = whole;
    }

    /// The box that is nearest to another box; of equally near ones the first.
    pub fn nearest(&self, from: Bounds) -> Option<usize> {
        let mut best = None;
        self.search(0..self.order.len(), from, &mut best);
        best.map(|(_, index)| index)
    }

    fn search(&self, part: Range<usize>, from: Bounds, best: &mut Option<(i64, usize)>) {
        let middle = part.start.midpoint(part.end);
        if part.is_empty() || self.parts[middle].1 == 0 {
            return;
        }
        let far = |bounds: Bounds| best.is_some_and(|(least, _)| gap2(from, bounds) > least);
        if far(self.parts[middle].0) {
            return;
        }
        let index = self.order[middle];
        if !self.taken[index] {
            let here = (gap2(from, self.boxes[index]), index);
            *best = Some(best.map_or(here, |best| best.min(here)));
        }
        let mut sides = [part.start..middle, middle + 1..part.end];
        let reach = |side: &Range<usize>| {
            (!side.is_empty()).then(|| gap2(from, self.parts[side.start.midpoint(side.end)].0))
        };
        if reach(&sides[1]) < reach(&sides[0]) {
            sides.swap(0, 1);
        }
        for side in sides {
            self.search(side, from, best);
        }
    }

    /// Takes a box away.
    pub fn take(&mut self, index: usize) {
        if std::mem::replace(&mut self.taken[index], true) {
            return;
        }
        let place = self.places[index];
        let mut part = 0..self.order.len();
        loop {
            let middle = part.start.midpoint(part.end);
            self.parts[middle].1 -= 1;
            match place.cmp(&middle) {
                std::cmp::Ordering::Less => part.end = middle,
                std::cmp::Ordering::Equal => return,
                std::cmp::Ordering::Greater => part.start = middle + 1,
            }
        }
    }
}

/// How far two boxes are apart, squared; nothing where they meet.
pub fn gap2(one: Bounds, other: Bounds) -> i64 {
    let along = |low: i32, high: i32, other_low: i32, other_high: i32| {
        let gap = i64::from(other_low) - i64::from(high);
        gap.max(i64::from(low) - i64::from(other_high)).max(0)
    };
    let x = along(one.0.x, one.1.x, other.0.x, other.1.x);
    let y = along(one.0.y, one.1.y, other.0.y, other.1.y);
    x * x + y * y
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_nearest_is_what_a_look_at_all_finds(
            boxes in proptest::collection::vec((0i32..100, 0i32..100, 0i32..20, 0i32..20), 0..60),
            from in (0i32..100, 0i32..100),
        ) {
            let bounds: Vec<Bounds> = boxes
                .iter()
                .map(|(x, y, width, depth)| (Point::new(*x, *y), Point::new(x + width, y + depth)))
                .collect();
            let mut tree = Boxes::new(bounds.clone());
            let mut left: Vec<usize> = (0..bounds.len()).collect();
            let mut here = (Point::new(from.0, from.1), Point::new(from.0, from.1));
            while let Some(wanted) = left.iter().copied().min_by_key(|index| gap2(here, bounds[*index])) {
                prop_assert_eq!(tree.nearest(here), Some(wanted));
                tree.take(wanted);
                tree.take(wanted);
                left.retain(|index| *index != wanted);
                here = bounds[wanted];
            }
            prop_assert_eq!(tree.nearest(here), None);
        }
    }
}
