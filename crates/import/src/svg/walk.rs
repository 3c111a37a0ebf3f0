//! From the outermost element to the shapes of every layer.

use super::frame::Frame;
use super::nest::Shape;
use super::outline::{Pen, Trouble};
use super::page::Page;
use super::style::{Named, Sheet, Style};
use super::{TANGLED, damaged, height, paint, path, refused, too_far};
use crate::error::{ErrorKind, ImportError};
use roxmltree::{Document, Node};
use skein::Micron;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use svgtypes::{Align, AspectRatio, ViewBox};

/// A layer as it is drawn.
pub(super) struct Layer {
    pub(super) z: Micron,
    pub(super) shapes: Vec<Shape>,
}

/// All layers in the order of the document.
pub(super) struct Drawn {
    pub(super) layers: Vec<Layer>,
    pub(super) left_out: LeftOut,
}

/// What is not printed.
#[derive(Default)]
pub(super) struct LeftOut {
    pub(super) texts: usize,
    pub(super) images: usize,
    pub(super) others: usize,
    pub(super) hidden: usize,
    /// Shapes without an area and a stroke.
    pub(super) blank: usize,
    /// Shapes in no layer.
    pub(super) loose: usize,
    /// Rules of style sheets that are not understood.
    pub(super) rules: usize,
}

/// Chords keep within this many microns of a curve.
const TOLERANCE: f64 = 2.0;
/// How deep elements may stand in elements.
const DEEPEST: usize = 128;
/// How many elements there may be, copies counted: copies of copies can be more than anyone waits for.
const MOST_ELEMENTS: usize = 2_000_000;
/// How many points all curves may have.
const MOST_POINTS: usize = 20_000_000;

/// Draws the layers of a document.
///
/// # Errors
/// With the line, where a shape cannot be read, has no place, or is more than may be.
pub(super) fn layers(document: &Document<'_>, page: &Page) -> Result<Drawn, ImportError> {
    let sheet = Sheet::of(document);
    let mut ids = BTreeMap::new();
    for node in document.descendants() {
        if let Some(id) = node.attribute("id") {
            ids.entry(id).or_insert(node);
        }
    }
    let mut heights: Vec<(f64, Node<'_, '_>)> = Vec::new();
    let mut walker = Walker {
        page,
        left_out: LeftOut { rules: sheet.ignored, ..LeftOut::default() },
        sheet,
        ids,
        heights: &mut heights,
        shapes: Vec::new(),
        elements: 0,
        points: MOST_POINTS,
    };
    let outside = Here { frame: page.frame, style: Style::initial(), layer: None, depth: 0, copied: false };
    // A group of controls ends the drawing.
    let (ControlFlow::Continue(()) | ControlFlow::Break(())) =
        walker.visit(document.root_element(), outside)?;
    let Walker { left_out, shapes, .. } = walker;
    // No layer is less than a micron high.
    let highest = heights.iter().map(|(z, _)| z.abs()).fold(0.0, f64::max);
    let slip = if page.slic3r && highest < 0.001 { 1e6 } else { 1.0 };
    let layers = heights
        .iter()
        .zip(shapes)
        .map(|((z, node), shapes)| Ok(Layer { z: height(*node, z * slip * page.height)?, shapes }));
    Ok(Drawn { layers: layers.collect::<Result<_, ImportError>>()?, left_out })
}

struct Walker<'a, 'n, 'input> {
    page: &'a Page,
    sheet: Sheet,
    ids: BTreeMap<&'n str, Node<'n, 'input>>,
    /// Of each layer its height in millimetres, and who says so.
    heights: &'a mut Vec<(f64, Node<'n, 'input>)>,
    /// Of each layer its shapes.
    shapes: Vec<Vec<Shape>>,
    left_out: LeftOut,
    elements: usize,
    /// How many more points there may be.
    points: usize,
}

/// What holds where an element stands.
#[derive(Clone, Copy)]
struct Here {
    frame: Frame,
    style: Style,
    layer: Option<usize>,
    depth: usize,
    /// Inside a copy ids name the original.
    copied: bool,
}

type Visited = Result<ControlFlow<()>, ImportError>;

const GO_ON: Visited = Ok(ControlFlow::Continue(()));

