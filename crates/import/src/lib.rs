#![doc = include_str!("../README.md")]

mod amf;
mod error;
mod measure;
mod number;
mod obj;
mod package;
mod part;
mod ply;
mod polygon;
mod recognise;
mod scene;
mod stl;
mod svg;
mod threemf;
mod weld;
mod words;
mod xml;

pub use error::{ErrorKind, ImportError, Place};
pub use measure::{FileUnit, Unit};
pub use part::{Format, Part, Report};
pub use recognise::is_drawing;

use skein::{Settings, Slices};

/// Reads a part.
#[derive(Clone, Debug, PartialEq, Settings)]
pub struct Import {
    /// The unit of the file. 3MF and AMF say their own, all others are taken for millimetres; a part that comes out a
    /// thousand times or 25.4 times too small was drawn in metres or inches.
    #[setting(default = FileUnit::File)]
    pub unit: FileUnit,
}

impl Import {
    /// The craft word.
    pub const NAME: &'static str = "import";

    /// Reads the bytes of a file of any known form, recognised by what is in it.
    ///
    /// ```
    /// let error = import::Import::default().read(b"").unwrap_err();
    /// assert_eq!(error.to_string(), "the file is empty");
    /// ```
    ///
    /// # Errors
    /// When the bytes are of another form, damaged, or hold no part.
    pub fn read(&self, bytes: &[u8]) -> Result<Part, ImportError> {
        self.read_as(recognise::format(bytes)?, bytes)
    }

    /// Reads the bytes of an SVG of any program as layers.
    ///
    /// ```
    /// let svg = b"<svg><g id='z:0.5'><path d='M0 0 H8 V8 H0z'/></g></svg>";
    /// let drawing = import::Import::default().drawing(svg).expect("a drawing");
    /// assert_eq!(drawing.slices.layers[0].z.mm(), 0.5);
    /// ```
    ///
    /// # Errors
    /// When the bytes are no SVG, or one that is damaged or says nowhere how high a layer is.
    pub fn drawing(&self, bytes: &[u8]) -> Result<Drawing, ImportError> {
        svg::read(bytes, self.unit)
    }

    /// Reads bytes as a file of one format, whatever they are.
    ///
    /// # Errors
    /// When they are none, or damaged, or hold no part.
    pub fn read_as(&self, format: Format, bytes: &[u8]) -> Result<Part, ImportError> {
        let unit = self.unit.or(None);
        match format {
            Format::BinaryStl => stl::binary(bytes, unit),
            Format::TextStl => stl::text(bytes, unit),
            Format::Obj => obj::read(bytes, unit),
            Format::Ply => ply::read(bytes, unit),
            Format::ThreeMf | Format::Amf if package::is_archive(bytes) => package::read(bytes, self.unit),
            Format::ThreeMf => threemf::model(bytes, self.unit),
            Format::Amf => amf::read(bytes, self.unit),
            Format::Svg => Err(recognise::no_mesh()),
        }
    }
}

/// Layers as another program drew them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The loops of each layer, with y upwards, where the drawing has them, and its height, as the drawing says it. Of
    /// the facts there are only those that the drawing says itself, and no stage has been here.
    pub slices: Slices,
    /// What was left out or guessed, one sentence for each kind.
    pub remarks: Vec<String>,
}
