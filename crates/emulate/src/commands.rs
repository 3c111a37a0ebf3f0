//! A text as commands, and as the operation of a machine.

use crate::error::Error;
use crate::machine::Machine;
use crate::operation::AdditiveOperation;
use gcode::{Diagnostics, Flavor, Parser, Program, Step};

/// What a machine makes of a program, from the text on. What is wrong with the text itself is in
/// [`Commands::diagnostics`], which this leaves out.
///
/// ```
/// use emulate::{Machine, read_operation};
///
/// let machine = Machine::default();
/// let program = gcode::preprocess(b"G1 X100 E5 F6000\nG1 X0\n", &machine.flavor)?;
/// let operation = read_operation(&program, &machine)?;
/// assert_eq!(operation.total_time(), 2.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As [`Machine::process`].
pub fn read_operation<'a>(
    program: &'a Program<'_>,
    machine: &'a Machine,
) -> Result<AdditiveOperation<'a>, Error> {
    machine.process_additive(Commands::of(program, &machine.flavor).steps)
}

/// The commands of a text and what is wrong with it.
///
/// ```
/// use emulate::Commands;
/// use gcode::Flavor;
///
/// let commands = Commands::read(b"G90 G1 X5 F600\n");
/// assert_eq!(commands.steps.len(), 2);
/// let klipper = Flavor::named("klipper").expect("built in");
/// let commands = Commands::read_as(b"SET_VELOCITY_LIMIT ACCEL=500\n", klipper);
/// assert_eq!(commands.steps[0].command.kind().name(), "Config");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Commands<'a> {
    /// The commands with their lines.
    pub steps: Vec<Step<'a>>,
    /// What is wrong with the text.
    pub diagnostics: Diagnostics,
}

impl<'a> Commands<'a> {
    /// Reads a text in the dialect of Marlin, which most files are for.
    pub fn read(text: &'a [u8]) -> Self {
        Self::read_as(text, &Flavor::default())
    }

    /// Reads a text in a dialect. Nothing in it is computed; [`gcode::preprocess`] does that.
    pub fn read_as(text: &'a [u8], flavor: &Flavor) -> Self {
        Self::parsed(text, Parser::new(flavor))
    }

    /// Reads a program whose variables, branches and loops are computed.
    pub fn of(program: &'a Program<'_>, flavor: &'a Flavor) -> Self {
        Self::parsed(&program.text, program.parser(flavor))
    }

    fn parsed(text: &'a [u8], mut parser: Parser<'_>) -> Self {
        // A line of a print has about thirty bytes, and room that is not used costs nothing.
        let mut steps = Vec::with_capacity(text.len() / 24);
        parser.read(text, |step| steps.push(step));
        Self { steps, diagnostics: parser.into_diagnostics() }
    }
}
