use super::*;
use crate::examples::{Mesh, encode, polar, revolve};
use std::fmt::Write;

/// A mesh as the file that it would be.
fn file(mesh: &Mesh) -> TriangleMesh {
    let mut bytes = Vec::new();
    encode(&mut bytes, "test", mesh).expect("memory takes everything");
    super::mesh(&bytes).expect("a part")
}

/// A file in the making: moves in mm, and clay for beads of a width and a height.
struct Pen {
    text: String,
    at: [f64; 2],
    section: f64,
}

impl Pen {
    fn new(head: &str, section: f64) -> Self {
        Self { text: format!("G21\nG90\n{head}\n"), at: [0.0; 2], section }
    }

    // Writing to a string cannot fail.
    fn go(&mut self, [x, y]: [f64; 2], z: f64) {
        let _ = writeln!(self.text, "G0 X{x:.4} Y{y:.4} Z{z:.4}");
        self.at = [x, y];
    }

    fn lay(&mut self, to: [f64; 2]) {
        let clay = self.section * libm::hypot(to[0] - self.at[0], to[1] - self.at[1]);
        let _ = writeln!(self.text, "G1 X{:.4} Y{:.4} E{clay:.6}", to[0], to[1]);
        self.at = to;
    }

    fn loop_of(&mut self, corners: &[[f64; 2]], z: f64) {
        self.go(corners[0], z);
        for corner in &corners[1..] {
            self.lay(*corner);
        }
        self.lay(corners[0]);
    }

    /// Full circles of two arcs around a place.
    fn circle(&mut self, [x, y]: [f64; 2], radius: f64, z: f64) {
        self.go([x + radius, y], z);
        let clay = self.section * std::f64::consts::PI * radius;
        for side in [-1.0, 1.0] {
            let _ = writeln!(
                self.text,
                "G3 X{:.4} Y{y:.4} I{:.4} J0 E{clay:.6}",
                x + side * radius,
                side * radius
            );
        }
    }
}

fn square(half: f64) -> [[f64; 2]; 4] {
    [[-half, -half], [half, -half], [half, half], [-half, half]]
}

/// A block of 40 × 40 × 6 mm: two walls, and strokes that are a tenth too far apart.
fn block() -> (Mesh, String) {
    let profile = [[0.0, 0.0], [20.0 * 2f64.sqrt(), 0.0], [20.0 * 2f64.sqrt(), 6.0], [0.0, 6.0]];
    let corner = std::f64::consts::FRAC_PI_4;
    let part = revolve(&profile, 4, |[radius, z], angle| polar(radius, angle + corner, z));
    let mut pen = Pen::new("M83", 3.0 * 1.5);
    for layer in 1..=4 {
        let z = 1.5 * f64::from(layer);
        pen.loop_of(&square(18.5), z);
        pen.loop_of(&square(15.5), z);
        for stroke in 0..9 {
            let y = -13.2 + 3.3 * f64::from(stroke);
            pen.go([-12.5, y], z);
            pen.lay([12.5, y]);
        }
    }
    (part, pen.text)
}

/// A tube that leans outwards: circles of arcs, the inner one too near to the outer.
fn funnel() -> (Mesh, String) {
    let profile = [[0.0, 0.0], [20.0, 0.0], [28.0, 16.0], [0.0, 16.0]];
    let part = revolve(&profile, 120, |[radius, z], angle| polar(radius, angle, z));
    let mut pen = Pen::new("M83", 3.0 * 2.0);
    for layer in 0..8 {
        let z = 2.0 + 2.0 * f64::from(layer);
        let radius = 20.5 + f64::from(layer);
        pen.circle([100.0, 80.0], radius - 1.5, z);
        pen.circle([100.0, 80.0], radius - 4.0, z);
    }
    (part, pen.text)
}

/// Two posts and what spills: one post is laid too wide and the other not at all above its middle.
fn posts() -> (Mesh, String) {
    let post = |at: f64| {
        let profile = [[0.0, 0.0], [10.0, 0.0], [10.0, 8.0], [0.0, 8.0]];
        revolve(&profile, 90, move |[radius, z], angle| {
            let [x, y, z] = polar(radius, angle, z);
            [x + at, y, z]
        })
    };
    let (mut vertices, mut triangles) = post(-15.0);
    let (more, others) = post(15.0);
    let first = vertices.len() as u32;
    vertices.extend(more);
    triangles.extend(others.into_iter().map(|triangle| triangle.map(|vertex| vertex + first)));
    let mut pen = Pen::new("M83", 2.0 * 2.0);
    for layer in 0..4 {
        let z = 2.0 + 2.0 * f64::from(layer);
        for radius in [9.5, 7.0, 5.0, 3.0] {
            pen.circle([-15.0, 0.0], radius, z);
            if layer < 2 {
                pen.circle([15.0, 0.0], radius, z);
            }
        }
    }
    ((vertices, triangles), pen.text)
}

