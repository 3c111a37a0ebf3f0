//! Every edit of any file.

use super::{Target, gcode, size};
use ::edit::{At, Axes, Base, Clean, Edit, HEATERS, Nozzle, Pause, Rim, Scale, Section, Size, Speed};
use std::sync::OnceLock;

pub(super) const TARGET: Target = Target {
    name: "edit",
    law: "an edit of any bytes is a file that can be edited, or a refusal",
    run,
    dictionary: gcode::WORDS,
    most: 16_384,
};

/// One of each kind, with numbers that change something.
fn edits() -> &'static [Edit] {
    static EDITS: OnceLock<Vec<Edit>> = OnceLock::new();
    EDITS.get_or_init(|| {
        let base = b"G90\nM83\nG1 Z1 F600\nG1 X0 Y0\nG1 X20 E4\nG1 Y20 E4\nG1 X0 E4\nG1 Y0 E4\n".to_vec();
        vec![
            Edit::Scale(Scale { size: Size::Factor(0.73), axes: Axes::Xyz, bead: true }),
            Edit::Scale(Scale { size: Size::Height(120.0), axes: Axes::Z, bead: false }),
            Edit::Speed(Speed { bottom: 1.5, top: 0.5, travels: true }),
            Edit::Nozzle(Nozzle { old: 2.0, new: 4.0, section: Section::Stadium, spread: 1.2, layer: None }),
            Edit::Nozzle(Nozzle {
                old: 4.0,
                new: 3.0,
                section: Section::Ellipse,
                spread: 1.0,
                layer: Some(1.5),
            }),
            Edit::Base(Base { other: base, height: None, e_factor: Some(1.0), lift: 2.0 }),
            Edit::Clean(Clean { commands: HEATERS.map(str::to_owned).to_vec() }),
            Edit::Rim(Rim { turns: 3, rise: 0.2, flow: 0.5 }),
            Edit::Pause(Pause { park: Some([5.0, 5.0]), prime: 1.0, relieve: 2.0, ..Pause::default() }),
            Edit::Pause(Pause { at: At::Height(3.0), ..Pause::default() }),
        ]
    })
}

fn run(bytes: &[u8]) -> String {
    let mut said = String::new();
    for edit in edits() {
        match edit.apply(bytes) {
            Ok(edited) => {
                let text = String::from_utf8_lossy(&edited.text);
                for word in ["NaN", "inf"] {
                    let made =
                        text.matches(word).count() > String::from_utf8_lossy(bytes).matches(word).count();
                    assert!(!made, "{} wrote {word}", edit.name());
                }
                said.push_str(&format!("{} {} ", edit.name(), size(edited.said.len())));
                // One edit on top of another.
                let _ = edits()[bytes.len() % edits().len()].apply(&edited.text);
            }
            Err(error) => said.push_str(&error.message),
        }
    }
    said
}
