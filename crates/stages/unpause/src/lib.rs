#![doc = include_str!("../README.md")]

use skein::{Error, Feed, Line, Notes, Nozzle, Pen, Ratio, Settings, Skein, Stage};

#[cfg(test)]
mod tests;

/// Makes up for the time that a slow controller takes for each line.
#[derive(Clone, Debug, Settings)]
pub struct Unpause {
    /// How long the controller stands still between two lines.
    #[setting(default = 28.0, min = 0.0, max = 1000.0, unit = "ms")]
    pub delay: Ratio,
    /// How much faster a move may become at most.
    #[setting(default = 1.3, min = 1.0, max = 10.0)]
    pub maximum_speed: Ratio,
}

impl Stage for Unpause {
    const NAME: &'static str = "unpause";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, _| {
            let mut was = nozzles[index];
            let mut pen = Pen::new(&was, layer.lines.len());
            for line in layer.lines {
                let next = {
                    let mut next: Nozzle = was;
                    next.follow(&line);
                    next
                };
                match (line, was.at, next.feed) {
                    (mut line @ (Line::Move(_) | Line::Arc(_)), Some(from), Some(feed)) => {
                        let length = line.length(from) / 1000.0;
                        let faster = self.faster(feed, length)?;
                        if let Some(step) = line.as_move_mut() {
                            step.feed = (pen.nozzle().feed != Some(faster)).then_some(faster);
                        }
                        pen.push(line);
                    }
                    (line, _, _) => pen.pass(line, &was),
                }
                was = next;
            }
            Ok(pen.finish(&was))
        })
    }
}

impl Unpause {
    /// The feed at which a move of this length in mm lasts, pause included, as long as it was meant to (stages.md
    /// §6.23): F / max(1/maximum, 1 − delay/length · F/60).
    fn faster(&self, feed: Feed, length: f64) -> Result<Feed, Error> {
        if length == 0.0 {
            return Ok(feed);
        }
        let speed = feed.mm_per_s();
        let share = 1.0 - self.delay.f64() / 1000.0 / length * speed;
        let faster = speed / share.max(1.0 / self.maximum_speed.f64());
        Feed::from_mm_per_s(faster).ok_or_else(|| {
            Error::new(format!("{faster} mm/s is no speed a machine can move at"))
                .hint("lower `maximum_speed`")
        })
    }
}
