#![doc = include_str!("../README.md")]

use skein::{Error, Feed, Line, Notes, Pen, Settings, Skein, Stage};

#[cfg(test)]
mod tests;

/// Keeps the moves within what the machine can do.
#[derive(Clone, Debug, Settings)]
pub struct Limit {
    /// The speed of the very first move, which begins wherever the nozzle happens to be.
    #[setting(default = 20.0, min = 0.01, max = 1000.0, unit = "mm/s")]
    pub maximum_initial_feed: Feed,
}

impl Stage for Limit {
    const NAME: &'static str = "limit";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let steepest = skein.facts()?.z_feed()?;
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, notes| {
            let mut was = nozzles[index];
            let mut pen = Pen::new(&was, layer.lines.len());
            let mut still = 0_usize;
            for mut line in layer.lines {
                let mut next = was;
                next.follow(&line);
                let feed = match (was.at, next.at, next.feed) {
                    (Some(from), Some(to), Some(feed)) => {
                        let pushes = line.as_move().is_some_and(|step| step.extrusion.is_some());
                        if matches!(line, Line::Move(_)) && from == to && !pushes {
                            still += 1;
                            was = next;
                            continue;
                        }
                        Some(held(feed, line.length(from), from.z.abs_diff(to.z), steepest))
                    }
                    (None, Some(_), Some(feed)) => Some(feed.min(self.maximum_initial_feed)),
                    _ => None,
                };
                match (line.as_move_mut(), feed) {
                    (Some(step), Some(feed)) => {
                        // What was said is said again, so that a file in which nothing is too fast stays as it is.
                        let new = pen.nozzle().feed != Some(feed) || step.feed == Some(feed);
                        step.feed = new.then_some(feed);
                        pen.push(line);
                    }
                    _ => pen.pass(line, &was),
                }
                was = next;
            }
            if still > 0 {
                notes.layer(index, "moves that go nowhere were left out");
            }
            Ok(pen.finish(&was))
        })
    }
}

/// The feed at which a move of `length` microns that rises or sinks by `rise` keeps to the vertical limit.
fn held(feed: Feed, length: f64, rise: u32, steepest: Feed) -> Feed {
    if rise == 0 || f64::from(feed.get()) * f64::from(rise) <= f64::from(steepest.get()) * length {
        return feed;
    }
    let held = f64::from(steepest.get()) * length / f64::from(rise);
    // Not below the limit itself, since no way is shorter than its rise.
    Feed::new(held.round() as u32).map_or(steepest, |held| held.max(steepest).min(feed))
}
