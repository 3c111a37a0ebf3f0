//! From lines to commands.
//!
//! A [`Parser`] goes through a text once and hands each [`Command`] to a visitor; nothing is allocated but diagnostics.
//! It keeps the modal state that is needed to say what a line means (units, plane, motion, what runs), and no position.
//! Nearly every line is a plain move and takes the short way in [`Parser::read`]; all others go through `scan`, which
//! reads words however they are spelled, and `obey`, which says what they order.

mod block;
mod cut;
mod motion;
mod obey;
mod scan;

pub use cut::whole_lines;
pub(crate) use cut::{behind_stray_cr, cut_line};

use crate::command::{Command, Plane, Spin, Step};
use crate::diagnostic::{Diagnostic, Diagnostics, Problem};
use crate::flavor::Flavor;
use crate::line::Line;
use crate::lines::without_bom;
use crate::parameters::{LengthUnit, Parameters};
use motion::{Manner, Motion, PLAIN};
use scan::{before_remark, body_start, not_in_flavor};
use std::borrow::Cow;

/// Which remarks become commands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Comments {
    /// None of them.
    None,
    /// Those that have a line of their own.
    #[default]
    Lines,
    /// All of them, those behind a command before it.
    All,
}

/// How a text is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadOptions {
    /// Which remarks become commands.
    pub comments: Comments,
    /// Lines that begin with `/` are passed over, as with the switch on the machine.
    pub skip_deleted: bool,
    /// The longest line that is read, bytes.
    pub longest_line: u32,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { comments: Comments::Lines, skip_deleted: false, longest_line: 1 << 16 }
    }
}

/// What a feed is written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum FeedMode {
    /// `G94`: length per minute.
    #[default]
    PerMinute,
    /// `G93`: moves per minute.
    Inverse,
    /// `G95`: length per turn of the spindle.
    PerTurn,
}

/// Reads a program, whole or block by block.
///
/// ```
/// use gcode::{Command, Flavor, Parser};
///
/// let flavor = Flavor::named("marlin").expect("built in");
/// let mut parser = Parser::new(flavor);
/// let mut kinds = Vec::new();
/// parser.read(b"G90 G1 X5 F1800\nG1 X9 E.5\n; done", |step| kinds.push((step.line, step.command.kind().name())));
/// assert_eq!(kinds, [(1, "AbsolutePosition"), (1, "Move"), (2, "MoveExtrude"), (3, "Comment")]);
/// assert!(parser.diagnostics().is_empty());
/// ```
#[derive(Clone, Debug)]
pub struct Parser<'f> {
    flavor: &'f Flavor,
    options: ReadOptions,
    diagnostics: Diagnostics,
    /// The line in the file for each line of the text, if they differ.
    lines: &'f [u32],
    /// The line of the text, and of the file.
    count: u32,
    line: u32,
    /// Read again and again.
    plain: Line,

    unit: LengthUnit,
    feed_mode: FeedMode,
    plane: Plane,
    absolute_centres: bool,
    motion: Option<Motion>,
    /// What the extruder keeps doing: turns per second, or mm².
    rate: f64,
    /// The last speed of the spindle, turns per second.
    speed: f64,
    spin: Spin,
    tool: u16,
    /// How often `%` stood alone on a line; what is behind the second is no program.
    tape_marks: u8,
}

impl<'f> Parser<'f> {
    /// A parser at the beginning of a program.
    pub fn new(flavor: &'f Flavor) -> Self {
        Self {
            flavor,
            options: ReadOptions::default(),
            diagnostics: Diagnostics::default(),
            lines: &[],
            count: 0,
            line: 0,
            plain: Line::default(),
            unit: flavor.unit,
            feed_mode: FeedMode::default(),
            plane: Plane::default(),
            absolute_centres: false,
            motion: None,
            rate: 0.0,
            speed: 0.0,
            spin: Spin::Off,
            tool: 0,
            tape_marks: 0,
        }
    }

    /// The same parser with other options.
    pub fn with_options(mut self, options: ReadOptions) -> Self {
        self.options = options;
        self
    }

    /// The same parser for a text whose lines come from elsewhere: `lines` says from where, one for each.
    pub fn with_lines(mut self, lines: &'f [u32]) -> Self {
        self.lines = lines;
        self
    }

    /// The same parser, which knows of these problems already.
    pub(crate) fn with_diagnostics(mut self, diagnostics: Diagnostics) -> Self {
        self.diagnostics = diagnostics;
        self
    }

    /// What is wrong with what was read so far.
    pub fn diagnostics(&self) -> &Diagnostics {
        &self.diagnostics
    }

    /// What is wrong with what was read.
    pub fn into_diagnostics(self) -> Diagnostics {
        self.diagnostics
    }

    /// Reads `text`, which is a program or whole lines of it, and shows every command to `visit`.
    pub fn read<'a>(&mut self, text: &'a [u8], visit: impl FnMut(Step<'a>)) {
        self.run(text, false, visit);
    }

    /// Does as [`read`](Self::read) up to the first problem.
    ///
    /// # Errors
    ///
    /// The first problem. The commands of its line may have been shown.
    pub fn read_strict<'a>(&mut self, text: &'a [u8], visit: impl FnMut(Step<'a>)) -> Result<(), Diagnostic> {
        self.run(text, true, visit);
        self.diagnostics.list().first().cloned().map_or(Ok(()), Err)
    }

