//! Reads any G-code: a text becomes lines, a line becomes a command and its words.
//!
//! The reader knows how G-code is spelled and nothing of what it does: no positions, no units, no modes. It takes
//! every byte there is. A line that cannot be read is code without a command, never an error and never a panic, and
//! what was skipped is told by [`Line::unreadable`] and [`Words::is_bare`].
//!
//! Nothing is allocated: one [`Line`] is read again and again.
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
