//! Runs a program and writes down the lines that it emits.

use super::expression::{Fault, Name, Reader, Value};
use super::statement::{Kind, Statement, Statements, take_digits};
use super::variables::Store;
use super::{Limits, Program};
use crate::diagnostic::{Diagnostic, Diagnostics, Problem};
use crate::flavor::{Flavor, Variables};
use crate::line::Line;
use crate::word::Code;
use std::borrow::Cow;
use std::io::Write;

/// A loop that is being run.
#[derive(Clone, Copy, Debug)]
struct Turns {
    start: usize,
    end: usize,
    /// Turns so far, and those that are left of a counted loop.
    done: u64,
    left: u64,
    /// What had changed when the last turn began, and how many turns in a row nothing did.
    seen: u64,
    idle: u64,
}

/// A call that is being run.
#[derive(Debug, Default)]
struct Call {
    /// Where it goes on behind the call.
    back: usize,
    /// Where it begins, and how often it is still to be run.
    start: usize,
    left: u64,
    loops: Vec<Turns>,
}

/// A program that is being run.
pub(super) struct Run<'s, 'a> {
    statements: &'s Statements<'a>,
    flavor: &'s Flavor,
    limits: Limits,
    store: Store,
    calls: Vec<Call>,
    text: Vec<u8>,
    lines: Vec<u32>,
    jumps_back: u64,
}

/// Letters of the arguments of a macro and the variables they fill.
const ARGUMENTS: &[(u8, u32)] = &[
    (b'A', 1),
    (b'B', 2),
    (b'C', 3),
    (b'I', 4),
    (b'J', 5),
    (b'K', 6),
    (b'D', 7),
    (b'E', 8),
    (b'F', 9),
    (b'H', 11),
    (b'M', 13),
    (b'Q', 17),
    (b'R', 18),
    (b'S', 19),
    (b'T', 20),
    (b'U', 21),
    (b'V', 22),
    (b'W', 23),
    (b'X', 24),
    (b'Y', 25),
    (b'Z', 26),
];

/// Where to go on; nothing at the end.
type Next = Value<Option<usize>>;

impl<'s, 'a> Run<'s, 'a> {
    pub fn new(
        statements: &'s Statements<'a>,
        flavor: &'s Flavor,
        limits: Limits,
        presets: &[(u32, f64)],
    ) -> Result<Self, Diagnostic> {
        let last_local = match flavor.variables {
            Variables::Rs274 => 30,
            Variables::Fanuc => 33,
            Variables::Siemens | Variables::RepRap | Variables::None => 0,
        };
        let mut store = Store::new(last_local, limits.variables);
        for &(number, value) in presets {
            store.set_number(number, value);
        }
        let calls = vec![Call::default()];
        Ok(Self {
            statements,
            flavor,
            limits,
            store,
            calls,
            text: Vec::new(),
            lines: Vec::new(),
            jumps_back: 0,
        })
    }

    pub fn run<'t>(mut self) -> Result<Program<'t>, Diagnostic> {
        let mut index = 0;
        let mut steps: u64 = 0;
        while let Some(statement) = self.statements.list.get(index) {
            steps += 1;
            let next = if steps > self.limits.steps {
                Err(Fault { index: 0, why: Cow::Borrowed("the program runs too long") })
            } else {
                self.step(index, statement)
            };
            match next {
                Ok(Some(next)) => index = next,
                Ok(None) => break,
                Err(fault) => {
                    let column = u32::try_from(fault.index).map_or(u32::MAX, |index| index.saturating_add(1));
                    return Err(Diagnostic {
                        line: statement.line,
                        column,
                        kind: Problem::Preprocess(fault.why),
                    });
                }
            }
        }
        Ok(Program { text: Cow::Owned(self.text), lines: self.lines, diagnostics: Diagnostics::default() })
    }

