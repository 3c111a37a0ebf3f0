//! A line of the skein, its printer and its reader side by side.

use crate::command::command;
use crate::{Arc, Center, Error};
use shape::Point3;
use unit::{Direction, Extrusion, Feed, Micron, Ratio};

/// One line of the tagged G-code. Whatever is not known is [`Line::Verbatim`] and passes through every stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    /// `G1 X Y Z F E`: a straight move to a place.
    Move(Move),
    /// `G2` or `G3`: a move along a piece of a circle.
    Arc(Box<Arc>),
    /// `(<boundaryPoint> X Y Z </boundaryPoint>)` and its kin: a point of an outline.
    Point(Mark, Point3),
    /// `M101`: clay flows from here.
    On,
    /// `M103`: clay stops.
    Off,
    /// `M108 S1.0`: from here a bead has so much of its nominal section.
    Flow(Ratio),
    /// `(<layer> 0.75 )`: a layer begins; the height of its middle.
    Layer(Micron),
    /// `(<thickness> 1.2 </thickness>)`: this layer is not as high as the header says.
    Thickness(Micron),
    /// `(<edge> outer )` or `(<loop> inner )`: a wall begins.
    Wall(Tag, Side),
    /// `(<rotation> (1+0j) )` or `(<bridgeRotation> (1+0j) )`: the direction of infill.
    Rotation(Tag, Direction),
    /// `(<infill>)`: a block begins.
    Open(Tag),
    /// `(</infill>)`: a block ends.
    Close(Tag),
    /// `(<layerHeight> 1.5 </layerHeight>)`: a named value.
    Value(Box<(Box<str>, Box<str>)>),
    /// `(<alterationDeleteThisPrefix/>)G28`: a line of the potter's own for the machine, which no stage takes for its own.
    Pasted(Box<str>),
    /// Anything else, to the byte.
    Verbatim(Box<str>),
}

/// A straight move. Every move carries all three coordinates; feed and extrusion only where a stage has set them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Move {
    /// Where it ends.
    pub to: Point3,
    /// How fast, if said.
    pub feed: Option<Feed>,
    /// What it pushes out, if said.
    pub extrusion: Option<Extrusion>,
}

impl Move {
    /// A move to a place, at no stated speed.
    pub fn to(to: Point3) -> Self {
        Self { to, feed: None, extrusion: None }
    }

    /// How long it is from a place, in microns.
    #[inline]
    pub fn length(&self, from: Point3) -> f64 {
        let square = |from: i32, to: i32| {
            let difference = (i64::from(to) - i64::from(from)) as f64;
            difference * difference
        };
        (square(from.x, self.to.x) + square(from.y, self.to.y) + square(from.z, self.to.z)).sqrt()
    }
}

/// Which outline a point belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// The outline of the part.
    Boundary,
    /// The outline of what is filled.
    Infill,
}

/// Which side of the clay a wall is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// Around the outside.
    Outer,
    /// Around a hole.
    Inner,
}

/// What a bead is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Feature {
    /// The outermost wall.
    Edge(Side),
    /// A wall inside it.
    Loop(Side),
    /// Between the walls.
    Infill,
    /// A bead on the middle of a part too thin for two.
    Middle,
    /// Around the part, to prime the nozzle or to hold the part on the bed.
    Skirt,
    /// Under what would hang in the air.
    Support,
    /// Under the whole part.
    Raft,
}

