//! Expressions, read and computed in one go.
//!
//! RS274 and Fanuc bracket with `[ ]` and name variables `#1` and `#<name>`; Siemens brackets with `( )` and names them
//! `R1`, `R[1]` or by a word. All bind powers first, then products, sums, comparisons and logic, and from left to right.

use super::variables::Store;
use crate::flavor::Variables;
use crate::number::read_number;
use std::borrow::Cow;

/// Why an expression has no value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    /// The byte of the line.
    pub index: usize,
    pub why: Cow<'static, str>,
}

pub(super) type Value<T> = Result<T, Fault>;

/// A variable that is assigned to or read.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Name {
    Number(u32),
    Text(Vec<u8>),
}

/// Reads one line from left to right.
pub(super) struct Reader<'a, 's> {
    pub text: &'a [u8],
    pub index: usize,
    pub store: &'s Store,
    pub dialect: Variables,
    /// How deep in brackets.
    depth: u32,
    /// How many operands and operators this line has.
    tokens: u32,
}

const DEEPEST: u32 = 64;
const MOST_TOKENS: u32 = 256;
/// Two numbers are equal in a comparison if they differ by less.
const EQUAL: f64 = 1e-6;

/// Binary operators: spelling, how strongly it binds, and what it does.
type Operator = (&'static [u8], u8, fn(f64, f64) -> f64);

const OPERATORS: &[Operator] = &[
    (b"**", 5, |a, b| libm::pow(a, b)),
    (b"*", 4, |a, b| a * b),
    (b"/", 4, |a, b| a / b),
    (b"MOD", 4, modulo),
    (b"DIV", 4, |a, b| (a / b).trunc()),
    (b"+", 3, |a, b| a + b),
    (b"-", 3, |a, b| a - b),
    (b"==", 2, |a, b| truth((a - b).abs() < EQUAL)),
    (b"<>", 2, |a, b| truth((a - b).abs() >= EQUAL)),
    (b"<=", 2, |a, b| truth(a <= b)),
    (b">=", 2, |a, b| truth(a >= b)),
    (b"<", 2, |a, b| truth(a < b)),
    (b">", 2, |a, b| truth(a > b)),
    (b"EQ", 2, |a, b| truth((a - b).abs() < EQUAL)),
    (b"NE", 2, |a, b| truth((a - b).abs() >= EQUAL)),
    (b"GE", 2, |a, b| truth(a >= b)),
    (b"GT", 2, |a, b| truth(a > b)),
    (b"LE", 2, |a, b| truth(a <= b)),
    (b"LT", 2, |a, b| truth(a < b)),
    (b"AND", 1, |a, b| truth(a != 0.0 && b != 0.0)),
    (b"XOR", 1, |a, b| truth((a != 0.0) != (b != 0.0))),
    (b"OR", 1, |a, b| truth(a != 0.0 || b != 0.0)),
];

fn truth(holds: bool) -> f64 {
    f64::from(u8::from(holds))
}

/// The remainder with the sign of the divisor.
fn modulo(a: f64, b: f64) -> f64 {
    a - b * (a / b).floor()
}

/// Functions of one number, angles in degrees.
type Function = (&'static [u8], fn(f64) -> f64);

const FUNCTIONS: &[Function] = &[
    (b"ABS", f64::abs),
    (b"ACOS", |x| libm::acos(x).to_degrees()),
    (b"ASIN", |x| libm::asin(x).to_degrees()),
    (b"COS", |x| libm::cos(x.to_radians())),
    (b"EXP", libm::exp),
    (b"LN", libm::log),
    (b"ROUND", f64::round),
    (b"SIN", |x| libm::sin(x.to_radians())),
    (b"SQRT", f64::sqrt),
    (b"TAN", |x| libm::tan(x.to_radians())),
    (b"TRUNC", f64::trunc),
    (b"POT", |x| x * x),
    (b"NOT", |x| truth(x == 0.0)),
];

/// `FIX` and `FUP` go down and up in RS274, towards zero and away from it in Fanuc.
fn fix(dialect: Variables, up: bool, value: f64) -> f64 {
    let away = if value < 0.0 { value.floor() } else { value.ceil() };
    match (dialect, up) {
        (Variables::Fanuc, false) => value.trunc(),
        (Variables::Fanuc, true) => away,
        (_, false) => value.floor(),
        (_, true) => value.ceil(),
    }
}

impl<'a, 's> Reader<'a, 's> {
    pub fn new(text: &'a [u8], index: usize, store: &'s Store, dialect: Variables) -> Self {
        Self { text, index, store, dialect, depth: 0, tokens: 0 }
    }

    pub fn fault<T>(&self, why: impl Into<Cow<'static, str>>) -> Value<T> {
        Err(Fault { index: self.index, why: why.into() })
    }

    /// The next byte that is no blank.
    pub fn peek(&mut self) -> Option<u8> {
        while self.text.get(self.index).is_some_and(|&byte| byte <= b' ') {
            self.index += 1;
        }
        self.text.get(self.index).copied()
    }

    /// Whether `word`, in upper case, comes next, in either case; then it is taken. Letters must not go on
    /// with letters, nor digits with digits.
    pub fn take(&mut self, word: &[u8]) -> bool {
        self.peek();
        let rest = self.text.get(self.index..).unwrap_or_default();
        let Some((start, behind)) = rest.split_at_checked(word.len()) else { return false };
        let goes_on = match (word.last(), behind.first()) {
            (Some(last), Some(next)) if last.is_ascii_alphabetic() => {
                next.is_ascii_alphabetic() || *next == b'_'
            }
            (Some(last), Some(next)) if last.is_ascii_digit() => next.is_ascii_digit(),
            _ => false,
        };
        if !start.eq_ignore_ascii_case(word) || goes_on {
            return false;
        }
        self.index += word.len();
        true
    }

    fn expect(&mut self, byte: u8) -> Value<()> {
        if self.peek() != Some(byte) {
            return self.fault(format!("`{}` is missing", char::from(byte)));
        }
        self.index += 1;
        Ok(())
    }

    fn is_siemens(&self) -> bool {
        self.dialect == Variables::Siemens
    }

    /// A whole expression: operands and operators.
    pub fn expression(&mut self) -> Value<f64> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return self.fault("brackets are nested too deep");
        }
        let value = self.operation(1);
        self.depth -= 1;
        value
    }

    /// Operands joined by operators that bind at least as strongly as `level`.
    fn operation(&mut self, level: u8) -> Value<f64> {
        if level > 5 {
            return self.operand();
        }
        let mut value = self.operation(level + 1)?;
        while let Some(operate) = self.operator(level) {
            let right = self.operation(level + 1)?;
            value = self.finite(operate(value, right))?;
        }
        Ok(value)
    }

    /// The operator that comes next, if it binds as strongly as `level`; else nothing is taken, not even blanks.
    fn operator(&mut self, level: u8) -> Option<fn(f64, f64) -> f64> {
        let before = self.index;
        let begins = |byte: u8| byte.is_ascii_alphabetic() || b"*/+-=<>".contains(&byte);
        let mut longest: Option<(&Operator, usize)> = None;
        if self.peek().is_some_and(begins) {
            let start = self.index;
            for operator in OPERATORS {
                self.index = start;
                if self.take(operator.0) && longest.is_none_or(|(found, _)| operator.0.len() > found.0.len())
                {
                    longest = Some((operator, self.index));
                }
            }
        }
        self.index = before;
        let (&(_, _, operate), end) = longest.filter(|(operator, _)| operator.1 == level)?;
        self.index = end;
        Some(operate)
    }

    fn finite(&self, value: f64) -> Value<f64> {
        if value.is_finite() { Ok(value) } else { self.fault("the result is no number") }
    }

    /// A number, a variable, a function, or an expression in brackets, with or without a sign.
    pub fn operand(&mut self) -> Value<f64> {
        self.tokens += 1;
        if self.tokens > MOST_TOKENS {
            return self.fault("an expression is too long");
        }
        let first = self.peek();
        match first {
            Some(b'[') if !self.is_siemens() => self.bracketed(b'[', b']'),
            Some(b'(') if self.is_siemens() => self.bracketed(b'(', b')'),
            Some(b'0'..=b'9' | b'.') => self.literal(),
            Some(sign @ (b'+' | b'-')) => {
                self.index += 1;
                self.depth += 1;
                if self.depth > DEEPEST {
                    return self.fault("too many signs");
                }
                let value = self.operand()?;
                self.depth -= 1;
                Ok(if sign == b'-' { -value } else { value })
            }
            Some(b'#') if !self.is_siemens() => {
                let name = self.variable()?;
                self.value_of(&name)
            }
            Some(b'A'..=b'Z' | b'a'..=b'z' | b'_') => self.named_operand(),
            _ => self.fault("a value is missing"),
        }
    }

    fn literal(&mut self) -> Value<f64> {
        let Some((value, end)) = read_number(self.text, self.index) else {
            return self.fault("this is no number");
        };
        self.index = end;
        Ok(value)
    }

    fn bracketed(&mut self, open: u8, close: u8) -> Value<f64> {
        self.expect(open)?;
        let value = self.expression()?;
        self.expect(close)?;
        Ok(value)
    }

    fn brackets(&self) -> (u8, u8) {
        if self.is_siemens() { (b'(', b')') } else { (b'[', b']') }
    }

    /// A function, or a variable of Siemens.
    fn named_operand(&mut self) -> Value<f64> {
        let (open, close) = self.brackets();
        if self.take(b"EXISTS") {
            self.expect(open)?;
            let name = self.variable()?;
            self.expect(close)?;
            return Ok(truth(self.get(&name).is_some()));
        }
        if self.take(b"ATAN2") {
            self.expect(open)?;
            let y = self.expression()?;
            self.expect(b',')?;
            let x = self.expression()?;
            self.expect(close)?;
            return Ok(libm::atan2(y, x).to_degrees());
        }
        if self.take(b"ATAN") {
            let y = self.bracketed(open, close)?;
            if self.peek() != Some(b'/') {
                return Ok(libm::atan(y).to_degrees());
            }
            self.index += 1;
            let x = self.bracketed(open, close)?;
            return Ok(libm::atan2(y, x).to_degrees());
        }
        for (word, up) in [(b"FIX", false), (b"FUP", true)] {
            if self.take(word) {
                let value = self.bracketed(open, close)?;
                return Ok(fix(self.dialect, up, value));
            }
        }
        for &(word, function) in FUNCTIONS {
            if self.take(word) {
                let value = if word == b"NOT" { self.operand()? } else { self.bracketed(open, close)? };
                return self.finite(function(value));
            }
        }
        if self.is_siemens() {
            if self.take(b"TRUE") {
                return Ok(1.0);
            }
            if self.take(b"FALSE") {
                return Ok(0.0);
            }
            let name = self.variable()?;
            return self.value_of(&name);
        }
        self.fault("this is no function")
    }

    /// The name of a variable.
    pub fn variable(&mut self) -> Value<Name> {
        if self.is_siemens() {
            return self.siemens_variable();
        }
        self.expect(b'#')?;
        self.depth += 1;
        if self.depth > DEEPEST {
            return self.fault("too many `#`");
        }
        let name = match self.peek() {
            Some(b'<') => {
                let rest = self.text.get(self.index + 1..).unwrap_or_default();
                let Some(length) = crate::find_byte(b'>', rest) else { return self.fault("`>` is missing") };
                let name = rest.get(..length).unwrap_or_default();
                self.index += length + 2;
                // Blanks and case do not count.
                let plain = name.iter().filter(|byte| !byte.is_ascii_whitespace());
                Name::Text(plain.map(u8::to_ascii_lowercase).collect())
            }
            Some(b'#') => {
                let inner = self.variable()?;
                let value = self.value_of(&inner)?;
                self.numbered(value)?
            }
            Some(b'[') => {
                let value = self.bracketed(b'[', b']')?;
                self.numbered(value)?
            }
            _ => {
                let value = self.literal()?;
                self.numbered(value)?
            }
        };
        self.depth -= 1;
        Ok(name)
    }

    fn siemens_variable(&mut self) -> Value<Name> {
        self.peek();
        let rest = self.text.get(self.index..).unwrap_or_default();
        if let [b'R' | b'r', next, ..] = rest {
            if *next == b'[' {
                self.index += 1;
                let value = self.bracketed_index()?;
                return self.numbered(value);
            }
            if next.is_ascii_digit() {
                self.index += 1;
                let value = self.literal()?;
                return self.numbered(value);
            }
        }
        let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        let length = rest.iter().position(|byte| !is_part(byte)).unwrap_or(rest.len());
        if length == 0 {
            return self.fault("a variable is missing");
        }
        self.index += length;
        Ok(Name::Text(rest.get(..length).unwrap_or_default().to_ascii_uppercase()))
    }

    fn bracketed_index(&mut self) -> Value<f64> {
        self.expect(b'[')?;
        let value = self.expression()?;
        self.expect(b']')?;
        Ok(value)
    }

    fn numbered(&self, value: f64) -> Value<Name> {
        const LARGEST: f64 = 1e6;
        let whole = value.round();
        if !(0.0..=LARGEST).contains(&whole) || (value - whole).abs() > EQUAL {
            return self.fault("this is no number of a variable");
        }
        Ok(Name::Number(whole as u32))
    }

    pub fn get(&self, name: &Name) -> Option<f64> {
        match name {
            Name::Number(number) => self.store.number(*number),
            Name::Text(name) => self.store.name(name),
        }
    }

    /// What a variable holds. A number that nobody has set is 0, a name is a mistake.
    fn value_of(&self, name: &Name) -> Value<f64> {
        match (self.get(name), name) {
            (Some(value), _) => Ok(value),
            (None, Name::Number(_)) => Ok(0.0),
            (None, Name::Text(name)) => {
                self.fault(format!("`{}` has no value", String::from_utf8_lossy(name)))
            }
        }
    }

    /// Whether a function or an expression can begin with the letters at `index`.
    pub fn is_function(text: &[u8], index: usize) -> bool {
        let rest = text.get(index..).unwrap_or_default();
        let length = rest.iter().position(|byte| !byte.is_ascii_alphabetic()).unwrap_or(rest.len());
        let word = rest.get(..length).unwrap_or_default();
        let known = FUNCTIONS.iter().map(|&(name, _)| name).chain([&b"ATAN"[..], b"FIX", b"FUP", b"EXISTS"]);
        rest.get(length) == Some(&b'[') && known.into_iter().any(|name| name.eq_ignore_ascii_case(word))
    }
}
