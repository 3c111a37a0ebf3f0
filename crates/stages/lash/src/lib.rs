#![doc = include_str!("../README.md")]

use skein::{Error, Line, Micron, Notes, Point3, Settings, Skein, Stage};

#[cfg(test)]
mod tests;

/// Makes up for the play of the axes.
#[derive(Clone, Debug, Settings)]
pub struct Lash {
    /// How far the nozzle stays behind when x turns round: half of what a dial gauge shows between coming from the left
    /// and coming from the right.
    #[setting(default = 0.2, min = 0.0, max = 10.0, unit = "mm")]
    pub x_backlash: Micron,
    /// The same for y.
    #[setting(default = 0.3, min = 0.0, max = 10.0, unit = "mm")]
    pub y_backlash: Micron,
}

impl Stage for Lash {
    const NAME: &'static str = "lash";

    /// One line after the other, since the side on which an axis rests follows from all moves before.
    fn craft(&self, mut skein: Skein, _notes: &mut Notes) -> Result<Skein, Error> {
        let mut carriage = Carriage { lash: self, at: None, side: (0, 0) };
        skein.head.iter_mut().try_for_each(|line| carriage.follow(line))?;
        for (index, layer) in skein.layers.iter_mut().enumerate() {
            let done = layer.lines.iter_mut().try_for_each(|line| carriage.follow(line));
            done.map_err(|error| error.in_layer(index))?;
        }
        skein.tail.iter_mut().try_for_each(|line| carriage.follow(line))?;
        Ok(skein)
    }
}

/// What carries the nozzle: where it was meant to be, and on which side of its play each axis rests.
struct Carriage<'a> {
    lash: &'a Lash,
    at: Option<Point3>,
    /// 1 after moving up, -1 after moving down, 0 before the first move of the axis.
    side: (i32, i32),
}

impl Carriage<'_> {
    /// Moves the end of a move by the play of its axes. An axis that does not move rests where it did.
    fn follow(&mut self, line: &mut Line) -> Result<(), Error> {
        if matches!(line, Line::Arc(_)) {
            return Err(Error::new("an arc cannot make up for the play of the axes")
                .hint("lash works on straight moves: put it before fillet, or let fillet make segments"));
        }
        let Some(step) = line.as_move_mut() else { return Ok(()) };
        let to = step.to;
        if let Some(from) = self.at.replace(to) {
            let turn = |side: i32, from: i32, to: i32| if to == from { side } else { (to - from).signum() };
            self.side = (turn(self.side.0, from.x, to.x), turn(self.side.1, from.y, to.y));
        }
        step.to.x += self.side.0 * self.lash.x_backlash.0;
        step.to.y += self.side.1 * self.lash.y_backlash.0;
        Ok(())
    }
}
