//! The text of [`Slices`]: an SVG drawing, one group a layer, one path with all its loops (stages.md §1.1).
//!
//! Coordinates are plain millimetres with y upwards; the transform of the drawing is for viewers and is not read.

use crate::{Error, Facts, Place, RotatedLoopLayer, Signature, Slices};
use shape::{Bounds, Point, Point3, Ring};
use unit::{Direction, Micron};

const NAMESPACE: &str = "https://clayforge.org/slice";

impl Slices {
    /// The drawing.
    pub fn write(&self) -> Vec<u8> {
        let mut out = Vec::with_capacity(
            256 + 16
                * self.layers.iter().flat_map(|layer| &layer.loops).map(|ring| ring.0.len()).sum::<usize>(),
        );
        let (width, depth) = (self.bounds.max.x - self.bounds.min.x, self.bounds.max.y - self.bounds.min.y);
        out.extend_from_slice(b"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        out.extend_from_slice(
            format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:slice=\"{NAMESPACE}\" version=\"1.1\" \
                 viewBox=\"{} {} {} {}\">\n",
                Micron(self.bounds.min.x),
                Micron(-self.bounds.max.y),
                Micron(width),
                Micron(depth)
            )
            .as_bytes(),
        );
        out.extend_from_slice(b" <metadata><slice:layers");
        for (tag, value) in self.facts.tags() {
            attribute(&mut out, tag, &value);
        }
        let Bounds { min, max } = self.bounds;
        for (name, value) in [
            ("minX", min.x),
            ("maxX", max.x),
            ("minY", min.y),
            ("maxY", max.y),
            ("minZ", min.z),
            ("maxZ", max.z),
        ] {
            attribute(&mut out, name, &Micron(value).to_string());
        }
        let names: Vec<&str> = self.done.iter().map(|signature| signature.stage.as_str()).collect();
        attribute(&mut out, "procedureName", &names.join(","));
        attribute(&mut out, "yAxisPointingUpward", "true");
        out.extend_from_slice(b">\n");
        for signature in &self.done {
            for (name, value) in &signature.settings {
                out.extend_from_slice(b"  <slice:setting");
                attribute(&mut out, "stage", &signature.stage);
                attribute(&mut out, "name", name);
                attribute(&mut out, "value", value);
                out.extend_from_slice(b"/>\n");
            }
        }
        out.extend_from_slice(b" </slice:layers></metadata>\n <g transform=\"scale(1,-1)\" fill=\"#c98\" fill-rule=\"evenodd\">\n");
        for layer in &self.layers {
            out.extend_from_slice(b"  <g id=\"z:");
            layer.z.write(&mut out);
            out.push(b'"');
            if let Some(thickness) = layer.thickness {
                attribute(&mut out, "slice:thickness", &thickness.to_string());
            }
            if let Some(rotation) = layer.rotation {
                attribute(&mut out, "slice:bridgeRotation", &rotation.to_string());
            }
            out.extend_from_slice(b"><path d=\"");
            for (index, ring) in layer.loops.iter().enumerate() {
                out.extend_from_slice(if index == 0 { b"M" } else { b" M" });
                for (index, point) in ring.0.iter().enumerate() {
                    out.extend_from_slice(if index == 0 { b" " } else { b" L " });
                    Micron(point.x).write(&mut out);
                    out.push(b' ');
                    Micron(point.y).write(&mut out);
                }
                out.extend_from_slice(b" z");
            }
            out.extend_from_slice(b"\"/></g>\n");
        }
        out.extend_from_slice(b" </g>\n</svg>\n");
        out
    }

    /// Whether a text says that carve wrote it. Of other drawings only the shapes are known.
    pub fn is_own(text: &[u8]) -> bool {
        let head = text.get(..4096).unwrap_or(text);
        head.windows(NAMESPACE.len()).any(|window| window == NAMESPACE.as_bytes())
    }

    /// Reads the drawing.
    ///
    /// # Errors
    /// With line and column, when it is no XML, no drawing of carve's, or when a number cannot be read.
    pub fn read(text: &[u8]) -> Result<Self, Error> {
        let text = std::str::from_utf8(text).map_err(|error| {
            Error::new("the drawing is not UTF-8 text").at(Place::At(format!("byte {}", error.valid_up_to())))
        })?;
        let document = roxmltree::Document::parse(text).map_err(|error| {
            let place = error.pos();
            Error::new(format!("this is no SVG: {error}"))
                .at(Place::Text { line: place.row as usize, column: place.col as usize })
        })?;
        let at = |node: roxmltree::Node<'_, '_>, message: String| {
            let place = document.text_pos_at(node.range().start);
            Error::new(message).at(Place::Text { line: place.row as usize, column: place.col as usize })
        };
        let meta = document.descendants().find(|node| node.has_tag_name((NAMESPACE, "layers"))).ok_or_else(
            || {
                Error::new("the drawing has no `slice:layers` metadata")
                    .hint("preface reads the SVG that carve writes")
            },
        )?;
        let mut slices = Self::default();
        for attribute in meta.attributes() {
            let (name, value) = (attribute.name(), attribute.value());
            if slices.facts.take(name, value).map_err(|error| at(meta, error.message))? {
                continue;
            }
            let length = || {
                value.parse::<Micron>().map_err(|_| at(meta, format!("`{value}` is no value for `{name}`")))
            };
            match name {
                "minX" => slices.bounds.min.x = length()?.0,
                "maxX" => slices.bounds.max.x = length()?.0,
                "minY" => slices.bounds.min.y = length()?.0,
                "maxY" => slices.bounds.max.y = length()?.0,
                "minZ" => slices.bounds.min.z = length()?.0,
                "maxZ" => slices.bounds.max.z = length()?.0,
                "procedureName" => {
                    for stage in value.split(',').filter(|stage| !stage.is_empty()) {
                        slices.done.push(Signature { stage: stage.to_owned(), settings: Vec::new() });
                    }
                }
                "yAxisPointingUpward" if value == "true" => {}
                "yAxisPointingUpward" => {
                    return Err(at(meta, "only drawings with y upwards can be read".to_owned()));
                }
                _ => {}
            }
        }
        for node in meta.children().filter(|node| node.has_tag_name((NAMESPACE, "setting"))) {
            let get = |name: &str| {
                node.attribute(name).ok_or_else(|| at(node, format!("the setting has no `{name}`")))
            };
            let (stage, name, value) = (get("stage")?, get("name")?, get("value")?);
            let signature = slices.done.iter_mut().find(|signature| signature.stage == stage);
            let signature =
                signature.ok_or_else(|| at(node, format!("`{stage}` is not in procedureName")))?;
            signature.settings.push((name.to_owned(), value.to_owned()));
        }
        for node in document.descendants().filter(|node| node.has_tag_name("g")) {
            let Some(z) = node.attribute("id").and_then(|id| id.strip_prefix("z:")) else { continue };
            let bad = |what: &str, value: &str| at(node, format!("`{value}` is no {what}"));
            let z = z.trim().parse().map_err(|_| bad("height", z))?;
            let thickness = match node.attribute((NAMESPACE, "thickness")) {
                Some(text) => Some(text.parse().map_err(|_| bad("thickness", text))?),
                None => None,
            };
            let rotation = match node.attribute((NAMESPACE, "bridgeRotation")) {
                Some(text) => Some(text.parse::<Direction>().map_err(|_| bad("direction", text))?),
                None => None,
            };
            let mut loops = Vec::new();
            for path in node.children().filter(|child| child.has_tag_name("path")) {
                read_loops(path.attribute("d").unwrap_or(""), &mut loops)
                    .map_err(|message| at(path, message))?;
            }
            slices.layers.push(RotatedLoopLayer { z, thickness, rotation, loops });
        }
        Ok(slices)
    }
}

