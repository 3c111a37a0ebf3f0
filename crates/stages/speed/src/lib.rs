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
    /// The speed of the outermost wall on the first layer, as a share of what it would have there.
    #[setting(default = 1.0, min = 0.05, max = 2.0)]
    pub first_layer_perimeter: Ratio,
    /// The speed of travels on the first layer, as a share. Slower pulls less at what has just been laid.
    #[setting(default = 1.0, min = 0.05, max = 1.0)]
    pub first_layer_travel: Ratio,
    /// The speed of the outermost wall, as a share. Less makes a cleaner face, but clay likes a feed that stays the
    /// same: each change of it shows as a thicker or thinner bead until the pressure has followed.
    #[setting(default = 1.0, min = 0.05, max = 2.0)]
    pub perimeter: Ratio,
    /// The speed on layers that bridge a gap, as a share. Less gives the bead time to catch hold; more pulls it
    /// straight.
    #[setting(default = 1.0, min = 0.05, max = 2.0)]
    pub bridge: Ratio,
    /// How much clay the outermost wall gets, as a share of what its bead is made of. Less keeps its face from bulging;
    /// too little does not bind.
    #[setting(default = 1.0, min = 0.1, max = 3.0)]
    pub perimeter_flow: Ratio,
    /// How much clay a bead gets on layers that bridge a gap. Less hangs through less.
    #[setting(default = 1.0, min = 0.1, max = 3.0)]
    pub bridge_flow: Ratio,
    /// How much clay a bead gets on the first layer, but for the outermost wall. More fills what the bed is uneven by.
    #[setting(default = 1.0, min = 0.1, max = 3.0)]
    pub first_layer_flow: Ratio,
    /// How much clay the outermost wall gets on the first layer.
    #[setting(default = 1.0, min = 0.1, max = 3.0)]
    pub first_layer_perimeter_flow: Ratio,
    /// Whether a bead that gets less clay is laid faster by as much, and one that gets more slower, so that equally much
    /// is pushed out each second: a pump that answers late then has nothing to answer to. No bead is laid faster than a
    /// travel.
    #[setting(default = false)]
    pub constant_flow: bool,
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
        if self.changes_flow() {
            let nozzles = skein.nozzles();
            let flow = |layer: usize| nozzles.get(layer).map_or(Ratio::ONE, |nozzle| nozzle.flow);
            self.pour(0, Ratio::ONE, &mut skein.head);
            self.pour(usize::MAX, flow(skein.layers.len()), &mut skein.tail);
            skein.each(|index, layer| {
                self.pour(index, flow(index), &mut layer.lines);
                Ok(())
            })?;
        }
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
        let travel = self.travel(layer)?;
        let (mut has_travelled, mut has_laid) = (false, false);
        for line in lines {
            if let Some(step) = line.as_move_mut() {
                let said = if nozzle.on { &mut has_laid } else { &mut has_travelled };
                let feed = match step.feed {
                    Some(feed) => feed,
                    None if nozzle.on => self.bead(layer, &nozzle, bridge)?,
                    None => travel,
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

    /// Whether any bead gets another share of clay than the document says.
    fn changes_flow(&self) -> bool {
        let shares =
            [self.perimeter_flow, self.bridge_flow, self.first_layer_flow, self.first_layer_perimeter_flow];
        shares.iter().any(|share| *share != Ratio::ONE)
    }

    /// Gives the beads of one layer their share of clay, on top of the share that they have already.
    ///
    /// It is said in front of the first move that has it, and the layer ends with the flow that the document has there:
    /// it can be moved, copied or left out, too.
    fn pour(&self, layer: usize, flow: Ratio, lines: &mut Vec<Line>) {
        let mut nozzle = Nozzle { flow, ..Nozzle::default() };
        let mut bridge = false;
        let mut said = flow;
        let mut poured = Vec::with_capacity(lines.len() + lines.len() / 16);
        for line in lines.drain(..) {
            nozzle.follow(&line);
            let wanted = match &line {
                Line::Flow(_) => continue,
                Line::Rotation(Tag::BridgeRotation, _) => {
                    bridge = true;
                    said
                }
                Line::Close(Tag::BridgeRotation) => {
                    bridge = false;
                    said
                }
                Line::Close(Tag::Layer) => nozzle.flow,
                line if nozzle.on && line.as_move().is_some() => {
                    let share = nozzle.flow.f64() * self.flow(layer, nozzle.feature(), bridge);
                    Ratio::from_f64(share).unwrap_or(nozzle.flow)
                }
                _ => said,
            };
            if wanted != said {
                poured.push(Line::Flow(wanted));
                said = wanted;
            }
            poured.push(line);
        }
        if said != nozzle.flow {
            poured.push(Line::Flow(nozzle.flow));
        }
        *lines = poured;
    }

    /// The share of clay of a bead.
    fn flow(&self, layer: usize, feature: Feature, bridge: bool) -> f64 {
        let is_edge = matches!(feature, Feature::Edge(_));
        let mut share = 1.0;
        if layer == 0 {
            share *= if is_edge { self.first_layer_perimeter_flow } else { self.first_layer_flow }.f64();
        }
        if is_edge {
            share *= self.perimeter_flow.f64();
        }
        if bridge {
            share *= self.bridge_flow.f64();
        }
        share
    }

    /// The feed of a travel.
    fn travel(&self, layer: usize) -> Result<Feed, Error> {
        if layer > 0 || self.first_layer_travel == Ratio::ONE {
            return Ok(self.travel_feed);
        }
        feed(self.travel_feed, self.first_layer_travel.f64(), "a travel")
    }

    /// The feed of a bead. All shares are multiplied first and rounded once.
    fn bead(&self, layer: usize, nozzle: &Nozzle, bridge: bool) -> Result<Feed, Error> {
        let is_edge = matches!(nozzle.feature(), Feature::Edge(_));
        let mut share = 1.0;
        if layer == 0 {
            share *= self.first_layer.f64();
            if is_edge {
                share *= self.first_layer_perimeter.f64();
            }
        }
        if is_edge {
            share *= self.perimeter.f64();
        }
        if bridge {
            share *= self.bridge.f64();
        }
        if self.constant_flow && nozzle.flow != Ratio::ONE {
            // What gets nearly nothing would be laid at any speed.
            let most = (self.travel_feed.mm_per_s() / self.feed.mm_per_s()).max(share);
            share = (share / nozzle.flow.f64().max(1e-6)).min(most);
        }
        feed(self.feed, share, "a bead")
    }
}

/// A share of a feed.
fn feed(whole: Feed, share: f64, what: &str) -> Result<Feed, Error> {
    Feed::from_mm_per_s(whole.mm_per_s() * share).ok_or_else(|| {
        Error::new(format!(
            "{what} at {} mm/s times {share} has no speed a machine can move at",
            whole.mm_per_s()
        ))
        .hint("bring the feeds and their shares closer to one another")
    })
}
