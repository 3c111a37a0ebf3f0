//! What starts and stops the clay on machines whose pump is no axis.

use crate::Export;
use skein::Ratio;

/// The lines for a start, a stop and a change of flow.
pub(crate) struct Extruder {
    on: String,
    off: String,
    flow: String,
}

impl Extruder {
    pub(crate) fn new(export: &Export) -> Self {
        Self { on: export.on.clone(), off: export.off.clone(), flow: export.flow.clone() }
    }

    pub(crate) fn start(&self, flow: Ratio, out: &mut Vec<u8>) {
        write(&self.on, flow, out);
    }

    pub(crate) fn stop(&self, flow: Ratio, out: &mut Vec<u8>) {
        write(&self.off, flow, out);
    }

    pub(crate) fn change(&self, flow: Ratio, out: &mut Vec<u8>) {
        write(&self.flow, flow, out);
    }
}

fn write(template: &str, flow: Ratio, out: &mut Vec<u8>) {
    for line in template.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let share = flow.f64();
        let line = line
            .replace("<flow>", &flow.to_string())
            .replace("<percent>", &format!("{}", (share * 100.0).round()))
            .replace("<pwm>", &format!("{}", (share * 255.0).round().clamp(0.0, 255.0)));
        out.extend_from_slice(line.as_bytes());
        out.push(b'\n');
    }
}
