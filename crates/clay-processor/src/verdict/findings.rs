//! Where each rule was broken, how often, and how badly.

use super::rule::Rule;

/// One rule's breaches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Finding {
    /// How many lines break it.
    pub(crate) count: usize,
    /// The line of the first.
    pub(crate) first: usize,
    /// Z at the first.
    pub(crate) height: Option<f64>,
    /// The line of the last: a line breaks a rule once, however often.
    last: usize,
    /// How bad the worst is; what it measures is the rule's business, and more is worse.
    pub(crate) worst: f64,
    /// The line of the worst.
    pub(crate) worst_at: usize,
}

/// All of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Findings([Finding; Rule::ALL.len()]);

impl Findings {
    /// `rule` is broken in the line `index` at `height`, so badly as `measure` says.
    #[cold]
    pub(crate) fn add(&mut self, rule: Rule, index: usize, height: Option<f64>, measure: f64) {
        let Some(finding) = self.0.get_mut(rule as usize) else { return };
        if finding.count == 0 {
            *finding =
                Finding { count: 1, first: index, height, last: index, worst: measure, worst_at: index };
        }
        if measure > finding.worst {
            finding.worst = measure;
            finding.worst_at = index;
        }
        finding.count += usize::from(index != finding.last);
        finding.last = index;
    }

    /// The rules that are broken, the worst first.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Rule, &Finding)> {
        Rule::ALL.iter().copied().zip(&self.0).filter(|(_, finding)| finding.count > 0)
    }
}
