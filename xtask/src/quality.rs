//! What comes out of a slicer: how often the nozzle travels, what of the part its beads leave bare, how far they lie over
//! each other and beside the part, and how much clay that is. It reads the moves and the mesh and nothing else, so that
//! files of all slicers are measured alike.

mod cover;
mod path;

use crate::process::median;
use clayforge::{Notes, Profile, read_part, repaired};
use cover::{Areas, Bead, Side, areas};
use path::{Level, Path};
use shape::{Face, TriangleMesh};
use std::fs;

/// The figures of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Quality {
    /// Distinct heights at which clay is laid.
    pub layers: usize,
    /// How many times the clay starts.
    pub starts: usize,
    /// Moves without clay between two threads; one after the other counts once.
    pub travels: usize,
    /// Their length in mm.
    pub travel_length: f64,
    /// The length of all beads in mm.
    pub length: f64,
    /// The clay from the first bead to the last, in mm³.
    pub clay: f64,
    /// What the mesh holds, in mm³.
    pub room: f64,
    /// What the beads cover; nothing for a spiral, whose layers have no section of the part that is theirs.
    pub cover: Option<Areas>,
}

/// How a file is to be read.
pub struct Measure {
    /// What a unit of E is, in mm³.
    pub area: f64,
    /// How many of the layers are looked at for what they cover, evenly spread.
    pub layers: usize,
}

/// `quality PART.stl FILE.gcode [--area A] [--layers N]` prints the figures of a file.
pub fn run(args: &[String]) -> Result<(), String> {
    let [part, file, options @ ..] = args else {
        return Err("`quality` measures a file against its part: `quality PART.stl FILE.gcode`".to_owned());
    };
    let mut measure = Measure { area: 1.0, layers: 40 };
    for option in options.chunks(2) {
        let [name, value] = option else { return Err(format!("`{}` needs a value", option[0])) };
        let wrong = || format!("`{value}` is no value of `{name}`");
        match name.as_str() {
            "--area" => measure.area = value.parse().map_err(|_| wrong())?,
            "--layers" => measure.layers = value.parse().map_err(|_| wrong())?,
            _ => return Err(format!("`{name}` is not known; there are `--area` and `--layers`")),
        }
    }
    let read = |path: &String| fs::read(path).map_err(|error| format!("{path}: {error}"));
    let quality =
        measure.of(&mesh(&read(part)?)?, &read(file)?).map_err(|error| format!("{file}: {error}"))?;
    for (name, figure) in quality.figures() {
        println!("{name:18} {figure:>10}");
    }
    Ok(())
}

/// The mesh of a file, repaired.
pub fn mesh(bytes: &[u8]) -> Result<TriangleMesh, String> {
    let profile = Profile::default();
    let mesh = read_part(bytes, &profile, &mut Notes::default()).map_err(|error| error.to_string())?;
    Ok(if mesh.flaws.none() { mesh } else { repaired(&mesh, &profile).0 })
}

impl Measure {
    /// The figures of a file that was made from a part.
    pub fn of(&self, part: &TriangleMesh, gcode: &[u8]) -> Result<Quality, String> {
        let path = Path::read(gcode, self.area)?;
        let levels = path.levels();
        let cover = (!path.is_spiral()).then(|| self.cover(part, &levels, path.middle()));
        Ok(Quality {
            layers: levels.len(),
            starts: path.starts,
            travels: path.travels,
            travel_length: path.travel_length,
            length: path.length(),
            clay: path.clay,
            room: part.volume().abs(),
            cover: cover.filter(|areas| areas.section > 0.0),
        })
    }

