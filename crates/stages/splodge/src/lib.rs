#![doc = include_str!("../README.md")]

use skein::{
    End, Error, Facts, Feed, Layer, Line, Micron, Notes, Nozzle, OrLag, Pen, Point3, Ratio, Settings, Skein,
    Span, Stage, Thread, spans,
};

#[cfg(test)]
mod tests;

/// Lays a blob of clay where a bead begins.
#[derive(Clone, Debug, Settings)]
pub struct Splodge {
    /// How much clay the blob of the very first bead takes, as a length of bead. Less than a tenth of a bead width is
    /// none.
    #[setting(default = 30.0, min = 0.0, max = 10000.0, unit = "mm")]
    pub initial_quantity: Micron,
    /// How fast it is laid.
    #[setting(default = 2.0, min = 0.001, max = 1000.0, unit = "mm/s")]
    pub initial_feed: Feed,
    /// How far the nozzle is lifted for it, as a share of how much higher the blob is than a bead. Thread-thin plastic
    /// wants 1; through a blob of clay the nozzle ploughs when it comes down again, so it stays down and the blob becomes
    /// wide.
    #[setting(default = 0.0, min = 0.0, max = 10.0)]
    pub initial_lift: Ratio,
    /// The same for the blobs of all other beads. With "lag" it is what is missing until the clay has followed, less what
    /// oozebane has made up for.
    #[setting(default = OrLag::Lag, min = 0.0, max = 10000.0, unit = "mm")]
    pub operating_quantity: OrLag<Micron>,
    /// How fast those are laid.
    #[setting(default = 2.0, min = 0.001, max = 1000.0, unit = "mm/s")]
    pub operating_feed: Feed,
    /// How far the nozzle is lifted for those.
    #[setting(default = 0.0, min = 0.0, max = 10.0)]
    pub operating_lift: Ratio,
}

impl Stage for Splodge {
    const NAME: &'static str = "splodge";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let mut facts = skein.facts()?;
        let quantity = self.operating_quantity.way(&facts, End::Start, facts.operating_feed())?;
        let Some(room) = Room::of(&skein) else { return Ok(skein) };
        let first = skein.layers.iter().position(|layer| layer.lines.contains(&Line::On));
        let initial = Blob::new(self.initial_quantity.um(), self.initial_feed, self.initial_lift, &facts)?;
        let usual = Blob::new(quantity, self.operating_feed, self.operating_lift, &facts)?;
        facts.made_up(End::Start, quantity);
        skein.state(&facts)?;
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, _| {
            let first = if first == Some(index) { &initial } else { &usual };
            Ok(lay(layer, &nozzles[index], &room, first, &usual))
        })
    }
}

/// A blob, in microns.
#[derive(Debug)]
struct Blob {
    /// How far before the bead it begins.
    length: f64,
    feed: Feed,
    /// So much of the nominal section is laid on its way: what it takes over its length.
    flow: Ratio,
    lift: i32,
}

impl Blob {
    /// Nothing when it is too small to be one.
    ///
    /// It is laid on a way as much shorter as it is slower, and is higher by the root of that (stages.md §6.18).
    fn new(quantity: f64, feed: Feed, lift: Ratio, facts: &Facts) -> Result<Option<Self>, Error> {
        if quantity < 0.1 * facts.bead_width()?.um() {
            return Ok(None);
        }
        let height = facts.layer_height()?.um();
        let slower = feed.mm_per_s() / facts.operating_feed()?.mm_per_s();
        let high = || {
            Error::new(format!("a blob laid at {} mm/s would take too much clay at a spot", feed.mm_per_s()))
                .hint("the feed of a blob is nearer to that of the beads")
        };
        Ok(Some(Self {
            length: quantity * slower,
            feed,
            flow: Ratio::from_f64(1.0 / slower).ok_or_else(high)?,
            lift: ((height / slower.sqrt() - height).max(0.0) * lift.f64()).round() as i32,
        }))
    }
}

/// The box around all that is printed: a blob is laid within it.
#[derive(Debug)]
struct Room {
    x: (i32, i32),
    y: (i32, i32),
}

impl Room {
    fn of(skein: &Skein) -> Option<Self> {
        let places = || skein.layers.iter().flat_map(|layer| &layer.lines).filter_map(Line::as_move);
        let ends = |of: fn(Point3) -> i32| {
            let values = || places().map(|step| of(step.to));
            Some((values().min()?, values().max()?))
        };
        Some(Self { x: ends(|at| at.x)?, y: ends(|at| at.y)? })
    }

    fn holds(&self, at: Point3) -> bool {
        (self.x.0..=self.x.1).contains(&at.x) && (self.y.0..=self.y.1).contains(&at.y)
    }

    /// A place at a distance from the start of a thread: behind it, or turned as little as is needed to stay in the box.
    fn beside(&self, thread: &Thread, distance: f64) -> Option<Point3> {
        const TURNS: [f64; 7] = [0.0, 45.0, -45.0, 90.0, -90.0, 135.0, -135.0];
        let start = thread.start;
        let flat = |at: Point3| (f64::from(at.x - start.x), f64::from(at.y - start.y));
        let (x, y) = thread.stretches.iter().map(|piece| flat(piece.step.to)).find(|to| *to != (0.0, 0.0))?;
        let length = libm::hypot(x, y);
        let turned = TURNS.iter().map(|degrees| {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            let (x, y) = (-x / length * distance, -y / length * distance);
            let by = |value: f64| value.round() as i32;
            Point3 { x: start.x + by(x * cos - y * sin), y: start.y + by(x * sin + y * cos), ..start }
        });
        turned.into_iter().find(|at| self.holds(*at))
    }
}

/// Lays a blob before every thread of a layer; the first thread may have another.
fn lay(
    layer: Layer,
    entering: &Nozzle,
    room: &Room,
    first: &Option<Blob>,
    usual: &Option<Blob>,
) -> Vec<Line> {
    let mut was = *entering;
    let mut pen = Pen::new(entering, layer.lines.len() + 64);
    let mut blob = first;
    for span in spans(&layer.lines, entering.on) {
        if let (Span::Thread(lines), false) = (span, was.on) {
            if let (Some(blob), Some(thread)) = (blob, Thread::read(lines, &was))
                && let Some(beside) = room.beside(&thread, blob.length)
            {
                let up = |at: Point3| Point3 { z: at.z + blob.lift, ..at };
                pen.arrive(up(beside));
                pen.flow(blob.flow);
                pen.on();
                pen.go(up(thread.start), Some(blob.feed));
                if blob.lift > 0 {
                    // Down to the bead without clay: what it needs is there.
                    pen.flow(Ratio(0));
                    pen.go(thread.start, Some(blob.feed));
                }
            }
            blob = usual;
        }
        for line in span.lines() {
            // The blob has started the clay already.
            if !(matches!(line, Line::On) && pen.nozzle().on) {
                pen.pass(line.clone(), &was);
            } else {
                pen.flow(was.flow);
            }
            was.follow(line);
        }
    }
    pen.finish(&was)
}
