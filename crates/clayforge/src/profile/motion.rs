//! How the machine moves: what the emulator must know of it.

use crate::Profile;
use emulate::motion::{MotionProfile, Smoothing};
use emulate::{Extruder, Limits, Machine};
use skein::{EUnit, Feed, Micron, Ratio, Settings, Value};

/// What the machine can do when it moves. The firmware knows it: `M503` prints it on Marlin, `$$` on GRBL.
#[derive(Clone, Debug, PartialEq, Settings)]
pub struct Motion {
    /// What it accelerates with (`M204`, `$120`).
    #[setting(default = 500, min = 1.0, max = 100000.0, unit = "mm/s²")]
    pub acceleration: u32,
    /// How far it may cut a corner (`M205 J`, `$11`). Less is slower round corners.
    #[setting(default = 0.05, min = 0.0, max = 10.0, unit = "mm")]
    pub junction_deviation: Micron,
    /// How much of a short move it goes at one speed (`minimum_cruise_ratio` of Klipper, where 0.5 is usual). Firmware
    /// of other kinds has none.
    #[setting(default = 0.0, min = 0.0, max = 0.99)]
    pub cruise_ratio: Ratio,
    /// The highest speed along x and along y (`M203`, `$110`).
    #[setting(default = 300.0, min = 0.1, max = 10000.0, unit = "mm/s")]
    pub xy_speed: Feed,
    /// The highest speed up and down.
    #[setting(default = 300.0, min = 0.1, max = 10000.0, unit = "mm/s")]
    pub z_speed: Feed,
    /// The highest speed of E, in its own unit. A pump that cannot follow slows the whole machine down, or loses steps.
    #[setting(default = 10000.0, min = 0.001, max = 30000.0, unit = "E/s")]
    pub e_speed: Feed,
}

impl Profile {
    /// The machine of this profile for the emulator.
    pub fn emulator(&self) -> Machine {
        let Motion { acceleration, junction_deviation, cruise_ratio, xy_speed, z_speed, e_speed } =
            &self.motion;
        let [flat, up, mut e] = [xy_speed, z_speed, e_speed].map(|speed| speed.mm_per_s());
        let known = self.machine.max_e_speed.f64();
        if known > 0.0 {
            e = e.min(known);
        }
        Machine {
            motion: MotionProfile {
                max_acceleration: Some(f64::from(*acceleration)),
                junction_deviation: junction_deviation.mm(),
                smoothing: Smoothing::CruiseRatio(cruise_ratio.f64()),
                ..MotionProfile::default()
            },
            limits: Limits { axis_speed: [flat, flat, up, e], ..Limits::default() },
            extruder: match self.machine.e_unit {
                EUnit::Mm3 => Extruder::Volume,
                EUnit::Ram(diameter) => Extruder::Piston { diameter: diameter.mm() },
                EUnit::Filament(diameter) => Extruder::Filament { diameter: diameter.mm() },
                EUnit::PerMm(_) => Extruder::Unit { mm3: 1.0 / self.machine.e_unit.per_mm3(self.section()) },
            },
            // Where the nozzle stands at the beginning is not known.
            start: None,
            ..Machine::default()
        }
    }

    /// The nominal section of a bead, mm².
    fn section(&self) -> f64 {
        let number = |key: &str| match self.get(key) {
            Some((_, Value::Number(number))) => number,
            _ => 1.0,
        };
        number("carve.bead_width") * number("carve.layer_height")
    }
}
