//! Says what the words of a line order, in the order in which RS274 obeys them.

use super::block::{Block, CodeWord, Few, bit, bits};
use super::motion::{AXES, Manner, Motion};
use super::{Comments, FeedMode, Parser, not_in_flavor};
use crate::command::{By, Command, Plane, Span, Spin, Step};
use crate::diagnostic::Problem;
use crate::flavor::{DwellUnit, Extruder};
use crate::given::Given;
use crate::parameters::LengthUnit;

/// What the controller of the BAAM does if `M69` says nothing: 250 revolutions a minute, for 60 seconds.
const PURGE_RPM: f64 = 250.0;
const PURGE_SECONDS: f64 = 60.0;

/// The fastest spindle that is no mistake, revolutions per minute.
const FASTEST: f64 = 1e6;

/// Something that a line orders, and when.
#[derive(Clone, Copy, Debug, Default)]
struct Item {
    rank: u8,
    what: What,
}

#[derive(Clone, Copy, Debug, Default)]
enum What {
    #[default]
    Feed,
    Spindle,
    Tool,
    Bead(f64),
    Name(usize),
    Code(CodeWord),
    Motion(Motion),
}

/// The order of RS274: feed mode, feed, speed, tool, change, spindle, coolant, others, dwell, plane, units, offsets,
/// systems, distance, origin, motion, stop.
fn rank(code: CodeWord) -> u8 {
    match (code.letter, code.tenths) {
        (b'G', 930 | 940 | 950) => 0,
        (b'M', 60) => 4,
        (b'M', 70 | 80 | 90) => 6,
        (b'G', 40) => 8,
        (b'G', 170 | 180 | 190) => 9,
        (b'G', 200 | 210 | 700 | 710) => 10,
        (b'G', 530..=599 | 5000..=5999) => 12,
        (b'G', 900 | 901 | 910 | 911) => 13,
        (b'G', _) if takes_axes(code) => 14,
        (b'G', _) => 11,
        (b'M', 0 | 10 | 20 | 300 | 600) => 16,
        _ => 7,
    }
}

/// Codes that set a mode and have no words of their own.
fn is_bare(code: CodeWord) -> bool {
    match code.letter {
        b'G' => matches!(
            code.tenths,
            0 | 10 | 20 | 30 | 170 | 180 | 190 | 200 | 210 | 400 | 490 | 530..=599 | 610 | 700 | 710 | 800
                | 900 | 901 | 910 | 911 | 930 | 940 | 950 | 980 | 990 | 5000..=5999
        ),
        _ => matches!(
            code.tenths,
            10 | 20 | 30 | 40 | 50 | 60 | 70 | 80 | 90 | 300 | 480 | 490 | 600 | 820 | 830
        ),
    }
}

/// Codes to which the axes of their line belong.
fn takes_axes(code: CodeWord) -> bool {
    code.letter == b'G' && matches!(code.tenths, 100 | 280..=309 | 520 | 920..=929)
}

fn spin_of(code: CodeWord) -> Option<Spin> {
    match (code.letter, code.tenths) {
        (b'M', 30) => Some(Spin::Clockwise),
        (b'M', 40) => Some(Spin::CounterClockwise),
        (b'M', 50) => Some(Spin::Off),
        _ => None,
    }
}

