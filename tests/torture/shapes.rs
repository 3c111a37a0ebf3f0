//! Parts from formulas, sound and spoiled.

use crate::support::{Triangles, polygon};
use unit::Angle;

/// Cosine and sine of a share of a full turn: the same bits on every platform.
pub fn turn(share: f64) -> [f64; 2] {
    let direction = Angle::from_degrees(360.0 * share).expect("an angle").direction();
    [direction.x, direction.y].map(|part| f64::from(part) / 1e6)
}

/// A surface over a grid of `columns` by `rows` cells that closes around in its columns.
pub fn sheet(columns: usize, rows: usize, at: impl Fn(usize, usize) -> [f64; 3]) -> Triangles {
    let mut triangles = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let next = (column + 1) % columns;
            let [a, b, c, d] = [at(column, row), at(next, row), at(next, row + 1), at(column, row + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
    triangles
}

/// Turns a profile of radius and height around the z axis; it starts and ends on the axis.
pub fn revolved(profile: &[[f64; 2]], around: usize) -> Triangles {
    let circle = polygon(around, 1.0);
    sheet(around, profile.len() - 1, |column, row| {
        let [radius, z] = profile[row];
        [circle[column][0] * radius, circle[column][1] * radius, z]
    })
}

/// A sphere that stands on the bed.
pub fn sphere(radius: f64, steps: usize) -> Triangles {
    let profile: Vec<[f64; 2]> = (0..=steps)
        .map(|step| {
            let [cosine, sine] = turn(0.5 * step as f64 / steps as f64);
            let side = if step == 0 || step == steps { 0.0 } else { radius * sine };
            [side, radius - radius * cosine]
        })
        .collect();
    revolved(&profile, steps * 2)
}

/// A ring of round section that lies on the bed.
pub fn torus(radius: f64, tube: f64, steps: usize) -> Triangles {
    let around = polygon(steps, 1.0);
    let mut triangles = sheet(steps, steps, |column, row| {
        let [out, up] = turn((row % steps) as f64 / steps as f64);
        let far = radius + tube * out;
        [around[column][0] * far, around[column][1] * far, tube + tube * up]
    });
    triangles.retain(|[a, b, c]| a != b && b != c);
    triangles
}

/// A gear: an upright prism over a star of `teeth`, between two radii.
pub fn gear(teeth: usize, inner: f64, outer: f64, height: f64) -> Triangles {
    let corner = |index: usize| {
        let [x, y] = turn(index as f64 / (2 * teeth) as f64);
        let radius = if index.is_multiple_of(2) { outer } else { inner };
        [x * radius, y * radius]
    };
    let count = 2 * teeth;
    let mut triangles = sheet(count, 1, |column, row| {
        let [x, y] = corner(column);
        [x, y, if row == 0 { 0.0 } else { height }]
    });
    for index in 0..count {
        let ([x, y], [u, v]) = (corner(index), corner((index + 1) % count));
        triangles.push([[0.0, 0.0, height], [x, y, height], [u, v, height]]);
        triangles.push([[0.0, 0.0, 0.0], [u, v, 0.0], [x, y, 0.0]]);
    }
    triangles
}

/// Inside out.
pub fn flipped(part: &Triangles) -> Triangles {
    part.iter().map(|[a, b, c]| [*a, *c, *b]).collect()
}

/// Elsewhere.
pub fn moved(part: &Triangles, by: [f64; 3]) -> Triangles {
    part.iter().map(|face| face.map(|[x, y, z]| [x + by[0], y + by[1], z + by[2]])).collect()
}

/// Without one facet.
pub fn without(part: &Triangles, facet: usize) -> Triangles {
    let mut part = part.clone();
    part.remove(facet);
    part
}

/// A box of 20 × 20 × 12 whose right side is split at the middle of its height while the others are not.
pub fn t_junction() -> Triangles {
    let mut part = super::cube();
    let right = |face: &[[f64; 3]; 3]| face.iter().all(|corner| corner[0] == 20.0);
    part.retain(|face| !right(face));
    for (low, high) in [(0.0, 6.0), (6.0, 12.0)] {
        let [a, b, c, d] = [[20.0, 0.0, low], [20.0, 20.0, low], [20.0, 20.0, high], [20.0, 0.0, high]];
        part.extend([[a, b, c], [a, c, d]]);
    }
    part
}

/// A box whose front side is a little off its edges: a crack all round.
pub fn cracked(width: f64) -> Triangles {
    let front = |face: &[[f64; 3]; 3]| face.iter().all(|corner| corner[1] == 0.0);
    let shift = |face: &[[f64; 3]; 3]| {
        if front(face) { face.map(|[x, y, z]| [x + width * 0.6, y, z + width * 0.7]) } else { *face }
    };
    super::cube().iter().map(shift).collect()
}

/// A band with half a twist.
pub fn moebius() -> Triangles {
    const STEPS: usize = 48;
    let at = |step: usize, side: f64| {
        let ([x, y], [half, lift]) =
            (turn(step as f64 / STEPS as f64), turn(0.5 * step as f64 / STEPS as f64));
        let radius = 30.0 + 8.0 * side * half;
        [x * radius, y * radius, 10.0 + 8.0 * side * lift]
    };
    let mut triangles = Vec::new();
    for step in 0..STEPS {
        // The last step comes back on the other side.
        let (to, sign) = if step + 1 == STEPS { (0, -1.0) } else { (step + 1, 1.0) };
        let [a, b, c, d] = [at(step, -1.0), at(to, -sign), at(to, sign), at(step, 1.0)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    triangles
}

/// A bottle without an inside.
pub fn klein() -> Triangles {
    const STEPS: usize = 32;
    let at = |column: usize, row: usize| {
        // The figure-eight immersion.
        let ([x, y], [half, lift]) =
            (turn(column as f64 / STEPS as f64), turn(0.5 * column as f64 / STEPS as f64));
        let ([_, one], [_, two]) = (turn(row as f64 / STEPS as f64), turn(2.0 * row as f64 / STEPS as f64));
        let radius = 25.0 + 10.0 * (half * one - lift * two);
        [x * radius, y * radius, 12.0 + 10.0 * (lift * one + half * two)]
    };
    let mut triangles = Vec::new();
    for column in 0..STEPS {
        for row in 0..STEPS {
            let next = |row: usize| match column + 1 {
                // Around once, the row runs the other way.
                STEPS => at(0, (STEPS - row) % STEPS),
                column => at(column, row),
            };
            let up = (row + 1) % STEPS;
            let [a, b, c, d] = [at(column, row), next(row), next(up), at(column, up)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    triangles
}

/// Triangles anywhere.
pub fn soup(count: usize) -> Triangles {
    let mut state = 7u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from((state >> 40) as u32) / f64::from(1u32 << 24) * 60.0
    };
    (0..count).map(|_| std::array::from_fn(|_| std::array::from_fn(|_| next()))).collect()
}
