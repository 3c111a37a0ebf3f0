//! `<setting.carve.layer_height>`: what a template may ask for.

use skein::{Error, Line, Micron, Skein};
use std::collections::BTreeMap;

/// Every name that a template may ask for, with its value.
#[derive(Clone, Debug, Default)]
pub(crate) struct Variables {
    /// By the name without blanks and underscores, in small letters.
    values: BTreeMap<String, String>,
    /// The names as they are written.
    names: Vec<String>,
}

impl Variables {
    /// The settings of all stages that have been here, the facts of the header, and the number of layers.
    pub(crate) fn of(skein: &Skein) -> Self {
        let mut variables = Self::default();
        for line in &skein.head {
            let Line::Value(pair) = line else { continue };
            let (tag, value) = (&*pair.0, &*pair.1);
            if tag != "setting" {
                variables.put(tag, value);
            } else if let [stage, name, value] = value.splitn(3, ' ').collect::<Vec<_>>()[..] {
                variables.put(&format!("setting.{stage}.{name}"), value.trim_matches('"'));
            }
        }
        variables.put("layers", &skein.layers.len().to_string());
        variables
    }

    /// The same with what is known in a layer: its number from 0, and the height of its middle.
    pub(crate) fn in_layer(&self, index: usize, z: Micron) -> Self {
        let mut variables = self.clone();
        variables.put("layer", &index.to_string());
        variables.put("z", &z.to_string());
        variables
    }

    fn put(&mut self, name: &str, value: &str) {
        if self.values.insert(key(name), value.to_owned()).is_none() {
            self.names.push(name.to_owned());
        }
    }

    /// The template with every `<name>` replaced by its value. What is in angle brackets and no name at all, like a
    /// number, stays.
    pub(crate) fn fill(&self, template: &str) -> Result<String, Error> {
        let mut text = String::with_capacity(template.len());
        let mut rest = template;
        while let Some((before, after)) = rest.split_once('<') {
            text += before;
            let name = after.split_once('>').filter(|(name, _)| is_name(name));
            let Some((name, behind)) = name else {
                text.push('<');
                rest = after;
                continue;
            };
            // What stands in brackets in a name is its unit.
            let asked = key(name.split('(').next().unwrap_or(name));
            let value = self.values.get(&asked).ok_or_else(|| self.unknown(name, &asked))?;
            text += value;
            rest = behind;
        }
        Ok(text + rest)
    }

    fn unknown(&self, name: &str, asked: &str) -> Error {
        let near = self
            .names
            .iter()
            .map(|known| (strsim::levenshtein(&key(known), asked), known))
            .min()
            .filter(|(far, _)| *far <= asked.len() / 3);
        let error = Error::new(format!("`<{name}>` is not known"));
        error.hint(match near {
            Some((_, known)) => format!("did you mean `<{known}>`?"),
            None => "a name is `setting.STAGE.KEY` of a stage that has worked, a tag of the header like \
                     `layerHeight`, or `layers`; at a layer also `layer` and `z`"
                .to_owned(),
        })
    }
}

fn is_name(text: &str) -> bool {
    text.starts_with(|letter: char| letter.is_ascii_alphabetic())
        && text.chars().all(|letter| letter.is_ascii_alphanumeric() || " ._()/".contains(letter))
}

fn key(name: &str) -> String {
    let letters = name.chars().filter(|letter| !matches!(letter, ' ' | '_'));
    letters.map(|letter| letter.to_ascii_lowercase()).collect()
}