    /// What the beads of some levels cover of the part.
    ///
    /// Every slicer lays a part where it likes. The middle of its box belongs in that of the box of all beads; or, where a
    /// tip of the part is too thin to be printed, the middles of most levels tell. It stands where less spills.
    fn cover(&self, part: &TriangleMesh, levels: &[Level], middle: [f64; 2]) -> Areas {
        let bounds = part.bounds();
        let floor = mm(bounds.min.z);
        let cuts: Vec<(usize, Vec<Side>)> = evenly(levels.len(), self.layers)
            .into_iter()
            .map(|index| (index, outline(part, floor + levels[index].z - levels[index].height / 2.0)))
            .filter(|(_, outline)| !outline.is_empty())
            .collect();
        let by_box = [
            middle[0] - f64::midpoint(mm(bounds.min.x), mm(bounds.max.x)),
            middle[1] - f64::midpoint(mm(bounds.min.y), mm(bounds.max.y)),
        ];
        let by_levels = [0, 1].map(|axis| {
            let of = |(index, outline): &(usize, Vec<Side>)| {
                let beads = levels[*index].beads.iter().flat_map(|bead| [bead.from[axis], bead.to[axis]]);
                center(beads) - center(outline.iter().flatten().map(|at| at[axis]))
            };
            median(cuts.iter().map(of).collect())
        });
        let at = |shift: [f64; 2]| {
            let mut sum = Areas::default();
            for (index, outline) in &cuts {
                let moved = |level: &Level| -> Vec<Bead> {
                    level.beads.iter().map(|bead| bead.back(shift)).collect()
                };
                let below = index.checked_sub(1).map(|below| moved(&levels[below]));
                sum.add(&areas(outline, &moved(&levels[*index]), below.as_deref()));
            }
            sum
        };
        let (one, other) = (at(by_box), at(by_levels));
        if other.spill < one.spill { other } else { one }
    }
}

fn mm(microns: i32) -> f64 {
    f64::from(microns) / 1000.0
}

/// The middle between the least and the greatest.
fn center(values: impl Iterator<Item = f64> + Clone) -> f64 {
    f64::midpoint(values.clone().fold(f64::MAX, f64::min), values.fold(f64::MIN, f64::max))
}

impl Quality {
    /// Every figure with its name.
    pub fn figures(&self) -> Vec<(&'static str, String)> {
        let Self { layers, starts, travels, travel_length, length, clay, room, cover } = self;
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        let percent = |part: f64, whole: f64| format!("{:.1} %", 100.0 * share(part, whole));
        let mut figures = vec![
            ("layers", layers.to_string()),
            ("starts", starts.to_string()),
            ("travels per layer", format!("{:.2}", share(*travels as f64, *layers as f64))),
            ("travel of the way", percent(*travel_length, travel_length + length)),
            ("clay of the part", percent(*clay, *room)),
        ];
        if let Some(cover) = cover {
            figures.extend([
                ("bare", percent(cover.bare, cover.section)),
                ("bare walls", percent(cover.bare_walls, cover.walls)),
                ("spill", percent(cover.spill, cover.section)),
                ("overlap", percent(cover.overlap, cover.beads)),
                ("unsupported", percent(cover.unsupported, cover.raised)),
            ]);
        }
        figures
    }
}

/// Where a plane cuts a part: sides with the clay on their left, in no order, in mm.
fn outline(part: &TriangleMesh, plane: f64) -> Vec<Side> {
    let cut = |face: &Face| {
        let corners =
            part.corners(face).map(|at| [at.x, at.y, at.z].map(|microns| f64::from(microns) / 1000.0));
        let (mut down, mut up) = (None, None);
        for (index, from) in corners.iter().enumerate() {
            let to = corners[(index + 1) % 3];
            let place = || {
                let share = (plane - from[2]) / (to[2] - from[2]);
                [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share)
            };
            match (from[2] < plane, to[2] < plane) {
                (false, true) => down = Some(place()),
                (true, false) => up = Some(place()),
                _ => {}
            }
        }
        Some([down?, up?])
    };
    part.faces.iter().filter_map(cut).collect()
}

/// So many numbers below `count`, from the first to the last.
fn evenly(count: usize, wanted: usize) -> Vec<usize> {
    let wanted = wanted.min(count);
    let (last, gaps) = (count.saturating_sub(1), wanted.saturating_sub(1).max(1));
    (0..wanted).map(|index| index * last / gaps).collect()
}

#[cfg(test)]
mod tests;
