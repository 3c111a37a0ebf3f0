//! SVG: the layers of a part as any program draws them (stages.md §1).

mod entities;
mod frame;
mod height;
mod nest;
mod outline;
mod page;
mod paint;
mod path;
mod script;
mod stroke;
mod style;
mod tangle;
#[cfg(test)]
mod tests;
mod walk;

use crate::error::{ErrorKind, ImportError, Place};
use crate::number::nearest;
use crate::{Drawing, FileUnit};
use page::Page;
use rayon::prelude::*;
use roxmltree::{Document, Node, ParsingOptions};
use shape::{Bounds, Point3};
use skein::{Facts, Micron, RotatedLoopLayer, Slices};
use walk::{Drawn, LeftOut};

/// Reads the layers of a drawing.
///
/// # Errors
/// When it is no XML, says nowhere how high a layer is, or asks for more than its size allows.
pub(crate) fn read(bytes: &[u8], unit: FileUnit) -> Result<Drawing, ImportError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let hint = "save it as plain SVG in UTF-8";
        let message = "the drawing is not UTF-8 text";
        ImportError::new(ErrorKind::Syntax, Place::Byte(error.valid_up_to()), message, hint)
    })?;
    entities::check(text)?;
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let place = Place::Line(error.pos().row as usize);
        let hint = "the file is damaged; export the drawing again, as plain SVG";
        ImportError::new(ErrorKind::Syntax, place, format!("this is no SVG: {error}"), hint)
    })?;
    let page = Page::of(&document, unit)?;
    let Drawn { mut layers, left_out } = walk::layers(&document, &page)?;
    let mut remarks: Vec<String> = page.remark.iter().cloned().collect();
    if !layers.is_sorted_by_key(|layer| layer.z) {
        remarks.push("the heights of the layers do not rise; they are sorted".to_owned());
        layers.sort_by_key(|layer| layer.z);
    }
    if layers.is_empty() {
        return Err(no_heights());
    }
    layers.dedup_by(|upper, lower| {
        let same = upper.z == lower.z;
        if same {
            lower.shapes.append(&mut upper.shapes);
        }
        same
    });
    let is_tangled =
        |layer: &walk::Layer| tangle::is_tangled(layer.shapes.iter().flat_map(|shape| &shape.rings));
    if layers.par_iter().any(is_tangled) {
        let message = "the shapes of a layer cross each other millions of times";
        return Err(ImportError::new(ErrorKind::TooLarge, Place::File, message, TANGLED));
    }
    let untidy = layers.iter().filter(|layer| nest::too_many(&layer.shapes)).count();
    let layers: Vec<RotatedLoopLayer> = layers
        .into_par_iter()
        .map(|layer| RotatedLoopLayer { z: layer.z, loops: nest::loops(layer.shapes), ..Default::default() })
        .collect();
    if layers.iter().all(|layer| layer.loops.is_empty()) {
        return Err(no_shapes());
    }
    if untidy > 0 {
        remarks
            .push(format!("{untidy} layers have too many shapes to tell holes from islands; all are clay"));
    }
    remarks.extend(left_out.remarks());
    Ok(Drawing { slices: slices(layers, page.facts), remarks })
}

fn slices(layers: Vec<RotatedLoopLayer>, facts: Facts) -> Slices {
    let points = || layers.iter().flat_map(|layer| &layer.loops).flat_map(|ring| &ring.0);
    let range = |values: &mut dyn Iterator<Item = i32>| {
        let first = values.next().unwrap_or_default();
        values.fold((first, first), |(low, high), value| (low.min(value), high.max(value)))
    };
    let (left, right) = range(&mut points().map(|point| point.x));
    let (front, back) = range(&mut points().map(|point| point.y));
    let (bottom, top) = range(&mut layers.iter().map(|layer| layer.z.0));
    let bounds =
        Bounds { min: Point3 { x: left, y: front, z: bottom }, max: Point3 { x: right, y: back, z: top } };
    Slices { facts, bounds, done: Vec::new(), layers }
}

fn no_heights() -> ImportError {
    let message = "no layer of the drawing says how high it is";
    let hint = "give every layer its height in millimetres, in its id or its name (z:1.5) or as an attribute \
                z=\"1.5\"; layers of your own part come from clayforge slice PART --until carve";
    ImportError::new(ErrorKind::NoHeight, Place::File, message, hint)
}

fn no_shapes() -> ImportError {
    let message = "no layer of the drawing has a shape with an area";
    let hint = "shapes are printed where they are filled, lines where they have a stroke; text must be made into paths";
    ImportError::new(ErrorKind::NoFacets, Place::File, message, hint)
}

/// What helps when outlines cross too often.
const TANGLED: &str = "unite the shapes in the program that drew them";

/// A drawing that is refused at an element.
fn refused(node: Node<'_, '_>, kind: ErrorKind, message: impl Into<String>, hint: &str) -> ImportError {
    let line = node.document().text_pos_at(node.range().start).row as usize;
    ImportError::new(kind, Place::Line(line), message, hint)
}

fn too_far(node: Node<'_, '_>) -> ImportError {
    let message = format!("a `{}` reaches more than a kilometre from the origin", node.tag_name().name());
    refused(node, ErrorKind::TooFar, message, "check the numbers of the drawing and its unit, import.unit")
}

fn damaged(node: Node<'_, '_>, attribute: &str) -> ImportError {
    let written = crate::error::quoted(node.attribute(attribute).unwrap_or_default().as_bytes());
    let name = node.tag_name().name();
    let message = format!("`{written}` cannot be read as the `{attribute}` of a `{name}`");
    refused(node, ErrorKind::Syntax, message, "the file is damaged; export the drawing again, as plain SVG")
}

/// A height in millimetres.
fn height(node: Node<'_, '_>, millimetres: f64) -> Result<Micron, ImportError> {
    nearest(millimetres * 1000.0).map(Micron).ok_or_else(|| {
        let message = format!("a layer is {millimetres:e} mm high");
        refused(node, ErrorKind::TooFar, message, "heights are millimetres, up to a kilometre")
    })
}

impl LeftOut {
    /// One sentence for each kind.
    fn remarks(self) -> Vec<String> {
        let Self { texts, images, others, hidden, blank, loose, rules } = self;
        [
            (texts, "texts were left out; make them into paths to print them"),
            (images, "images were left out"),
            (others, "elements that are no shapes were left out"),
            (hidden, "hidden elements were left out"),
            (blank, "shapes with neither an area nor a stroke were left out"),
            (loose, "shapes stand in no layer with a height and were left out"),
            (rules, "rules of the style sheet are for more than one class, name or id and were left out"),
        ]
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect()
    }
}
