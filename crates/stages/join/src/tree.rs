//! Which strands of an island are joined, and where.
//!
//! Strands that lie beside each other become a tree: each is visited from another, at a place where the two are a bead
//! apart. A thread that goes round the tree lays everything once and never stops. There are three kinds of joint:
//!
//! * A **rung** joins a closed strand to one that runs beside it. Both leave out half a bead, and the clay of that is what
//!   the two steps over are made of.
//! * An **arch** is an open strand with both ends beside the same walk, which goes on through it.
//! * A **stem** goes to a strand and comes back the same way. What is gone over twice is two half beads side by side; the
//!   clay of the way is taken from the strand.

use crate::fence::Fence;
use crate::grid::{Grid, Near, Side};
use crate::strand::Strand;
use crate::visit::{Child, Tree, Visit};
use skein::{Feature, Point, Ring};
use std::collections::{BTreeMap, VecDeque};
use std::ops::Range;

/// Where a tree begins.
#[derive(Clone, Copy, Debug)]
pub struct Start {
    /// The seam.
    pub place: Point,
    /// Whether it must be there, even if a part of a wall is then laid in two halves.
    pub fixed: bool,
}

/// How far beside each other two strands may lie to be joined, in bead spacings: neighbours lie one apart, a little more
/// where the part is a little wider.
const BESIDE: f64 = 1.4;
/// How far an open end may be from what it is joined to, in bead spacings: a row of infill may end almost a spacing before
/// the wall's next neighbour.
pub const REACH: f64 = 2.0;

/// How far a bridge may reach to what is beside nothing, in bead spacings: over the empty inside of a wall four beads thick.
const BRIDGE: f64 = 3.5;

/// An island that is being joined.
pub struct Weave<'a> {
    strands: &'a [Strand],
    sides: Grid,
    outlines: Fence<'a>,
    spacing: f64,
    visited: Vec<bool>,
    /// What each strand's ends are near to, and which ends are near to each strand.
    ends: Vec<Vec<EndContact>>,
    closed_left: usize,
    /// What was left when a bridge was first looked for.
    far: Option<Grid>,
}

/// An end of an open strand beside another strand.
#[derive(Clone, Copy, Debug)]
struct EndContact {
    /// How far along this strand.
    here: f64,
    /// The other strand.
    other: usize,
    /// How far along it.
    there: f64,
}

impl<'a> Weave<'a> {
    /// Finds what lies beside what; the spacing of the beads is in microns.
    pub fn new(strands: &'a [Strand], outlines: &'a [Ring], spacing: f64) -> Self {
        let reach = REACH * spacing;
        // Nothing is looked for on the only strand that is open, and it is the one with the longest sides.
        let open = strands.iter().filter(|strand| !strand.closed).count();
        let wanted = strands.iter().enumerate().filter(|(_, strand)| strand.closed || open > 1);
        let sides = Grid::new(wanted.flat_map(|(owner, strand)| sides(owner, strand)), reach);
        let outlines = Fence::new(outlines, reach);
        let closed_left = strands.iter().filter(|strand| strand.closed).count();
        let visited = vec![false; strands.len()];
        let ends = vec![Vec::new(); strands.len()];
        let mut weave = Self { strands, sides, outlines, spacing, visited, ends, closed_left, far: None };
        weave.find_ends();
        weave
    }

