#![doc = include_str!("../README.md")]

use skein::{
    Choice, Error, Layer, Line, Micron, Notes, Nozzle, Pen, Point, Point3, Ratio, Settings, Skein, Stage, Tag,
};

#[cfg(test)]
mod tests;

/// Prints the part in rows and columns.
#[derive(Clone, Debug, Settings)]
pub struct Multiply {
    /// Copies along x.
    #[setting(default = 2, min = 1, max = 1000)]
    pub columns: u32,
    /// Copies along y.
    #[setting(default = 2, min = 1, max = 1000)]
    pub rows: u32,
    /// How much room is left between two copies, in bead widths.
    #[setting(default = 5.0, min = 0.0, max = 1000.0)]
    pub separation_over_bead_width: Ratio,
    /// Where the middle of all copies is.
    #[setting(default = Place::Part)]
    pub place: Place,
    /// The middle of all copies when `place` is `"center"`.
    #[setting(default = Point::new(100000, 100000), min = -10000.0, max = 10000.0, unit = "mm")]
    pub center: Point,
    /// Whether odd layers go through the rows from the last to the first, so that each layer begins where the one below
    /// has ended.
    #[setting(default = false)]
    pub reverse_odd_layers: bool,
}

/// Where the middle of all copies is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Place {
    /// Where the middle of the part is.
    Part,
    /// At `center`.
    Center,
}

impl Stage for Multiply {
    const NAME: &'static str = "multiply";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let width = skein.facts()?.bead_width()?;
        let Some(bounds) = laid(&skein) else { return Ok(skein) };
        let shifts = self.shifts(bounds, width)?;
        let nozzles = skein.nozzles();
        let mut layers = skein.layers.iter().zip(&nozzles);
        if self.columns * self.rows > 1 && layers.any(|(layer, entering)| goes_on(layer, entering)) {
            return Err(Error::new(
                "clay goes on from layer to layer and cannot be laid in turns with its copies",
            )
            .hint(way_out(&skein)));
        }
        let skein = skein.rewrite(notes, |index, layer, _| {
            Ok(repeat(layer, &nozzles[index], self.order(index).into_iter().map(|copy| shifts[copy])))
        })?;
        notes.say(format!("{} copies", self.columns * self.rows));
        Ok(skein)
    }
}

/// Whether clay flows into the part of a layer that is laid for each copy, or out of it.
fn goes_on(layer: &Layer, entering: &Nozzle) -> bool {
    let mut nozzle = *entering;
    layer.lines[..end(layer)].iter().for_each(|line| nozzle.follow(line));
    entering.on || nozzle.on
}

/// Where a layer ends; what stands behind is no part of it.
fn end(layer: &Layer) -> usize {
    let close = layer.lines.iter().position(|line| *line == Line::Close(Tag::Layer));
    close.unwrap_or(layer.lines.len())
}

/// What helps where clay goes on from layer to layer, by what the header says of the stages that have been here.
fn way_out(skein: &Skein) -> String {
    let through = |line: &Line| matches!(line, Line::Value(pair) if &*pair.0 == "setting" && &*pair.1 == "join through_layers true");
    let coil = skein.has_done("coil").then_some("`coil.active`");
    let join = skein.head.iter().any(through).then_some("`join.through_layers`");
    let settings: Vec<&str> = coil.into_iter().chain(join).collect();
    let apart = "print the parts one after the other";
    match settings.is_empty() {
        true => apart.to_string(),
        false => format!("{apart}, or set {} to false", settings.join(" and ")),
    }
}

/// The corners of the box around all beads, in microns: the places between which clay flows.
fn laid(skein: &Skein) -> Option<(Point, Point)> {
    let mut bounds: Option<(Point, Point)> = None;
    let mut nozzle = Nozzle::default();
    for line in skein.lines() {
        let from = nozzle.at;
        nozzle.follow(line);
        if let (true, Some(step)) = (nozzle.on, line.as_move()) {
            for at in from.into_iter().chain([step.to]) {
                let (min, max) = bounds.unwrap_or((Point::new(at.x, at.y), Point::new(at.x, at.y)));
                bounds = Some((
                    Point::new(min.x.min(at.x), min.y.min(at.y)),
                    Point::new(max.x.max(at.x), max.y.max(at.y)),
                ));
            }
        }
    }
    bounds
}

