//! Closed curves that cross, taken apart into simple loops.
//!
//! At each crossing the two strands swap their onward parts, which leaves simple loops that only touch (the Seifert
//! circles of the curves). The winding number is the same all along one side of such a loop: the loops with winding 1 on
//! their left and 0 on their right are the outline of everything that is covered at least once. One look at each curve
//! tells its winding number at one place; from there it changes by one at every crossing, up or down by the way the
//! other strand goes. Crossings are found with boxes around runs of the curve, so the cost grows with the number of
//! points and of crossings.
//!
//! Coordinates inside are floats of microns with the rounding errors of floats. What is known twice is compared: the
//! arcs of a loop with each other, whether the loop is kept or not, and the winding number after a whole curve with the
//! one before. When two disagree, curves touch within that error and the exact integer kernel of
//! [`boolean`](super::boolean) takes over. The result is rounded to whole microns once.

use super::tree::{Box2, Tree};
use super::vector::V;
use super::{Point, Ring, boolean};

/// A region grown or shrunk.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Offset {
    /// What it became.
    pub rings: Vec<Ring>,
    /// The length in microns of the longest loop of the offset curve that turned inside out, where the region was too
    /// narrow: about twice the length of the part that was lost. Infinite when it is not known.
    pub lost: f64,
}

/// Closed curves that may cross themselves and each other.
#[derive(Default)]
pub(super) struct Curves {
    points: Vec<V>,
    rings: Vec<Tree>,
    /// A box around every [`GROUP`] rings: a layer of many small parts need not look at all for each.
    groups: Vec<Box2>,
    /// Which sides are no part of an offset side.
    spokes: Vec<bool>,
}

/// How many rings share a box.
const GROUP: usize = 16;

/// A place where two sides cross, with how far along each it lies (0..1).
pub(super) struct Crossing {
    at: V,
    sides: [usize; 2],
    along: [f64; 2],
    /// Whether the second goes to the left of the first there.
    leftwards: bool,
}

/// A simple loop, taken out of the curves; its arcs run from crossing to crossing.
#[derive(Default)]
struct Circle {
    points: Vec<V>,
    arcs: Vec<Arc>,
    /// How long it is, spokes not counted.
    length: f64,
}

/// A piece of a ring between two crossings, as a part of a loop.
struct Arc {
    /// Where it begins in the loop's points.
    start: usize,
    /// The ring in [`Curves::rings`].
    ring: usize,
    /// The winding number on its left, less that of the ring's beginning.
    rise: i32,
}

/// A place of a ring where the winding number is looked up: the middle of its longest piece of a side.
#[derive(Clone, Copy)]
struct Anchor {
    place: V,
    /// A hundredth of a micron to the left: far above the error of a float, far below what is printed.
    aside: V,
    length2: f64,
    rise: i32,
}

/// One strand's passage through a crossing.
struct Visit {
    side: usize,
    along: f64,
    crossing: usize,
    /// The other strand's passage.
    partner: usize,
    ring: usize,
    /// The winding number on the left behind it, less that of the ring's beginning.
    rise: i32,
}

impl Curves {
    /// Adds a closed curve.
    pub(super) fn push(&mut self, points: impl IntoIterator<Item = V>) {
        self.push_with_spokes(points, &[]);
    }

    /// Adds a closed curve, some of whose sides, given by the index of their start in it, are no part of an offset
    /// side but lead to a corner of the ring and back.
    pub(super) fn push_with_spokes(&mut self, points: impl IntoIterator<Item = V>, spokes: &[usize]) {
        let start = self.points.len();
        self.points.extend(points);
        let end = self.points.len();
        if end - start < 3 {
            self.points.truncate(start);
            return;
        }
        self.spokes.resize(end, false);
        for index in spokes {
            self.spokes[start + index] = true;
        }
        let tree = Tree::new(&self.points, start, end);
        if self.rings.len().is_multiple_of(GROUP) {
            self.groups.push(Box2::EMPTY);
        }
        if let (Some(group), Some(bounds)) = (self.groups.last_mut(), tree.whole()) {
            group.add(bounds.low);
            group.add(bounds.high);
        }
        self.rings.push(tree);
    }

    /// The outline of what has a positive winding number.
    pub(super) fn covered(&self) -> Offset {
        let crossings = self.crossings();
        if crossings.is_empty() && self.rings.len() == 1 {
            // Nothing can have turned inside out.
            let ring = rounded(&self.points).filter(|ring| ring.area2() > 0);
            return Offset { rings: ring.into_iter().collect(), lost: 0.0 };
        }
        match self.outlines(&crossings) {
            Some(result) => result,
            None => Offset { rings: boolean::positive(&self.raw()), lost: f64::INFINITY },
        }
    }

