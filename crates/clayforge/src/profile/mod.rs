//! Profiles: what the settings of a print are, read from TOML with the place of every key.

mod check;
mod flavor;
mod motion;
mod show;
mod toml;

pub use flavor::read_flavor;
pub use motion::Motion;
pub(crate) use show::{bounds, wrapped};
pub use show::{schema, starter};

use crate::stages::{Chain, Entry, STAGES, check_sequence};
use crate::work::{Keys, Work};
use import::Import;
use skein::{Error, Field, Kind, Machine, Place, SettingError, Settings, Value};
use std::collections::BTreeMap;
use toml::Text;

/// The profiles that come with the program, by name; the first is the one that is used when nobody names one.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("clay", include_str!("../../../../profiles/clay.toml")),
    ("generic-ram", include_str!("../../../../profiles/generic-ram.toml")),
    ("generic-auger", include_str!("../../../../profiles/generic-auger.toml")),
    ("vase", include_str!("../../../../profiles/vase.toml")),
];

/// How deep profiles may inherit: more is a mistake.
const DEEPEST: usize = 16;

/// The clay itself.
#[derive(Clone, Debug, PartialEq, Settings)]
pub struct Clay {
    /// The density of the wet clay: weigh a syringe of it. 25 % of water make 1.87, 20 % make 1.98; only the mass in
    /// the summary depends on it.
    #[setting(default = 1.9, min = 0.5, max = 5.0, unit = "g/cm³")]
    pub density: skein::Ratio,
}

/// A text that a profile is read from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// What messages call it, and what a profile that inherits is resolved against: a path, or the name of a built-in
    /// profile.
    pub name: String,
    /// The TOML.
    pub text: String,
}

/// Finds the profile that another names in `inherits`: it is given the name, and the name of the one that inherits.
pub type Lookup<'a> = &'a dyn Fn(&str, &str) -> Result<Source, Error>;

/// A stage of a profile.
pub struct Station {
    /// What is known of the stage.
    pub entry: &'static Entry,
    /// Whether it works.
    pub active: bool,
    /// The stage with its settings.
    pub work: Box<dyn Work>,
}

/// Everything that is set for a print.
pub struct Profile {
    /// What it is called.
    pub name: String,
    /// The order of the stages.
    pub chain: Chain,
    /// An order of one's own, instead of the chain's.
    pub sequence: Option<Vec<&'static str>>,
    /// The printer.
    pub machine: Machine,
    /// How it moves.
    pub motion: Motion,
    /// The clay.
    pub clay: Clay,
    /// How parts are read.
    pub import: Import,
    /// Every stage there is, in the order of the table.
    pub stations: Vec<Station>,
    /// Where each key was set last: file and place.
    places: BTreeMap<String, (String, Place)>,
}

impl Default for Profile {
    /// Every setting at its default.
    fn default() -> Self {
        let stations =
            STAGES.iter().map(|entry| Station { entry, active: entry.active, work: entry.make() }).collect();
        Self {
            name: String::new(),
            chain: Chain::default(),
            sequence: None,
            machine: Machine::default(),
            motion: Motion::default(),
            clay: Clay::default(),
            import: Import::default(),
            stations,
            places: BTreeMap::new(),
        }
    }
}

impl Clone for Profile {
    fn clone(&self) -> Self {
        let stations = self.stations.iter();
        Self {
            name: self.name.clone(),
            chain: self.chain,
            sequence: self.sequence.clone(),
            machine: self.machine.clone(),
            motion: self.motion.clone(),
            clay: self.clay.clone(),
            import: self.import.clone(),
            stations: stations
                .map(|one| Station { entry: one.entry, active: one.active, work: one.work.copy() })
                .collect(),
            places: self.places.clone(),
        }
    }
}

impl PartialEq for Profile {
    /// Whether both set the same; the name and the places do not matter.
    fn eq(&self, other: &Self) -> bool {
        self.chain == other.chain && self.sequence == other.sequence && self.sections() == other.sections()
    }
}

impl std::fmt::Debug for Profile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.show())
    }
}

