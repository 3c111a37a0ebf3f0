#![doc = include_str!("../README.md")]

use skein::{
    Angle, Error, Facts, Layer, Line, Notes, Nozzle, Pen, Point3, Ratio, Settings, Skein, Stage, along,
};

#[cfg(test)]
mod tests;

/// Lifts the nozzle over what is printed.
#[derive(Clone, Debug, Settings)]
pub struct Hop {
    /// How high the nozzle is lifted, in layer heights. Higher cuts the bead more surely and clears what stands up; the
    /// way takes longer.
    #[setting(default = 2.0, min = 0.0, max = 100.0)]
    pub over_layer_height: Ratio,
    /// How steeply it rises and comes down; 90 is straight up. Steep cuts the bead, flat smears its end along the way.
    #[setting(default = 60.0, min = 5.0, max = 90.0, unit = "°")]
    pub minimum_angle: Angle,
    /// Travels shorter than this many bead widths stay down: there is nothing to cross.
    #[setting(default = 1.5, min = 0.0, max = 1000.0)]
    pub minimum_travel: Ratio,
}

/// The share of a piece of travel that may be spent on rising or sinking (stages.md §6.15).
const SLOPE: f64 = 0.416_666_66;

impl Stage for Hop {
    const NAME: &'static str = "hop";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let lift = self.lift(&skein.facts()?)?;
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, _| Ok(lift.layer(layer, &nozzles[index])))
    }
}

impl Hop {
    fn lift(&self, facts: &Facts) -> Result<Lift, Error> {
        let height = facts.layer_height()?.um() * self.over_layer_height.f64();
        let angle = self.minimum_angle.degrees();
        let run = if angle >= 90.0 { 0.0 } else { height / libm::tan(angle.to_radians()) };
        let shortest = facts.bead_width()?.um() * self.minimum_travel.f64();
        Ok(Lift { height: height.round() as i32, run, shortest })
    }
}

/// The form of a hop, in microns.
struct Lift {
    height: i32,
    /// How far the nozzle goes along while it rises.
    run: f64,
    shortest: f64,
}

impl Lift {
    fn layer(&self, layer: Layer, entering: &Nozzle) -> Vec<Line> {
        let mut was = *entering;
        let mut pen = Pen::new(entering, layer.lines.len() * 3 / 2);
        // The lines since clay stopped: a travel, perhaps with tags between its moves.
        let mut waiting: Vec<(Line, Nozzle)> = Vec::new();
        for line in layer.lines {
            let before = was;
            was.follow(&line);
            if matches!(line, Line::On) {
                self.travel(&mut pen, std::mem::take(&mut waiting));
                pen.pass(line, &before);
            } else if before.on {
                pen.pass(line, &before);
            } else {
                waiting.push((line, before));
            }
        }
        // What does not lead to a bead parks the nozzle, and is meant as it is.
        for (line, before) in waiting {
            pen.pass(line, &before);
        }
        pen.finish(&was)
    }

    /// Writes a travel: up, across, and down to where the next bead begins.
    fn travel(&self, pen: &mut Pen, lines: Vec<(Line, Nozzle)>) {
        let moves = || lines.iter().filter(|(line, _)| line.as_move().is_some());
        let pieces = moves().filter_map(|(line, was)| Some((was.at?, line.as_move()?.to)));
        let level = |from: Point3, to: Point3| {
            let square = |a: i32, b: i32| (f64::from(a) - f64::from(b)) * (f64::from(a) - f64::from(b));
            (square(from.x, to.x) + square(from.y, to.y)).sqrt()
        };
        let length: f64 = pieces.clone().map(|(from, to)| level(from, to)).sum();
        let known = moves().all(|(line, was)| was.at.is_some() && matches!(line, Line::Move(_)));
        let quiet = moves().all(|(line, _)| line.as_move().is_some_and(|step| step.extrusion.is_none()));
        let pasted = lines.iter().any(|(line, _)| matches!(line, Line::Pasted(_)));
        if !known || !quiet || pasted || length == 0.0 || length < self.shortest {
            lines.into_iter().for_each(|(line, was)| pen.pass(line, &was));
            return;
        }
        let top = pieces.flat_map(|(from, to)| [from.z, to.z]).max().unwrap_or_default() + self.height;
        let up = |at: Point3| Point3 { z: top, ..at };
        let count = moves().count();
        let mut number = 0;
        for (line, was) in &lines {
            let (Some(step), Some(from)) = (line.as_move(), was.at) else {
                pen.pass(line.clone(), was);
                continue;
            };
            number += 1;
            let feed = step.feed.or(was.feed);
            let slope = self.run.min(level(from, step.to) * SLOPE);
            if number == 1 {
                pen.go(up(along(up(from), up(step.to), slope)), feed);
            }
            if number == count {
                pen.go(along(up(step.to), up(from), slope), feed);
                pen.go(step.to, feed);
            } else {
                pen.go(up(step.to), feed);
            }
        }
    }
}
