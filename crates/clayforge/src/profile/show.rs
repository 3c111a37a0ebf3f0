//! Profiles as text: the effective one, the schema, and one to begin with.

use super::toml::spell;
use super::{Profile, Section};
use serde_json::{Map, Value as Json, json};
use skein::{Field, Kind, Value};
use std::fmt::Write;

impl Profile {
    /// The whole profile as TOML; reading it gives the same profile.
    pub fn show(&self) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "chain = {:?}", self.chain.word());
        if let Some(sequence) = &self.sequence {
            let _ = writeln!(text, "sequence = {sequence:?}");
        }
        for section in self.sections() {
            let _ = writeln!(text, "\n[{}]", section.name);
            for (field, value) in section.fields.iter().zip(&section.values) {
                let _ = writeln!(text, "{}", assignment(field, value));
            }
        }
        text
    }
}

/// `walls = 2` with the unit behind it.
fn assignment(field: &Field, value: &Value) -> String {
    let text = format!("{} = {}", field.name, spell(value));
    if field.unit.is_empty() || text.contains('\n') { text } else { format!("{text} # {}", field.unit) }
}

/// A profile to begin with: every setting with its manual, at its default and switched off by a `#`.
pub fn starter() -> String {
    let mut text = String::from(
        "# A profile of your own. A line without # in front counts; every other setting is inherited.\n\
         # Lengths are millimetres, speeds millimetres per second.\n\n\
         inherits = \"clay\"\n\n\
         # The order of the stages: \"clay\", or \"seed\" for the literal order of the seed.\n\
         # chain = \"clay\"\n",
    );
    for Section { name, about, fields, .. } in Profile::default().sections() {
        let _ = writeln!(text, "\n# {about}\n[{name}]");
        for field in fields {
            let _ = writeln!(text);
            for line in wrapped(field.about, 98) {
                let _ = writeln!(text, "# {line}");
            }
            let bounds = bounds(&field);
            if !bounds.is_empty() {
                let _ = writeln!(text, "# {bounds}");
            }
            if let Kind::Choice(words) = field.kind {
                for (word, about) in words {
                    let _ = writeln!(text, "#   {word:?}: {about}");
                }
            }
            for line in assignment(&field, &field.default).lines() {
                let _ = writeln!(text, "# {line}");
            }
        }
    }
    text
}

/// `0 to 1000 mm`, as far as there are bounds.
pub(crate) fn bounds(field: &Field) -> String {
    let unit = if field.unit.is_empty() { String::new() } else { format!(" {}", field.unit) };
    match (field.min, field.max) {
        (Some(min), Some(max)) => format!("{min} to {max}{unit}"),
        (Some(min), None) => format!("at least {min}{unit}"),
        (None, Some(max)) => format!("at most {max}{unit}"),
        (None, None) => String::new(),
    }
}

/// A paragraph as lines of a width.
pub(crate) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The JSON schema of a profile, for editors that know TOML.
pub fn schema() -> String {
    let mut properties = Map::new();
    properties.insert(
        "inherits".into(),
        json!({ "type": "string", "description": "The profile this one is based on: a name or a file." }),
    );
    properties.insert(
        "chain".into(),
        json!({ "enum": ["clay", "seed"], "description": "The order of the stages." }),
    );
    let names: Vec<&str> = crate::STAGES.iter().map(|entry| entry.name).collect();
    properties.insert(
        "sequence".into(),
        json!({ "type": "array", "items": { "enum": names }, "uniqueItems": true, "description": "An order of your own." }),
    );
    for Section { name, about, fields, .. } in Profile::default().sections() {
        let keys: Map<String, Json> =
            fields.iter().map(|field| (field.name.to_owned(), field_schema(field))).collect();
        properties.insert(
            name.to_owned(),
            json!({ "type": "object", "description": about, "properties": keys, "additionalProperties": false }),
        );
    }
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "clayforge profile",
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
    });
    format!("{schema:#}\n")
}

fn field_schema(field: &Field) -> Json {
    let mut schema = Map::new();
    let mut about = field.about.to_owned();
    if !field.unit.is_empty() {
        let _ = write!(about, " Unit: {}.", field.unit);
    }
    let kind = match field.kind {
        Kind::Switch => Some("boolean"),
        Kind::Count => Some("integer"),
        Kind::Number => Some("number"),
        Kind::Text => Some("string"),
        Kind::Choice(words) => {
            let choices: Vec<Json> =
                words.iter().map(|(word, about)| json!({ "const": word, "description": about })).collect();
            schema.insert("oneOf".into(), Json::Array(choices));
            None
        }
        Kind::Form(form) => {
            let _ = write!(about, " Form: {form}.");
            None
        }
    };
    if let Some(kind) = kind {
        schema.insert("type".into(), kind.into());
    }
    if matches!(field.kind, Kind::Count | Kind::Number) {
        for (name, bound) in [("minimum", field.min), ("maximum", field.max)] {
            if let Some(bound) = bound {
                schema.insert(name.into(), bound.into());
            }
        }
    }
    schema.insert("description".into(), about.into());
    schema.insert("default".into(), to_json(&field.default));
    Json::Object(schema)
}

/// A value as JSON.
fn to_json(value: &Value) -> Json {
    match value {
        Value::Bool(value) => json!(value),
        Value::Number(value) => json!(value),
        Value::Text(value) => json!(value),
        Value::List(values) => Json::Array(values.iter().map(to_json).collect()),
        Value::Table(values) => {
            Json::Object(values.iter().map(|(name, value)| (name.clone(), to_json(value))).collect())
        }
    }
}