/// A section with its settings and their present values.
#[derive(PartialEq)]
pub(crate) struct Section {
    pub name: &'static str,
    pub about: &'static str,
    pub fields: Vec<Field>,
    pub values: Vec<Value>,
}

impl Profile {
    /// Reads a profile and those that it inherits from.
    ///
    /// # Errors
    /// With file, line and column, for whatever is no profile.
    pub fn read(source: Source, lookup: Lookup<'_>) -> Result<Self, Error> {
        let mut profile = Self::default();
        profile.name.clone_from(&source.name);
        profile.take(&source, lookup, &mut Vec::new())?;
        Ok(profile)
    }

    /// A profile that comes with the program.
    pub fn built_in(name: &str) -> Option<Result<Self, Error>> {
        built_in(name).map(|source| Self::read(source, &only_built_in))
    }

    fn take(&mut self, source: &Source, lookup: Lookup<'_>, above: &mut Vec<String>) -> Result<(), Error> {
        let text = Text::read(source)?;
        above.push(source.name.clone());
        if let Some((wanted, at)) = text.inherits()? {
            let refuse = |message: String| located(Error::new(message), &source.name, &at);
            if above.len() >= DEEPEST {
                return Err(refuse(format!("profiles inherit more than {DEEPEST} deep")));
            }
            let parent = lookup(&wanted, &source.name).map_err(|error| {
                let mut refused = refuse(format!("inherits = {wanted:?}: {}", error.message));
                refused.hint = error.hint;
                refused
            })?;
            if above.contains(&parent.name) {
                let circle =
                    above.iter().chain([&parent.name]).map(String::as_str).collect::<Vec<_>>().join(" → ");
                return Err(refuse(format!("profiles inherit in a circle: {circle}")));
            }
            self.take(&parent, lookup, above)?;
        }
        above.pop();
        for assignment in text.assignments()? {
            let key = assignment.key.join(".");
            self.assign(&assignment.key, &assignment.value).map_err(|error| {
                let is_key = error.place == Place::At("key".to_owned());
                located(
                    error,
                    &source.name,
                    if is_key { &assignment.key_place } else { &assignment.value_place },
                )
            })?;
            self.places.insert(key, (source.name.clone(), assignment.value_place));
        }
        Ok(())
    }

    /// Sets one key from words of the command line: `fill.walls` and `2`. The value is read as TOML; a text needs no
    /// quotes.
    ///
    /// # Errors
    /// When there is no such key or the value does not fit.
    pub fn set(&mut self, key: &str, value: &str) -> Result<(), Error> {
        let what = format!("--set {key}={value}");
        let refuse = |error: Error| {
            let mut error = error.said_by(&what);
            error.place = Place::Whole;
            error
        };
        let path: Vec<String> = key.split('.').map(|part| part.trim().to_owned()).collect();
        let wants_text = match path.as_slice() {
            [section, name] => self.sections().iter().any(|known| {
                known.name == section
                    && known
                        .fields
                        .iter()
                        .any(|field| field.name == name && matches!(field.kind, Kind::Text | Kind::Choice(_)))
            }),
            _ => false,
        };
        let read = toml::value_of(value, wants_text).map_err(refuse)?;
        if path == ["inherits"] {
            return Err(refuse(Error::new("a profile is chosen, not set").hint("--profile NAME")));
        }
        self.assign(&path, &read).map_err(refuse)?;
        self.places.insert(path.join("."), (what, Place::Whole));
        Ok(())
    }

