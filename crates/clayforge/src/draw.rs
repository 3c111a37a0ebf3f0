//! Draws the layers of a document as one SVG, so that every stage can be looked at.
//!
//! Coordinates are millimetres. Beads have their true width; where clay lies twice it is darker.

use crate::Document;
use skein::{Bead, Error, Feature, Layer, Line, Nozzle, Point, Ring, Skein, Slices, boundary};
use std::fmt::Write;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// Only this layer, counted from zero.
    pub layer: Option<usize>,
    /// The most layers of a sheet; of more, as many are drawn, evenly spread.
    pub most: usize,
}

impl Default for Drawing {
    fn default() -> Self {
        Self { layer: None, most: 60 }
    }
}

/// The layers of a document, side by side from the bottom left to the top right of the text: row by row, the bed first.
///
/// # Errors
/// When the document has no layers to draw, or its header lacks a fact.
pub fn draw(document: &Document, drawing: Drawing) -> Result<String, Error> {
    match document {
        Document::Slices(slices) => sheet(slice_pictures(slices), drawing),
        Document::Skein(skein) => sheet(skein_pictures(skein, drawing)?, drawing),
        Document::Mesh(_) | Document::Gcode => Err(Error::new("only slices and skeins are drawn")),
    }
}

/// One layer, drawn.
#[derive(Default)]
struct Picture {
    index: usize,
    z: String,
    svg: String,
    corners: Option<(Point, Point)>,
}

impl Picture {
    /// Makes room for a point and what is around it.
    fn reach(&mut self, at: Point, around: i32) {
        let (low, high) = self.corners.get_or_insert((at, at));
        low.x = low.x.min(at.x.saturating_sub(around));
        low.y = low.y.min(at.y.saturating_sub(around));
        high.x = high.x.max(at.x.saturating_add(around));
        high.y = high.y.max(at.y.saturating_add(around));
    }

    fn rings(&mut self, rings: &[Ring], style: &str) {
        if rings.is_empty() {
            return;
        }
        let _ = write!(self.svg, "<path {style} d=\"");
        for ring in rings {
            for (index, point) in ring.0.iter().enumerate() {
                self.reach(*point, 0);
                self.point(if index == 0 { 'M' } else { 'L' }, *point);
            }
            self.svg.push('z');
        }
        self.svg.push_str("\"/>\n");
    }

    fn path(&mut self, points: &[Point], width: f64, style: &str) {
        // The pen is half its width beyond its path on every side.
        let around = unit::round_within(width * 500.0, 1e8).unwrap_or(0) as i32;
        let _ = write!(self.svg, "<path {style} stroke-width=\"{width:.3}\" d=\"");
        for (index, point) in points.iter().enumerate() {
            self.reach(*point, around);
            self.point(if index == 0 { 'M' } else { 'L' }, *point);
        }
        self.svg.push_str("\"/>\n");
    }

    fn point(&mut self, letter: char, at: Point) {
        let _ = write!(self.svg, "{letter}{} {}", unit::Micron(at.x), unit::Micron(at.y));
    }
}

/// Which of `count` layers are drawn.
fn chosen(count: usize, drawing: Drawing) -> Vec<usize> {
    let most = drawing.most.max(1);
    match drawing.layer {
        Some(layer) => (0..count).filter(|index| *index == layer).collect(),
        None if count <= most => (0..count).collect(),
        None if most == 1 => vec![0],
        None => (0..most).map(|step| step * (count - 1) / (most - 1)).collect(),
    }
}

fn slice_pictures(slices: &Slices) -> impl Fn(Drawing) -> (usize, Vec<Picture>) + '_ {
    |drawing| {
        let pictures = chosen(slices.layers.len(), drawing).into_iter().filter_map(|index| {
            let layer = slices.layers.get(index)?;
            let mut picture = Picture { index, z: layer.z.to_string(), ..Picture::default() };
            picture.rings(&layer.loops, "class=\"clay\"");
            Some(picture)
        });
        (slices.layers.len(), pictures.collect())
    }
}

