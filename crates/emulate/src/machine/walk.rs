//! From command to command: what each does, and how long it takes.

use super::limits::{Limits, along, any};
use super::record::{More, Record};
use super::state::{Deposit, Effect, State, Way};
use super::{Machine, feed::Feed};
use crate::error::Error;
use crate::extruder::Extruder;
use crate::motion::{Move, Planner, SHORTEST, least};
use crate::process::{Action, Row};
use gcode::{By, Command, Diagnostic, Diagnostics, Problem, Step};
use std::borrow::Cow;

/// So many moves a walk keeps in mind when it keeps nothing else.
const LONGEST_WINDOW: usize = 1 << 16;

/// A machine on its way through a program.
pub(crate) struct Walk<'m, R: Record> {
    machine: &'m Machine,
    state: State,
    limits: Limits,
    /// Whether any axis has a limit of speed, and of acceleration, of its own.
    has_axes: [bool; 2],
    /// mm³ of one E; `M200` changes it.
    mm3_per_unit: f64,
    planner: Planner<R::Tag>,
    record: R,
    diagnostics: Diagnostics,
}

impl<'m, R: Record> Walk<'m, R> {
    pub(crate) fn new(machine: &'m Machine, record: R) -> Result<Self, Error> {
        machine.motion.check()?;
        let mut limits = machine.limits;
        if let Some(acceleration) = machine.motion.max_acceleration {
            limits = limits.with_acceleration(acceleration);
        }
        let feed = Feed::new(machine.default_feed, machine.rapid_speed);
        Ok(Self {
            machine,
            state: State::new(machine.start, machine.flavor.g90_affects_e, machine.bare_g92, feed),
            has_axes: has_axes(&limits),
            limits,
            mm3_per_unit: machine.extruder.mm3_per_unit(),
            planner: Planner::default(),
            record,
            diagnostics: Diagnostics::default(),
        })
    }

    /// Keeps no more moves in mind than a machine could need.
    pub(crate) fn bounded(mut self) -> Self {
        self.planner = Planner::bounded(LONGEST_WINDOW);
        self
    }

