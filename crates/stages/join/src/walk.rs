//! Goes round a tree of strands and lays everything once.

use crate::sheet::{Path, Step};
use crate::strand::Strand;
use crate::visit::{Child, Tree, Visit};
use skein::Point;

/// The thread that goes round a tree. The last of a closed root, as long as `rise` in microns, is its closing.
pub fn path(strands: &[Strand], tree: &Tree, rise: f64) -> Path {
    let Some(root) = tree.visits.first() else { return Path::default() };
    let start = strands[root.strand].at(root.entry);
    let mut walker = Walker { strands, tree, start, steps: Vec::new() };
    walker.run();
    let mut path = Path { start, steps: walker.steps, closing: None, flows_on: false };
    let long = strands[root.strand].length() > 4.0 * rise;
    if path.start == path.end() && strands[root.strand].closed && long {
        close(&mut path, rise);
    }
    path
}

/// Takes the closing off a path that ends where it begins.
fn close(path: &mut Path, rise: f64) {
    let mut left = rise;
    while left > 0.0 {
        let Some(last) = path.steps.pop() else { return };
        let from = path.end();
        let length = from.distance(last.to);
        if length > left {
            let share = 1.0 - left / length;
            let between = |from: i32, to: i32| {
                (f64::from(from) + (f64::from(to) - f64::from(from)) * share).round() as i32
            };
            let to = Point::new(between(from.x, last.to.x), between(from.y, last.to.y));
            path.steps.push(Step { to, ..last });
        }
        left -= length;
        path.closing = Some(Step { to: path.start, ..last });
    }
}

/// Where a bead lies on the way of its strand. What is laid twice lies in two lanes, a half bead in each.
#[derive(Clone, Copy, PartialEq)]
enum Lane {
    Left,
    Middle,
    Right,
}

/// Length times flow of a way.
fn laid(points: &[Point], flows: &[f64]) -> f64 {
    points.windows(2).zip(flows).map(|(pair, flow)| pair[0].distance(pair[1]) * flow).sum()
}

/// A way at a distance to the left of another, in microns.
fn beside(points: &[Point], distance: f64) -> Vec<Point> {
    let along = |from: Point, to: Point| {
        let (x, y) = from.delta(to);
        let length = from.distance(to);
        (length > 0.0).then(|| (x as f64 / length, y as f64 / length))
    };
    // Of points on the same place the first is beside itself as the next side says.
    let mut directions: Vec<Option<(f64, f64)>> =
        points.windows(2).map(|pair| along(pair[0], pair[1])).collect();
    for index in 1..directions.len() {
        directions[index] = directions[index].or(directions[index - 1]);
    }
    let side = |index: usize| directions.get(index).copied().flatten();
    let shifted = points.iter().enumerate().map(|(index, point)| {
        let after = side(index);
        let before = index.checked_sub(1).and_then(side);
        let (Some(one), Some(other)) = (before.or(after), after.or(before)) else { return *point };
        // A corner is cut where it would stand out more than twice as far.
        let scale = distance / (1.0 + one.0 * other.0 + one.1 * other.1).max(0.5);
        let (x, y) = (-(one.1 + other.1) * scale, (one.0 + other.0) * scale);
        Point::new((f64::from(point.x) + x).round() as i32, (f64::from(point.y) + y).round() as i32)
    });
    shifted.collect()
}

/// A lane keeps no step shorter than this share of a bead's width: half a bead of that length is less clay than can be said.
const FINENESS: f64 = 16.0;

/// Leaves out the points of a way that are nearer to the one before than a distance in microns, but for the first and the
/// last.
fn drop_crumbs(points: &mut Vec<Point>, flows: &mut Vec<f64>, least: f64) {
    let mut kept: Vec<(Point, f64)> = Vec::with_capacity(flows.len());
    let Some((first, rest)) = points.split_first() else { return };
    for (index, (point, flow)) in rest.iter().zip(flows.iter()).enumerate() {
        let before = kept.last().map_or(*first, |last| last.0);
        if before.distance(*point) >= least {
            kept.push((*point, *flow));
        } else if index + 1 == rest.len() {
            kept.pop();
            kept.push((*point, *flow));
        }
    }
    points.truncate(1);
    points.extend(kept.iter().map(|kept| kept.0));
    flows.clear();
    flows.extend(kept.iter().map(|kept| kept.1));
}

/// A step over holds its clay on a way that is at most so many times longer than was thought; more would leave a thread that
/// no nozzle can lay.
const LONGER: f64 = 4.0;

struct Walker<'a> {
    strands: &'a [Strand],
    tree: &'a Tree,
    start: Point,
    steps: Vec<Step>,
}

/// A visit under way.
struct Place {
    visit: usize,
    /// The next child.
    next: usize,
    /// How far the walk has come.
    along: f64,
    /// How far along what is laid now is a second half.
    second: f64,
    /// Where to go, and with what flow, when it is over.
    back: Option<(Point, f64)>,
}