    /// The loops that are outlines; `None` when what is known of a loop twice disagrees, which it does where sides lie on
    /// each other and their crossings are found in no order that fits together.
    fn outlines(&self, crossings: &[Crossing]) -> Option<Offset> {
        let circles = self.circles(&self.visits(crossings)?, crossings);
        let beginnings = self.beginnings(&circles)?;
        let mut result = Offset::default();
        for circle in &circles {
            // Left of an outline all is covered once, and right of it nothing is.
            let mut arcs = circle.arcs.iter().filter_map(|arc| Some(beginnings[arc.ring]? + arc.rise == 1));
            let is_outline = arcs.next().unwrap_or(false);
            if arcs.any(|other| other != is_outline) {
                return None;
            }
            if is_outline {
                result.rings.extend(rounded(&circle.points));
            } else {
                result.lost = result.lost.max(circle.length);
            }
        }
        Some(result)
    }

    /// The curves as they are, in whole microns.
    pub(super) fn raw(&self) -> Vec<Ring> {
        let round = |place: &V| Point::new(place.x.round() as i32, place.y.round() as i32);
        self.rings
            .iter()
            .map(|tree| Ring(self.points[tree.start..tree.end].iter().map(round).collect()))
            .collect()
    }

    /// The parts of the first rings that lie outside the region of the others, each as a vector.
    pub(super) fn outside(&self, first: usize) -> Vec<V> {
        let mut found = Vec::new();
        let (loops, region) = self.rings.split_at(first);
        for one in loops {
            for other in region {
                one.with_other(&self.points, other, &mut |one, other| found.extend(self.compare(one, other)));
            }
        }
        let mut cuts: Vec<(usize, f64)> =
            found.iter().map(|crossing| (crossing.sides[0], crossing.along[0])).collect();
        cuts.sort_unstable_by(|one, other| one.0.cmp(&other.0).then(one.1.total_cmp(&other.1)));
        let mut parts = Vec::new();
        let mut cuts = cuts.into_iter().peekable();
        for one in loops {
            for side in one.start..one.end {
                let (from, vector) = (self.points[side], self.points[side].to(one.after(&self.points, side)));
                let mut before = 0.0;
                let mut part = |until: f64| {
                    let middle = from.plus(vector, f64::midpoint(before, until));
                    let winding: i32 = region.iter().map(|tree| tree.winding(&self.points, middle)).sum();
                    if winding <= 0 && until > before {
                        parts.push(V { x: vector.x * (until - before), y: vector.y * (until - before) });
                    }
                    before = until;
                };
                while let Some((_, along)) = cuts.next_if(|cut| cut.0 == side) {
                    part(along);
                }
                part(1.0);
            }
        }
        parts
    }

    /// Every crossing, in a fixed order.
    pub(super) fn crossings(&self) -> Vec<Crossing> {
        let mut found = Vec::new();
        for (index, tree) in self.rings.iter().enumerate() {
            let mut pair =
                |one: (&Tree, usize), other: (&Tree, usize)| found.extend(self.compare(one, other));
            tree.with_itself(&self.points, &mut pair);
            for other in &self.rings[index + 1..] {
                tree.with_other(&self.points, other, &mut pair);
            }
        }
        found
    }

    /// Where two sides cross, if they do.
    fn compare(&self, (tree, side): (&Tree, usize), (other, second): (&Tree, usize)) -> Option<Crossing> {
        let (a, b) = (self.points[side], tree.after(&self.points, side));
        let (c, d) = (self.points[second], other.after(&self.points, second));
        // Neighbours share an end and cannot cross.
        if std::ptr::eq(tree, other) && (tree.next(side) == second || tree.next(second) == side) {
            return None;
        }
        if a.x.max(b.x) < c.x.min(d.x)
            || c.x.max(d.x) < a.x.min(b.x)
            || a.y.max(b.y) < c.y.min(d.y)
            || c.y.max(d.y) < a.y.min(b.y)
        {
            return None;
        }
        let (end, second_end) = (tree.next(side), other.next(second));
        if self.left(side, end, second) == self.left(side, end, second_end)
            || self.left(second, second_end, side) == self.left(second, second_end, end)
        {
            return None;
        }
        let (ab, cd) = (a.to(b), c.to(d));
        let share = |one: f64, other: f64| {
            let sum = one.abs() + other.abs();
            if sum > 0.0 { one.abs() / sum } else { 0.5 }
        };
        let along = share(cd.cross(c.to(a)), cd.cross(c.to(b)));
        let along_second = share(ab.cross(a.to(c)), ab.cross(a.to(d)));
        Some(Crossing {
            at: a.plus(ab, along),
            sides: [side, second],
            along: [along, along_second],
            leftwards: self.left(side, end, second_end),
        })
    }

