//! TOML to [`Value`]s, with the place of every key.

use super::{Source, located};
use skein::{Error, Place, Value};
use toml_edit::{Document, Item, Key, TableLike};

/// A profile's text, parsed.
pub(super) struct Text<'a> {
    source: &'a Source,
    document: Document<&'a str>,
}

/// One `key = value`.
pub(super) struct Assignment {
    /// The section, if any, and the name.
    pub key: Vec<String>,
    pub value: Value,
    pub key_place: Place,
    pub value_place: Place,
}

impl<'a> Text<'a> {
    pub fn read(source: &'a Source) -> Result<Self, Error> {
        let document = Document::parse(source.text.as_str()).map_err(|error| {
            let place = error.span().map_or(Place::Whole, |span| place(&source.text, span.start));
            let message = error.message().trim().replace('\n', ", ");
            let error = Error::new(message).hint(
                "a profile is TOML: lines like `walls = 2` below a line like `[fill]`, texts in quotes",
            );
            located(error, &source.name, &place)
        })?;
        Ok(Self { source, document })
    }

    /// The profile that this one is based on.
    pub fn inherits(&self) -> Result<Option<(String, Place)>, Error> {
        let Some(item) = self.document.get("inherits") else { return Ok(None) };
        let place = self.place_of(item);
        match item.as_str() {
            Some(name) => Ok(Some((name.to_owned(), place))),
            None => Err(located(
                Error::new("inherits is the name of a profile, in quotes"),
                &self.source.name,
                &place,
            )),
        }
    }

    /// Everything that is set, in the order of the text.
    pub fn assignments(&self) -> Result<Vec<Assignment>, Error> {
        let mut found = Vec::new();
        for (name, item) in self.document.iter() {
            if name == "inherits" {
                continue;
            }
            match item.as_table_like() {
                Some(section) => {
                    if section.iter().next().is_none() && !KNOWN_TOP.contains(&name) {
                        // An empty section says nothing, but its name may be wrong.
                        super::Profile::default().known_section(name).map_err(|error| {
                            let place = self.key_place(self.document.as_table(), name);
                            located(error, &self.source.name, &place)
                        })?;
                    }
                    for (key, item) in section.iter() {
                        found.push(self.assignment(&[name, key], section, item)?);
                    }
                }
                None => found.push(self.assignment(&[name], self.document.as_table(), item)?),
            }
        }
        Ok(found)
    }

    fn assignment(&self, path: &[&str], table: &dyn TableLike, item: &Item) -> Result<Assignment, Error> {
        let name = path.last().copied().unwrap_or_default();
        let (key_place, value_place) = (self.key_place(table, name), self.place_of(item));
        let value = value(item).map_err(|why| {
            located(Error::new(format!("{} {why}", path.join("."))), &self.source.name, &value_place)
        })?;
        Ok(Assignment {
            key: path.iter().map(|part| (*part).to_owned()).collect(),
            value,
            key_place,
            value_place,
        })
    }

    fn key_place(&self, table: &dyn TableLike, name: &str) -> Place {
        table.key(name).and_then(Key::span).map_or(Place::Whole, |span| place(&self.source.text, span.start))
    }

    fn place_of(&self, item: &Item) -> Place {
        item.span().map_or(Place::Whole, |span| place(&self.source.text, span.start))
    }
}

const KNOWN_TOP: &[&str] = &["chain", "sequence"];

impl super::Profile {
    /// Refuses a section that does not exist.
    fn known_section(&self, name: &str) -> Result<(), Error> {
        if self.sections().iter().any(|section| section.name == name) {
            return Ok(());
        }
        let error = Error::new(format!("there is no section `{name}`"));
        Err(match self.near(None, name) {
            Some(near) => error.hint(format!("did you mean `{near}`?")),
            None => error.hint("all settings: clayforge profile show clay"),
        })
    }
}

/// Line and column of a byte, both counted from one; the column in characters.
pub(super) fn place(text: &str, offset: usize) -> Place {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    Place::Text {
        line: before.bytes().filter(|byte| *byte == b'\n').count() + 1,
        column: before[line_start..].chars().count() + 1,
    }
}

fn value(item: &Item) -> Result<Value, String> {
    match item {
        Item::Value(value) => plain(value),
        Item::Table(table) => named(table),
        Item::ArrayOfTables(_) => Err("is a list of tables, which no setting is".to_owned()),
        Item::None => Err("has no value".to_owned()),
    }
}

fn plain(value: &toml_edit::Value) -> Result<Value, String> {
    use toml_edit::Value as Toml;
    Ok(match value {
        Toml::Boolean(value) => Value::Bool(*value.value()),
        // Beyond 2^53 a float is not exact; every bound is far below.
        Toml::Integer(value) => Value::Number(*value.value() as f64),
        Toml::Float(value) => Value::Number(*value.value()),
        Toml::String(value) => Value::Text(value.value().clone()),
        Toml::Datetime(value) => return Err(format!("= {} is a date, which no setting is", value.value())),
        Toml::Array(values) => Value::List(values.iter().map(plain).collect::<Result<_, _>>()?),
        Toml::InlineTable(values) => named(values)?,
    })
}

fn named(table: &dyn TableLike) -> Result<Value, String> {
    let entry = |(name, item): (&str, &Item)| value(item).map(|value| (name.to_owned(), value));
    table.iter().map(entry).collect::<Result<_, _>>().map(Value::Table)
}

/// A value as words of the command line have it: TOML, or a text without quotes.
pub(super) fn value_of(text: &str, wants_text: bool) -> Result<Value, Error> {
    let text = text.trim();
    match text.parse::<toml_edit::Value>() {
        Ok(value) if !wants_text || value.is_str() => plain(&value).map_err(Error::new),
        Ok(_) => Ok(Value::Text(text.to_owned())),
        Err(_) if wants_text || is_word(text) => Ok(Value::Text(text.to_owned())),
        Err(error) => {
            let message = error.message().lines().next().unwrap_or("it cannot be read").to_owned();
            Err(Error::new(format!("the value is no TOML: {message}"))
                .hint("quote it for the shell: --set 'machine.e_unit={ ram = 60 }'"))
        }
    }
}

fn is_word(text: &str) -> bool {
    let first = text.chars().next().is_some_and(char::is_alphabetic);
    first && text.chars().all(|letter| letter.is_alphanumeric() || "-_./ ".contains(letter))
}

/// A value as TOML spells it.
pub(super) fn spell(value: &Value) -> String {
    match value {
        Value::Bool(_) | Value::Number(_) => value.to_string(),
        Value::Text(text) => toml_edit::Value::from(text.as_str()).to_string(),
        Value::List(values) => format!("[{}]", values.iter().map(spell).collect::<Vec<_>>().join(", ")),
        Value::Table(values) => {
            let entries: Vec<String> =
                values.iter().map(|(name, value)| format!("{name} = {}", spell(value))).collect();
            format!("{{ {} }}", entries.join(", "))
        }
    }
}
