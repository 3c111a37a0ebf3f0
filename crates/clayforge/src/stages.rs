//! The table of stages, in the order in which clay meets them, and the two chains made of it.

use crate::work::{On, Special, Work};
use skein::{Error, Field, Skein, Slices};

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
    (@slices $type:ty) => { On<Slices, $type> };
    (@skein $type:ty) => { On<Skein, $type> };
}

stages! {
    off special scale::Scale: "Makes the part larger by what drying and firing take from it.";
    on special carve::Carve: "Cuts the part into layers of loops.";
    on slices bottom::Bottom: "Puts the lowest layer on the bed, or on the bat that lies on it.";
    on special preface::Preface: "Turns the drawing of the layers into the first skein.";
    off skein widen::Widen: "Moves the outside outwards where a hole leaves too little clay.";
    on skein inset::Inset: "Lays the outermost wall half a bead inside the outline.";
    on skein fill::Fill: "Adds the inner walls and the infill and puts the threads in order.";
    off skein coil::Coil: "Winds the wall as one thread from the base to the rim.";
    on skein join::Join: "Makes one thread of everything that is laid on an island.";
    off skein multiply::Multiply: "Prints the part in rows and columns.";
    on skein speed::Speed: "Says how fast every move is made.";
    off skein temperature::Temperature: "Says how hot the nozzle is, for machines that heat.";
    off skein raft::Raft: "Builds what the part stands on and what holds up its overhangs.";
    off skein skirt::Skirt: "Draws lines around the part until the clay flows evenly.";
    off skein chamber::Chamber: "Says how warm the bed and the air are, and how hard clay is pushed.";
    off skein tower::Tower: "Lets one island grow some layers before the next.";
    off skein jitter::Jitter: "Moves the seam from layer to layer.";
    off skein clip::Clip: "Ends loops early, by what still follows when clay stops.";
    off skein smooth::Smooth: "Replaces short jags of the infill by straight lines.";
    off skein stretch::Stretch: "Makes curves larger by what clay pulls them in.";
    off skein skin::Skin: "Divides walls and tops into finer beads.";
    off skein comb::Comb: "Leads travels over the clay instead of over holes.";
    off skein cool::Cool: "Gives small layers time to stiffen.";
    off skein hop::Hop: "Lifts the nozzle over what is printed.";
    off skein wipe::Wipe: "Cleans the nozzle from time to time.";
    off skein oozebane::Oozebane: "Stops the clay before the end of a bead and starts it before the beginning.";
    off skein dwindle::Dwindle: "Lets the pressure go at the end of a bead.";
    off skein splodge::Splodge: "Lays a blob of clay where a bead begins.";
    off skein home::Home: "Runs lines of your own between layers.";
    off skein lash::Lash: "Makes up for the play of the axes.";
    off skein fillet::Fillet: "Rounds the corners.";
    off skein limit::Limit: "Keeps the moves within what the machine can do.";
    off skein unpause::Unpause: "Makes up for the time that a slow controller takes for each line.";
    on skein dimension::Dimension: "Says how much clay every move pushes out.";
    on skein alteration::Alteration: "Adds your own lines at the start, at the end and at the layers.";
    on special export::Export: "Writes the file that the machine reads.";
}

/// The stage of a name.
pub fn stage(name: &str) -> Option<&'static Entry> {
    STAGES.iter().find(|entry| entry.name == name)
}

/// The literal order of the seed.
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
///
/// Two of its pairs are missing, since the seed's own chain breaks them and is merely less good for it: comb works before
/// clip and stretch, and unpause behind dimension, whose E goes by length.
const ORDERS: &[&[&str]] = &[
    &["scale", "carve"],
    &[
        "carve",
        "bottom",
        "preface",
        "widen",
        "inset",
        "fill",
        "coil",
        "join",
        "multiply",
        "speed",
        "raft",
        "tower",
        "jitter",
        "clip",
        "cool",
        "hop",
        "wipe",
        "oozebane",
        "home",
        "lash",
        "fillet",
        "limit",
        "dimension",
        "alteration",
        "export",
    ],
    &["preface", "temperature", "raft", "skirt", "export"],
    &["multiply", "speed", "skirt"],
    &["fill", "smooth", "cool"],
    &["fill", "stretch", "hop"],
    &["clip", "skin", "cool"],
    &["tower", "comb", "cool"],
    &["wipe", "dwindle", "home"],
    &["wipe", "splodge", "home"],
    &["fillet", "unpause", "alteration"],
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
        assert_eq!(check_sequence(&Chain::Seed.stages()), Ok(()));
        assert_eq!(Chain::Seed.stages(), SEED);
    }

    #[test]
    fn a_4_a_sequence_that_breaks_a_dependency_names_the_pair() {
        let error =
            check_sequence(&["carve", "preface", "fill", "inset", "export"]).expect_err("fill before inset");
        assert_eq!(error.message, "sequence has `fill` before `inset`: inset must come first");
        assert!(check_sequence(&["carve", "preface", "preface", "export"]).is_err());
        assert!(check_sequence(&["carve", "inset", "export"]).is_err());
    }
}
