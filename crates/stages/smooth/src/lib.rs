#![doc = include_str!("../README.md")]

#[cfg(test)]
mod tests;

use skein::{
    Error, Feature, Feed, Layer, Line, Move, Notes, Nozzle, Point3, Ratio, Settings, Skein, Stage, Stretch,
    Thread, along,
};

/// Replaces short jags of the infill by straight lines.
#[derive(Clone, Debug, Settings)]
pub struct Smooth {
    /// The first layer that is smoothed, counted from 0.
    #[setting(default = 1, min = 0, max = 1000000)]
    pub layers_from: u32,
    /// How much shorter the way from one jag to the next may become, in spacings of the infill. More smooths longer jags,
    /// and lays wider beads in their place.
    #[setting(default = 1.2, min = 0.2, max = 2.0)]
    pub maximum_shortening_over_width: Ratio,
}

/// A shortcut is no longer than this many of the largest shortening (stages.md §7.5).
const LONGEST: f64 = 1.5;

/// The cosine beyond which two lines count as turned back upon each other: within three degrees, which is what rounding
/// to microns leaves of parallel lines of a tenth of a millimetre.
const BACK: f64 = -0.9986;

impl Stage for Smooth {
    const NAME: &'static str = "smooth";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let width = skein.facts()?.infill_width()?.um();
        let most = width * self.maximum_shortening_over_width.f64();
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, _| {
            let raw = index < usize::try_from(self.layers_from).unwrap_or(usize::MAX);
            Ok(if raw { layer.lines } else { smooth(layer, &nozzles[index], most) })
        })
    }
}

/// A layer with the jags of its infill made straight; `most` is the largest shortening in microns.
fn smooth(layer: Layer, entering: &Nozzle, most: f64) -> Vec<Line> {
    layer.rethread(entering, |thread, _, _| smoothed(thread, most))
}

/// The thread with a line from the middle of each stroke to the middle of the next wherever that is short enough; nothing
/// when it is nowhere.
fn smoothed(thread: &Thread, most: f64) -> Option<Thread> {
    let pieces: Vec<(Point3, Stretch)> = thread.pieces().map(|(from, piece)| (from, *piece)).collect();
    let mut done = Thread { start: thread.start, stretches: Vec::with_capacity(pieces.len()) };
    let (mut index, mut any) = (0, false);
    while let Some((from, piece)) = pieces.get(index) {
        let here = done.end();
        let jag = Jag::find(&pieces[index..], most);
        match jag {
            Some(jag) => {
                if here == *from {
                    done.stretches.push(Stretch { step: Move { to: jag.from, ..piece.step }, ..*piece });
                }
                done.stretches.push(jag.line);
                (index, any) = (index + jag.pieces, true);
            }
            None => {
                // The rest of a stroke whose first half a shortcut has replaced, or all of it.
                done.stretches.push(*piece);
                index += 1;
            }
        }
    }
    any.then_some(done)
}

/// Two strokes that turn back upon each other, and what lies between them.
struct Jag {
    /// The middle of the first.
    from: Point3,
    /// The shortcut to the middle of the second.
    line: Stretch,
    /// How many pieces lie before the second.
    pieces: usize,
}

/// So many pieces may lie between two strokes: one along the border of the infill, or some through the strip beside it.
const JOINTS: usize = 6;

impl Jag {
    /// The jag that the first of some pieces begins.
    fn find(pieces: &[(Point3, Stretch)], most: f64) -> Option<Self> {
        let longest = pieces.len().min(JOINTS + 2);
        (3..=longest).find_map(|count| Self::of(&pieces[..count], most))
    }

    /// Nothing when the first and the last piece are no strokes, or the shortcut would be too short or too long.
    fn of(pieces: &[(Point3, Stretch)], most: f64) -> Option<Self> {
        let [first, joints @ .., second] = pieces else { return None };
        let is_infill =
            |piece: &Stretch| piece.feature() == Feature::Infill && piece.step.extrusion.is_none();
        if !pieces.iter().all(|(_, piece)| is_infill(piece)) || cosine(first, second)? > BACK {
            return None;
        }
        let (from, to) = (middle(first), middle(second));
        let straight = Move::to(to).length(from);
        let ways: Vec<(&(Point3, Stretch), f64)> = [(first, 0.5), (second, 0.5)]
            .into_iter()
            .chain(joints.iter().map(|joint| (joint, 1.0)))
            .collect();
        let long: f64 = ways.iter().map(|(piece, share)| length(piece) * share).sum();
        if straight < 1.0 || long - straight >= most || straight >= LONGEST * most {
            return None;
        }
        // The same clay in the same time.
        let clay: f64 = ways.iter().map(|(piece, share)| length(piece) * share * piece.1.flow.f64()).sum();
        let feed = |piece: &Stretch| piece.step.feed.map(Feed::mm_per_s);
        let time: Option<f64> =
            ways.iter().map(|(piece, share)| Some(length(piece) * share / feed(&piece.1)?)).sum();
        let feed = time.and_then(|time| Feed::from_mm_per_s(straight / time)).or(second.1.step.feed);
        let flow = Ratio::from_f64(clay / straight)?;
        Some(Self {
            from,
            line: Stretch { step: Move { feed, ..Move::to(to) }, flow, ..second.1 },
            pieces: joints.len() + 1,
        })
    }
}

fn length((from, piece): &(Point3, Stretch)) -> f64 {
    piece.step.length(*from)
}

fn middle(piece: &(Point3, Stretch)) -> Point3 {
    along(piece.0, piece.1.step.to, length(piece) / 2.0)
}

/// The cosine of the angle between two pieces; nothing when one has no length.
fn cosine(one: &(Point3, Stretch), other: &(Point3, Stretch)) -> Option<f64> {
    let vector = |(from, piece): &(Point3, Stretch)| {
        let to = piece.step.to;
        let difference = |a: i32, b: i32| f64::from(b) - f64::from(a);
        (difference(from.x, to.x), difference(from.y, to.y))
    };
    let (a, b) = (vector(one), vector(other));
    let lengths = libm::hypot(a.0, a.1) * libm::hypot(b.0, b.1);
    (lengths > 0.0).then(|| (a.0 * b.0 + a.1 * b.1) / lengths)
}