    /// Whether point `k` lies left of the line from `i` to `j`.
    ///
    /// Points in line are told apart as if each had been moved a little, the earlier ones infinitely more than the
    /// later (simulation of simplicity: Edelsbrunner and Mücke 1990), so that the answers for all triples fit
    /// together and every touch is either a crossing or none. For the same reason the three are sorted first.
    fn left(&self, i: usize, j: usize, k: usize) -> bool {
        let (mut first, mut second, mut third, mut even) = (i, j, k, true);
        let mut order = |one: &mut usize, other: &mut usize| {
            if *one > *other {
                std::mem::swap(one, other);
                even = !even;
            }
        };
        order(&mut first, &mut second);
        order(&mut second, &mut third);
        order(&mut first, &mut second);
        let (a, b, c) = (self.points[first], self.points[second], self.points[third]);
        let terms = [a.to(b).cross(a.to(c)), b.y - c.y, c.x - b.x, c.y - a.y];
        let positive = terms.into_iter().find(|term| *term != 0.0).is_some_and(|term| term > 0.0);
        positive == even
    }

    /// The passages of each ring in their order, with the winding number behind each; `None` when it is not the same again
    /// after a whole ring.
    fn visits(&self, crossings: &[Crossing]) -> Option<Vec<Visit>> {
        let mut visits: Vec<Visit> = Vec::with_capacity(crossings.len() * 2);
        for (index, crossing) in crossings.iter().enumerate() {
            for strand in 0..2 {
                visits.push(Visit {
                    side: crossing.sides[strand],
                    along: crossing.along[strand],
                    crossing: index,
                    partner: 0,
                    ring: 0,
                    rise: 0,
                });
            }
        }
        visits.sort_unstable_by(|one, other| {
            one.side
                .cmp(&other.side)
                .then(one.along.total_cmp(&other.along))
                .then(one.crossing.cmp(&other.crossing))
        });
        let mut first: Vec<Option<usize>> = vec![None; crossings.len()];
        for index in 0..visits.len() {
            match first[visits[index].crossing] {
                None => first[visits[index].crossing] = Some(index),
                Some(partner) => {
                    visits[index].partner = partner;
                    visits[partner].partner = index;
                }
            }
        }
        let (mut ring, mut rise) = (0, 0);
        for visit in &mut visits {
            while visit.side >= self.rings[ring].end {
                if rise != 0 {
                    return None;
                }
                ring += 1;
            }
            let crossing = &crossings[visit.crossing];
            // What a strand has on its left is wound around once more. One that goes to the left has it behind the place
            // where it crosses, one that goes to the right before it.
            let is_second = visit.side == crossing.sides[1];
            rise += if crossing.leftwards == is_second { 1 } else { -1 };
            (visit.ring, visit.rise) = (ring, rise);
        }
        (rise == 0).then_some(visits)
    }

    /// Takes the curves apart at their crossings.
    fn circles(&self, visits: &[Visit], crossings: &[Crossing]) -> Vec<Circle> {
        let mut circles: Vec<Circle> = Vec::new();
        let mut used = vec![false; visits.len()];
        let mut from = 0;
        for (ring, tree) in self.rings.iter().enumerate() {
            let to = from + visits[from..].iter().take_while(|visit| visit.ring == ring).count();
            if from == to {
                let points = Vec::with_capacity(tree.end - tree.start);
                let mut circle = Circle { points, arcs: vec![Arc { start: 0, ring, rise: 0 }], length: 0.0 };
                for side in tree.start..tree.end {
                    circle.points.push(self.points[side]);
                    self.lengthen(&mut circle, side, tree.after(&self.points, side));
                }
                circles.push(circle);
            }
            from = to;
        }
        for start in 0..visits.len() {
            let mut circle = Circle::default();
            let mut here = start;
            while !used[here] {
                used[here] = true;
                here = self.walk(visits, here, crossings, &mut circle);
            }
            if circle.points.len() > 2 {
                circles.push(circle);
            }
        }
        circles
    }

