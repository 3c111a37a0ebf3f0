//! What is said about the interruptions that are left.

use crate::sheet::{Plan, Sheet};
use crate::{Join, Seam};

use skein::{Error, Notes, Point};

/// The interruptions between the first touch and the last.
pub struct Report {
    stops: Vec<Stop>,
    /// The width of a bead in microns.
    spacing: f64,
}

/// A place where clay stops and begins again elsewhere.
struct Stop {
    layer: usize,
    at: Point,
    /// How far it is to where clay begins again, in microns.
    length: f64,
    why: Why,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Why {
    /// To the next layer, which `through_layers` would do away with.
    Rise,
    /// To the next layer, which begins elsewhere.
    FarRise,
    /// To another island.
    Island,
    /// On an island, to what is beside nothing else.
    Apart,
}

impl Report {
    /// Looks at every place between two threads.
    pub fn new(sheets: &[Sheet], plans: &[Plan], spacing: f64) -> Self {
        let mut stops = Vec::new();
        let mut before: Option<(usize, usize, Point)> = None;
        for (layer, (sheet, plan)) in sheets.iter().zip(plans).enumerate() {
            if let Some(end) = sheet.kept {
                before = end.map(|end| (layer, 0, end));
            }
            for (island, path) in plan
                .paths
                .iter()
                .enumerate()
                .flat_map(|(index, paths)| paths.iter().map(move |path| (index, path)))
            {
                if let Some((last_layer, last_island, at)) = before.filter(|_| !path.flows_on) {
                    let length = at.distance(path.start);
                    let why = match (last_layer == layer, last_island == island) {
                        (true, true) => Why::Apart,
                        (true, false) => Why::Island,
                        (false, _) if length <= crate::tree::REACH * spacing => Why::Rise,
                        (false, _) => Why::FarRise,
                    };
                    stops.push(Stop { layer: last_layer, at, length, why });
                }
                before = Some((layer, island, path.closed_end()));
            }
        }
        Self { stops, spacing }
    }

    /// Says how many there are and what would do away with them.
    ///
    /// # Errors
    /// When there are more than are allowed.
    pub fn say(&self, join: &Join, notes: &mut Notes) -> Result<(), Error> {
        let count = self.stops.len();
        if let Some(first) = self.stops.first()
            && count > join.max_interruptions as usize
        {
            let at = format!("x {:.1} y {:.1}", f64::from(first.at.x) / 1e3, f64::from(first.at.y) / 1e3);
            return Err(Error::layer(
                first.layer,
                format!(
                    "clay stops at {at}, the first of {count} interruptions; `max_interruptions` is {}",
                    join.max_interruptions
                ),
            )
            .hint(self.advice(join)));
        }
        if let Some(longest) = self.stops.iter().max_by(|one, other| one.length.total_cmp(&other.length)) {
            let beads = longest.length / self.spacing;
            let text = format!(
                "clay stops {count} times before the end; the longest way without clay is {:.1} mm ({beads:.1} beads). {}",
                longest.length / 1e3,
                self.advice(join)
            );
            notes.spot(longest.layer, longest.at, text);
        } else {
            notes.say("clay never stops before the end");
        }
        Ok(())
    }

    fn advice(&self, join: &Join) -> String {
        let count = |why: Why| self.stops.iter().filter(|stop| stop.why == why).count();
        let mut parts = Vec::new();
        let (rises, far, islands, apart) =
            (count(Why::Rise), count(Why::FarRise), count(Why::Island), count(Why::Apart));
        if rises > 0 && !join.through_layers {
            parts.push(format!(
                "{rises} are between layers: `join.through_layers = true` does away with them"
            ));
        }
        if far > 0 {
            let cure = match join.seam {
                Seam::Nearest if !join.through_layers => {
                    "`join.through_layers = true` lets clay flow on to most of them"
                }
                Seam::Nearest => "the part changes too much there",
                Seam::Aligned | Seam::Behind => "`join.seam = \"nearest\"` keeps them short",
            };
            parts.push(format!("{far} lead to layers that begin elsewhere: {cure}"));
        }
        if islands > 0 {
            parts.push(format!("{islands} lead to other islands: only a part in one piece has none"));
        }
        if apart > 0 {
            parts.push(format!("{apart} lead to beads that lie beside no other: `fill.density` 0 or 1, or more `fill.walls`, leave fewer"));
        }
        parts.join("; ")
    }
}
