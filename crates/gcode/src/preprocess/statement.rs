//! The lines of a program as statements, with their jumps linked.

use super::expression::Reader;
use super::variables::Store;
use crate::diagnostic::{Diagnostic, Problem};
use crate::flavor::Variables;
use crate::parse::cut_line;
use std::borrow::Cow;
use std::collections::HashMap;

/// What a line does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Is emitted, after its values are computed and its assignments are made.
    Plain,
    /// A definition: passed over when it is come to.
    Sub,
    EndSub,
    Return,
    Call,
    /// `O100` alone begins the program of that number.
    Program,
    /// `M98` and `G65`.
    CallProgram,
    /// `M99`, `M17`, `RET`.
    EndProgram,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    /// `LOOP`: for ever.
    Loop,
    For,
    Repeat,
    Do,
    /// Ends a loop that is tested or counted where it begins.
    EndLoop,
    /// Ends a `Do` that goes on while the condition holds.
    DoWhile,
    /// Ends a `Do` that goes on until the condition holds.
    Until,
    Break,
    Continue,
    /// `IF … GOTO` and `IF … THEN`.
    Condition,
    Goto,
    /// `REPEAT label P=n`.
    RepeatFrom,
    /// `DEF REAL a, b=2`.
    Define,
}

/// A line and what it does.
#[derive(Clone, Debug)]
pub(super) struct Statement<'a> {
    pub line: u32,
    pub text: &'a [u8],
    pub kind: Kind,
    /// Behind the word that says so.
    pub rest: usize,
    /// Where it goes on: the next branch of an `If`; the other end of a loop; the end of what a `Break` leaves.
    pub next: usize,
    /// The last line of the branches of an `If`.
    pub end: usize,
}

/// A program.
#[derive(Debug, Default)]
pub(super) struct Statements<'a> {
    pub list: Vec<Statement<'a>>,
    /// Named subroutines and numbered programs.
    pub subs: HashMap<Vec<u8>, usize>,
    /// Where each label stands, from the top.
    pub labels: HashMap<Vec<u8>, Vec<usize>>,
    open: Vec<Open>,
}

/// A block whose end has not come.
#[derive(Debug)]
struct Open {
    start: usize,
    label: Vec<u8>,
    /// The branches of an `If`; the breaks of a loop.
    parts: Vec<usize>,
}

