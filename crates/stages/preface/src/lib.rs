#![doc = include_str!("../README.md")]

use rayon::prelude::*;
use skein::{
    Error, Layer, Line, Mark, Micron, Point3, Reader, RotatedLoopLayer, Settings, Skein, Slices, Tag,
};

#[cfg(test)]
mod tests;

/// Turns layers of loops into the first skein: a header and an outline for each loop.
#[derive(Clone, Debug, Settings)]
pub struct Preface {
    /// A note of your own that travels with the print: clay, glaze, date. One line.
    #[setting(default = "")]
    pub meta: String,
    /// Write G90: coordinates are absolute. All of ours are; switch it off only for firmware that does not know G90.
    #[setting(default = true)]
    pub set_positioning_to_absolute: bool,
    /// Write G21: lengths are millimetres. All of ours are; switch it off only for firmware that does not know G21.
    #[setting(default = true)]
    pub set_units_to_millimeters: bool,
}

impl Preface {
    /// The craft word.
    pub const NAME: &'static str = "preface";

    /// Writes the skein. It has outlines and no moves; whoever runs the stage signs it.
    ///
    /// # Errors
    /// When the slices lack a fact or the note cannot stand in a tag.
    pub fn craft(&self, slices: &Slices) -> Result<Skein, Error> {
        let usual = slices.facts.layer_height()?;
        Ok(Skein {
            head: self.head(slices)?,
            layers: slices.layers.par_iter().map(|layer| outlines(layer, usual)).collect(),
            tail: vec![Line::Close(Tag::Crafting), Line::Off],
        })
    }

    /// The header, in the order of the late Skeinforge (stages.md §6.1), without its time stamps: the same part must
    /// give the same file tomorrow.
    fn head(&self, slices: &Slices) -> Result<Vec<Line>, Error> {
        let mut facts = slices.facts.clone();
        // Whatever the drawing says, coordinates are whole microns from here on.
        facts.decimals = Some(Micron::PLACES);
        let width = Line::value("edgeWidth", &facts.bead_width()?.to_string())?;
        let mut head =
            vec![Line::value("format", "clayforge skein")?, Line::Open(Tag::ExtruderInitialization)];
        if self.set_positioning_to_absolute {
            head.push(command("G90")?);
        }
        if self.set_units_to_millimeters {
            head.push(command("G21")?);
        }
        head.push(Line::value("craftTypeName", "extrusion")?);
        for (tag, value) in facts.tags().iter().filter(|(tag, _)| *tag != "edgeWidth") {
            head.push(Line::value(tag, value)?);
        }
        head.extend(self.note()?);
        // Later stages put their facts above the bead width, so it is the last of the values.
        head.push(width);
        head.push(Line::Open(Tag::Settings));
        for signature in &slices.done {
            for (name, value) in &signature.settings {
                head.push(Line::value("setting", &format!("{} {name} {value}", signature.stage))?);
            }
        }
        head.push(Line::Close(Tag::Settings));
        for signature in &slices.done {
            head.push(Line::value("procedureName", &signature.stage)?);
        }
        head.push(Line::Close(Tag::ExtruderInitialization));
        head.push(Line::Open(Tag::Crafting));
        Ok(head)
    }

    /// The potter's own note, if there is one.
    fn note(&self) -> Result<Option<Line>, Error> {
        let note = self.meta.trim();
        if note.is_empty() {
            return Ok(None);
        }
        Line::value("meta", note).map(Some).map_err(|_| {
            Error::new(format!("meta = {note:?} cannot stand in a header tag")).hint("a note is one line")
        })
    }
}

/// A command as a skein holds it: read, so that in memory and in a file it is the same line.
fn command(text: &str) -> Result<Line, Error> {
    Reader::default().line(text.as_bytes())
}

/// The lines of one layer: an outline for every loop. Insets and holes are not sorted into each other yet.
fn outlines(layer: &RotatedLoopLayer, usual: Micron) -> Layer {
    let points: usize = layer.loops.iter().map(|ring| ring.0.len() + 4).sum();
    let mut lines = Vec::with_capacity(points + 5);
    lines.push(Line::Layer(layer.z));
    // A layer of the usual height says nothing, so that the exceptions stand out.
    lines.extend(layer.thickness.filter(|height| *height != usual).map(Line::Thickness));
    lines.extend(layer.rotation.map(|direction| Line::Rotation(Tag::BridgeRotation, direction)));
    for ring in &layer.loops {
        lines.push(Line::Open(Tag::NestedRing));
        lines.push(Line::Open(Tag::BoundaryPerimeter));
        lines.extend(
            ring.0
                .iter()
                .map(|point| Line::Point(Mark::Boundary, Point3 { x: point.x, y: point.y, z: layer.z.0 })),
        );
        lines.push(Line::Close(Tag::BoundaryPerimeter));
        lines.push(Line::Close(Tag::NestedRing));
    }
    lines.extend(layer.rotation.map(|_| Line::Close(Tag::BridgeRotation)));
    lines.push(Line::Close(Tag::Layer));
    Layer { lines }
}
