//! Every stage on every text.

use super::{Target, assert_not_ours, skein};
use ::skein::{Skein, Slices};
use clayforge::{Notes, Profile, STAGES};
use std::sync::OnceLock;

pub(super) const TARGET: Target = Target {
    name: "stages",
    law: "a stage makes of any text that keeps the laws one that keeps them, or refuses it",
    run,
    dictionary: skein::WORDS,
    most: 16_384,
};

/// The built-in profile with every stage at work.
fn profile() -> &'static Profile {
    static PROFILE: OnceLock<Profile> = OnceLock::new();
    PROFILE.get_or_init(|| {
        let mut profile = Profile::default();
        for entry in STAGES {
            // What cannot be switched is always at work.
            let _ = profile.set(&format!("{}.active", entry.name), "true");
        }
        profile
    })
}

fn run(bytes: &[u8]) -> String {
    let lawful = Skein::read(bytes).is_ok_and(|skein| skein.verify().is_ok());
    if !lawful && Slices::read(bytes).is_err() {
        return "neither a skein that keeps the laws nor a drawing".to_owned();
    }
    let mut said = String::new();
    for entry in STAGES.iter().filter(|entry| entry.name != "carve") {
        let mut out = Vec::new();
        let mut sink = |piece: &[u8]| {
            out.extend_from_slice(piece);
            Ok(())
        };
        match clayforge::craft(entry.name, bytes, profile(), &mut Notes::default(), &mut sink) {
            Ok(()) => {
                said.push_str(entry.name);
                said.push(if out == bytes { '=' } else { '+' });
            }
            Err(error) => {
                assert_not_ours(&error);
                said.push_str(&error.message);
            }
        }
        said.push(' ');
    }
    said
}
