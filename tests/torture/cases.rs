//! Parts that are spoiled as meshes: the classes topology, overlap, no solid, limits, planes and analytic.

use super::shapes::{
    cracked, flipped, gear, klein, moebius, moved, revolved, sheet, soup, sphere, t_junction, torus, turn,
    without,
};
use super::{Case, Expect, Layers, cube};
use crate::support::{Triangles, cuboid, polygon, prism, stl, tube};

fn are(at: impl Fn(f64) -> (f64, usize) + Send + Sync + 'static, share: f64) -> Layers {
    Layers::Are(Box::new(at), share)
}

/// The same area in one loop everywhere.
fn even(area: f64) -> Layers {
    are(move |_| (area, 1), 1e-4)
}

fn case(name: &'static str, part: &Triangles, expect: Expect) -> Case {
    Case { name, file: stl(part), settings: &[], expect }
}

fn right(name: &'static str, part: Triangles, layers: Layers) -> Case {
    case(name, &part, Expect::Right(layers))
}

fn warned(name: &'static str, part: Triangles, layers: Layers, word: &'static str) -> Case {
    case(name, &part, Expect::Warned(layers, word))
}

fn refused(name: &'static str, part: Triangles, word: &'static str) -> Case {
    case(name, &part, Expect::Refused(word))
}

fn with(mut case: Case, settings: &'static [&'static str]) -> Case {
    case.settings = settings;
    case
}

fn both(one: Triangles, other: Triangles) -> Triangles {
    [one, other].concat()
}

pub fn cases() -> Vec<Case> {
    let mut cases = topology();
    cases.extend((0..12).map(|facet| {
        let flat = cube()[facet].iter().all(|corner| corner[2] == cube()[facet][0][2]);
        let name = if flat { "a level facet missing" } else { "a facet of the side missing" };
        warned(name, without(&cube(), facet), even(400.0), "1 hole in the mesh was closed")
    }));
    cases.extend(overlap());
    cases.extend(no_solid());
    cases.extend(limits());
    cases.extend(planes());
    cases.extend(analytic());
    cases
}

/// The box with one facet turned over.
fn one_flipped() -> Triangles {
    let mut part = cube();
    part[3].swap(0, 1);
    part
}

fn topology() -> Vec<Case> {
    let side =
        |part: Triangles| part.into_iter().filter(|face| !face.iter().all(|at| at[0] == 20.0)).collect();
    let top =
        |part: Triangles| part.into_iter().filter(|face| !face.iter().all(|at| at[2] == 12.0)).collect();
    // A sliver on the edge between two sides, whose long side both know and whose short ones nobody.
    let sliver = both(cube(), vec![[[20.0, 0.0, 0.0], [20.0, 0.0, 6.0], [20.0, 0.0, 12.0]]]);
    let collapsed = both(cube(), vec![[[20.0, 0.0, 0.0], [20.0, 0.0, 0.0], [20.0, 0.0, 12.0]]]);
    let doubled = both(cube(), vec![cube()[2]]);
    let half: Triangles = cube()
        .into_iter()
        .enumerate()
        .map(|(index, [a, b, c])| if index % 2 == 0 { [a, b, c] } else { [a, c, b] })
        .collect();
    let crumbs: Triangles = cube()
        .into_iter()
        .flat_map(|face| {
            // Every facet a little smaller about its middle: nothing fits any more.
            let middle: [f64; 3] =
                std::array::from_fn(|axis| face.iter().map(|corner| corner[axis]).sum::<f64>() / 3.0);
            [face.map(|corner| {
                std::array::from_fn(|axis| middle[axis] + (corner[axis] - middle[axis]) * 0.999)
            })]
        })
        .collect();
    vec![
        warned("a sliver beside an edge", sliver, even(400.0), "without area"),
        warned("a facet without area", collapsed, even(400.0), "have no area"),
        warned("a doubled facet", doubled, even(400.0), "duplicate"),
        warned("a flipped facet", one_flipped(), even(400.0), "1 flipped face"),
        warned("half of the facets flipped", half, even(400.0), "flipped"),
        right("inside out", flipped(&cube()), even(400.0)),
        right(
            "a cavity, all inside out",
            flipped(&both(cube(), flipped(&cuboid([5.0, 5.0, 3.0], [15.0, 15.0, 9.0])))),
            are(|z| if (3.0..9.0).contains(&z) { (300.0, 2) } else { (400.0, 1) }, 1e-4),
        ),
        warned("both sides of every facet", both(cube(), flipped(&cube())), even(400.0), "duplicate"),
        warned("open at the top", top(cube()), even(400.0), "surface = \"wall\""),
        warned("open at a side", side(cube()), even(400.0), "hole"),
        warned("a T-junction", t_junction(), even(400.0), "T-junction"),
        warned("a crack of 0.0011 mm", cracked(0.0011), even(400.0), "crack"),
        warned("a crack of 0.05 mm", cracked(0.04), are(|_| (400.0, 1), 3e-3), "crack"),
        warned("every facet by itself", crumbs, are(|_| (400.0, 1), 5e-3), "crack"),
    ]
}

