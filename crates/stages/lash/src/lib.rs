#![doc = include_str!("../README.md")]

use skein::{Error, Line, Micron, Notes, Nozzle, Point3, Ratio, Settings, Skein, Stage};

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
        let mut carriage = Carriage { lash: self, nozzle: Nozzle::default(), driven: None, side: (0, 0) };
        skein.head.iter_mut().try_for_each(|line| carriage.drive(line).map(drop))?;
        for (index, layer) in skein.layers.iter_mut().enumerate() {
            layer.lines =
                carriage.layer(std::mem::take(&mut layer.lines)).map_err(|error| error.in_layer(index))?;
        }
        skein.tail.iter_mut().try_for_each(|line| carriage.drive(line).map(drop))?;
        Ok(skein)
    }
}

/// What carries the nozzle: where it was meant to be and is driven to, and on which side of its play each axis rests.
struct Carriage<'a> {
    lash: &'a Lash,
    /// As the lines mean it that have come so far.
    nozzle: Nozzle,
    driven: Option<Point3>,
    /// 1 after moving up, -1 after moving down, 0 before the first move of the axis.
    side: (i32, i32),
}

impl Carriage<'_> {
    /// The lines of a layer. While an axis takes up its play the nozzle stands still, so a move that is driven further than
    /// the nozzle goes lays the clay of its own length.
    fn layer(&mut self, old: Vec<Line>) -> Result<Vec<Line>, Error> {
        let mut lines = Vec::with_capacity(old.len());
        let mut said = self.nozzle.flow;
        for mut line in old {
            let lays = self.nozzle.on && line.as_move().is_some_and(|step| step.extrusion.is_none());
            let share = self.drive(&mut line)?;
            let flow = self.nozzle.flow;
            let wanted = share.filter(|_| lays).and_then(|share| Ratio::from_f64(flow.f64() * share));
            let wanted = wanted.unwrap_or(flow);
            if wanted != said && !matches!(line, Line::Flow(_)) {
                lines.push(Line::Flow(wanted));
            }
            said = wanted;
            lines.push(line);
        }
        if said != self.nozzle.flow {
            lines.push(Line::Flow(self.nozzle.flow));
        }
        Ok(lines)
    }

    /// Moves the end of a move by the play of its axes, and says how much of the way the nozzle goes. An axis that does not
    /// move rests where it did.
    fn drive(&mut self, line: &mut Line) -> Result<Option<f64>, Error> {
        if matches!(line, Line::Arc(_)) {
            return Err(Error::new("an arc cannot make up for the play of the axes")
                .hint("lash works on straight moves: put it before fillet, or let fillet make segments"));
        }
        let from = self.nozzle.at;
        self.nozzle.follow(line);
        let Some(step) = line.as_move_mut() else { return Ok(None) };
        let meant = *step;
        if let Some(from) = from {
            let turn = |side: i32, from: i32, to: i32| if to == from { side } else { (to - from).signum() };
            self.side = (turn(self.side.0, from.x, meant.to.x), turn(self.side.1, from.y, meant.to.y));
        }
        step.to.x += self.side.0 * self.lash.x_backlash.0;
        step.to.y += self.side.1 * self.lash.y_backlash.0;
        let driven = self.driven.replace(step.to).map(|driven| step.length(driven));
        let went = from.map(|from| meant.length(from));
        Ok(went.zip(driven).filter(|(_, driven)| *driven > 0.0).map(|(went, driven)| went / driven))
    }
}
