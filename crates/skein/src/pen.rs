//! Writes the lines of a layer anew. Speed and flow hold until they are said again, so what is inserted, left out or
//! turned round must not change those of what follows.

use crate::{Line, Move, Nozzle};
use shape::Point3;
use unit::{Feed, Ratio};

/// Writes lines and says speed and flow where they change.
#[derive(Debug)]
pub struct Pen {
    nozzle: Nozzle,
    /// The nozzle in front of the line that was written last.
    before: Nozzle,
    lines: Vec<Line>,
}

/// A piece of a thread, as straight as a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stretch {
    /// Where it ends, how fast it is if anybody has said so, and what it pushes if that is said.
    pub step: Move,
    /// The share of the nominal section that flows.
    pub flow: Ratio,
}

/// A thread taken apart, so that it can be turned, cut and moved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Thread {
    /// Where it begins.
    pub start: Point3,
    /// Its pieces in order.
    pub stretches: Vec<Stretch>,
}

impl Pen {
    /// A pen for a layer that finds the nozzle like this. The speed counts as not said yet, since every layer says its
    /// own.
    pub fn new(entering: &Nozzle, lines: usize) -> Self {
        let nozzle = Nozzle { feed: None, ..*entering };
        Self { nozzle, before: nozzle, lines: Vec::with_capacity(lines) }
    }

    /// What the nozzle does behind the lines written so far.
    pub fn nozzle(&self) -> &Nozzle {
        &self.nozzle
    }

    /// Writes a line as it is.
    pub fn push(&mut self, line: Line) {
        self.before = self.nozzle;
        self.nozzle.follow(&line);
        self.lines.push(line);
    }

    /// Passes an old line on with the speed and the flow that it had; `was` is the nozzle in front of it in the old layer.
    pub fn pass(&mut self, mut line: Line, was: &Nozzle) {
        if was.on || matches!(line, Line::On) {
            self.flow(was.flow);
        }
        if let Some(step) = line.as_move_mut() {
            step.feed = match (step.feed, was.feed) {
                (None, Some(feed)) if self.nozzle.feed != Some(feed) => Some(feed),
                (said, _) => said,
            };
        }
        self.push(line);
    }

    /// A move at a speed.
    pub fn go(&mut self, to: Point3, feed: Option<Feed>) {
        self.step(Move { feed, ..Move::to(to) });
    }

    /// A move whose speed is said when it is new.
    pub fn step(&mut self, step: Move) {
        let feed = step.feed.filter(|feed| self.nozzle.feed != Some(*feed));
        self.push(Line::Move(Move { feed, ..step }));
    }

    /// From here this share of the nominal section flows.
    pub fn flow(&mut self, flow: Ratio) {
        if self.nozzle.flow != flow {
            self.push(Line::Flow(flow));
        }
    }

    /// Clay starts, unless it flows already.
    pub fn on(&mut self) {
        if !self.nozzle.on {
            self.push(Line::On);
        }
    }

    /// Clay stops, if it flows.
    pub fn off(&mut self) {
        if self.nozzle.on {
            self.push(Line::Off);
        }
    }

    /// Lets the travel that was just written end somewhere else; if there is none, a new one leads there.
    pub fn arrive(&mut self, at: Point3) {
        match self.lines.last_mut() {
            Some(Line::Move(step)) if !self.nozzle.on => {
                step.to = at;
                self.nozzle.at = Some(at);
            }
            _ if self.nozzle.at == Some(at) => {}
            _ => self.go(at, None),
        }
    }

    /// From where the move that was written last went.
    pub fn came_from(&self) -> Option<Point3> {
        self.before.at
    }

    /// Takes back the travel that was just written, with the place from which it went; nothing when something else was
    /// written last or that place is unknown.
    pub fn take_travel(&mut self) -> Option<(Point3, Move)> {
        let from = self.before.at?;
        match self.lines.last() {
            Some(Line::Move(travel)) if !self.nozzle.on => {
                let travel = *travel;
                self.lines.pop();
                self.nozzle = self.before;
                Some((from, travel))
            }
            _ => None,
        }
    }