    fn reader<'r>(&self, statement: &Statement<'r>) -> Reader<'r, '_> {
        Reader::new(statement.text, statement.rest, &self.store, self.flavor.variables)
    }

    fn test(&self, statement: &Statement<'_>) -> Value<bool> {
        Ok(self.reader(statement).expression()? != 0.0)
    }

    fn step(&mut self, index: usize, statement: &Statement<'_>) -> Next {
        let forward = index + 1;
        Ok(Some(match statement.kind {
            Kind::Plain => return self.plain(statement, forward),
            Kind::Sub => statement.next + 1,
            Kind::EndSub | Kind::Return | Kind::EndProgram => return self.finish_call(statement),
            Kind::Call => return self.call(statement, forward),
            Kind::CallProgram => return self.call_program(statement, forward),
            // A program that nobody called begins: what came before is at its end, unless nothing did.
            Kind::Program if index == 0 || self.lines.is_empty() && self.calls.len() == 1 => forward,
            Kind::Program => return self.finish_call(statement),
            Kind::If => self.branch(index)?,
            Kind::ElseIf | Kind::Else => statement.end + 1,
            Kind::EndIf => forward,
            Kind::While | Kind::Loop | Kind::For | Kind::Repeat => return self.begin_turn(index, statement),
            Kind::Do => {
                self.turn(index, statement.next, 0)?;
                forward
            }
            Kind::EndLoop => statement.next,
            Kind::DoWhile | Kind::Until => {
                if self.test(statement)? == (statement.kind == Kind::DoWhile) {
                    statement.next
                } else {
                    self.leave_loop(statement.next);
                    forward
                }
            }
            Kind::Break => {
                let end = statement.next;
                let start = self.statements.list.get(end).map_or(end, |last| last.next);
                self.leave_loop(start);
                end + 1
            }
            Kind::Continue => statement.next,
            Kind::Condition => return self.condition(index, statement),
            Kind::Goto => self.goto(index, statement.text, statement.rest)?,
            Kind::RepeatFrom => return self.repeat_from(index, statement),
            Kind::Define => {
                self.define(statement)?;
                forward
            }
        }))
    }

    /// Where the branch begins that is to be run.
    fn branch(&self, mut index: usize) -> Value<usize> {
        while let Some(statement) = self.statements.list.get(index) {
            let taken = match statement.kind {
                Kind::If | Kind::ElseIf => self.test(statement)?,
                _ => true,
            };
            if taken {
                return Ok(index + 1);
            }
            index = statement.next;
        }
        Ok(index)
    }

    /// Begins a turn of the loop at `start`; `count` is how many turns it has if it is counted.
    fn turn(&mut self, start: usize, end: usize, count: u64) -> Value<&mut Turns> {
        let seen = self.store.changes.wrapping_add(self.lines.len() as u64);
        let limits = self.limits;
        let Some(call) = self.calls.last_mut() else {
            return Err(Fault { index: 0, why: Cow::Borrowed("nothing is being run") });
        };
        match call.loops.iter().rposition(|turns| turns.start == start) {
            Some(found) => call.loops.truncate(found + 1),
            None => call.loops.push(Turns { start, end, done: 0, left: count, seen: !seen, idle: 0 }),
        }
        let Some(turns) = call.loops.last_mut() else {
            return Err(Fault { index: 0, why: Cow::Borrowed("nothing is being run") });
        };
        turns.done += 1;
        turns.idle = if turns.seen == seen { turns.idle + 1 } else { 0 };
        turns.seen = seen;
        let why = if turns.idle > limits.idle {
            "this loop never ends: nothing changes in it"
        } else if turns.done > limits.turns {
            "this loop has too many turns"
        } else {
            return Ok(turns);
        };
        Err(Fault { index: 0, why: Cow::Borrowed(why) })
    }

    fn leave_loop(&mut self, start: usize) {
        if let Some(call) = self.calls.last_mut()
            && let Some(found) = call.loops.iter().rposition(|turns| turns.start == start)
        {
            call.loops.truncate(found);
        }
    }

    fn is_running(&self, start: usize) -> bool {
        self.calls.last().is_some_and(|call| call.loops.iter().any(|turns| turns.start == start))
    }

    fn begin_turn(&mut self, index: usize, statement: &Statement<'_>) -> Next {
        let first = !self.is_running(index);
        let goes_on = match statement.kind {
            Kind::While => self.test(statement)?,
            Kind::For => self.count(statement, first)?,
            Kind::Repeat if first => {
                let count = self.reader(statement).expression()?;
                // A count below one is none; one too large runs into the limit.
                self.turn(index, statement.next, count.max(0.0) as u64)?.left > 0
            }
            Kind::Repeat => {
                let turns = self.turn(index, statement.next, 0)?;
                turns.left = turns.left.saturating_sub(1);
                turns.left > 0
            }
            _ => true,
        };
        if !goes_on {
            self.leave_loop(index);
            return Ok(Some(statement.next + 1));
        }
        if statement.kind != Kind::Repeat {
            self.turn(index, statement.next, 0)?;
        }
        Ok(Some(index + 1))
    }

    /// `FOR i = a TO b`: sets or raises the variable, and says whether it is still in bounds.
    fn count(&mut self, statement: &Statement<'_>, first: bool) -> Value<bool> {
        let mut reader = self.reader(statement);
        let name = reader.variable()?;
        if !reader.take(b"=") {
            return reader.fault("`=` is missing");
        }
        let from = reader.expression()?;
        if !reader.take(b"TO") {
            return reader.fault("`TO` is missing");
        }
        let to = reader.expression()?;
        let value = if first { from } else { reader.get(&name).unwrap_or(from) + 1.0 };
        self.assign(statement, &name, value)?;
        Ok(value <= to)
    }

    fn assign(&mut self, statement: &Statement<'_>, name: &Name, value: f64) -> Value<()> {
        if *name == Name::Number(0) && self.flavor.variables == Variables::Fanuc {
            return Err(Fault { index: statement.rest, why: Cow::Borrowed("#0 cannot be set") });
        }
        let fits = match name {
            Name::Number(number) => self.store.set_number(*number, value),
            Name::Text(text) => self.store.set_name(text, value),
        };
        if fits { Ok(()) } else { Err(Fault { index: 0, why: Cow::Borrowed("too many variables") }) }
    }

    fn condition(&mut self, index: usize, statement: &Statement<'_>) -> Next {
        let mut reader = self.reader(statement);
        let holds = reader.expression()? != 0.0;
        let at = reader.index;
        if reader.take(b"THEN") {
            let rest = reader.index;
            if holds {
                return self.plain(&Statement { rest, ..statement.clone() }, index + 1);
            }
            return Ok(Some(index + 1));
        }
        if !holds {
            return Ok(Some(index + 1));
        }
        self.goto(index, statement.text, at).map(Some)
    }

    /// Where the `GOTO` at `at` leads.
    fn goto(&mut self, index: usize, text: &[u8], at: usize) -> Value<usize> {
        let mut reader = Reader::new(text, at, &self.store, self.flavor.variables);
        let siemens = self.flavor.variables == Variables::Siemens;
        let ahead = reader.take(b"GOTOF");
        let back = !ahead && reader.take(b"GOTOB");
        if !ahead && !back {
            // The word itself is taken already where a statement begins with it.
            reader.take(b"GOTO");
        }
        let label = if siemens {
            match reader.variable()? {
                Name::Text(name) => name,
                Name::Number(_) => return reader.fault("a label is missing"),
            }
        } else {
            let value = reader.operand()?;
            format!("{value}").into_bytes()
        };
        let places = self.statements.labels.get(&label).map(Vec::as_slice).unwrap_or_default();
        let after = places.iter().find(|&&place| place > index);
        let before = places.iter().rev().find(|&&place| place <= index);
        let found = match (ahead, back) {
            (true, _) => after,
            (_, true) => before,
            _ => after.or(before),
        };
        let Some(&target) = found else {
            return reader.fault(format!("there is no label `{}` to go to", String::from_utf8_lossy(&label)));
        };
        if target <= index {
            self.jumps_back += 1;
            if self.jumps_back > self.limits.turns {
                return Err(Fault { index: at, why: Cow::Borrowed("too many jumps backwards") });
            }
        }
        if let Some(call) = self.calls.last_mut() {
            call.loops.retain(|turns| turns.start < target && target <= turns.end);
        }
        Ok(target)
    }

    /// `REPEAT label P=n`: runs what stands between the label and itself n times more.
    fn repeat_from(&mut self, index: usize, statement: &Statement<'_>) -> Next {
        let mut reader = self.reader(statement);
        let Name::Text(label) = reader.variable()? else { return reader.fault("a label is missing") };
        let count = if reader.take(b"P") && reader.take(b"=") { reader.expression()? } else { 1.0 };
        let places = self.statements.labels.get(&label).map(Vec::as_slice).unwrap_or_default();
        let Some(&target) = places.iter().rev().find(|&&place| place <= index) else {
            return reader.fault("there is no label above to repeat from");
        };
        let first = !self.is_running(index);
        let turns = self.turn(index, index, count.max(0.0) as u64)?;
        turns.left = if first { turns.left } else { turns.left.saturating_sub(1) };
        if turns.left > 0 {
            return Ok(Some(target));
        }
        self.leave_loop(index);
        Ok(Some(index + 1))
    }

    /// `DEF REAL a, b=2`.
    fn define(&mut self, statement: &Statement<'_>) -> Value<()> {
        let mut reader = self.reader(statement);
        if !(reader.take(b"REAL") || reader.take(b"INT") || reader.take(b"BOOL")) {
            return reader.fault("only REAL, INT and BOOL can be defined");
        }
        let mut found = Vec::new();
        loop {
            let name = reader.variable()?;
            let value = if reader.take(b"=") { reader.expression()? } else { 0.0 };
            found.push((name, value));
            if !reader.take(b",") {
                break;
            }
        }
        for (name, value) in found {
            self.assign(statement, &name, value)?;
        }
        Ok(())
    }

    /// `o100 call [1] [2]`.
    fn call(&mut self, statement: &Statement<'_>, back: usize) -> Next {
        let mut reader = self.reader(statement);
        reader.index += 1;
        let label = if reader.peek() == Some(b'<') {
            let rest = statement.text.get(reader.index + 1..).unwrap_or_default();
            let length = crate::find_byte(b'>', rest).unwrap_or(rest.len());
            reader.index += length + 2;
            let name = rest.get(..length).unwrap_or_default();
            name.iter().filter(|byte| !byte.is_ascii_whitespace()).map(u8::to_ascii_lowercase).collect()
        } else {
            take_digits(&mut reader).unwrap_or_default()
        };
        reader.take(b"CALL");
        let mut arguments = Vec::new();
        while reader.peek() == Some(b'[') {
            arguments.push((arguments.len() as u32 + 1, reader.operand()?));
            if arguments.len() > 30 {
                return reader.fault("a call has at most 30 arguments");
            }
        }
        self.enter(statement, &label, arguments, 1, back)
    }

    /// `M98 P100 L3` and `G65 P100 L3 A1 B2`.
    fn call_program(&mut self, statement: &Statement<'_>, back: usize) -> Next {
        let mut reader = self.reader(statement);
        let (mut label, mut count, mut arguments) = (None, 1, Vec::new());
        while let Some(letter) = reader.peek().filter(|&byte| !matches!(byte, b'(' | b';')) {
            reader.index += 1;
            let value = reader.operand()?;
            match letter.to_ascii_uppercase() {
                b'P' => label = Some(format!("{value}").into_bytes()),
                b'L' => count = value.max(0.0) as u64,
                letter => match ARGUMENTS.iter().find(|(known, _)| *known == letter) {
                    Some(&(_, number)) => arguments.push((number, value)),
                    None => return reader.fault("this letter is no argument of a macro"),
                },
            }
        }
        let Some(label) = label else { return reader.fault("a call needs P, the number of the program") };
        self.enter(statement, &label, arguments, count, back)
    }

    fn enter(
        &mut self,
        statement: &Statement<'_>,
        label: &[u8],
        arguments: Vec<(u32, f64)>,
        count: u64,
        back: usize,
    ) -> Next {
        let fault = |why: Cow<'static, str>| Err(Fault { index: statement.rest, why });
        let Some(&index) = self.statements.subs.get(label) else {
            return fault(
                format!("there is no program `{}` in this file", String::from_utf8_lossy(label)).into(),
            );
        };
        if count == 0 {
            return Ok(Some(back));
        }
        if count > self.limits.turns {
            return fault(Cow::Borrowed("this call has too many turns"));
        }
        if self.store.depth() >= self.limits.depth {
            return fault(Cow::Borrowed("calls are nested too deep"));
        }
        self.store.enter(arguments.into_iter());
        self.calls.push(Call { back, start: index + 1, left: count - 1, loops: Vec::new() });
        Ok(Some(index + 1))
    }

    /// Goes back to where the call came from, or runs it once more; ends the program if nothing called.
    fn finish_call(&mut self, statement: &Statement<'_>) -> Next {
        if statement.kind == Kind::Return {
            // `o100 return [5]` gives a value to `#<_value>`.
            let text = statement.text;
            if let Some(bracket) = text.iter().position(|&byte| byte == b'[') {
                let value = Reader::new(text, bracket, &self.store, self.flavor.variables).operand()?;
                self.assign(statement, &Name::Text(b"_value".to_vec()), value)?;
            }
        }
        if self.calls.len() < 2 {
            return Ok(None);
        }
        if let Some(call) = self.calls.last_mut()
            && call.left > 0
        {
            call.left -= 1;
            call.loops.clear();
            return Ok(Some(call.start));
        }
        self.store.leave();
        Ok(self.calls.pop().map(|call| call.back))
    }

    /// Emits a line.
    fn plain(&mut self, statement: &Statement<'_>, forward: usize) -> Next {
        let start = self.text.len();
        let mut assigned = Vec::new();
        self.write(statement, &mut assigned)?;
        for (name, value) in assigned.iter() {
            self.assign(statement, name, *value)?;
        }
        let line = self.text.get(start..).unwrap_or_default();
        if line.trim_ascii().is_empty() {
            self.text.truncate(start);
            return Ok(Some(forward));
        }
        let ends = matches!(Line::of(line).command, Some(command) if command == Code::m(2) || command == Code::m(30));
        self.text.push(b'\n');
        self.lines.push(statement.line);
        let too_much =
            self.lines.len() as u64 > self.limits.lines || self.text.len() as u64 > self.limits.bytes;
        if too_much {
            return Err(Fault { index: 0, why: Cow::Borrowed("the program emits too much") });
        }
        Ok(if ends { None } else { Some(forward) })
    }

    /// Writes a line with its values; what it assigns, by the values before it, is added to `assigned`.
    fn write(&mut self, statement: &Statement<'_>, assigned: &mut Vec<(Name, f64)>) -> Value<()> {
        let dialect = self.flavor.variables;
        let mut reader = Reader::new(statement.text, statement.rest, &self.store, dialect);
        let out = &mut self.text;
        while let Some(&byte) = statement.text.get(reader.index) {
            let start = reader.index;
            match byte {
                b';' => {
                    out.extend_from_slice(statement.text.get(start..).unwrap_or_default());
                    break;
                }
                b'(' if dialect != Variables::Siemens => copy_to(out, &mut reader, b')'),
                b'"' => copy_to(out, &mut reader, b'"'),
                b'#' if dialect != Variables::Siemens => {
                    let name = reader.variable()?;
                    if !reader.take(b"=") {
                        return reader.fault("a variable stands where a word should");
                    }
                    let value = reader.expression()?;
                    assigned.push((name, value));
                }
                b'$' if dialect == Variables::Siemens => {
                    out.extend_from_slice(statement.text.get(start..).unwrap_or_default());
                    break;
                }
                b'A'..=b'Z' | b'a'..=b'z' if dialect == Variables::Siemens => {
                    write_siemens_word(out, &mut reader, assigned)?;
                }
                b'A'..=b'Z' | b'a'..=b'z' => write_word(out, &mut reader, byte)?,
                _ => {
                    out.push(byte);
                    reader.index += 1;
                }
            }
        }
        Ok(())
    }
}

