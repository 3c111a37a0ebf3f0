#![doc = include_str!("../README.md")]

use skein::{
    Error, Feed, Layer, Line, Micron, Move, Notes, Nozzle, Pen, Point3, Settings, Skein, Stage, along,
};

#[cfg(test)]
mod tests;

/// Cleans the nozzle from time to time.
#[derive(Clone, Debug, Settings)]
pub struct Wipe {
    /// Where the nozzle comes to the brush.
    #[setting(default = place(2, 2, 50), min = -10000.0, max = 10000.0, unit = "mm")]
    pub arrival: Point3,
    /// The brush itself.
    #[setting(default = place(2, 17, 50), min = -10000.0, max = 10000.0, unit = "mm")]
    pub wipe: Point3,
    /// Where the nozzle leaves the brush.
    #[setting(default = place(2, 2, 50), min = -10000.0, max = 10000.0, unit = "mm")]
    pub departure: Point3,
    /// The nozzle is wiped before the first layer and then every so many layers.
    #[setting(default = 3, min = 1, max = 1000000)]
    pub period: u32,
}

impl Stage for Wipe {
    const NAME: &'static str = "wipe";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        let (width, travel) = (facts.bead_width()?.um(), facts.travel_feed()?);
        let highest = skein.highest();
        self.keep_clear(&skein, width, highest.last().copied().flatten())?;
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, _| {
            if !index.is_multiple_of(self.period as usize) {
                return Ok(layer.lines);
            }
            let way = Way { wipe: self, highest: highest[index], width, travel };
            Ok(way.layer(layer, &nozzles[index]))
        })
    }
}

impl Wipe {
    /// The brush must not stand in the print.
    fn keep_clear(&self, skein: &Skein, width: f64, top: Option<i32>) -> Result<(), Error> {
        let places = || skein.layers.iter().flat_map(|layer| &layer.lines).filter_map(Line::as_move);
        let width = width.ceil() as i32;
        let box_of = |side: fn(&Move) -> i32| {
            Some((places().map(side).min()? - width, places().map(side).max()? + width))
        };
        let (Some(x), Some(y)) = (box_of(|step| step.to.x), box_of(|step| step.to.y)) else { return Ok(()) };
        for (name, at) in [("arrival", self.arrival), ("wipe", self.wipe), ("departure", self.departure)] {
            let inside = (x.0..=x.1).contains(&at.x) && (y.0..=y.1).contains(&at.y);
            if inside && top.is_some_and(|top| at.z < top) {
                return Err(Error::new(format!(
                    "`{name}` at x {} y {} lies in the print",
                    Micron(at.x),
                    Micron(at.y)
                ))
                .hint("put the brush beside the part, or the part elsewhere"));
            }
        }
        Ok(())
    }
}

/// A place in whole millimetres.
const fn place(x: i32, y: i32, z: i32) -> Point3 {
    Point3 { x: x * 1000, y: y * 1000, z: z * 1000 }
}

/// The way to the brush and back, for one layer.
struct Way<'a> {
    wipe: &'a Wipe,
    highest: Option<i32>,
    width: f64,
    travel: Feed,
}

impl Way<'_> {
    fn layer(&self, layer: Layer, entering: &Nozzle) -> Vec<Line> {
        let mut was = *entering;
        let mut pen = Pen::new(entering, layer.lines.len() + 12);
        let mut wiped = false;
        for line in layer.lines {
            if let (false, Some(step)) = (wiped, line.as_move()) {
                wiped = true;
                pen.off();
                self.there(&mut pen, was.at);
                self.back(&mut pen, step.to);
                if was.on {
                    // The bead goes on where it was left.
                    was.at.into_iter().for_each(|at| pen.go(at, Some(self.travel)));
                    pen.on();
                }
            }
            let before = was;
            was.follow(&line);
            pen.pass(line, &before);
        }
        pen.finish(&was)
    }

    fn there(&self, pen: &mut Pen, from: Option<Point3>) {
        let Wipe { arrival, wipe, departure, .. } = *self.wipe;
        for at in from.map_or([None; 2], |from| self.above(from, arrival)).into_iter().flatten() {
            pen.go(at, Some(self.travel));
        }
        for at in [arrival, wipe, departure] {
            pen.go(at, Some(self.travel));
        }
    }

    fn back(&self, pen: &mut Pen, to: Point3) {
        for at in self.above(self.wipe.departure, to).into_iter().flatten() {
            pen.go(at, Some(self.travel));
        }
    }

    /// Two places a bead width from both ends of a way, above all that is printed and above both ends.
    fn above(&self, from: Point3, to: Point3) -> [Option<Point3>; 2] {
        let top = from.z.max(to.z).max(self.highest.unwrap_or(i32::MIN));
        let up = |at: Point3| Point3 { z: top, ..at };
        if Move::to(up(to)).length(up(from)) < 3.0 * self.width {
            return [None, None];
        }
        [along(up(from), up(to), self.width), along(up(to), up(from), self.width)].map(Some)
    }
}
