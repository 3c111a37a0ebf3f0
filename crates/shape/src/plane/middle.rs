//! The middle of what is too thin for a bead.
//!
//! What shrinking and growing again by half a bead does not give back is thinner than a bead. Such a piece is
//! triangulated; the middles of the inner sides of its triangles, joined from triangle to triangle, are its middle line
//! (chordal axis: Prasad 1997).

use super::{Offset, Point, Ring, boolean, islands, offset, simplified};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::BTreeMap;

/// A line along the middle of a thin part.
#[derive(Clone, Debug, PartialEq)]
pub struct MiddleLine {
    /// Its points; a closed line repeats its first.
    pub points: Vec<Point>,
    /// How wide the part is at each point, in microns.
    pub widths: Vec<f64>,
}

/// The middle lines of all parts of a region that are thinner than `width` microns.
///
/// `core` is the region shrunk by half the width, which the caller has anyway.
pub fn thin_parts(region: &[Ring], core: &Offset, width: f64) -> Vec<MiddleLine> {
    // A loop that turned inside out and is shorter than this was a corner, not a part; unless it was all of a small part.
    if core.lost < width && !region.iter().any(|ring| ring.length() < 8.0 * width) {
        return Vec::new();
    }
    let area = |rings: &[Ring]| rings.iter().map(|ring| ring.area2() as f64 / 2.0).sum::<f64>();
    let grown = offset(&core.rings, width / 2.0);
    if area(region) - area(&grown) < width * width / 16.0 {
        return Vec::new();
    }
    // Slivers along curves, where shrinking and growing differ by rounding, are no parts, nor tails of parts.
    let sliver = width / 50.0;
    let is_part = |piece: &Vec<Ring>| {
        let around: f64 = piece.iter().map(Ring::length).sum();
        area(piece) >= (width * width / 16.0).max(sliver * around / 2.0)
    };
    let mut lines = Vec::new();
    let rest = islands(&boolean::difference(region, &grown)).into_iter().filter(is_part);
    let parts = rest.flat_map(|piece| islands(&offset(&offset(&piece, -sliver), sliver))).filter(is_part);
    for piece in parts {
        let mut found = middle_lines(&piece, region, width);
        // A line ends before the tip; the clay for the tip goes onto the line.
        let covered: f64 = found.iter().map(MiddleLine::area).sum();
        let share = area(&piece) / covered;
        if covered * MOST < area(&piece) {
            // A stub in a piece as wide as it is long (or no line at all).
            found = dab(&piece, width).into_iter().collect();
        } else {
            found.iter_mut().flat_map(|line| &mut line.widths).for_each(|width| *width *= share.max(LEAST));
        }
        lines.extend(found);
    }
    lines
}

/// How much more or less clay than its own width a middle line takes to fill its piece: more for the tips, less where
/// it runs on into the part beside the piece.
const MOST: f64 = 1.7;
const LEAST: f64 = 0.7;

impl MiddleLine {
    /// What it covers, in square microns.
    pub fn area(&self) -> f64 {
        let stretches = self.points.windows(2).zip(self.widths.windows(2));
        stretches.map(|(ends, widths)| ends[0].distance(ends[1]) * f64::midpoint(widths[0], widths[1])).sum()
    }

    /// Its parts that are at least so many microns wide and cover at least the square of that.
    pub fn wider_than(&self, least: f64) -> Vec<Self> {
        let empty = || Self { points: Vec::new(), widths: Vec::new() };
        let (mut parts, mut part) = (Vec::new(), empty());
        let add = |part: &mut Self, at: usize, share: f64| {
            let along = |from: i32, to: i32| {
                (f64::from(from) + share * (f64::from(to) - f64::from(from))).round() as i32
            };
            let (from, to) = (self.points[at], self.points[if share > 0.0 { at + 1 } else { at }]);
            part.points.push(Point::new(along(from.x, to.x), along(from.y, to.y)));
            part.widths.push(if share > 0.0 { least } else { self.widths[at] });
        };
        for at in 0..self.points.len() {
            let here = self.widths[at];
            if here >= least {
                add(&mut part, at, 0.0);
            }
            let Some(next) = self.widths.get(at + 1) else { break };
            if (here >= least) != (*next >= least) {
                add(&mut part, at, (least - here) / (next - here));
                if here >= least {
                    parts.push(std::mem::replace(&mut part, empty()));
                }
            }
        }
        parts.push(part);
        parts.retain(|part| part.area() >= least * least);
        parts
    }
}