    /// Sets a key. The place of an error is `At("key")` when it is the key that is wrong.
    fn assign(&mut self, path: &[String], value: &Value) -> Result<(), Error> {
        let at_key = |message: String, near: Option<String>| {
            let error = Error::new(message).at(Place::At("key".to_owned()));
            match near {
                Some(near) => error.hint(format!("did you mean `{near}`?")),
                None => error.hint("all settings: clayforge profile show clay"),
            }
        };
        let path: Vec<&str> = path.iter().map(String::as_str).collect();
        match path.as_slice() {
            ["chain"] => {
                let word = if let Value::Text(word) = value { word.as_str() } else { "" };
                let found = Chain::WORDS.iter().find(|(known, _)| *known == word);
                let (_, chain) = found
                    .ok_or_else(|| Error::new(format!("chain = {value} is none of \"clay\", \"seed\"")))?;
                self.chain = *chain;
                self.sequence = None;
                Ok(())
            }
            ["sequence"] => {
                self.sequence = Some(sequence_of(value)?);
                Ok(())
            }
            [name] => {
                let is_section = self.sections().iter().any(|section| section.name == *name);
                let message = if is_section {
                    format!("`{name}` is a section, not a setting")
                } else {
                    format!("there is no setting `{name}`")
                };
                Err(at_key(message, if is_section { None } else { self.near(None, name) }))
            }
            [section, name] => {
                let key = format!("{section}.{name}");
                let Some((keys, active)) = self.section_mut(section) else {
                    let near = self.near(None, section).or_else(|| self.near(None, name));
                    return Err(at_key(format!("there is no section `{section}`"), near));
                };
                if let ("active", Some(active)) = (*name, active) {
                    let Value::Bool(wanted) = value else {
                        return Err(Error::new(format!("{key} = {value} is not true or false")));
                    };
                    *active = *wanted;
                    return Ok(());
                }
                match keys.set(name, value) {
                    Ok(()) => Ok(()),
                    Err(SettingError::Refused(why)) => {
                        Err(Error::new(format!("{key} = {value} {why}"))
                            .hint(format!("clayforge explain {key}")))
                    }
                    Err(SettingError::Unknown) => {
                        let near = self.near(Some(section), name);
                        Err(at_key(format!("there is no setting `{key}`"), near))
                    }
                }
            }
            _ => Err(at_key(format!("there is no setting `{}`", path.join(".")), None)),
        }
    }

    fn section_mut(&mut self, name: &str) -> Option<(&mut dyn Keys, Option<&mut bool>)> {
        match name {
            "machine" => Some((&mut self.machine, None)),
            "motion" => Some((&mut self.motion, None)),
            "clay" => Some((&mut self.clay, None)),
            Import::NAME => Some((&mut self.import, None)),
            _ => {
                let station = self.stations.iter_mut().find(|station| station.entry.name == name)?;
                Some((station.work.keys_mut(), Some(&mut station.active)))
            }
        }
    }

    /// The key or section that was probably meant.
    fn near(&self, section: Option<&str>, name: &str) -> Option<String> {
        let mut best: Option<(f64, String)> = None;
        let mut offer = |score: f64, key: String| {
            if score > 0.75 && best.as_ref().is_none_or(|(known, _)| score > *known) {
                best = Some((score, key));
            }
        };
        for known in self.sections() {
            let at_home = section == Some(known.name);
            if section.is_none() {
                offer(strsim::jaro_winkler(known.name, name), known.name.to_owned());
            }
            for field in &known.fields {
                // A key of the same section is likelier than the same word elsewhere.
                let bonus = if at_home { 0.1 } else { 0.0 };
                offer(
                    strsim::jaro_winkler(field.name, name) + bonus,
                    format!("{}.{}", known.name, field.name),
                );
            }
        }
        if section.is_none() {
            for key in ["inherits", "chain", "sequence"] {
                offer(strsim::jaro_winkler(key, name), key.to_owned());
            }
        }
        best.map(|(_, key)| key)
    }

    /// Every section with its settings: the printer, the clay, the reading of parts, the stages.
    pub(crate) fn sections(&self) -> Vec<Section> {
        let section = |name, about, keys: &dyn Keys| Section {
            name,
            about,
            fields: keys.fields(),
            values: keys.values().into_iter().map(|(_, value)| value).collect(),
        };
        let mut sections = vec![
            section("machine", "The printer.", &self.machine),
            section("motion", "How the printer moves.", &self.motion),
            section("clay", "The clay itself.", &self.clay),
            section(Import::NAME, "How the file of a part is read.", &self.import),
        ];
        for station in &self.stations {
            let mut one = section(station.entry.name, station.entry.about, station.work.keys());
            one.fields.insert(0, active_field(station.entry));
            one.values.insert(0, Value::Bool(station.active));
            sections.push(one);
        }
        sections
    }

