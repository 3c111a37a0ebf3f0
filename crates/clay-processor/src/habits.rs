//! Says why the two models differ.

use gcode::{Code, Line};

use crate::letter::{Letter, Movement};
use crate::machine::Machine;
use crate::motion::Class;
use crate::report::{DialectNote, Habit};

/// How often something was seen, and where first.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Count {
    pub(crate) count: usize,
    pub(crate) first: usize,
}

impl Count {
    #[inline]
    pub(crate) fn add(&mut self, index: usize) {
        self.add_all(&Self { count: 1, first: index });
    }

    #[inline]
    pub(crate) fn add_all(&mut self, later: &Self) {
        if self.count == 0 {
            self.first = later.first;
        }
        self.count += later.count;
    }
}

/// What a file does that the letter model may read otherwise.
#[derive(Clone, Debug, Default)]
pub(crate) struct Habits {
    rapid_z: Count,
    repeated_z: Count,
    silent_e: Count,
    repeated_position: Count,
    arcs: Count,
    relative_z: Count,
    inches: Count,
    shifted_z: Count,
    unread: Count,
}

impl Habits {
    /// Watches a move go by: what it does to the clay and what its words say.
    #[inline]
    pub(crate) fn watch_move(
        &mut self,
        index: usize,
        line: &Line,
        class: Class,
        movement: Option<Movement>,
        machine: &Machine,
    ) {
        let words = &line.words;
        let has_z = words.has(b'Z');
        if has_z {
            match class {
                Class::Flat => self.repeated_z.add(index),
                Class::Travel | Class::DiagonalTravel | Class::Vertical
                    if line.command == Some(Code::g(0)) =>
                {
                    self.rapid_z.add(index);
                }
                _ => {}
            }
            if machine.motion.is_relative() {
                self.relative_z.add(index);
            }
            if machine.motion.is_inches() {
                self.inches.add(index);
            }
        }
        let is_arc = line.command == Some(Code::g(2)) || line.command == Some(Code::g(3));
        if is_arc && class != Class::Still {
            self.arcs.add(index);
        }
        match class {
            Class::Flat | Class::Slope => {}
            Class::Travel | Class::DiagonalTravel | Class::Vertical if words.has(b'E') => {
                self.silent_e.add(index)
            }
            _ => {
                if movement.is_some_and(|movement| !agree(class, movement)) {
                    self.repeated_position.add(index);
                }
            }
        }
        if line.unreadable || words.has_bare() {
            self.unread.add(index);
        }
    }

    /// Does as [`watch_move`](Self::watch_move) with a readable `G1` that has E and no Z.
    #[inline(always)]
    pub(crate) fn watch_stroke(&mut self, index: usize, class: Class) {
        if matches!(class, Class::Travel | Class::DiagonalTravel | Class::Vertical) {
            self.silent_e.add(index);
        }
    }

    /// Watches a line that moves nothing.
    #[inline]
    pub(crate) fn watch_still(&mut self, index: usize, line: &Line) {
        if line.command == Some(Code::g(92)) && line.words.has(b'Z') {
            self.shifted_z.add(index);
        }
    }