/// Copies up to and with `end`, which is not the next byte.
fn copy_to(out: &mut Vec<u8>, reader: &mut Reader<'_, '_>, end: u8) {
    let rest = reader.text.get(reader.index..).unwrap_or_default();
    let length = rest.iter().skip(1).position(|&byte| byte == end).map_or(rest.len(), |index| index + 2);
    out.extend_from_slice(rest.get(..length).unwrap_or_default());
    reader.index += length;
}

/// Writes a number so that it reads back as it is.
fn write_number(out: &mut Vec<u8>, value: f64) {
    // A minus zero is a zero; writing to a vector does not fail.
    let _ = write!(out, "{}", value + 0.0);
}

/// Writes a word whose number may be an expression.
fn write_word(out: &mut Vec<u8>, reader: &mut Reader<'_, '_>, letter: u8) -> Value<()> {
    reader.index += 1;
    let behind = reader.index;
    let next = reader.peek();
    let signed =
        matches!(next, Some(b'+' | b'-')) && matches!(reader.text.get(reader.index + 1), Some(b'#' | b'['));
    let computed =
        signed || matches!(next, Some(b'#' | b'[')) || Reader::is_function(reader.text, reader.index);
    if !computed {
        reader.index = behind;
        out.push(letter);
        return Ok(());
    }
    // In Fanuc's language a word whose variable has never been set is not there.
    if reader.dialect == Variables::Fanuc && next == Some(b'#') {
        let start = reader.index;
        let name = reader.variable()?;
        if reader.get(&name).is_none() {
            return Ok(());
        }
        reader.index = start;
    }
    let value = reader.operand()?;
    out.push(letter);
    write_number(out, value);
    Ok(())
}