    /// Of every end of an open strand the nearest strand, the nearest wall and the nearest wall that is not seen: where
    /// several open strands meet, the nearest is often another that leads nowhere. And what is beside one end and the other
    /// as well.
    fn find_ends(&mut self) {
        for (index, strand) in self.strands.iter().enumerate().filter(|(_, strand)| !strand.closed) {
            let places = [0.0, strand.length()];
            let mut beside = places.map(|here| {
                let mut found: Vec<Near> = Vec::with_capacity(4);
                let mut add = |near: Option<Near>| found.extend(near.filter(|near| !found.contains(near)));
                add(self.beside_end(index, here, |_| true));
                add(self.beside_end(index, here, |other| self.strands[other].closed));
                add(self.beside_end(index, here, |other| {
                    self.strands[other].closed && !is_edge(&self.strands[other])
                }));
                found.retain(|near| self.is_inside(index, here, near));
                found
            });
            for (end, here) in places.iter().enumerate() {
                for other in beside[1 - end].clone() {
                    let is_new = beside[end].iter().all(|near| near.owner != other.owner);
                    let near = is_new
                        .then(|| self.beside_end(index, *here, |owner| owner == other.owner as usize))
                        .flatten();
                    beside[end].extend(near.filter(|near| {
                        near.distance <= BESIDE * self.spacing && self.is_inside(index, *here, near)
                    }));
                }
            }
            for (here, found) in places.into_iter().zip(beside) {
                for near in found {
                    let (other, there) = (near.owner as usize, near.along);
                    self.ends[index].push(EndContact { here, other, there });
                    self.ends[other].push(EndContact { here: there, other: index, there: here });
                }
            }
        }
    }

    /// What an end of an open strand is nearest to.
    fn beside_end(&self, index: usize, here: f64, wanted: impl Fn(usize) -> bool) -> Option<Near> {
        let wanted = |other: u32| other as usize != index && wanted(other as usize);
        self.sides.nearest(self.strands[index].at(here), wanted)
    }

    /// Whether the way from an end of a strand to what is near it crosses no outline.
    fn is_inside(&self, index: usize, here: f64, near: &Near) -> bool {
        let there = self.strands[near.owner as usize].at(near.along);
        !self.outlines.is_crossed(self.strands[index].at(here), there)
    }

    /// The trees of the island: the first begins at the seam, each further one near it.
    pub fn trees(mut self, seam: Start) -> Vec<Tree> {
        let mut trees: Vec<Tree> = Vec::new();
        loop {
            let Some(tree) = self.tree(Start { fixed: seam.fixed && trees.is_empty(), ..seam }) else {
                return trees;
            };
            trees.push(tree);
        }
    }

    fn tree(&mut self, start: Start) -> Option<Tree> {
        let seam = start.place;
        let longest = |one: &usize, other: &usize| {
            let length = |index: usize| self.strands[index].length();
            length(*one).total_cmp(&length(*other)).then(other.cmp(one))
        };
        let open =
            || (0..self.strands.len()).filter(|index| !self.visited[*index] && !self.strands[*index].closed);
        // The longest open strand is laid last and once; it would cost most to go back over.
        let on_wall = |index: &usize| self.ends[*index].iter().any(|end| self.is_free_wall(end.other));
        let tail = open().filter(on_wall).max_by(longest);
        let root = match tail {
            Some(tail) => return Some(self.with_tail(tail, start)),
            None => match self.nearest_closed(seam) {
                Some(wall) => {
                    let entry = self.nearest_on(wall, seam);
                    self.root(wall, entry, true)
                }
                None => {
                    let strand = open().max_by(longest)?;
                    let ends = [0.0, self.strands[strand].length()];
                    let gap = |along: f64| seam.distance2(self.strands[strand].at(along));
                    let forward = gap(ends[0]) <= gap(ends[1]);
                    self.root(strand, if forward { ends[0] } else { ends[1] }, forward)
                }
            },
        };
        let mut tree = Tree { visits: vec![root], again: 0.0, spacing: self.spacing };
        self.grow(&mut tree, VecDeque::from([0]), seam);
        Some(tree)
    }

