//! How long layers take, how slow they may become, and how hot the nozzle is.

use skein::{Facts, Feed, Line, Nozzle, Skein};

/// How long a layer takes, in seconds, by length over speed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Times {
    /// All of it.
    pub(crate) all: f64,
    /// The laying of beads.
    pub(crate) laying: f64,
}

impl Times {
    /// Counts the lines of a layer.
    pub(crate) fn of(lines: &[Line], mut nozzle: Nozzle) -> Self {
        let mut times = Self::default();
        for line in lines {
            let (from, on) = (nozzle.at, nozzle.on);
            nozzle.follow(line);
            if let (Some(from), Some(feed), Some(_)) = (from, nozzle.feed, line.as_move()) {
                let time = line.length(from) / 1000.0 / feed.mm_per_s();
                times.all += time;
                times.laying += if on { time } else { 0.0 };
            }
        }
        times
    }
}

/// The feed times a share, but not below a floor, unless it was below it before; and whether the floor has held it.
pub(crate) fn held(feed: Feed, share: f64, floor: Feed) -> (Feed, bool) {
    let slower = Feed::new((f64::from(feed.get()) * share).round() as u32).unwrap_or(floor);
    let floor = floor.min(feed);
    if slower < floor { (floor, true) } else { (slower, false) }
}

/// The temperature that the lines before and at the beginning of each layer have set, where the machine heats its nozzle.
pub(crate) fn temperatures(skein: &Skein, facts: &Facts) -> Vec<Option<f64>> {
    if !facts.heaters.is_some_and(|heaters| heaters.nozzle) {
        return vec![None; skein.layers.len()];
    }
    let last = |lines: &[Line]| lines.iter().rev().find_map(degrees);
    let mut now = last(&skein.head);
    let mut heated = Vec::with_capacity(skein.layers.len());
    for layer in &skein.layers {
        now = last(&layer.lines).or(now);
        heated.push(now);
    }
    heated
}

/// What `M104 S200` sets.
fn degrees(line: &Line) -> Option<f64> {
    match line {
        Line::Verbatim(text) | Line::Pasted(text) => {
            text.trim().strip_prefix("M104")?.trim_start().strip_prefix('S')?.parse().ok()
        }
        _ => None,
    }
}
