//! Where the part begins on a layer, and how clay flows on into it.

use skein::{Feed, Layer, Line, Nozzle, Point3, Tag};

/// The first bead of a layer.
pub(crate) struct Lead {
    /// Where lines go that come before it.
    pub(crate) at: usize,
    /// Where it starts, if the nozzle can go there straight from what comes before.
    pub(crate) start: Option<Point3>,
    /// Its speed.
    pub(crate) feed: Option<Feed>,
    /// The nozzle as it starts.
    pub(crate) first: Option<Nozzle>,
    /// Its line that lets clay flow.
    on: usize,
}

impl Lead {
    pub(crate) fn find(layer: &Layer, mut nozzle: Nozzle) -> Self {
        let lines = &layer.lines;
        let opening = layer.opening();
        let on = lines.iter().position(|line| *line == Line::On);
        let end = on.unwrap_or(lines.len());
        // Behind what the machine does before it lays anything: warming up, going around while it does.
        let opens = |line: &Line| match line {
            Line::Open(tag) => *tag != Tag::Alteration,
            line => matches!(line, Line::Wall(..)),
        };
        let block = (opening..end).find(|index| opens(&lines[*index]));
        let at = block.unwrap_or(opening).min(end);
        let mut start = None;
        let mut foreign = false;
        for (index, line) in lines[..end].iter().enumerate() {
            nozzle.follow(line);
            if index >= at {
                start = line.as_move().map_or(start, |step| Some(step.to));
                foreign |= matches!(line, Line::Verbatim(_) | Line::Pasted(_) | Line::Arc(_));
            }
        }
        let first = on.map(|_| nozzle);
        let bead = lines[end..].iter().find_map(Line::as_move);
        let feed = bead.and_then(|step| step.feed.or(nozzle.feed));
        Self { at, start: start.filter(|_| on.is_some() && !foreign), feed, first, on: end }
    }

    /// Takes out the way to the first bead and the start of its clay: both are there already.
    pub(crate) fn take_over(&self, lines: &mut Vec<Line>) {
        if let Some(step) = lines[self.on..].iter_mut().find_map(Line::as_move_mut) {
            step.feed = step.feed.or(self.feed);
        }
        let mut index = 0;
        lines.retain(|line| {
            index += 1;
            let between = (self.at..self.on).contains(&(index - 1)) && line.as_move().is_some();
            !between && index - 1 != self.on
        });
    }
}
