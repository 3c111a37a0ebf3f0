use crate::{Error, Notes, Settings, Skein};

/// A craft stage that takes a document and gives one of the same form: its settings, and what it does. Nearly all work
/// on skeins; those before preface work on slices.
pub trait Stage<Document = Skein>: Settings + Clone + Send + Sync + 'static {
    /// The craft word: crate, profile section, header tag and command.
    const NAME: &'static str;

    /// Does the work. The same document and the same settings give the same document.
    ///
    /// # Errors
    /// When the document lacks what the stage needs, with the place.
    fn craft(&self, document: Document, notes: &mut Notes) -> Result<Document, Error>;
}
