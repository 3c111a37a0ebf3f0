//! The manual: a page for each stage, a paragraph for each setting.

use crate::Profile;
use crate::profile::{bounds, wrapped};
use crate::stages::{STAGES, stage};
use skein::{Error, Field, Kind};
use std::fmt::Write;

/// What the manual says about a stage, a section or a setting: `fill`, `machine`, `fill.walls`.
///
/// # Errors
/// When there is no such thing; with what was probably meant.
pub fn explain(topic: &str) -> Result<String, Error> {
    let topic = topic.trim();
    let profile = Profile::default();
    let sections = profile.sections();
    if let Some((name, _)) = topic.split_once('.') {
        if let Some((field, _)) = profile.get(topic) {
            return Ok(setting(name, &field));
        }
    } else if let Some(section) = sections.iter().find(|section| section.name == topic) {
        let mut text = match stage(topic) {
            Some(entry) => format!("{}\n\n", entry.page.trim_end()),
            None => format!("# {topic}\n\n{}\n\n", section.about),
        };
        let _ = writeln!(text, "## All settings\n");
        for field in &section.fields {
            let _ = writeln!(text, "{}", setting(topic, field));
        }
        return Ok(text);
    }
    let keys = sections.iter().flat_map(|section| {
        let keys = section.fields.iter().map(|field| format!("{}.{}", section.name, field.name));
        std::iter::once(section.name.to_owned()).chain(keys.collect::<Vec<_>>())
    });
    let near = keys
        .map(|key| (strsim::jaro_winkler(&key, topic), key))
        .filter(|(score, _)| *score > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let names: Vec<&str> = STAGES.iter().map(|entry| entry.name).collect();
    let error = Error::new(format!("there is no stage and no setting `{topic}`")).said_by("explain");
    Err(match near {
        Some((_, key)) => error.hint(format!("did you mean `{key}`?")),
        None => error.hint(format!("there are machine, clay, {}", names.join(", "))),
    })
}

/// `fill.walls = 2`, what it does, and what it may be.
fn setting(section: &str, field: &Field) -> String {
    let unit = if field.unit.is_empty() { String::new() } else { format!(" {}", field.unit) };
    let mut text = format!("{section}.{} (default {}{unit})\n", field.name, field.default);
    for line in wrapped(field.about, 96) {
        let _ = writeln!(text, "    {line}");
    }
    let kind = match field.kind {
        Kind::Switch => "true or false".to_owned(),
        Kind::Count => format!("a whole number, {}", bounds(field)),
        Kind::Number => format!("a number, {}", bounds(field)),
        Kind::Text => "a text in quotes".to_owned(),
        Kind::Choice(_) => "one of".to_owned(),
        Kind::Form(form) => match bounds(field) {
            bounds if bounds.is_empty() => form.to_owned(),
            bounds => format!("{form}, {bounds}"),
        },
    };
    let _ = writeln!(
        text,
        "    It is {}{}",
        kind.trim_end_matches(", "),
        if matches!(field.kind, Kind::Choice(_)) { ":" } else { "." }
    );
    if let Kind::Choice(words) = field.kind {
        for (word, about) in words {
            let _ = writeln!(text, "      {word:?}: {about}");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::explain;

    #[test]
    fn a_setting_says_default_unit_and_bounds() {
        let text = explain("carve.layer_height").expect("known");
        assert!(text.starts_with("carve.layer_height (default 1.5 mm)\n"), "{text}");
        assert!(text.contains("0.05 to 100 mm"), "{text}");
    }

    #[test]
    fn whoever_mistypes_is_helped() {
        assert_eq!(
            explain("fill.wals").expect_err("unknown").hint.as_deref(),
            Some("did you mean `fill.walls`?")
        );
        for topic in ["fill", "machine", "clay", "fill.active", "machine.e_unit"] {
            explain(topic).unwrap_or_else(|error| panic!("{error}"));
        }
        for topic in ["", ".", "ü", "fill.", "nonsense.nonsense"] {
            assert!(explain(topic).is_err());
        }
    }
}
