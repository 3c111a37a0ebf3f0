//! One turn of a bead: from a place along the bead until it comes by there again.

use gcode::Line;

use crate::machine::{Act, EPSILON, Machine, Move, Point};
use crate::tape::{raw_lines, split_bom};

/// A bead has come round when it passes this near, as a share of the way it went.
const NEAR: f64 = 0.05;
/// A bead that comes by in the opposite direction is the other side of a wall. The cosine of the angle between them.
const OPPOSITE: f64 = -0.7;
/// How far a chord may be from its arc, mm.
const CHORD_ERROR: f64 = 0.01;

/// A straight piece of a bead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Leg {
    pub(crate) from: Point,
    pub(crate) to: Point,
    pub(crate) clay: f64,
    pub(crate) feed: Option<f64>,
}

impl Leg {
    fn way(&self) -> [f64; 2] {
        [self.to[0] - self.from[0], self.to[1] - self.from[1]]
    }

    pub(crate) fn length(&self) -> f64 {
        let [x, y] = self.way();
        x.hypot(y)
    }

    /// How far along the point is that is nearest to `place`, as a share, and how far it is from there, in XY.
    fn nearest(&self, place: Point) -> (f64, f64) {
        let [x, y] = self.way();
        let [to_x, to_y] = [place[0] - self.from[0], place[1] - self.from[1]];
        let squared = x * x + y * y;
        let share = if squared > 0.0 { ((to_x * x + to_y * y) / squared).clamp(0.0, 1.0) } else { 0.0 };
        (share, (to_x - x * share).hypot(to_y - y * share))
    }

    /// What is left of it after `share`.
    fn behind(&self, share: f64) -> Self {
        let from = std::array::from_fn(|axis| self.from[axis] + (self.to[axis] - self.from[axis]) * share);
        Self { from, clay: self.clay * (1.0 - share), ..*self }
    }

    fn reversed(&self) -> Self {
        Self { from: self.to, to: self.from, ..*self }
    }
}

/// The unbroken bead of which the line `last` is the end.
pub(crate) fn bead_before(text: &[u8], last: usize) -> Vec<Leg> {
    let mut legs = Vec::new();
    for_moves(text, last, |_, act| match act {
        Act::Move(step) if step.prints() => add_legs(&mut legs, step),
        Act::Move(step) if step.travels() => legs.clear(),
        Act::Home => legs.clear(),
        Act::Move(_) | Act::Other => {}
    });
    legs
}

/// The beads from the line `first` to the line `last`.
pub(crate) fn beads_between(text: &[u8], first: usize, last: usize) -> Vec<Leg> {
    let mut legs = Vec::new();
    for_moves(text, last, |index, act| {
        if let Act::Move(step) = act
            && index >= first
            && step.prints()
        {
            add_legs(&mut legs, step);
        }
    });
    legs
}

fn for_moves(text: &[u8], last: usize, mut with: impl FnMut(usize, &Act)) {
    let mut machine = Machine::new();
    let mut line = Line::default();
    for (index, raw) in raw_lines(split_bom(text).1).enumerate().take(last.saturating_add(1)) {
        line.read(raw.text);
        with(index, &machine.obey(&line));
    }
}

fn add_legs(legs: &mut Vec<Leg>, step: &Move) {
    let count = step.arc.map_or(1, |arc| arc.chords(CHORD_ERROR));
    let mut from = step.from;
    for number in 1..=count {
        let to = if number == count { step.to } else { step.at(number as f64 / count as f64) };
        legs.push(Leg { from, to, clay: step.clay / count as f64, feed: step.feed });
        from = to;
    }
}

/// The last turn of a bead, in the order in which it was printed: it ends where the bead does and begins where the bead
/// was nearest to that place one turn before. Nothing if the bead does not come round.
pub(crate) fn last_turn(bead: &[Leg]) -> Option<Vec<Leg>> {
    let mut turn: Vec<Leg> = turn_of(bead.iter().rev().map(Leg::reversed))?;
    turn.reverse();
    for leg in &mut turn {
        *leg = leg.reversed();
    }
    Some(turn)
}