/// The line for a piece that is about as long as it is wide, as wide as it takes to fill it: a ring half as large as the piece,
/// or where that would be narrower than a third of `width`, a stretch half as long. The piece is one outside, first, with its
/// holes.
pub fn dab(piece: &[Ring], width: f64) -> Option<MiddleLine> {
    let ring = piece.first()?;
    let area: f64 = piece.iter().map(|ring| ring.area2() as f64 / 2.0).sum();
    let count = ring.0.len() as f64;
    let mean = |of: fn(&Point) -> i32| ring.0.iter().map(|point| f64::from(of(point))).sum::<f64>() / count;
    let centre = (mean(|point| point.x), mean(|point| point.y));
    let towards = |point: &Point, share: f64| {
        let at = |centre: f64, place: i32| (centre + share * (f64::from(place) - centre)).round() as i32;
        Point::new(at(centre.0, point.x), at(centre.1, point.y))
    };
    let half = Ring(ring.0.iter().map(|point| towards(point, 0.5)).collect());
    if let Some(half) = simplified(&half, width / 40.0).filter(|half| area >= width / 3.0 * half.length()) {
        let widths = vec![area / half.length(); half.0.len() + 1];
        let points = half.0.iter().chain(half.0.first()).copied().collect();
        return Some(MiddleLine { points, widths });
    }
    // Along the farthest corner: the longest way through.
    let far =
        ring.0.iter().max_by_key(|point| point.distance2(Point::new(centre.0 as i32, centre.1 as i32)))?;
    let ends = [towards(far, -0.5), towards(far, 0.5)];
    let length = ends[0].distance(ends[1]);
    (length >= 1.0).then(|| MiddleLine { points: ends.to_vec(), widths: vec![area / length; 2] })
}

/// The graph of the middle: nodes are middles of triangle sides or of triangles where three branches meet.
#[derive(Default)]
struct Axis {
    places: Vec<(f64, f64)>,
    joints: Vec<Vec<usize>>,
}

impl Axis {
    fn node(&mut self, place: (f64, f64)) -> usize {
        self.places.push(place);
        self.joints.push(Vec::new());
        self.places.len() - 1
    }

    fn join(&mut self, one: usize, other: usize) {
        self.joints[one].push(other);
        self.joints[other].push(one);
    }

    fn distance(&self, one: usize, other: usize) -> f64 {
        length((self.places[one].0 - self.places[other].0, self.places[one].1 - self.places[other].1))
    }
}

fn middle_lines(piece: &[Ring], region: &[Ring], width: f64) -> Vec<MiddleLine> {
    let Some(axis) = axis(piece, width) else { return Vec::new() };
    let mut lines = Vec::new();
    for path in paths(&axis) {
        let length: f64 = path.windows(2).map(|pair| axis.distance(pair[0], pair[1])).sum();
        let closed = path.first() == path.last();
        // A twig of the axis reaches into every corner; what counts is longer than it is wide.
        if length < width / 2.0 && !closed {
            continue;
        }
        let places: Vec<(f64, f64)> = path.iter().map(|node| axis.places[*node]).collect();
        let halves: Vec<f64> = places.iter().map(|place| distance_to(region, *place)).collect();
        let (from, to) = if closed { (0, places.len() - 1) } else { without_tips(&places, &halves) };
        let kept = straightened(&places[from..=to], width / 40.0);
        let point = |index: &usize| {
            let (x, y) = places[from + index];
            Point::new(x.round() as i32, y.round() as i32)
        };
        let points: Vec<Point> = kept.iter().map(point).collect();
        let widths = kept.iter().map(|index| (2.0 * halves[from + index]).min(width)).collect();
        lines.push(MiddleLine { points, widths });
    }
    lines
}

/// The chordal axis of a piece; `None` when it cannot be triangulated.
fn axis(piece: &[Ring], width: f64) -> Option<Axis> {
    let mut mesh: ConstrainedDelaunayTriangulation<Point2<f64>> = ConstrainedDelaunayTriangulation::new();
    for ring in piece {
        let mut handles = Vec::new();
        for (from, to) in ring.segments() {
            // Long sides are cut so that triangles across the piece are about as long as it is wide.
            let cuts = (from.distance(to) / (width / 4.0)).ceil().max(1.0) as u32;
            for cut in 0..cuts {
                let share = f64::from(cut) / f64::from(cuts);
                let at = |a: i32, b: i32| f64::from(a) + share * (f64::from(b) - f64::from(a));
                handles.push(mesh.insert(Point2::new(at(from.x, to.x), at(from.y, to.y))).ok()?);
            }
        }
        handles.dedup();
        for index in 0..handles.len() {
            let (from, to) = (handles[index], handles[(index + 1) % handles.len()]);
            if from != to && mesh.can_add_constraint(from, to) {
                mesh.add_constraint(from, to);
            }
        }
    }
    let mut axis = Axis::default();
    // In the order of the mesh's own numbers, which depend on nothing but the points.
    let mut nodes: BTreeMap<usize, usize> = BTreeMap::new();
    for face in mesh.inner_faces() {
        let corners = face.positions();
        let middle = Point::new(
            ((corners[0].x + corners[1].x + corners[2].x) / 3.0).round() as i32,
            ((corners[0].y + corners[1].y + corners[2].y) / 3.0).round() as i32,
        );
        if piece.iter().filter(|ring| ring.contains(middle)).count() % 2 == 0 {
            continue;
        }
        let mut inner = Vec::new();
        for edge in face.adjacent_edges() {
            if !edge.is_constraint_edge() {
                let [a, b] = edge.positions();
                let id = edge.as_undirected().fix().index();
                let place = (f64::midpoint(a.x, b.x), f64::midpoint(a.y, b.y));
                inner.push(*nodes.entry(id).or_insert_with(|| axis.node(place)));
            }
        }
        match inner[..] {
            [one, other] => axis.join(one, other),
            [one, other, third] => {
                let middle = axis.node((
                    (corners[0].x + corners[1].x + corners[2].x) / 3.0,
                    (corners[0].y + corners[1].y + corners[2].y) / 3.0,
                ));
                [one, other, third].into_iter().for_each(|node| axis.join(middle, node));
            }
            _ => {}
        }
    }
    Some(axis)
}

