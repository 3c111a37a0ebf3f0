//! Programs that compute: variables, expressions, branches, loops and calls become plain lines.
//!
//! A program is cut into [statements](statement) first, whose jumps are linked once; then it is [run](run), and what it
//! emits is a text of plain lines, each with the line of the file it comes from. Dialects differ in how a statement and an
//! [expression](expression) are spelled, and hardly in what they do, so there is one interpreter for all of them. It
//! opens no file, and every loop, call and output is bounded by [`Limits`].
//!
//! A text in which nothing is to be computed is passed on as it is, without a copy.

mod expression;
mod run;
mod statement;
mod variables;

use crate::diagnostic::{Diagnostic, Diagnostics, Problem};
use crate::flavor::{Flavor, Variables};
use crate::parse::{Parser, cut_line};
use run::Run;
use statement::Statements;
use std::borrow::Cow;

/// How far a program may go. Beyond a limit is an error, never a shorter program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Lines that are emitted.
    pub lines: u64,
    /// Bytes that are emitted.
    pub bytes: u64,
    /// Lines that are run.
    pub steps: u64,
    /// Turns of one loop, and jumps backwards.
    pub turns: u64,
    /// Turns of a loop in which nothing changes and nothing is emitted.
    pub idle: u64,
    /// Calls within calls.
    pub depth: usize,
    /// Variables.
    pub variables: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            lines: 50_000_000,
            bytes: 1 << 30,
            steps: 200_000_000,
            turns: 10_000_000,
            idle: 1_000_000,
            depth: 32,
            variables: 65_536,
        }
    }
}

/// What is known before a program begins.
#[derive(Clone, Debug)]
pub struct Preprocessor<'f> {
    flavor: &'f Flavor,
    limits: Limits,
    presets: Vec<(u32, f64)>,
}

/// A program of plain lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Program<'a> {
    /// Its text; that of the file if nothing had to be computed.
    pub text: Cow<'a, [u8]>,
    /// The line of the file for each line of the text; empty if they are the same.
    pub lines: Vec<u32>,
    /// What is doubtful about it.
    pub diagnostics: Diagnostics,
}

impl Program<'_> {
    /// A parser for [`text`](Self::text), which names the lines of the file.
    pub fn parser<'p>(&'p self, flavor: &'p Flavor) -> Parser<'p> {
        Parser::new(flavor).with_lines(&self.lines).with_diagnostics(self.diagnostics.clone())
    }
}

/// Computes the plain lines of `text`.
///
/// # Errors
///
/// Whatever stops the machine: an expression without a value, a jump to nowhere, a limit.
///
/// ```
/// use gcode::{Flavor, preprocess};
///
/// let flavor = Flavor::named("rs274").expect("built in");
/// let text = b"#1=0\no1 while [#1 LT 2]\nG1 X[#1 * 5]\n#1=[#1 + 1]\no1 endwhile\n";
/// let program = preprocess(text, flavor)?;
/// assert_eq!(&*program.text, b"G1 X0\nG1 X5\n");
/// assert_eq!(program.lines, [3, 3]);
/// # Ok::<(), gcode::Diagnostic>(())
/// ```
pub fn preprocess<'a>(text: &'a [u8], flavor: &Flavor) -> Result<Program<'a>, Diagnostic> {
    Preprocessor::new(flavor).run(text)
}

impl<'f> Preprocessor<'f> {
    /// One that knows nothing but the flavor.
    pub fn new(flavor: &'f Flavor) -> Self {
        Self { flavor, limits: Limits::default(), presets: Vec::new() }
    }

    /// The same with other limits.
    pub fn with_limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// The same with a value for the variable `#number` or `Rnumber`, as a machine keeps from one program to the next.
    pub fn with_variable(mut self, number: u32, value: f64) -> Self {
        self.presets.push((number, value));
        self
    }

    /// Computes the plain lines of `text`.
    ///
    /// # Errors
    ///
    /// Those of [`preprocess`].
    pub fn run<'a>(&self, text: &'a [u8]) -> Result<Program<'a>, Diagnostic> {
        if !computes(text, self.flavor.variables) {
            let diagnostics = unsupported(text, self.flavor.variables);
            return Ok(Program { text: Cow::Borrowed(text), lines: Vec::new(), diagnostics });
        }
        let statements = Statements::read(text, self.flavor.variables)?;
        Run::new(&statements, self.flavor, self.limits, &self.presets)?.run()
    }
}

/// Whether anything in `text` may have to be computed.
fn computes(text: &[u8], dialect: Variables) -> bool {
    let mut rest = text;
    let mut any = |is: fn(&[u8]) -> bool| {
        while !rest.is_empty() {
            let (line, behind) = cut_line(rest);
            rest = behind;
            if is(line) {
                return true;
            }
        }
        false
    };
    match dialect {
        Variables::None | Variables::RepRap => false,
        Variables::Rs274 | Variables::Fanuc => any(|line| {
            let start = line.trim_ascii_start();
            line.iter().any(|byte| matches!(byte, b'#' | b'['))
                || matches!(start, [b'O' | b'o' | b'W' | b'w', ..])
                || matches!(start, [b'G' | b'g', b'O' | b'o' | b'6', ..])
        }),
        Variables::Siemens => any(|line| {
            let start = line.trim_ascii_start();
            !start.starts_with(b";")
                && (line.iter().any(|byte| matches!(byte, b'=' | b':' | b'['))
                    || statement::has_siemens_keyword(start))
        }),
    }
}

/// Lines of a language that is not computed here.
fn unsupported(text: &[u8], dialect: Variables) -> Diagnostics {
    const KEYWORDS: [&str; 9] = ["while", "if", "elif", "else", "break", "continue", "var", "global", "set"];
    let mut diagnostics = Diagnostics::default();
    if dialect != Variables::RepRap {
        return diagnostics;
    }
    let mut rest = text;
    let mut line_number: u32 = 0;
    while !rest.is_empty() {
        let (line, behind) = cut_line(rest);
        rest = behind;
        line_number = line_number.saturating_add(1);
        let start = line.trim_ascii_start();
        let length = start.iter().position(|byte| !byte.is_ascii_alphabetic()).unwrap_or(start.len());
        let word = start.get(..length).unwrap_or_default();
        if KEYWORDS.iter().any(|keyword| keyword.as_bytes().eq_ignore_ascii_case(word)) {
            let kind =
                Problem::Preprocess(Cow::Borrowed("the commands of RepRapFirmware's language are not run"));
            let column = u32::try_from(line.len() - start.len()).unwrap_or(u32::MAX - 1) + 1;
            diagnostics.push(Diagnostic { line: line_number, column, kind });
        }
    }
    diagnostics
}

#[cfg(test)]
mod tests;
