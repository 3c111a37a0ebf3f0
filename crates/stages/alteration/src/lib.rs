#![doc = include_str!("../README.md")]

mod redundant;
#[cfg(test)]
mod tests;
mod variables;

use skein::command::{command, word};
use skein::{Error, Heaters, Layer, Line, Notes, Place, Settings, Skein, Stage, Tag};
use variables::Variables;

/// Adds your own lines at the start, at the end and at the layers.
#[derive(Clone, Debug, Settings)]
pub struct Alteration {
    /// Lines before the print: home, prime. The file has said millimetres and absolute coordinates before them, and says
    /// how E counts, from zero, behind them.
    #[setting(default = "G28")]
    pub start: String,
    /// Lines after the print: relieve the pressure, lift, park. With `G92 E0` in front, a line with E is the same whether
    /// E counts from move to move or from the start. No line may lower the nozzle into the pot.
    #[setting(default = "G91\nG1 Z10 F600\nG90\nM84")]
    pub end: String,
    /// Lines before each layer: a picture, a message, a pause.
    #[setting(default = "")]
    pub layer: String,
    /// The first layer that gets `layer`, counted from 0.
    #[setting(default = 0, min = 0, max = 1000000)]
    pub from_layer: u32,
    /// Every so many layers get `layer`.
    #[setting(default = 1, min = 1, max = 1000000)]
    pub period: u32,
    /// Whether a temperature (M104, M140) or a flow (M108) that is overwritten before anything moves is left out.
    #[setting(default = true)]
    pub remove_redundant: bool,
}

impl Stage for Alteration {
    const NAME: &'static str = "alteration";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let heaters = skein.facts()?.heaters.unwrap_or_default();
        let variables = Variables::of(&skein);
        let block = |name: &str, template: &str, variables: &Variables| -> Result<Vec<Line>, Error> {
            let text = variables.fill(template).map_err(|error| error.at(in_setting(name, None)))?;
            cold(name, &text, heaters)?;
            let block = Line::alteration(&text);
            // A block without lines is none.
            Ok(if block.len() == 2 { Vec::new() } else { block })
        };
        let start = block("start", &self.start, &variables)?;
        let end = block("end", &self.end, &variables)?;
        doubt_end(&skein, &end, notes);
        if !self.layer.trim().is_empty() {
            for (index, layer) in skein.layers.iter_mut().enumerate().skip(self.from_layer as usize) {
                if (index - self.from_layer as usize).is_multiple_of(self.period as usize) {
                    let lines = block("layer", &self.layer, &variables.in_layer(index, layer.z()))?;
                    let body = layer.heading();
                    layer.lines.splice(body..body, lines);
                }
            }
        }
        // Behind what the header says of coordinates and before what is said of clay.
        let crafting = skein.head.iter().position(|line| *line == Line::Open(Tag::Crafting));
        let index = crafting.unwrap_or(skein.head.len());
        skein.head.splice(index..index, start);
        if !skein.tail.is_empty() {
            skein.tail.extend(end);
        } else if !end.is_empty() {
            notes.say("the print has no end behind which the lines of `end` could stand");
        }
        if self.remove_redundant {
            redundant::remove(&mut skein.head);
            skein.each(|_, layer: &mut Layer| {
                redundant::remove(&mut layer.lines);
                Ok(())
            })?;
            redundant::remove(&mut skein.tail);
        }
        Ok(skein)
    }
}

fn in_setting(name: &str, line: Option<usize>) -> Place {
    Place::At(match line {
        Some(line) => format!("`{name}`, line {}", line + 1),
        None => format!("`{name}`"),
    })
}

/// A line that heats what the machine cannot heat is refused.
fn cold(name: &str, text: &str, heaters: Heaters) -> Result<(), Error> {
    for (index, line) in text.lines().enumerate() {
        if heaters.refuse(line) {
            return Err(Error::new(format!("`{}` heats", line.trim()))
                .at(in_setting(name, Some(index)))
                .hint("a clay printer has no heater: leave the line out, or name it in machine.heaters"));
        }
    }
    Ok(())
}

/// Says when a line of the end lowers the nozzle.
fn doubt_end(skein: &Skein, end: &[Line], notes: &mut Notes) {
    // Where the layers end is high enough to compare with, and found without reading every line.
    let ends = skein.layers.iter().filter_map(|layer| layer.lines.iter().rev().find_map(Line::as_move));
    let Some(top) = ends.map(|step| step.to.z).max() else { return };
    let mut relative = false;
    for text in end.iter().filter_map(Line::plain) {
        match command(text) {
            Some((b'G', 90, _)) => relative = false,
            Some((b'G', 91, _)) => relative = true,
            Some((b'G', 0 | 1, words)) => {
                let floor = if relative { 0 } else { i64::from(top) };
                if word(words, b'Z').is_some_and(|z| z < floor) {
                    notes.say(format!("`{text}` at the end lowers the nozzle, perhaps into the pot"));
                    return;
                }
            }
            _ => {}
        }
    }
}
