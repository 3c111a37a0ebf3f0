//! The results.

use crate::verdict::{Severity, Verdict};

/// What [`process`](crate::process()) found in a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// The words as they are written.
    pub letter: Model,
    /// What the machine does.
    pub machine: Model,
    /// Why the two differ; empty if they agree.
    pub notes: Vec<DialectNote>,
    /// Lines of the file.
    pub lines: usize,
    /// Lines that print, in the machine model.
    pub extruding_lines: usize,
    /// Breaks in the printing, in the machine model.
    pub interruptions: Interruptions,
    /// How the spirals of the machine model climb, in their order.
    pub pitches: Vec<Pitch>,
    /// What is wrong with the file, the worst first.
    pub verdicts: Vec<Verdict>,
}

impl Report {
    /// Whether the file may be printed: no verdict forbids it.
    pub fn ok(&self) -> bool {
        self.verdicts.iter().all(|verdict| verdict.severity != Severity::Forbids)
    }
}

/// One way to see the file. Indices are lines, counted from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// The last line of the comments and blank lines that the file begins with; nothing if no comment is among them.
    pub first_part_comments_end: Option<usize>,
    /// The first line of the comments and blank lines that the file ends with; nothing if no comment is among them.
    pub last_part_comments_start: Option<usize>,
    /// Letter: the largest Z word of a move (`G0` to `G3`), as written. Machine: the largest Z at the end of a printing
    /// move, mm. 0 if there is none.
    pub max_height: f64,
    /// In the order of the file.
    pub layers: Vec<Run>,
    /// In the order of the file.
    pub spirals: Vec<Run>,
    /// Movements in XY at one height.
    pub horizontal_movement_without_extrusion: Vec<Horizontal>,
    /// Movements in Z alone.
    pub vertical_movement_without_extrusion: Vec<Vertical>,
    /// Movements in XY and Z at once.
    pub diagonal_movement_without_extrusion: Vec<Diagonal>,
}

/// The lines of a layer or a spiral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// The first line of it.
    pub start_index: usize,
    /// The last line of it.
    pub end_index: usize,
    /// Of a layer: its Z. Of a spiral: Z after its first line. Nothing if Z is unknown.
    pub height: Option<f64>,
}

/// A movement in XY without extrusion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Horizontal {
    /// The line.
    pub index: usize,
    /// Nothing if Z is unknown.
    pub height: Option<f64>,
}

/// A movement in Z without extrusion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertical {
    /// The line.
    pub index: usize,
    /// Z before; nothing if unknown.
    pub from: Option<f64>,
    /// Z after; nothing if unknown, as when the move is relative to an unknown height.
    pub to: Option<f64>,
}

/// A movement in XY and Z without extrusion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagonal {
    /// The line.
    pub index: usize,
}

/// Groups of movements without extrusion that have printing before and after them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interruptions {
    /// How many groups.
    pub count: usize,
    /// The length of all groups, mm.
    pub length: f64,
    /// The length of the longest group, mm.
    pub longest: f64,
    /// The first line of the longest group.
    pub longest_index: Option<usize>,
    /// The groups that go where no clay stands below, within three layers.
    pub open_air: Vec<Crossing>,
}

/// An interruption over open air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The first line of the group.
    pub index: usize,
    /// How far it goes over open air, mm.
    pub length: f64,
}

/// How a spiral climbs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pitch {
    /// How often it goes round: its height in usual turns; 0 if it makes no whole turn.
    pub turns: f64,
    /// How much it usually rises in a whole turn, mm; nothing if it makes none.
    pub rise: Option<f64>,
    /// In how many turns it came back above itself, so that their rise could be measured. Where islands end and walls
    /// lean by nearly a bead a turn, it does not.
    pub measured: usize,
    /// Where it lies highest above the turn below, for more than a corner; nothing if it never passes above itself.
    pub steepest: Option<Steep>,
    /// Z at its end, mm; nothing if it is unknown.
    pub top: Option<f64>,
}

/// A place in a spiral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steep {
    /// How far the thread lies above the turn below it, mm.
    pub rise: f64,
    /// The line.
    pub index: usize,
    /// Z at the end of the line, mm; nothing if it is unknown.
    pub height: Option<f64>,
}

/// A difference between the two models and the habit of the file that causes it.
#[derive(Clone, Debug, PartialEq)]
pub struct DialectNote {
    /// Which habit.
    pub habit: Habit,
    /// The first line of it, counted from 0.
    pub index: usize,
    /// How often it was seen.
    pub count: usize,
    /// A sentence for the potter.
    pub text: String,
}

/// Ways to write G-code that the letter model reads otherwise than a machine does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Habit {
    /// Z changes with `G0`, which the letter model's layers pass over.
    RapidLayerChange,
    /// Printing lines at one height repeat their Z.
    RepeatedZ,
    /// Layers of the letter model begin with a travel.
    LeadingTravel,
    /// Layers of the letter model end with a line that does not print.
    TrailingLine,
    /// Layers of the letter model in which nothing is printed, such as parking.
    Parking,
    /// The nozzle lifts and comes back to the same layer.
    Hop,
    /// Spiral lines in which Z is left out because rounding did not change it.
    RoundedZ,
    /// The position is set (`G92`) in the middle of a spiral.
    ResetInSpiral,
    /// Travels carry an E that brings no clay.
    SilentE,
    /// Moves name an axis that is there already.
    RepeatedPosition,
    /// Arcs, printed or not.
    Arcs,
    /// Z is relative.
    RelativeZ,
    /// Lengths are in inches.
    Inches,
    /// The height is set with `G92`.
    ShiftedZ,
    /// None of these explains a difference.
    Other,
    /// A word of a move has no number, or one that cannot be read, and is ignored; said even if the models agree.
    UnreadWord,
}