impl Parser<'_> {
    /// Shows the commands of a block.
    pub(super) fn obey<'a>(&mut self, line: &'a [u8], block: Block<'a>, visit: &mut dyn FnMut(Step<'a>)) {
        let number = self.line;
        let mut show = |command| visit(Step { line: number, command });
        let has_code = !block.code.is_empty() || block.text.is_some();
        let comments = self.options.comments;
        if comments == Comments::All || (comments == Comments::Lines && !has_code) {
            block.remarks.as_slice().iter().for_each(|text| show(Command::Comment { text }));
        }
        if let Some((code, text)) = block.text {
            return show(Command::M { tenths: code.tenths, words: self.parameters(text) });
        }
        if !has_code {
            return;
        }
        if block.refused {
            return show(Command::Config { text: block.code });
        }
        for code in block.codes.as_slice().iter().filter(|code| code.letter == b'G') {
            if let Some(unit) = self.flavor.unit_of(code.tenths) {
                self.unit = unit;
            }
        }
        let mut items = self.items(line, &block);
        if items.as_slice().is_empty() {
            return self.obey_nothing(line, &block, &mut show);
        }
        // Stable, so that codes of one rank keep their order.
        items.as_mut_slice().sort_by_key(|item| item.rank);
        for item in items.as_slice() {
            self.obey_item(line, &block, item.what, &mut show);
        }
    }

    /// What the block orders, in the order of its words.
    fn items(&mut self, line: &[u8], block: &Block<'_>) -> Few<Item, 24> {
        let mut items: Few<Item, 24> = Few::default();
        let letters = block.words.letters();
        let codes = block.codes.as_slice();
        let taker = codes.iter().any(|&code| !is_bare(code));
        let explicit = self.explicit_motion(codes);
        let moves = letters & (AXES | bits(b"IJKR")) != 0;
        let goes_on = explicit.is_none() && !taker && letters & AXES != 0 && self.flavor.modal_motion;
        let motion = explicit.or(self.motion.filter(|_| goes_on));

        for &code in codes {
            if code.letter == b'G' && Motion::of(code.tenths).is_some() || spin_of(code).is_some() {
                continue;
            }
            if code.letter == b'G' && code.tenths == 530 && motion.is_some() && moves {
                continue;
            }
            if let Some(motion) = explicit.filter(|_| takes_axes(code) && moves) {
                self.report(0, Problem::Conflict { used: motion.tenths(), dropped: code.tenths });
                continue;
            }
            items.push(Item { rank: rank(code), what: What::Code(code) });
        }
        let spins = codes.iter().any(|&code| spin_of(code).is_some());
        let alone = !taker && motion.is_none();
        if alone && letters & bit(b'F') != 0 {
            items.push(Item { rank: 1, what: What::Feed });
        }
        if !taker && (letters & bit(b'T') != 0 || block.words.is_bare(b'T')) {
            items.push(Item { rank: 3, what: What::Tool });
        }
        if spins || (!taker && letters & bit(b'S') != 0 && self.is_spindle_speed(line, block, motion, moves))
        {
            items.push(Item { rank: 5, what: What::Spindle });
        }
        if let Some(area) = block.bead {
            self.rate = area;
            if area == 0.0 || !moves || !motion.is_some_and(|motion| motion != Motion::Rapid) {
                items.push(Item { rank: 7, what: What::Bead(area) });
            }
        }
        for index in 0..block.names.as_slice().len() {
            items.push(Item { rank: 7, what: What::Name(index) });
        }
        if let Some(motion) = motion {
            items.push(Item { rank: 15, what: What::Motion(motion) });
            if !taker {
                self.report_bare(block);
            }
        }
        items
    }

    /// The last motion word.
    fn explicit_motion(&mut self, codes: &[CodeWord]) -> Option<Motion> {
        let mut found: Option<Motion> = None;
        for code in codes.iter().filter(|code| code.letter == b'G') {
            let Some(motion) = Motion::of(code.tenths) else { continue };
            if let Some(before) = found.filter(|&before| before != motion) {
                self.report(0, Problem::Conflict { used: motion.tenths(), dropped: before.tenths() });
            }
            found = Some(motion);
        }
        if found.is_some_and(|motion| matches!(motion, Motion::Clockwise | Motion::CounterClockwise))
            && !self.flavor.arcs
        {
            self.report(0, not_in_flavor("an arc"));
        }
        found
    }

    /// Whether an S word orders something of its own; as part of a motion it is taken in here.
    fn is_spindle_speed(
        &mut self,
        line: &[u8],
        block: &Block<'_>,
        motion: Option<Motion>,
        moves: bool,
    ) -> bool {
        let Some(motion) = motion else { return true };
        let along = moves && motion != Motion::Rapid;
        let speed = self.turns(line, block);
        match self.flavor.extruder {
            Extruder::Screw if along && speed > 0.0 => {
                self.rate = speed;
                self.speed = speed;
                false
            }
            Extruder::None | Extruder::Amount if along && self.spin != Spin::Off => {
                self.speed = speed;
                false
            }
            Extruder::Amount if self.spin == Spin::Off => {
                self.report_word(line, b'S', Problem::Unused(b'S'));
                false
            }
            _ => true,
        }
    }

    /// The S word in turns per second; the last one if there is none.
    fn turns(&mut self, line: &[u8], block: &Block<'_>) -> f64 {
        match block.words.get(b'S') {
            None => self.speed,
            Some(speed) if !(0.0..=FASTEST).contains(&speed) => {
                self.report_word(line, b'S', Problem::OutOfRange(b'S'));
                self.speed
            }
            Some(speed) => speed / 60.0,
        }
    }

    /// Passes on words that order nothing here.
    fn obey_nothing<'a>(&mut self, line: &[u8], block: &Block<'a>, show: &mut dyn FnMut(Command<'a>)) {
        let letters = block.words.letters();
        if letters & (AXES | bit(b'E')) != 0 {
            self.report(block.start, Problem::NoMotion);
        } else {
            let unused = (b'A'..=b'Z').filter(|&letter| letters & bit(letter) != 0);
            unused.for_each(|letter| self.report_word(line, letter, Problem::Unused(letter)));
        }
        self.report_bare(block);
        show(Command::Config { text: block.code });
    }

    fn report_bare(&mut self, block: &Block<'_>) {
        for &(letter, index) in block.bare.as_slice().iter().filter(|(letter, _)| *letter != b'T') {
            self.report(index, Problem::NoNumber(letter));
        }
    }

    fn obey_item<'a>(
        &mut self,
        line: &'a [u8],
        block: &Block<'a>,
        what: What,
        show: &mut dyn FnMut(Command<'a>),
    ) {
        match what {
            What::Feed => {
                if let Some(feed) = self.feed(&block.words, line).get() {
                    show(Command::FeedRate { feed });
                }
            }
            What::Spindle => show(self.spindle(line, block)),
            What::Tool => {
                self.tool = tool_number(block).unwrap_or(self.tool);
                show(Command::Config { text: tool_text(block) });
            }
            What::Bead(area) => show(self.bead(area)),
            What::Name(index) => {
                let text = block.names.as_slice().get(index).copied().unwrap_or_default();
                if is_assignment_like(text, self.flavor.bead_off.as_bytes()) {
                    self.rate = 0.0;
                    show(self.bead(0.0));
                } else {
                    show(Command::Config { text });
                }
            }
            What::Code(code) => {
                let command = self.code(line, block, code);
                show(command);
            }
            What::Motion(motion) => {
                self.motion = Some(motion);
                let machine = block.machine
                    || block.codes.as_slice().iter().any(|code| code.letter == b'G' && code.tenths == 530);
                let manner = Manner { line, code: block.code, radius: block.radius, machine };
                let none = Command::G { tenths: motion.tenths(), words: self.parameters(b"") };
                show(self.motion_command(motion, &block.words, manner).unwrap_or(none));
            }
        }
    }

    fn bead<'a>(&self, deposit: f64) -> Command<'a> {
        Command::Extrude { deposit, by: By::Area, feed: Given::NONE, tool: self.tool }
    }

    /// Switches the spindle, or the screw that stands in its place.
    fn spindle<'a>(&mut self, line: &[u8], block: &Block<'a>) -> Command<'a> {
        self.speed = self.turns(line, block);
        let spin = block.codes.as_slice().iter().rev().find_map(|&code| spin_of(code));
        if self.flavor.extruder == Extruder::Screw {
            self.rate = match spin {
                Some(Spin::Off) => 0.0,
                Some(Spin::CounterClockwise) => -self.speed,
                Some(Spin::Clockwise) | None => self.speed,
            };
            return Command::Extrude {
                deposit: self.rate,
                by: By::Speed,
                feed: Given::NONE,
                tool: self.tool,
            };
        }
        self.spin = spin.unwrap_or(self.spin);
        let speed = if block.words.has(b'S') { Given::new(self.speed) } else { Given::NONE };
        Command::Mill { speed, spin: self.spin }
    }

    /// The command of a code that is neither motion nor spindle.
    fn code<'a>(&mut self, line: &[u8], block: &Block<'a>, code: CodeWord) -> Command<'a> {
        let words = self.parameters(if is_bare(code) { b"" } else { behind(block, code) });
        if code.letter == b'M' {
            if code.tenths == self.flavor.purge_code && code.tenths != 0 {
                return self.purge(line, block);
            }
            return Command::M { tenths: code.tenths, words };
        }
        match code.tenths {
            40 => return self.dwell(line, block),
            170 => self.plane = Plane::Xy,
            180 => self.plane = Plane::Zx,
            190 => self.plane = Plane::Yz,
            900 => return Command::AbsolutePosition,
            910 => return Command::IncrementalPosition,
            901 => self.absolute_centres = true,
            911 => self.absolute_centres = false,
            540..=590 if code.tenths.is_multiple_of(10) => {
                return Command::WorkCoordinates { system: code.tenths / 10 - 53 };
            }
            591..=593 => return Command::WorkCoordinates { system: code.tenths - 584 },
            5000..=5990 if self.flavor.named_words && code.tenths.is_multiple_of(10) => {
                return Command::WorkCoordinates { system: code.tenths / 10 - 500 };
            }
            930 | 940 | 950 if self.flavor.feed_modes => {
                self.feed_mode = match code.tenths {
                    930 => FeedMode::Inverse,
                    950 => FeedMode::PerTurn,
                    _ => FeedMode::PerMinute,
                };
            }
            930 | 950 => self.report(0, not_in_flavor("another unit of the feed")),
            200 if self.flavor.unit_of(code.tenths) != Some(LengthUnit::Inch) => {
                self.report(0, not_in_flavor("lengths in inches"));
            }
            _ => {}
        }
        Command::G { tenths: code.tenths, words }
    }

    fn dwell<'a>(&mut self, line: &[u8], block: &Block<'a>) -> Command<'a> {
        let flavor = self.flavor;
        let word =
            flavor.dwell.iter().find_map(|&(letter, unit)| Some((letter, unit, block.words.get(letter)?)));
        let (time, by) = match word {
            Some((letter, unit, value)) if value >= 0.0 => {
                if unit == DwellUnit::DoubtfulSeconds {
                    self.report_word(
                        line,
                        letter,
                        not_in_flavor("this word of a dwell; it is read as seconds"),
                    );
                }
                match unit {
                    DwellUnit::Seconds | DwellUnit::DoubtfulSeconds => (value, Span::Seconds),
                    DwellUnit::Milliseconds => (value / 1000.0, Span::Seconds),
                    DwellUnit::Revolutions => (value, Span::Revolutions),
                }
            }
            _ => {
                self.report(block.start, Problem::NoDuration);
                (0.0, Span::Seconds)
            }
        };
        let deposit_by = match flavor.extruder {
            Extruder::Screw => By::Speed,
            Extruder::Area => By::Area,
            Extruder::Amount | Extruder::None => return Command::Dwell { time, by },
        };
        if self.rate == 0.0 || by == Span::Revolutions {
            return Command::Dwell { time, by };
        }
        Command::Purge { time, deposit: self.rate, by: deposit_by }
    }

    /// `M69` of the BAAM: F revolutions a minute for P seconds.
    fn purge<'a>(&mut self, line: &[u8], block: &Block<'a>) -> Command<'a> {
        for letter in (b'A'..=b'Z').filter(|&letter| !b"FP".contains(&letter) && block.words.has(letter)) {
            self.report_word(line, letter, Problem::Unused(letter));
        }
        let within = |letter, default| {
            block.words.get(letter).filter(|value| (0.0..=FASTEST).contains(value)).unwrap_or(default)
        };
        let deposit = within(b'F', PURGE_RPM) / 60.0;
        Command::Purge { time: within(b'P', PURGE_SECONDS), deposit, by: By::Speed }
    }
}

