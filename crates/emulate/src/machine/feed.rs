//! How fast a move is told to be.

use super::state::Say;
use gcode::{Given, Span};
use std::borrow::Cow;

/// Slower than this is a slip of the pen, mm/s.
const SLOWEST: f64 = 1e-6;

/// What a feed counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FeedMode {
    /// `G94`: mm/s by now.
    #[default]
    PerMinute,
    /// `G93`: moves per second.
    InverseTime,
    /// `G95`: mm for each revolution.
    PerRevolution,
}

/// The feed and what it depends on.
#[derive(Clone, Debug)]
pub(crate) struct Feed {
    pub(crate) mode: FeedMode,
    /// The last feed, in the unit of its mode; nothing before the first.
    last: Option<f64>,
    /// The feed of a machine that was told none, mm/s.
    default: f64,
    /// How fast a rapid move is, mm/s.
    rapid: Option<f64>,
    /// `M220`.
    factor: f64,
    /// Revolutions per second.
    pub(crate) spindle: f64,
}

impl Feed {
    pub(crate) fn new(default: f64, rapid: Option<f64>) -> Self {
        Self { mode: FeedMode::default(), last: None, default, rapid, factor: 1.0, spindle: 0.0 }
    }

    /// Remembers a feed.
    pub(crate) fn set(&mut self, feed: f64, say: Say<'_>) {
        if feed > SLOWEST && feed.is_finite() {
            self.last = Some(feed);
        } else {
            say(Cow::Borrowed("a feed must be positive; the old one is kept"));
        }
    }

    /// `M220`.
    pub(crate) fn percent(&mut self, percent: Option<f64>) {
        if let Some(percent) = percent.filter(|&percent| percent > 1e-3 && percent < 1e6) {
            self.factor = percent / 100.0;
        }
    }

    /// The speed of a move of this length, mm/s.
    #[inline]
    pub(crate) fn speed(&mut self, feed: Given, rapid: bool, length: f64, say: Say<'_>) -> f64 {
        if let Some(feed) = feed.get() {
            self.set(feed, say);
        }
        if rapid && let Some(rapid) = self.rapid {
            return rapid;
        }
        if self.mode == FeedMode::InverseTime && feed.is_none() {
            say(Cow::Borrowed("under G93 every move needs its own F"));
        }
        let Some(last) = self.last else {
            say(Cow::Owned(format!("no feed was given yet; {} mm/s is assumed", self.default)));
            self.last = Some(self.default);
            return self.default;
        };
        let speed = match self.mode {
            FeedMode::PerMinute => last * self.factor,
            FeedMode::InverseTime => last * length * self.factor,
            FeedMode::PerRevolution => last * self.spindle * self.factor,
        };
        if speed > SLOWEST {
            return speed;
        }
        say(Cow::Borrowed("a move without speed: the spindle stands still, or there is no way"));
        self.default
    }

    /// A dwell in seconds.
    pub(crate) fn seconds(&self, time: f64, by: Span, say: Say<'_>) -> f64 {
        match by {
            Span::Seconds => time,
            Span::Revolutions if self.spindle > 0.0 => time / self.spindle,
            Span::Revolutions => {
                say(Cow::Borrowed("a dwell in revolutions while the spindle stands still; it takes no time"));
                0.0
            }
        }
    }
}
