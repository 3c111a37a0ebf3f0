//! The table of stages, in the order in which clay meets them, and the two chains made of it.

use crate::work::{OnSkein, Special, Work};
use skein::{Error, Field};

/// What is known of a stage before it has settings.
pub struct Entry {
    /// The craft word: profile section, header tag and command.
    pub name: &'static str,
    /// What it is for, in one sentence.
    pub about: &'static str,
    /// Its manual page.
    pub page: &'static str,
    /// Whether it works when the profile says nothing.
    pub active: bool,
    make: fn() -> Box<dyn Work>,
}

impl Entry {
    /// The stage with its defaults.
    pub fn make(&self) -> Box<dyn Work> {
        (self.make)()
    }

    /// Its settings.
    pub fn fields(&self) -> Vec<Field> {
        self.make().keys().fields()
    }
}

/// A line of the table: `on` or `off` is whether the stage works by default; the word before the type says what it
/// works on.
macro_rules! stages {
    ($($active:ident $kind:ident $stage:ident::$type:ident: $about:literal;)*) => {
        /// Every stage, in the order of the chain `clay`.
        pub const STAGES: &[Entry] = &[$(Entry {
            name: stringify!($stage),
            about: $about,
            page: include_str!(concat!("../../stages/", stringify!($stage), "/README.md")),
            active: stages!(@$active),
            make: || Box::new(<stages!(@$kind $stage::$type)>::default()),
        }),*];
    };
    (@on) => { true };
    (@off) => { false };
    (@special $type:ty) => { Special<$type> };
    (@skein $type:ty) => { OnSkein<$type> };
}

stages! {
    on special carve::Carve: "Cuts the part into layers of loops.";
    on special preface::Preface: "Turns the drawing of the layers into the first skein.";
    on skein inset::Inset: "Lays the outermost wall half a bead inside the outline.";
    on skein fill::Fill: "Adds the inner walls and the infill and puts the threads in order.";
    on skein speed::Speed: "Says how fast every move is made.";
    on skein dimension::Dimension: "Says how much clay every move pushes out.";
    on special export::Export: "Writes the file that the machine reads.";
}

/// The stage of a name.
pub fn stage(name: &str) -> Option<&'static Entry> {
    STAGES.iter().find(|entry| entry.name == name)
}

/// The literal order of the seed; what is not in the table yet is passed over.
const SEED: &[&str] = &[
    "carve",
    "preface",
    "widen",
    "inset",
    "fill",
    "multiply",
    "speed",
    "raft",
    "chamber",
    "tower",
    "jitter",
    "comb",
    "clip",
    "cool",
    "stretch",
    "hop",
    "wipe",
    "oozebane",
    "splodge",
    "home",
    "lash",
    "fillet",
    "dimension",
    "unpause",
    "export",
];

/// Of two stages in the same row, the one further left must come first (stages.md §8.3).
const ORDERS: &[&[&str]] = &[
    &[
        "carve",
        "scale",
        "bottom",
        "preface",
        "widen",
        "inset",
        "fill",
        "multiply",
        "speed",
        "raft",
        "tower",
        "jitter",
        "clip",
        "comb",
        "cool",
        "hop",
        "wipe",
        "oozebane",
        "home",
        "lash",
        "fillet",
        "limit",
        "unpause",
        "dimension",
        "alteration",
        "export",
    ],
    &["preface", "temperature", "raft", "skirt", "export"],
    &["multiply", "speed", "skirt"],
    &["fill", "smooth", "comb"],
    &["preface", "stretch", "comb"],
    &["fill", "clip", "skin", "comb"],
    &["speed", "wipe", "dwindle", "home"],
    &["speed", "wipe", "splodge", "home"],
    &["preface", "chamber", "export"],
];

/// A chain that has a name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Chain {
    /// The order that clay wants.
    #[default]
    Clay,
    /// The literal order of the seed.
    Seed,
}

impl Chain {
    /// The words of a profile.
    pub const WORDS: &'static [(&'static str, Self)] = &[("clay", Self::Clay), ("seed", Self::Seed)];

    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Clay => "clay",
            Self::Seed => "seed",
        }
    }

    /// The names of its stages in order.
    pub fn stages(self) -> Vec<&'static str> {
        match self {
            Self::Clay => STAGES.iter().map(|entry| entry.name).collect(),
            Self::Seed => SEED.iter().filter_map(|name| stage(name)).map(|entry| entry.name).collect(),
        }
    }
}

/// Checks a sequence of one's own.
///
/// # Errors
/// When a stage is there twice, one that must come before another comes after it, or the document of one has not the
/// form that the next one reads.
pub fn check_sequence(names: &[&'static str]) -> Result<(), Error> {
    let place = |name: &str| names.iter().position(|other| *other == name);
    for (index, name) in names.iter().enumerate() {
        if place(name) != Some(index) {
            return Err(Error::new(format!("sequence has `{name}` twice")));
        }
    }
    for order in ORDERS {
        for (index, first) in order.iter().enumerate() {
            for second in &order[index + 1..] {
                if let (Some(one), Some(other)) = (place(first), place(second))
                    && other < one
                {
                    return Err(Error::new(format!(
                        "sequence has `{second}` before `{first}`: {first} must come first"
                    ))
                    .hint("the order that works: clayforge stages"));
                }
            }
        }
    }
    for needed in ["carve", "preface", "export"] {
        if place(needed).is_none() {
            return Err(Error::new(format!("sequence has no `{needed}`"))
                .hint("every chain needs carve, preface and export"));
        }
    }
    for pair in names.windows(2) {
        let forms = |name: &str| stage(name).map(|entry| entry.make().forms());
        if let [before, after] = pair
            && let (Some((_, gives)), Some((takes, _))) = (forms(before), forms(after))
            && gives != takes
        {
            return Err(Error::new(format!(
                "sequence has `{after}` behind `{before}`, which gives {gives}; {after} reads {takes}"
            )));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_named_chains_keep_to_the_order() {
        assert_eq!(check_sequence(&Chain::Clay.stages()), Ok(()));
        assert!(!Chain::Seed.stages().is_empty());
    }

    #[test]
    fn a_sequence_that_breaks_a_dependency_names_the_pair() {
        let error =
            check_sequence(&["carve", "preface", "fill", "inset", "export"]).expect_err("fill before inset");
        assert_eq!(error.message, "sequence has `fill` before `inset`: inset must come first");
        assert!(check_sequence(&["carve", "preface", "preface", "export"]).is_err());
        assert!(check_sequence(&["carve", "inset", "export"]).is_err());
    }
}
