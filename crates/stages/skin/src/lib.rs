#![doc = include_str!("../README.md")]

mod divide;
#[cfg(test)]
mod tests;

use divide::{Division, divided};
use skein::{
    Error, Feature, Layer, Line, Notes, Nozzle, Pen, Point3, Ratio, Settings, Skein, Span, Stage, Tag,
    Thread, spans,
};

/// Divides walls and tops into finer beads.
#[derive(Clone, Debug, Settings)]
pub struct Skin {
    /// The first layer that is divided, counted from 0.
    #[setting(default = 1, min = 0, max = 1000000)]
    pub layers_from: u32,
    /// In how many beads, one upon the other, the outermost wall of a layer is laid. More makes slopes smoother and
    /// takes as many times longer.
    #[setting(default = 2, min = 1, max = 3)]
    pub vertical_wall_divisions: u32,
    /// In how many beads side by side the outermost wall is laid. A nozzle lays no bead much narrower than it is.
    #[setting(default = 1, min = 1, max = 3)]
    pub horizontal_wall_divisions: u32,
    /// In how many beads, one upon the other, the infill of the topmost layer is laid.
    #[setting(default = 2, min = 1, max = 3)]
    pub vertical_infill_divisions: u32,
    /// In how many beads side by side the infill of the topmost layer is laid: two go there and back on either side of
    /// where the one lay. A nozzle lays no bead much narrower than it is.
    #[setting(default = 1, min = 1, max = 3)]
    pub horizontal_infill_divisions: u32,
    /// Whether the way to infill that lies lower than the layer leads over the layer. Otherwise it goes at the height of
    /// that infill, through the lower beads of the walls.
    #[setting(default = false)]
    pub hop_when_extruding_infill: bool,
    /// How much of a divided wall is left out at each of its ends, in bead widths; for those that `clip` has cut, nothing.
    #[setting(default = 0.0, min = 0.0, max = 10.0)]
    pub clip_over_bead_width: Ratio,
}

impl Stage for Skin {
    const NAME: &'static str = "skin";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        let widths = Widths { wall: facts.bead_width()?.um(), infill: facts.infill_width()?.um() };
        let nozzles = skein.nozzles();
        let highest = skein.highest();
        let beads = |(layer, nozzle): (&Layer, &Nozzle)| nozzle.on || layer.lines.contains(&Line::On);
        let top = skein.layers.iter().zip(&nozzles).rposition(beads);
        skein.rewrite(notes, |index, layer, notes| {
            if index < usize::try_from(self.layers_from).unwrap_or(usize::MAX) {
                return Ok(layer.lines);
            }
            // A bead that goes on from layer to layer has no place for others.
            if nozzles[index].on {
                notes.layer(index, "stays undivided: clay goes on there from the layer below, by `coil` or `join`");
                return Ok(layer.lines);
            }
            // Beside what stands higher than its foot already, as behind `tower`, a bead that lies lower than the layer
            // would be laid through it.
            let height = layer.height(&facts)?.0;
            let foot = layer.nozzle_z(&facts)?.0 - height;
            if highest[index].is_some_and(|highest| highest > foot) {
                notes.layer(index, "stays undivided beside what stands already");
                return Ok(layer.lines);
            }
            let knife = Knife { skin: self, height, widths, top: top == Some(index) };
            let mut whole = false;
            let lines = knife.layer(layer, &nozzles[index], &mut whole);
            if whole {
                notes.layer(
                    index,
                    "beads that are open, too narrow, not level or joined with others by `join` were not divided as was \
                     asked",
                );
            }
            Ok(lines)
        })
    }
}

/// The room that a bead takes beside its neighbours, in microns.
#[derive(Clone, Copy)]
struct Widths {
    wall: f64,
    infill: f64,
}

/// The stage at work on one layer.
struct Knife<'a> {
    skin: &'a Skin,
    /// In microns.
    height: i32,
    widths: Widths,
    /// Whether the layer is the topmost.
    top: bool,
}

/// A thread in finer beads.
struct Cut {
    feature: Feature,
    /// The nozzle in front of the thread.
    was: Nozzle,
    /// The beads of each height, from the lowest up; the last are at the height of the thread.
    heights: Vec<Vec<Thread>>,
}

