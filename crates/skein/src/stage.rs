use crate::settings::Value;
use crate::{Error, Notes, Settings, Skein};

/// A craft stage from skein to skein: its settings, and what it does.
pub trait Stage: Settings + Clone + Send + Sync + 'static {
    /// The craft word: crate, profile section, header tag and command.
    const NAME: &'static str;

    /// Does the work. The same skein and the same settings give the same skein.
    ///
    /// # Errors
    /// When the skein lacks what the stage needs, with the place.
    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error>;
}

/// A stage whose type is forgotten: what a pipeline holds.
pub trait Craft: Send + Sync {
    /// The craft word.
    fn name(&self) -> &'static str;
    /// Every setting with its present value.
    fn values(&self) -> Vec<(&'static str, Value)>;
    /// Does the work.
    ///
    /// # Errors
    /// As [`Stage::craft`].
    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error>;
}

impl<T: Stage> Craft for T {
    fn name(&self) -> &'static str {
        T::NAME
    }
    fn values(&self) -> Vec<(&'static str, Value)> {
        Settings::values(self)
    }
    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        Stage::craft(self, skein, notes)
    }
}