impl Walker<'_> {
    /// A tree may be as deep as there are strands, so what is under way is kept in a list.
    fn run(&mut self) {
        let mut under_way = vec![Place { visit: 0, next: 0, along: 0.0, second: 0.0, back: None }];
        while let Some(place) = under_way.last_mut() {
            let (tree, index) = (self.tree, place.visit);
            let visit = &tree.visits[index];
            let again = if index == 0 { tree.again } else { 0.0 };
            if let Some(child) = visit.children.get(place.next) {
                let from = std::mem::replace(&mut place.along, child.resume.unwrap_or(f64::INFINITY));
                let second = std::mem::replace(&mut place.second, child.leave);
                place.next += 1;
                self.lay(visit, from, child.leave, again, second);
                under_way.push(self.enter(visit, child));
                continue;
            }
            let back = place.back;
            self.lay(visit, place.along, visit.length + again, again, place.second);
            if visit.returns {
                self.lay_back(visit);
            }
            under_way.pop();
            if let Some((to, flow)) = back {
                let end = if visit.returns { visit.entry } else { visit.on_strand(visit.length) };
                self.over(visit, self.strands[visit.strand].at(end), to, flow);
            }
        }
    }

    /// Goes over to a child.
    fn enter(&mut self, parent: &Visit, child: &Child) -> Place {
        let visit = &self.tree.visits[child.visit];
        let from = self.strands[parent.strand].at(parent.on_strand(child.leave));
        self.over(visit, from, self.strands[visit.strand].at(visit.entry), child.flow);
        let back =
            child.resume.map(|resume| (self.strands[parent.strand].at(parent.on_strand(resume)), child.flow));
        Place { visit: child.visit, next: 0, along: 0.0, second: 0.0, back }
    }

    /// Steps over to a place. The nozzle may stand in a lane beside where the step begins; then the same clay lies on the way
    /// from there.
    fn over(&mut self, visit: &Visit, from: Point, to: Point, flow: f64) {
        let longer = (self.here().distance(to) / from.distance(to).max(1.0)).clamp(0.5, LONGER);
        let feature = self.strands[visit.strand].feature;
        self.step(Step { to, flow: flow / longer, feature });
    }

    fn here(&self) -> Point {
        self.steps.last().map_or(self.start, |last| last.to)
    }

    /// Lays a part of a walk. What is walked twice has half the flow each time: up to `again` and beyond the end, and the
    /// halves of the walk, of which those up to `second` are laid for the second time.
    fn lay(&mut self, visit: &Visit, from: f64, to: f64, again: f64, second: f64) {
        let once = if visit.returns { Lane::Right } else { Lane::Middle };
        let share = if visit.returns { visit.share } else { visit.share / 2.0 };
        let mut stretches = vec![(from, to.min(again), share, Lane::Right)];
        let (mut here, end) = (from.max(again), to.min(visit.length));
        let first = visit.halves.partition_point(|(_, end)| *end <= here);
        for (low, high) in visit.halves[first..].iter().take_while(|(low, _)| *low < end) {
            stretches.push((here, *low, visit.share, once));
            let (from, to) = (here.max(*low), end.min(*high));
            let turn = to.min(second).max(from);
            stretches.push((from, turn, share, Lane::Left));
            stretches.push((turn, to, share, Lane::Right));
            here = to;
        }
        stretches.push((here, end, visit.share, once));
        stretches.push((from.max(visit.length), to, share, Lane::Left));
        for (from, to, share, lane) in stretches {
            if from < to {
                self.stretch(visit, from, to, share, visit.forward, lane);
            }
        }
    }

    /// Lays all of a walk the other way.
    fn lay_back(&mut self, visit: &Visit) {
        self.stretch(visit, 0.0, visit.length, visit.share, !visit.forward, Lane::Right);
    }

    fn stretch(&mut self, visit: &Visit, from: f64, to: f64, share: f64, forward: bool, lane: Lane) {
        let strand = &self.strands[visit.strand];
        let (low, high) = visit.range(from, to);
        let mut points = vec![strand.at(low)];
        let mut flows = Vec::new();
        strand.walk(low, high, |piece| {
            points.push(piece.end);
            flows.push(piece.flow * share);
        });
        if !forward {
            points.reverse();
            flows.reverse();
        }
        let clay = laid(&points, &flows);
        if lane != Lane::Middle {
            let shift = self.tree.spacing / 4.0 * strand.mean_flow().min(1.0);
            points = beside(&points, if lane == Lane::Left { shift } else { -shift });
            // The way over to the lane is part of it, and all of it holds the clay that is due.
            points.insert(0, self.here());
            flows.insert(0, flows.first().copied().unwrap_or(0.0));
            drop_crumbs(&mut points, &mut flows, self.tree.spacing / FINENESS);
            let factor = clay / laid(&points, &flows).max(1.0);
            flows.iter_mut().for_each(|flow| *flow *= factor);
        }
        for (to, flow) in points.into_iter().skip(1).zip(flows) {
            self.step(Step { to, flow, feature: strand.feature });
        }
    }

    /// A step that has no length lays nothing.
    fn step(&mut self, step: Step) {
        if self.here() != step.to {
            self.steps.push(step);
        }
    }
}
