//! Dialects of G-code, as data.
//!
//! A [`Flavor`] says how a dialect is spelled and what its words mean, as far as one machine differs from another. The
//! parser and the exporter ask it and know no dialect by name. Those that are [built in](Flavor::built_in) are one
//! table; [`Flavor::set`] makes others, key by key, and [`Flavor::detect`] guesses from a file.

mod detect;
mod keys;
mod limit;
mod table;

pub use detect::{Choice, Reason};
pub use keys::FlavorError;
pub use limit::{Limit, LimitValue, Quantity};

use crate::parameters::LengthUnit;
use std::borrow::Cow;

/// How a machine lays clay.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extruder {
    /// By E words.
    #[default]
    Amount,
    /// By a screw that turns as the spindle words say: `M3 S`, `M5`.
    Screw,
    /// By a bead section that stays set: [`Flavor::bead_on`] and [`Flavor::bead_off`].
    Area,
    /// Not at all; it mills.
    None,
}

/// Whether `G90` and `G91` speak of E too.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AffectsE {
    /// E is relative after `G91` or after `M83`.
    #[default]
    Or,
    /// Whichever of `G90`, `G91`, `M82` and `M83` came last.
    Override,
    /// Only `M82` and `M83` do.
    Never,
}

/// The unit of a dwell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DwellUnit {
    /// Seconds.
    Seconds,
    /// Thousandths of a second.
    Milliseconds,
    /// Turns of the spindle.
    Revolutions,
    /// Seconds, although the manual of the machine does not have the word; to be told.
    DoubtfulSeconds,
}

/// What may stand in place of the numbers of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Variables {
    /// Nothing: what looks like a variable is a mistake.
    #[default]
    None,
    /// `#1`, `#<name>`, `[ ]`, o-words.
    Rs274,
    /// `#1`, `[ ]`, `WHILE DO`, `GOTO`, `G65`.
    Fanuc,
    /// `R1`, `( )`, `GOTOF`, `WHILE`, `FOR`, labels.
    Siemens,
    /// `var`, `if`, `while`, `{ }`: known, and told, but not run.
    RepRap,
}

/// What the P word of an arc counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ArcTurns {
    /// Nothing.
    #[default]
    None,
    /// Whole turns on top of the arc.
    Extra,
    /// Turns in all, the begun one counted.
    Total,
}

/// A dialect. Every field is one question in which machines differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Flavor {
    /// Its name, in lower case.
    pub name: Cow<'static, str>,
    /// `;` begins a remark.
    pub semicolon: bool,
    /// `(` and `)` enclose a remark.
    pub parentheses: bool,
    /// `"` encloses text in which a `;` is no remark.
    pub quotes: bool,
    /// Names of several letters are words, and `=` may stand before a number: `X=5`, `CR=3`.
    pub named_words: bool,
    /// Blanks may stand within a number.
    pub digit_gaps: bool,
    /// A line with a letter twice is refused as a whole, instead of the last counting.
    pub refuses_repeated: bool,
    /// The unit before the first `G20` or `G21`.
    pub unit: LengthUnit,
    /// The codes of inch and millimetre, in tenths; none if it has only one unit.
    pub unit_codes: Option<(u16, u16)>,
    /// A line of axes alone goes on with the last motion.
    pub modal_motion: bool,
    /// `G0` is faster than `G1`.
    pub rapid: bool,
    /// The words of a dwell, the one that wins first.
    pub dwell: Cow<'static, [(u8, DwellUnit)]>,
    /// How it lays clay.
    pub extruder: Extruder,
    /// The name that sets the section of the bead, mm².
    pub bead_on: Cow<'static, str>,
    /// The line that ends the bead.
    pub bead_off: Cow<'static, str>,
    /// Whether `G90` and `G91` speak of E too.
    pub g90_affects_e: AffectsE,
    /// It knows arcs at all.
    pub arcs: bool,
    /// The word of an arc's radius; empty if it knows none.
    pub arc_radius: Cow<'static, str>,
    /// What P means on an arc.
    pub arc_turns: ArcTurns,
    /// `G93` and `G95`.
    pub feed_modes: bool,
    /// The M codes behind which the rest of the line is text, in tenths.
    pub text_codes: Cow<'static, [u16]>,
    /// Lines may end with `*` and the XOR of their bytes.
    pub checksum: bool,
    /// The command that makes a pause with the extruder running, as an M code in tenths; 0 if none.
    pub purge_code: u16,
    /// What may stand in place of numbers.
    pub variables: Variables,
    /// The words that change the limits of the machine.
    pub limits: Cow<'static, [Limit]>,
    /// The decimals of lengths when it is written.
    pub decimals: u8,
    /// The line that ends a program; empty if none does.
    pub end: Cow<'static, str>,
}

impl Flavor {
    /// The built-in flavor of this name, in either case. `cead` and `baam` are other names of `siemens` and
    /// `cincinnati`.
    ///
    /// ```
    /// use gcode::Flavor;
    ///
    /// assert_eq!(Flavor::named("Klipper").map(|flavor| flavor.rapid), Some(false));
    /// assert_eq!(Flavor::named("cead"), Flavor::named("siemens"));
    /// assert_eq!(Flavor::named("abacus"), None);
    /// ```
    pub fn named(name: &str) -> Option<&'static Self> {
        let name = match name.to_ascii_lowercase().as_str() {
            "baam" => "cincinnati".to_owned(),
            "cead" => "siemens".to_owned(),
            "rrf" => "reprapfirmware".to_owned(),
            "linuxcnc" => "rs274".to_owned(),
            name => name.to_owned(),
        };
        Self::built_in().iter().find(|flavor| flavor.name == name)
    }

    /// The unit that this G code, in tenths, sets.
    pub(crate) fn unit_of(&self, tenths: u16) -> Option<LengthUnit> {
        let (inch, millimetre) = self.unit_codes?;
        match tenths {
            _ if tenths == inch => Some(LengthUnit::Inch),
            _ if tenths == millimetre => Some(LengthUnit::Millimetre),
            _ => None,
        }
    }
}

impl Default for Flavor {
    /// Marlin, which most files are for.
    fn default() -> Self {
        table::marlin()
    }
}

#[cfg(test)]
mod tests;
