//! Pots made from formulas, as fill would lay them.

use proptest::prelude::*;
use shape::plane::offset;
use skein::{Point, Ring, Skein};
use std::f64::consts::TAU;
use std::fmt::Write;

/// A pot by its outline at each height. Lengths are in microns.
#[derive(Clone, Copy, Debug)]
pub struct Pot {
    pub radius: f64,
    /// Depth of the lobes as a share of the radius, and how many.
    pub lobes: (f64, u32),
    /// Turns of the form per layer.
    pub twist: f64,
    /// How far each layer reaches over the one below.
    pub flare: f64,
    /// How much narrower it is in the middle of its height.
    pub waist: f64,
    /// How far each layer is moved.
    pub lean: f64,
    /// Which way it leans, as a share of a turn.
    pub lean_to: f64,
    pub square: bool,
    pub layers: usize,
    pub base: usize,
    pub walls: usize,
    /// How wide a bead is.
    pub width: f64,
    /// How high a layer is.
    pub height: i32,
}

/// The plain one.
pub const CYLINDER: Pot = Pot {
    radius: 30_000.0,
    lobes: (0.0, 0),
    twist: 0.0,
    flare: 0.0,
    waist: 0.0,
    lean: 0.0,
    lean_to: 0.0,
    square: false,
    layers: 12,
    base: 2,
    walls: 1,
    width: 3_000.0,
    height: 1_500,
};

impl Pot {
    pub fn outline(&self, layer: usize) -> Ring {
        let up = layer as f64;
        let tall = (self.layers.max(2) - 1) as f64;
        let radius = self.radius + self.flare * up - self.waist * libm::sin(TAU / 2.0 * up / tall);
        let count = if self.square { 4 } else { 240 };
        let (east, north) = (libm::cos(TAU * self.lean_to), libm::sin(TAU * self.lean_to));
        let corner = |step: usize| {
            let angle = TAU * step as f64 / count as f64;
            let far = radius + self.radius * self.lobes.0 * libm::cos(angle * f64::from(self.lobes.1));
            let turned = angle + TAU * self.twist * up;
            let at = |cosine: f64, lean: f64| (far * cosine + self.lean * up * lean).round() as i32;
            Point::new(at(libm::cos(turned), east), at(libm::sin(turned), north))
        };
        Ring((0..count).map(corner).collect())
    }

    /// The middle of a bead of the wall on a layer, where there is one.
    pub fn bead(&self, layer: usize, bead: usize) -> Option<Ring> {
        let inside = offset(&[self.outline(layer)], -self.width * (bead as f64 + 0.5));
        <[Ring; 1]>::try_from(inside).ok().map(|[ring]| ring)
    }

    /// Whether every layer has room for the beads of its wall.
    pub fn has_room(&self) -> bool {
        let room =
            |layer| self.bead(layer, self.walls - 1).is_some_and(|ring| ring.length() > 8.0 * self.width);
        (0..self.layers).all(room)
    }

    /// The pot as fill would lay it: its walls, and as much infill as a base takes.
    pub fn skein(&self) -> Skein {
        let (width, height) = (self.width / 1000.0, f64::from(self.height) / 1000.0);
        let mut text = include_str!("../../../../../tests/case-header.gcode")
            .replace("ayerHeight> 1.5 ", &format!("ayerHeight> {height} "))
            .replace("Width> 3.0 ", &format!("Width> {width} "));
        for layer in 0..self.layers {
            let outline = self.outline(layer);
            let (middle, top) = (height * (layer as f64 + 0.5), height * (layer as f64 + 1.0));
            let _ = writeln!(text, "(<layer> {middle:.3} )\n(<nestedRing>)\n(<boundaryPerimeter>)");
            for at in &outline.0 {
                let (x, y) = mm(*at);
                let _ = writeln!(text, "(<boundaryPoint> X{x} Y{y} Z{middle:.3} </boundaryPoint>)");
            }
            text.push_str("(</boundaryPerimeter>)\n");
            for wall in 0..self.walls {
                let tag = if wall == 0 { "edge" } else { "loop" };
                if let Some(ring) = self.bead(layer, wall) {
                    let _ = writeln!(text, "(<{tag}> outer )");
                    thread(&mut text, ring.0.iter().chain(ring.0.first()), top);
                    let _ = writeln!(text, "(</{tag}>)");
                }
            }
            if layer < self.base {
                text.push_str("(<infill>)\n");
                // Only its length counts.
                let far = (outline.area() * 1e6 / self.width).round() as i32;
                thread(&mut text, &[Point::new(0, 0), Point::new(far, 0)], top);
                text.push_str("(</infill>)\n");
            }
            text.push_str("(</nestedRing>)\n(</layer>)\n");
        }
        text.push_str("(</crafting>)\n");
        Skein::read(text.as_bytes()).expect("a skein")
    }
}

fn mm(at: Point) -> (f64, f64) {
    (f64::from(at.x) / 1000.0, f64::from(at.y) / 1000.0)
}

fn thread<'a>(text: &mut String, points: impl IntoIterator<Item = &'a Point>, z: f64) {
    for (index, at) in points.into_iter().enumerate() {
        let (x, y) = mm(*at);
        let _ = writeln!(text, "G1 X{x} Y{y} Z{z:.3}{}", if index == 0 { "\nM101" } else { "" });
    }
    text.push_str("M103\n");
}

/// Pots of all sizes and beads whose walls lean by so many times the height at most, whichever way: outwards, inwards,
/// to a side, by the twist of their lobes and by all of that at once.
pub fn pots(steepest: f64) -> impl Strategy<Value = Pot> {
    let size = (15_000.0..120_000.0_f64, 2_000.0..8_000.0_f64, 0.1..0.75_f64);
    let form = (0.0..0.15_f64, 0..9_u32, any::<bool>());
    let leans = (-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64, 0.0..1.0_f64, 0.0..1.0_f64);
    (size, form, leans, 3..12_usize, 0..3_usize, 1..4_usize)
        .prop_map(move |((radius, width, flat), (deep, lobes, square), leans, turns, base, walls)| {
            let (flare, waist, lean, twist, lean_to, slope) = leans;
            let height = ((width * flat).clamp(800.0, 3_000.0) as i32 / 10) * 10;
            let layers = turns + base;
            let lobes = if square { (0.0, 0) } else { (deep, lobes) };
            // What each kind of leaning moves a wall by in one layer, at most; together they may do so by `most`.
            let most = slope * steepest * f64::from(height);
            let turning = TAU * radius * if square { 0.71 } else { lobes.0 * f64::from(lobes.1) };
            let waisting = TAU / 2.0 / (layers - 1) as f64;
            let sum = flare.abs() + waist.abs() + lean.abs() + twist.abs();
            let part = |share: f64| most * share / sum.max(1e-6);
            Pot {
                radius,
                lobes,
                twist: if turning > 0.0 { (part(twist) / turning).clamp(-0.02, 0.02) } else { 0.0 },
                flare: part(flare),
                waist: part(waist) / waisting,
                lean: part(lean),
                lean_to,
                square,
                layers,
                base,
                walls,
                width,
                height,
            }
        })
        .prop_filter("the beads have no room", Pot::has_room)
}
