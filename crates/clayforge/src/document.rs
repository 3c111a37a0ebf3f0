//! The document that flows down the chain, in whichever of its forms it is.

use shape::TriangleMesh;
use skein::{Error, Signature, Skein, Slices};
use std::fmt;

/// What stands between two stages.
#[derive(Clone, Debug)]
pub enum Document {
    /// The parts as triangles.
    Mesh(Plate),
    /// The loops of each layer.
    Slices(Slices),
    /// Tagged G-code.
    Skein(Skein),
    /// The file for the machine. Its text went to the sink while it was made and is not kept.
    Gcode,
}

/// The parts that are printed together, before they are cut.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plate {
    /// The parts.
    pub parts: Vec<TriangleMesh>,
    /// The stages that have been here. Their settings are not kept: an STL file has no room for them.
    pub done: Vec<String>,
}

/// What the header of an STL file of ours begins with, in front of the stages that have been here.
const STL_HEAD: &str = "clayforge mesh: ";

impl Plate {
    /// The stages that an STL file of ours says it has been through.
    pub(crate) fn stages_of(bytes: &[u8]) -> Vec<String> {
        let head =
            bytes.get(..80).and_then(|head| head.strip_prefix(STL_HEAD.as_bytes())).unwrap_or_default();
        let words = head.split(|byte| !byte.is_ascii_lowercase()).filter(|word| !word.is_empty());
        words.map(|word| String::from_utf8_lossy(word).into_owned()).collect()
    }
}

/// The forms of a document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// [`Document::Mesh`], as text an STL file.
    Mesh,
    /// [`Document::Slices`], as text an SVG drawing.
    Slices,
    /// [`Document::Skein`], as text tagged G-code.
    Skein,
    /// [`Document::Gcode`], as text what the machine reads.
    Gcode,
}

impl Form {
    /// How a file of this form ends.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Mesh => "stl",
            Self::Slices => "svg",
            Self::Skein | Self::Gcode => "gcode",
        }
    }

    /// Guesses the form of a text from how it begins; only the forms that a stage reads.
    pub fn of(text: &[u8]) -> Self {
        let head = &text[..text.len().min(1 << 16)];
        let has = |needle: &[u8]| head.windows(needle.len()).any(|window| window == needle);
        if import::is_drawing(text) {
            Self::Slices
        } else if has(b"(<extruderInitialization>)") || has(b"(</extruderInitialization>)") {
            Self::Skein
        } else {
            Self::Mesh
        }
    }
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Mesh => "a mesh",
            Self::Slices => "the SVG of carve",
            Self::Skein => "a skein",
            Self::Gcode => "G-code",
        })
    }
}

/// A document that stages take and give back in the same form.
pub(crate) trait Text: Sized + 'static {
    /// Its form.
    const FORM: Form;
    /// Takes it out; of another document only its form comes back.
    fn from_document(document: Document) -> Result<Self, Form>;
    /// Puts it in.
    fn into_document(self) -> Document;
}

macro_rules! texts {
    ($($type:ident)*) => {$(
        impl Text for $type {
            const FORM: Form = Form::$type;
            fn from_document(document: Document) -> Result<Self, Form> {
                match document {
                    Document::$type(inner) => Ok(inner),
                    other => Err(other.form()),
                }
            }
            fn into_document(self) -> Document {
                Document::$type(self)
            }
        }
    )*};
}

texts! { Slices Skein }

impl Document {
    /// Its form.
    pub fn form(&self) -> Form {
        match self {
            Self::Mesh(_) => Form::Mesh,
            Self::Slices(_) => Form::Slices,
            Self::Skein(_) => Form::Skein,
            Self::Gcode => Form::Gcode,
        }
    }

    /// Its text, if it has one that is kept.
    pub fn text(&self) -> Option<Vec<u8>> {
        match self {
            Self::Slices(slices) => Some(slices.write()),
            Self::Skein(skein) => Some(skein.write()),
            // Several parts are no file.
            Self::Mesh(Plate { parts, done }) => match &parts[..] {
                [part] => Some(mesh::binary_stl(part, &done.join(" "))),
                _ => None,
            },
            Self::Gcode => None,
        }
    }

    /// Whether a stage has been here already.
    pub fn has_done(&self, stage: &str) -> bool {
        match self {
            Self::Slices(slices) => slices.done.iter().any(|signature| signature.stage == stage),
            Self::Skein(skein) => skein.has_done(stage),
            Self::Mesh(plate) => plate.done.iter().any(|done| done == stage),
            Self::Gcode => false,
        }
    }

    /// Says in the header that a stage has been here.
    pub(crate) fn sign(&mut self, signature: Signature) -> Result<(), Error> {
        match self {
            Self::Slices(slices) => slices.done.push(signature),
            Self::Skein(skein) => skein.sign(&signature)?,
            Self::Mesh(plate) => plate.done.push(signature.stage),
            Self::Gcode => {}
        }
        Ok(())
    }

    /// Checks the laws of its form.
    pub(crate) fn verify(&self) -> Result<(), Error> {
        match self {
            Self::Skein(skein) => skein.verify(),
            _ => Ok(()),
        }
    }
}
