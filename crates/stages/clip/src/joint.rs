//! Whether there is room for a joint between two loops.

use skein::{Line, Nozzle, Point3, boundary};

/// What lies on a layer: outlines, and the beads as they were before they were clipped.
pub(crate) struct Ground {
    outlines: Vec<Group>,
    beads: Vec<Group>,
}

/// Sides that lie together, with the box around them: what is far away is left out at once.
#[derive(Default)]
struct Group {
    sides: Vec<[(f64, f64); 2]>,
    low: (f64, f64),
    high: (f64, f64),
}

/// How near a joint may come to a bead, in bead widths; and twice that is how far from its own ends it is looked at,
/// since there it meets the loops that it joins (the cells of stages.md §6.12).
const ROOM: f64 = 0.343;

impl Ground {
    pub(crate) fn of(lines: &[Line]) -> Self {
        let outlines = boundary(lines)
            .iter()
            .map(|ring| Group::new(ring.segments().map(|(a, b)| [flat(a.x, a.y), flat(b.x, b.y)])))
            .collect();
        let mut beads = Vec::new();
        let mut sides = Vec::new();
        let mut nozzle = Nozzle::default();
        for line in lines {
            if let (true, Some(from), Some(step)) = (nozzle.on, nozzle.at, line.as_move()) {
                sides.push([flat(from.x, from.y), flat(step.to.x, step.to.y)]);
            }
            nozzle.follow(line);
            if *line == Line::Off {
                beads.push(Group::new(sides.drain(..)));
            }
        }
        Self { outlines, beads }
    }

    /// Whether a joint crosses no outline and comes too near to no bead.
    pub(crate) fn is_free(&self, from: Point3, to: Point3, width: f64) -> bool {
        let (a, b) = (flat(from.x, from.y), flat(to.x, to.y));
        if self.outlines.iter().any(|group| group.near(a, b, 0.0, |side| crosses([a, b], *side))) {
            return false;
        }
        let length = libm::hypot(b.0 - a.0, b.1 - a.1);
        let end = 2.0 * ROOM * width;
        if length <= 2.0 * end {
            return true;
        }
        let at = |distance: f64| {
            let share = distance / length;
            (a.0 + (b.0 - a.0) * share, a.1 + (b.1 - a.1) * share)
        };
        let (a, b) = (at(end), at(length - end));
        let room = ROOM * width;
        !self.beads.iter().any(|group| group.near(a, b, room, |side| distance([a, b], *side) < room))
    }
}

impl Group {
    fn new(sides: impl Iterator<Item = [(f64, f64); 2]>) -> Self {
        let sides: Vec<_> = sides.collect();
        let ends = || sides.iter().flatten();
        let fold = |pick: fn(f64, f64) -> f64, start: f64| {
            ends().fold((start, start), |box_, at| (pick(box_.0, at.0), pick(box_.1, at.1)))
        };
        Self { low: fold(f64::min, f64::INFINITY), high: fold(f64::max, f64::NEG_INFINITY), sides }
    }

    /// Whether any side near a line is as is asked.
    fn near(&self, a: (f64, f64), b: (f64, f64), room: f64, test: impl Fn(&[(f64, f64); 2]) -> bool) -> bool {
        let apart = |a: f64, b: f64, low: f64, high: f64| a.max(b) + room < low || a.min(b) - room > high;
        if apart(a.0, b.0, self.low.0, self.high.0) || apart(a.1, b.1, self.low.1, self.high.1) {
            return false;
        }
        self.sides.iter().any(test)
    }
}

fn flat(x: i32, y: i32) -> (f64, f64) {
    (f64::from(x), f64::from(y))
}

/// Twice the area of a triangle, positive when it turns left. Exact for whole microns within a kilometre.
fn turn(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> f64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

fn crosses([a, b]: [(f64, f64); 2], [c, d]: [(f64, f64); 2]) -> bool {
    (turn(a, b, c) > 0.0) != (turn(a, b, d) > 0.0) && (turn(c, d, a) > 0.0) != (turn(c, d, b) > 0.0)
}

/// The distance between two lines that end.
fn distance(one: [(f64, f64); 2], other: [(f64, f64); 2]) -> f64 {
    if crosses(one, other) {
        return 0.0;
    }
    let to_line = |p: (f64, f64), [a, b]: [(f64, f64); 2]| {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let square = dx * dx + dy * dy;
        let share = if square == 0.0 { 0.0 } else { ((p.0 - a.0) * dx + (p.1 - a.1) * dy) / square };
        let share = share.clamp(0.0, 1.0);
        libm::hypot(a.0 + dx * share - p.0, a.1 + dy * share - p.1)
    };
    let ends =
        [to_line(one[0], other), to_line(one[1], other), to_line(other[0], one), to_line(other[1], one)];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}
