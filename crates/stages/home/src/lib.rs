#![doc = include_str!("../README.md")]

use skein::{
    Error, Feed, Layer, Line, Move, Notes, Nozzle, Pen, Point3, Ratio, Settings, Skein, Stage, along,
};

#[cfg(test)]
mod tests;

/// Runs lines of your own between layers.
#[derive(Clone, Debug, Settings)]
pub struct Home {
    /// The lines. Nothing happens without any. They begin above the highest place of the print, and the nozzle goes back
    /// there afterwards.
    #[setting(default = "")]
    pub lines: String,
    /// How many layers lie between two runs.
    #[setting(default = 1, min = 1, max = 1000000)]
    pub period: u32,
    /// How far above the print the nozzle goes, in layer heights.
    #[setting(default = 2.0, min = 0.0, max = 1000.0)]
    pub clearance: Ratio,
}

impl Stage for Home {
    const NAME: &'static str = "home";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        if self.lines.trim().is_empty() {
            notes.say("there are no lines to run: set `lines`");
            return Ok(skein);
        }
        let facts = skein.facts()?;
        let width = facts.bead_width()?.um();
        let clearance = (facts.layer_height()?.um() * self.clearance.f64()).round() as i32;
        let travel = facts.travel_feed()?;
        let nozzles = skein.nozzles();
        let highest = skein.highest();
        skein.rewrite(notes, |index, layer, _| {
            let due = index > 0 && index.is_multiple_of(self.period as usize);
            Ok(match highest[index].filter(|_| due) {
                Some(top) => {
                    let errand = Errand { lines: &self.lines, top: top + clearance, width, travel };
                    errand.layer(layer, &nozzles[index])
                }
                None => layer.lines,
            })
        })
    }
}

/// The way out of the print and back, for one layer.
struct Errand<'a> {
    lines: &'a str,
    /// How high the nozzle goes.
    top: i32,
    width: f64,
    travel: Feed,
}

impl Errand<'_> {
    /// Goes out before the first move of a layer.
    fn layer(&self, layer: Layer, entering: &Nozzle) -> Vec<Line> {
        let mut was = *entering;
        let mut pen = Pen::new(entering, layer.lines.len() + 16);
        let mut out = false;
        for line in layer.lines {
            if let (false, Some(step), Some(from)) = (out, line.as_move(), was.at) {
                out = true;
                self.run(&mut pen, was.on, from, step.to);
            }
            let before = was;
            was.follow(&line);
            pen.pass(line, &before);
        }
        pen.finish(&was)
    }

    /// Straight up, the lines, and back to a bead width in front of where the print goes on.
    fn run(&self, pen: &mut Pen, was_on: bool, from: Point3, to: Point3) {
        let up = |at: Point3| Point3 { z: self.top.max(at.z), ..at };
        pen.off();
        pen.go(up(from), Some(self.travel));
        for line in Line::alteration(self.lines) {
            pen.push(line);
        }
        pen.go(up(from), Some(self.travel));
        if Move::to(up(to)).length(up(from)) > self.width {
            pen.go(along(up(to), up(from), self.width), Some(self.travel));
        }
        if was_on {
            pen.on();
        }
    }
}