impl Multiply {
    /// How far each copy lies from the part, row by row.
    fn shifts(&self, (min, max): (Point, Point), width: Micron) -> Result<Vec<Point>, Error> {
        let gap = (width.um() * self.separation_over_bead_width.f64()).round() as i64;
        let middle = |low: i32, high: i32| i64::midpoint(i64::from(low), i64::from(high));
        let axis = |low: i32, high: i32, count: u32, center: i32| -> Result<Vec<i32>, Error> {
            let pitch = i64::from(high) - i64::from(low) + gap;
            let first = match self.place {
                Place::Part => 0,
                Place::Center => i64::from(center) - middle(low, high),
            } - pitch * (i64::from(count) - 1) / 2;
            let shifts = (0..i64::from(count)).map(|index| {
                let shift = first + index * pitch;
                let fits =
                    [low, high].iter().all(|end| Micron::from_places(i64::from(*end) + shift).is_some());
                i32::try_from(shift).ok().filter(|_| fits)
            });
            shifts.collect::<Option<_>>().ok_or_else(|| {
                Error::new(format!("{count} copies reach further than any machine does"))
                    .hint("fewer columns or rows, or less separation")
            })
        };
        let x = axis(min.x, max.x, self.columns, self.center.x)?;
        let y = axis(min.y, max.y, self.rows, self.center.y)?;
        Ok(y.iter().flat_map(|y| x.iter().map(|x| Point::new(*x, *y))).collect())
    }

    /// The order in which a layer goes through the copies: from side to side, so that the way between them is short.
    /// The rows are counted through all layers, so that with one row the direction changes from layer to layer.
    fn order(&self, layer: usize) -> Vec<usize> {
        let (columns, rows) = (self.columns as usize, self.rows as usize);
        let mut order = Vec::with_capacity(columns * rows);
        for number in 0..rows {
            let row = if self.reverse_odd_layers && layer % 2 == 1 { rows - 1 - number } else { number };
            let copies = row * columns..(row + 1) * columns;
            if (layer * rows + number).is_multiple_of(2) {
                order.extend(copies)
            } else {
                order.extend(copies.rev())
            }
        }
        order
    }
}

/// The layer with everything that is laid on it once for each copy; what is said to the machine is said once.
fn repeat(layer: Layer, entering: &Nozzle, shifts: impl ExactSizeIterator<Item = Point>) -> Vec<Line> {
    let body = layer.heading();
    // What stands behind the layer's end is said once, too.
    let end = end(&layer);
    let mut pen = Pen::new(entering, layer.lines.len() * shifts.len());
    layer.lines[..body].iter().for_each(|line| pen.push(line.clone()));
    let mut was = *entering;
    for (number, shift) in shifts.enumerate() {
        was = *entering;
        for line in &layer.lines[body.min(end)..end] {
            let said = matches!(
                line,
                Line::Verbatim(_)
                    | Line::Pasted(_)
                    | Line::Open(Tag::Alteration)
                    | Line::Close(Tag::Alteration)
            );
            if number == 0 || !said {
                pen.pass(moved(line.clone(), shift), &was);
            }
            was.follow(line);
        }
    }
    layer.lines[end.max(body)..].iter().for_each(|line| pen.push(line.clone()));
    pen.finish(&was)
}

fn moved(mut line: Line, by: Point) -> Line {
    let shift = |at: &mut Point3| (at.x, at.y) = (at.x + by.x, at.y + by.y);
    if let Line::Point(_, at) = &mut line {
        shift(at);
    } else if let Some(step) = line.as_move_mut() {
        shift(&mut step.to);
    }
    line
}
