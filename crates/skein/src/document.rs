use crate::settings::Value;
use crate::{Error, Facts, Line, Notes, Reader, Tag};
use rayon::prelude::*;
use unit::Micron;

/// The tagged G-code: a list of lines, held in three parts so that layers can be worked on side by side.
///
/// The parts are a function of the lines alone, so reading the text gives the same parts: `head` ends before the first
/// `(<layer>` line; each layer runs up to the next such line; `tail` begins with the line that closes the crafting
/// block. Laid end to end they are all lines of the text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Skein {
    /// The header and whatever stands before the first layer.
    pub head: Vec<Line>,
    /// The layers in the order in which they are printed.
    pub layers: Vec<Layer>,
    /// What follows the last layer.
    pub tail: Vec<Line>,
}

/// The lines of one layer; the first is its [`Line::Layer`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layer {
    /// The lines.
    pub lines: Vec<Line>,
}

/// A stage with the settings it ran with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// The stage.
    pub stage: String,
    /// Its settings, each as a profile would say it.
    pub settings: Vec<(String, String)>,
}

impl Signature {
    /// Signs for a stage.
    pub fn new(stage: &str, values: &[(&'static str, Value)]) -> Self {
        let settings = values.iter().map(|(name, value)| ((*name).to_owned(), value.to_string())).collect();
        Self { stage: stage.to_owned(), settings }
    }
}

impl Layer {
    /// The height of the middle of the layer.
    pub fn z(&self) -> Micron {
        match self.lines.first() {
            Some(Line::Layer(z)) => *z,
            _ => Micron::ZERO,
        }
    }

    /// How high the layer is: as it says itself, else as the header says.
    pub fn height(&self, facts: &Facts) -> Result<Micron, Error> {
        match self.lines.get(1) {
            Some(Line::Thickness(height)) => Ok(*height),
            _ => facts.layer_height(),
        }
    }

    /// How high the nozzle stands while the layer is printed: at its top.
    pub fn nozzle_z(&self, facts: &Facts) -> Result<Micron, Error> {
        // An odd height has its middle rounded down to the micron, so half of it is rounded up.
        self.height(facts).map(|height| Micron(self.z().0 + height.0 - height.0 / 2))
    }
}

impl Layer {
    /// How many of its first lines say what the layer is: its height, and its thickness where that is its own.
    pub fn heading(&self) -> usize {
        self.lines.iter().take_while(|line| matches!(line, Line::Layer(_) | Line::Thickness(_))).count()
    }

    /// Where lines go that come before everything the layer lays: behind its height, its directions, and whatever nobody
    /// knows.
    pub fn opening(&self) -> usize {
        let lays = |line: &Line| match line {
            Line::Open(tag) | Line::Close(tag) => *tag != Tag::Alteration,
            Line::Wall(..) | Line::On | Line::Off | Line::Flow(_) => true,
            line => line.as_move().is_some(),
        };
        self.lines.iter().position(lays).unwrap_or(self.lines.len())
    }
}

impl Skein {
    /// Sorts lines into head, layers and tail.
    pub fn from_lines(lines: impl IntoIterator<Item = Line>) -> Self {
        let mut skein = Self::default();
        for line in lines {
            skein.push(line);
        }
        skein
    }

    /// Appends a line to the part it belongs to.
    fn push(&mut self, line: Line) {
        match line {
            _ if !self.tail.is_empty() => self.tail.push(line),
            Line::Close(Tag::Crafting) => self.tail.push(line),
            Line::Layer(_) => self.layers.push(Layer { lines: vec![line] }),
            _ => self.layers.last_mut().map_or(&mut self.head, |layer| &mut layer.lines).push(line),
        }
    }

    /// Every line in order.
    pub fn lines(&self) -> impl Iterator<Item = &Line> {
        self.head.iter().chain(self.layers.iter().flat_map(|layer| &layer.lines)).chain(&self.tail)
    }

    /// Reads the text. LF, CRLF and a bare CR end a line; empty lines are dropped.
    ///
    /// # Errors
    /// With the line, when one cannot be read.
    pub fn read(text: &[u8]) -> Result<Self, Error> {
        let mut reader = Reader::default();
        let mut skein = Self::default();
        let mut number = 0;
        for chunk in text.split(|byte| *byte == b'\n') {
            let chunk = chunk.strip_suffix(b"\r").unwrap_or(chunk);
            for piece in chunk.split(|byte| *byte == b'\r') {
                number += 1;
                if piece.trim_ascii().is_empty() {
                    continue;
                }
                skein.push(reader.line(piece).map_err(|error| error.at(crate::Place::Line(number)))?);
            }
        }
        if !skein.head.contains(&Line::Close(Tag::ExtruderInitialization)) {
            return Err(Error::new("this is no skein: its header never ends")
                .hint("a skein is what preface writes; it has a line `(</extruderInitialization>)`"));
        }
        Ok(skein)
    }

    /// The text: every line with a line feed.
    pub fn write(&self) -> Vec<u8> {
        let mut text = Vec::with_capacity(self.lines().count() * 32);
        for line in self.lines() {
            line.write(&mut text);
            text.push(b'\n');
        }
        text
    }

    /// What the header says.
    ///
    /// # Errors
    /// When a known fact has a value it cannot have.
    pub fn facts(&self) -> Result<Facts, Error> {
        let mut facts = Facts::default();
        for (index, line) in self.head.iter().enumerate() {
            if let Line::Value(pair) = line {
                facts.take(&pair.0, &pair.1).map_err(|error| error.at(crate::Place::Line(index + 1)))?;
            }
        }
        Ok(facts)
    }

    /// Writes facts into the header, above the bead width, or in place of an older value.
    pub fn state(&mut self, facts: &Facts) -> Result<(), Error> {
        for (tag, value) in facts.tags() {
            let line = Line::value(tag, &value)?;
            let named = |name: &str| {
                self.head.iter().position(|line| matches!(line, Line::Value(pair) if &*pair.0 == name))
            };
            match (named(tag), named("edgeWidth").or_else(|| self.end_of_header())) {
                (Some(index), _) => self.head[index] = line,
                (None, Some(index)) => self.head.insert(index, line),
                (None, None) => self.head.push(line),
            }
        }
        Ok(())
    }

    fn end_of_header(&self) -> Option<usize> {
        self.head.iter().position(|line| *line == Line::Close(Tag::ExtruderInitialization))
    }

    /// Whether a stage has been here already.
    pub fn has_done(&self, stage: &str) -> bool {
        self.head
            .iter()
            .any(|line| matches!(line, Line::Value(pair) if &*pair.0 == "procedureName" && &*pair.1 == stage))
    }

    /// Says in the header that a stage has been here, and with which settings.
    pub fn sign(&mut self, signature: &Signature) -> Result<(), Error> {
        let settings = signature
            .settings
            .iter()
            .map(|(name, value)| Line::value("setting", &format!("{} {name} {value}", signature.stage)))
            .collect::<Result<Vec<_>, _>>()?;
        if let Some(index) = self.head.iter().position(|line| *line == Line::Close(Tag::Settings)) {
            self.head.splice(index..index, settings);
        }
        let done = Line::value("procedureName", &signature.stage)?;
        let end = self.end_of_header().unwrap_or(self.head.len());
        self.head.insert(end, done);
        Ok(())
    }

    /// Rewrites every layer by itself, side by side; the work sees the layer's index and its lines.
    ///
    /// # Errors
    /// The error of the lowest layer that has one, at that layer.
    pub fn rewrite(
        mut self,
        notes: &mut Notes,
        work: impl Fn(usize, Layer, &mut Notes) -> Result<Vec<Line>, Error> + Sync,
    ) -> Result<Self, Error> {
        let layers = std::mem::take(&mut self.layers);
        let done: Vec<(Result<Layer, Error>, Notes)> = layers
            .into_par_iter()
            .enumerate()
            .map(|(index, layer)| {
                let mut notes = Notes::default();
                let lines = work(index, layer, &mut notes).map(|lines| Layer { lines });
                (lines.map_err(|error| error.in_layer(index)), notes)
            })
            .collect();
        for (layer, remarks) in done {
            notes.append(remarks);
            self.layers.push(layer?);
        }
        Ok(self)
    }

    /// Changes every layer in place, side by side.
    ///
    /// # Errors
    /// The error of the lowest layer that has one, at that layer.
    pub fn each(
        &mut self,
        work: impl Fn(usize, &mut Layer) -> Result<(), Error> + Sync,
    ) -> Result<(), Error> {
        let done: Vec<Result<(), Error>> = self
            .layers
            .par_iter_mut()
            .enumerate()
            .map(|(index, layer)| work(index, layer).map_err(|error| error.in_layer(index)))
            .collect();
        done.into_iter().collect()
    }
}
