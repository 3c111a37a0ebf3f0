//! Clay G-code for the machine.

use skein::{Choice, Error, Notes, Settings, Skein};

/// Writes the file that the machine reads.
#[derive(Clone, Debug, Settings)]
pub struct Export {
    /// Lines before the print: home, prime.
    #[setting(default = "G28\nG92 E0")]
    pub start: String,
    /// Lines after the print: relieve the pressure, lift, park. No line may lower the nozzle into the pot.
    #[setting(default = "G91\nG1 Z10 F600\nG90\nM84")]
    pub end: String,
    /// What the file says beside its commands.
    #[setting(default = Comments::Layers)]
    pub comments: Comments,
    /// Decimals of coordinates.
    #[setting(default = 3, min = 1, max = 3)]
    pub decimals: u32,
}

/// What the file says beside its commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Comments {
    /// A head, and for each layer and bead what viewers understand.
    Layers,
    /// The head only.
    Head,
    /// Nothing.
    None,
}

impl Export {
    /// The craft word.
    pub const NAME: &'static str = "export";

    /// Writes the file in pieces, each ending with a line; the skein is taken apart on the way, so that it and the
    /// text are never whole in memory together.
    ///
    /// # Errors
    /// When a move has no place on a machine, or with what the sink says.
    pub fn export(
        &self,
        _skein: Skein,
        _notes: &mut Notes,
        _sink: &mut dyn FnMut(&[u8]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        Err(Error::new("under construction"))
    }
}