    /// One command.
    #[inline]
    pub(crate) fn step(&mut self, step: &Step<'_>) -> Result<(), Error> {
        let Self { state, diagnostics, .. } = self;
        let mut say = |text: Cow<'static, str>| {
            diagnostics.push(Diagnostic { line: step.line, column: 0, kind: Problem::Machine(text) });
        };
        let before = state.at;
        match &state.obey(&step.command, &mut say) {
            Effect::Way(way) => self.go(step.line, way),
            Effect::Nothing => {
                self.obey_settings(&step.command);
                self.row(step.line, Action::Nothing, before, None);
                Ok(())
            }
            &Effect::Wait(seconds, deposit) => {
                self.stop()?;
                let action = if deposit.is_some() { Action::Purge } else { Action::Dwell };
                let tag = self.row(step.line, action, before, deposit);
                self.record.waited(tag, seconds);
                Ok(())
            }
            Effect::Stop => {
                self.stop()?;
                self.row(step.line, Action::Nothing, before, None);
                Ok(())
            }
            Effect::Home => {
                self.stop()?;
                self.row(step.line, Action::Home, before, None);
                Ok(())
            }
        }
    }

    /// All that is left; the record and what is wrong with the program.
    pub(crate) fn finish(mut self) -> Result<(R, Diagnostics), Error> {
        self.stop()?;
        Ok((self.record, self.diagnostics))
    }

    /// Takes what a command says about limits and the extruder.
    #[cold]
    fn obey_settings(&mut self, command: &Command<'_>) {
        if self.machine.obeys_limits && matches!(command, Command::M { .. } | Command::Config { .. }) {
            self.limits.obey(command, &self.machine.flavor);
            self.has_axes = has_axes(&self.limits);
        }
        if let Command::M { tenths: 2000, words } = command
            && let Some(diameter) = words.get(b'D')
        {
            // M200 D0 counts as the machine does of itself.
            let extruder = if diameter > 0.0 { Extruder::Volume } else { self.machine.extruder };
            self.mm3_per_unit = extruder.mm3_per_unit();
        }
    }

    /// The machine comes to rest.
    fn stop(&mut self) -> Result<(), Error> {
        let Self { planner, record, machine, .. } = self;
        planner
            .stop(&machine.motion, &mut |tag, step, acceleration| record.moved(tag, step, acceleration))
            .map_err(|error| {
                let line = error.index.and_then(|index| planner.tag(index)).map(|tag| record.line(tag));
                Error::of_motion(error, line)
            })
    }

    #[inline(never)]
    fn row(&mut self, line: u32, action: Action, from: [f64; 3], deposit: Option<Deposit>) -> R::Tag {
        let row = Row { line, action, at: self.state.at, tool: self.state.tool, ..Row::default() };
        self.record.row(&row, &more(&self.state, self.mm3_per_unit, from, deposit))
    }

    /// A move of the nozzle or of the extruder.
    #[inline(always)]
    fn go(&mut self, line: u32, way: &Way) -> Result<(), Error> {
        let Self { state, diagnostics, .. } = self;
        let mut say = |text: Cow<'static, str>| {
            diagnostics.push(Diagnostic { line, column: 0, kind: Problem::Machine(text) });
        };
        let mut step = match &way.arc {
            None => Move::line(way.from, way.to, 0.0),
            Some(arc) => Move {
                tangent_in: arc.tangent(0.0),
                tangent_out: arc.tangent(1.0),
                length: arc.length(),
                ..Move::line(way.from, way.to, 0.0)
            },
        };
        let extruded =
            way.deposit.filter(|deposit| deposit.by == By::Amount).map_or(0.0, |deposit| deposit.amount);
        let moves = step.length >= SHORTEST;
        let action = match way.deposit {
            Some(deposit) if moves && deposit.amount > 0.0 => Action::Deposit,
            _ if moves => Action::Travel,
            _ if extruded.abs() >= SHORTEST => Action::Extrude,
            _ => Action::Nothing,
        };
        if !moves {
            (step.length, step.tangent_in, step.tangent_out) = (extruded.abs(), [0.0; 3], [0.0; 3]);
        }
        let still = action == Action::Nothing;
        let told = if still {
            if let Some(feed) = way.feed.get() {
                state.feed.set(feed, &mut say);
            }
            0.0
        } else {
            state.feed.speed(way.feed, way.rapid, step.length, &mut say)
        };
        let row = Row {
            line,
            action,
            at: way.to,
            feed_rate: told,
            length: if still { 0.0 } else { step.length },
            tool: state.tool,
            arc: way.arc.as_ref().filter(|_| moves),
        };
        let tag = self.record.row(&row, &more(&self.state, self.mm3_per_unit, way.from, way.deposit));
        if still {
            return Ok(());
        }
        step.extruder = extruded / step.length;
        step.table = way.table / step.length;
        step.target = told;
        self.limit(&mut step, action, row.arc.is_some());
        if let Some(arc) = row.arc {
            step.target = least(step.target, arc.speed_limit(step.acceleration));
        }
        let Self { planner, record, machine, .. } = self;
        planner
            .push(&machine.motion, &step, tag, &mut |tag, step, acceleration| {
                record.moved(tag, step, acceleration)
            })
            .map_err(|error| {
                let line = error.index.and_then(|index| planner.tag(index)).map(|tag| record.line(tag));
                Error::of_motion(error, line)
            })
    }

    /// What the limits leave of the speed that was asked for, and the acceleration.
    #[inline]
    fn limit(&self, step: &mut Move, action: Action, is_arc: bool) {
        let Self { limits, machine: Machine { motion, .. }, .. } = self;
        let highest = motion.max_velocity.map_or(limits.speed, |highest| least(highest, limits.speed));
        step.target = least(step.target, highest);
        step.acceleration = match action {
            Action::Deposit => limits.print,
            Action::Extrude => limits.retract,
            _ => limits.travel,
        };
        if self.has_axes != [false; 2] {
            self.limit_axes(step, is_arc);
        }
        // Smoothing is for the nozzle; what the extruder does alone shakes nothing.
        step.smooth_acceleration = match action {
            Action::Extrude => step.acceleration,
            _ => limits.smoothing.unwrap_or(motion.smoothing).acceleration(step.acceleration),
        };
        step.junction_deviation = match limits.corner {
            Some(corner) => corner.deviation(step.acceleration),
            None => motion.junction_deviation,
        };
    }

    /// What the limits of single axes leave.
    #[inline]
    fn limit_axes(&self, step: &mut Move, is_arc: bool) {
        let ([x, y, z], end) = (step.tangent_in, step.tangent_out);
        // An arc may point anywhere in its plane between its ends.
        let flat = if is_arc { libm::hypot(x, y).max(libm::hypot(end[0], end[1])) } else { 0.0 };
        let shares = [x.abs().max(flat), y.abs().max(flat), z.abs().max(end[2].abs()), step.extruder.abs()];
        let [has_speeds, has_accelerations] = self.has_axes;
        if has_speeds {
            step.target = least(step.target, along(&self.limits.axis_speed, &shares));
        }
        if has_accelerations {
            step.acceleration = least(step.acceleration, along(&self.limits.axis_acceleration, &shares));
        }
    }
}

fn has_axes(limits: &Limits) -> [bool; 2] {
    [&limits.axis_speed, &limits.axis_acceleration].map(any)
}

#[inline]
fn more(state: &State, mm3_per_unit: f64, from: [f64; 3], deposit: Option<Deposit>) -> More {
    More { deposit, mm3_per_unit, flow: state.flow, spindle: state.feed.spindle, from, axis: state.axis }
}