impl<'n, 'input> Walker<'_, 'n, 'input> {
    fn visit(&mut self, node: Node<'n, 'input>, outside: Here) -> Visited {
        let Some(name) = node.svg_name() else { return GO_ON };
        let controls = node.attributes().find(|attribute| attribute.name() == "beginningOfControlSection");
        if controls.is_some_and(|flag| flag.value().eq_ignore_ascii_case("true")) {
            return Ok(ControlFlow::Break(()));
        }
        self.elements += 1;
        let hint = "flatten the drawing: ungroup it, and unlink its clones";
        if outside.depth > DEEPEST {
            let message = format!("elements stand more than {DEEPEST} deep in others, or in themselves");
            return Err(refused(node, ErrorKind::TooLarge, message, hint));
        }
        if self.elements > MOST_ELEMENTS {
            let message = format!("the drawing has more than {MOST_ELEMENTS} elements, copies counted");
            return Err(refused(node, ErrorKind::TooLarge, message, hint));
        }
        if matches!(name, "defs" | "symbol" | "clipPath" | "mask" | "marker" | "pattern" | "metadata")
            && !outside.copied
        {
            return GO_ON;
        }
        let mut here = Here { depth: outside.depth + 1, ..outside };
        here.style = outside.style.inherited(node, &self.sheet);
        let z = if outside.copied { None } else { height::of(node) };
        if let Some(z) = z {
            here.layer = Some(self.shapes.len());
            self.heights.push((z, node));
            self.shapes.push(Vec::new());
            // A layer that was switched off to look at another is printed all the same.
            here.style.displayed = true;
            here.style.visible = true;
        }
        if !here.style.displayed {
            self.left_out.hidden += 1;
            return GO_ON;
        }
        here.frame = self.inside(node, here.frame)?;
        match name {
            "svg" | "g" | "a" | "switch" | "symbol" => self.children(node, here),
            "use" => self.copy(node, here),
            // The labels of layers are for viewers.
            "text" if self.page.plain => GO_ON,
            "text" => self.leave_out(|left_out| &mut left_out.texts),
            "image" => self.leave_out(|left_out| &mut left_out.images),
            "title" | "desc" | "style" | "script" | "linearGradient" | "radialGradient" | "filter"
            | "defs" | "metadata" | "clipPath" | "mask" | "marker" | "pattern" | "view" => GO_ON,
            _ => self.shape(node, name, here),
        }
    }

    fn children(&mut self, node: Node<'n, 'input>, here: Here) -> Visited {
        for child in node.children() {
            if self.visit(child, here)?.is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        GO_ON
    }

    fn leave_out(&mut self, what: impl FnOnce(&mut LeftOut) -> &mut usize) -> Visited {
        *what(&mut self.left_out) += 1;
        GO_ON
    }

    /// The frame inside an element: its own transform, and the window of a drawing within the drawing.
    fn inside(&self, node: Node<'n, 'input>, frame: Frame) -> Result<Frame, ImportError> {
        if self.page.plain {
            return Ok(frame);
        }
        let frame = match node.attribute("transform") {
            Some(list) => frame.around(Frame::read(list).ok_or_else(|| damaged(node, "transform"))?),
            None => frame,
        };
        match node.tag_name().name() {
            "svg" | "symbol" if node != node.document().root_element() => self.window(node, frame),
            _ => Ok(frame),
        }
    }

    /// Where a nested drawing or a symbol has its window.
    fn window(&self, node: Node<'n, 'input>, frame: Frame) -> Result<Frame, ImportError> {
        let (wide, high) = self.page.window;
        let length = |name: &str, whole: f64| match node.attribute(name).map(str::trim) {
            None | Some("auto") => Ok(None),
            Some(text) => {
                let length = text.parse().map_err(|_| damaged(node, name))?;
                Ok(Some(self.page.length(length, whole)))
            }
        };
        let (x, y) = (length("x", wide)?.unwrap_or(0.0), length("y", high)?.unwrap_or(0.0));
        let frame = frame.around(Frame::shift(x, y));
        let Some(view) = node.attribute("viewBox") else { return Ok(frame) };
        let view: ViewBox = view.parse().map_err(|_| damaged(node, "viewBox"))?;
        let (width, height) =
            (length("width", wide)?.unwrap_or(view.w), length("height", high)?.unwrap_or(view.h));
        let aspect = node.attribute("preserveAspectRatio").and_then(|text| text.trim().parse().ok());
        let aspect = aspect.unwrap_or(AspectRatio { defer: false, align: Align::XMidYMid, slice: false });
        let (x, y) = (width / view.w, height / view.h);
        let (x, y) = match aspect.align {
            Align::None => (x, y),
            _ if aspect.slice => (x.max(y), x.max(y)),
            _ => (x.min(y), x.min(y)),
        };
        // What is left of the window is shared by both sides.
        let rest = Frame::shift((width - x * view.w) / 2.0, (height - y * view.h) / 2.0);
        Ok(frame.around(rest).around(Frame::scale(x, y)).around(Frame::shift(-view.x, -view.y)))
    }

    /// A copy of an element that stands elsewhere.
    fn copy(&mut self, node: Node<'n, 'input>, here: Here) -> Visited {
        let reference = node.attributes().find(|attribute| attribute.name() == "href");
        let id = reference.and_then(|href| href.value().trim().strip_prefix('#'));
        let Some(original) = id.and_then(|id| self.ids.get(id).copied()) else {
            let written = crate::error::quoted(reference.map_or("", |href| href.value()).as_bytes());
            let message = format!("a `use` shows `{written}`, which is not in the drawing");
            let hint = "only what stands in the same file can be shown; unlink the clone, or embed it";
            return Err(refused(node, ErrorKind::Missing, message, hint));
        };
        let (wide, high) = self.page.window;
        let shift = |name: &str, whole: f64| match node.attribute(name) {
            Some(text) => text
                .trim()
                .parse()
                .map(|length| self.page.length(length, whole))
                .map_err(|_| damaged(node, name)),
            None => Ok(0.0),
        };
        let (x, y) = (shift("x", wide)?, shift("y", high)?);
        let frame = here.frame.around(Frame::shift(x, y));
        self.visit(original, Here { frame, copied: true, ..here })
    }

    fn shape(&mut self, node: Node<'n, 'input>, name: &str, here: Here) -> Visited {
        if here.copied {
            // A long shape takes its time every time.
            self.elements += node.range().len() / 1024;
        }
        let frame = here.frame;
        let growth = frame.growth();
        let mut pen = Pen::new(TOLERANCE / growth.max(f64::MIN_POSITIVE), self.points);
        let drawn = match path::draw(node, name, self.page, &mut pen) {
            None => return self.leave_out(|left_out| &mut left_out.others),
            Some(drawn) => drawn,
        };
        drawn.map_err(|(trouble, attribute)| trouble.at(node, attribute))?;
        self.points = self.points.saturating_sub(pen.points());
        if !here.style.visible {
            return self.leave_out(|left_out| &mut left_out.hidden);
        }
        let Some(shapes) = here.layer.and_then(|layer| self.shapes.get_mut(layer)) else {
            return self.leave_out(|left_out| &mut left_out.loose);
        };
        let said = |trouble: Trouble| trouble.at(node, "d");
        let style = here.style;
        let mut rings = Vec::new();
        if style.fill {
            rings = paint::filled(&pen.ways, style.even_odd, &frame).map_err(said)?;
        }
        if rings.is_empty() && style.stroke {
            let (wide, high) = self.page.window;
            let whole = libm::hypot(wide, high) / std::f64::consts::SQRT_2;
            let width = self.page.length(style.stroke_width, whole);
            rings = paint::stroked(&pen.ways, width, &frame).map_err(said)?;
        }
        if rings.is_empty() {
            return self.leave_out(|left_out| &mut left_out.blank);
        }
        // Slic3r says of every polygon what it is.
        let kind = node.attributes().find(|attribute| attribute.name() == "type");
        let hole = kind.is_some_and(|kind| kind.namespace().is_some() && kind.value() == "hole");
        shapes.push(Shape { rings, hole });
        GO_ON
    }
}

impl Trouble {
    fn at(self, node: Node<'_, '_>, attribute: &str) -> ImportError {
        match self {
            Self::Damaged => damaged(node, attribute),
            Self::TooFar => too_far(node),
            Self::TooMany => {
                let message = format!("the curves of the drawing have more than {MOST_POINTS} points");
                refused(node, ErrorKind::TooLarge, message, "draw it with fewer curves")
            }
            Self::Tangled => {
                let message = format!("a `{}` crosses itself millions of times", node.tag_name().name());
                refused(node, ErrorKind::TooLarge, message, TANGLED)
            }
        }
    }
}
