//! The outermost element: units, the window, and which way y goes.

use super::damaged;
use super::frame::Frame;
use super::script::Script;
use crate::{FileUnit, ImportError};
use roxmltree::{Document, Node};
use skein::{Facts, Micron};
use svgtypes::{Align, AspectRatio, Length, LengthUnit, ViewBox};

/// Pixels of CSS to an inch, and millimetres.
const DPI: f64 = 96.0;
const INCH: f64 = 25.4;

/// How a drawing lies on the bed.
pub(super) struct Page {
    /// From the units of the drawing to microns, with y upwards.
    pub(super) frame: Frame,
    /// Coordinates are those of the part; transforms are for viewers.
    pub(super) plain: bool,
    /// Slic3r writes heights that it has scaled twice, by a million.
    pub(super) slic3r: bool,
    /// How many millimetres a height of one is.
    pub(super) height: f64,
    /// How wide and high the window is, for lengths in percent.
    pub(super) window: (f64, f64),
    /// How many units of the drawing a millimetre is, for lengths that say their unit.
    pub(super) millimetre: f64,
    /// What the drawing says of the part.
    pub(super) facts: Facts,
    /// What is guessed.
    pub(super) remark: Option<String>,
}

impl Page {
    pub(super) fn of(document: &Document<'_>, unit: FileUnit) -> Result<Self, ImportError> {
        let root = document.root_element();
        let given = (unit != FileUnit::File).then(|| unit.or(None).microns() as f64 / 1000.0);
        let said = Said::of(root)?;
        let layers = metadata(document);
        let script = Script::of(document).filter(|_| layers.is_none());
        let slic3r = root.namespaces().any(|space| space.uri().contains("slic3r"));
        let upward = layers.and_then(|layers| layers.attribute("yAxisPointingUpward"));
        // Slic3r turns y neither, nor does the seed.
        let plain =
            slic3r || script.is_some() || upward.is_some_and(|value| value.eq_ignore_ascii_case("true"));
        let bare = said.is_bare();
        let unit = given.unwrap_or(if bare || plain { 1.0 } else { INCH / DPI });
        let frame = if plain {
            Frame::scale(unit * 1000.0, unit * 1000.0)
        } else {
            said.frame(unit, given.is_some())
        };
        let said_of_part = |name: &str| match &script {
            Some(script) => script.value(name),
            None => layers.and_then(|layers| layers.attribute(name)),
        };
        let either = |name: &str, old: &str| length(said_of_part(name).or_else(|| said_of_part(old))?);
        let facts = Facts {
            layer_height: either("layerHeight", "layerThickness"),
            bead_width: either("edgeWidth", "perimeterWidth"),
            ..Facts::default()
        };
        let remark = (bare && !plain && given.is_none()).then(|| {
            "the drawing names no unit and is read in millimetres; --set import.unit says otherwise, and px behind \
             its width that it is in pixels"
                .to_owned()
        });
        let window = said.window();
        let millimetre = if bare || plain { 1.0 / unit } else { DPI / INCH };
        Ok(Self { frame, plain, slic3r, height: given.unwrap_or(1.0), window, millimetre, facts, remark })
    }

    /// A length in units of the drawing; percent are of `whole`.
    pub(super) fn length(&self, length: Length, whole: f64) -> f64 {
        let Length { number, unit } = length;
        match unit {
            LengthUnit::None | LengthUnit::Px => number,
            LengthUnit::Percent => number / 100.0 * whole,
            _ => number * millimetres(unit) * self.millimetre,
        }
    }
}

/// How many millimetres a unit has.
fn millimetres(unit: LengthUnit) -> f64 {
    match unit {
        LengthUnit::None | LengthUnit::Px | LengthUnit::Percent => INCH / DPI,
        LengthUnit::In => INCH,
        LengthUnit::Cm => 10.0,
        LengthUnit::Mm => 1.0,
        LengthUnit::Pt => INCH / 72.0,
        LengthUnit::Pc => INCH / 6.0,
        // Letters as a browser has them that nobody told otherwise: 16 pixels.
        LengthUnit::Em => INCH / 6.0,
        LengthUnit::Ex => INCH / 12.0,
    }
}

/// The `layers` element of the late Skeinforge, whatever the address of its name space is.
fn metadata<'a, 'input>(document: &'a Document<'input>) -> Option<Node<'a, 'input>> {
    let metadata = document.root_element().children().find(|node| node.tag_name().name() == "metadata")?;
    metadata.descendants().find(|node| node.tag_name().name() == "layers")
}

fn length(text: &str) -> Option<Micron> {
    text.trim().parse::<Micron>().ok().filter(|length| length.0 > 0)
}

/// What the outermost element says of its size.
struct Said {
    width: Option<Length>,
    height: Option<Length>,
    view: Option<ViewBox>,
    aspect: AspectRatio,
}

impl Said {
    fn of(root: Node<'_, '_>) -> Result<Self, ImportError> {
        let side = |name: &str| match root.attribute(name).map(str::trim) {
            None | Some("auto") => Ok(None),
            Some(text) => {
                let length: Length = text.parse().map_err(|_| damaged(root, name))?;
                let is_size = length.unit != LengthUnit::Percent && length.number > 0.0;
                Ok(Some(length).filter(|length| is_size && length.number.is_finite()))
            }
        };
        let view = root.attribute("viewBox").map(str::parse::<ViewBox>).transpose();
        let view = view.map_err(|_| damaged(root, "viewBox"))?;
        let aspect = root.attribute("preserveAspectRatio").and_then(|text| text.trim().parse().ok());
        let aspect = aspect.unwrap_or(AspectRatio { defer: false, align: Align::XMidYMid, slice: false });
        Ok(Self { width: side("width")?, height: side("height")?, view, aspect })
    }

    /// Whether it names no unit at all.
    fn is_bare(&self) -> bool {
        [self.width, self.height].into_iter().flatten().all(|length| length.unit == LengthUnit::None)
    }

    fn window(&self) -> (f64, f64) {
        let plain = |length: Option<Length>| length.map_or(0.0, |length| length.number);
        self.view.map_or((plain(self.width), plain(self.height)), |view| (view.w, view.h))
    }

    /// From units of the drawing to microns. The lower left corner of the page is the origin.
    ///
    /// `unit` is how many millimetres a bare number of `width` is; when it is `given`, it is the unit of the drawing.
    fn frame(&self, unit: f64, given: bool) -> Frame {
        let side = |length: Option<Length>| {
            length.map(|length| match length.unit {
                LengthUnit::None => length.number * unit,
                named => length.number * millimetres(named),
            })
        };
        let (width, height) = (side(self.width), side(self.height));
        let Some(view) = self.view else {
            let bottom = if given { self.height.map(|height| height.number * unit) } else { height };
            return Frame::shift(0.0, 1000.0 * bottom.unwrap_or(0.0)).around(upward(unit, unit));
        };
        let sides = (width.map(|width| width / view.w), height.map(|height| height / view.h));
        let (x, y) = match sides {
            _ if given => (unit, unit),
            (Some(x), Some(y)) if self.aspect.align == Align::None => (x, y),
            (Some(x), Some(y)) if self.aspect.slice => (x.max(y), x.max(y)),
            (Some(x), Some(y)) => (x.min(y), x.min(y)),
            (Some(one), None) | (None, Some(one)) => (one, one),
            (None, None) => (unit, unit),
        };
        upward(x, y).around(Frame::shift(-view.x, -view.y - view.h))
    }
}

/// From millimetres downwards to microns upwards.
fn upward(x: f64, y: f64) -> Frame {
    Frame::scale(1000.0 * x, -1000.0 * y)
}