    /// A setting and its present value, by its key.
    pub fn get(&self, key: &str) -> Option<(Field, Value)> {
        let (wanted, name) = key.split_once('.')?;
        let section = self.sections().into_iter().find(|section| section.name == wanted)?;
        section.fields.into_iter().zip(section.values).find(|(field, _)| field.name == name)
    }

    /// The stages in the order in which they run.
    ///
    /// # Errors
    /// When the profile's own sequence breaks a dependency.
    pub fn chain(&self) -> Result<Vec<&Station>, Error> {
        let names = match &self.sequence {
            Some(names) => {
                check_sequence(names).map_err(|error| self.blame(error, "sequence"))?;
                names.clone()
            }
            None => self.chain.stages(),
        };
        Ok(names.iter().filter_map(|name| self.station(name)).collect())
    }

    /// A stage by its name.
    pub fn station(&self, name: &str) -> Option<&Station> {
        self.stations.iter().find(|station| station.entry.name == name)
    }

    /// An error at the place where a key was set.
    fn blame(&self, error: Error, key: &str) -> Error {
        match self.places.get(key) {
            Some((what, place)) => located(error, what, place),
            None => error.said_by("profile"),
        }
    }
}

/// An error at a place of a text, in the form that editors jump to: `clay.toml:14:10: …`.
fn located(mut error: Error, name: &str, place: &Place) -> Error {
    error.what = match place {
        Place::Text { line, column } => format!("{name}:{line}:{column}"),
        _ => name.to_owned(),
    };
    error.place = Place::Whole;
    error
}

fn sequence_of(value: &Value) -> Result<Vec<&'static str>, Error> {
    let Value::List(items) = value else {
        return Err(Error::new(format!("sequence = {value} is no list of stages")));
    };
    let known = |item: &Value| {
        let Value::Text(word) = item else {
            return Err(Error::new(format!("sequence has {item}, which is no name in quotes")));
        };
        crate::stages::stage(word).map(|entry| entry.name).ok_or_else(|| {
            let near = STAGES
                .iter()
                .map(|entry| (strsim::jaro_winkler(entry.name, word), entry.name))
                .filter(|(score, _)| *score > 0.75)
                .max_by(|a, b| a.0.total_cmp(&b.0));
            let error = Error::new(format!("sequence has `{word}`, and there is no such stage"));
            match near {
                Some((_, name)) => error.hint(format!("did you mean `{name}`?")),
                None => error.hint("all stages: clayforge stages"),
            }
        })
    };
    items.iter().map(known).collect()
}

fn active_field(entry: &Entry) -> Field {
    Field {
        name: "active",
        about: "Whether the stage works; switched off, it passes its document on unchanged.",
        unit: "",
        kind: Kind::Switch,
        default: Value::Bool(entry.active),
        min: None,
        max: None,
    }
}

/// The text of a profile that comes with the program; its name may end in `.toml`.
pub fn built_in(name: &str) -> Option<Source> {
    let plain = name.strip_suffix(".toml").unwrap_or(name);
    let (name, text) = BUILT_IN.iter().find(|(known, _)| *known == plain)?;
    Some(Source { name: format!("{name}{BUILT_IN_MARK}"), text: (*text).to_owned() })
}

/// What stands behind the name of a built-in profile, so that it is not taken for a file.
const BUILT_IN_MARK: &str = " (built in)";

/// Whether a source of this name comes with the program; what it inherits comes with the program, too.
pub fn is_built_in(name: &str) -> bool {
    name.strip_suffix(BUILT_IN_MARK).is_some_and(|name| built_in(name).is_some())
}

/// A [`Lookup`] that knows the profiles of the program and no files.
///
/// # Errors
/// When there is none of this name.
pub fn only_built_in(wanted: &str, _by: &str) -> Result<Source, Error> {
    built_in(wanted).ok_or_else(|| {
        Error::new(format!("there is no profile `{wanted}`")).hint("all profiles: clayforge profile list")
    })
}

#[cfg(test)]
mod tests;