    /// Lays a whole thread from where the nozzle stands.
    pub fn thread(&mut self, thread: &Thread) {
        let Some(first) = thread.stretches.first() else { return };
        self.flow(first.flow);
        self.on();
        for stretch in &thread.stretches {
            self.flow(stretch.flow);
            self.step(stretch.step);
        }
        self.off();
    }

    /// The lines. Behind them flows what flowed behind the old ones, which `was` knows.
    pub fn finish(mut self, was: &Nozzle) -> Vec<Line> {
        if self.nozzle.flow != was.flow {
            let end = self.lines.len() - usize::from(matches!(self.lines.last(), Some(Line::Close(_))));
            self.lines.insert(end, Line::Flow(was.flow));
        }
        self.lines
    }
}

impl Thread {
    /// Takes a thread apart; `was` is the nozzle in front of its `M101`. Nothing when it has lines that are neither
    /// straight moves nor flows, or no move at all.
    pub fn read(lines: &[Line], was: &Nozzle) -> Option<Self> {
        let mut nozzle = *was;
        let mut stretches = Vec::with_capacity(lines.len());
        for line in lines {
            nozzle.follow(line);
            match line {
                Line::Move(step) => {
                    stretches.push(Stretch { step: Move { feed: nozzle.feed, ..*step }, flow: nozzle.flow });
                }
                Line::On | Line::Off | Line::Flow(_) => {}
                _ => return None,
            }
        }
        (!stretches.is_empty()).then_some(Self { start: was.at?, stretches })
    }

    /// Where it ends.
    pub fn end(&self) -> Point3 {
        self.stretches.last().map_or(self.start, |last| last.step.to)
    }

    /// Whether it ends where it begins.
    pub fn is_closed(&self) -> bool {
        self.end() == self.start && self.stretches.len() > 1
    }

    /// Each piece with the place where it begins.
    pub fn pieces(&self) -> impl Iterator<Item = (Point3, &Stretch)> {
        let starts = std::iter::once(self.start).chain(self.stretches.iter().map(|stretch| stretch.step.to));
        starts.zip(&self.stretches)
    }

    /// Its length in microns.
    pub fn length(&self) -> f64 {
        self.pieces().map(|(from, stretch)| stretch.step.length(from)).sum()
    }

    /// Cuts it at a length from its start, in microns; one of the parts is empty when that is beyond an end. What a cut
    /// piece pushes is shared by length.
    pub fn split(self, at: f64) -> (Self, Self) {
        let mut before = Self { start: self.start, stretches: Vec::new() };
        let mut left = at;
        let mut rest = self.stretches.into_iter();
        for stretch in rest.by_ref() {
            let from = before.end();
            let length = stretch.step.length(from);
            if left < length {
                if left <= 0.0 {
                    let stretches = std::iter::once(stretch).chain(rest).collect();
                    return (before, Self { start: from, stretches });
                }
                let (near, far) = stretch.cut(from, left / length);
                before.stretches.push(near);
                let stretches = std::iter::once(far).chain(rest).collect();
                return (before, Self { start: near.step.to, stretches });
            }
            left -= length;
            before.stretches.push(stretch);
        }
        let start = before.end();
        (before, Self { start, stretches: Vec::new() })
    }

    /// Another thread behind it.
    pub fn join(mut self, other: Self) -> Self {
        self.stretches.extend(other.stretches);
        self
    }

    /// The same thread from its end to its start.
    pub fn reversed(mut self) -> Self {
        let ends: Vec<Point3> = self.pieces().map(|(from, _)| from).collect();
        let start = self.end();
        self.stretches.iter_mut().zip(&ends).for_each(|(stretch, from)| stretch.step.to = *from);
        self.stretches.reverse();
        Self { start, ..self }
    }
}

