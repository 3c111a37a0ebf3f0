//! What the finished file is called when nobody says.

use crate::Profile;
use export::{Export, Naming};
use skein::{Settings, Value};

impl Profile {
    /// The name of the file for a part, as the settings of export want it. `time` is the day and the time.
    pub fn file_name(&self, part: &str, time: &str) -> String {
        let mut export = Export::default();
        for (key, value) in
            self.station("export").map(|station| station.work.keys().values()).unwrap_or_default()
        {
            // They are the settings of the same stage, so each of them fits.
            let _ = export.set(key, &value);
        }
        let word = |letter: &str, key: &str| match self.get(key) {
            Some((_, Value::Number(number))) => Some(format!("{letter}{number}")),
            _ => None,
        };
        let description = [
            word("h", "carve.layer_height"),
            word("w", "carve.bead_width"),
            word("n", "fill.walls"),
            word("d", "fill.density"),
        ];
        let description = description.into_iter().flatten().collect();
        export.file_name(&Naming { part, profile: &self.name, description, time })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_settings_of_export_name_the_file() {
        let mut profile = Profile::default();
        assert_eq!(profile.file_name("cup", "now"), "cup.gcode");
        for key in ["name_has_description", "name_has_time"] {
            profile.set(&format!("export.{key}"), "true").expect("a switch");
        }
        assert_eq!(profile.file_name("cup", "now"), "cup_h1.5_w3.2_n2_d0.2_now.gcode");
    }
}
