//! What is asked of the drive that pushes the clay.

use super::findings::Findings;
use super::limits::Limits;
use super::rule::Rule;
use crate::motion::Move;

/// More than this over a limit is no rounding.
const ROUNDING: f64 = 1.001;

/// Watches E.
#[derive(Clone, Debug)]
pub(crate) struct Pump {
    /// mm/min; nothing before the first F.
    feed: Option<f64>,
    /// The most that E may do, units/s.
    max_e: f64,
    /// The most that the pump may give, units of E/s.
    max_flow: f64,
    e_per_mm3: f64,
}

impl Pump {
    pub(crate) fn new(limits: &Limits) -> Self {
        let e_per_mm3 = limits.e_per_mm3.unwrap_or(f64::INFINITY);
        Self {
            feed: None,
            max_e: limits.max_e_speed.unwrap_or(f64::INFINITY),
            max_flow: limits.max_flow.map_or(f64::INFINITY, |flow| flow * e_per_mm3),
            e_per_mm3,
        }
    }

    /// A line says how fast to go.
    #[inline]
    pub(crate) fn set_feed(&mut self, feed: f64) {
        self.feed = Some(feed);
    }

    /// Clay is pushed while the nozzle goes its way.
    #[inline(always)]
    pub(crate) fn print(&self, findings: &mut Findings, index: usize, step: &Move) {
        let Some(feed) = self.feed else { return findings.add(Rule::NoSpeed, index, step.to, 0.0) };
        let limit = self.max_e.min(self.max_flow) * ROUNDING * 60.0;
        // Speed of E over speed of the nozzle is E over its way; compared as squares, since a root is slow.
        let pushed = step.clay * feed;
        if pushed * pushed > limit * limit * step.squared() {
            self.too_fast(findings, index, step, pushed / step.length() / 60.0);
        }
    }

    /// E goes alone.
    pub(crate) fn push(&self, findings: &mut Findings, index: usize, step: &Move) {
        if let Some(feed) = self.feed {
            self.too_fast(findings, index, step, feed / 60.0);
        }
    }

    /// `speed` is in units of E a second.
    fn too_fast(&self, findings: &mut Findings, index: usize, step: &Move, speed: f64) {
        // A way that is not known has no speed.
        if !speed.is_finite() {
            return;
        }
        if speed > self.max_e * ROUNDING {
            findings.add(Rule::ESpeed, index, step.to, speed);
        }
        if step.clay > 0.0 && speed > self.max_flow * ROUNDING {
            findings.add(Rule::Flow, index, step.to, speed / self.e_per_mm3);
        }
    }
}