/// Cuts the axis into paths: from ends and junctions to ends and junctions, then what is left as loops.
fn paths(axis: &Axis) -> Vec<Vec<usize>> {
    let mut walked: std::collections::BTreeSet<(usize, usize)> = std::collections::BTreeSet::new();
    let key = |one: usize, other: usize| (one.min(other), one.max(other));
    let mut paths = Vec::new();
    let stops = (0..axis.joints.len()).filter(|node| axis.joints[*node].len() != 2);
    let loops = (0..axis.joints.len()).filter(|node| axis.joints[*node].len() == 2);
    for start in stops.chain(loops) {
        for &first in &axis.joints[start] {
            if !walked.insert(key(start, first)) {
                continue;
            }
            let mut path = vec![start, first];
            let mut here = first;
            while here != start && axis.joints[here].len() == 2 {
                let before = path[path.len() - 2];
                let next =
                    if axis.joints[here][0] == before { axis.joints[here][1] } else { axis.joints[here][0] };
                if !walked.insert(key(here, next)) {
                    break;
                }
                path.push(next);
                here = next;
            }
            paths.push(path);
        }
    }
    paths
}

/// The part of a line whose ends are not pulled aside by the corners of a blunt tip.
///
/// At a tip the outline is nearer than it is along the part; a bead that ends half its width before the tip fills it.
fn without_tips(places: &[(f64, f64)], halves: &[f64]) -> (usize, usize) {
    let last = places.len() - 1;
    let typical = halves[last / 2];
    let within = |index: &usize| halves[*index] >= 0.9 * typical;
    let from = (0..=last / 2).find(within).unwrap_or(0);
    let to = (last / 2..=last).rev().find(within).unwrap_or(last);
    if from < to { (from, to) } else { (0, last) }
}

/// Which points of a line stay when those nearer than `tolerance` to the line through their neighbours go (Douglas and Peucker 1973).
fn straightened(places: &[(f64, f64)], tolerance: f64) -> Vec<usize> {
    let mut keep = vec![false; places.len()];
    let last = places.len() - 1;
    // A closed line has no chord to start from; its middle serves.
    let mut spans =
        if places[0] == places[last] { vec![(0, last / 2), (last / 2, last)] } else { vec![(0, last)] };
    for (from, to) in &spans {
        (keep[*from], keep[*to]) = (true, true);
    }
    while let Some((from, to)) = spans.pop() {
        let mut worst = (tolerance, None);
        for index in from + 1..to {
            let gap = distance_to_segment(places[from], places[to], places[index]);
            if gap > worst.0 {
                worst = (gap, Some(index));
            }
        }
        if let Some(middle) = worst.1 {
            keep[middle] = true;
            spans.extend([(from, middle), (middle, to)]);
        }
    }
    (0..places.len()).filter(|index| keep[*index]).collect()
}

fn distance_to(rings: &[Ring], place: (f64, f64)) -> f64 {
    let float = |point: Point| (f64::from(point.x), f64::from(point.y));
    rings
        .iter()
        .flat_map(Ring::segments)
        .map(|(from, to)| distance_to_segment(float(from), float(to), place))
        .fold(f64::INFINITY, f64::min)
}

fn distance_to_segment(from: (f64, f64), to: (f64, f64), place: (f64, f64)) -> f64 {
    let (along, reach) = ((to.0 - from.0, to.1 - from.1), (place.0 - from.0, place.1 - from.1));
    let length2 = along.0 * along.0 + along.1 * along.1;
    let share =
        if length2 > 0.0 { ((along.0 * reach.0 + along.1 * reach.1) / length2).clamp(0.0, 1.0) } else { 0.0 };
    length((reach.0 - share * along.0, reach.1 - share * along.1))
}

/// The length of a vector. (`f64::hypot` differs between platforms.)
fn length((x, y): (f64, f64)) -> f64 {
    (x * x + y * y).sqrt()
}