/// `M x y L x y … z`, as many times as there are loops.
fn read_loops(data: &str, loops: &mut Vec<Ring>) -> Result<(), String> {
    let mut points: Vec<Point> = Vec::new();
    let mut pending: Option<Micron> = None;
    for word in data.split([' ', ',', '\n', '\t', '\r']).filter(|word| !word.is_empty()) {
        match word {
            "M" | "L" => {}
            "z" | "Z" => {
                if pending.is_some() || points.len() < 3 {
                    return Err("a loop has fewer than three points".to_owned());
                }
                loops.push(Ring(std::mem::take(&mut points)));
            }
            number => {
                let value: Micron =
                    number.parse().map_err(|_| format!("`{number}` is no coordinate and no M, L or z"))?;
                match pending.take() {
                    Some(x) => points.push(Point::new(x.0, value.0)),
                    None => pending = Some(value),
                }
            }
        }
    }
    if points.is_empty() && pending.is_none() { Ok(()) } else { Err("a loop is not closed by z".to_owned()) }
}

fn attribute(out: &mut Vec<u8>, name: &str, value: &str) {
    out.push(b' ');
    out.extend_from_slice(name.as_bytes());
    out.extend_from_slice(b"=\"");
    for byte in value.bytes() {
        match byte {
            b'"' => out.extend_from_slice(b"&quot;"),
            b'&' => out.extend_from_slice(b"&amp;"),
            b'<' => out.extend_from_slice(b"&lt;"),
            _ => out.push(byte),
        }
    }
    out.push(b'"');
}

impl Slices {
    /// A document with no layers yet.
    pub fn new(facts: Facts, min: Point3, max: Point3) -> Self {
        Self { facts, bounds: Bounds { min, max }, ..Self::default() }
    }
}
