//! The underside that lies most nearly level.

use shape::{Point3, TriangleMesh};

/// An underside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overhang {
    /// Degrees between the underside and the level: 0 is a ceiling, 90 an upright wall.
    pub angle: f64,
    /// Its middle, in microns.
    pub at: Point3,
    /// How much surface hangs over as far as this or within a degree of it, in mm².
    pub area: f64,
}

/// The lowest overhang over a height: the face that looks down most. Faces that stand on the bed, below `floor`, hang
/// over nothing. `None` when no face looks down.
pub(crate) fn lowest(mesh: &TriangleMesh, floor: i32) -> Option<Overhang> {
    let mut undersides: Vec<(f64, Point3, f64)> = Vec::new();
    let mut least = f64::INFINITY;
    for face in &mesh.faces {
        let corners = mesh.corners(face);
        let [x, y, z] = mesh.normal(face);
        if z >= 0.0 || corners.iter().all(|corner| corner.z <= floor) {
            continue;
        }
        let angle = libm::atan2((x * x + y * y).sqrt(), -z).to_degrees();
        if angle > least + 1.0 {
            continue;
        }
        least = least.min(angle);
        let middle = |of: fn(&Point3) -> i32| {
            (corners.iter().map(|corner| i64::from(of(corner))).sum::<i64>() / 3) as i32
        };
        let at = Point3 { x: middle(|p| p.x), y: middle(|p| p.y), z: middle(|p| p.z) };
        undersides.push((angle, at, (x * x + y * y + z * z).sqrt() / 2e6));
    }
    undersides.retain(|(angle, ..)| *angle <= least + 1.0);
    let area = undersides.iter().map(|(.., area)| area).sum();
    let first = undersides.iter().min_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)))?;
    Some(Overhang { angle: first.0, at: first.1, area })
}
