//! A text as commands.

use gcode::{Comments, Diagnostics, Flavor, Parser, ReadOptions, Step};

/// The commands of a text and what is wrong with it.
///
/// ```
/// use emulate::Program;
/// use gcode::Flavor;
///
/// let program = Program::read(b"G90 G1 X5 F600\n");
/// assert_eq!(program.steps.len(), 2);
/// let program = Program::read_as(b"SET_VELOCITY_LIMIT ACCEL=500\n", Flavor::named("klipper").expect("built in"));
/// assert_eq!(program.steps[0].command.kind().name(), "Config");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program<'a> {
    /// The commands with their lines.
    pub steps: Vec<Step<'a>>,
    /// What is wrong with the text.
    pub diagnostics: Diagnostics,
}

impl<'a> Program<'a> {
    /// Reads a text in the dialect of Marlin, which most files are for.
    pub fn read(text: &'a [u8]) -> Self {
        Self::read_as(text, &Flavor::default())
    }

    /// Reads a text in a dialect.
    pub fn read_as(text: &'a [u8], flavor: &Flavor) -> Self {
        Self::read_mapped(text, flavor, &[])
    }

    /// Reads a text whose lines come from elsewhere: `lines` says from which line of the file each is, as the
    /// preprocessor does.
    pub fn read_mapped(text: &'a [u8], flavor: &Flavor, lines: &[u32]) -> Self {
        let options = ReadOptions { comments: Comments::Lines, ..ReadOptions::default() };
        let mut parser = Parser::new(flavor).with_options(options).with_lines(lines);
        // A line of a print has about thirty bytes.
        let mut steps = Vec::with_capacity(text.len() / 30);
        parser.read(text, |step| steps.push(step));
        Self { steps, diagnostics: parser.into_diagnostics() }
    }
}
