//! Parts and prints of any fineness for the benchmarks in `benches/`: the same bytes on every machine.

use std::f64::consts::TAU;
use std::fmt::Write;

/// The bytes of a binary STL: a solid vase of five lobes, twisted, with a waist, 100 mm high, of about so many
/// triangles.
pub fn vase(triangles: usize) -> Vec<u8> {
    // Two triangles for each step around and each step up; a circle is about twice as long as the vase is high.
    let around = (libm::sqrt(triangles as f64) as usize).max(6);
    let rings = (triangles / (2 * around)).max(2);
    let ring = |up: f64| -> Vec<[f32; 3]> {
        let radius = 26.5 + 5.0 * libm::sin(TAU * (up * 0.95 + 0.02)) + 2.0 * up;
        let corner = |step: usize| {
            let angle = TAU * step as f64 / around as f64;
            let lobed = radius * (1.0 + 0.09 * libm::cos(5.0 * angle));
            let twisted = angle + up * TAU / 6.0;
            [lobed * libm::cos(twisted), lobed * libm::sin(twisted), 100.0 * up].map(|value| value as f32)
        };
        (0..around).map(corner).collect()
    };
    let mut facets: Vec<[[f32; 3]; 3]> = Vec::with_capacity(2 * around * rings);
    let mut below = vec![[0.0; 3]; around];
    for index in 0..=rings {
        let above = match index {
            _ if index == rings => vec![[0.0, 0.0, 100.0]; around],
            _ => ring(index as f64 / (rings - 1) as f64),
        };
        for step in 0..around {
            let next = (step + 1) % around;
            let [a, b, c, d] = [below[step], below[next], above[next], above[step]];
            // The two ends are fans: one triangle of each pair has no area there.
            facets.extend((index > 0).then_some([a, b, c]));
            facets.extend((index < rings).then_some([a, c, d]));
        }
        below = above;
    }
    let mut bytes = vec![b' '; 80];
    bytes.extend_from_slice(&(facets.len() as u32).to_le_bytes());
    for facet in facets {
        // Nobody believes the normals of a file.
        bytes.extend_from_slice(&[0; 12]);
        bytes.extend(facet.iter().flatten().flat_map(|value| value.to_le_bytes()));
        bytes.extend_from_slice(&[0; 2]);
    }
    bytes
}

/// The G-code of a lobed pot of so many lines, as layers with a break between them or as one spiral.
pub fn print(lines: usize, spiral: bool) -> Vec<u8> {
    /// Lines around the pot.
    const AROUND: usize = 2000;
    const HEIGHT: f64 = 0.5;
    let mut text = String::from("M83\nM302 P1\nG28\nG1 Z0.5 F1800\n");
    // Writing to a string cannot fail.
    for line in 0..lines {
        let angle = TAU * (line % AROUND) as f64 / AROUND as f64;
        let radius = 40.0 + 3.0 * libm::cos(7.0 * angle);
        let (x, y) = (100.0 + radius * libm::cos(angle), 100.0 + radius * libm::sin(angle));
        let _ = if spiral {
            let z = HEIGHT * (1.0 + line as f64 / AROUND as f64);
            writeln!(text, "G1 X{x:.3} Y{y:.3} Z{z:.4} E0.08")
        } else if line % AROUND == 0 {
            let z = HEIGHT * (1 + line / AROUND) as f64;
            writeln!(text, "G0 F6000 X{x:.3} Y{y:.3} Z{z:.3}\nG1 F1800")
        } else {
            writeln!(text, "G1 X{x:.3} Y{y:.3} E0.08000")
        };
    }
    text.into_bytes()
}
