//! The laws of a skein. They are checked on everything a stage returns; a broken law is our bug.
//!
//! * The header ends, and no layer begins in it.
//! * A layer's first line is its `(<layer>` line, and it has no other.
//! * Clay does not start while it flows, be it from the layer below.
//! * Blocks of a layer close in the order in which they opened, within their layer.
//! * The tail, if there is one, begins with the line that closes the crafting block.

use crate::{Error, Layer, Line, Skein, Tag};
use rayon::prelude::*;

impl Skein {
    /// Checks the laws.
    ///
    /// # Errors
    /// The first law that is broken, with the line of the skein's text.
    pub fn verify(&self) -> Result<(), Error> {
        if !self.head.contains(&Line::Close(Tag::ExtruderInitialization)) {
            return Err(Error::new("the header never ends"));
        }
        if let Some(index) = self.head.iter().position(|line| matches!(line, Line::Layer(_))) {
            return Err(Error::line(index, "a layer begins in the header"));
        }
        if self.tail.first().is_some_and(|line| *line != Line::Close(Tag::Crafting)) {
            return Err(Error::line(self.lines().count() - self.tail.len(), "the last layer never ends"));
        }
        let mut flows = flows_behind(&self.head).unwrap_or(false);
        let entered: Vec<bool> = self
            .layers
            .iter()
            .map(|layer| {
                let behind = flows_behind(&layer.lines).unwrap_or(flows);
                std::mem::replace(&mut flows, behind)
            })
            .collect();
        let broken: Vec<Option<(usize, String)>> =
            self.layers.par_iter().zip(entered).map(|(layer, flows)| broken_law(layer, flows)).collect();
        let mut before = self.head.len();
        for (layer, law) in self.layers.iter().zip(broken) {
            if let Some((index, message)) = law {
                return Err(Error::line(before + index, message));
            }
            before += layer.lines.len();
        }
        Ok(())
    }
}

/// Whether clay flows behind some lines, if they say so.
fn flows_behind(lines: &[Line]) -> Option<bool> {
    lines.iter().rev().find(|line| matches!(line, Line::On | Line::Off)).map(|line| *line == Line::On)
}

fn broken_law(layer: &Layer, mut flows: bool) -> Option<(usize, String)> {
    if !matches!(layer.lines.first(), Some(Line::Layer(_))) {
        return Some((0, "a layer does not begin with its height".to_owned()));
    }
    let mut open: Vec<Tag> = Vec::new();
    for (index, line) in layer.lines.iter().enumerate() {
        match line {
            Line::Layer(_) if index > 0 => return Some((index, "a layer begins inside a layer".to_owned())),
            Line::Layer(_) => open.push(Tag::Layer),
            Line::On if flows => return Some((index, "a bead starts inside a bead".to_owned())),
            Line::On => flows = true,
            Line::Off => flows = false,
            Line::Open(tag) | Line::Wall(tag, _) | Line::Rotation(tag, _) => open.push(*tag),
            Line::Close(tag) if open.pop() != Some(*tag) => {
                return Some((index, format!("`{}` closes what is not open", tag.name())));
            }
            _ => {}
        }
    }
    open.pop().map(|tag| (layer.lines.len() - 1, format!("`{}` is never closed", tag.name())))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Found by fuzzing: what one layer leaves open the next one began again, and no stage could mend it.
    #[test]
    fn a_bead_goes_on_from_layer_to_layer() {
        let two = |second: &str| {
            let text = format!(
                "(</extruderInitialization>)\n(<layer> 1 )\nM101\n(</layer>)\n(<layer> 2 )\n{second}\n(</layer>)\n"
            );
            Skein::read(text.as_bytes()).expect("a skein").verify()
        };
        assert_eq!(two("M103"), Ok(()));
        assert_eq!(two("M103\nM101"), Ok(()));
        assert_eq!(two("M101"), Err(Error::line(5, "a bead starts inside a bead")));
    }
}