    /// A tree that begins on a wall and ends with an open strand. From its seam the wall is walked all the way round, and
    /// on to where the open strand begins; where the seam may be anywhere it is there.
    fn with_tail(&mut self, tail: usize, start: Start) -> Tree {
        let seam = start.place;
        // Not on the wall that is seen, if there is another; then with the shortest way on it, or to it.
        let mut best: Option<(bool, f64, EndContact, f64, f64, bool)> = None;
        for end in self.ends[tail].iter().filter(|end| self.is_free_wall(end.other)) {
            let entry = if start.fixed { self.nearest_on(end.other, seam) } else { end.there };
            let ahead = self.strands[end.other].wrapped(end.there - entry);
            let behind = self.strands[end.other].length() - ahead;
            let (again, forward) = if ahead <= behind { (ahead, true) } else { (behind, false) };
            let way = if start.fixed { again } else { seam.distance(self.strands[end.other].at(end.there)) };
            let seen = is_edge(&self.strands[end.other]);
            if best.is_none_or(|(edge, least, ..)| (seen, way) < (edge, least)) {
                best = Some((seen, way, *end, entry, again, forward));
            }
        }
        let Some((_, _, end, entry, again, forward)) = best else {
            return Tree { visits: Vec::new(), again: 0.0, spacing: self.spacing };
        };
        let root = self.root(end.other, entry, forward);
        let whole = self.strands[tail].length();
        let gap = self.strands[tail].at(end.here).distance(self.strands[end.other].at(end.there));
        let share = whole / (whole + gap);
        let mut visit = self.root(tail, end.here, end.here == 0.0);
        visit.share = share;
        let flow = self.strands[tail].mean_flow() * share;
        let mut tree = Tree { visits: vec![root, visit], again, spacing: self.spacing };
        let leave = self.strands[end.other].length() + again;
        tree.visits[0].adopt(Child { leave, resume: None, flow, visit: 1 });
        self.grow(&mut tree, VecDeque::from([0, 1]), seam);
        tree
    }

    fn root(&mut self, strand: usize, entry: f64, forward: bool) -> Visit {
        self.take(strand);
        let length = self.strands[strand].length();
        Visit {
            strand,
            entry,
            forward,
            length,
            returns: false,
            share: 1.0,
            children: Vec::new(),
            halves: Vec::new(),
        }
    }

    fn take(&mut self, strand: usize) {
        self.visited[strand] = true;
        self.closed_left -= usize::from(self.strands[strand].closed);
    }

    fn is_free_wall(&self, strand: usize) -> bool {
        self.strands[strand].closed && !self.visited[strand]
    }

    fn nearest_closed(&self, seam: Point) -> Option<usize> {
        let gap = |index: usize| {
            self.strands[index].points().iter().map(|point| seam.distance2(*point)).min().unwrap_or(i64::MAX)
        };
        (0..self.strands.len()).filter(|index| self.is_free_wall(*index)).min_by_key(|index| gap(*index))
    }

    fn nearest_on(&self, strand: usize, seam: Point) -> f64 {
        let sides = self.strands[strand].sides();
        let near = sides.map(|(start, from, to)| {
            let (share, distance) = Side { owner: 0, start, from, to }.nearest(seam);
            (distance, start + share * from.distance(to))
        });
        near.min_by(|one, other| one.0.total_cmp(&other.0)).map_or(0.0, |(_, along)| along)
    }

    /// Adds everything that can be reached, strand by strand, and then what a bridge leads to.
    fn grow(&mut self, tree: &mut Tree, mut queue: VecDeque<usize>, seam: Point) {
        let mut bridged = 0;
        loop {
            while let Some(visit) = queue.pop_front() {
                self.add_walls(tree, visit, seam, &mut queue);
                self.add_ends(tree, visit, &mut queue);
            }
            if self.visited.iter().all(|visited| *visited) || bridged == tree.visits.len() {
                return;
            }
            let parents = bridged..tree.visits.len();
            bridged = parents.end;
            self.bridge(tree, parents, &mut queue);
        }
    }