impl Knife<'_> {
    /// The layer with finer beads. What lies lower comes first, so that the nozzle never goes through what already stands
    /// beside it.
    fn layer(&self, layer: Layer, entering: &Nozzle, whole: &mut bool) -> Vec<Line> {
        let cuts = self.cuts(&layer.lines, *entering, whole);
        let mut threads = cuts.iter();
        let mut was = *entering;
        let mut pen = Pen::new(entering, layer.lines.len() * 2);
        let mut fresh = true;
        for span in spans(&layer.lines, entering.on) {
            if fresh && is_of_a_bead(&span) {
                fresh = false;
                lay_lower(&mut pen, &cuts, self.skin.hop_when_extruding_infill);
            }
            let cut = match span {
                Span::Thread(_) => threads.next().and_then(Option::as_ref),
                _ => None,
            };
            let Some(threads) = cut.and_then(|cut| cut.heights.last()) else {
                pen.pass_all(span.lines(), &mut was);
                continue;
            };
            let feed = was.feed;
            span.lines().iter().for_each(|line| was.follow(line));
            for (number, thread) in threads.iter().enumerate() {
                if number == 0 {
                    pen.arrive(thread.start);
                } else {
                    pen.go(thread.start, feed);
                }
                pen.thread(thread, &was);
            }
        }
        pen.finish(&was)
    }

    /// The threads of a layer as they are cut; nothing for one that stays.
    fn cuts(&self, lines: &[Line], mut was: Nozzle, whole: &mut bool) -> Vec<Option<Cut>> {
        let mut cuts = Vec::new();
        for span in spans(lines, was.on) {
            if let Span::Thread(lines) = span {
                cuts.push(self.cut(lines, &was, whole));
            }
            span.lines().iter().for_each(|line| was.follow(line));
        }
        cuts
    }

    fn cut(&self, lines: &[Line], was: &Nozzle, whole: &mut bool) -> Option<Cut> {
        let Some(thread) = Thread::read(lines, was) else {
            *whole |= lines.iter().any(|line| matches!(line, Line::Arc(_)));
            return None;
        };
        let (division, width) = thread.stretches.iter().find_map(|piece| self.division(piece.feature()))?;
        // One that climbs, or goes on as another bead, cannot be laid twice.
        let block = thread.stretches.first().and_then(|first| first.block);
        let plain = |piece: &skein::Stretch| {
            piece.block == block && piece.step.extrusion.is_none() && piece.step.to.z == thread.start.z
        };
        if was.on || !thread.stretches.iter().all(plain) {
            *whole = true;
            return None;
        }
        let (heights, as_asked) = divided(&thread, division, self.height, width);
        *whole |= !as_asked;
        Some(Cut { feature: was.feature(), was: *was, heights })
    }

    /// How beads for something are divided, and their width in microns; nothing when they are not.
    fn division(&self, feature: Feature) -> Option<(Division, f64)> {
        let skin = self.skin;
        let (division, width) = match feature {
            Feature::Edge(_) => {
                let division = Division {
                    vertical: skin.vertical_wall_divisions,
                    horizontal: skin.horizontal_wall_divisions,
                    clip: skin.clip_over_bead_width.f64() * self.widths.wall,
                };
                (division, self.widths.wall)
            }
            Feature::Infill if self.top => {
                let division = Division {
                    vertical: skin.vertical_infill_divisions,
                    horizontal: skin.horizontal_infill_divisions,
                    clip: 0.0,
                };
                (division, self.widths.infill)
            }
            _ => return None,
        };
        (division.vertical > 1 || division.horizontal > 1).then_some((division, width))
    }
}

/// Whether a bead, or the way to it, begins here.
fn is_of_a_bead(span: &Span<'_>) -> bool {
    match span {
        Span::Thread(_) | Span::Travel(_) | Span::Other(Line::Wall(..)) => true,
        Span::Other(Line::Open(tag)) => {
            matches!(tag, Tag::Infill | Tag::Middle | Tag::Skirt | Tag::Support | Tag::Raft)
        }
        Span::Other(_) => false,
    }
}

/// Lays what is lower than the layer's own height, from the lowest up.
fn lay_lower(pen: &mut Pen, cuts: &[Option<Cut>], hop_to_infill: bool) {
    let mut lower: Vec<Lower<'_>> = cuts
        .iter()
        .flatten()
        .flat_map(|cut| {
            let (top, below) =
                cut.heights.split_last().map_or((&[][..], &[][..]), |(top, below)| (top, below));
            let top = top.first().map(|thread| thread.start.z);
            below.iter().flatten().map(move |thread| Lower { cut, thread, top })
        })
        .collect();
    lower.sort_by_key(|bead| bead.thread.start.z);
    for Lower { cut, thread, top } in lower {
        let (open, close) = cut.feature.tags();
        pen.push(open);
        let hop = top.filter(|_| hop_to_infill && cut.feature == Feature::Infill);
        if let (Some(z), Some(from)) = (hop, pen.nozzle().at) {
            pen.go(Point3 { z, ..from }, cut.was.feed);
            pen.go(Point3 { z, ..thread.start }, cut.was.feed);
        }
        pen.go(thread.start, cut.was.feed);
        pen.thread(thread, &Nozzle { on: false, ..*pen.nozzle() });
        pen.push(close);
    }
}

/// A bead that lies lower than its layer.
struct Lower<'a> {
    cut: &'a Cut,
    thread: &'a Thread,
    /// The height of the topmost bead of its cut.
    top: Option<i32>,
}
