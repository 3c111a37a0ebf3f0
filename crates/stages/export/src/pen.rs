//! The writer of moves. It knows what the machine knows and says only what changes.

use crate::entry::{Entry, is_foreign};
use crate::extruder::Extruder;
use crate::{Comments, Export, remarks};
use skein::command::{bare, command};
use skein::{
    Arc, Bead, Center, Error, Extrusion, Facts, Feature, Feed, Layer, Line, Micron, Move, Nozzle, Point3,
    Ratio, Skein,
};
use unit::decimal;

/// What is the same for the whole file.
pub(crate) struct Style {
    facts: Facts,
    bead: Option<Bead>,
    travel: Feed,
    pub(crate) comments: Comments,
    extruder: Extruder,
    /// Coordinates are multiples of so many microns.
    step: i32,
    /// Whether an E word counts from the start of the print (M82).
    absolute: bool,
}

/// The top and the height of a layer.
#[derive(Clone, Copy)]
pub(crate) struct Size {
    pub(crate) top: Micron,
    pub(crate) height: Micron,
}

impl Style {
    pub(crate) fn new(export: &Export, skein: &Skein) -> Result<Self, Error> {
        let facts = skein.facts()?;
        let counting = |line: &Line| match line {
            Line::Verbatim(text) => match command(text) {
                Some((b'M', number @ (82 | 83), _)) => Some(number),
                _ => None,
            },
            _ => None,
        };
        Ok(Self {
            travel: facts.travel_feed()?,
            bead: facts.bead().ok(),
            comments: export.comments,
            extruder: Extruder::new(export),
            step: 10_i32.pow(3_u32.saturating_sub(export.decimals)),
            absolute: skein.head.iter().rev().find_map(counting) == Some(82),
            facts,
        })
    }

    /// The size of a layer.
    pub(crate) fn size(&self, layer: &Layer) -> Result<Size, Error> {
        Ok(Size { top: layer.nozzle_z(&self.facts)?, height: layer.height(&self.facts)? })
    }

    /// How wide a bead lies that has this share of the nominal section.
    fn width(&self, size: Option<Size>, flow: Ratio) -> Option<Micron> {
        let bead = self.bead?.of_height(size?.height);
        let width = bead.section.width(bead.area() * flow.f64(), bead.height.mm());
        Micron::from_mm(width).filter(|width| width.0 > 0)
    }

    /// To the decimals of the file, halves away from zero.
    #[inline]
    fn rounded(&self, at: Point3) -> Point3 {
        if self.step == 1 {
            return at;
        }
        Point3 { x: self.round(at.x), y: self.round(at.y), z: self.round(at.z) }
    }

    #[inline]
    fn round(&self, value: i32) -> i32 {
        (value + value.signum() * (self.step / 2)) / self.step * self.step
    }
}

/// Writes lines of the skein as G-code.
pub(crate) struct Pen<'a> {
    style: &'a Style,
    size: Option<Size>,
    /// The skein's view: whether clay flows, what for, and which feed it has said.
    nozzle: Nozzle,
    /// The machine's view, in the decimals of the file.
    at: Axes,
    feed: Option<Feed>,
    e: Option<Extrusion>,
    /// Nothing in this layer has changed the height or laid clay yet.
    fresh: bool,
    /// What the last `;TYPE:` and `;WIDTH:` were about.
    shown: Option<Feature>,
    shown_flow: Option<Ratio>,
    /// What has been written.
    pub(crate) text: Vec<u8>,
}

/// Where the machine is, as far as anybody knows.
#[derive(Clone, Copy, Default)]
struct Axes {
    x: Option<i32>,
    y: Option<i32>,
    z: Option<i32>,
}

impl From<Point3> for Axes {
    fn from(at: Point3) -> Self {
        Self { x: Some(at.x), y: Some(at.y), z: Some(at.z) }
    }
}

