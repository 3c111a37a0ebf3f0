//! Goes round a tree of strands and lays everything once.

use crate::sheet::{Path, Step};
use crate::strand::Strand;
use crate::tree::{Child, Tree, Visit};
use skein::Point;

/// The thread that goes round a tree. The last of a closed root, as long as `rise` in microns, is its closing.
pub fn path(strands: &[Strand], tree: &Tree, rise: f64) -> Path {
    let Some(root) = tree.visits.first() else { return Path::default() };
    let mut walker = Walker { strands, tree, steps: Vec::new() };
    walker.run();
    let start = strands[root.strand].at(root.entry);
    let mut path = Path { start, steps: walker.steps, closing: None, flows_on: false };
    if path.start == path.end() && strands[root.strand].closed {
        close(&mut path, rise);
    }
    path
}

/// Takes the closing off a path that ends where it begins.
fn close(path: &mut Path, rise: f64) {
    let mut left = rise;
    while path.steps.len() > 4 && left > 0.0 {
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

struct Walker<'a> {
    strands: &'a [Strand],
    tree: &'a Tree,
    steps: Vec<Step>,
}

/// A visit under way.
struct Place {
    visit: usize,
    /// The next child.
    next: usize,
    /// How far the walk has come.
    along: f64,
    /// Where to go, and with what flow, when it is over.
    back: Option<(Point, f64)>,
}

impl Walker<'_> {
    /// A tree may be as deep as there are strands, so what is under way is kept in a list.
    fn run(&mut self) {
        let mut under_way = vec![Place { visit: 0, next: 0, along: 0.0, back: None }];
        while let Some(place) = under_way.last_mut() {
            let (tree, index) = (self.tree, place.visit);
            let visit = &tree.visits[index];
            let again = if index == 0 { tree.again } else { 0.0 };
            if let Some(child) = visit.children.get(place.next) {
                let from = std::mem::replace(&mut place.along, child.resume.unwrap_or(f64::INFINITY));
                place.next += 1;
                self.lay(visit, from, child.leave, again);
                under_way.push(self.enter(visit, child));
                continue;
            }
            let back = place.back;
            self.lay(visit, place.along, visit.length + again, again);
            if visit.returns {
                self.lay_back(visit);
            }
            under_way.pop();
            if let Some((to, flow)) = back {
                self.over(visit, to, flow);
            }
        }
    }

    /// Goes over to a child.
    fn enter(&mut self, parent: &Visit, child: &Child) -> Place {
        let visit = &self.tree.visits[child.visit];
        self.over(visit, self.strands[visit.strand].at(visit.entry), child.flow);
        let back =
            child.resume.map(|resume| (self.strands[parent.strand].at(parent.on_strand(resume)), child.flow));
        Place { visit: child.visit, next: 0, along: 0.0, back }
    }

    fn over(&mut self, visit: &Visit, to: Point, flow: f64) {
        let feature = self.strands[visit.strand].feature;
        self.step(Step { to, flow, feature });
    }

    /// Lays a part of a walk. What is walked twice, up to `again` and beyond the end, has half the flow each time.
    fn lay(&mut self, visit: &Visit, from: f64, to: f64, again: f64) {
        for (from, to, share) in [
            (from, to.min(again), 0.5),
            (from.max(again), to.min(visit.length), 1.0),
            (from.max(visit.length), to, 0.5),
        ] {
            if from < to {
                self.stretch(visit, from, to, visit.share * share, visit.forward);
            }
        }
    }

    fn lay_back(&mut self, visit: &Visit) {
        self.stretch(visit, 0.0, visit.length, visit.share, !visit.forward);
    }

    fn stretch(&mut self, visit: &Visit, from: f64, to: f64, share: f64, forward: bool) {
        let strand = &self.strands[visit.strand];
        let (low, high) = visit.range(from, to);
        let mut pieces = Vec::new();
        strand.walk(low, high, |piece| pieces.push(piece));
        let feature = strand.feature;
        if forward {
            for piece in pieces {
                self.step(Step { to: strand.at(piece.to), flow: piece.flow * share, feature });
            }
        } else {
            for piece in pieces.into_iter().rev() {
                self.step(Step { to: strand.at(piece.from), flow: piece.flow * share, feature });
            }
        }
    }

    /// A step that has no length lays nothing.
    fn step(&mut self, step: Step) {
        if self.steps.last().is_none_or(|last| last.to != step.to) {
            self.steps.push(step);
        }
    }
}