    /// Leads from strands to all that lie within a bridge of them, each by its shortest way.
    fn bridge(&mut self, tree: &mut Tree, parents: Range<usize>, queue: &mut VecDeque<usize>) {
        let reach = BRIDGE * self.spacing;
        let (strands, visited) = (self.strands, &self.visited);
        let far = self.far.get_or_insert_with(|| {
            let left = strands.iter().enumerate().filter(|(index, _)| !visited[*index]);
            Grid::new(left.flat_map(|(owner, strand)| sides(owner, strand)), reach)
        });
        let mut shortest: BTreeMap<u32, (usize, f64, Near)> = BTreeMap::new();
        for parent in parents {
            let visit = &tree.visits[parent];
            let steps = (visit.length / self.spacing).ceil().max(1.0);
            for step in 0..=steps as usize {
                let leave = visit.free_near(visit.length * step as f64 / steps);
                let at = strands[visit.strand].at(visit.on_strand(leave));
                let Some(near) = far.nearest(at, |other| !visited[other as usize]) else { continue };
                let place = strands[near.owner as usize].at(near.along);
                let nearer = shortest.get(&near.owner).is_none_or(|best| near.distance < best.2.distance);
                if nearer && !self.outlines.is_crossed(at, place) {
                    shortest.insert(near.owner, (parent, leave, near));
                }
            }
        }
        for (owner, (parent, leave, near)) in shortest {
            let strand = &strands[owner as usize];
            // An open strand is entered at one of its ends.
            let whole = strand.length();
            let entry = match strand.closed {
                true => near.along,
                false if near.along < whole / 2.0 => 0.0,
                false => whole,
            };
            let (from, to) = (self.place(&tree.visits[parent], leave), strand.at(entry));
            if from.distance(to) <= reach && !self.outlines.is_crossed(from, to) {
                self.stem(tree, parent, leave, owner as usize, entry, queue);
            }
        }
    }

    /// Open ends beside the strand, and what is beside its own ends.
    fn add_ends(&mut self, tree: &mut Tree, parent: usize, queue: &mut VecDeque<usize>) {
        let contacts = self.ends[tree.visits[parent].strand].clone();
        for contact in contacts {
            if self.visited[contact.other] || self.arch(tree, parent, contact.other, queue) {
                continue;
            }
            let visit = &tree.visits[parent];
            let leave = visit.free_near(self.along_walk(visit, contact.here));
            let (from, to) = (self.place(visit, leave), self.strands[contact.other].at(contact.there));
            if !self.outlines.is_crossed(from, to) {
                self.stem(tree, parent, leave, contact.other, contact.there, queue);
            }
        }
    }

    /// Takes an open strand in on the way, when both of its ends are beside the walk. Where they are a bead or two apart,
    /// the walk between them is left out; where they are farther, that stretch is laid in two halves, if it is shorter than
    /// the strand.
    fn arch(&mut self, tree: &mut Tree, parent: usize, strand: usize, queue: &mut VecDeque<usize>) -> bool {
        let visit = &tree.visits[parent];
        let whole = self.strands[strand].length();
        let contact = |there: f64| {
            let ends = self.ends[strand].iter();
            ends.filter(|end| end.other == visit.strand && end.here == there)
                .map(|end| self.along_walk(visit, end.there))
                .next()
        };
        let (Some(start), Some(end)) = (contact(0.0), contact(whole)) else { return false };
        let (low, high) = (start.min(end), start.max(end));
        let again = if parent == 0 { tree.again } else { 0.0 };
        if self.strands[strand].closed || visit.returns || low < again || !visit.is_free(low, high) {
            return false;
        }
        let short = high - low <= ARCH * self.spacing;
        if !short && high - low >= whole {
            return false;
        }
        let (leave, resume) = if short { (low, high) } else { (high, low) };
        let entry = if leave == start { 0.0 } else { whole };
        let ways = [(leave, entry), (resume, whole - entry)]
            .map(|(on_walk, on_strand)| (self.place(visit, on_walk), self.strands[strand].at(on_strand)));
        if ways.iter().any(|(from, to)| self.outlines.is_crossed(*from, *to)) {
            return false;
        }
        // The ways over take their clay from what is left out and from the strand.
        let left_out = if short { self.laid(visit, low, high) * visit.share } else { 0.0 };
        let over: f64 = ways.iter().map(|(from, to)| from.distance(*to)).sum();
        let (clay, mean) = (self.strands[strand].laid(0.0, whole), self.strands[strand].mean_flow());
        let share = (clay + left_out) / (clay + over * mean).max(1.0);
        if (share - 1.0).abs() > MOST {
            return false;
        }
        let mut visit = self.root(strand, entry, entry == 0.0);
        visit.share = share;
        let index = tree.visits.len();
        tree.visits.push(visit);
        tree.visits[parent].adopt(Child { leave, resume: Some(resume), flow: mean * share, visit: index });
        queue.push_back(index);
        true
    }

