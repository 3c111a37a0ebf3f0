//! Writes the edited file, and follows it as the printer will.
//!
//! Two machines go side by side through an edit: one reads the old file, one what is written. An edit says what a move
//! shall do; what its words must be follows from where the second machine stands and in what modes. So a line needs no
//! change unless it would do something else, and rounding is never carried on: each word makes up for the last.

use gcode::{Kind, Line, Token, Tokens};

use crate::machine::{AXES, Act, Machine, Move};
use crate::tape::Raw;
use crate::words::{Changes, checksum, is_written_alike, rewrite, write_number};

/// Decimals of a length or of E that is computed: a hundredth of a micron, so that what is edited back comes back.
const DECIMALS: u32 = 5;
/// The same in inches.
const DECIMALS_OF_INCHES: u32 = 7;
/// Decimals of a feed.
const FEED_DECIMALS: u32 = 3;

/// What a move shall do.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    /// Where it shall go; an axis of which nothing is said does as the line says.
    pub(crate) to: [Option<f64>; 3],
    /// E of it, mm.
    pub(crate) clay: f64,
    /// mm/min; nothing for whatever holds.
    pub(crate) feed: Option<f64>,
    /// The size of an arc, against the old one.
    pub(crate) arc: f64,
}

impl Aim {
    /// As it was.
    pub(crate) fn same(was: &Move) -> Self {
        Self { to: [None; 3], clay: was.clay, feed: None, arc: 1.0 }
    }
}

/// The file that is being written.
pub(crate) struct Writer {
    pub(crate) out: Vec<u8>,
    pub(crate) machine: Machine,
    line_end: &'static [u8],
    /// Clay that rounding has kept back so far.
    owed: f64,
    numbers: Numbers,
    scratch: Line,
}

/// The numbers in front of the lines, if there are any.
#[derive(Debug, Default)]
struct Numbers {
    /// Of the last line of code, as it was written.
    last: Option<f64>,
    /// Whether that line had a checksum.
    checked: bool,
    /// How much higher the numbers are than they were: by the lines put in and left out.
    shift: f64,
}

impl Writer {
    /// For a file of about so many bytes.
    pub(crate) fn new(bytes: usize, line_end: &'static [u8]) -> Self {
        Self {
            out: Vec::with_capacity(bytes.saturating_add(bytes / 8)),
            machine: Machine::new(),
            line_end,
            owed: 0.0,
            numbers: Numbers::default(),
            scratch: Line::default(),
        }
    }

    /// A line as it is.
    pub(crate) fn keep(&mut self, raw: Raw<'_>, line: &Line) {
        if has_number(raw.text) {
            self.rewrite(raw, Changes::default());
            return;
        }
        self.out.extend_from_slice(raw.text);
        self.out.extend_from_slice(raw.end);
        if line.kind == Kind::Code {
            self.numbers.last = None;
        }
        self.machine.obey(line);
    }

    /// A move, with the words that let it do what it shall. `was` is what it did.
    pub(crate) fn go(&mut self, raw: Raw<'_>, line: &Line, was: &Move, aim: &Aim) {
        let mut changes = Changes::default();
        let decimals = self.decimals();
        self.change_axes(&mut changes, line, aim);
        if aim.arc != 1.0 {
            for letter in *b"IJKR" {
                if let Some(value) = line.words.get(letter) {
                    changes.put(letter, value * aim.arc, decimals);
                }
            }
        }
        let wanted = aim.clay + self.owed;
        match line.words.get(b'E') {
            Some(old) => {
                let new = self.machine.word_of_clay(wanted);
                if !is_written_alike(old, new, decimals) {
                    changes.put(b'E', new, decimals);
                }
            }
            None if aim.clay != was.clay => {
                changes.put(b'E', self.machine.word_of_clay(wanted), decimals);
            }
            None => {}
        }
        if let Some(feed) = aim.feed {
            let scale = self.machine.scale();
            let holds = line.words.get(b'F').map(|feed| feed * scale).or(self.machine.feed());
            if holds.is_none_or(|holds| !is_written_alike(holds / scale, feed / scale, FEED_DECIMALS)) {
                changes.put(b'F', feed / scale, FEED_DECIMALS);
            }
        }
        let given = if changes.is_empty() && !has_number(raw.text) {
            self.numbers.last = None;
            self.out.extend_from_slice(raw.text);
            self.out.extend_from_slice(raw.end);
            self.machine.obey(line)
        } else {
            self.rewrite(raw, changes)
        };
        if let Act::Move(now) = given {
            self.owed = wanted - now.clay;
        }
    }

    /// Whether an axis is there already, but for what rounding has left.
    fn stands_at(&self, axis: usize, place: f64) -> bool {
        let scale = self.machine.scale();
        self.machine.place()[axis]
            .is_some_and(|at| is_written_alike(at / scale, place / scale, self.decimals() - 1))
    }

    fn decimals(&self) -> u32 {
        if self.machine.scale() == 1.0 { DECIMALS } else { DECIMALS_OF_INCHES }
    }

