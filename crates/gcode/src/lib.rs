//! Reads and writes any G-code.
//!
//! There are two readers, for two kinds of users.
//!
//! **[`Line`]** is for those who want the text: lines, codes and words, by the letter, whatever they do. It takes every
//! byte there is and says in [`Line::unreadable`] and [`Words::is_bare`] what it skipped. One line is read again and
//! again, and nothing is allocated.
//!
//! ```
//! use gcode::{Code, Line, lines};
//!
//! let mut line = Line::default();
//! let mut length = 0.0;
//! for text in lines(b"; a cup\nN2 g01 x10 E.5*71\nG1X20E1.5") {
//!     line.read(text);
//!     if line.command == Some(Code::g(1)) {
//!         length += line.words.get(b'E').unwrap_or(0.0);
//!     }
//! }
//! assert_eq!(length, 2.0);
//! ```
//!
//! **[`Parser`]** is for those who want the machine. A program passes through three steps: [`preprocess`] computes its
//! variables, branches and calls; the parser reads the lines by a [`Flavor`], which says how the machine is spoken to; and
//! every instruction is handed on as a [`Command`] of one of 19 kinds, in mm and seconds whatever the file is in. What is
//! odd or wrong is a [`Diagnostic`] with line and column. [`GcodeExporter`] goes the other way, into any flavor.
//!
//! ```
//! use gcode::{Command, Exporter, Flavor, GcodeExporter, check_text, preprocess};
//!
//! let text = b"%\n(a wall for LinuxCNC)\n#1=0\no1 repeat [2]\nG1 X[#1 * 40] F600\n#1=[#1 + 1]\no1 endrepeat\nM2\n";
//! check_text(text)?;
//! let choice = Flavor::detect(text);
//! assert_eq!(choice.to_string(), "rs274, because of LINUXCNC in line 2");
//!
//! let program = preprocess(text, choice.flavor)?;
//! let marlin = Flavor::named("marlin").expect("built in");
//! let (mut ends, mut out) = (Vec::new(), Vec::new());
//! let mut exporter = GcodeExporter::new(marlin).from_flavor(choice.flavor);
//! let mut parser = program.parser(choice.flavor);
//! parser.read(&program.text, |step| {
//!     if let Command::Move { to, feed, .. } = step.command {
//!         ends.push((step.line, to.x.get(), feed.get()));
//!     }
//!     exporter.line(&step, &mut out);
//! });
//! assert_eq!(ends, [(5, Some(0.0), Some(10.0)), (5, Some(40.0), Some(10.0))]);
//! assert_eq!(out, b"%\n;a wall for LinuxCNC\nG1 X0 F600\nG1 X40 F600\nM2\n");
//! assert!(parser.diagnostics().is_empty() && exporter.diagnostics().is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod command;
mod diagnostic;
mod export;
mod flavor;
mod given;
mod line;
mod lines;
mod number;
mod parameters;
mod parse;
mod plain;
mod preprocess;
mod short;
mod sniff;
mod token;
mod word;

pub use command::{By, Centre, Command, CommandKind, Plane, Span, Spin, Step, Target, Turn};
pub use diagnostic::{Diagnostic, Diagnostics, Problem};
pub use export::{Exporter, GcodeExporter, Row};
pub use flavor::{
    AffectsE, ArcTurns, Choice, DwellUnit, Extruder, Flavor, FlavorError, Limit, LimitValue, Quantity,
    Reason, Variables,
};
pub use given::Given;
pub use line::{Kind, Line};
pub use lines::{Lines, find_byte, lines, without_bom, without_cr};
pub use number::read_number;
pub use parameters::{LengthUnit, MM_PER_INCH, Parameters};
pub use parse::{Comments, Parser, ReadOptions, whole_lines};
pub use preprocess::{Limits, Preprocessor, Program, preprocess};
pub use sniff::{NotText, check_text};
pub use token::{Token, Tokens};
pub use word::{Code, Words};
