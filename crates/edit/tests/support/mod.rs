//! Prints in several dialects, and a reader of motion of their own: what an edit does is not judged by its own eyes.

use gcode::{Code, Line, lines};
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::fmt::Write;

/// How a program writes.
#[derive(Clone, Copy, Debug)]
pub struct Dialect {
    pub relative: bool,
    pub relative_e: bool,
    pub inches: bool,
    pub crlf: bool,
    pub numbered: bool,
    pub arcs: bool,
    /// E begins at 0 again on every layer.
    pub resets: bool,
    /// The last turns climb.
    pub spiral: bool,
}

pub fn dialect() -> impl Strategy<Value = Dialect> {
    any::<[bool; 8]>().prop_map(|[relative, relative_e, inches, crlf, numbered, arcs, resets, spiral]| {
        Dialect {
            relative,
            // Firmware does not agree on absolute E among relative coordinates.
            relative_e: relative_e || relative,
            inches,
            crlf,
            numbered,
            arcs,
            resets,
            spiral,
        }
    })
}

/// A pot: a base of two layers of rings, and a wall of four turns.
#[derive(Clone, Copy, Debug)]
pub struct Pot {
    pub centre: [f64; 2],
    pub radius: f64,
    pub layer: f64,
    /// E for each mm.
    pub flow: f64,
    pub dialect: Dialect,
}

pub fn pot() -> impl Strategy<Value = Pot> {
    (60_u32..120, 60_u32..120, 20_u32..40, 1_u32..8, 1_u32..20, dialect()).prop_map(
        |(x, y, radius, layer, flow, dialect)| Pot {
            centre: [f64::from(x), f64::from(y)],
            radius: f64::from(radius),
            layer: f64::from(layer) * 0.25,
            flow: f64::from(flow) * 0.1,
            dialect,
        },
    )
}

struct Pen {
    text: String,
    at: [f64; 3],
    e: f64,
    dialect: Dialect,
    number: u32,
}

impl Pen {
    fn line(&mut self, code: &str) {
        let mut code = code.to_owned();
        if self.dialect.numbered && !code.starts_with(';') {
            self.number += 1;
            code = format!("N{} {code}", self.number);
            let sum = code.bytes().fold(0, |sum, byte| sum ^ byte);
            let _ = write!(code, "*{sum}");
        }
        self.text.push_str(&code);
        self.text.push_str(if self.dialect.crlf { "\r\n" } else { "\n" });
    }

    fn go(&mut self, command: &str, to: [f64; 3], flow: f64, length: f64, rest: &str) {
        let unit = if self.dialect.inches { 25.4 } else { 1.0 };
        let mut code = command.to_owned();
        for (letter, axis) in ["X", "Y", "Z"].into_iter().zip(0..3) {
            if to[axis] != self.at[axis] {
                let word = if self.dialect.relative { to[axis] - self.at[axis] } else { to[axis] };
                let _ = write!(code, " {letter}{:.5}", word / unit);
            }
        }
        if flow > 0.0 {
            let clay = flow * length;
            self.e += clay;
            let word = if self.dialect.relative_e { clay } else { self.e };
            let _ = write!(code, " E{:.5}", word / unit);
        }
        self.at = to;
        self.line(&format!("{code}{rest}"));
    }

    fn straight(&mut self, to: [f64; 3], flow: f64) {
        let length = (0..3).map(|axis| (to[axis] - self.at[axis]).powi(2)).sum::<f64>().sqrt();
        self.go("G1", to, flow, length, "");
    }
}

