//! How fast everything moves.

use skein::{Error, Feed, Notes, Ratio, Settings, Skein, Stage};

/// Puts a feed rate on every move.
#[derive(Clone, Debug, Settings)]
pub struct Speed {
    /// The speed at which beads are laid.
    #[setting(default = 30.0, min = 0.1, max = 1000.0, unit = "mm/s")]
    pub feed: Feed,
    /// The speed of travels. Faster leaves thinner strings and shakes wet walls more.
    #[setting(default = 60.0, min = 0.1, max = 1000.0, unit = "mm/s")]
    pub travel_feed: Feed,
    /// The speed of the first layer, as a share of the others'. Slower sticks better.
    #[setting(default = 0.5, min = 0.05, max = 2.0)]
    pub first_layer: Ratio,
    /// The speed of the outermost wall, as a share.
    #[setting(default = 1.0, min = 0.05, max = 2.0)]
    pub perimeter: Ratio,
    /// The speed on layers that bridge a gap, as a share.
    #[setting(default = 1.0, min = 0.05, max = 2.0)]
    pub bridge: Ratio,
}

impl Stage for Speed {
    const NAME: &'static str = "speed";

    fn craft(&self, skein: Skein, _notes: &mut Notes) -> Result<Skein, Error> {
        Ok(skein)
    }
}
