//! The rules and what is said when one is broken.

/// What is wrong with a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Which rule is broken.
    pub rule: Rule,
    /// How bad it is.
    pub severity: Severity,
    /// Where first; nothing if it is about the file as a whole.
    pub place: Option<Place>,
    /// How often.
    pub count: usize,
    /// What is so, where, and why it matters.
    pub text: String,
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// It must not be printed: the machine, the bed or the pot is in danger, or nothing would come out.
    Forbids,
    /// It can be printed, and may come out otherwise than it was meant.
    Warns,
}

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The line, counted from 0.
    pub index: usize,
    /// The layer or spiral that it is in or behind, counted from 0 in the order of the file; nothing before the first.
    pub layer: Option<usize>,
    /// Z there, mm; nothing if it is unknown.
    pub height: Option<f64>,
}

/// The rules, each with its name in JSON; those that forbid printing come first.
macro_rules! rules {
    ($($(#[$about:meta])* $rule:ident = $name:literal, $severity:ident;)*) => {
        /// What a file can break.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Rule { $($(#[$about])* $rule,)* }

        impl Rule {
            /// Every rule, the worst first.
            pub const ALL: &[Self] = &[$(Self::$rule),*];

            /// Its name for scripts.
            pub fn name(self) -> &'static str {
                match self { $(Self::$rule => $name,)* }
            }

            /// How bad it is to break it. Heating is told apart by what is known of the machine.
            pub(crate) fn severity(self) -> Severity {
                match self { $(Self::$rule => Severity::$severity,)* }
            }
        }
    };
}

rules! {
    /// Nothing is printed.
    NothingPrinted = "nothing_printed", Forbids;
    /// Clay is laid at a height that nobody knows.
    UnknownHeight = "unknown_height", Forbids;
    /// Clay is laid at the bed or below, or the nozzle goes below it.
    BelowBed = "below_bed", Forbids;
    /// Clay is laid beside the bed.
    OutsideBed = "outside_bed", Forbids;
    /// Clay is laid higher than the machine is.
    AboveMachine = "above_machine", Forbids;
    /// The nozzle goes through clay that stands higher.
    IntoClay = "into_clay", Forbids;
    /// Clay is laid after the print has ended: motors off, program over, or Z homed.
    AfterEnd = "after_end", Forbids;
    /// Clay is laid far above all that stands, as when printing goes on behind the lift at the end.
    LiftedOff = "lifted_off", Forbids;
    /// A heater is switched on in a machine that has none.
    Heats = "heats", Forbids;
    /// The nozzle leaves the bed or the machine without printing.
    TravelOutside = "travel_outside", Warns;
    /// A layer is lower than the one before.
    Descends = "descends", Warns;
    /// The first layer is not as high as it is meant to be.
    FirstLayer = "first_layer", Warns;
    /// Layers are not as high as they are meant to be.
    LayerHeight = "layer_height", Warns;
    /// There is a gap between two layers.
    LayerGap = "layer_gap", Warns;
    /// A layer is laid twice.
    RepeatedLayer = "repeated_layer", Warns;
    /// A spiral rises otherwise than it is meant to, or faster in one turn than in the others.
    SpiralPitch = "spiral_pitch", Warns;
    /// Clay is laid in the air.
    InAir = "in_air", Warns;
    /// The printing is interrupted.
    Interrupted = "interrupted", Warns;
    /// An interruption crosses open air, where the clay that follows the nozzle falls.
    OpenAir = "open_air", Warns;
    /// E is asked to go faster than it can.
    ESpeed = "e_speed", Warns;
    /// More clay is asked for than the pump can give.
    Flow = "flow", Warns;
    /// The firmware refuses E while it is cold.
    ColdExtrusion = "cold_extrusion", Warns;
    /// The firmware refuses so long a way of E in one move.
    LongPrime = "long_prime", Warns;
    /// `G90` ends `M83` in some firmware.
    LostRelativeE = "lost_relative_e", Warns;
    /// Clay is laid before any speed was set.
    NoSpeed = "no_speed", Warns;
}