impl Pot {
    pub fn text(&self) -> String {
        let dialect = self.dialect;
        let mut pen = Pen { text: String::new(), at: [0.0; 3], e: 0.0, dialect, number: 0 };
        let unit = if dialect.inches { 25.4 } else { 1.0 };
        pen.line("; a pot");
        pen.line("M104 S200");
        pen.line("G28");
        pen.line("G90");
        pen.line("M82");
        pen.line(if dialect.inches { "G20" } else { "G21" });
        pen.line("G92 X0 Y0 Z0 E0");
        if dialect.relative {
            pen.line("G91");
        }
        if dialect.relative_e {
            pen.line("M83");
        }
        pen.line(&format!("G1 F{}", 1200.0 / unit));
        let [x, y] = self.centre;
        for layer in 1..=2 {
            let z = f64::from(layer) * self.layer;
            pen.line(&format!(";LAYER:{layer}"));
            for radius in [self.radius / 2.0, self.radius] {
                pen.straight([x + radius, y, z], 0.0);
                self.ring(&mut pen, radius, z, 0.0);
            }
            pen.line(if dialect.numbered { "M106 S100" } else { "M106 S100 ; blow" });
            if dialect.resets {
                pen.line("G92 E0");
                pen.e = 0.0;
            }
        }
        for turn in 0..4 {
            let z = f64::from(2 + turn) * self.layer;
            if dialect.spiral {
                self.ring(&mut pen, self.radius, z, self.layer);
            } else {
                pen.straight([x + self.radius, y, z + self.layer], 0.0);
                self.ring(&mut pen, self.radius, z + self.layer, 0.0);
            }
        }
        pen.line("M107");
        let top = pen.at[2] + 10.0;
        pen.straight([pen.at[0], pen.at[1], top], 0.0);
        pen.straight([0.0, 0.0, top], 0.0);
        pen.line("M84");
        pen.text
    }

    fn ring(&self, pen: &mut Pen, radius: f64, z: f64, rise: f64) {
        let [x, y] = self.centre;
        if self.dialect.arcs {
            let unit = if self.dialect.inches { 25.4 } else { 1.0 };
            let length = (TAU * radius / 2.0).hypot(rise / 2.0);
            for (side, share) in [(-1.0, 0.5), (1.0, 1.0)] {
                let to = [x + side * radius, y, z + rise * share];
                let rest = format!(" I{:.5} J0", side * radius / unit);
                pen.go("G3", to, self.flow, length, &rest);
            }
            return;
        }
        const STEPS: u32 = 24;
        for step in 1..=STEPS {
            let share = f64::from(step) / f64::from(STEPS);
            let (sin, cos) = if step == STEPS { (0.0, 1.0) } else { (share * TAU).sin_cos() };
            pen.straight([x + radius * cos, y + radius * sin, z + rise * share], self.flow);
        }
    }
}

/// One move, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    pub from: [f64; 3],
    pub to: [f64; 3],
    pub clay: f64,
    pub feed: f64,
    /// The way, arcs as half circles.
    pub length: f64,
}

impl Step {
    pub fn prints(&self) -> bool {
        self.clay > 1e-9 && self.length > 1e-9 && (self.from[0], self.from[1]) != (self.to[0], self.to[1])
    }
}

/// All moves of a text; the first place is 0.
pub fn steps(text: &[u8]) -> Vec<Step> {
    let (mut at, mut e, mut feed, mut unit) = ([0.0; 3], 0.0, 0.0, 1.0);
    let (mut relative, mut relative_e) = (false, false);
    let mut found = Vec::new();
    for text in lines(text) {
        let line = Line::of(text);
        let Some(Code { letter, thousandths }) = line.command else { continue };
        match (letter, thousandths / 1000) {
            (b'G', 20) => unit = 25.4,
            (b'G', 21) => unit = 1.0,
            (b'G', 90) => relative = false,
            (b'G', 91) => relative = true,
            (b'M', 82) => relative_e = false,
            (b'M', 83) => relative_e = true,
            (b'G', 92) => e = line.words.get(b'E').map_or(e, |value| value * unit),
            (b'G', number @ 0..=3) => {
                let from: [f64; 3] = at;
                for (axis, letter) in (*b"XYZ").into_iter().enumerate() {
                    if let Some(value) = line.words.get(letter) {
                        at[axis] = value * unit + if relative { at[axis] } else { 0.0 };
                    }
                }
                let mut clay = 0.0;
                if let Some(value) = line.words.get(b'E') {
                    clay = value * unit - if relative_e || relative { 0.0 } else { e };
                    e += clay;
                }
                feed = line.words.get(b'F').map_or(feed, |value| value * unit);
                let ways: [f64; 3] = std::array::from_fn(|axis| at[axis] - from[axis]);
                let flat = ways[0].hypot(ways[1]);
                let flat = if number >= 2 { flat * TAU / 4.0 } else { flat };
                found.push(Step { from, to: at, clay, feed, length: flat.hypot(ways[2]) });
            }
            _ => {}
        }
    }
    found
}

/// The whole way and clay of the beads.
pub fn beads(text: &[u8]) -> (f64, f64) {
    let steps = steps(text);
    let beads = steps.iter().filter(|step| step.prints());
    beads.fold((0.0, 0.0), |(length, clay), step| (length + step.length, clay + step.clay))
}