/// A keyword and what it says.
type Keyword = (&'static [u8], Kind);

const O_WORDS: &[Keyword] = &[
    (b"SUB", Kind::Sub),
    (b"ENDSUB", Kind::EndSub),
    (b"RETURN", Kind::Return),
    (b"CALL", Kind::Call),
    (b"IF", Kind::If),
    (b"ELSEIF", Kind::ElseIf),
    (b"ELSE", Kind::Else),
    (b"ENDIF", Kind::EndIf),
    (b"WHILE", Kind::While),
    (b"ENDWHILE", Kind::EndLoop),
    (b"DO", Kind::Do),
    (b"REPEAT", Kind::Repeat),
    (b"ENDREPEAT", Kind::EndLoop),
    (b"BREAK", Kind::Break),
    (b"CONTINUE", Kind::Continue),
];

const SIEMENS: &[Keyword] = &[
    (b"IF", Kind::If),
    (b"ELSE", Kind::Else),
    (b"ENDIF", Kind::EndIf),
    (b"WHILE", Kind::While),
    (b"ENDWHILE", Kind::EndLoop),
    (b"FOR", Kind::For),
    (b"ENDFOR", Kind::EndLoop),
    (b"LOOP", Kind::Loop),
    (b"ENDLOOP", Kind::EndLoop),
    (b"REPEAT", Kind::Do),
    (b"UNTIL", Kind::Until),
    (b"GOTOF", Kind::Goto),
    (b"GOTOB", Kind::Goto),
    (b"GOTO", Kind::Goto),
    (b"DEF", Kind::Define),
    (b"M17", Kind::EndProgram),
    (b"RET", Kind::EndProgram),
];

/// Words of Siemens' language that are not run.
const SIEMENS_UNKNOWN: &[&[u8]] = &[b"CASE", b"PROC", b"EXTERN", b"CALL", b"REPEATB", b"MCALL"];

/// Whether a line of Siemens begins with a word of its language.
pub(super) fn has_siemens_keyword(start: &[u8]) -> bool {
    let begins = |word: &[u8]| start.get(..word.len()).is_some_and(|found| found.eq_ignore_ascii_case(word));
    let behind_number = matches!(start, [b'N' | b'n', b'0'..=b'9', ..]);
    behind_number
        || SIEMENS.iter().any(|(word, _)| begins(word))
        || SIEMENS_UNKNOWN.iter().any(|word| begins(word))
}

fn problem(line: u32, index: usize, why: impl Into<Cow<'static, str>>) -> Diagnostic {
    let column = u32::try_from(index).map_or(u32::MAX, |index| index.saturating_add(1));
    Diagnostic { line, column, kind: Problem::Preprocess(why.into()) }
}

impl<'a> Statements<'a> {
    /// Reads a program.
    pub fn read(text: &'a [u8], dialect: Variables) -> Result<Self, Diagnostic> {
        let mut statements = Self::default();
        let mut rest = crate::without_bom(text);
        let mut line: u32 = 0;
        // Names no variable is needed to read.
        let store = Store::new(0, 0);
        while !rest.is_empty() {
            let (text, behind) = cut_line(rest);
            rest = behind;
            line =
                line.checked_add(1).ok_or_else(|| problem(u32::MAX, 0, "more lines than can be counted"))?;
            let mut reader = Reader::new(text, 0, &store, dialect);
            match dialect {
                Variables::Siemens => statements.read_siemens(line, &mut reader)?,
                _ => statements.read_rs274(line, &mut reader)?,
            }
        }
        match statements.open.last() {
            None => Ok(statements),
            Some(open) => {
                let line = statements.list.get(open.start).map_or(0, |statement| statement.line);
                Err(problem(line, 0, "nothing ends this block"))
            }
        }
    }

    fn push(&mut self, line: u32, reader: &Reader<'a, '_>, kind: Kind) -> usize {
        let index = self.list.len();
        self.list.push(Statement {
            line,
            text: reader.text,
            kind,
            rest: reader.index,
            next: index,
            end: index,
        });
        index
    }

    fn read_rs274(&mut self, line: u32, reader: &mut Reader<'a, '_>) -> Result<(), Diagnostic> {
        if reader.peek() == Some(b'/') {
            reader.index += 1;
        }
        if let Some(label) = take_number(reader, b"N") {
            self.labels.entry(label).or_default().push(self.list.len());
        }
        if matches!(reader.peek(), Some(b'O' | b'o')) {
            return self.read_o_word(line, reader);
        }
        if reader.take(b"WHILE") {
            let label = last_number(reader.text, b"DO");
            return self.link(line, reader, Kind::While, label);
        }
        if let Some(label) = take_number(reader, b"DO") {
            return self.link(line, reader, Kind::Loop, label);
        }
        if let Some(label) = take_number(reader, b"END") {
            return self.link(line, reader, Kind::EndLoop, label);
        }
        let kind = if reader.take(b"IF") {
            Kind::Condition
        } else if reader.take(b"GOTO") {
            Kind::Goto
        } else if reader.take(b"M98") || (reader.dialect == Variables::Fanuc && reader.take(b"G65")) {
            Kind::CallProgram
        } else if reader.take(b"M99") {
            Kind::EndProgram
        } else if reader.dialect == Variables::Fanuc && (reader.take(b"G66") || reader.take(b"G67")) {
            return Err(problem(line, reader.index, "modal calls (G66) are not run"));
        } else {
            Kind::Plain
        };
        self.push(line, reader, kind);
        Ok(())
    }

    fn read_o_word(&mut self, line: u32, reader: &mut Reader<'a, '_>) -> Result<(), Diagnostic> {
        let start = reader.index;
        reader.index += 1;
        let label = if reader.peek() == Some(b'<') {
            let rest = reader.text.get(reader.index + 1..).unwrap_or_default();
            let length =
                crate::find_byte(b'>', rest).ok_or_else(|| problem(line, start, "`>` is missing"))?;
            reader.index += length + 2;
            let name = rest.get(..length).unwrap_or_default();
            name.iter().filter(|byte| !byte.is_ascii_whitespace()).map(u8::to_ascii_lowercase).collect()
        } else {
            take_digits(reader).ok_or_else(|| problem(line, start, "an O word has a number or a name"))?
        };
        let Some(&(_, kind)) = O_WORDS.iter().find(|(word, _)| reader.take(word)) else {
            let index = self.push(line, reader, Kind::Program);
            if self.subs.insert(label, index).is_some() {
                return Err(problem(line, start, "there are two programs of this name"));
            }
            return Ok(());
        };
        match kind {
            Kind::Call | Kind::Return => {
                // The name is read again when it is run.
                reader.index = start;
                self.push(line, reader, kind);
                Ok(())
            }
            _ => self.link(line, reader, kind, label),
        }
    }

    fn read_siemens(&mut self, line: u32, reader: &mut Reader<'a, '_>) -> Result<(), Diagnostic> {
        if reader.peek() == Some(b'/') {
            reader.index += 1;
        }
        take_number(reader, b"N");
        if let Some(label) = take_label(reader) {
            self.labels.entry(label).or_default().push(self.list.len());
        }
        let start = reader.index;
        if let Some(word) = SIEMENS_UNKNOWN.iter().find(|word| reader.take(word)) {
            let text = format!("`{}` is not run", String::from_utf8_lossy(word));
            return Err(problem(line, start, text));
        }
        let found = SIEMENS.iter().find(|(word, _)| reader.take(word)).map_or(Kind::Plain, |&(_, kind)| kind);
        let rest = reader.text.get(reader.index..).unwrap_or_default();
        let upper = rest.split(|&byte| byte == b';').next().unwrap_or_default().to_ascii_uppercase();
        let kind = match found {
            Kind::If if upper.windows(4).any(|word| word == b"GOTO") => Kind::Condition,
            Kind::Do if !upper.trim_ascii().is_empty() => Kind::RepeatFrom,
            kind => kind,
        };
        match kind {
            Kind::Plain | Kind::Condition | Kind::RepeatFrom | Kind::Define | Kind::EndProgram => {
                self.push(line, reader, kind);
                Ok(())
            }
            Kind::Goto => {
                // Which of the three it is, is read again when it is run.
                reader.index = start;
                self.push(line, reader, kind);
                Ok(())
            }
            _ => self.link(line, reader, kind, Vec::new()),
        }
    }

    /// Adds a statement that begins, divides, leaves or ends a block.
    fn link(
        &mut self,
        line: u32,
        reader: &Reader<'a, '_>,
        mut kind: Kind,
        label: Vec<u8>,
    ) -> Result<(), Diagnostic> {
        let top =
            self.open.last().filter(|open| open.label == label).and_then(|open| self.list.get(open.start));
        let top = top.map(|statement| statement.kind);
        if kind == Kind::While && top == Some(Kind::Do) {
            kind = Kind::DoWhile;
        }
        let index = self.push(line, reader, kind);
        let expected: &[Kind] = match kind {
            Kind::Sub | Kind::If | Kind::While | Kind::Loop | Kind::For | Kind::Repeat | Kind::Do => {
                if kind == Kind::Sub && self.subs.insert(label.clone(), index).is_some() {
                    return Err(problem(line, 0, "there are two subroutines of this name"));
                }
                self.open.push(Open { start: index, label, parts: Vec::new() });
                return Ok(());
            }
            Kind::Break | Kind::Continue => return self.leave(line, index, &label),
            Kind::EndSub => &[Kind::Sub],
            Kind::ElseIf | Kind::Else | Kind::EndIf => &[Kind::If],
            Kind::DoWhile | Kind::Until => &[Kind::Do],
            _ => &[Kind::While, Kind::Loop, Kind::For, Kind::Repeat],
        };
        if !top.is_some_and(|top| expected.contains(&top)) {
            return Err(problem(line, 0, "nothing is open that this could end or divide"));
        }
        if matches!(kind, Kind::ElseIf | Kind::Else) {
            self.open.iter_mut().last().into_iter().for_each(|open| open.parts.push(index));
            return Ok(());
        }
        if let Some(open) = self.open.pop() {
            self.close(&open, kind, index);
        }
        Ok(())
    }

    /// Links what leaves the innermost loop of this label.
    fn leave(&mut self, line: u32, index: usize, label: &[u8]) -> Result<(), Diagnostic> {
        let list = &self.list;
        let is_loop = |open: &&mut Open| {
            open.label == label
                && list.get(open.start).is_some_and(|start| !matches!(start.kind, Kind::If | Kind::Sub))
        };
        let open = self.open.iter_mut().rev().find(is_loop);
        open.map(|open| open.parts.push(index)).ok_or_else(|| problem(line, 0, "there is no loop to leave"))
    }

    fn close(&mut self, open: &Open, kind: Kind, end: usize) {
        let mut link = |from: usize, next: usize| {
            if let Some(statement) = self.list.get_mut(from) {
                statement.next = next;
                statement.end = end;
            }
        };
        if kind == Kind::EndIf {
            let mut before = open.start;
            for &part in open.parts.iter().chain([&end]) {
                link(before, part);
                before = part;
            }
            return;
        }
        link(open.start, end);
        link(end, open.start);
        open.parts.iter().for_each(|&part| link(part, end));
    }
}

/// Reads `word` and the digits behind it, if both come next.
fn take_number(reader: &mut Reader<'_, '_>, word: &[u8]) -> Option<Vec<u8>> {
    let start = reader.index;
    let digits = if reader.take(word) { take_digits(reader) } else { None };
    if digits.is_none() {
        reader.index = start;
    }
    digits
}

/// The digits that come next, without zeros in front.
pub(super) fn take_digits(reader: &mut Reader<'_, '_>) -> Option<Vec<u8>> {
    reader.peek();
    let rest = reader.text.get(reader.index..).unwrap_or_default();
    let length = rest.iter().position(|byte| !byte.is_ascii_digit()).unwrap_or(rest.len());
    let digits = rest.get(..length).filter(|digits| !digits.is_empty())?;
    reader.index += length;
    let zeros = digits.iter().take(length - 1).take_while(|&&byte| byte == b'0').count();
    Some(digits.get(zeros..).unwrap_or_default().to_vec())
}

/// The digits behind the last `word` of a line.
fn last_number(text: &[u8], word: &[u8]) -> Vec<u8> {
    let upper = text.to_ascii_uppercase();
    let at = upper.windows(word.len()).rposition(|window| window == word);
    let rest = at.and_then(|at| upper.get(at + word.len()..)).unwrap_or_default().trim_ascii();
    rest.iter().copied().take_while(u8::is_ascii_digit).collect()
}

/// A label of Siemens: a name of two characters or more, and a colon.
fn take_label(reader: &mut Reader<'_, '_>) -> Option<Vec<u8>> {
    reader.peek();
    let rest = reader.text.get(reader.index..).unwrap_or_default();
    let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    let length = rest.iter().position(|byte| !is_part(byte)).unwrap_or(rest.len());
    if length < 2 || rest.get(length) != Some(&b':') || rest.get(length + 1) == Some(&b'=') {
        return None;
    }
    reader.index += length + 1;
    rest.get(..length).map(<[u8]>::to_ascii_uppercase)
}
