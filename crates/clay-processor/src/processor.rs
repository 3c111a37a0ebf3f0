//! Feeds both models line by line.

use gcode::{Code, Kind, Line, find_byte, without_bom, without_cr};

use crate::comments::Comments;
use crate::habits::Habits;
use crate::letter::Letter;
use crate::machine::Machine;
use crate::motion::{Class, Motion};
use crate::report::Report;
use crate::verdict::{Judge, Limits};

/// What is in a whole file.
pub fn process(text: &[u8]) -> Report {
    let mut processor = Processor::new(Options::default());
    processor.push(text);
    processor.finish()
}

/// What a file does not say about the printer it is for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// `G90` and `G91` hold for E too, as in Marlin. Otherwise E obeys `M82` and `M83` alone.
    pub e_follows_g90: bool,
    /// What the file is held against.
    pub limits: Limits,
}

/// Takes a file piece by piece, for instance while it is written. Keeps its results and no text but an unfinished line.
///
/// ```
/// use clay_processor::{Options, Processor};
///
/// let mut processor = Processor::new(Options::default());
/// processor.push(b"G1 Z1\nG1 X1");
/// processor.push(b"0 E1\nG1 X0 E2");
/// assert_eq!(processor.finish().machine.layers.len(), 1);
/// ```
#[derive(Clone, Debug)]
pub struct Processor {
    line: Line,
    index: usize,
    /// The beginning of a line whose end has not come yet.
    unfinished: Vec<u8>,
    comments: Comments,
    letter: Letter,
    machine: Machine,
    habits: Habits,
}

impl Default for Processor {
    fn default() -> Self {
        Self::new(Options::default())
    }
}

impl Processor {
    /// A processor at the beginning of a file.
    pub fn new(options: Options) -> Self {
        Self {
            line: Line::default(),
            index: 0,
            unfinished: Vec::new(),
            comments: Comments::default(),
            letter: Letter::default(),
            machine: Machine::new(
                Motion::new(options.e_follows_g90),
                Judge::new(options.limits, options.e_follows_g90),
                options.limits.bead_width,
            ),
            habits: Habits::default(),
        }
    }

    /// Takes the next piece of the file. It may end anywhere.
    pub fn push(&mut self, text: &[u8]) {
        let mut rest = self.take_to_end(text);
        loop {
            let length = if let Some(length) = self.line.read_plain(rest) {
                self.follow();
                length
            } else if let Some(end) = find_byte(b'\n', rest) {
                let (line, _) = rest.split_at(end);
                self.take(without_cr(line));
                end + 1
            } else {
                break;
            };
            let Some(behind) = rest.get(length..) else { break };
            rest = behind;
        }
        self.unfinished.extend_from_slice(rest);
    }

    /// Takes the next whole line, without its LF. What [`push`](Self::push) left unfinished is a line before it.
    pub fn feed_line(&mut self, line: &[u8]) {
        if !self.unfinished.is_empty() {
            self.take_unfinished();
        }
        self.take(without_cr(line));
    }

    /// The file is at its end.
    pub fn finish(mut self) -> Report {
        // A byte order mark alone is an empty file.
        let is_line = self.index > 0 || !without_bom(&self.unfinished).is_empty();
        if !self.unfinished.is_empty() && is_line {
            self.take_unfinished();
        }
        self.letter.finish();
        self.machine.finish();
        let notes = self.habits.notes(&self.letter, &self.machine);

        let (head, tail) = self.comments.ends(self.index);
        let (mut letter, mut machine) = (self.letter.model, self.machine.model);
        for model in [&mut letter, &mut machine] {
            model.first_part_comments_end = head;
            model.last_part_comments_start = tail;
        }
        let pitches = self.machine.spirals.pitches;
        let (verdicts, interruptions) = self.machine.judge.finish(&machine, &pitches);
        Report {
            letter,
            machine,
            notes,
            lines: self.index,
            extruding_lines: self.machine.extruding_lines,
            interruptions,
            pitches,
            verdicts,
        }
    }

