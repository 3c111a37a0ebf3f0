//! Boxes around the sides of curves, so that sides that may meet are found without looking at all of them.

use super::vector::V;

/// How many sides a leaf of the tree holds: few enough to compare all with all, enough to keep the tree small.
const LEAF: usize = 8;

/// Boxes around runs of a curve's sides: leaves of [`LEAF`] sides first, then pairs of boxes, up to one for all.
pub(super) struct Tree {
    /// Where the ring's points begin and end among those of all curves.
    pub(super) start: usize,
    pub(super) end: usize,
    /// Where each level's boxes begin in `boxes`, the leaves' first.
    levels: Vec<usize>,
    boxes: Vec<Box2>,
    /// Whether the run in each box goes forwards all along its chord, so that it cannot cross itself.
    forwards: Vec<bool>,
}

/// A box.
#[derive(Clone, Copy)]
pub(super) struct Box2 {
    pub(super) low: V,
    pub(super) high: V,
}

impl Box2 {
    pub(super) const EMPTY: Self = Self {
        low: V { x: f64::INFINITY, y: f64::INFINITY },
        high: V { x: f64::NEG_INFINITY, y: f64::NEG_INFINITY },
    };

    pub(super) fn add(&mut self, point: V) {
        self.low = V { x: self.low.x.min(point.x), y: self.low.y.min(point.y) };
        self.high = V { x: self.high.x.max(point.x), y: self.high.y.max(point.y) };
    }

    pub(super) fn holds(&self, point: V) -> bool {
        (self.low.x..=self.high.x).contains(&point.x) && (self.low.y..=self.high.y).contains(&point.y)
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        self.low.x <= other.high.x
            && other.low.x <= self.high.x
            && self.low.y <= other.high.y
            && other.low.y <= self.high.y
    }
}

impl Tree {
    pub(super) fn new(points: &[V], start: usize, end: usize) -> Self {
        let count = end - start;
        let leaves = count.div_ceil(LEAF);
        let mut boxes = Vec::with_capacity(leaves * 2 + 8);
        for leaf in 0..leaves {
            let (from, to) = (start + leaf * LEAF, (start + (leaf + 1) * LEAF).min(end));
            let mut bounds = Box2::EMPTY;
            points[from..to].iter().for_each(|point| bounds.add(*point));
            bounds.add(points[if to == end { start } else { to }]);
            boxes.push(bounds);
        }
        let mut levels = vec![0];
        let (mut from, mut length) = (0, leaves);
        while length > 1 {
            levels.push(boxes.len());
            for pair in 0..length.div_ceil(2) {
                let mut bounds = boxes[from + 2 * pair];
                if 2 * pair + 1 < length {
                    let other: Box2 = boxes[from + 2 * pair + 1];
                    bounds.add(other.low);
                    bounds.add(other.high);
                }
                boxes.push(bounds);
            }
            from += length;
            length = length.div_ceil(2);
        }
        let forwards = Vec::with_capacity(boxes.len());
        let mut tree = Self { start, end, levels, boxes, forwards };
        for level in 0..tree.levels.len() {
            for index in 0..leaves.div_ceil(1 << level) {
                tree.forwards.push(tree.runs_forwards(points, level, index));
            }
        }
        tree
    }

    fn runs_forwards(&self, points: &[V], level: usize, index: usize) -> bool {
        // A run whose first half turns back does so too.
        if level > 0 && !self.forwards[self.levels[level - 1] + 2 * index] {
            return false;
        }
        let mut sides = self.sides(level, index);
        let chord = points[sides.start].to(points[self.next(sides.end - 1)]);
        sides.all(|side| points[side].to(points[self.next(side)]).dot(chord) > 0.0)
    }

    /// The box around all of it.
    pub(super) fn whole(&self) -> Option<&Box2> {
        self.boxes.last()
    }

    /// Calls for every two sides of the ring that may cross.
    pub(super) fn with_itself(&self, points: &[V], pair: &mut impl FnMut((&Self, usize), (&Self, usize))) {
        self.with_itself_in(points, self.levels.len() - 1, 0, pair);
    }

    /// Calls for every side of this ring and of another that may cross.
    pub(super) fn with_other(
        &self,
        points: &[V],
        other: &Self,
        pair: &mut impl FnMut((&Self, usize), (&Self, usize)),
    ) {
        self.with_other_in(points, other, (self.levels.len() - 1, 0), (other.levels.len() - 1, 0), pair);
    }

    /// How far from a place a way in a direction meets the ring, in lengths of that way, when it is nearer than `best`.
    pub(super) fn first_hit(&self, points: &[V], from: V, toward: V, best: &mut f64) {
        self.first_hit_in(points, self.levels.len() - 1, 0, from, toward, best);
    }

    /// How often the ring goes around a place, counter-clockwise.
    pub(super) fn winding(&self, points: &[V], point: V) -> i32 {
        self.winding_in(points, self.levels.len() - 1, 0, point)
    }