fn overlap() -> Vec<Case> {
    let inner = || cuboid([5.0, 5.0, 3.0], [15.0, 15.0, 9.0]);
    let second = || moved(&cube(), [10.0, 5.0, 0.0]);
    let united = || even(800.0 - 150.0);
    let hollow = |z: f64| if (3.0..9.0).contains(&z) { (300.0, 2) } else { (400.0, 1) };
    // Two rooms with one wall between them: its sides meet three facets.
    let rooms = {
        let mut part = both(cube(), moved(&cube(), [20.0, 0.0, 0.0]));
        let mut seen = 0;
        part.retain(|face| {
            let wall = face.iter().all(|at| at[0] == 20.0);
            seen += usize::from(wall);
            !wall || seen <= 2
        });
        part
    };
    let bow: Triangles = sheet(4, 1, |column, row| {
        let [x, y] = [[0.0, 0.0], [20.0, 20.0], [20.0, 0.0], [0.0, 20.0]][column];
        [x, y, 12.0 * row as f64]
    });
    vec![
        warned("two through each other", both(cube(), second()), united(), "overlap"),
        warned(
            "two through each other, one inside out",
            both(cube(), flipped(&second())),
            united(),
            "inside out",
        ),
        right("one inside the other", both(cube(), inner()), even(400.0)),
        right("a cavity", both(cube(), flipped(&inner())), are(hollow, 1e-4)),
        warned("two rooms with a wall between", rooms, even(800.0), ""),
        warned(
            "side by side in contact",
            both(cube(), moved(&cube(), [20.0, 0.0, 0.0])),
            are(|_| (800.0, 1), 1e-4),
            "touch",
        ),
        warned("twice the same", both(cube(), cube()), even(400.0), "duplicate"),
        warned(
            "edge to edge",
            both(cube(), moved(&cube(), [20.0, 20.0, 0.0])),
            are(|_| (800.0, 2), 1e-4),
            "touch",
        ),
        right("corner on corner", both(cube(), moved(&cube(), [20.0, 20.0, 12.0])), even(400.0)),
        warned("a bow tie", bow, are(|_| (200.0, 2), 1e-3), ""),
        right(
            "a part in a part in a part",
            (0..3)
                .flat_map(|depth| {
                    let inset = 4.0 * f64::from(depth);
                    let shell = cuboid([inset, inset, 0.0], [24.0 - inset, 24.0 - inset, 12.0]);
                    if depth == 1 { flipped(&shell) } else { shell }
                })
                .collect(),
            are(|_| (24.0 * 24.0 - 16.0 * 16.0 + 8.0 * 8.0, 3), 1e-4),
        ),
    ]
}