fn skein_pictures(
    skein: &Skein,
    drawing: Drawing,
) -> Result<impl Fn(Drawing) -> (usize, Vec<Picture>), Error> {
    let facts = skein.facts()?;
    let wanted = chosen(skein.layers.len(), drawing);
    let mut nozzle = Nozzle::default();
    skein.head.iter().for_each(|line| nozzle.follow(line));
    let mut pictures = Vec::with_capacity(wanted.len());
    for (index, layer) in skein.layers.iter().enumerate() {
        if wanted.contains(&index) {
            let bead = match facts.bead() {
                Ok(bead) => bead.of_height(layer.height(&facts)?),
                // Outlines can be drawn without knowing what a bead is.
                Err(_) if !layer.lines.contains(&Line::On) => Bead::default(),
                Err(error) => return Err(error),
            };
            pictures.push((index, layer, nozzle, bead));
        }
        layer.lines.iter().for_each(|line| nozzle.follow(line));
    }
    let count = skein.layers.len();
    Ok(move |_| {
        let drawn =
            pictures.iter().map(|(index, layer, nozzle, bead)| skein_picture(*index, layer, *nozzle, *bead));
        (count, drawn.collect())
    })
}

fn skein_picture(index: usize, layer: &Layer, mut nozzle: Nozzle, bead: Bead) -> Picture {
    let mut picture = Picture { index, z: layer.z().to_string(), ..Picture::default() };
    picture.rings(&boundary(&layer.lines), "class=\"part\"");
    let mut run: Vec<Point> = Vec::new();
    let mut travels = String::new();
    // A run ends where clay starts, stops, flows otherwise or for something else.
    for line in &layer.lines {
        let flat = |nozzle: &Nozzle| nozzle.at.map(|at| Point::new(at.x, at.y));
        match line {
            Line::Move(step) => {
                if run.is_empty() {
                    run.extend(flat(&nozzle));
                }
                run.push(Point::new(step.to.x, step.to.y));
            }
            Line::Arc(arc) => {
                if run.is_empty() {
                    run.extend(flat(&nozzle));
                }
                let from = nozzle.at.unwrap_or(arc.step.to);
                run.extend(arc.chords(from, 5.0).iter().map(|at| Point::new(at.x, at.y)));
            }
            // Clay may flow on from one kind of bead into the next.
            Line::On | Line::Off | Line::Flow(_) | Line::Wall(..) | Line::Open(_) | Line::Close(_) => {
                end_run(&mut run, &nozzle, bead, &mut picture, &mut travels)
            }
            _ => {}
        }
        nozzle.follow(line);
    }
    end_run(&mut run, &nozzle, bead, &mut picture, &mut travels);
    // Travels lie above the clay.
    picture.svg.push_str(&travels);
    picture
}

fn end_run(run: &mut Vec<Point>, nozzle: &Nozzle, bead: Bead, picture: &mut Picture, travels: &mut String) {
    if run.len() > 1 {
        if nozzle.on {
            let height = bead.height.mm();
            let width = bead.section.width(bead.area() * nozzle.flow.f64(), height);
            picture.path(run, width, &format!("class=\"{}\"", class_of(nozzle.feature())));
        } else {
            let mut above = Picture { corners: picture.corners, ..Picture::default() };
            above.path(run, (bead.width.mm() / 12.0).max(0.02), "class=\"travel\"");
            picture.corners = above.corners;
            travels.push_str(&above.svg);
        }
    }
    run.clear();
}

fn class_of(feature: Feature) -> &'static str {
    match feature {
        Feature::Edge(_) => "edge",
        Feature::Loop(_) => "loop",
        Feature::Infill => "infill",
        Feature::Middle => "middle",
        Feature::Skirt => "skirt",
        Feature::Support => "support",
        Feature::Raft => "raft",
    }
}

const STYLE: &str = "path{fill:none;stroke-linecap:round;stroke-linejoin:round}\
.clay{fill:#c98;stroke:#643;fill-rule:evenodd}\
.part{stroke:#333}\
.edge,.loop,.infill,.middle,.skirt,.support,.raft{stroke-opacity:.55}\
.edge{stroke:#a4472f}.loop{stroke:#d98f4e}.infill{stroke:#5b8f8a}.middle{stroke:#7a55a0}\
.skirt{stroke:#8a8a3a}.support{stroke:#4d7fb8}.raft{stroke:#8b8f98}\
.travel{stroke:#e00000}\
text{font-family:sans-serif;fill:#333}";

