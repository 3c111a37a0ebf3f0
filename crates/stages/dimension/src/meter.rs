//! Clay by length: what each move pushes, and the sums that do not drift.

use crate::Counting;
use skein::{Bead, EUnit, Error, Extrusion, Facts, Line, Micron, Nozzle, Ratio};
use std::ops::Add;

/// Sums beyond this are no longer exact to the last decimal: 90 000 million E units.
const LIMIT: f64 = 9e15;

/// What the machine's E word counts, and for which bead.
pub(crate) struct Meter {
    bead: Bead,
    /// E units, in hundred-thousandths, per mm³ of bead.
    per_mm3: f64,
    /// The least step of an E word in hundred-thousandths.
    step: i64,
    counting: Counting,
}

/// Clay so far, in hundred-thousandths of an E unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Total {
    /// By length, unrounded.
    measured: f64,
    /// What moves said themselves.
    said: i64,
}

/// Where the E words of a layer count from.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Account {
    /// All clay below the layer.
    pub(crate) below: Total,
    /// What of it an absolute E word leaves out, since E has been set back to zero there.
    pub(crate) zero: i64,
}

impl Add for Total {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { measured: self.measured + other.measured, said: self.said.saturating_add(other.said) }
    }
}

impl Meter {
    pub(crate) fn new(facts: &Facts, flow: Ratio, counting: Counting) -> Result<Self, Error> {
        let bead = facts.bead()?;
        let unit = facts.e_unit()?;
        // A micro-litre holds a thousand steps of 0.001 mm³, so three decimals are enough for volume; in a ram of
        // 60 mm the same step would be 2.8 mm³, so lengths of a ram, of a make-believe filament or of a bead's own
        // measure take all five.
        let step = if unit == EUnit::Mm3 { 100 } else { 1 };
        Ok(Self { bead, per_mm3: unit.per_mm3(bead.area()) * flow.f64() * 1e5, step, counting })
    }

    /// How much clay the lines of one layer take by themselves.
    pub(crate) fn measure(&self, lines: &[Line], height: Micron, nozzle: Nozzle) -> Result<Total, Error> {
        let mut walk = Walk::new(self, height, nozzle);
        for line in lines {
            walk.follow(line)?;
        }
        Ok(walk.total)
    }

    /// Writes the E words of one layer above `below`, and returns the total at its end.
    ///
    /// What is rounded is the total, and an E word is the difference of two rounded totals. So the sum of all E words
    /// is never further from the clay than half a step, however many moves there are.
    pub(crate) fn write(
        &self,
        lines: &mut [Line],
        height: Micron,
        nozzle: Nozzle,
        Account { below, zero }: Account,
    ) -> Result<Total, Error> {
        let mut walk = Walk::new(self, height, nozzle);
        let mut before = self.rounded(below)?;
        for line in lines {
            if !walk.follow(line)? {
                continue;
            }
            let after = self.rounded(below + walk.total)?;
            if let Some(step) = line.as_move_mut() {
                let word = match self.counting {
                    Counting::Relative => after.saturating_sub(before),
                    Counting::Absolute => after.saturating_sub(zero),
                };
                step.extrusion = Extrusion::new(word);
            }
            before = after;
        }
        Ok(below + walk.total)
    }

    /// The least step of an E word in hundred-thousandths.
    pub(crate) fn step(&self) -> i64 {
        self.step
    }

    /// A total in hundred-thousandths of E, as E words say it.
    pub(crate) fn rounded(&self, total: Total) -> Result<i64, Error> {
        let step = self.step as f64;
        let measured = unit::round_within(total.measured / step, LIMIT / step);
        measured.and_then(|steps| (steps * self.step).checked_add(total.said)).ok_or_else(|| {
            Error::new("the print takes more clay than an E word can count")
                .hint("look at `e_unit` and `flow`")
        })
    }
}

/// The nozzle's way through the lines of one layer.
struct Walk<'a> {
    meter: &'a Meter,
    height: Micron,
    nozzle: Nozzle,
    /// Hundred-thousandths of E per micron of bead at the present flow.
    per_micron: f64,
    total: Total,
}

impl<'a> Walk<'a> {
    fn new(meter: &'a Meter, height: Micron, nozzle: Nozzle) -> Self {
        let mut walk = Self { meter, height, nozzle, per_micron: 0.0, total: Total::default() };
        walk.pour(nozzle.flow);
        walk
    }

    fn pour(&mut self, flow: Ratio) {
        // The section of this layer's own height: a low first layer takes less clay.
        let section = self.meter.bead.of_height(self.height).area();
        self.nozzle.flow = flow;
        self.per_micron = section * flow.f64() * self.meter.per_mm3 / 1000.0;
    }

    /// Takes one line; true when it is a move that pushes clay.
    #[inline]
    fn follow(&mut self, line: &Line) -> Result<bool, Error> {
        let Some(step) = line.as_move() else {
            match line {
                Line::On => self.nozzle.on = true,
                Line::Off => self.nozzle.on = false,
                Line::Flow(flow) => self.pour(*flow),
                _ => {}
            }
            return Ok(false);
        };
        let from = self.nozzle.at.replace(step.to);
        if let Some(said) = step.extrusion {
            // An E word that an earlier stage has put there is an amount of its own: a prime, a relief.
            self.total.said = self.total.said.saturating_add(said.get());
            return Ok(true);
        }
        if !self.nozzle.on {
            return Ok(false);
        }
        let Some(from) = from else {
            return Err(Error::new("clay flows before the nozzle has a place")
                .hint("a bead needs a travel to its start before M101"));
        };
        self.total.measured += line.length(from) * self.per_micron;
        Ok(true)
    }
}
