//! Both chains on parts made from bytes.

use super::{Target, assert_not_ours, assert_same, size};
use crate::stl::{Triangle, stl};
use clayforge::{Error, Event, Notes, Profile};

pub(super) const TARGET: Target = Target {
    name: "chain",
    law: "the chain of texts makes of any part the bytes of the chain in memory, and both refuse alike",
    run,
    dictionary: &[],
    most: 200,
};

/// What the first bytes choose from: pairs of a key and its value.
const SETTINGS: &[(&str, &str)] = &[
    ("fill.density", "0"),
    ("fill.density", "1"),
    ("fill.walls", "0"),
    ("fill.walls", "1"),
    ("fill.walls", "5"),
    ("carve.layer_height", "0.7"),
    ("carve.first_layer_height", "0.4"),
    ("carve.bead_width", "6"),
    ("carve.bead_width", "1.1"),
    ("carve.bead_section", "stadium"),
    ("carve.bead_section", "ellipse"),
    ("machine.e_unit", "{ ram = 50 }"),
    ("machine.e_unit", "{ filament = 1.75 }"),
    ("dimension.counting", "absolute"),
    ("chain", "seed"),
    ("fill.base_layers", "0"),
    ("fill.top_layers", "0"),
    ("fill.base_layers", "1000"),
    ("speed.first_layer", "1"),
    ("speed.feed", "200"),
    ("widen.active", "true"),
    ("multiply.active", "true"),
    ("temperature.active", "true"),
    ("raft.active", "true"),
    ("skirt.active", "true"),
    ("chamber.active", "true"),
    ("tower.active", "true"),
    ("jitter.active", "true"),
    ("clip.active", "true"),
    ("smooth.active", "true"),
    ("stretch.active", "true"),
    ("skin.active", "true"),
    ("comb.active", "true"),
    ("cool.active", "true"),
    ("hop.active", "true"),
    ("wipe.active", "true"),
    ("oozebane.active", "true"),
    ("dwindle.active", "true"),
    ("splodge.active", "true"),
    ("home.active", "true"),
    ("lash.active", "true"),
    ("fillet.active", "true"),
    ("limit.active", "true"),
    ("unpause.active", "true"),
];
/// Bytes for the settings; the rest is the part.
const CHOICES: usize = 4;
/// Bytes of one solid, and of one corner of it.
const SOLID: usize = 8;

/// A stage and the text behind it.
type Behind = (&'static str, Vec<u8>);

fn run(bytes: &[u8]) -> String {
    let (choices, rest) = bytes.split_at(CHOICES.min(bytes.len()));
    let mut profile = Profile::default();
    for &choice in choices.iter().filter(|choice| **choice > 0) {
        let (key, value) = SETTINGS[usize::from(choice) % SETTINGS.len()];
        profile.set(key, value).unwrap_or_else(|error| panic!("{key} = {value}: {error}"));
    }
    let part = stl(&triangles(rest));
    let (texts, done) = in_memory(&part, &profile);
    if let Err(error) = &done {
        assert_not_ours(error);
    }
    let mut text = part;
    for (stage, expected) in &texts {
        match crafted(stage, &text, &profile) {
            Ok(made) => {
                assert_same(&made, expected, &format!("{stage} as text and in memory"));
                text = made;
            }
            // The file is checked when it is whole, which the last stage alone has no part in.
            Err(error) => panic!("{stage} refuses the text of what it takes in memory: {error}"),
        }
    }
    let kinds = choices.iter().map(|choice| SETTINGS[usize::from(*choice) % SETTINGS.len()].0);
    match done {
        Ok(()) => format!("{} {}", size(text.len()), kinds.collect::<Vec<_>>().join(" ")),
        Err(error) => error.message,
    }
}

/// The text behind every stage, and what stopped the chain.
fn in_memory(part: &[u8], profile: &Profile) -> (Vec<Behind>, Result<(), Error>) {
    let (mut texts, mut gcode) = (Vec::new(), Vec::new());
    let mut watch = |event: Event<'_>| {
        if let Event::Done { name, number: 1.., document, .. } = event {
            texts.push((name, document.text()));
        }
        Ok(())
    };
    let mut sink = |piece: &[u8]| {
        gcode.extend_from_slice(piece);
        Ok(())
    };
    let done = clayforge::slice(part, profile, None, &mut watch, &mut sink).map(drop);
    // What has no text went to the sink.
    let texts = texts.into_iter().map(|(name, text)| (name, text.unwrap_or_else(|| gcode.clone())));
    (texts.collect(), done)
}

fn crafted(stage: &str, text: &[u8], profile: &Profile) -> Result<Vec<u8>, Error> {
    let mut out = Vec::new();
    clayforge::craft(stage, text, profile, &mut Notes::default(), &mut |piece| {
        out.extend_from_slice(piece);
        Ok(())
    })?;
    Ok(out)
}

/// Boxes, pyramids and lone triangles, some through each other, some flat, some nearly: corners stand on a grid of
/// half a millimetre and stray by microns.
fn triangles(bytes: &[u8]) -> Vec<Triangle> {
    let solids = bytes.chunks_exact(SOLID);
    solids.flat_map(|solid| solid.try_into().map_or_else(|_| Vec::new(), |solid| one(&solid))).collect()
}

fn one(&[kind, x, y, z, wide, deep, high, stray]: &[u8; SOLID]) -> Vec<Triangle> {
    let half = |byte: u8| f64::from(byte) / 2.0;
    let stray = f64::from(stray) / 1000.0;
    let low = [half(x), half(y), half(z % 64)];
    let size = [half(wide), half(deep), half(high % 64)];
    let corner = |right: bool, back: bool, top: bool| {
        let mut at = low;
        for (axis, yes) in [right, back, top].into_iter().enumerate() {
            at[axis] += if yes { size[axis] } else { 0.0 };
        }
        at[0] += if back { stray } else { 0.0 };
        at[1] += if top { stray } else { 0.0 };
        at
    };
    let [a, b, c, d] = [
        corner(false, false, false),
        corner(true, false, false),
        corner(true, true, false),
        corner(false, true, false),
    ];
    let [e, f, g, h] = [
        corner(false, false, true),
        corner(true, false, true),
        corner(true, true, true),
        corner(false, true, true),
    ];
    match kind % 4 {
        0 => vec![[a, b, g]],
        1 => vec![[a, c, b], [a, d, c], [a, b, e], [b, c, e], [c, d, e], [d, a, e]],
        _ => vec![
            [a, c, b],
            [a, d, c],
            [e, f, g],
            [e, g, h],
            [a, b, f],
            [a, f, e],
            [b, c, g],
            [b, g, f],
            [c, d, h],
            [c, h, g],
            [d, a, e],
            [d, e, h],
        ],
    }
}