/// Gives the blocks of the grammar (stages.md §2.2) their names.
macro_rules! tags {
    ($($(#[doc = $doc:literal])+ $variant:ident = $name:literal;)*) => {
        /// The name of a block.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Tag { $($(#[doc = $doc])+ $variant,)* }
        impl Tag {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The name as it stands between the angle brackets.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }
            pub(crate) fn from_name(name: &[u8]) -> Option<Self> {
                $(if name == $name.as_bytes() { return Some(Self::$variant); })*
                None
            }
        }
    };
}

tags! {
    /// An outline with everything that belongs to it.
    NestedRing = "nestedRing";
    /// The points of an outline and its wall.
    BoundaryPerimeter = "boundaryPerimeter";
    /// A layer.
    Layer = "layer";
    /// The outermost wall.
    Edge = "edge";
    /// An inner wall.
    Loop = "loop";
    /// Everything between the walls.
    Infill = "infill";
    /// The outline of what is filled.
    InfillBoundary = "infillBoundary";
    /// A bead on the middle of a thin part.
    Middle = "middle";
    /// The direction of infill.
    Rotation = "rotation";
    /// The direction of a bridge.
    BridgeRotation = "bridgeRotation";
    /// The header.
    ExtruderInitialization = "extruderInitialization";
    /// The settings that were used.
    Settings = "settings";
    /// Lines around the part.
    Skirt = "skirt";
    /// What holds up an overhang.
    Support = "supportLayer";
    /// What the part stands on.
    Raft = "raft";
    /// Lines of the potter's own.
    Alteration = "alteration";
    /// All layers.
    Crafting = "crafting";
}

impl Mark {
    fn tag(self) -> &'static str {
        match self {
            Self::Boundary => "boundaryPoint",
            Self::Infill => "infillPoint",
        }
    }
}

impl Side {
    fn word(self) -> &'static str {
        match self {
            Self::Outer => "outer",
            Self::Inner => "inner",
        }
    }
}

impl Line {
    /// A named value.
    ///
    /// # Errors
    /// When name or value would not read back as they were: a line break, a bracket, or blanks at an end.
    pub fn value(name: &str, value: &str) -> Result<Self, Error> {
        let plain = !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        let sound = value.trim() == value && !value.is_empty() && !value.contains(['\n', '\r']);
        if !plain || !sound || is_point(name) || name == "thickness" {
            return Err(Error::new(format!("`{name}` = `{value}` cannot stand in a header tag")));
        }
        Ok(Self::Value(Box::new((name.into(), value.into()))))
    }

    /// A block of the potter's own lines. Behind lines that count from where the nozzle is (G91), coordinates are
    /// absolute again, as those of every stage are.
    pub fn alteration(text: &str) -> Vec<Self> {
        let own = text.lines().map(str::trim).filter(|line| !line.is_empty());
        let mut block = vec![Self::Open(Tag::Alteration)];
        block.extend(own.map(|line| Self::Pasted(line.into())));
        let counting = |line: &str| match command(line) {
            Some((b'G', mode @ (90 | 91), _)) => Some(mode),
            _ => None,
        };
        if text.lines().rev().find_map(counting) == Some(91) {
            block.push(Self::Pasted("G90".into()));
        }
        block.push(Self::Close(Tag::Alteration));
        block
    }

    /// Where it goes, how fast, and what it pushes, if it is a move; an arc is one, too.
    #[inline]
    pub fn as_move(&self) -> Option<&Move> {
        match self {
            Self::Move(step) => Some(step),
            Self::Arc(arc) => Some(&arc.step),
            _ => None,
        }
    }

    /// The same, to be changed.
    #[inline]
    pub fn as_move_mut(&mut self) -> Option<&mut Move> {
        match self {
            Self::Move(step) => Some(step),
            Self::Arc(arc) => Some(&mut arc.step),
            _ => None,
        }
    }

    /// How long the way is from a place to the end of this move, in microns; nothing for other lines. The way up
    /// counts, too: a spiral climbs while it lays.
    #[inline]
    pub fn length(&self, from: Point3) -> f64 {
        match self {
            Self::Move(step) => step.length(from),
            Self::Arc(arc) => arc.length(from),
            _ => 0.0,
        }
    }