impl Stretch {
    /// The two parts on either side of a share of its way.
    fn cut(self, from: Point3, share: f64) -> (Self, Self) {
        let between = |a: i32, b: i32| a + ((f64::from(b) - f64::from(a)) * share).round() as i32;
        let to = self.step.to;
        let middle = Point3 { x: between(from.x, to.x), y: between(from.y, to.y), z: between(from.z, to.z) };
        let whole = self.step.extrusion;
        let first = whole.and_then(|whole| unit::Extrusion::new((whole.get() as f64 * share).round() as i64));
        let second =
            whole.zip(first).and_then(|(whole, first)| unit::Extrusion::new(whole.get() - first.get()));
        (
            Self { step: Move { to: middle, extrusion: first, ..self.step }, ..self },
            Self { step: Move { extrusion: second, ..self.step }, ..self },
        )
    }
}

/// A place at a length along the way from one to another, in microns.
pub fn along(from: Point3, to: Point3, distance: f64) -> Point3 {
    let length = Move::to(to).length(from);
    if length == 0.0 {
        return from;
    }
    let share = (distance / length).clamp(0.0, 1.0);
    let between = |a: i32, b: i32| a + ((f64::from(b) - f64::from(a)) * share).round() as i32;
    Point3 { x: between(from.x, to.x), y: between(from.y, to.y), z: between(from.z, to.z) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Reader;

    fn lines(text: &str) -> Vec<Line> {
        let mut reader = Reader::default();
        text.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect()
    }

    fn text(lines: &[Line]) -> String {
        let mut text = Vec::new();
        for line in lines {
            line.write(&mut text);
            text.push(b'\n');
        }
        String::from_utf8(text).expect("text")
    }

    const LOOP: &str = "\
G1 X0.0 Y0.0 Z1.0 F3600.0
M108 S1.0
M101
G1 X10.0 Y0.0 Z1.0 F1800.0
M108 S0.5
G1 X10.0 Y10.0 Z1.0
G1 X0.0 Y0.0 Z1.0 F900.0
M103
";

    fn thread() -> (Nozzle, Thread) {
        let lines = lines(LOOP);
        let mut nozzle = Nozzle::default();
        lines[..2].iter().for_each(|line| nozzle.follow(line));
        (nozzle, Thread::read(&lines[2..], &nozzle).expect("a thread"))
    }

    #[test]
    fn what_is_passed_on_unchanged_is_the_same() {
        let mut pen = Pen::new(&Nozzle::default(), 0);
        let mut was = Nozzle::default();
        for line in lines(LOOP) {
            pen.pass(line.clone(), &was);
            was.follow(&line);
        }
        assert_eq!(text(&pen.finish(&was)), LOOP);
    }

    #[test]
    fn a_turned_thread_keeps_the_speed_and_flow_of_every_piece() {
        let (nozzle, thread) = thread();
        assert!(thread.is_closed());
        let (before, after) = thread.split(15_000.0);
        let mut pen = Pen::new(&nozzle, 0);
        pen.go(after.start, None);
        pen.thread(&after.join(before));
        let mut end = nozzle;
        end.flow = Ratio(500_000);
        assert_eq!(
            text(&pen.finish(&end)),
            "G1 X10.0 Y5.0 Z1.0\nM108 S0.5\nM101\nG1 X10.0 Y10.0 Z1.0 F1800.0\nG1 X0.0 Y0.0 Z1.0 F900.0\nM108 S1.0\n\
             G1 X10.0 Y0.0 Z1.0 F1800.0\nM108 S0.5\nG1 X10.0 Y5.0 Z1.0\nM103\n"
        );
    }

    #[test]
    fn reversed_twice_is_the_same_and_a_cut_beyond_an_end_cuts_nothing() {
        let (_, thread) = thread();
        assert_eq!(thread.clone().reversed().reversed(), thread);
        let length = thread.length();
        assert_eq!(thread.clone().split(length + 1.0).0, thread);
        assert_eq!(thread.clone().split(0.0).1, thread);
    }
}