    fn change_axes(&self, changes: &mut Changes, line: &Line, aim: &Aim) {
        let decimals = self.decimals();
        for (axis, letter) in AXES.into_iter().enumerate() {
            let Some(place) = aim.to[axis] else { continue };
            let new = self.machine.word_to(axis, place);
            let differs = match line.words.get(letter) {
                Some(old) => !is_written_alike(old, new, decimals),
                None => !self.stands_at(axis, place),
            };
            if differs {
                changes.put(letter, new, decimals);
            }
        }
    }

    /// A line left out. Its number is left out with it.
    pub(crate) fn leave_out(&mut self, raw: Raw<'_>) {
        if has_number(raw.text) {
            self.numbers.shift -= 1.0;
        }
    }

    /// A line of our own.
    pub(crate) fn insert(&mut self, text: &str) {
        let start = self.out.len();
        let numbered = self.numbers.last.filter(|_| !text.starts_with(';'));
        if let Some(last) = numbered {
            self.out.push(b'N');
            write_number(&mut self.out, last + 1.0, 0);
            self.out.push(b' ');
            self.numbers.last = Some(last + 1.0);
            self.numbers.shift += 1.0;
        }
        self.out.extend_from_slice(text.as_bytes());
        if numbered.is_some() && self.numbers.checked {
            let sum = checksum(self.out.get(start..).unwrap_or_default());
            self.out.extend_from_slice(format!("*{sum}").as_bytes());
        }
        self.out.extend_from_slice(self.line_end);
        self.scratch.read(text.as_bytes());
        self.machine.obey(&self.scratch);
    }

    /// A move of our own, in whatever modes the printer is: to the places named, with so much clay, at so many mm/min.
    pub(crate) fn draw(&mut self, to: [Option<f64>; 3], clay: f64, feed: Option<f64>) {
        let decimals = self.decimals();
        let mut text = b"G1".to_vec();
        let mut put = |letter: u8, value: f64, decimals: u32| {
            text.extend_from_slice(&[b' ', letter]);
            write_number(&mut text, value, decimals);
        };
        for ((axis, letter), place) in AXES.into_iter().enumerate().zip(to) {
            if let Some(place) = place.filter(|&place| !self.stands_at(axis, place)) {
                put(letter, self.machine.word_to(axis, place), decimals);
            }
        }
        let wanted = clay + self.owed;
        if clay != 0.0 {
            put(b'E', self.machine.word_of_clay(wanted), decimals);
        }
        let scale = self.machine.scale();
        if let Some(feed) = feed
            && self.machine.feed().is_none_or(|holds| !is_written_alike(holds, feed, FEED_DECIMALS))
        {
            put(b'F', feed / scale, FEED_DECIMALS);
        }
        if text.len() == 2 {
            return;
        }
        let before = self.machine.e_word() * scale;
        self.insert(&String::from_utf8_lossy(&text));
        if clay != 0.0 {
            self.owed = wanted - (self.machine.e_word() * scale - before);
        }
    }

    /// E is called `value` from here on, so that the words that follow need no change; relative words need none anyway.
    pub(crate) fn call_e(&mut self, value: f64) {
        if !self.machine.is_relative_e() {
            let mut text = b"G92 E".to_vec();
            write_number(&mut text, value / self.machine.scale(), self.decimals());
            self.insert(&String::from_utf8_lossy(&text));
        }
        self.owed = 0.0;
    }

    /// The place of our own lines: a file whose last line has no end gets one before them.
    pub(crate) fn end_line(&mut self) {
        if self.out.last().is_some_and(|&byte| byte != b'\n') {
            self.out.extend_from_slice(self.line_end);
        }
    }

    /// Writes the changed line, reads what was written, and does it.
    fn rewrite(&mut self, raw: Raw<'_>, mut changes: Changes) -> Act {
        self.scratch.read(raw.text);
        let number = number_of(raw.text);
        self.numbers.last = number.map(|number| number + self.numbers.shift);
        if let Some(new) = self.numbers.last {
            self.numbers.checked = raw.text.contains(&b'*');
            if self.numbers.shift != 0.0 && !is_counter_reset(&self.scratch) {
                changes.put(b'N', new, 0);
            } else if is_counter_reset(&self.scratch) {
                self.numbers.shift = 0.0;
                self.numbers.last = number;
            }
        }
        let start = self.out.len();
        if changes.is_empty() {
            self.out.extend_from_slice(raw.text);
        } else {
            rewrite(&mut self.out, raw.text, changes);
            self.scratch.read(self.out.get(start..).unwrap_or_default());
        }
        let act = self.machine.obey(&self.scratch);
        self.out.extend_from_slice(raw.end);
        act
    }
}

/// Whether the line begins with an N.
#[inline]
fn has_number(text: &[u8]) -> bool {
    matches!(text.trim_ascii_start().first(), Some(b'N' | b'n'))
}

fn number_of(text: &[u8]) -> Option<f64> {
    match Tokens::new(text).next() {
        Some(Token::Word { letter: b'N', value, .. }) => value,
        _ => None,
    }
}

/// `M110` sets the number from which the machine counts.
fn is_counter_reset(line: &Line) -> bool {
    line.command == Some(gcode::Code::m(110))
}
