//! Changes finished G-code by what it does, not by how it is spelled.
//!
//! A potter has a file, of any program, and wants the pot larger, slower, with another nozzle, on another base, with a
//! stronger rim, or with a pause; and without slicing again. An [`Edit`] reads the commands with everything that holds
//! when they are met (units, absolute and relative, `G92`, the feed, arcs) and writes the file with the words changed
//! that must be. All other bytes stay, also those that nobody here understands; what was done stands behind the comments
//! that the file begins with.
//!
//! ```
//! use edit::{Axes, Edit, Scale, Size};
//!
//! let half = Edit::Scale(Scale { size: Size::Factor(0.5), axes: Axes::Xyz, bead: false });
//! let cup = b"G90\nM83\nG1 Z1 F600\nG1 X0 Y0\nG1 X10 E4 ; front\nG1 Y10 E4\n";
//! let edited = half.apply(cup)?;
//! let text = String::from_utf8(edited.text).unwrap();
//! assert!(text.ends_with("\nG1 X2.5 Y2.5 Z0.5\nG1 X7.5 E1 ; front\nG1 Y7.5 E1\n"));
//! # Ok::<(), skein::Error>(())
//! ```
//!
//! Edits are chained by giving each the text of the one before: [`apply_all`]. What a file is made of (layers, spirals)
//! is the business of [`clay_processor`], and so is the proof that an edit did what it says: see `tests/`.

mod arc;
mod base;
mod clean;
mod follow;
mod foot;
mod machine;
mod nozzle;
mod pause;
mod rim;
mod scale;
mod speed;
mod survey;
mod tape;
mod turn;
mod words;
mod writer;

pub use base::Base;
pub use clean::{Clean, FANS, HEATERS};
pub use nozzle::{Nozzle, Section};
pub use pause::{At, Pause};
pub use rim::Rim;
pub use scale::{Axes, Scale, Size};
pub use skein::Error;
pub use speed::Speed;

use tape::{head_length, line_end};

/// A change of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Larger or smaller.
    Scale(Scale),
    /// Faster or slower.
    Speed(Speed),
    /// For another nozzle.
    Nozzle(Nozzle),
    /// With the base of another file.
    Base(Base),
    /// Without some commands.
    Clean(Clean),
    /// With the last turn repeated.
    Rim(Rim),
    /// With a stop.
    Pause(Pause),
}

/// A file after an edit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edited {
    /// The file.
    pub text: Vec<u8>,
    /// What was done, a sentence each; they stand in the file too.
    pub said: Vec<String>,
}

impl Edit {
    /// The word by which it is called.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Scale(_) => "scale",
            Self::Speed(_) => "speed",
            Self::Nozzle(_) => "nozzle",
            Self::Base(_) => "base",
            Self::Clean(_) => "clean",
            Self::Rim(_) => "rim",
            Self::Pause(_) => "pause",
        }
    }

    /// Changes `text`, a file of G-code.
    ///
    /// # Errors
    /// When the file has not what the edit is about, such as layers or a spiral; when a number makes no sense; when
    /// the result could not be printed. The text of the error is for potters.
    pub fn apply(&self, text: &[u8]) -> Result<Edited, Error> {
        let edited = match self {
            Self::Scale(edit) => edit.apply(text),
            Self::Speed(edit) => edit.apply(text),
            Self::Nozzle(edit) => edit.apply(text),
            Self::Base(edit) => edit.apply(text),
            Self::Clean(edit) => edit.apply(text),
            Self::Rim(edit) => edit.apply(text),
            Self::Pause(edit) => edit.apply(text),
        };
        let mut edited = edited.map_err(|error| error.said_by(self.name()))?;
        self.sign(&mut edited, line_end(text));
        Ok(edited)
    }

    /// Puts what was done behind the comments that the file begins with.
    fn sign(&self, edited: &mut Edited, line_end: &[u8]) {
        let mut block = Vec::new();
        for (number, sentence) in edited.said.iter().enumerate() {
            let lead = if number == 0 { format!("; edit {}: ", self.name()) } else { ";   ".to_owned() };
            block.extend_from_slice(lead.as_bytes());
            block.extend_from_slice(sentence.as_bytes());
            block.extend_from_slice(line_end);
        }
        let place = head_length(&edited.text);
        edited.text.splice(place..place, block);
    }
}

/// Makes all edits, one on top of the other.
///
/// # Errors
/// Those of [`Edit::apply`].
pub fn apply_all(text: &[u8], edits: &[Edit]) -> Result<Edited, Error> {
    let mut whole = Edited { text: text.to_vec(), said: Vec::new() };
    for edit in edits {
        let edited = edit.apply(&whole.text)?;
        whole.text = edited.text;
        whole.said.extend(edited.said.into_iter().map(|sentence| format!("{}: {sentence}", edit.name())));
    }
    Ok(whole)
}

/// The result, with sentences that fit into comments.
fn said(text: Vec<u8>, sentences: &[String]) -> Edited {
    Edited { text, said: sentences.iter().map(|sentence| sentence.replace(['\r', '\n'], " ")).collect() }
}

/// A number that multiplies.
///
/// # Errors
/// When it is not above zero, or beyond what a part can be multiplied by.
fn factor(what: &str, value: f64) -> Result<f64, Error> {
    /// A thousand times as large or as small is no part of a printer any more.
    const MOST: f64 = 1000.0;
    if (1.0 / MOST..=MOST).contains(&value) {
        return Ok(value);
    }
    Err(Error::new(format!("{what} is {value}, and must be between 0.001 and 1000"))
        .hint("1 changes nothing, 0.5 makes it half, 2 doubles it"))
}

/// A length or an amount that may be zero, in mm.
///
/// # Errors
/// When it is negative or beyond a metre.
fn amount(what: &str, value: f64, most: f64) -> Result<f64, Error> {
    if (0.0..=most).contains(&value) {
        return Ok(value);
    }
    Err(Error::new(format!("{what} is {value}, and must be between 0 and {most}"))
        .hint("give a number in this range"))
}