/// Lays the pictures out in rows.
fn sheet(pictures: impl Fn(Drawing) -> (usize, Vec<Picture>), drawing: Drawing) -> Result<String, Error> {
    let (count, pictures) = pictures(drawing);
    if let (Some(layer), true) = (drawing.layer, pictures.is_empty()) {
        return Err(Error::new(format!("there is no layer {layer}"))
            .hint(format!("there are {count}, counted from 0")));
    }
    // Every cell shows the same window, so that layers can be compared.
    let mut window: Option<(Point, Point)> = None;
    for (low, high) in pictures.iter().filter_map(|picture| picture.corners) {
        let (least, most) = window.get_or_insert((low, high));
        (least.x, least.y) = (least.x.min(low.x), least.y.min(low.y));
        (most.x, most.y) = (most.x.max(high.x), most.y.max(high.y));
    }
    let (low, high) = window.unwrap_or((Point::new(0, 0), Point::new(10_000, 10_000)));
    let mm = |microns: i32| f64::from(microns) / 1000.0;
    let (part_width, part_depth) = ((mm(high.x) - mm(low.x)).max(0.1), (mm(high.y) - mm(low.y)).max(0.1));
    let letter = part_width.max(part_depth) * 0.06;
    let gap = letter;
    let (cell_width, cell_depth) = (part_width + gap, part_depth + gap + letter * 1.4);
    let columns = ((pictures.len() as f64 * cell_depth / cell_width).sqrt().ceil() as usize)
        .clamp(1, pictures.len().max(1));
    let rows = pictures.len().div_ceil(columns).max(1);
    let (width, depth) = (cell_width * columns as f64 + gap, cell_depth * rows as f64 + gap + letter * 1.6);
    let pixels = 1600.0;
    // Outlines are a pixel wide, in millimetres: not every viewer knows strokes that do not scale.
    let line = width / pixels;
    let mut svg = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.3} {depth:.3}\" width=\"{pixels:.0}\" \
         height=\"{:.0}\" stroke-width=\"{line:.4}\">\n<style>{STYLE}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fffdf8\"/>",
        (pixels * depth / width).ceil(),
    );
    let layers = if count == 1 { "layer" } else { "layers" };
    let title = if pictures.len() == count {
        format!("{count} {layers}")
    } else {
        format!("{} of {count} {layers}", pictures.len())
    };
    let _ = writeln!(
        svg,
        "<text x=\"{gap:.3}\" y=\"{:.3}\" font-size=\"{:.3}\">{title}</text>",
        letter * 1.5,
        letter * 1.1
    );
    for (place, picture) in pictures.iter().enumerate() {
        let left = gap + cell_width * (place % columns) as f64;
        let top = gap + letter * 1.6 + cell_depth * (place / columns) as f64;
        let _ = writeln!(
            svg,
            "<text x=\"{left:.3}\" y=\"{:.3}\" font-size=\"{letter:.3}\">{} · z {}</text>\n\
             <g transform=\"translate({:.3} {:.3}) scale(1 -1)\">\n{}</g>",
            top + letter,
            picture.index,
            picture.z,
            left - mm(low.x),
            top + letter * 1.4 + mm(high.y),
            picture.svg,
        );
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::TINY;

    #[test]
    fn a_tiny_skein_is_drawn_with_its_beads_and_travels() {
        let skein = Document::Skein(Skein::read(TINY.as_bytes()).expect("a skein"));
        let svg = draw(&skein, Drawing::default()).expect("drawn");
        assert_eq!(svg.matches("class=\"edge\" stroke-width=\"3.000\"").count(), 2, "{svg}");
        assert_eq!(svg.matches("class=\"travel\"").count(), 1, "{svg}");
        assert!(svg.contains(">1 · z 2.25</text>"), "{svg}");
        let one = draw(&skein, Drawing { layer: Some(1), most: 60 }).expect("drawn");
        assert!(one.contains("1 of 2 layers") && !one.contains(">0 · z"), "{one}");
        assert!(draw(&skein, Drawing { layer: Some(2), most: 60 }).is_err());
        let capped = draw(&skein, Drawing { layer: None, most: 1 }).expect("drawn");
        assert!(capped.contains("1 of 2 layers"));
    }

    #[test]
    fn a_sheet_of_many_layers_has_the_first_and_the_last() {
        let some = chosen(1000, Drawing::default());
        assert_eq!((some.len(), some.first(), some.last()), (60, Some(&0), Some(&999)));
        assert!(chosen(0, Drawing::default()).is_empty());
    }
}
