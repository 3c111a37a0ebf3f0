//! `--dump`: the text and the drawn layers of every stage, to look at and to feed back.

use crate::output::put;
use crate::report::{Stop, io_error};
use clayforge::{Document, Drawing, Error, Form, draw};
use std::fs;
use std::path::{Path, PathBuf};

/// A folder that is being filled.
pub struct Dump {
    folder: PathBuf,
    /// The number and name of the last stage, and its drawing: what the machine reads looks like the skein before it.
    last: Option<(usize, &'static str)>,
    drawing: Option<String>,
}

impl Dump {
    /// Makes the folder.
    pub fn begin(folder: &Path) -> Result<Self, Error> {
        fs::create_dir_all(folder).map_err(|error| io_error(folder, "write", &error))?;
        Ok(Self { folder: folder.to_owned(), last: None, drawing: None })
    }

    /// Writes what a stage made.
    pub fn stage(&mut self, number: usize, name: &'static str, document: &Document) -> Result<(), Error> {
        self.last = Some((number, name));
        if document.form() == Form::Mesh {
            // The part as it was read is there already; what a stage has made of it is not.
            return match document.text().filter(|_| document.has_done(name)) {
                Some(text) => self.put(Form::Mesh.extension(), &text),
                None => Ok(()),
            };
        }
        if let Some(text) = document.text() {
            self.put(document.form().extension(), &text)?;
            self.drawing = Some(draw(document, Drawing::default()).map_err(|error| error.said_by("--dump"))?);
        }
        match &self.drawing {
            Some(drawing) => self.put("layers.svg", drawing.as_bytes()),
            None => Ok(()),
        }
    }

    /// Writes the finished file.
    pub fn file(&mut self, gcode: &[u8]) -> Result<(), Error> {
        self.put(Form::Gcode.extension(), gcode)
    }

    fn put(&self, ending: &str, text: &[u8]) -> Result<(), Error> {
        let Some((number, name)) = self.last else { return Ok(()) };
        let path = self.folder.join(format!("{number:02}-{name}.{ending}"));
        match put(&path, text) {
            Err(Stop::Failed(error)) => Err(error),
            _ => Ok(()),
        }
    }
}
