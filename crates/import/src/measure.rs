//! Units of length, and what the size of a part says about them.

use shape::Bounds;
use skein::{Choice, Micron};

/// A unit of length in which a file may be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unit {
    /// A thousandth of a millimetre.
    Micron,
    /// What a file is in that does not say.
    #[default]
    Millimetre,
    /// Ten millimetres.
    Centimetre,
    /// A thousand millimetres.
    Metre,
    /// 25.4 millimetres.
    Inch,
    /// Twelve inches.
    Foot,
}

impl Unit {
    /// How many microns it has.
    pub const fn microns(self) -> u64 {
        match self {
            Self::Micron => 1,
            Self::Millimetre => 1_000,
            Self::Centimetre => 10_000,
            Self::Metre => 1_000_000,
            Self::Inch => 25_400,
            Self::Foot => 304_800,
        }
    }

    /// The words of 3MF (core specification, 3.4) and AMF (ISO/ASTM 52915, 6.2), and their spellings in the wild.
    pub(crate) fn of_word(word: &str) -> Option<Self> {
        const WORDS: &[(&str, Unit)] = &[
            ("micron", Unit::Micron),
            ("micrometer", Unit::Micron),
            ("millimeter", Unit::Millimetre),
            ("mm", Unit::Millimetre),
            ("centimeter", Unit::Centimetre),
            ("meter", Unit::Metre),
            ("inch", Unit::Inch),
            ("foot", Unit::Foot),
            ("feet", Unit::Foot),
        ];
        WORDS.iter().find(|(known, _)| known.eq_ignore_ascii_case(word)).map(|(_, unit)| *unit)
    }

    /// What it is called in a sentence: `it was read in …`.
    pub(crate) fn plural(self) -> &'static str {
        match self {
            Self::Micron => "microns",
            Self::Millimetre => "millimetres",
            Self::Centimetre => "centimetres",
            Self::Metre => "metres",
            Self::Inch => "inches",
            Self::Foot => "feet",
        }
    }
}

/// The unit that the profile asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum FileUnit {
    /// What the file says; millimetres when it does not say, as STL, OBJ and PLY never do.
    File,
    /// Microns.
    Um,
    /// Millimetres, whatever the file says.
    Mm,
    /// Centimetres.
    Cm,
    /// Metres.
    M,
    /// Inches of 25.4 mm.
    Inch,
    /// Feet of 304.8 mm.
    Foot,
}

impl FileUnit {
    /// The unit, for a file that says `own`.
    pub(crate) fn or(self, own: Option<Unit>) -> Unit {
        match self {
            Self::File => own.unwrap_or_default(),
            Self::Um => Unit::Micron,
            Self::Mm => Unit::Millimetre,
            Self::Cm => Unit::Centimetre,
            Self::M => Unit::Metre,
            Self::Inch => Unit::Inch,
            Self::Foot => Unit::Foot,
        }
    }
}

/// What is asked when a part in millimetres has the size of a pot in another unit: nobody prints a pot of four
/// millimetres from clay, but many draw one of four inches.
pub(crate) fn doubt(bounds: Bounds) -> Option<String> {
    let side = |low: i32, high: i32| Micron(high - low);
    let sides = [
        side(bounds.min.x, bounds.max.x),
        side(bounds.min.y, bounds.max.y),
        side(bounds.min.z, bounds.max.z),
    ];
    let [x, y, z] = sides;
    let largest = sides.into_iter().max()?.0;
    let (plural, word) = match largest {
        // A pot of up to 1.5 m.
        ..1_500 => ("metres", "m"),
        // One of 40 to 250 mm.
        1_500..10_000 => ("inches", "inch"),
        // Beyond 20 m.
        20_000_000.. => ("microns", "um"),
        _ => return None,
    };
    Some(format!(
        "the part is {x} × {y} × {z} mm; if it was drawn in {plural}, read it with --set import.unit={word}"
    ))
}