    /// Follows the curve from one passage to the next and says where the other strand goes on.
    fn walk(&self, visits: &[Visit], here: usize, crossings: &[Crossing], circle: &mut Circle) -> usize {
        let visit = &visits[here];
        circle.arcs.push(Arc { start: circle.points.len(), ring: visit.ring, rise: visit.rise });
        circle.points.push(crossings[visit.crossing].at);
        let tree = &self.rings[visit.ring];
        let next = match visits.get(here + 1) {
            Some(next) if next.side < tree.end => here + 1,
            // Round the ring to its first passage.
            _ => visits.partition_point(|visit| visit.side < tree.start),
        };
        let mut side = visit.side;
        // The last passage of a ring leads round to the first even when both lie on one side.
        let mut around = next <= here;
        while side != visits[next].side || around {
            around = around && side + 1 != tree.end;
            let following = tree.next(side);
            self.lengthen(circle, side, self.points[following]);
            circle.points.push(self.points[following]);
            side = following;
        }
        self.lengthen(circle, side, crossings[visits[next].crossing].at);
        visits[next].partner
    }

    /// Counts the way from a loop's last point to the next, unless it is on a spoke.
    fn lengthen(&self, circle: &mut Circle, side: usize, to: V) {
        if let Some(from) = circle.points.last()
            && !self.spokes[side]
        {
            let way = from.to(to);
            circle.length += way.dot(way).sqrt();
        }
    }

    /// The winding number on the left of each ring's beginning, from one look at the ring; nothing for a ring that vanishes
    /// in rounding, and `None` when a look meets more than one strand.
    fn beginnings(&self, circles: &[Circle]) -> Option<Vec<Option<i32>>> {
        let mut anchors: Vec<Option<Anchor>> = vec![None; self.rings.len()];
        for circle in circles {
            for (index, arc) in circle.arcs.iter().enumerate() {
                let end = circle.arcs.get(index + 1).map_or(circle.points.len(), |next| next.start);
                let best = &mut anchors[arc.ring];
                if let Some(anchor) = circle.anchor(arc.start..end, arc.rise)
                    && best.is_none_or(|best| best.length2 < anchor.length2)
                {
                    *best = Some(anchor);
                }
            }
        }
        anchors
            .into_iter()
            .map(|anchor| {
                let Some(Anchor { place, aside, rise, .. }) = anchor else { return Some(None) };
                let left = self.winding(place.plus(aside, 1.0));
                (left - self.winding(place.plus(aside, -1.0)) == 1).then_some(Some(left - rise))
            })
            .collect()
    }

    /// How far along a ray, in lengths of `toward`, the first curve is met, if nearer than `reach`.
    pub(super) fn first_hit(&self, from: V, toward: V, reach: f64) -> Option<f64> {
        let mut best = reach;
        for tree in &self.rings {
            tree.first_hit(&self.points, from, toward, &mut best);
        }
        (best < reach).then_some(best)
    }

    /// How often the curves go round a point, counter-clockwise.
    fn winding(&self, point: V) -> i32 {
        // A closed curve does not go round a point outside its box.
        let near = self.groups.iter().enumerate().filter(|(_, group)| group.holds(point));
        near.flat_map(|(index, _)| &self.rings[index * GROUP..((index + 1) * GROUP).min(self.rings.len())])
            .map(|tree| tree.winding(&self.points, point))
            .sum()
    }
}

impl Circle {
    /// The place to look at some sides; `None` when all are shorter than a micron, which vanishes in rounding anyway.
    fn anchor(&self, sides: std::ops::Range<usize>, rise: i32) -> Option<Anchor> {
        let points = &self.points;
        let side =
            |index: usize| points[index].to(points[if index + 1 == points.len() { 0 } else { index + 1 }]);
        let (mut best, mut length2) = (None, 1.0);
        for index in sides {
            let vector = side(index);
            if vector.dot(vector) > length2 {
                length2 = vector.dot(vector);
                best = Some(index);
            }
        }
        let index = best?;
        let (vector, reach) = (side(index), 0.01 / length2.sqrt());
        let left = vector.left();
        let aside = V { x: left.x * reach, y: left.y * reach };
        Some(Anchor { place: points[index].plus(vector, 0.5), aside, length2, rise })
    }
}

/// A loop in whole microns; `None` when nothing is left of it.
fn rounded(circle: &[V]) -> Option<Ring> {
    let mut points: Vec<Point> = Vec::with_capacity(circle.len());
    for place in circle {
        let point = place.rounded();
        if points.last() != Some(&point) {
            points.push(point);
        }
    }
    while points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    let ring = Ring(points);
    // A loop less than a micron wide is rounding, not clay.
    (ring.0.len() > 2 && (ring.area2().unsigned_abs() as f64) > 2.0 * ring.length()).then_some(ring)
}