    /// Goes to a strand and comes back.
    fn stem(
        &mut self,
        tree: &mut Tree,
        parent: usize,
        leave: f64,
        strand: usize,
        entry: f64,
        queue: &mut VecDeque<usize>,
    ) {
        let gap = self.place(&tree.visits[parent], leave).distance(self.strands[strand].at(entry));
        let whole = self.strands[strand].length();
        let open = !self.strands[strand].closed;
        let taken = whole / (whole + gap);
        let forward = !open || entry < whole / 2.0;
        let mut visit = self.root(strand, entry, forward);
        visit.returns = open;
        visit.share = if open { taken / 2.0 } else { taken };
        let flow = self.strands[strand].mean_flow() * taken / 2.0;
        let index = tree.visits.len();
        tree.visits.push(visit);
        tree.visits[parent].adopt(Child { leave, resume: Some(leave), flow, visit: index });
        queue.push_back(index);
    }

    /// Closed strands beside the strand, looked for from the place nearest to the seam outwards.
    fn add_walls(&mut self, tree: &mut Tree, parent: usize, seam: Point, queue: &mut VecDeque<usize>) {
        if self.closed_left == 0 {
            return;
        }
        let reach = BESIDE * self.spacing;
        let length = tree.visits[parent].length;
        let middle = {
            let visit = &tree.visits[parent];
            self.along_walk(visit, self.nearest_on(visit.strand, seam))
        };
        let mut beside: Vec<(f64, Near)> = Vec::new();
        for leave in outwards(middle, length, self.spacing / 2.0) {
            let at = self.place(&tree.visits[parent], leave);
            let near = self.sides.nearest(at, |other| self.is_free_wall(other as usize));
            let Some(near) = near.filter(|near| near.distance <= reach) else { continue };
            beside.push((leave, near));
            // A step over should not cross the second lane of what is laid twice.
            if parent != 0 || leave >= tree.again {
                self.rung(tree, parent, leave, near, EVEN, queue);
            }
            if self.closed_left == 0 {
                return;
            }
        }
        for (leave, near) in &beside {
            self.rung(tree, parent, *leave, *near, UNEVEN, queue);
        }
        // What is too small or too crooked for a rung.
        for (leave, near) in beside {
            let strand = near.owner as usize;
            let leave = tree.visits[parent].free_near(leave);
            let at = self.place(&tree.visits[parent], leave);
            let inside = !self.outlines.is_crossed(at, self.strands[strand].at(near.along));
            if !self.visited[strand] && inside {
                self.stem(tree, parent, leave, strand, near.along, queue);
            }
        }
    }

