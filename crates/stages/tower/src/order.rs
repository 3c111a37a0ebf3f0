//! In which order the islands of all layers are laid.

use crate::pieces::{Island, Pieces};
use skein::Point;

/// What a tower must keep to, in microns.
pub struct Rules {
    /// The width of a bead.
    pub width: f64,
    /// How much wider the nozzle is per micron of height.
    pub slope: f64,
    /// How many layers an island may climb.
    pub height: usize,
}

/// How far an island may reach out over the one below to be counted as its continuation, in bead widths.
const OVERHANG: f64 = 1.5;

/// Layers and islands in the order in which they are laid.
pub struct Order {
    steps: Vec<Step>,
}

/// A piece of the way up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// The layer.
    pub layer: usize,
    /// The island; nothing for a layer that has none.
    pub island: Option<usize>,
    /// Whether it continues the island of the step before.
    pub climbs: bool,
}

impl Order {
    /// Lets islands grow from a layer on. The lowest layer that is not done gives its next island in its own order; from
    /// there the nozzle climbs, as long as the cone of the nozzle stays clear when it comes back for what it has left.
    pub fn new(layers: &[Pieces], start: usize, rules: &Rules) -> Self {
        let mut left: Vec<Vec<bool>> = layers.iter().map(|layer| vec![true; layer.islands.len()]).collect();
        let mut steps = Vec::new();
        let mut lowest = 0;
        while lowest < layers.len() {
            let Some(first) = left[lowest].iter().position(|left| *left) else {
                if layers[lowest].islands.is_empty() {
                    steps.push(Step { layer: lowest, island: None, climbs: false });
                }
                lowest += 1;
                continue;
            };
            let mut island = first;
            let mut layer = lowest;
            left[layer][island] = false;
            steps.push(Step { layer, island: Some(island), climbs: false });
            let height = if lowest < start { 0 } else { rules.height };
            for _ in 0..height {
                let Some(next) = rules.next(layers, &left, lowest, (layer, island)) else { break };
                (layer, island) = (layer + 1, next);
                left[layer][island] = false;
                steps.push(Step { layer, island: Some(island), climbs: true });
            }
        }
        Self { steps }
    }

    /// The steps; those that follow each other on a layer, in its own order, together.
    pub fn groups(&self) -> impl Iterator<Item = &[Step]> {
        self.steps.chunk_by(|one, other| one.layer == other.layer && one.island < other.island)
    }

    /// Whether every layer is done before the next.
    pub fn is_by_layers(&self) -> bool {
        self.steps.is_sorted_by_key(|step| step.layer)
    }

    /// How often an island grows while its layer is not done.
    pub fn climbs(&self) -> usize {
        self.steps.windows(2).filter(|pair| pair[1].layer < pair[0].layer).count()
    }
}

impl Rules {
    /// The island of the next layer with which a tower goes on: the nearest that it carries and that leaves room.
    fn next(
        &self,
        layers: &[Pieces],
        left: &[Vec<bool>],
        lowest: usize,
        (layer, island): (usize, usize),
    ) -> Option<usize> {
        let above = layers.get(layer + 1)?;
        let below = &layers[layer].islands[island];
        let way = |island: &Island| {
            let (_, from) = below.ends?;
            island.ends.map(|(to, _)| Point::distance2(from, to))
        };
        (0..above.islands.len())
            .filter(|next| left[layer + 1][*next])
            .filter(|next| {
                let next = &above.islands[*next];
                below.footprint.carries(&next.footprint, OVERHANG * self.width)
                    && self.leaves_room(layers, left, lowest..layer + 1, (next, above.z))
            })
            .min_by_key(|next| way(&above.islands[*next]).unwrap_or(i64::MAX))
    }

    /// Whether the nozzle will come to every island that is left in some layers without touching a tower of a height.
    fn leaves_room(
        &self,
        layers: &[Pieces],
        left: &[Vec<bool>],
        range: std::ops::Range<usize>,
        (tower, top): (&Island, i32),
    ) -> bool {
        range.into_iter().all(|layer| {
            let height = f64::from(top) - f64::from(layers[layer].z);
            let reach = height.max(0.0) * self.slope + self.width / 2.0;
            let waits = layers[layer].islands.iter().zip(&left[layer]).filter(|(_, left)| **left);
            waits.into_iter().all(|(island, _)| !island.footprint.is_within(&tower.footprint, reach))
        })
    }
}