/// The words that belong to `code`: those behind it, or all if others stand before it.
fn behind<'a>(block: &Block<'a>, code: CodeWord) -> &'a [u8] {
    let is_first = block.codes.as_slice().first().is_some_and(|first| first.end == code.end);
    let index = code.end.saturating_sub(block.start);
    // A word that stands before the first code belongs to it as well.
    let nothing_before = block.code.first().is_some_and(|first| first.eq_ignore_ascii_case(&code.letter));
    let start = if is_first && nothing_before { index } else { 0 };
    block.code.get(start..).unwrap_or_default().trim_ascii()
}

fn tool_number(block: &Block<'_>) -> Option<u16> {
    let number = block.words.get(b'T')?;
    ((0.0..=65535.0).contains(&number) && number.fract() == 0.0).then_some(number as u16)
}

/// The T word and its number.
fn tool_text<'a>(block: &Block<'a>) -> &'a [u8] {
    let start = block.code.iter().position(|byte| matches!(byte, b'T' | b't')).unwrap_or(0);
    let text = block.code.get(start..).unwrap_or_default();
    let next = text.iter().skip(1).position(u8::is_ascii_alphabetic).map_or(text.len(), |index| index + 1);
    text.get(..next).unwrap_or_default().trim_ascii()
}

/// Whether two lines say the same up to an equal sign, in either case.
fn is_assignment_like(text: &[u8], known: &[u8]) -> bool {
    let name = |text: &'_ [u8]| {
        let end = text.iter().position(|&byte| byte == b'=').unwrap_or(text.len());
        text.get(..end).unwrap_or_default().trim_ascii().to_ascii_uppercase()
    };
    !known.is_empty() && name(text) == name(known)
}
