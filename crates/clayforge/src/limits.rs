//! What a finished file is held against: the printer and the heights of a profile.

use crate::Profile;
use clay_processor as check;
use skein::{Bead, BedShape, Choice, Firmware, Heaters, Machine, Micron, Section, Value};

impl Profile {
    /// What a file for this profile is held against.
    pub fn limits(&self) -> check::Limits {
        let millimetres = |key: &str| match self.get(key) {
            Some((_, Value::Number(mm))) => Some(mm),
            _ => None,
        };
        let rest = millimetres("carve.layer_height");
        let first = millimetres("carve.first_layer_height");
        let width = millimetres("carve.bead_width");
        let machine = &self.machine;
        // Zero is what nobody knows.
        let known = |limit: f64| Some(limit).filter(|limit| *limit > 0.0);
        let bead = || {
            let section = match self.get("carve.bead_section") {
                Some((_, Value::Text(word))) => Section::WORDS.iter().position(|(known, _)| *known == word),
                _ => None,
            };
            let section = section.and_then(|index| Section::ALL.get(index).copied())?;
            Some(Bead { width: Micron::from_mm(width?)?, height: Micron::from_mm(rest?)?, section })
        };
        check::Limits {
            bed: Some(bed(machine)),
            layers: rest.zip(first).map(|(rest, first)| check::LayerHeights { first, rest }),
            bead_width: width,
            e_per_mm3: bead().map(|bead| machine.e_unit.per_mm3(bead.area())),
            max_e_speed: known(machine.max_e_speed.f64()),
            max_flow: known(f64::from(machine.max_flow)),
            heated: Some(machine.heaters != Heaters::default()),
            firmware: match machine.firmware {
                Firmware::Unknown => None,
                Firmware::Marlin => Some(check::Firmware::Marlin),
                Firmware::Reprapfirmware => Some(check::Firmware::RepRap),
                Firmware::Klipper => Some(check::Firmware::Klipper),
                Firmware::Plain => Some(check::Firmware::Plain),
            },
            longest_e: known(f64::from(machine.longest_e)),
        }
    }
}

fn bed(machine: &Machine) -> check::Bed {
    let (x, y) = machine.least();
    let least = (Micron(x).mm(), Micron(y).mm());
    check::Bed {
        least,
        greatest: (least.0 + machine.bed.x.mm(), least.1 + machine.bed.y.mm()),
        round: machine.shape == BedShape::Ellipse,
        height: machine.bed.z.mm(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_says_what_its_files_must_keep() {
        let mut profile = Profile::default();
        for (key, value) in [
            ("machine.bed", "[200, 300, 400]"),
            ("machine.origin", "center"),
            ("machine.shape", "ellipse"),
            ("machine.e_unit", "{ ram = 50 }"),
            ("machine.max_e_speed", "2.5"),
            ("machine.firmware", "klipper"),
            ("carve.layer_height", "2"),
        ] {
            profile.set(key, value).unwrap_or_else(|error| panic!("{key}: {error}"));
        }
        let limits = profile.limits();
        let bed =
            check::Bed { least: (-100.0, -150.0), greatest: (100.0, 150.0), round: true, height: 400.0 };
        assert_eq!(limits.bed, Some(bed));
        assert_eq!(limits.layers, Some(check::LayerHeights { first: 1.2, rest: 2.0 }));
        assert_eq!((limits.max_e_speed, limits.max_flow), (Some(2.5), None));
        assert_eq!(limits.firmware, Some(check::Firmware::Klipper));
        assert_eq!(limits.heated, Some(false));
        let per_mm3 = limits.e_per_mm3.expect("the bead is known");
        assert!((per_mm3 * std::f64::consts::FRAC_PI_4 * 2500.0 - 1.0).abs() < 1e-12);
    }
}