/// The first turn of a bead.
pub(crate) fn first_turn(bead: &[Leg]) -> Option<Vec<Leg>> {
    turn_of(bead.iter().copied())
}

/// Follows a bead from its beginning until it comes round.
fn turn_of(bead: impl Iterator<Item = Leg>) -> Option<Vec<Leg>> {
    let mut turn: Vec<Leg> = Vec::new();
    let mut length = 0.0;
    let mut start: Option<Leg> = None;
    // How much of the turn to keep, the share of its last leg, and how near it comes.
    let mut best: Option<(usize, f64, f64)> = None;
    for leg in bead {
        if leg.length() == 0.0 {
            turn.push(leg);
            continue;
        }
        let first = *start.get_or_insert(leg);
        let (share, distance) = leg.nearest(first.from);
        let is_near = length > 0.0 && distance <= NEAR * (length + leg.length() * share);
        match best {
            Some((_, _, nearest)) if !is_near || distance > nearest - EPSILON => break,
            _ if is_near && !is_opposite(&first, &leg) => best = Some((turn.len(), share, distance)),
            _ => {}
        }
        length += leg.length();
        turn.push(leg);
        if distance <= EPSILON && best.is_some() {
            break;
        }
    }
    let (count, share, _) = best?;
    turn.truncate(count + 1);
    let leg = turn.last_mut()?;
    let rest = leg.behind(share);
    *leg = Leg { to: rest.from, clay: leg.clay - rest.clay, ..*leg };
    Some(turn)
}

fn is_opposite(a: &Leg, b: &Leg) -> bool {
    let ([ax, ay], [bx, by]) = (a.way(), b.way());
    ax * bx + ay * by < OPPOSITE * a.length() * b.length()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bead(points: &[[f64; 3]]) -> Vec<Leg> {
        points.windows(2).map(|ends| Leg { from: ends[0], to: ends[1], clay: 1.0, feed: None }).collect()
    }

    fn spiral(turns: f64, steps: u32) -> Vec<Leg> {
        let points: Vec<Point> = (0..=(turns * f64::from(steps)) as u32)
            .map(|step| {
                let share = f64::from(step) / f64::from(steps);
                let angle = share * std::f64::consts::TAU;
                [20.0 * angle.cos(), 20.0 * angle.sin(), 1.0 + share]
            })
            .collect();
        bead(&points)
    }

    #[test]
    fn a_spiral_comes_round_after_one_turn() {
        let turn = last_turn(&spiral(3.5, 48)).expect("it comes round");
        assert_eq!(turn.len(), 48);
        let (first, last) = (turn[0].from, turn[47].to);
        assert!((last[2] - first[2] - 1.0).abs() < 1e-6, "{first:?} {last:?}");
        let turn = first_turn(&spiral(3.5, 48)).expect("it comes round");
        assert!((turn[turn.len() - 1].to[2] - 2.0).abs() < 1e-6);
    }

    #[test]
    fn a_square_and_a_narrow_wall_come_round_once() {
        let square =
            bead(&[[0.0, 0.0, 1.0], [40.0, 0.0, 1.0], [40.0, 40.0, 1.0], [0.0, 40.0, 1.0], [0.0, 0.0, 1.0]]);
        assert_eq!(last_turn(&square).expect("a square").len(), 4);
        let wall = bead(&[
            [50.0, 0.0, 1.0],
            [100.0, 0.0, 1.0],
            [100.0, 2.0, 1.0],
            [0.0, 2.0, 1.0],
            [0.0, 0.0, 1.0],
            [50.0, 0.0, 1.0],
        ]);
        assert_eq!(last_turn(&wall).expect("a wall").len(), 5, "the other side is no end of the turn");
    }

    #[test]
    fn an_open_bead_has_no_turn() {
        assert_eq!(last_turn(&bead(&[[0.0, 0.0, 1.0], [40.0, 0.0, 1.0], [40.0, 40.0, 1.0]])), None);
        assert_eq!(last_turn(&spiral(0.8, 48)), None);
        assert_eq!(last_turn(&[]), None);
    }
}