    /// The sentences about a whole file.
    pub(crate) fn notes(&self, letter: &Letter, machine: &Machine) -> Vec<DialectNote> {
        let (by_letter, by_machine) = (&letter.model, &machine.model);
        let layers = by_letter.layers != by_machine.layers;
        let spirals = by_letter.spirals != by_machine.spirals;
        let movements = by_letter.horizontal_movement_without_extrusion
            != by_machine.horizontal_movement_without_extrusion
            || by_letter.vertical_movement_without_extrusion
                != by_machine.vertical_movement_without_extrusion
            || by_letter.diagonal_movement_without_extrusion
                != by_machine.diagonal_movement_without_extrusion;
        let any = layers || spirals || movements;

        let reasons = [
            (layers, Habit::RapidLayerChange, self.rapid_z),
            (layers || spirals, Habit::RepeatedZ, self.repeated_z),
            (layers, Habit::LeadingTravel, letter.led),
            (layers, Habit::TrailingLine, letter.trailed),
            (layers, Habit::Parking, letter.idle),
            (layers, Habit::Hop, machine.hops),
            (spirals, Habit::RoundedZ, machine.spirals.rounded),
            (spirals, Habit::ResetInSpiral, machine.spirals.resets),
            (movements, Habit::SilentE, self.silent_e),
            (movements, Habit::RepeatedPosition, self.repeated_position),
            (any, Habit::Arcs, self.arcs),
            (any, Habit::RelativeZ, self.relative_z),
            (any, Habit::Inches, self.inches),
            (any, Habit::ShiftedZ, self.shifted_z),
        ];
        let mut notes: Vec<DialectNote> = reasons
            .into_iter()
            .filter(|(differs, _, seen)| *differs && seen.count > 0)
            .map(|(_, habit, seen)| note(habit, seen))
            .collect();
        if any && notes.is_empty() {
            notes.push(DialectNote {
                habit: Habit::Other,
                index: 0,
                count: 1,
                text: format!(
                    "the letter finds {} layers and {} spirals, the machine {} and {}, and no known habit explains it",
                    by_letter.layers.len(),
                    by_letter.spirals.len(),
                    by_machine.layers.len(),
                    by_machine.spirals.len(),
                ),
            });
        }
        if self.unread.count > 0 {
            notes.push(note(Habit::UnreadWord, self.unread));
        }
        notes
    }
}

/// Whether a line does what its words say.
fn agree(class: Class, movement: Movement) -> bool {
    matches!(
        (class, movement),
        (Class::Travel, Movement::Horizontal)
            | (Class::Vertical, Movement::Vertical)
            | (Class::DiagonalTravel, Movement::Diagonal)
    )
}

fn note(habit: Habit, seen: Count) -> DialectNote {
    let what = match habit {
        Habit::RapidLayerChange => "`G0` with Z changes the height; by the letter only a `G1` begins a layer",
        Habit::RepeatedZ => {
            "a printing line repeats the Z it is at; by the letter Z makes it a spiral or a new layer"
        }
        Habit::LeadingTravel => {
            "a layer begins with a `G1` that does not print; by the letter it belongs to the layer"
        }
        Habit::TrailingLine => {
            "a layer ends with a `G1` that does not print; by the letter it belongs to the layer"
        }
        Habit::Parking => {
            "`G1` lines after a Z print nothing, as when parking; by the letter they are a layer"
        }
        Habit::Hop => "the nozzle lifts and comes back to the layer; by the letter each island is a layer",
        Habit::RoundedZ => {
            "a spiral line has the height of the one before, by rounding; by the letter it may end there"
        }
        Habit::ResetInSpiral => "`G92` stands inside a spiral; by the letter the spiral ends there",
        Habit::SilentE => "a travel carries an E that brings no clay; by the letter it is no travel",
        Habit::RepeatedPosition => "a move names an axis that is there already; by the letter the axis moves",
        Habit::Arcs => "the nozzle goes along an arc (`G2`, `G3`); by the letter only straight lines count",
        Habit::RelativeZ => "Z is relative (`G91`); by the letter it is the height",
        Habit::Inches => "Z is in inches (`G20`); by the letter it is as written",
        Habit::ShiftedZ => "`G92` sets the height; by the letter Z goes on from the last word",
        Habit::Other => "the models differ",
        Habit::UnreadWord => "a word of a move has no number that can be read and is ignored",
    };
    let Count { count, first } = seen;
    let place = match count {
        1 => format!("line {}", first + 1),
        _ => format!("line {} and {} more", first + 1, count - 1),
    };
    DialectNote { habit, index: first, count, text: format!("{place}: {what}") }
}
