//! What is fuzzed.

mod chain;
mod check;
mod edit;
mod emulate;
mod gcode;
mod import;
mod profile;
mod skein;
mod slices;
mod stages;

use std::fmt::Debug;

/// A function of bytes and what helps to reach its corners.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The word on the command line, and the folder of the corpus.
    pub name: &'static str,
    /// What must hold, in one sentence.
    pub law: &'static str,
    /// Says what the bytes came to.
    ///
    /// # Panics
    /// When a law is broken.
    pub run: fn(&[u8]) -> String,
    /// Words of the format.
    pub dictionary: &'static [&'static str],
    /// The longest input that is tried, in bytes.
    pub most: usize,
}

/// Every target.
pub const TARGETS: &[Target] = &[
    import::TARGET,
    slices::TARGET,
    skein::TARGET,
    stages::TARGET,
    gcode::TARGET,
    check::TARGET,
    edit::TARGET,
    emulate::TARGET,
    profile::TARGET,
    chain::TARGET,
];

/// The target of a name.
pub fn target(name: &str) -> Option<&'static Target> {
    TARGETS.iter().find(|target| target.name == name)
}

/// How much there is of something, to the power of two: not every number is something new.
fn size(count: usize) -> String {
    let letters = usize::BITS - count.leading_zeros();
    "i".repeat(letters as usize)
}

/// Panics when two values differ; shows the first of their text that does.
#[track_caller]
fn assert_equal<T: PartialEq + Debug>(found: &T, expected: &T, what: &str) {
    if found != expected {
        let (found, expected) = (format!("{found:?}"), format!("{expected:?}"));
        panic!("{what}: {}", difference(expected.as_bytes(), found.as_bytes()));
    }
}

/// Panics when two texts differ; shows where they part.
#[track_caller]
fn assert_same(found: &[u8], expected: &[u8], what: &str) {
    assert!(found == expected, "{what}: {}", difference(expected, found));
}

/// Where two texts part, with a little of both.
fn difference(expected: &[u8], found: &[u8]) -> String {
    let place = expected.iter().zip(found).take_while(|(one, other)| one == other).count();
    let near = |text: &[u8]| {
        String::from_utf8_lossy(&text[place.saturating_sub(40)..(place + 80).min(text.len())]).into_owned()
    };
    format!("from byte {place} on, expected\n{}\nfound\n{}", near(expected), near(found))
}

/// Panics when a refusal says that we made a mistake.
#[track_caller]
fn assert_not_ours(error: &clayforge::Error) {
    assert!(!error.message.contains("our bug"), "{error}");
}