    fn run<'a>(&mut self, text: &'a [u8], strict: bool, mut visit: impl FnMut(Step<'a>)) {
        // Apart from the parser, which reads it and changes.
        let mut plain = std::mem::take(&mut self.plain);
        self.run_lines(text, strict, &mut plain, &mut visit);
        self.plain = plain;
    }

    fn run_lines<'a>(
        &mut self,
        text: &'a [u8],
        strict: bool,
        plain: &mut Line,
        visit: &mut impl FnMut(Step<'a>),
    ) {
        let mut rest = if self.count == 0 { without_bom(text) } else { text };
        while !rest.is_empty() {
            if !self.next_line() {
                return;
            }
            rest = match self.read_plain(rest, plain) {
                Some((command, behind)) => {
                    visit(Step { line: self.line, command });
                    behind
                }
                None => {
                    let (line, behind) = cut_line(rest);
                    self.read_any(line, visit);
                    behind
                }
            };
            if strict && !self.diagnostics.is_empty() {
                return;
            }
        }
    }

    /// Goes on to the next line; false if there are too many.
    #[inline(always)]
    fn next_line(&mut self) -> bool {
        let Some(count) = self.count.checked_add(1) else {
            self.report(0, Problem::TooManyLines);
            return false;
        };
        self.count = count;
        self.line = if self.lines.is_empty() { count } else { self.mapped_line() };
        true
    }

    #[cold]
    fn mapped_line(&self) -> u32 {
        let index = self.count as usize - 1;
        self.lines.get(index).or(self.lines.last()).copied().unwrap_or(self.count)
    }

    /// The command of the first line of `text`, if that is a plain move, and what is behind it.
    #[inline(always)]
    fn read_plain<'a>(&mut self, text: &'a [u8], plain: &mut Line) -> Option<(Command<'a>, &'a [u8])> {
        let length = plain.read_plain(text)?;
        let tenths = u16::try_from(plain.command?.thousandths / 100).ok()?;
        let motion = Motion::of(tenths)?;
        if plain.words.letters() & !PLAIN != 0 || self.tape_marks > 1 {
            return None;
        }
        let (line, behind) = text.split_at_checked(length)?;
        let command = self.motion_command(motion, &plain.words, Manner { line, ..Manner::default() })?;
        self.motion = Some(motion);
        Some((command, behind_stray_cr(behind)))
    }

    /// Reads any line.
    fn read_any<'a>(&mut self, line: &'a [u8], visit: &mut dyn FnMut(Step<'a>)) {
        if line.len() > self.options.longest_line as usize {
            return self.report(0, Problem::LineTooLong(self.options.longest_line));
        }
        if self.tape_marks > 1 {
            return;
        }
        let mut start = body_start(line);
        if line.get(start) == Some(&b'/') {
            if self.options.skip_deleted {
                return;
            }
            start += 1 + body_start(line.get(start + 1..).unwrap_or_default());
        }
        let body = line.get(start..).unwrap_or_default();
        let step = |command| Step { line: self.line, command };
        match *body {
            [] => {}
            [b';', ref text @ ..] if self.flavor.semicolon => {
                if self.options.comments != Comments::None {
                    visit(step(Command::Comment { text }));
                }
            }
            [b'%', ref rest @ ..] if rest.trim_ascii().is_empty() => {
                self.tape_marks += 1;
                visit(step(Command::Config { text: b"%" }));
            }
            [b'@' | b'$', ..] | [b'T' | b't', b'?', ..] => self.read_config(body, visit),
            [b'#' | b'{' | b'[', ..] => {
                self.report(start, Problem::Preprocess(Cow::Borrowed("a line that nobody has computed")));
                self.read_config(body, visit);
            }
            [first, second, ..]
                if !self.flavor.named_words
                    && first.is_ascii_alphabetic()
                    && (second.is_ascii_alphabetic() || second == b'_') =>
            {
                self.read_config(body, visit);
            }
            _ => {
                let block = self.scan(line, start);
                self.obey(line, block, visit);
            }
        }
    }

    /// Passes on a line that only the machine knows.
    fn read_config<'a>(&mut self, body: &'a [u8], visit: &mut dyn FnMut(Step<'a>)) {
        let (text, remark) = before_remark(body, self.flavor.quotes);
        if let Some(text) = remark
            && self.options.comments == Comments::All
        {
            visit(Step { line: self.line, command: Command::Comment { text } });
        }
        visit(Step { line: self.line, command: Command::Config { text } });
    }

    fn parameters<'a>(&self, text: &'a [u8]) -> Parameters<'a> {
        Parameters::new(text, self.unit)
    }

    /// Tells of a problem at the byte `index` of the line.
    #[cold]
    fn report(&mut self, index: usize, kind: Problem) {
        let column = u32::try_from(index).map_or(u32::MAX, |index| index.saturating_add(1));
        self.diagnostics.push(Diagnostic { line: self.line, column, kind });
    }

    /// Tells of a problem at the word of `letter`.
    #[cold]
    fn report_word(&mut self, line: &[u8], letter: u8, kind: Problem) {
        let index = line.iter().rposition(|byte| byte.eq_ignore_ascii_case(&letter)).unwrap_or(0);
        self.report(index, kind);
    }
}

#[cfg(test)]
mod tests;
