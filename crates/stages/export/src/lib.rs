#![doc = include_str!("../README.md")]

mod alteration;
mod entry;
mod pen;
mod remarks;
#[cfg(test)]
mod tests;

use alteration::Alteration;
use entry::{Change, Entry};
use pen::{Pen, Style};
use rayon::prelude::*;
use skein::{Choice, Error, Layer, Line, Notes, Place, Settings, Skein, Tag};

/// Writes the file that the machine reads.
#[derive(Clone, Debug, Settings)]
pub struct Export {
    /// Lines before the print: home, prime. The file has said millimetres and absolute coordinates before them, and says
    /// how E counts, from zero, behind them. They may not heat: a clay printer has nothing to heat.
    #[setting(default = "G28")]
    pub start: String,
    /// Lines after the print: relieve the pressure, lift, park. With `G92 E0` in front, a line with E is the same whether
    /// E counts from move to move or from the start. No line may lower the nozzle into the pot, and none may heat.
    #[setting(default = "G91\nG1 Z10 F600\nG90\nM84")]
    pub end: String,
    /// What the file says beside its commands. Less makes a smaller file that viewers understand less.
    #[setting(default = Comments::Layers)]
    pub comments: Comments,
    /// Decimals of coordinates. Fewer make a smaller file; at one decimal fine curves show steps.
    #[setting(default = 3, min = 1, max = 3)]
    pub decimals: u32,
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
        let start = Alteration::new("start", &self.start)?;
        let end = Alteration::new("end", &self.end)?;
        let style = Style::new(self, &skein)?;
        doubts(&skein, &end, notes);

        let mut text = Vec::new();
        remarks::head(&skein, self.comments, &mut text)?;
        let Skein { head, layers, tail } = skein;
        // What the header says of coordinates holds for the start, and the start cannot undo what is said of E.
        let crafting = head.iter().position(|line| *line == Line::Open(Tag::Crafting)).unwrap_or(head.len());
        let (header, crafting) = head.split_at(crafting);
        let mut pen = Pen::new(&style, Entry::default(), None, text);
        pen.lines(header);
        start.write(self.comments, &mut pen.text);
        // Nobody knows where the start leaves the nozzle.
        let entry = Entry { at: None, ..Entry::default().after(Change::of(header)) };
        let mut pen = Pen::new(&style, entry, None, pen.text);
        pen.lines(crafting);
        sink(&pen.text)?;

        let (entries, leaving) = entries(entry.after(Change::of(crafting)), &layers);
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
                sink(&text?)?;
            }
        }

        let mut pen = Pen::new(&style, leaving, None, Vec::new());
        pen.lines(&tail);
        end.write(self.comments, &mut pen.text);
        sink(&pen.text)
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

/// What a potter should look at before the file goes to the machine.
fn doubts(skein: &Skein, end: &Alteration<'_>, notes: &mut Notes) {
    if !skein.has_done("dimension") {
        notes.say("dimension has not run, so nothing says how much clay a move pushes");
    }
    // Where the layers end is high enough to compare with, and found without reading every line.
    let ends = skein.layers.iter().filter_map(|layer| layer.lines.iter().rev().find_map(Line::as_move));
    let top = ends.map(|step| step.to.z).max();
    if let Some(line) = top.and_then(|top| end.lowers(top)) {
        notes.say(format!("`{line}` at the end lowers the nozzle, perhaps into the pot"));
    }
}
