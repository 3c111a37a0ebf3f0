#![doc = include_str!("../README.md")]

use shape::{Point3, TriangleMesh};
use skein::{Error, Micron, Notes, Ratio, Settings};

#[cfg(test)]
mod tests;

/// Makes the part larger by what drying and firing take from it.
#[derive(Clone, Debug, Settings)]
pub struct Scale {
    /// How much shorter a line of the wet clay is when it is dry, as a share. Draw a line of 100 mm on a slab, dry it, and
    /// measure.
    #[setting(default = 0.06, min = 0.0, max = 0.4)]
    pub drying_shrinkage: Ratio,
    /// How much shorter a line of the dry clay is when it is fired, as a share.
    #[setting(default = 0.05, min = 0.0, max = 0.4)]
    pub firing_shrinkage: Ratio,
    /// How much more of its height the part loses, as a share: layers settle on each other.
    #[setting(default = 0.0, min = 0.0, max = 0.2)]
    pub settling: Ratio,
    /// A factor for length and depth besides.
    #[setting(default = 1.0, min = 0.01, max = 100.0)]
    pub xy_plane_scale: Ratio,
    /// A factor for the height besides.
    #[setting(default = 1.0, min = 0.01, max = 100.0)]
    pub z_axis_scale: Ratio,
}

impl Scale {
    /// The craft word.
    pub const NAME: &'static str = "scale";

    /// The factors in the plane and upwards.
    ///
    /// What loses the share s of its length must be 1/(1 − s) as long before (clay.md §5.8).
    pub fn factors(&self) -> (f64, f64) {
        let left = (1.0 - self.drying_shrinkage.f64()) * (1.0 - self.firing_shrinkage.f64());
        (self.xy_plane_scale.f64() / left, self.z_axis_scale.f64() / (left * (1.0 - self.settling.f64())))
    }

    /// Scales a part about its own middle and its foot.
    ///
    /// The part is scaled and not its layers, so that these keep their height and their beads their width.
    ///
    /// # Errors
    /// When it becomes larger than any machine.
    pub fn scale(&self, part: &mut TriangleMesh, notes: &mut Notes) -> Result<(), Error> {
        let (plane, up) = self.factors();
        let bounds = part.bounds();
        let middle = |low: i32, high: i32| (f64::from(low) + f64::from(high)) / 2.0;
        let center = (middle(bounds.min.x, bounds.max.x), middle(bounds.min.y, bounds.max.y));
        let moved = |at: i32, center: f64, factor: f64| {
            Micron::from_mm((center + (f64::from(at) - center) * factor) / 1000.0).map(|at| at.0)
        };
        for at in &mut part.vertices {
            let scaled = (
                moved(at.x, center.0, plane),
                moved(at.y, center.1, plane),
                moved(at.z, f64::from(bounds.min.z), up),
            );
            let (Some(x), Some(y), Some(z)) = scaled else {
                return Err(Error::new(format!("scaled by {plane:.4} the part is larger than any machine"))
                    .hint("look at the shrinkage and the unit of the part"));
            };
            *at = Point3 { x, y, z };
        }
        notes.say(format!(
            "the part is printed {plane:.4} times as wide and {up:.4} times as high as it will be fired"
        ));
        Ok(())
    }
}