    /// Takes the line that is unfinished, if `text` ends it; returns what is behind it.
    fn take_to_end<'a>(&mut self, text: &'a [u8]) -> &'a [u8] {
        if self.unfinished.is_empty() {
            return text;
        }
        let Some(end) = find_byte(b'\n', text) else { return text };
        let (line, rest) = text.split_at(end);
        self.unfinished.extend_from_slice(line);
        self.take_unfinished();
        rest.get(1..).unwrap_or_default()
    }

    fn take_unfinished(&mut self) {
        let mut line = std::mem::take(&mut self.unfinished);
        self.take(without_cr(&line));
        line.clear();
        self.unfinished = line;
    }

    #[inline(never)]
    fn take(&mut self, text: &[u8]) {
        let text = if self.index == 0 { without_bom(text) } else { text };
        self.line.read(text);
        self.follow();
    }

    /// Feeds the models with the line that was read.
    #[inline(always)]
    fn follow(&mut self) {
        if is_stroke(&self.line) {
            self.follow_stroke();
        } else {
            self.follow_any();
        }
    }

    /// Does what [`follow_any`](Self::follow_any) does, for a line that prints where the nozzle is high already: nearly
    /// every line of a file, and most of what the models ask of a line has one answer.
    #[inline(always)]
    fn follow_stroke(&mut self) {
        self.comments.feed(self.index, Kind::Code);
        let class = self.machine.feed_straight(self.index, &self.line.words);
        self.letter.feed_stroke(self.index, matches!(class, Class::Flat | Class::Slope));
        self.habits.watch_stroke(self.index, class);
        self.index += 1;
    }

    #[inline(never)]
    fn follow_any(&mut self) {
        self.comments.feed(self.index, self.line.kind);
        let class = self.machine.feed(self.index, &self.line);
        let prints = matches!(class, Some(Class::Flat | Class::Slope));
        let movement = self.letter.feed(self.index, &self.line, prints);
        match class {
            Some(class) => self.habits.watch_move(self.index, &self.line, class, movement, &self.machine),
            None => self.habits.watch_still(self.index, &self.line),
        }
        self.index += 1;
    }
}

/// Whether `line` is a readable `G1` that has E and no Z.
#[inline(always)]
fn is_stroke(line: &Line) -> bool {
    let words = &line.words;
    line.command == Some(Code::g(1))
        && words.has(b'E')
        && !words.has(b'Z')
        && !words.has_bare()
        && !line.unreadable
}

#[cfg(test)]
mod tests {
    use gcode::lines;
    use proptest::prelude::*;

    use super::*;

    /// Strokes, plain lines and others.
    fn text() -> impl Strategy<Value = String> {
        let stroke = "G1 X[0-3][.][0-9]{1,3} Y-?[0-2] E[.0-2]{1,2}";
        let words = "( [XYZEFIJ]-?[0-2]([.][0-9]{1,3})?){0,5}";
        let command = "(G[0-3]|G1|G28|G9[0-2]|M8[23]|G2[01]|g1|N1 G1|M106|;TYPE:a)";
        let line = prop_oneof![
            3 => stroke.prop_map(|line| line),
            3 => words.prop_map(|words| format!("G1{words}")),
            2 => (command, words).prop_map(|(command, words)| command + &words),
            1 => "(G1 [XZE]?1?[ é]?Z?|;|\\(a\\)G1 E|)",
        ];
        prop::collection::vec(line, 0..60).prop_map(|lines| lines.join("\n"))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn the_short_way_finds_what_the_long_way_does(text in text(), e_follows_g90: bool) {
            let mut short = Processor::new(Options { e_follows_g90, ..Options::default() });
            let mut long = short.clone();
            short.push(text.as_bytes());
            for line in lines(text.as_bytes()) {
                long.line.read(line);
                long.follow_any();
            }
            prop_assert_eq!(short.finish(), long.finish());
        }
    }
}
