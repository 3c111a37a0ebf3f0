#![doc = include_str!("../README.md")]

mod base;
mod lane;
mod lay;
mod plan;
mod seam;
mod source;
#[cfg(test)]
mod tests;
mod texture;
mod thin;
mod track;
mod turn;
mod write;
mod zigzag;

use plan::{Plan, Role};
use rayon::prelude::*;
use skein::{Choice, Error, Layer, Micron, Notes, Ratio, Settings, Skein, Stage};
use source::Source;

/// Winds the wall of a pot as one thread that climbs from the base to the rim.
#[derive(Clone, Debug, Settings)]
pub struct Coil {
    /// How many beads the wall is thick: 1, 2 or 3. With 0 as many as fill lays, or as fit into a wall that is drawn.
    #[setting(default = 0, min = 0, max = 3)]
    pub beads: u32,
    /// How the solid layers below the wall are laid. How many there are is a setting of fill.
    #[setting(default = Base::InAndOut)]
    pub base: Base,
    /// How much clay the base gets, as a share of what fills it. More presses it tight and onto the bed.
    #[setting(default = 1.0, min = 0.5, max = 2.0)]
    pub base_flow: Ratio,
    /// How far apart the rings of the base lie, in beads. Less binds better and heaps clay up.
    #[setting(default = 1.0, min = 0.5, max = 1.5, unit = "beads")]
    pub base_spacing: Ratio,
    /// How far the place where a wall of two or three beads crosses over moves on with each turn, in beads. 0 puts all of
    /// them above each other; more than a half leaves a gap beside each.
    #[setting(default = 0.25, min = -1.0, max = 1.0, unit = "beads")]
    pub seam_step: Ratio,
    /// How often the nozzle goes round the finished rim without clay, to smooth it.
    #[setting(default = 0, min = 0, max = 100)]
    pub rim_turns: u32,
    /// How far waves swing the wall to either side. 0 for a smooth wall.
    #[setting(default = 0.0, min = 0.0, max = 20.0, unit = "mm")]
    pub wave_height: Micron,
    /// How many waves a turn has.
    #[setting(default = 12, min = 1, max = 1000)]
    pub waves: u32,
    /// How far the waves are turned from layer to layer, as a share of a wave. 0.5 sets hills on valleys.
    #[setting(default = 0.0, min = -1.0, max = 1.0, unit = "waves")]
    pub wave_step: Ratio,
}

/// How the solid layers below the wall are laid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Base {
    /// Round and round, from the rim to the middle and back out: one thread that goes on as the wall.
    InAndOut,
    /// There and back in straight lines within one ring: one thread that goes on as the wall, which begins at the corner
    /// where the lines end. Where lines would fall apart, and on what is smaller than three, round and round.
    ZigZag,
    /// As fill laid them, with a stop before the wall.
    AsFilled,
}

impl Stage for Coil {
    const NAME: &'static str = "coil";

    /// Each layer is read by itself, what it becomes depends on its neighbours, and then each is laid by itself again.
    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let facts = skein.facts()?;
        let sources = std::mem::take(&mut skein.layers)
            .into_par_iter()
            .enumerate()
            .map(|(index, layer)| {
                Source::read(layer, &facts, self.beads as usize).map_err(|error| error.in_layer(index))
            })
            .collect::<Result<Vec<Source>, Error>>()?;
        let plan = Plan::new(self, &sources, notes);
        let lines: Vec<_> = (0..sources.len()).into_par_iter().map(|index| plan.write(index)).collect();
        let roles = plan.roles;
        for ((index, source), (lines, remarks)) in sources.into_iter().enumerate().zip(lines) {
            notes.append(remarks);
            let layer = match roles[index] {
                Role::Layered => source.layer,
                _ => Layer { lines },
            };
            skein.layers.push(layer);
        }
        Ok(skein)
    }
}
