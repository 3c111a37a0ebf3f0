#![doc = include_str!("../README.md")]

use skein::{Error, Feature, Feed, Line, Notes, Nozzle, Ratio, Settings, Skein, Stage, Tag};

#[cfg(test)]
mod tests;

/// Puts a feed rate on every move.
#[derive(Clone, Debug, Settings)]
pub struct Speed {
    /// The speed at which beads are laid. Slower presses better and shakes less; faster is done before the rim dries.
    #[setting(default = 30.0, min = 0.1, max = 1000.0, unit = "mm/s")]
    pub feed: Feed,
    /// The speed of travels. Faster leaves thinner strings and shakes wet walls more.
    #[setting(default = 60.0, min = 0.1, max = 1000.0, unit = "mm/s")]
    pub travel_feed: Feed,
    /// The fastest that the machine goes up or down. Stages that lift the nozzle keep to it; `limit` holds all moves to
    /// it.
    #[setting(default = 10.0, min = 0.01, max = 1000.0, unit = "mm/s")]
    pub z_feed: Feed,
    /// The speed of going around while something is waited for, as a share of the feed.
    #[setting(default = 0.5, min = 0.01, max = 2.0)]
    pub orbital: Ratio,
    /// The speed of the first layer, as a share of the others'. Slower sticks better.
    #[setting(default = 0.5, min = 0.05, max = 2.0)]
    pub first_layer: Ratio,
    /// The speed of the outermost wall, as a share. Less makes a cleaner face, but clay likes a feed that stays the
    /// same: each change of it shows as a thicker or thinner bead until the pressure has followed.
    #[setting(default = 1.0, min = 0.05, max = 2.0)]
    pub perimeter: Ratio,
    /// The speed on layers that bridge a gap, as a share. Less gives the bead time to catch hold; more pulls it
    /// straight.
    #[setting(default = 1.0, min = 0.05, max = 2.0)]
    pub bridge: Ratio,
}

impl Stage for Speed {
    const NAME: &'static str = "speed";

    fn craft(&self, mut skein: Skein, _notes: &mut Notes) -> Result<Skein, Error> {
        let mut facts = skein.facts()?;
        facts.operating_feed = Some(self.feed);
        facts.travel_feed = Some(self.travel_feed);
        facts.z_feed = Some(self.z_feed);
        // To the three decimals that the header has.
        let orbital = (self.feed.mm_per_s() * self.orbital.f64() * 1000.0).round() / 1000.0;
        facts.orbital_feed = Feed::from_mm_per_s(orbital.max(0.001));
        skein.state(&facts)?;
        // Whatever moves before the first layer lies on the bed like the first layer.
        let nozzles = skein.nozzles();
        self.pace(0, false, &mut skein.head)?;
        self.pace(usize::MAX, nozzles.last().is_some_and(|nozzle| nozzle.on), &mut skein.tail)?;
        skein.each(|index, layer| self.pace(index, nozzles[index].on, &mut layer.lines))?;
        Ok(skein)
    }
}

impl Speed {
    /// Gives the moves of one layer their feed.
    ///
    /// As on the machine a feed holds until the next one, so it is said only when it changes. The first travel and the
    /// first bead of a layer always say theirs: a layer can be moved, copied or left out and is still right. In a spiral
    /// clay is `on` already when a layer begins.
    fn pace(&self, layer: usize, on: bool, lines: &mut [Line]) -> Result<(), Error> {
        let mut nozzle = Nozzle { on, ..Nozzle::default() };
        let mut bridge = false;
        let (mut has_travelled, mut has_laid) = (false, false);
        for line in lines {
            if let Some(step) = line.as_move_mut() {
                let said = if nozzle.on { &mut has_laid } else { &mut has_travelled };
                let feed = match step.feed {
                    Some(feed) => feed,
                    None if nozzle.on => self.bead(layer, nozzle.feature, bridge)?,
                    None => self.travel_feed,
                };
                if nozzle.feed != Some(feed) || !*said {
                    step.feed = Some(feed);
                }
                *said = true;
            }
            match line {
                Line::Rotation(Tag::BridgeRotation, _) => bridge = true,
                Line::Close(Tag::BridgeRotation) => bridge = false,
                _ => {}
            }
            nozzle.follow(line);
        }
        Ok(())
    }

    /// The feed of a bead. All shares are multiplied first and rounded once.
    fn bead(&self, layer: usize, feature: Feature, bridge: bool) -> Result<Feed, Error> {
        let mut share = 1.0;
        if layer == 0 {
            share *= self.first_layer.f64();
        }
        if matches!(feature, Feature::Edge(_)) {
            share *= self.perimeter.f64();
        }
        if bridge {
            share *= self.bridge.f64();
        }
        Feed::from_mm_per_s(self.feed.mm_per_s() * share).ok_or_else(|| {
            Error::new(format!(
                "a bead at {} mm/s times {share} has no speed a machine can move at",
                self.feed.mm_per_s()
            ))
            .hint("bring `feed` and its shares closer to one another")
        })
    }
}
