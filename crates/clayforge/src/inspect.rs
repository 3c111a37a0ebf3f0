//! A part looked at before it is sliced.

use crate::Profile;
use mesh::{Diagnosis, Repair, Repairs};
use shape::TriangleMesh;
use skein::Value;

/// What a part is, measured in the beads and layers of a profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// What the mesh is and what is wrong with it.
    pub diagnosis: Diagnosis,
    /// How wide a bead is, in microns.
    pub bead_width: f64,
}

impl Inspection {
    /// Examines a part. What lies in the lower half of the first layer touches the bed.
    pub fn of(part: &TriangleMesh, profile: &Profile) -> Self {
        let floor = length(profile, "carve.first_layer_height") / 2.0;
        Self {
            diagnosis: mesh::diagnose(part, floor as i32),
            bead_width: length(profile, "carve.bead_width"),
        }
    }

    /// The thinnest wall in beads, if there is a wall.
    pub fn thinnest_in_beads(&self) -> Option<f64> {
        self.diagnosis.thinnest_wall.map(|(thick, _)| thick / self.bead_width)
    }
}

/// The part as `slice` would repair it with this profile.
pub fn repaired(part: &TriangleMesh, profile: &Profile) -> (TriangleMesh, Repairs) {
    let [height, width, hole] =
        ["carve.layer_height", "carve.bead_width", "carve.close_gaps"].map(|key| length(profile, key) as i32);
    mesh::repair(part, Repair::for_layers(height, width, i64::from(hole)))
}

/// A length of the profile in microns.
fn length(profile: &Profile, key: &str) -> f64 {
    match profile.get(key) {
        Some((_, Value::Number(mm))) => (mm * 1000.0).round(),
        _ => 0.0,
    }
}
