//! Table T1 of the acceptance rows (L15): what lies on the test meshes behind fill, with the settings of the original.
//!
//! Layers, walls and the length of the outermost are those of the original. Inner walls lie farther apart than there, since
//! our beads are as far apart as they are wide, so their number counts and not their length; the narrowing cone has room for
//! two more. Infill threads are no more than there, and travels at most a tenth longer.

use crate::support::{clay, meshes, sliced, stl, tube};
use skein::{Feature, Line, Nozzle, Side, Skein};

/// The settings of the original (SF50).
const ORIGINAL: &[(&str, &str)] = &[
    ("machine.nozzle", "0.5"),
    ("carve.layer_height", "0.4"),
    ("carve.first_layer_height", "0.4"),
    ("carve.bead_width", "0.72"),
    ("fill.walls", "1"),
    ("fill.extra_shells_base", "1"),
    ("fill.extra_shells_alternating_solid_layer", "2"),
    ("fill.extra_shells_sparse_layer", "1"),
    ("fill.base_layers", "3"),
    ("fill.top_layers", "3"),
    ("fill.surrounding_angle", "60"),
    ("fill.density", "0.2"),
    ("fill.overlap", "0.15"),
    ("fill.start", "\"lower-left\""),
];

/// What is counted: threads and their length in mm.
#[derive(Default)]
struct Totals {
    layers: usize,
    edges: usize,
    edges_mm: f64,
    loops: usize,
    infill: usize,
    travel_mm: f64,
}

impl Totals {
    fn of(skein: &Skein) -> Self {
        let mut totals = Self { layers: skein.layers.len(), ..Self::default() };
        let mut nozzle = Nozzle::default();
        for line in skein.lines() {
            if let (Some(step), Some(from)) = (line.as_move(), nozzle.at) {
                let length = step.length(from) / 1000.0;
                match (nozzle.on, nozzle.feature()) {
                    (false, _) => totals.travel_mm += length,
                    (true, Feature::Edge(_)) => totals.edges_mm += length,
                    _ => {}
                }
            }
            if *line == Line::On {
                match nozzle.feature() {
                    Feature::Edge(_) => totals.edges += 1,
                    Feature::Loop(_) => totals.loops += 1,
                    Feature::Infill => totals.infill += 1,
                    _ => {}
                }
            }
            nozzle.follow(line);
        }
        totals
    }
}

#[test]
fn l15_t1_totals_behind_fill() {
    let profile = clay(ORIGINAL);
    // Layers, perimeters and their length, inner walls; at most so many infill threads and millimetres of travel.
    let table = [
        ("cube", 25, 25, 1928.0, 28, 27, 794.0),
        ("two", 25, 50, 1856.0, 56, 74, 1913.0),
        ("cyl", 30, 30, 2757.0, 33, 132, 1649.0),
        ("ring", 25, 50, 3610.0, 56, 111, 2015.0),
        ("bridge", 15, 25, 928.0, 28, 30, 709.0),
        ("mushroom", 25, 25, 1488.0, 28, 36, 793.0),
        ("cone", 37, 36, 1681.0, 36, 93, 1069.0),
    ];
    let meshes = meshes();
    let mut failures = Vec::new();
    for (name, layers, edges, edges_mm, loops, infill, travel_mm) in table {
        let Some((_, mesh)) = meshes.iter().find(|(mesh, _)| *mesh == name) else {
            panic!("there is no mesh {name}")
        };
        let run = sliced(name, &stl(mesh), &profile);
        let found =
            Totals::of(&Skein::read(run.behind("fill")).unwrap_or_else(|error| panic!("{name}: {error}")));
        let same = (found.layers, found.edges, found.loops) == (layers, edges, loops)
            && (found.edges_mm / edges_mm - 1.0).abs() < 0.01
            && found.infill <= infill
            && found.travel_mm <= 1.1 * travel_mm;
        if !same {
            failures.push(format!(
                "{name}: {} {} ({:.0}) {} {} {:.0}",
                found.layers, found.edges, found.edges_mm, found.loops, found.infill, found.travel_mm
            ));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// W2: a wall of a tube too thin for two beads has room for both once the outside is widened.
#[test]
fn w2_two_walls_fit_a_widened_tube() {
    let mut keys = ORIGINAL.to_vec();
    keys.push(("widen.active", "true"));
    let run = sliced("thin", &stl(&tube(15.0, 14.2, 10.0)), &clay(&keys));
    let skein = Skein::read(run.behind("inset")).unwrap_or_else(|error| panic!("{error}"));
    let mut radii: Vec<(Feature, f64)> = Vec::new();
    let mut nozzle = Nozzle::default();
    for line in &skein.layers[12].lines {
        nozzle.follow(line);
        if let (true, Some(at)) = (nozzle.on, nozzle.at) {
            // The part stands on the middle of the bed.
            let (x, y) = (f64::from(at.x) / 1000.0 - 100.0, f64::from(at.y) / 1000.0 - 100.0);
            radii.push((nozzle.feature(), (x * x + y * y).sqrt()));
        }
    }
    for (side, radius) in [(Side::Inner, 14.56), (Side::Outer, 15.28)] {
        let wall: Vec<f64> = radii
            .iter()
            .filter(|(feature, _)| *feature == Feature::Edge(side))
            .map(|(_, radius)| *radius)
            .collect();
        assert!(wall.len() > 40, "{side:?}");
        // The corners of a 48-gon stand out by 0.2 %.
        assert!(
            wall.iter().all(|found| (found - radius).abs() < 0.02 + 0.0022 * radius),
            "{side:?} {wall:?}"
        );
    }
}