/// Writes a word of Siemens, in which `=` may stand before an expression; or takes an assignment.
fn write_siemens_word(
    out: &mut Vec<u8>,
    reader: &mut Reader<'_, '_>,
    assigned: &mut Vec<(Name, f64)>,
) -> Value<()> {
    let start = reader.index;
    let rest = reader.text.get(start..).unwrap_or_default();
    let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    let length = rest.iter().position(|byte| !is_part(byte)).unwrap_or(rest.len());
    let word = rest.get(..length).unwrap_or_default();
    let is_parameter = matches!(word, [b'R' | b'r', digits @ ..] if digits.iter().all(u8::is_ascii_digit));
    let is_defined = reader.store.name(&word.to_ascii_uppercase()).is_some();
    if is_parameter && (length > 1 || rest.get(length) == Some(&b'[')) || is_defined {
        let name = reader.variable()?;
        if reader.take(b"=") {
            let value = reader.expression()?;
            assigned.push((name, value));
            return Ok(());
        }
        reader.index = start;
    }
    out.extend_from_slice(word);
    reader.index = start + length;
    if reader.peek() != Some(b'=') {
        reader.index = start + length;
        return Ok(());
    }
    reader.index += 1;
    out.push(b'=');
    let value_start = reader.index;
    if let Some((_, end)) = crate::read_number(reader.text, value_start)
        && reader.text.get(end).is_none_or(|byte| *byte <= b' ' || *byte == b';')
    {
        out.extend_from_slice(reader.text.get(value_start..end).unwrap_or_default());
        reader.index = end;
        return Ok(());
    }
    let value = reader.expression()?;
    write_number(out, value);
    Ok(())
}
