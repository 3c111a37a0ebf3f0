#![doc = include_str!("../README.md")]

use skein::{Celsius, Error, Heaters, Notes, Settings, Skein, Stage};

#[cfg(test)]
mod tests;

/// Says how hot the nozzle is, for machines that heat it.
#[derive(Clone, Debug, Settings)]
pub struct Temperature {
    /// How many degrees a second the nozzle cools. The slower, the longer the print waits for it.
    #[setting(default = 3.0, min = 0.1, max = 100.0, unit = "°C/s")]
    pub cooling_rate: Celsius,
    /// How many degrees a second the nozzle warms up.
    #[setting(default = 10.0, min = 0.1, max = 100.0, unit = "°C/s")]
    pub heating_rate: Celsius,
    /// How hot the base of a raft is laid.
    #[setting(default = 200.0, min = 0.0, max = 500.0, unit = "°C")]
    pub base: Celsius,
    /// How hot the rest of a raft is laid.
    #[setting(default = 200.0, min = 0.0, max = 500.0, unit = "°C")]
    pub interface: Celsius,
    /// How hot the infill of the part's first layer is laid.
    #[setting(default = 195.0, min = 0.0, max = 500.0, unit = "°C")]
    pub object_first_layer_infill: Celsius,
    /// How hot the walls of the part's first layer are laid. Hotter sticks better.
    #[setting(default = 220.0, min = 0.0, max = 500.0, unit = "°C")]
    pub object_first_layer_perimeter: Celsius,
    /// How hot the other layers are laid.
    #[setting(default = 230.0, min = 0.0, max = 500.0, unit = "°C")]
    pub object_next_layers: Celsius,
    /// How hot support is laid. Cooler comes off more easily.
    #[setting(default = 200.0, min = 0.0, max = 500.0, unit = "°C")]
    pub support: Celsius,
    /// How hot the part is laid on layers with support.
    #[setting(default = 230.0, min = 0.0, max = 500.0, unit = "°C")]
    pub supported: Celsius,
}

impl Stage for Temperature {
    const NAME: &'static str = "temperature";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let mut facts = skein.facts()?;
        if !facts.heaters.is_some_and(|Heaters { nozzle, .. }| nozzle) {
            notes.say("the machine has no heater in its nozzle, so nobody is told a temperature");
            return Ok(skein);
        }
        facts.cooling_rate = Some(self.cooling_rate);
        facts.heating_rate = Some(self.heating_rate);
        facts.base_temperature = Some(self.base);
        facts.interface_temperature = Some(self.interface);
        facts.first_layer_infill_temperature = Some(self.object_first_layer_infill);
        facts.first_layer_perimeter_temperature = Some(self.object_first_layer_perimeter);
        facts.next_layers_temperature = Some(self.object_next_layers);
        facts.support_temperature = Some(self.support);
        facts.supported_temperature = Some(self.supported);
        skein.state(&facts)?;
        Ok(skein)
    }
}