impl<'a> Pen<'a> {
    /// A pen that takes over where other lines have ended; `size` is that of its layer, if it writes one.
    ///
    /// The machine's feed is not taken over: each layer says its own, so that it can be looked at, and cut out, alone.
    pub(crate) fn new(style: &'a Style, entry: Entry, size: Option<Size>, text: Vec<u8>) -> Self {
        let flow = entry.flow.unwrap_or(Ratio::ONE);
        Self {
            style,
            size,
            nozzle: Nozzle { at: entry.at, on: entry.on, feed: entry.feed, flow, ..Nozzle::default() },
            at: entry.at.map_or(Axes::default(), |at| style.rounded(at).into()),
            feed: None,
            e: entry.e,
            fresh: size.is_some(),
            shown: None,
            shown_flow: None,
            text,
        }
    }

    /// Writes the lines of the skein that mean something to a machine: E carries what M101, M103 and M108 say, and tags
    /// are for the stages.
    pub(crate) fn lines(&mut self, lines: &[Line]) {
        for line in lines {
            let was_on = self.nozzle.on;
            self.nozzle.follow(line);
            match line {
                Line::Move(step) => self.step(step),
                Line::On if !was_on => self.style.extruder.start(self.nozzle.flow, &mut self.text),
                Line::Off if was_on => self.style.extruder.stop(self.nozzle.flow, &mut self.text),
                Line::Flow(flow) if was_on => self.style.extruder.change(*flow, &mut self.text),
                Line::Arc(arc) => self.arc(arc),
                Line::Verbatim(text) | Line::Pasted(text) => self.verbatim(line, text),
                _ => {}
            }
            if self.keeps_tags() && is_tag(line) {
                line.write(&mut self.text);
                self.text.push(b'\n');
            }
        }
    }

    fn verbatim(&mut self, line: &Line, text: &str) {
        let remarks = match self.style.comments {
            Comments::Layers | Comments::Tags => true,
            Comments::Head | Comments::HeadTags => self.size.is_none(),
            Comments::None => false,
        };
        let text = if remarks { text } else { bare(text) };
        // A tag that no stage knew is still a tag.
        if !text.is_empty() && !text.starts_with('(') {
            self.text.extend_from_slice(text.as_bytes());
            self.text.push(b'\n');
        }
        if is_foreign(line) {
            (self.at, self.feed) = (Axes::default(), None);
        }
        if let Some((b'G', 92, words)) = command(text)
            && let Some(count) = skein::command::word(words, b'E')
        {
            self.e = Extrusion::new(count * 100);
        }
    }

    /// Whether tags are written here.
    fn keeps_tags(&self) -> bool {
        match self.style.comments {
            Comments::Tags => true,
            Comments::HeadTags => self.size.is_none(),
            Comments::Layers | Comments::Head | Comments::None => false,
        }
    }

    #[inline]
    fn step(&mut self, step: &Move) {
        let to = self.style.rounded(step.to);
        if self.nozzle.on {
            self.fresh = false;
            self.show_bead();
        } else if self.fresh && step.extrusion.is_none() && self.at.z != Some(to.z) {
            self.fresh = false;
            return self.enter(to);
        }
        self.go(to, self.nozzle.feed, step.extrusion);
    }

    /// An arc. Its centre is rounded like its end; R is, too, and a firmware stretches a radius that is too short.
    fn arc(&mut self, arc: &Arc) {
        if self.nozzle.on {
            self.show_bead();
        }
        self.fresh = false;
        let to = self.style.rounded(arc.step.to);
        self.text.extend_from_slice(if arc.clockwise { b"G2" } else { b"G3" });
        self.axis(b'X', to.x);
        self.axis(b'Y', to.y);
        if self.at.z != Some(to.z) {
            self.axis(b'Z', to.z);
        }
        let words = match arc.center {
            Center::Offset { i, j } => [Some((b'I', i)), Some((b'J', j))],
            Center::Radius(radius) => [Some((b'R', radius)), None],
        };
        for (letter, length) in words.into_iter().flatten() {
            self.axis(letter, self.style.round(length.0));
        }
        if let Some(e) = arc.step.extrusion {
            self.extrude(e);
        }
        self.feed(self.nozzle.feed);
        self.text.push(b'\n');
        self.at = to.into();
    }