    /// Appends the line without a line break.
    pub fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Move(step) => {
                out.extend_from_slice(b"G1");
                step.place(out);
                step.rest(out);
            }
            Self::Arc(arc) => arc.write(out),
            Self::Point(mark, at) => {
                bracket(out, mark.tag());
                out.extend_from_slice(b" X");
                axes(out, *at);
                close(out, mark.tag());
            }
            Self::On => out.extend_from_slice(b"M101"),
            Self::Off => out.extend_from_slice(b"M103"),
            Self::Flow(flow) => {
                out.extend_from_slice(b"M108 S");
                flow.write(out);
            }
            Self::Layer(z) => {
                out.extend_from_slice(b"(<layer> ");
                z.write(out);
                out.extend_from_slice(b" )");
            }
            Self::Thickness(height) => {
                out.extend_from_slice(b"(<thickness> ");
                height.write(out);
                close(out, "thickness");
            }
            Self::Wall(tag, side) => {
                bracket(out, tag.name());
                out.push(b' ');
                out.extend_from_slice(side.word().as_bytes());
                out.extend_from_slice(b" )");
            }
            Self::Rotation(tag, direction) => {
                bracket(out, tag.name());
                out.extend_from_slice(format!(" {direction} )").as_bytes());
            }
            Self::Open(tag) => {
                bracket(out, tag.name());
                out.push(b')');
            }
            Self::Close(tag) => {
                out.extend_from_slice(b"(</");
                out.extend_from_slice(tag.name().as_bytes());
                out.extend_from_slice(b">)");
            }
            Self::Value(pair) => {
                bracket(out, &pair.0);
                out.push(b' ');
                out.extend_from_slice(pair.1.as_bytes());
                close(out, &pair.0);
            }
            Self::Pasted(text) => {
                out.extend_from_slice(PASTED);
                out.extend_from_slice(text.as_bytes());
            }
            Self::Verbatim(text) => out.extend_from_slice(text.as_bytes()),
        }
    }
}

/// What protects a line of the potter's own from the stages.
pub(crate) const PASTED: &[u8] = b"(<alterationDeleteThisPrefix/>)";

impl Move {
    #[inline]
    fn place(&self, out: &mut Vec<u8>) {
        out.extend_from_slice(b" X");
        axes(out, self.to);
    }

    #[inline]
    fn rest(&self, out: &mut Vec<u8>) {
        if let Some(feed) = self.feed {
            out.extend_from_slice(b" F");
            feed.write(out);
        }
        if let Some(extrusion) = self.extrusion {
            out.extend_from_slice(b" E");
            extrusion.write(out);
        }
    }
}

impl Arc {
    fn write(&self, out: &mut Vec<u8>) {
        out.extend_from_slice(if self.clockwise { b"G2" } else { b"G3" });
        self.step.place(out);
        match self.center {
            Center::Offset { i, j } => {
                out.extend_from_slice(b" I");
                i.write(out);
                out.extend_from_slice(b" J");
                j.write(out);
            }
            Center::Radius(radius) => {
                out.extend_from_slice(b" R");
                radius.write(out);
            }
        }
        self.step.rest(out);
    }
}

fn axes(out: &mut Vec<u8>, at: Point3) {
    Micron(at.x).write(out);
    out.extend_from_slice(b" Y");
    Micron(at.y).write(out);
    out.extend_from_slice(b" Z");
    Micron(at.z).write(out);
}

fn bracket(out: &mut Vec<u8>, name: &str) {
    out.extend_from_slice(b"(<");
    out.extend_from_slice(name.as_bytes());
    out.push(b'>');
}

fn close(out: &mut Vec<u8>, name: &str) {
    out.extend_from_slice(b" </");
    out.extend_from_slice(name.as_bytes());
    out.extend_from_slice(b">)");
}

fn is_point(name: &str) -> bool {
    name == Mark::Boundary.tag() || name == Mark::Infill.tag()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_takes_no_more_room_than_a_move_and_its_kind() {
        assert_eq!(size_of::<Line>(), 32);
    }
}
