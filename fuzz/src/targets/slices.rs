//! The drawing between carve and preface.

use super::{Target, assert_equal, size};
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
    ],
    most: 32_768,
};

fn run(bytes: &[u8]) -> String {
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
