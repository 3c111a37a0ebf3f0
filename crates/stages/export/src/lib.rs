#![doc = include_str!("../README.md")]

mod entry;
mod extruder;
mod name;
mod pen;
mod remarks;
mod replace;
#[cfg(test)]
mod tests;

use entry::{Change, Entry};
use pen::{Pen, Style};
use rayon::prelude::*;
use replace::Table;
use skein::{Choice, Error, Layer, Line, Notes, Place, Settings, Skein};

pub use name::Naming;

/// Writes the file that the machine reads.
#[derive(Clone, Debug, Settings)]
pub struct Export {
    /// What the file says beside its commands. Less makes a smaller file that viewers understand less.
    #[setting(default = Comments::Layers)]
    pub comments: Comments,
    /// Decimals of coordinates. Fewer make a smaller file; at one decimal fine curves show steps.
    #[setting(default = 3, min = 1, max = 3)]
    pub decimals: u32,
    /// Lines where clay starts to flow, for machines whose pump is no axis: a valve (`M106`), a screw (`M3 S<pwm>`).
    /// `<flow>` is the share of the nominal bead, `<percent>` a hundred times and `<pwm>` 255 times that.
    #[setting(default = "")]
    pub on: String,
    /// Lines where clay stops.
    #[setting(default = "")]
    pub off: String,
    /// Lines where the flow changes while clay flows, with the same words.
    #[setting(default = "")]
    pub flow: String,
    /// Replacements in the finished lines, one a line: what is replaced, a tab, and what takes its place, in which `\n`
    /// begins a new line. A rule that is a whole word replaces whole words only.
    #[setting(default = "")]
    pub replace: String,
    /// What is added to the name of the part to make that of the file.
    #[setting(default = "")]
    pub suffix: String,
    /// Whether the name of the file says the profile.
    #[setting(default = false)]
    pub name_has_profile: bool,
    /// Whether the name of the file says layer height, bead width, walls and infill.
    #[setting(default = false)]
    pub name_has_description: bool,
    /// Whether the name of the file says the day and the time.
    #[setting(default = false)]
    pub name_has_time: bool,
    /// How the name of the file ends.
    #[setting(default = "gcode")]
    pub file_extension: String,
}

/// What the file says beside its commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Comments {
    /// A head, and for each layer and bead what viewers understand.
    Layers,
    /// The head only.
    Head,
    /// Nothing.
    None,
    /// Every tag of the stages, as they read it.
    Tags,
    /// The tags of the header only.
    HeadTags,
}

/// So many layers are formatted side by side and handed on before the next ones: enough to keep the cores busy, few
/// enough that neither the skein nor the text is ever whole beside the other.
const BATCH: usize = 64;

impl Export {
    /// The craft word.
    pub const NAME: &'static str = "export";

    /// Writes the file in pieces, each ending with a line; the skein is taken apart on the way, so that it and the
    /// text are never whole in memory together.
    ///
    /// # Errors
    /// When the start or the end would heat, when the header lacks a fact, or with what the sink says.
    pub fn export(
        &self,
        skein: Skein,
        notes: &mut Notes,
        sink: &mut dyn FnMut(&[u8]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        self.keep_cold(&skein)?;
        let style = Style::new(self, &skein)?;
        let table = Table::read(&self.replace)?;
        let mut sink = |text: Vec<u8>| match table.apply(&text) {
            Some(text) => sink(&text),
            None => sink(&text),
        };
        if !skein.has_done("dimension") {
            notes.say("dimension has not run, so nothing says how much clay a move pushes");
        }

        let mut text = Vec::new();
        remarks::head(&skein, self.comments, &mut text)?;
        let Skein { head, layers, tail } = skein;
        let mut pen = Pen::new(&style, Entry::default(), None, text);
        pen.lines(&head);
        sink(pen.text)?;

        let (entries, leaving) = entries(Entry::default().after(Change::of(&head)), &layers);
        drop(head);
        let mut layers = layers.into_iter().zip(entries).enumerate();
        loop {
            let batch: Vec<_> = layers.by_ref().take(BATCH).collect();
            if batch.is_empty() {
                break;
            }
            let pieces: Vec<Result<Vec<u8>, Error>> = batch
                .into_par_iter()
                .map(|(index, (layer, entry))| piece(&style, index, layer, entry))
                .collect();
            for text in pieces {
                sink(text?)?;
            }
        }

        let mut pen = Pen::new(&style, leaving, None, Vec::new());
        pen.lines(&tail);
        sink(pen.text)
    }

    /// Whatever stage or hand has put it there: no line heats what the machine cannot heat.
    fn keep_cold(&self, skein: &Skein) -> Result<(), Error> {
        let heaters = skein.facts()?.heaters.unwrap_or_default();
        let hot = |lines: &[Line]| {
            lines.iter().filter_map(Line::plain).find(|text| heaters.refuse(text)).map(str::to_owned)
        };
        let refuse = |text: String, place: Place| {
            Error::new(format!("`{}` heats", text.trim()))
                .at(place)
                .hint("a clay printer has no heater: leave the line out, or name it in machine.heaters")
        };
        for lines in [&skein.head, &skein.tail] {
            if let Some(text) = hot(lines) {
                return Err(refuse(text, Place::Whole));
            }
        }
        let layers: Vec<Option<String>> = skein.layers.par_iter().map(|layer| hot(&layer.lines)).collect();
        match layers.into_iter().enumerate().find_map(|(index, text)| Some((index, text?))) {
            Some((index, text)) => Err(refuse(text, Place::Layer(index))),
            None => Ok(()),
        }
    }
}

/// The text of one layer, which is dropped.
fn piece(style: &Style, index: usize, layer: Layer, entry: Entry) -> Result<Vec<u8>, Error> {
    // Most lines are beads of two coordinates and an E.
    let mut text = Vec::with_capacity(layer.lines.len() * 28 + 64);
    let size = style.size(&layer).map_err(|error| error.at(Place::Layer(index)))?;
    if style.comments == Comments::Layers {
        remarks::layer(index, size, &mut text);
    }
    let mut pen = Pen::new(style, entry, Some(size), text);
    pen.lines(&layer.lines);
    Ok(pen.text)
}

/// What the machine knows when each layer begins, and when the last one ends. The layers are searched side by side,
/// since a skein without any M108 is searched to its first line.
fn entries(mut entry: Entry, layers: &[Layer]) -> (Vec<Entry>, Entry) {
    let changes: Vec<Change> = layers.par_iter().map(|layer| Change::of(&layer.lines)).collect();
    let step = |change| {
        let next = entry.after(change);
        std::mem::replace(&mut entry, next)
    };
    let entries = changes.into_iter().map(step).collect();
    (entries, entry)
}
