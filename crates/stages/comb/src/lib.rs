#![doc = include_str!("../README.md")]

mod jump;
mod outlines;
mod path;
#[cfg(test)]
mod tests;

use outlines::Outlines;
use path::Guide;
use skein::{
    Error, Facts, Layer, Line, Micron, Move, Notes, Nozzle, Pen, Point, Point3, Ratio, Settings, Skein,
    Stage, boundary,
};

/// Leads travels over the clay.
#[derive(Clone, Debug, Settings)]
pub struct Comb {
    /// How far inside the outline a travel keeps where it turns, in bead widths; less where the clay is too narrow for
    /// that. 0.5 is the middle of the outermost bead; more keeps what drips from the nozzle off the surface.
    #[setting(default = 0.5, min = 0.0, max = 10.0)]
    pub margin_over_bead_width: Ratio,
    /// How far the nozzle runs straight ahead before it leaves an island and after it has come to another, in bead
    /// widths, counted from one bead inside the outline. What it loses then falls on clay. 0 leaves at the outline itself.
    #[setting(default = 1.0, min = 0.0, max = 50.0)]
    pub running_jump_space_over_bead_width: Ratio,
    /// How many millimetres of detour one millimetre less of open air is worth. With 0 no travel becomes longer; more
    /// leads further around holes, which takes time.
    #[setting(default = 4.0, min = 0.0, max = 1000.0)]
    pub detour_over_open_air: Ratio,
}

impl Stage for Comb {
    const NAME: &'static str = "comb";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let measures = self.measures(&skein.facts()?)?;
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, _| Ok(measures.layer(layer, &nozzles[index])))
    }
}

impl Comb {
    fn measures(&self, facts: &Facts) -> Result<Measures, Error> {
        let width = facts.bead_width()?;
        let running_jump = self.running_jump_space_over_bead_width;
        Ok(Measures {
            width: width.um(),
            margin: width.um() * self.margin_over_bead_width.f64(),
            run_up: if running_jump.0 == 0 { 0.0 } else { width.um() * (1.0 + running_jump.f64()) },
            price: self.detour_over_open_air.f64(),
        })
    }
}

/// The settings in microns.
#[derive(Clone, Copy, Debug)]
struct Measures {
    width: f64,
    /// How far inside the outline a way turns.
    margin: f64,
    /// How far inside the outline a jump between islands begins and ends; 0 for at the outline.
    run_up: f64,
    /// What a micron of open air costs more than one of clay.
    price: f64,
}

impl Measures {
    /// The layer with its travels led over its own clay; the first of them comes from the layer below.
    fn layer(&self, layer: Layer, entering: &Nozzle) -> Vec<Line> {
        let Some((last, top)) = last_bead(&layer.lines, entering) else { return layer.lines };
        let mut was = *entering;
        let mut guide = None;
        let mut led: Vec<(usize, Vec<Point>)> = Vec::new();
        for (index, line) in layer.lines[..last].iter().enumerate() {
            if let Some((from, to)) = self.travel(line, &was, top) {
                let guide =
                    guide.get_or_insert_with(|| Guide::new(Outlines::new(&boundary(&layer.lines)), *self));
                let way = guide.way(from, to);
                if !way.is_empty() {
                    led.push((index, way));
                }
            }
            was.follow(line);
        }
        if led.is_empty() { layer.lines } else { write(layer.lines, entering, led) }
    }

    /// The ends of a line that is a travel on the layer. One that flies above it, or is shorter than a bead is wide, has
    /// nothing to go around.
    fn travel(&self, line: &Line, was: &Nozzle, top: Micron) -> Option<(Point, Point)> {
        let (Line::Move(Move { to, extrusion: None, .. }), Some(from), false) = (line, was.at, was.on) else {
            return None;
        };
        let (start, end) = (Point::new(from.x, from.y), Point::new(to.x, to.y));
        (from.z.max(to.z) <= top.0 && start.distance(end) > self.width).then_some((start, end))
    }
}

/// Where the last bead of a layer begins, and how high its highest bead is; nothing when it has none. Travels behind the
/// last bead park the nozzle, and are meant as they are.
fn last_bead(lines: &[Line], entering: &Nozzle) -> Option<(usize, Micron)> {
    let last = lines.iter().rposition(|line| *line == Line::On)?;
    let mut on = entering.on;
    let mut top = None;
    for line in lines {
        match line {
            Line::On => on = true,
            Line::Off => on = false,
            _ if on => top = top.max(line.as_move().map(|step| step.to.z)),
            _ => {}
        }
    }
    top.map(|top| (last, Micron(top)))
}

/// Writes a layer with way points in front of some of its travels. They lie at the higher end of the travel, so that
/// the nozzle does not plough through what is laid, and are reached at its speed.
fn write(lines: Vec<Line>, entering: &Nozzle, led: Vec<(usize, Vec<Point>)>) -> Vec<Line> {
    let mut was = *entering;
    let mut pen = Pen::new(entering, lines.len() + led.iter().map(|(_, way)| way.len()).sum::<usize>());
    let mut led = led.into_iter().peekable();
    for (index, line) in lines.into_iter().enumerate() {
        let before = was;
        was.follow(&line);
        match (led.next_if(|(at, _)| *at == index), &line, before.at) {
            (Some((_, way)), Line::Move(step), Some(from)) => {
                let feed = step.feed.or(before.feed);
                let z = from.z.max(step.to.z);
                way.into_iter().for_each(|at| pen.go(Point3 { x: at.x, y: at.y, z }, feed));
                pen.step(Move { feed, ..*step });
            }
            _ => pen.pass(line, &before),
        }
    }
    pen.finish(&was)
}
