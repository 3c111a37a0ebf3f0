//! A flavor of G-code from TOML: the keys of [`Flavor::KEYS`], and `inherits` for the built-in one that it changes.

use super::toml::place;
use gcode::Flavor;
use skein::{Error, Place};
use toml_edit::{Document, Value};

/// The flavor that `text` describes. Without `inherits` it is Marlin with changes.
///
/// # Errors
///
/// The text is no TOML, a key is unknown, or a value has another form; each with its place.
///
/// ```
/// let mine = clayforge::read_flavor("inherits = \"siemens\"\nname = \"cead\"\nbead_on = \"CLAY\"\n")?;
/// assert_eq!((&*mine.name, &*mine.bead_on, mine.named_words), ("cead", "CLAY", true));
/// let error = clayforge::read_flavor("rapid = true\ndwell = [\"P h\"]").unwrap_err();
/// assert_eq!(error.to_string(), "2:9: dwell: `P h` is not a letter and s, ms or rev, such as `P ms`");
/// # Ok::<(), clayforge::Error>(())
/// ```
pub fn read_flavor(text: &str) -> Result<Flavor, Error> {
    let at = |span: Option<std::ops::Range<usize>>| span.map_or(Place::Whole, |span| place(text, span.start));
    let document = Document::parse(text).map_err(|error| {
        let message = error.message().trim().replace('\n', ", ");
        Error::new(message).at(at(error.span())).hint("a flavor is TOML: lines like `rapid = true`")
    })?;
    let mut flavor = Flavor::default();
    if let Some(item) = document.get("inherits") {
        let base = item.as_str().and_then(Flavor::named).ok_or_else(|| {
            let names: Vec<&str> = Flavor::built_in().iter().map(|flavor| &*flavor.name).collect();
            Error::new("inherits is no flavor that is built in")
                .at(at(item.span()))
                .hint(format!("there are {}", names.join(", ")))
        })?;
        flavor = base.clone();
    }
    for (key, item) in document.iter().filter(|(key, _)| *key != "inherits") {
        let value = item.as_value().and_then(plain);
        let value = value
            .ok_or_else(|| Error::new(format!("{key} is no text, number or list")).at(at(item.span())))?;
        flavor.set(key, &value).map_err(|error| Error::new(error.to_string()).at(at(item.span())))?;
    }
    Ok(flavor)
}

/// A value as [`Flavor::set`] reads it.
fn plain(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.value().clone()),
        Value::Boolean(flag) => Some(flag.value().to_string()),
        Value::Integer(number) => Some(number.value().to_string()),
        Value::Float(number) => Some(number.value().to_string()),
        Value::Array(list) => {
            list.iter().map(plain).collect::<Option<Vec<_>>>().map(|parts| parts.join(", "))
        }
        Value::Datetime(_) | Value::InlineTable(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_built_in_flavor_is_what_its_toml_says() {
        for flavor in Flavor::built_in() {
            let text: String =
                flavor.entries().iter().map(|(key, value)| format!("{key} = '{value}'\n")).collect();
            assert_eq!(read_flavor(&text).as_ref(), Ok(flavor));
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        for (text, expected) in [
            ("rapid true", "1:7"),
            ("\ninherits = \"abacus\"", "2:12"),
            ("colour = 1", "1:10: colour: no key of a flavor"),
            ("rapid = {}", "1:9: rapid is no text"),
        ] {
            let error = read_flavor(text).expect_err(text).to_string();
            assert!(error.starts_with(expected), "{error}");
        }
    }
}
