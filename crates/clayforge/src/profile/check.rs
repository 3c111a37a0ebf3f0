//! What no setting can know alone.

use super::Profile;
use skein::{Error, Notes, Value};

impl Profile {
    /// Checks the settings against each other.
    ///
    /// # Errors
    /// When they cannot work together, at the place of the one that is to blame.
    pub fn check(&self, notes: &mut Notes) -> Result<(), Error> {
        let mut own = Notes::default();
        let done = self.cross_check(&mut own);
        own.said_by("profile");
        notes.append(own);
        done
    }

    fn cross_check(&self, notes: &mut Notes) -> Result<(), Error> {
        self.chain()?;
        for station in &self.stations {
            let (takes, gives) = station.work.forms();
            if !station.active && takes != gives {
                let name = station.entry.name;
                let error = Error::new(format!("{name}.active = false: without {name} there is no print"));
                return Err(self.blame(
                    error.hint("it turns one kind of document into another"),
                    &format!("{name}.active"),
                ));
            }
        }
        self.check_bead(notes)?;
        for station in &self.stations {
            for (key, value) in station.work.keys().values() {
                let Value::Text(text) = value else { continue };
                for line in text.lines().filter(|line| self.machine.heaters.refuse(line)) {
                    let name = station.entry.name;
                    notes.say(format!(
                        "{name}.{key} has `{}`, which heats what the machine cannot heat",
                        line.trim()
                    ));
                }
            }
        }
        Ok(())
    }

    fn check_bead(&self, notes: &mut Notes) -> Result<(), Error> {
        let number = |key: &str| match self.get(key) {
            Some((_, Value::Number(number))) => Some(number),
            _ => None,
        };
        let (Some(height), Some(first), Some(width)) =
            (number("carve.layer_height"), number("carve.first_layer_height"), number("carve.bead_width"))
        else {
            return Ok(());
        };
        let nozzle = self.machine.nozzle.mm();
        let stadium =
            self.get("carve.bead_section").is_some_and(|(_, value)| value == Value::from("stadium"));
        if stadium && width < height {
            let error = Error::new(format!(
                "carve.bead_width = {width} is below carve.layer_height = {height}: a stadium is wider than high"
            ));
            return Err(self.blame(
                error.hint("a wider bead, lower layers, or carve.bead_section = \"ellipse\""),
                "carve.bead_width",
            ));
        }
        if width < 0.8 * nozzle || width > 3.0 * nozzle {
            notes.say(format!(
                "carve.bead_width = {width} mm is unusual for a nozzle of {nozzle} mm: 0.8 to 3 times it can be laid"
            ));
        }
        if height > nozzle {
            notes.say(format!("carve.layer_height = {height} mm is more than the nozzle of {nozzle} mm: layers may not stick"));
        }
        if first > 2.0 * height {
            notes.say(format!(
                "carve.first_layer_height = {first} mm is more than twice carve.layer_height = {height} mm: the first \
                 layer is not pressed onto the bed"
            ));
        }
        Ok(())
    }
}
