#![doc = include_str!("../README.md")]

use skein::{Celsius, Error, Line, Micron, Notes, Ratio, Reader, Settings, Skein, Stage, Tag};

#[cfg(test)]
mod tests;

/// Says how warm the bed and the air are, and how hard clay is pushed.
#[derive(Clone, Debug, Settings)]
pub struct Chamber {
    /// How warm the bed is when the print begins. 0 leaves it alone.
    #[setting(default = 60.0, min = 0.0, max = 300.0, unit = "°C")]
    pub bed_temperature: Celsius,
    /// The height at which the temperature of the bed begins to change. Below 0 it never does.
    #[setting(default = -1.0, min = -1.0, max = 100000.0, unit = "mm")]
    pub bed_temperature_begin_change_height: Micron,
    /// The height at which it has changed.
    #[setting(default = -1.0, min = -1.0, max = 100000.0, unit = "mm")]
    pub bed_temperature_end_change_height: Micron,
    /// How warm the bed is from there on.
    #[setting(default = 20.0, min = 0.0, max = 300.0, unit = "°C")]
    pub bed_temperature_end: Celsius,
    /// How warm the air around the part is; with a fan it is drying air. 0 leaves it alone.
    #[setting(default = 30.0, min = 0.0, max = 300.0, unit = "°C")]
    pub chamber_temperature: Celsius,
    /// Whether the print waits until bed and air are warm.
    #[setting(default = false)]
    pub wait: bool,
    /// How hard clay is pushed, in the unit of the machine. 0 says nothing.
    #[setting(default = 0.0, min = 0.0, max = 1000.0, unit = "bar")]
    pub pressure: Ratio,
    /// The line that sets the pressure; `{pressure}` stands for the value.
    #[setting(default = "M142 S{pressure}")]
    pub pressure_line: String,
    /// Whether bed, air and pressure are switched off when the print ends.
    #[setting(default = true)]
    pub turn_off_at_end: bool,
}

/// The commands that set a temperature, and that also wait for it.
struct Heater {
    set: &'static str,
    wait: &'static str,
}

const BED: Heater = Heater { set: "M140", wait: "M190" };
const CHAMBER: Heater = Heater { set: "M141", wait: "M191" };

impl Stage for Chamber {
    const NAME: &'static str = "chamber";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let heaters = skein.facts()?.heaters.unwrap_or_default();
        let warm = |heater: bool, wanted: Celsius, what: &str, notes: &mut Notes| {
            if wanted.0 > 0 && !heater {
                notes.say(format!("the machine cannot warm its {what}, so nobody is told a temperature"));
            }
            heater && wanted.0 > 0
        };
        let bed = warm(heaters.bed, self.bed_temperature, "bed", notes);
        let air = warm(heaters.chamber, self.chamber_temperature, "chamber", notes);
        let (mut start, mut end) = (Vec::new(), Vec::new());
        for (on, heater, wanted) in
            [(bed, BED, self.bed_temperature), (air, CHAMBER, self.chamber_temperature)]
        {
            if on {
                start.push(command(if self.wait { heater.wait } else { heater.set }, wanted)?);
                end.push(command(heater.set, Celsius::default())?);
            }
        }
        if self.pressure.0 > 0 {
            start.extend(self.push(self.pressure));
            end.extend(self.push(Ratio(0)));
        }
        if bed && let Some(ramp) = Ramp::new(self)? {
            ramp.write(&mut skein)?;
        }
        let crafting = skein.head.iter().position(|line| *line == Line::Open(Tag::Crafting));
        let at = crafting.map_or(skein.head.len(), |index| index + 1);
        skein.head.splice(at..at, start);
        if self.turn_off_at_end && !end.is_empty() {
            if skein.tail.is_empty() {
                notes.say("the print has no end at which anything could be switched off");
            } else {
                skein.tail.extend(end);
            }
        }
        Ok(skein)
    }
}

impl Chamber {
    /// The lines that set the pressure.
    fn push(&self, pressure: Ratio) -> Vec<Line> {
        let text = self.pressure_line.replace("{pressure}", &pressure.to_string());
        let pasted = text.lines().map(str::trim_end).filter(|line| !line.is_empty());
        let mut lines = vec![Line::Open(Tag::Alteration)];
        lines.extend(pasted.map(|line| Line::Pasted(line.into())));
        lines.push(Line::Close(Tag::Alteration));
        lines
    }
}

/// A command as a skein holds it: read, so that in memory and in a file it is the same line.
fn command(word: &str, temperature: Celsius) -> Result<Line, Error> {
    Reader::default().line(format!("{word} S{temperature}").as_bytes())
}

/// The temperature of the bed by height.
struct Ramp {
    begin: (f64, f64),
    end: (f64, f64),
}

impl Ramp {
    /// `None` when the bed stays as it is.
    fn new(chamber: &Chamber) -> Result<Option<Self>, Error> {
        let from = chamber.bed_temperature_begin_change_height;
        let to = chamber.bed_temperature_end_change_height;
        if from.0 < 0 {
            return Ok(None);
        }
        if to < from {
            return Err(Error::new(format!(
                "the bed cannot begin to change at {from} mm and be done at {to} mm"
            ))
            .hint("set bed_temperature_end_change_height above bed_temperature_begin_change_height, or both to -1"));
        }
        Ok(Some(Self {
            begin: (from.mm(), chamber.bed_temperature.degrees()),
            end: (to.mm(), chamber.bed_temperature_end.degrees()),
        }))
    }

    fn at(&self, z: f64) -> f64 {
        let ((from, warm), (to, cool)) = (self.begin, self.end);
        let share = if z >= to { 1.0 } else { ((z - from) / (to - from)).max(0.0) };
        warm * (1.0 - share) + cool * share
    }

    /// Says the temperature on every layer where it changes.
    fn write(&self, skein: &mut Skein) -> Result<(), Error> {
        let mut now = Celsius::from_degrees(self.begin.1);
        for layer in &mut skein.layers {
            let wanted = Celsius::from_degrees(self.at(layer.z().mm()));
            if wanted != now {
                let line = command(BED.set, wanted.unwrap_or_default())?;
                let at = layer.lines.len().min(if matches!(layer.lines.get(1), Some(Line::Thickness(_))) {
                    2
                } else {
                    1
                });
                layer.lines.insert(at, line);
                now = wanted;
            }
        }
        Ok(())
    }
}