    fn extrude(&mut self, e: Extrusion) {
        self.text.extend_from_slice(b" E");
        decimal::write_short(&mut self.text, e.get(), Extrusion::PLACES);
        self.e = Some(e);
    }

    /// The way to the first bead of a layer: the height is a line of its own. A clay processor knows a layer by it, and
    /// a nozzle that climbs straight up does not drag through the wall.
    fn enter(&mut self, to: Point3) {
        match self.at.z {
            // Down to another pot: across at the height of the finished one, and only then down.
            Some(z) if z > to.z => {
                self.go(Point3 { z, ..to }, self.nozzle.feed, None);
                self.rise(to.z);
            }
            _ => {
                self.rise(to.z);
                self.go(to, self.nozzle.feed, None);
            }
        }
    }

    fn rise(&mut self, z: i32) {
        self.text.extend_from_slice(b"G1");
        self.axis(b'Z', z);
        self.feed(Some(self.style.travel));
        self.text.push(b'\n');
        self.at.z = Some(z);
    }

    /// A move, with the words that change. One that changes and pushes nothing is left out.
    #[inline]
    fn go(&mut self, to: Point3, feed: Option<Feed>, e: Option<Extrusion>) {
        let axes = Axes::from(to);
        let (x, y, z) = (axes.x != self.at.x, axes.y != self.at.y, axes.z != self.at.z);
        if !(x || y || z || e.is_some_and(|e| self.pushes(e))) {
            return;
        }
        self.text.extend_from_slice(b"G1");
        if x {
            self.axis(b'X', to.x);
        }
        if y {
            self.axis(b'Y', to.y);
        }
        if z {
            self.axis(b'Z', to.z);
        }
        if let Some(e) = e {
            self.extrude(e);
        }
        self.feed(feed);
        self.text.push(b'\n');
        self.at = axes;
    }

    #[inline]
    fn axis(&mut self, letter: u8, microns: i32) {
        self.text.extend_from_slice(&[b' ', letter]);
        decimal::write_short(&mut self.text, i64::from(microns), Micron::PLACES);
    }

    #[inline]
    fn feed(&mut self, feed: Option<Feed>) {
        let Some(feed) = feed.filter(|feed| self.feed != Some(*feed)) else { return };
        self.text.extend_from_slice(b" F");
        decimal::write_short(&mut self.text, i64::from(feed.get()), Feed::PLACES);
        self.feed = Some(feed);
    }

    /// Whether an E word moves the ram.
    fn pushes(&self, e: Extrusion) -> bool {
        let before = if self.style.absolute { self.e.map_or(0, Extrusion::get) } else { 0 };
        e.get() != before
    }

    /// What the next bead is for and how wide it will be, when that is not what it was.
    #[inline]
    fn show_bead(&mut self) {
        let (feature, flow) = (self.nozzle.feature(), self.nozzle.flow);
        if self.style.comments != Comments::Layers
            || (self.shown, self.shown_flow) == (Some(feature), Some(flow))
        {
            return;
        }
        if self.shown.replace(feature) != Some(feature) {
            remarks::feature(feature, &mut self.text);
        }
        if self.shown_flow.replace(flow) != Some(flow)
            && let Some(width) = self.style.width(self.size, flow)
        {
            remarks::width(width, &mut self.text);
        }
    }
}

/// Whether a line is a tag: what the stages say to each other and no machine.
fn is_tag(line: &Line) -> bool {
    match line {
        Line::Move(_) | Line::Arc(_) | Line::On | Line::Off | Line::Flow(_) | Line::Pasted(_) => false,
        Line::Verbatim(text) => text.starts_with('('),
        _ => true,
    }
}
