use std::fmt;

/// What is worth saying without stopping: dropped, repaired, guessed, doubtful.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notes(Vec<Note>);

/// One remark of one stage about one layer or the whole part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// The stage that says it; filled in by whoever runs the stage.
    pub stage: String,
    /// The layer it is about, counted from zero.
    pub layer: Option<usize>,
    /// What is so. Notes of equal text are shown as one with a list of layers, so the text names no layer.
    pub text: String,
    /// Where in the layer, if one spot is meant: millimetres.
    pub spot: Option<String>,
}

impl Notes {
    /// A remark about the whole part.
    pub fn say(&mut self, text: impl Into<String>) {
        self.0.push(Note { stage: String::new(), layer: None, text: text.into(), spot: None });
    }

    /// A remark about a layer.
    pub fn layer(&mut self, layer: usize, text: impl Into<String>) {
        self.0.push(Note { stage: String::new(), layer: Some(layer), text: text.into(), spot: None });
    }

    /// A remark about a spot of a layer.
    pub fn spot(&mut self, layer: usize, at: shape::Point, text: impl Into<String>) {
        let spot = format!("x {:.1} y {:.1}", f64::from(at.x) / 1000.0, f64::from(at.y) / 1000.0);
        self.0.push(Note { stage: String::new(), layer: Some(layer), text: text.into(), spot: Some(spot) });
    }

    /// All of another's remarks behind one's own.
    pub fn append(&mut self, mut other: Self) {
        self.0.append(&mut other.0);
    }

    /// The remarks in the order in which they were made.
    pub fn iter(&self) -> impl Iterator<Item = &Note> {
        self.0.iter()
    }

    /// Whether nobody said anything.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Signs every remark that has no speaker yet.
    pub fn said_by(&mut self, stage: &str) {
        for note in self.0.iter_mut().filter(|note| note.stage.is_empty()) {
            note.stage = stage.to_owned();
        }
    }

    /// One line for each different remark, with the layers it is about and the first spot.
    pub fn summary(&self) -> Vec<String> {
        let mut order: Vec<(&str, &str)> = Vec::new();
        let mut groups: std::collections::HashMap<(&str, &str), Vec<&Note>> =
            std::collections::HashMap::new();
        for note in &self.0 {
            let key = (note.stage.as_str(), note.text.as_str());
            groups.entry(key).or_insert_with(|| {
                order.push(key);
                Vec::new()
            });
            if let Some(group) = groups.get_mut(&key) {
                group.push(note);
            }
        }
        order.iter().map(|key| group_text(key.0, key.1, &groups[key])).collect()
    }
}

fn group_text(stage: &str, text: &str, notes: &[&Note]) -> String {
    let mut layers: Vec<usize> = notes.iter().filter_map(|note| note.layer).collect();
    layers.sort_unstable();
    layers.dedup();
    let place = if layers.is_empty() { String::new() } else { format!("{}: ", Ranges(&layers)) };
    let spot = match notes.iter().find_map(|note| note.spot.as_deref()) {
        Some(spot) if notes.len() > 1 => format!(" (first of {} at {spot})", notes.len()),
        Some(spot) => format!(" (at {spot})"),
        None => String::new(),
    };
    format!("{stage}: {place}{text}{spot}")
}

/// `layers 3–7, 9`; long lists are cut.
struct Ranges<'a>(&'a [usize]);

impl fmt::Display for Ranges<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut runs: Vec<(usize, usize)> = Vec::new();
        for &layer in self.0 {
            match runs.last_mut() {
                Some((_, end)) if *end + 1 == layer => *end = layer,
                _ => runs.push((layer, layer)),
            }
        }
        f.write_str(if self.0.len() == 1 { "layer " } else { "layers " })?;
        for (index, (start, end)) in runs.iter().take(8).enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            if start == end {
                write!(f, "{comma}{start}")?;
            } else {
                write!(f, "{comma}{start}–{end}")?;
            }
        }
        if runs.len() > 8 {
            write!(
                f,
                " and {} more",
                self.0.len() - runs.iter().take(8).map(|(s, e)| e - s + 1).sum::<usize>()
            )?;
        }
        Ok(())
    }
}
