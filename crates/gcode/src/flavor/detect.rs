//! Guesses the flavor of a file from what only one dialect says.

use super::Flavor;
use crate::parse::cut_line;
use std::fmt;

/// How many lines at either end of a file are looked at: what a slicer says of itself, and the settings it appends.
const LINES: usize = 200;

/// A sign of a dialect: whose, what it looks like in upper case, and how much it says.
struct Sign {
    flavor: &'static str,
    text: &'static str,
    place: Place,
    weight: u32,
}

#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// A remark says it.
    Remark,
    /// A line of code begins with it, and what follows is no part of it.
    Start,
    /// It stands somewhere in the code of a line.
    Code,
}

const fn sign(flavor: &'static str, place: Place, text: &'static str, weight: u32) -> Sign {
    Sign { flavor, text, place, weight }
}

/// What a program says of itself weighs most, then what only one dialect has, then habits.
const SIGNS: &[Sign] = &{
    use Place::{Code, Remark, Start};
    [
        sign("marlin", Remark, "FLAVOR:MARLIN", 100),
        sign("marlin", Remark, "GCODE_FLAVOR = MARLIN", 100),
        sign("reprapfirmware", Remark, "FLAVOR:REPRAP (REPRAP", 100),
        sign("reprapfirmware", Remark, "GCODE_FLAVOR = REPRAPFIRMWARE", 100),
        sign("klipper", Remark, "GCODE_FLAVOR = KLIPPER", 100),
        sign("klipper", Remark, "FLAVOR:KLIPPER", 100),
        sign("rs274", Remark, "GCODE_FLAVOR = MACHINEKIT", 100),
        sign("cincinnati", Remark, "CINCINNATI", 100),
        sign("cincinnati", Remark, "BAAM", 60),
        sign("siemens", Remark, "SIEMENS", 100),
        sign("siemens", Remark, "CEAD", 60),
        sign("grbl", Remark, "GRBL", 60),
        sign("rs274", Remark, "LINUXCNC", 100),
        sign("klipper", Start, "SET_VELOCITY_LIMIT", 50),
        sign("klipper", Start, "SET_PRESSURE_ADVANCE", 50),
        sign("klipper", Start, "EXCLUDE_OBJECT_START", 40),
        sign("klipper", Start, "EXCLUDE_OBJECT_DEFINE", 40),
        sign("klipper", Start, "BED_MESH_CALIBRATE", 40),
        sign("klipper", Start, "START_PRINT", 20),
        sign("klipper", Start, "PRINT_START", 20),
        sign("reprapfirmware", Start, "M566", 40),
        sign("reprapfirmware", Start, "M572", 40),
        sign("reprapfirmware", Start, "M98 P\"", 40),
        sign("reprapfirmware", Start, "VAR", 40),
        sign("marlin", Start, "M205", 10),
        sign("marlin", Start, "M900", 20),
        sign("marlin", Start, "M420", 20),
        sign("marlin", Start, "M500", 10),
        sign("marlin", Start, "M104", 3),
        sign("marlin", Start, "M109", 3),
        sign("marlin", Start, "M82", 2),
        sign("marlin", Start, "M83", 2),
        sign("cincinnati", Start, "M66", 40),
        sign("cincinnati", Start, "M68", 30),
        sign("cincinnati", Start, "M69", 30),
        sign("cincinnati", Start, "M64", 30),
        sign("cincinnati", Start, "M222", 10),
        sign("cincinnati", Start, "M237", 20),
        sign("siemens", Start, "TRAORI", 50),
        sign("siemens", Start, "DEF REAL", 50),
        sign("siemens", Start, "MSG(", 50),
        sign("siemens", Start, "WHEN TRUE DO", 50),
        sign("siemens", Start, "G642", 30),
        sign("siemens", Start, "G500", 30),
        sign("siemens", Code, "BEAD_AREA=", 50),
        sign("siemens", Code, "GOTOF", 40),
        sign("siemens", Code, "GOTOB", 40),
        sign("siemens", Code, "SUPA", 30),
        sign("siemens", Code, "R1=", 40),
        sign("siemens", Code, "X=", 20),
        sign("siemens", Code, "CR=", 30),
        sign("grbl", Start, "$H", 50),
        sign("grbl", Start, "$X", 50),
        sign("grbl", Start, "$1", 50),
        sign("rs274", Code, "#<", 60),
        sign("rs274", Start, "O<", 60),
        sign("rs274", Code, " ENDSUB", 60),
        sign("rs274", Code, " ENDWHILE", 40),
        sign("rs274", Start, "G64 P", 20),
    ]
};

/// What speaks for a flavor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reason {
    /// What was found.
    pub text: &'static str,
    /// In which line, counted from one; counted from the end, and negative, behind the first 200.
    pub line: i32,
}

