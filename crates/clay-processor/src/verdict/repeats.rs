//! Finds layers that are laid twice.

use super::findings::Findings;
use super::rule::Rule;
use crate::motion::EPSILON_Z;

/// The strokes at one height so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Repeats {
    height: f64,
    first: usize,
    /// Which way, and how long it is, squared.
    strokes: Vec<(u64, f32)>,
}

/// A layer of fewer strokes is not worth a word: a line to and fro is no layer laid twice.
const FEWEST: usize = 6;

impl Repeats {
    /// Clay was laid from one place to another, `length` apart, at this height.
    #[inline]
    pub(crate) fn stroke(
        &mut self,
        findings: &mut Findings,
        index: usize,
        height: f64,
        from: (f64, f64),
        to: (f64, f64),
        squared: f64,
    ) {
        if (height - self.height).abs() > EPSILON_Z || self.strokes.is_empty() {
            self.end(findings);
            self.height = height;
            self.first = index;
        }
        self.strokes.push((mark(from, to), squared as f32));
    }

    /// The layer has ended.
    #[inline]
    pub(crate) fn end(&mut self, findings: &mut Findings) {
        if !self.strokes.is_empty() {
            self.judge(findings);
        }
    }

    /// At least half of what is laid is laid again, in the same direction.
    #[inline(never)]
    fn judge(&mut self, findings: &mut Findings) {
        if self.strokes.len() >= FEWEST {
            self.strokes.sort_unstable_by_key(|(mark, _)| *mark);
            let (mut once, mut again) = (0.0, 0.0);
            for same in self.strokes.chunk_by(|one, next| one.0 == next.0) {
                let length = same.first().map_or(0.0, |(_, squared)| f64::from(*squared).sqrt());
                once += length;
                again += length * (same.len() - 1) as f64;
            }
            if again > 0.0 && again >= once / 2.0 {
                findings.add(Rule::RepeatedLayer, self.first, Some(self.height), again);
            }
        }
        self.strokes.clear();
    }
}

/// A number for the way from one place to another, to the micron. Two ways share one by a chance of one in 2⁶⁴, and a
/// sort of numbers is several times faster than one of places.
#[inline(always)]
fn mark(from: (f64, f64), to: (f64, f64)) -> u64 {
    // The cast keeps what is out of reach at the border, where it does not matter, and is faster than rounding.
    let micron = |mm: f64| (mm * 1000.0 + if mm < 0.0 { -0.5 } else { 0.5 }) as i32;
    let place = |at: (f64, f64)| u64::from(micron(at.0) as u32) << 32 | u64::from(micron(at.1) as u32);
    // Odd constants with evenly spread bits: 2⁶⁴ over the golden ratio, and a prime.
    let mixed = place(from).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29) ^ place(to);
    let mixed = (mixed ^ mixed >> 32).wrapping_mul(0xD6E8_FEB8_6659_FD93);
    mixed ^ mixed >> 32
}