/// What another program, which unites outlines of the beads instead of going along rows, found in the same files: starts,
/// travels, mm of bead, mm of travel, mm³ of clay, mm³ of mesh; and bare, spill and unsupported as shares.
#[rustfmt::skip]
const FOUND: [([usize; 2], [f64; 4], [f64; 4]); 3] = [
    ([44, 43], [1988.0, 972.0, 8946.0, 9600.0], [0.0547, 0.0, 0.0, 0.0]),
    ([16, 15], [2136.3, 44.5, 12817.7, 29207.7], [0.5981, 0.0004, 0.0909, 0.2006]),
    ([24, 23], [923.6, 499.5, 3694.5, 5022.5], [0.3419, 0.0775, 0.0, 0.0]),
];

#[test]
fn three_files_measure_as_another_program_measures_them() {
    for ((part, gcode), (counts, sums, shares)) in [block(), funnel(), posts()].iter().zip(FOUND) {
        let found = Measure { area: 1.0, layers: 40 }.of(&file(part), gcode.as_bytes()).expect("beads");
        assert_eq!([found.starts, found.travels], counts);
        // Its figures have one decimal, and its arcs are of chords of a degree.
        for (found, figure) in [found.length, found.travel_length, found.clay, found.room].iter().zip(sums) {
            assert!((found - figure).abs() < 0.06 + 1e-4 * figure, "{found} is not {figure}");
        }
        let cover = found.cover.expect("no spiral");
        let ours = [
            cover.bare / cover.section,
            cover.spill / cover.section,
            cover.overlap / cover.beads,
            cover.unsupported / cover.raised,
        ];
        for (found, share) in ours.iter().zip(shares) {
            assert!((found - share).abs() < 0.002, "{ours:?} are not {shares:?}");
        }
    }
}

/// A square of 10 mm with the clay on the left.
fn ten() -> Vec<Side> {
    let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
    (0..4).map(|side| [corners[side], corners[(side + 1) % 4]]).collect()
}

#[test]
fn one_bead_covers_its_length_and_two_half_circles() {
    let bead = Bead { from: [2.0, 5.0], to: [8.0, 5.0], width: 2.0 };
    let covered = 12.0 + std::f64::consts::PI;
    let found = areas(&ten(), &[bead], None);
    let near = |found: f64, exact: f64| assert!((found - exact).abs() < 0.05, "{found} is not {exact}");
    near(found.section, 100.0);
    near(found.beads, covered);
    near(found.bare, 100.0 - covered);
    // All but the middle square, of which the bead covers 2 × 2 mm.
    near(found.walls, 100.0 - 4.0);
    near(found.bare_walls, 100.0 - covered);
    near(found.spill, 0.0);
    assert_eq!((found.raised, found.unsupported), (0.0, 0.0));
    // Half of it beside the square, over a bead that lies across.
    let (half, below) = (Bead { from: [-4.0, 5.0], to: [4.0, 5.0], ..bead }, Bead { to: [2.0, 9.0], ..bead });
    let found = areas(&ten(), &[half], Some(&[below]));
    near(found.spill, (16.0 + std::f64::consts::PI) / 2.0);
    near(found.raised, 16.0 + std::f64::consts::PI);
    // Below lies a strip 2 mm wide that ends in a half circle, which is all within the bead above.
    near(found.unsupported, found.raised - (2.0 + std::f64::consts::FRAC_PI_2));
    near(areas(&ten(), &[bead, bead], None).overlap, 24.0 - covered);
}

/// A block with a fin on one side that no bead fits into: its box tells the wrong place, the levels above the fin the right
/// one.
#[test]
fn a_part_with_a_thin_fin_is_laid_where_its_beads_lie() {
    let ((mut vertices, mut triangles), gcode) = block();
    let first = vertices.len() as u32;
    vertices.extend([[20.0, -0.1, 0.0], [30.0, 0.0, 0.0], [20.0, 0.1, 0.0], [20.0, 0.0, 1.0]]);
    triangles
        .extend([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|face| face.map(|corner| corner + first)));
    let cover = |part: &Mesh| {
        let found = Measure { area: 1.0, layers: 40 }.of(&file(part), gcode.as_bytes()).expect("beads");
        found.cover.expect("no spiral")
    };
    let (with, without) = (cover(&(vertices, triangles)), cover(&block().0));
    assert!((with.spill - without.spill).abs() < 0.1, "{} {}", with.spill, without.spill);
    assert!((with.bare - without.bare).abs() < 5.0, "{} {}", with.bare, without.bare);
}

#[test]
fn levels_are_picked_from_the_first_to_the_last() {
    assert_eq!(evenly(10, 4), [0, 3, 6, 9]);
    assert_eq!(
        (evenly(2, 40), evenly(7, 1), evenly(0, 3), evenly(3, 0)),
        (vec![0, 1], vec![0], vec![], vec![])
    );
}

#[test]
fn a_spiral_and_a_file_without_beads_have_no_cover() {
    let (part, _) = funnel();
    let measure = Measure { area: 1.0, layers: 40 };
    let spiral = "M83\nG1 X0 Y0 Z1 F600\nG1 X20 Z1.5 E9\nG1 Y20 Z2 E9\nG1 X0 Z2.5 E9\nG1 Y0 Z3 E9\n";
    assert_eq!(measure.of(&file(&part), spiral.as_bytes()).expect("beads").cover, None);
    assert!(measure.of(&file(&part), b"G1 X10\n").is_err());
}
