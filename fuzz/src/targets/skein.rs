//! The text between the stages.

use super::{Target, assert_equal, size};
use ::skein::Skein;

/// Words of a skein, for whatever reads one.
pub(super) const WORDS: &[&str] = &[
    "(<layer> 0.75 )\n",
    "(</layer>)\n",
    "M101\n",
    "M103\n",
    "G1 X1.0 Y2.0 Z1.5\n",
    "G1 X1.0 Y2.0 Z1.5 F960.0 E0.5\n",
    "M108 S0.83\n",
    "G2 X1.0 Y1.0 I0.5 J0.5\n",
    "G3 X0.0 Y0.0 Z1.5 I-0.5 J0.0\n",
    "(<loop> outer )\n",
    "(</loop>)\n",
    "(<edge> outer )\n",
    "(</edge>)\n",
    "(<infill>)\n",
    "(</infill>)\n",
    "(<middle>)\n",
    "(</middle>)\n",
    "(<boundaryPerimeter>)\n",
    "(</boundaryPerimeter>)\n",
    "(<boundaryPoint> X1.0 Y2.0 Z0.2 </boundaryPoint>)\n",
    "(<thickness> 1.2 </thickness>)\n",
    "(<rotation> 1.0,0.0 )\n",
    "(<crafting>)\n",
    "(</crafting>)\n",
    "(</extruderInitialization>)\n",
    "(<setting> fill walls 2 </setting>)\n",
    "(<procedureName> fill </procedureName>)\n",
    "(<edgeWidth> 3.2 </edgeWidth>)\n",
    "(<layerHeight> 1.5 </layerHeight>)\n",
    "(<operatingFeedRatePerSecond> 30.0 </operatingFeedRatePerSecond>)\n",
    "\r\n",
    "; note\n",
];

pub(super) const TARGET: Target = Target {
    name: "skein",
    law: "a skein that is read is written and read again as the same",
    run,
    dictionary: WORDS,
    most: 32_768,
};

fn run(bytes: &[u8]) -> String {
    match Skein::read(bytes) {
        Ok(skein) => {
            let again = Skein::read(&skein.write());
            assert_equal(&again, &Ok(skein.clone()), "read again");
            let kept = skein.verify().map_or_else(|error| error.message, |()| "keeps the laws".to_owned());
            let facts = skein.facts().map_or_else(|error| error.message, |_| "facts".to_owned());
            format!("{} layers, {facts}, {kept}", size(skein.layers.len()))
        }
        Err(error) => error.message,
    }
}
