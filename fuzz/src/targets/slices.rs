//! The drawing between carve and preface, and drawings of other programs.

use super::{Target, assert_equal, size};
use ::import::Import;
use ::skein::Slices;
use clayforge::{Drawing, Error, draw_text};

pub(super) const TARGET: Target = Target {
    name: "slices",
    law: "a drawing that is read is written and read again as the same, and can be drawn or refused",
    run,
    dictionary: &[
        "<svg xmlns=\"http://www.w3.org/2000/svg\">",
        "<g id=\"z:0.75\">",
        "<path d=\"M 0 0 L 1 0 L 1 1 z\"/>",
        "slice:layers ",
        "layerHeight=\"1.5\"",
        "bridgeRotation=\"1.0,0.0\"",
        "minX=\"",
        "transform=\"",
        " z M ",
        " L ",
        "</g>",
        "<!-- ",
        " -->",
        "&#x30;",
        "slice:z=\"",
        "procedureName=\"carve,bottom\"",
        "<g z=\"1.5\">",
        "<rect x=\"1\" y=\"1\" width=\"9\" height=\"9\" rx=\"1\"/>",
        "<circle r=\"5\"/>",
        "<polygon slic3r:type=\"hole\" points=\"0,0 1,0 1,1\"/>",
        "<use href=\"#a\"/>",
        "<g id=\"a\">",
        "<!DOCTYPE a [<!ENTITY b \"c\">]>",
        "fill=\"none\" stroke=\"red\" stroke-width=\"2mm\"",
        "style=\"fill-rule:evenodd\"",
        "viewBox=\"0 0 9 9\" width=\"9mm\"",
        "scale(2) rotate(30 1 1) translate(-1)",
        "A 5 3 30 1 0 ",
        " C 1 2 3 4 5 6 ",
        "yAxisPointingUpward=\"true\"",
    ],
    most: 32_768,
};

fn run(bytes: &[u8]) -> String {
    let foreign = match Import::default().drawing(bytes) {
        Ok(drawing) => {
            let slices = drawing.slices;
            assert_equal(&Slices::read(&slices.write()), &Ok(slices.clone()), "read as ours");
            format!("{} drawn", size(slices.layers.len()))
        }
        Err(error) => error.to_string(),
    };
    format!("{foreign}, {}", own(bytes))
}

fn own(bytes: &[u8]) -> String {
    match Slices::read(bytes) {
        Ok(slices) => {
            let again = Slices::read(&slices.write());
            assert_equal(&again, &Ok(slices.clone()), "read again");
            let drawn = match draw_text(bytes, Drawing::default()) {
                Ok(_) => String::new(),
                Err(error) => error.to_string(),
            };
            let loops = slices.layers.iter().map(|layer| layer.loops.len()).sum();
            format!("{} layers, {} loops {drawn}", size(slices.layers.len()), size(loops))
        }
        Err(Error { message, .. }) => message,
    }
}