/// The flavor that was chosen, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The flavor.
    pub flavor: &'static Flavor,
    /// What speaks for it, the strongest first; empty if nothing does.
    pub reasons: Vec<Reason>,
    /// Whether nothing else has as much to be said for it.
    pub certain: bool,
}

impl fmt::Display for Choice {
    /// `klipper, because of SET_VELOCITY_LIMIT in line 3`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.flavor.name)?;
        for (index, reason) in self.reasons.iter().take(3).enumerate() {
            f.write_str(if index == 0 { ", because of " } else { ", " })?;
            match reason.line {
                line if line < 0 => write!(f, "{} in line {} from the end", reason.text, -line)?,
                line => write!(f, "{} in line {line}", reason.text)?,
            }
        }
        if !self.certain {
            f.write_str("; nothing certain says so, name the flavor if it is another")?;
        }
        Ok(())
    }
}

impl Flavor {
    /// The flavor that the first and the last 200 lines of `text` speak for most; Marlin if nothing does.
    ///
    /// ```
    /// let choice = gcode::Flavor::detect(b"G28\nSET_VELOCITY_LIMIT ACCEL=500\nG1 X5\n");
    /// assert_eq!(choice.to_string(), "klipper, because of SET_VELOCITY_LIMIT in line 2");
    /// ```
    pub fn detect(text: &[u8]) -> Choice {
        let mut found: Vec<(&Sign, i32)> = Vec::new();
        let mut rest = crate::without_bom(text);
        for number in 1..=LINES as i32 {
            if rest.is_empty() {
                break;
            }
            let (line, behind) = cut_line(rest);
            rest = behind;
            look(line, number, &mut found);
        }
        let rest = rest.strip_suffix(b"\n").unwrap_or(rest);
        for (index, line) in rest.rsplit(|&byte| byte == b'\n').take(LINES).enumerate() {
            look(line, -1 - index as i32, &mut found);
        }
        choose(found)
    }
}

/// Adds the signs of a line that have not been seen before.
fn look(line: &[u8], number: i32, found: &mut Vec<(&'static Sign, i32)>) {
    // What is longer is a picture, not a sign.
    const LONGEST: usize = 400;
    let line = line.get(..LONGEST).unwrap_or(line).to_ascii_uppercase();
    let line = line.trim_ascii();
    let (code, remark) = match line.iter().position(|&byte| byte == b';') {
        Some(index) => line.split_at(index),
        None if line.first() == Some(&b'(') => (&b""[..], line),
        None => (line, &b""[..]),
    };
    for sign in SIGNS {
        let text = sign.text.as_bytes();
        let holds = match sign.place {
            Place::Remark => has(remark, text),
            Place::Code => has(code, text),
            Place::Start => {
                code.strip_prefix(text).is_some_and(|rest| !is_inside(text, rest.first().copied()))
            }
        };
        if holds && !found.iter().any(|(other, _)| std::ptr::eq(*other, sign)) {
            found.push((sign, number));
        }
    }
}

/// Whether `next` goes on with the name or number in which `text` ends.
fn is_inside(text: &[u8], next: Option<u8>) -> bool {
    let ends_in_digit = text.last().is_some_and(u8::is_ascii_digit);
    // `$1` stands for all settings of two or three digits.
    let whole = text.first() != Some(&b'$');
    let ends_in_letter = text.last().is_some_and(u8::is_ascii_alphabetic);
    match next {
        Some(byte) if byte.is_ascii_digit() => ends_in_digit && whole,
        Some(byte) if byte.is_ascii_alphabetic() || byte == b'_' => ends_in_letter && text != b"G64 P",
        _ => false,
    }
}

fn has(text: &[u8], part: &[u8]) -> bool {
    text.windows(part.len()).any(|window| window == part)
}

fn choose(mut found: Vec<(&'static Sign, i32)>) -> Choice {
    let score = |flavor: &Flavor| -> u32 {
        found.iter().filter(|(sign, _)| sign.flavor == flavor.name).map(|(sign, _)| sign.weight).sum()
    };
    let scores: Vec<u32> = Flavor::built_in().iter().map(score).collect();
    let best = scores.iter().copied().max().unwrap_or(0);
    let index = scores.iter().position(|&score| score == best).unwrap_or(0);
    let certain = best > 0 && scores.iter().filter(|&&score| score == best).count() == 1;
    let built_in = Flavor::built_in();
    // Marlin is the first.
    let flavor = &built_in[if certain { index } else { 0 }];
    found.retain(|(sign, _)| sign.flavor == flavor.name);
    found.sort_by_key(|(sign, _)| std::cmp::Reverse(sign.weight));
    let reasons = found.into_iter().map(|(sign, line)| Reason { text: sign.text, line }).collect();
    Choice { flavor, reasons, certain }
}
