//! The machine: it takes commands one after the other and says what becomes of them.

mod feed;
mod limits;
pub(crate) mod record;
mod state;
mod walk;

pub use limits::{Corner, Limits};
pub use record::Totals;
pub use state::BareG92;

use crate::error::Error;
use crate::extruder::Extruder;
use crate::motion::MotionProfile;
use crate::operation::{AdditiveOperation, Operation, SubtractiveOperation};
use gcode::{Flavor, Step};
use record::{Columns, Material, Milling, Sum};
use walk::Walk;

/// A machine: its limits, its habits, and how its motion is planned.
///
/// ```
/// use emulate::{Machine, Commands, motion::MotionProfile};
///
/// let program = Commands::read(b"G1 X100 F3000\nG4 P500\nG1 X0\n");
/// let machine = Machine {
///     motion: MotionProfile { max_acceleration: Some(500.0), ..MotionProfile::default() },
///     ..Machine::default()
/// };
/// let operation = machine.process(program.steps)?;
/// assert_eq!(operation.commands().len(), operation.process_data().len());
/// assert!((operation.total_time() - 4.7).abs() < 1e-9);
/// # Ok::<(), emulate::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Machine {
    /// The planner, with the limits that hold for every move.
    pub motion: MotionProfile,
    /// Limits of axes and kinds of move.
    pub limits: Limits,
    /// Whether what a file says about limits is obeyed from its line on.
    pub obeys_limits: bool,
    /// The dialect that it speaks.
    pub flavor: Flavor,
    /// What E counts.
    pub extruder: Extruder,
    /// The speed of `G0` where that is not the feed, mm/s.
    pub rapid_speed: Option<f64>,
    /// The feed before a file gives one, mm/s.
    pub default_feed: f64,
    /// Where the nozzle is at the beginning, mm; nothing takes the first place that the file names.
    pub start: Option<[f64; 3]>,
    /// What `G92` without an axis does.
    pub bare_g92: BareG92,
    /// The diameter of the cutter, mm, if it mills.
    pub cutter: Option<f64>,
}

impl Default for Machine {
    fn default() -> Self {
        Self {
            motion: MotionProfile::default(),
            limits: Limits::default(),
            obeys_limits: true,
            flavor: Flavor::default(),
            extruder: Extruder::default(),
            rapid_speed: None,
            default_feed: 50.0,
            start: Some([0.0; 3]),
            bare_g92: BareG92::default(),
            cutter: None,
        }
    }
}

impl Machine {
    /// A machine with the limits that its firmware says: the commands of its settings, as `M503` or `$$` print them.
    pub fn from_firmware(settings: &[Step<'_>], flavor: &Flavor) -> Self {
        let mut limits = Limits::default();
        for step in settings {
            limits.obey(&step.command, flavor);
        }
        Self { limits, flavor: flavor.clone(), ..Self::default() }
    }

    /// Emulates a program.
    ///
    /// # Errors
    /// When a number of the machine makes no sense, or a rule of it asks for an impossible speed. What is wrong with
    /// the program itself stands among the diagnostics of the operation.
    pub fn process<'a>(&self, steps: Vec<Step<'a>>) -> Result<Operation<'a>, Error> {
        let (columns, diagnostics) = self.walk(&steps, Columns::<()>::new(self, steps.len()))?;
        Ok(Operation::new(steps, columns.finish().0, diagnostics))
    }

    /// Emulates a program that deposits material.
    ///
    /// # Errors
    /// As [`process`](Self::process).
    pub fn process_additive<'a>(&self, steps: Vec<Step<'a>>) -> Result<AdditiveOperation<'a>, Error> {
        let (columns, diagnostics) = self.walk(&steps, Columns::<Material>::new(self, steps.len()))?;
        let (process, material) = columns.finish();
        let operation = Operation::new(steps, process, diagnostics);
        Ok(AdditiveOperation::new(operation, material, self.extruder))
    }

    /// Emulates a program that cuts material away.
    ///
    /// # Errors
    /// As [`process`](Self::process).
    pub fn process_subtractive<'a>(&self, steps: Vec<Step<'a>>) -> Result<SubtractiveOperation<'a>, Error> {
        let (columns, diagnostics) = self.walk(&steps, Columns::<Milling>::new(self, steps.len()))?;
        let (process, milling) = columns.finish();
        Ok(SubtractiveOperation::new(Operation::new(steps, process, diagnostics), milling))
    }

    /// Writes a program with whatever exporter it is given: a [`gcode::GcodeExporter`] for G-code of any flavor,
    /// [`gcode::Row`]s, or one of one's own.
    ///
    /// ```
    /// use emulate::{Commands, Machine};
    /// use gcode::{Exporter, Step};
    ///
    /// /// Names the commands.
    /// struct Names;
    /// impl Exporter for Names {
    ///     fn line(&mut self, step: &Step<'_>, out: &mut Vec<u8>) {
    ///         out.extend_from_slice(step.command.kind().name().as_bytes());
    ///         out.push(b'\n');
    ///     }
    /// }
    ///
    /// let steps = Commands::read(b"G90 G1 X5 F600\nG4 P10\n").steps;
    /// let names = Machine::default().export(&steps, &mut Names);
    /// assert_eq!(names, b"AbsolutePosition\nMove\nDwell\n");
    /// ```
    pub fn export(&self, steps: &[Step<'_>], exporter: &mut dyn gcode::Exporter) -> Vec<u8> {
        let mut out = Vec::new();
        steps.iter().for_each(|step| exporter.line(step, &mut out));
        out
    }

    /// Begins to emulate a program of any length, of which nothing but sums is kept.
    ///
    /// # Errors
    /// When a number of the machine makes no sense.
    pub fn stream(&self) -> Result<Stream<'_>, Error> {
        Ok(Stream { walk: Walk::new(self, Sum::new(self))?.bounded(), error: None })
    }

    fn walk<R: record::Record>(
        &self,
        steps: &[Step<'_>],
        record: R,
    ) -> Result<(R, gcode::Diagnostics), Error> {
        let mut walk = Walk::new(self, record)?;
        for step in steps {
            walk.step(step)?;
        }
        walk.finish()
    }
}

/// An emulation that takes its commands one by one and keeps only sums. It needs the same memory for any program.
///
/// ```
/// use emulate::Machine;
/// use gcode::{Flavor, Parser};
///
/// let machine = Machine::default();
/// let flavor = Flavor::default();
/// let mut parser = Parser::new(&flavor);
/// let mut stream = machine.stream()?;
/// for block in [&b"G1 X100 F6000\n"[..], &b"G4 S2\nG1 X0\n"[..]] {
///     parser.read(block, |step| stream.step(&step));
/// }
/// assert_eq!(stream.finish()?.total_time, 4.0);
/// # Ok::<(), emulate::Error>(())
/// ```
pub struct Stream<'m> {
    walk: Walk<'m, Sum>,
    error: Option<Error>,
}

impl Stream<'_> {
    /// One command. After an error nothing more is done; [`finish`](Self::finish) returns it.
    #[inline]
    pub fn step(&mut self, step: &Step<'_>) {
        if self.error.is_none() {
            self.error = self.walk.step(step).err();
        }
    }

    /// The sums.
    ///
    /// # Errors
    /// When a rule of the machine asks for an impossible speed.
    pub fn finish(self) -> Result<Totals, Error> {
        match self.error {
            Some(error) => Err(error),
            None => self.walk.finish().map(|(sum, diagnostics)| sum.finish(diagnostics)),
        }
    }
}