fn no_solid() -> Vec<Case> {
    let skin = |steps: usize, share: f64, height: f64| -> Triangles {
        let mut part = Triangles::new();
        for step in 0..steps {
            let ([x, y], [u, v]) =
                (turn(share * step as f64 / steps as f64), turn(share * (step + 1) as f64 / steps as f64));
            let [a, b] = [[20.0 * x, 20.0 * y, 0.0], [20.0 * u, 20.0 * v, 0.0]];
            let [c, d] = [[20.0 * u, 20.0 * v, height], [20.0 * x, 20.0 * y, height]];
            part.extend([[a, b, c], [a, c, d]]);
        }
        part
    };
    // What a wall of one bead along a circle takes.
    let ring = std::f64::consts::TAU * 20.0 * 2.0;
    vec![
        warned("Moebius strip", moebius(), Layers::Any, "one side only"),
        warned("Klein bottle", klein(), Layers::Any, "turned over"),
        refused("soup", soup(300), "surface = \"wall\""),
        refused(
            "one triangle",
            vec![[[0.0, 0.0, 0.0], [20.0, 0.0, 0.0], [10.0, 0.0, 15.0]]],
            "surface = \"wall\"",
        ),
        refused("flat", vec![[[0.0; 3], [20.0, 0.0, 0.0], [0.0, 20.0, 0.0]]], "too flat"),
        warned("a tube of one skin", skin(72, 1.0, 12.0), Layers::Any, "surface = \"wall\""),
        with(
            right("a tube of one skin as a wall", skin(72, 1.0, 12.0), are(move |_| (ring, 2), 5e-3)),
            &["carve.surface=wall"],
        ),
        with(
            right("a gutter as a wall", skin(36, 0.5, 12.0), are(move |_| (ring / 2.0 + 3.0, 1), 3e-2)),
            &["carve.surface=wall"],
        ),
        with(
            right("a wall of three beads", skin(72, 1.0, 12.0), are(move |_| (3.0 * ring, 2), 5e-3)),
            &["carve.surface=wall", "carve.wall_beads=3"],
        ),
    ]
}

fn limits() -> Vec<Case> {
    let scaled = |size: f64| cuboid([0.0; 3], [size; 3]);
    let cone = || revolved(&[[0.0, 0.0], [15.0, 20.0], [0.0, 20.0]], 96);
    let fin = both(cube(), cuboid([9.0, 9.9995, 12.0], [19.0, 10.0005, 20.0]));
    vec![
        warned("walls thinner than a bead", tube(20.0, 19.2, 12.0), Layers::Any, "thin"),
        warned("a razor fin on a box", fin, Layers::Any, "thin"),
        refused("a cube of 0.01 mm", scaled(0.01), "too flat"),
        refused("a cube of 0.4 mm", scaled(0.4), "too flat"),
        refused("5 m", scaled(5000.0), "room for"),
        refused("1 km", scaled(999_999.0), "room for"),
        right("0.2 mm over the bed", moved(&cube(), [0.0, 0.0, 0.2]), even(400.0)),
        right("below the bed", moved(&cube(), [0.0, 0.0, -50.0]), even(400.0)),
        right("in the air", moved(&cube(), [0.0, 0.0, 50.0]), even(400.0)),
        with(
            refused("in the air where it is", moved(&cube(), [10.0, 10.0, 50.0]), "hangs 50"),
            &["carve.place=file"],
        ),
        with(
            warned(
                "half below the bed where it is",
                moved(&cube(), [10.0, 10.0, -6.0]),
                even(400.0),
                "cut off",
            ),
            &["carve.place=file"],
        ),
        with(
            right("lying, stood up", cuboid([0.0; 3], [12.0, 20.0, 20.0]), even(400.0)),
            &["carve.rotate=[0, 90, 0]"],
        ),
        // Its clay would fall ten millimetres: the check of the finished file refuses it.
        refused(
            "a part in the air beside one",
            both(cube(), moved(&cube(), [0.0, 0.0, 20.0])),
            "float in the air",
        ),
        right(
            "a cone on its tip",
            cone(),
            are(
                |z| {
                    let radius = 15.0 * z / 20.0;
                    (radius * radius * 96.0 * turn(1.0 / 192.0)[0] * turn(1.0 / 192.0)[1], 1)
                },
                3e-2,
            ),
        ),
        right("as large as the bed", cuboid([0.0; 3], [400.0, 400.0, 3.0]), even(160_000.0)),
    ]
}

