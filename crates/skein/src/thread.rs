//! Threads taken apart, so that they can be turned, cut and moved.

use crate::{Feature, Line, Move, Nozzle};
use shape::Point3;
use unit::Ratio;

/// A piece of a thread, as straight as a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stretch {
    /// Where it ends, how fast it is if anybody has said so, and what it pushes if that is said.
    pub step: Move,
    /// The share of the nominal section that flows.
    pub flow: Ratio,
    /// The block that it stands in.
    pub block: Option<Feature>,
}

/// A thread taken apart, so that it can be turned, cut and moved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Thread {
    /// Where it begins.
    pub start: Point3,
    /// Its pieces in order.
    pub stretches: Vec<Stretch>,
}

impl Thread {
    /// Takes the lines of a [`Span::Thread`](crate::Span::Thread) apart; `was` is the nozzle in front of them. Nothing when
    /// it has an arc, or no move at all.
    pub fn read(lines: &[Line], was: &Nozzle) -> Option<Self> {
        let mut nozzle = *was;
        let mut stretches = Vec::with_capacity(lines.len());
        for line in lines {
            nozzle.follow(line);
            match line {
                Line::Move(step) => {
                    let step = Move { feed: nozzle.feed, ..*step };
                    stretches.push(Stretch { step, flow: nozzle.flow, block: nozzle.block });
                }
                Line::Arc(_) => return None,
                _ => {}
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

    /// Whether it is one closed wall and nothing else.
    pub fn is_wall(&self) -> bool {
        self.is_closed() && self.stretches.iter().all(|piece| piece.feature().is_wall())
    }

    /// Whether a part of it is a wall.
    pub fn has_wall(&self) -> bool {
        self.stretches.iter().any(|piece| piece.feature().is_wall())
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
    /// What it is for.
    pub fn feature(&self) -> Feature {
        self.block.unwrap_or(Feature::Middle)
    }

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