    /// The point after a point of the ring.
    pub(super) fn next(&self, index: usize) -> usize {
        if index + 1 == self.end { self.start } else { index + 1 }
    }

    /// The end of a side that starts at a point of the ring.
    pub(super) fn after(&self, points: &[V], side: usize) -> V {
        points[self.next(side)]
    }

    fn bounds(&self, level: usize, index: usize) -> &Box2 {
        &self.boxes[self.levels[level] + index]
    }

    /// The boxes inside a box.
    fn children(&self, level: usize, index: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        let below = self.levels[level] - self.levels[level - 1];
        [2 * index, 2 * index + 1]
            .into_iter()
            .filter(move |child| *child < below)
            .map(move |child| (level - 1, child))
    }

    /// The sides inside a box.
    fn sides(&self, level: usize, index: usize) -> std::ops::Range<usize> {
        let width = LEAF << level;
        self.start + index * width..(self.start + (index + 1) * width).min(self.end)
    }

    fn with_itself_in(
        &self,
        points: &[V],
        level: usize,
        index: usize,
        pair: &mut impl FnMut((&Self, usize), (&Self, usize)),
    ) {
        if self.forwards[self.levels[level] + index] {
            return;
        }
        if level == 0 {
            let sides = self.sides(0, index);
            for side in sides.clone() {
                for second in side + 1..sides.end {
                    pair((self, side), (self, second));
                }
            }
            return;
        }
        let (one, other) = ((level - 1, 2 * index), (level - 1, 2 * index + 1));
        self.with_itself_in(points, one.0, one.1, pair);
        if self.children(level, index).count() == 2 {
            self.with_itself_in(points, other.0, other.1, pair);
            self.with_other_in(points, self, one, other, pair);
        }
    }

    fn with_other_in(
        &self,
        points: &[V],
        other: &Self,
        one: (usize, usize),
        two: (usize, usize),
        pair: &mut impl FnMut((&Self, usize), (&Self, usize)),
    ) {
        if !self.bounds(one.0, one.1).meets(other.bounds(two.0, two.1)) {
            return;
        }
        if one.0 == 0 && two.0 == 0 {
            let seconds = other.sides(0, two.1);
            let reach = other.bounds(0, two.1);
            for side in self.sides(0, one.1) {
                let (a, b) = (points[side], self.after(points, side));
                if a.x.max(b.x) < reach.low.x
                    || a.x.min(b.x) > reach.high.x
                    || a.y.max(b.y) < reach.low.y
                    || a.y.min(b.y) > reach.high.y
                {
                    continue;
                }
                for second in seconds.clone() {
                    pair((self, side), (other, second));
                }
            }
        } else if one.0 >= two.0 {
            for child in self.children(one.0, one.1) {
                self.with_other_in(points, other, child, two, pair);
            }
        } else {
            for child in other.children(two.0, two.1) {
                self.with_other_in(points, other, one, child, pair);
            }
        }
    }

    fn first_hit_in(&self, points: &[V], level: usize, index: usize, from: V, toward: V, best: &mut f64) {
        let mut ray = Box2::EMPTY;
        ray.add(from);
        ray.add(from.plus(toward, *best));
        if !self.bounds(level, index).meets(&ray) {
            return;
        }
        if level > 0 {
            for (level, index) in self.children(level, index) {
                self.first_hit_in(points, level, index, from, toward, best);
            }
            return;
        }
        for side in self.sides(0, index) {
            let (a, b) = (points[side], self.after(points, side));
            let (left, right) = (toward.cross(from.to(a)), toward.cross(from.to(b)));
            if (left >= 0.0) != (right >= 0.0) {
                let share = a.plus(a.to(b), left / (left - right));
                let along = from.to(share).dot(toward) / toward.dot(toward);
                if along >= 0.0 && along < *best {
                    *best = along;
                }
            }
        }
    }

    /// What the sides in a box add to the winding number: those that cross the ray to the right, upwards less
    /// downwards. A run that lies wholly right of the point counts by its two ends.
    fn winding_in(&self, points: &[V], level: usize, index: usize, point: V) -> i32 {
        let bounds = self.bounds(level, index);
        if bounds.high.x < point.x || bounds.high.y < point.y || bounds.low.y > point.y {
            return 0;
        }
        let sides = self.sides(level, index);
        let above = |place: V| i32::from(place.y > point.y);
        if bounds.low.x > point.x {
            return above(self.after(points, sides.end - 1)) - above(points[sides.start]);
        }
        if level == 0 {
            return sides
                .map(|side| {
                    let (a, b) = (points[side], self.after(points, side));
                    let rise = above(b) - above(a);
                    let right = rise != 0 && {
                        let turn = a.to(b).cross(a.to(point));
                        if rise > 0 { turn > 0.0 } else { turn < 0.0 }
                    };
                    if right { rise } else { 0 }
                })
                .sum();
        }
        self.children(level, index).map(|(level, index)| self.winding_in(points, level, index, point)).sum()
    }
}
