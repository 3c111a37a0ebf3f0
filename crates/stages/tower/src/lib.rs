#![doc = include_str!("../README.md")]

mod footprint;
mod order;
mod pieces;
#[cfg(test)]
mod tests;
mod write;

use order::{Order, Rules};
use pieces::Pieces;
use skein::{Angle, Error, Notes, Settings, Skein, Stage};

/// Prints an island some layers high before the next.
#[derive(Clone, Debug, Settings)]
pub struct Tower {
    /// How wide the nozzle and what carries it open upwards, from the vertical. Wider keeps towers lower where islands are
    /// near each other; narrower than the machine really is, it runs into what it has built.
    #[setting(default = 60.0, min = 0.0, max = 89.0, unit = "°")]
    pub extruder_possible_collision_cone_angle: Angle,
    /// How many layers an island may grow above the lowest before the nozzle goes to another. Higher saves travels; a very
    /// great number finishes whole copies one after the other, as far as the cone permits.
    #[setting(default = 5, min = 1, max = 1000000, unit = "layers")]
    pub maximum_tower_height: u32,
    /// How many layers at the bottom are laid whole, as in a print without towers.
    #[setting(default = 1, min = 0, max = 1000000, unit = "layers")]
    pub tower_start_layer: u32,
}

impl Stage for Tower {
    const NAME: &'static str = "tower";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        let nozzles = skein.nozzles();
        if nozzles.iter().any(|nozzle| nozzle.on) {
            notes.say("clay goes on from layer to layer, so no island can be printed before another");
            return Ok(skein);
        }
        let pieces = (skein.layers.iter().zip(&nozzles).enumerate())
            .map(|(index, (layer, nozzle))| {
                Pieces::read(layer, nozzle, &facts).map_err(|error| error.in_layer(index))
            })
            .collect::<Result<Vec<Pieces>, Error>>()?;
        // What is laid beside the islands (skirt, raft, support) stays as it is, and everything up to there.
        let beside = pieces.iter().rposition(|layer| layer.has_more).map_or(0, |last| last + 1);
        let start = beside.max(self.tower_start_layer as usize).min(pieces.len());
        if beside > self.tower_start_layer as usize && pieces.iter().any(|layer| layer.islands.len() > 1) {
            notes.say(format!("towers begin above layer {beside}, the last with a skirt, a raft or support"));
        }
        let rules = Rules {
            width: facts.bead_width()?.um(),
            slope: libm::tan(self.extruder_possible_collision_cone_angle.degrees().to_radians()),
            height: self.maximum_tower_height as usize,
        };
        let order = Order::new(&pieces, start, &rules);
        if order.is_by_layers() {
            return Ok(skein);
        }
        notes.say(format!("{} times an island grows before its layer is done", order.climbs()));
        skein.layers = write::layers(&skein.layers, &pieces, &order, &nozzles, facts.layer_height()?);
        Ok(skein)
    }
}