    /// Joins a closed strand to one that runs beside it here, if the two are as far apart as beads are.
    fn rung(
        &mut self,
        tree: &mut Tree,
        parent: usize,
        leave: f64,
        near: Near,
        tolerance: f64,
        queue: &mut VecDeque<usize>,
    ) {
        if self.visited[near.owner as usize] {
            return;
        }
        let visit = &tree.visits[parent];
        let child = &self.strands[near.owner as usize];
        let resume = leave + RUNG * self.spacing;
        if resume > visit.length || !visit.is_free(leave, resume) {
            return;
        }
        let back = self.place(visit, resume);
        let Some(other) = self.sides.nearest(back, |owner| owner == near.owner) else { return };
        // The short way between the two places is left out, the long way is walked.
        let whole = child.length();
        let ahead = child.wrapped(other.along - near.along);
        let (short, forward) = if ahead <= whole / 2.0 { (ahead, false) } else { (whole - ahead, true) };
        let even = |length: f64, beads: f64| (length / (beads * self.spacing) - 1.0).abs() <= tolerance;
        let (from, to) = (self.place(visit, leave), back);
        let (enter, exit) = (child.at(near.along), child.at(other.along));
        if !(even(short, RUNG) && even(near.distance, 1.0) && even(other.distance, 1.0))
            || whole < 3.0 * self.spacing
            || self.outlines.is_crossed(from, enter)
            || self.outlines.is_crossed(exit, to)
        {
            return;
        }
        let first = if forward { other.along } else { near.along };
        // Of what is walked twice only the half of the first time is left out.
        let again = if parent == 0 { tree.again } else { 0.0 };
        let (once, twice) =
            (self.laid(visit, leave.max(again), resume), self.laid(visit, leave, resume.min(again)));
        let left_out = child.laid(first, first + short) + (once + twice / 2.0) * visit.share;
        let flow = left_out / (from.distance(enter) + exit.distance(to)).max(1.0);
        if (flow / RUNG - 1.0).abs() > MOST {
            return;
        }
        let strand = near.owner as usize;
        let mut visit = self.root(strand, near.along, forward);
        visit.length = whole - short;
        let index = tree.visits.len();
        tree.visits.push(visit);
        tree.visits[parent].adopt(Child { leave, resume: Some(resume), flow, visit: index });
        queue.push_back(index);
    }

    /// Length times flow of a part of a walk.
    fn laid(&self, visit: &Visit, from: f64, to: f64) -> f64 {
        if to <= from {
            return 0.0;
        }
        let (from, to) = visit.range(from, to);
        self.strands[visit.strand].laid(from, to)
    }

    fn place(&self, visit: &Visit, along: f64) -> Point {
        self.strands[visit.strand].at(visit.on_strand(along))
    }

    /// How far along a walk a place of its strand is.
    fn along_walk(&self, visit: &Visit, on_strand: f64) -> f64 {
        let way = if visit.forward { on_strand - visit.entry } else { visit.entry - on_strand };
        self.strands[visit.strand].wrapped(way)
    }
}

/// How far apart the two steps over of a rung are, in bead spacings. The beads on both sides then reach so near to each other
/// that their round ends leave no hole; what each step over has for itself is as wide, and its flow is that share of a bead.
const RUNG: f64 = 0.5;
/// What a rung leaves out is as long as that, and its steps as long as beads are apart, or so much longer or shorter.
const EVEN: f64 = 0.15;
/// The same where no place is better.
const UNEVEN: f64 = 0.5;
/// How far apart on a walk the ends of a strand may be for the walk between them to be left out, in bead spacings.
const ARCH: f64 = 1.5;
/// The flow of a step over is within so much of a bead's.
const MOST: f64 = 0.6;

/// The sides of a strand.
fn sides(owner: usize, strand: &Strand) -> impl Iterator<Item = Side> {
    strand.sides().map(move |(start, from, to)| Side { owner: owner as u32, start, from, to })
}

/// Whether a strand is seen from outside.
fn is_edge(strand: &Strand) -> bool {
    matches!(strand.feature, Feature::Edge(_))
}

/// Places along a length from a middle outwards, a step apart.
fn outwards(middle: f64, length: f64, step: f64) -> impl Iterator<Item = f64> {
    let count = (length / step).ceil() as i64;
    (0..=2 * count)
        .map(move |index| {
            let side = if index % 2 == 0 { 1.0 } else { -1.0 };
            middle + side * ((index + 1) / 2) as f64 * step
        })
        .filter(move |place| (0.0..=length).contains(place))
}
