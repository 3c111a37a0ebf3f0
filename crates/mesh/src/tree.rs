//! A static tree of boxes: what lies near a point, along a ray, or across another box.

use shape::Point3;

/// A box in microns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Box3 {
    pub(crate) low: [i32; 3],
    pub(crate) high: [i32; 3],
}

impl Box3 {
    /// The least box around some points; turned inside out for none.
    pub(crate) fn around(points: impl IntoIterator<Item = Point3>) -> Self {
        let mut whole = Self { low: [i32::MAX; 3], high: [i32::MIN; 3] };
        for point in points {
            let point = array(point);
            whole.join(&Self { low: point, high: point });
        }
        whole
    }

    /// The box with a margin on all sides.
    pub(crate) fn grown(mut self, by: i32) -> Self {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].saturating_sub(by);
            self.high[axis] = self.high[axis].saturating_add(by);
        }
        self
    }

    pub(crate) fn meets(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    /// Takes points in.
    pub(crate) fn add(&mut self, points: [Point3; 3]) {
        points.map(array).iter().for_each(|point| self.join(&Self { low: *point, high: *point }));
    }

    /// The point in the middle.
    pub(crate) fn middle(&self) -> [i32; 3] {
        [0, 1, 2].map(|axis| (self.middle2(axis) / 2) as i32)
    }

    fn join(&mut self, other: &Self) {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
    }

    /// Twice the middle, so that it stays whole.
    fn middle2(&self, axis: usize) -> i64 {
        i64::from(self.low[axis]) + i64::from(self.high[axis])
    }
}

/// A point as an array, for what is the same along all axes.
pub(crate) fn array(point: Point3) -> [i32; 3] {
    [point.x, point.y, point.z]
}

/// Boxes in a tree. The halves of a node are the halves of its range, so that the tree needs no pointers.
pub(crate) struct Tree {
    /// The box around each node's range, the root first, the children of node `n` at `2n + 1` and `2n + 2`.
    nodes: Vec<Box3>,
    /// The boxes, sorted into the ranges.
    items: Vec<(Box3, u32)>,
}

/// How many boxes a leaf holds.
const LEAF: usize = 6;

impl Tree {
    /// Builds a tree; an item is known by its place in the list.
    pub(crate) fn new(boxes: impl IntoIterator<Item = Box3>) -> Self {
        let mut items: Vec<(Box3, u32)> = boxes.into_iter().zip(0..).collect();
        let mut nodes = Vec::new();
        if !items.is_empty() {
            let empty = Box3::around([]);
            nodes = vec![empty; (items.len().div_ceil(LEAF)).next_power_of_two() * 2 - 1];
            let leaves = nodes.len() / 2;
            split(&mut nodes, &mut items, 0, leaves);
        }
        Self { nodes, items }
    }

    /// Calls `found` for every item whose box meets the asked box, in an order that depends on the items only.
    pub(crate) fn meeting(&self, asked: &Box3, mut found: impl FnMut(u32)) {
        self.visit(|node| node.meets(asked), &mut found);
    }

    /// Calls `found` for every item whose box, and the boxes around it, are wanted.
    pub(crate) fn visit(&self, mut wanted: impl FnMut(&Box3) -> bool, found: &mut impl FnMut(u32)) {
        if self.nodes.is_empty() {
            return;
        }
        let leaves = self.nodes.len() / 2;
        let mut waiting: Vec<(usize, usize, usize)> = vec![(0, 0, self.items.len())];
        while let Some((node, from, to)) = waiting.pop() {
            if from == to || !wanted(&self.nodes[node]) {
                continue;
            }
            if node >= leaves {
                for (around, item) in &self.items[from..to] {
                    if wanted(around) {
                        found(*item);
                    }
                }
            } else {
                let middle = from + (to - from) / 2;
                waiting.push((2 * node + 2, middle, to));
                waiting.push((2 * node + 1, from, middle));
            }
        }
    }
}

/// Sorts a range into its two halves along the longest axis, and those likewise.
fn split(nodes: &mut [Box3], items: &mut [(Box3, u32)], node: usize, leaves: usize) {
    let mut around = Box3::around([]);
    items.iter().for_each(|(item, _)| around.join(item));
    nodes[node] = around;
    if node >= leaves || items.is_empty() {
        return;
    }
    let length = |axis: usize| i64::from(around.high[axis]) - i64::from(around.low[axis]);
    let axis = (1..3).fold(0, |longest, axis| if length(axis) > length(longest) { axis } else { longest });
    let middle = items.len() / 2;
    items.select_nth_unstable_by_key(middle, |(item, number)| (item.middle2(axis), *number));
    let (left, right) = items.split_at_mut(middle);
    split(nodes, left, 2 * node + 1, leaves);
    split(nodes, right, 2 * node + 2, leaves);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_tree_finds_what_a_look_at_all_finds(
            points in prop::collection::vec((-50i32..50, -50i32..50, -50i32..50), 0..200),
            asked in ((-60i32..60, -60i32..60, -60i32..60), 0i32..40),
        ) {
            let boxes: Vec<Box3> = points
                .iter()
                .map(|(x, y, z)| Box3 { low: [*x, *y, *z], high: [x + 3, y + 7, z + 1] })
                .collect();
            let ((x, y, z), size) = asked;
            let asked = Box3 { low: [x, y, z], high: [x + size, y + size, z + size] };
            let mut found = Vec::new();
            Tree::new(boxes.iter().copied()).meeting(&asked, |item| found.push(item));
            found.sort_unstable();
            let all: Vec<u32> =
                (0u32..).zip(&boxes).filter(|(_, item)| item.meets(&asked)).map(|(number, _)| number).collect();
            prop_assert_eq!(found, all);
        }
    }
}
