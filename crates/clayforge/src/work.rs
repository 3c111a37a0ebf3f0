//! A stage whose type is forgotten: what the table makes and the pipeline runs.

use crate::document::{Plate, Text};
use crate::{Document, Form};
use skein::{Error, Field, Machine, Notes, SettingError, Settings, Signature, Stage, Value};
use std::marker::PhantomData;

/// Where pieces of the finished file go; an error stops the writing.
pub type Sink<'a> = &'a mut dyn FnMut(&[u8]) -> Result<(), Error>;

/// What a stage may see beside its document and its settings.
pub struct Bench<'a> {
    /// The printer, for the stages that cut the part and write the file.
    pub machine: &'a Machine,
    /// Where remarks go.
    pub notes: &'a mut Notes,
    /// Where export writes.
    pub sink: Sink<'a>,
}

/// Settings whose type is forgotten.
pub trait Keys: Send + Sync {
    /// Every setting, as its manual page says.
    fn fields(&self) -> Vec<Field>;
    /// Sets one.
    ///
    /// # Errors
    /// When there is no such setting or the value does not fit.
    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError>;
    /// Every setting with its present value.
    fn values(&self) -> Vec<(&'static str, Value)>;
}

impl<T: Settings + Send + Sync> Keys for T {
    fn fields(&self) -> Vec<Field> {
        T::fields()
    }
    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        Settings::set(self, key, value)
    }
    fn values(&self) -> Vec<(&'static str, Value)> {
        Settings::values(self)
    }
}

/// A stage with its settings, its type forgotten.
pub trait Work: Send + Sync {
    /// The form it takes and the form it gives.
    fn forms(&self) -> (Form, Form);
    /// Its settings.
    fn keys(&self) -> &dyn Keys;
    /// Its settings, to change them.
    fn keys_mut(&mut self) -> &mut dyn Keys;
    /// Does the work.
    ///
    /// # Errors
    /// When the document is of another form, or as the stage says.
    fn work(&self, document: Document, bench: &mut Bench<'_>) -> Result<Document, Error>;
    /// Another of the same.
    fn copy(&self) -> Box<dyn Work>;
}

fn wrong_form(wanted: Form, found: Form) -> Error {
    Error::new(format!("the stage reads {wanted}, and this is {found}"))
        .hint("the order of the stages: clayforge stages")
}

/// Stages that keep the form of the document.
pub(crate) struct On<D, S>(S, PhantomData<fn(D)>);

impl<D, S: Clone> Clone for On<D, S> {
    fn clone(&self) -> Self {
        Self(self.0.clone(), PhantomData)
    }
}

impl<D, S: Default> Default for On<D, S> {
    fn default() -> Self {
        Self(S::default(), PhantomData)
    }
}

/// The part of [`Work`] that is the same for every stage.
macro_rules! settings_of {
    ($($keys:tt)+) => {
        fn keys(&self) -> &dyn Keys {
            &self.$($keys)+
        }
        fn keys_mut(&mut self) -> &mut dyn Keys {
            &mut self.$($keys)+
        }
        fn copy(&self) -> Box<dyn Work> {
            Box::new(self.clone())
        }
    };
}

impl<D: Text, S: Stage<D>> Work for On<D, S> {
    settings_of!(0);

    fn forms(&self) -> (Form, Form) {
        (D::FORM, D::FORM)
    }
    fn work(&self, document: Document, bench: &mut Bench<'_>) -> Result<Document, Error> {
        let document = D::from_document(document).map_err(|found| wrong_form(D::FORM, found))?;
        self.0.craft(document, bench.notes).map(D::into_document)
    }
}

/// The stages that change the form of the document, each in its own way.
#[derive(Clone, Default)]
pub(crate) struct Special<S>(S);

impl Work for Special<scale::Scale> {
    settings_of!(0);

    fn forms(&self) -> (Form, Form) {
        (Form::Mesh, Form::Mesh)
    }
    fn work(&self, document: Document, bench: &mut Bench<'_>) -> Result<Document, Error> {
        match document {
            Document::Mesh(mut plate) => {
                plate.parts.iter_mut().try_for_each(|part| self.0.scale(part, bench.notes))?;
                Ok(Document::Mesh(plate))
            }
            other => Err(wrong_form(Form::Mesh, other.form())),
        }
    }
}

impl Work for Special<carve::Carve> {
    settings_of!(0);

    fn forms(&self) -> (Form, Form) {
        (Form::Mesh, Form::Slices)
    }
    fn work(&self, document: Document, bench: &mut Bench<'_>) -> Result<Document, Error> {
        match document {
            Document::Mesh(Plate { parts, done }) => {
                let mut slices = self.0.carve_all(&parts, bench.machine, bench.notes)?;
                slices.done = done.iter().map(|stage| Signature::new(stage, &[])).collect();
                Ok(Document::Slices(slices))
            }
            Document::Slices(drawing) => {
                self.0.lay(drawing, bench.machine, bench.notes).map(Document::Slices)
            }
            other => Err(wrong_form(Form::Mesh, other.form())),
        }
    }
}

impl Work for Special<preface::Preface> {
    settings_of!(0);

    fn forms(&self) -> (Form, Form) {
        (Form::Slices, Form::Skein)
    }
    fn work(&self, document: Document, _bench: &mut Bench<'_>) -> Result<Document, Error> {
        match document {
            Document::Slices(slices) => self.0.craft(&slices).map(Document::Skein),
            other => Err(wrong_form(Form::Slices, other.form())),
        }
    }
}

impl Work for Special<export::Export> {
    settings_of!(0);

    fn forms(&self) -> (Form, Form) {
        (Form::Skein, Form::Gcode)
    }
    fn work(&self, document: Document, bench: &mut Bench<'_>) -> Result<Document, Error> {
        match document {
            Document::Skein(skein) => self.0.export(skein, bench.notes, bench.sink).map(|()| Document::Gcode),
            other => Err(wrong_form(Form::Skein, other.form())),
        }
    }
}