fn planes() -> Vec<Case> {
    // Rows of vertices at every height where a layer is cut, and at its borders.
    let rows = |step: f64, count: usize| {
        sheet(4, count, |column, row| {
            let [x, y] = [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]][column];
            [x, y, step * row as f64]
        })
    };
    let lid = |height: f64| {
        let [a, b, c, d] = [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]].map(|[x, y]| [x, y, height]);
        vec![[a, b, c], [a, c, d]]
    };
    let closed =
        |step: f64, count: usize| both(rows(step, count), both(flipped(&lid(0.0)), lid(step * count as f64)));
    let steps = |height: f64| both(cube(), cuboid([0.0, 0.0, 0.0], [10.0, 10.0, height]));
    vec![
        right("a row of vertices on every plane", closed(0.5, 24), even(400.0)),
        right("a row of vertices just beside", closed(0.4999, 24), even(400.0)),
        right("a level face on a plane", cuboid([0.0; 3], [20.0, 20.0, 8.5]), even(400.0)),
        right("slivers of 0.0005 mm", cuboid([0.0; 3], [20.0, 20.0, 11.9995]), even(400.0)),
        warned(
            "a step on a plane",
            steps(15.5),
            are(|z| if z < 12.0 { (400.0, 1) } else { (100.0, 1) }, 1e-4),
            "overlap",
        ),
    ]
}

fn analytic() -> Vec<Case> {
    /// The area of a regular polygon in a circle, as a share of its radius squared.
    fn share(corners: f64) -> f64 {
        corners * turn(0.5 / corners)[0] * turn(0.5 / corners)[1]
    }
    let towers: Triangles = (0..100)
        .flat_map(|index| {
            moved(
                &cuboid([0.0; 3], [4.0, 4.0, 8.0]),
                [f64::from(index % 10) * 8.0, f64::from(index / 10) * 8.0, 0.0],
            )
        })
        .collect();
    vec![
        right("a cube", cube(), even(400.0)),
        right("a cylinder", prism(&polygon(96, 20.0), 0.0, 12.0), are(|_| (400.0 * share(96.0), 1), 5e-4)),
        right(
            "a sphere",
            sphere(15.0, 96),
            are(
                |z| {
                    let square = 15.0 * 15.0 - (z - 15.0) * (z - 15.0);
                    (square * share(192.0), 1)
                },
                4e-3,
            ),
        ),
        right(
            "a ring of round section",
            torus(30.0, 8.0, 192),
            are(
                |z| {
                    let wide = (64.0f64 - (z - 8.0) * (z - 8.0)).sqrt();
                    (4.0 * 30.0 * wide * share(192.0), 2)
                },
                4e-3,
            ),
        ),
        right("a gear", gear(24, 20.0, 25.0, 12.0), even(24.0 * 20.0 * 25.0 * turn(1.0 / 48.0)[1])),
        right("a tube", tube(20.0, 12.0, 12.0), are(|_| ((400.0 - 144.0) * share(48.0), 2), 1e-3)),
        right("100 towers", towers, are(|_| (1600.0, 100), 1e-4)),
        right(
            "a large sphere",
            sphere(40.0, 256),
            are(
                |z| {
                    let square = 1600.0 - (z - 40.0) * (z - 40.0);
                    (square * share(512.0), 1)
                },
                4e-3,
            ),
        ),
    ]
}
