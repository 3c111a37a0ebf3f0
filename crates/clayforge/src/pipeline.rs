//! Runs the stages: in memory from a part to the file, or one stage from text to text. Both go through `step`.

use crate::document::Plate;
use crate::door::{self, Door};
use crate::draw::{Drawing, draw};
use crate::figures::Figures;
use crate::profile::{Profile, Station};
use crate::stopwatch::{self, Stopwatch};
use crate::work::{Bench, Sink};
use crate::{Document, Form};
use clay_processor::{Firmware, Limits, Options, Processor, Report, Rule, Severity, Verdict};
use import::{Format, Import};
use skein::{Error, Notes, Signature, Skein, Value};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{Builder, Scope, ScopedJoinHandle};

/// What happens while a part is sliced, for progress bars, clocks and dumps.
pub enum Event<'a> {
    /// A stage begins.
    Started {
        /// The stage; `import` is the reading of the part.
        name: &'static str,
    },
    /// A stage has ended.
    Done {
        /// The stage.
        name: &'static str,
        /// Its number in the chain: carve is 1, the reading of the part and what works on it are 0.
        number: usize,
        /// How many stages the chain has.
        of: usize,
        /// What it made.
        document: &'a Document,
    },
}

/// Watches a slicing; an error stops it.
pub type Watch<'a> = &'a mut dyn FnMut(Event<'_>) -> Result<(), Error>;

/// What is known after a part was sliced.
#[derive(Clone, Debug, Default)]
pub struct Sliced {
    /// What the stages had to say.
    pub notes: Notes,
    /// Lengths, clay and time; not when the slicing stopped before the skein.
    pub figures: Option<Figures>,
    /// Layers and spirals that a reader of the finished file finds; not when the slicing stopped before it.
    pub found: Option<Found>,
    /// The form of what went to the sink.
    pub form: Option<Form>,
    /// What the files of the parts were, by their bytes.
    pub formats: Vec<Format>,
}

/// What the letter model of the clay processor finds in the finished file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Found {
    /// Layers.
    pub layers: usize,
    /// Spirals.
    pub spirals: usize,
}

/// Slices the bytes of a part in any known form; what the last stage makes goes to the sink, piece by piece.
///
/// The chain ends early behind the stage `until`. The bytes are dropped as soon as they are read.
///
/// # Errors
/// When the part, the profile or a stage refuses; an error that names nobody is about the part.
pub fn slice(
    part: impl AsRef<[u8]>,
    profile: &Profile,
    until: Option<&str>,
    watch: Watch<'_>,
    sink: Sink<'_>,
) -> Result<Sliced, Error> {
    slice_all([Ok(part)], profile, until, watch, sink)
}

/// Slices several parts, which stand side by side on the bed. Each is asked for when the one before it has been read;
/// one that cannot be had stops the slicing with its error.
///
/// # Errors
/// When a part, the profile or a stage refuses; an error that names nobody is about the last part that was asked for.
pub fn slice_all<P: AsRef<[u8]>>(
    parts: impl IntoIterator<Item = Result<P, Error>>,
    profile: &Profile,
    until: Option<&str>,
    watch: Watch<'_>,
    sink: Sink<'_>,
) -> Result<Sliced, Error> {
    let mut sliced = Sliced::default();
    let chain = profile.chain()?;
    if let Some(last) = until.filter(|last| !chain.iter().any(|station| station.entry.name == *last)) {
        return Err(Error::new(format!("the chain has no stage `{last}`"))
            .hint("clayforge stages")
            .said_by("--until"));
    }
    profile.check(&mut sliced.notes)?;
    watch(Event::Started { name: Import::NAME })?;
    let Door { mut document, doubt } = door::open(parts, profile, &mut sliced)?;
    watch(Event::Done { name: Import::NAME, number: 0, of: chain.len(), document: &document })?;
    // Stages of the part come before the first that can be drawn, which has the number one.
    let before = chain.iter().take_while(|station| station.work.forms().1 == Form::Mesh).count();
    for (index, station) in chain.iter().enumerate() {
        let name = station.entry.name;
        if station.work.forms().1 == Form::Mesh && document.form() != Form::Mesh {
            if station.active {
                sliced.notes.say("works on meshes: the layers of a drawing stay as they are");
                sliced.notes.said_by(name);
            }
            continue;
        }
        watch(Event::Started { name })?;
        let mut bench = Bench { machine: &profile.machine, notes: &mut sliced.notes, sink: &mut *sink };
        let is_part = document.form() == Form::Mesh;
        document = if station.work.forms().1 == Form::Gcode {
            let (figures, found) = finish(station, document, profile, &mut bench)?;
            sliced.figures = Some(figures);
            sliced.found = Some(found);
            Document::Gcode
        } else {
            step(station, document, &mut bench).map_err(|error| match &doubt {
                Some(doubt) if is_part => error.hint(doubt),
                _ => error,
            })?
        };
        let number = (index + 1).saturating_sub(before);
        watch(Event::Done { name, number, of: chain.len() - before, document: &document })?;
        if until == Some(name) {
            break;
        }
    }
    if let Document::Skein(skein) = &document {
        sliced.figures = Some(figures(skein, profile)?);
    }
    if let Some(text) = document.text() {
        sink(&text)?;
    }
    sliced.form = Some(document.form());
    Ok(sliced)
}

/// Runs one stage on a text; the text that it makes goes to the sink.
///
/// A stage that is switched off, or that the text has been through already, gives the text back as it is.
///
/// # Errors
/// When there is no such stage, or the text, the profile or the stage refuses.
pub fn craft(
    stage: &str,
    text: &[u8],
    profile: &Profile,
    notes: &mut Notes,
    sink: Sink<'_>,
) -> Result<(), Error> {
    let station = profile.station(stage).ok_or_else(|| {
        Error::new(format!("there is no stage `{stage}`"))
            .hint("all stages: clayforge stages")
            .said_by("craft")
    })?;
    // What is doubtful in the profile is said once, by `slice` and `profile check`, not by every stage of a pipe.
    profile.check(&mut Notes::default())?;
    let name = station.entry.name;
    let (takes, gives) = station.work.forms();
    let form = Form::of(text);
    if !station.active
        || (form == gives && takes != gives && read(form, text, &profile.import, notes)?.has_done(name))
    {
        return sink(text);
    }
    // A drawing of another program is for carve as a mesh is.
    let form = if form == Form::Slices && gives == Form::Slices { form } else { takes };
    let document = read(form, text, &profile.import, notes).map_err(|error| error.said_by(name))?;
    if document.has_done(name) {
        return sink(text);
    }
    let mut bench = Bench { machine: &profile.machine, notes, sink };
    let document = step(station, document, &mut bench)?;
    match document.text() {
        Some(text) => sink(&text),
        None => Ok(()),
    }
}

/// The one place a stage is run, whichever way its document came: craft, sign, verify.
fn step(station: &Station, document: Document, bench: &mut Bench<'_>) -> Result<Document, Error> {
    let name = station.entry.name;
    if !station.active || document.has_done(name) {
        return Ok(document);
    }
    let done = station.work.work(document, bench).map_err(|error| error.said_by(name));
    bench.notes.said_by(name);
    let mut document = done?;
    document
        .sign(Signature::new(name, &station.work.keys().values()))
        .map_err(|error| error.said_by(name))?;
    document.verify().map_err(|error| {
        Error::new(format!("{name} made a skein that breaks a law ({error}); this is our bug, not yours"))
            .hint("please report it with the part, the profile and the files of --dump")
            .said_by(name)
    })?;
    Ok(document)
}

/// Counts the skein and writes the file, which a clay processor reads while it is written, and an emulator behind it.
fn finish(
    station: &Station,
    document: Document,
    profile: &Profile,
    bench: &mut Bench<'_>,
) -> Result<(Figures, Found), Error> {
    let mut counted = match &document {
        Document::Skein(skein) => figures(skein, profile)?,
        _ => Figures::default(),
    };
    if counted.threads == 0 {
        return Err(Error::new("nothing is left to print: no bead was laid")
            .hint("is the part thinner than a bead, or a stage switched off? --dump DIR shows every stage")
            .said_by(station.entry.name));
    }
    let sink = &mut *bench.sink;
    let limits = own_limits(profile);
    let machine = profile.emulator();
    let (report, totals) = std::thread::scope(|scope| {
        let (send, receive) = sync_channel(Tee::AHEAD);
        let (pass_on, passed_on) = sync_channel(Tee::AHEAD);
        let (give_back, empty) = sync_channel(2 * Tee::AHEAD + 3);
        let reader = begin(scope, move || process(limits, &receive, &pass_on))?;
        let machine = &machine;
        let timer = begin(scope, move || time(machine, &passed_on, &give_back))?;
        let mut tee = Tee { send: Some(send), empty, chunk: Vec::new() };
        let mut both = |piece: &[u8]| {
            tee.push(piece);
            sink(piece)
        };
        let mut bench = Bench { machine: bench.machine, notes: &mut *bench.notes, sink: &mut both };
        let written = step(station, document, &mut bench);
        tee.close();
        let broke = || Error::new("a reader of the finished file broke; this is our bug");
        let report = reader.join().map_err(|_| broke());
        let totals = timer.join().map_err(|_| broke()).flatten();
        written.and_then(|_| Ok((report?, totals?)))
    })?;
    counted.time_s = totals.total_time;
    let found = Found { layers: report.letter.layers.len(), spirals: report.letter.spirals.len() };
    if found.layers != counted.layers && found.spirals == 0 {
        bench.notes.say(format!(
            "{} layers have beads, and a reader that goes by the letter finds {} in the file",
            counted.layers, found.layers
        ));
    }
    judge(&report.verdicts, bench.notes)?;
    bench.notes.said_by("check");
    stopwatch::warn(&totals, profile, bench.notes);
    bench.notes.said_by("motion");
    Ok((counted, found))
}

/// Begins a thread.
fn begin<'scope, T: Send + 'scope>(
    scope: &'scope Scope<'scope, '_>,
    work: impl FnOnce() -> T + Send + 'scope,
) -> Result<ScopedJoinHandle<'scope, T>, Error> {
    Builder::new().spawn_scoped(scope, work).map_err(|error| {
        Error::new(format!("the file cannot be read back while it is written: no thread begins: {error}"))
            .hint("the machine has no memory left, or too many programs run on it")
    })
}

/// What a file of our own is held against. Stages may make other layers than `carve.layer_height` says; a firmware that
/// nobody has named is not suspected.
fn own_limits(profile: &Profile) -> Limits {
    let limits = profile.limits();
    Limits { layers: None, firmware: limits.firmware.or(Some(Firmware::Plain)), ..limits }
}

/// Passes on what the check warns of, and refuses what must not be printed.
fn judge(verdicts: &[Verdict], notes: &mut Notes) -> Result<(), Error> {
    for verdict in verdicts {
        match verdict.severity {
            Severity::Forbids => {
                return Err(Error::new(format!("the finished file must not be printed: {}", verdict.text))
                    .hint(
                        "does a piece of the part float in the air, or do the lines of alteration do this? if it is neither, \
                         please report it as our bug",
                    )
                    .said_by("check"));
            }
            // The summary counts the travels.
            Severity::Warns if verdict.rule == Rule::Interrupted => {}
            Severity::Warns => notes.say(verdict.text.as_str()),
        }
    }
    Ok(())
}

/// Sends what is written to the reader, in chunks that are worth a message; the reader gives them back empty, since
/// fresh memory costs more than the copying.
struct Tee {
    send: Option<SyncSender<Vec<u8>>>,
    empty: Receiver<Vec<u8>>,
    chunk: Vec<u8>,
}

impl Tee {
    /// Large enough that the messages cost nothing, small enough to stay in the cache.
    const CHUNK: usize = 256 * 1024;
    /// How many chunks the writer may be ahead: 4 MB, so that it seldom waits.
    const AHEAD: usize = 16;

    fn push(&mut self, piece: &[u8]) {
        let mut rest = piece;
        while !rest.is_empty() {
            if self.chunk.capacity() == 0 {
                self.chunk = self.empty.try_recv().unwrap_or_else(|_| Vec::with_capacity(Self::CHUNK));
            }
            let (now, later) = rest.split_at(rest.len().min(Self::CHUNK - self.chunk.len()));
            self.chunk.extend_from_slice(now);
            rest = later;
            if self.chunk.len() == Self::CHUNK {
                self.flush();
            }
        }
    }

    fn flush(&mut self) {
        if let Some(send) = &self.send {
            // A reader that is gone is met again when it is joined.
            let _ = send.send(std::mem::take(&mut self.chunk));
        }
    }

    fn close(&mut self) {
        self.flush();
        self.send = None;
    }
}

fn process(limits: Limits, chunks: &Receiver<Vec<u8>>, pass_on: &SyncSender<Vec<u8>>) -> Report {
    let mut processor = Processor::new(Options { limits, ..Options::default() });
    for chunk in chunks {
        processor.push(&chunk);
        // An emulator that is gone is met again when it is joined.
        let _ = pass_on.send(chunk);
    }
    processor.finish()
}

fn time(
    machine: &emulate::Machine,
    chunks: &Receiver<Vec<u8>>,
    give_back: &SyncSender<Vec<u8>>,
) -> Result<emulate::Totals, Error> {
    let mut stopwatch = Stopwatch::new(machine)?;
    for mut chunk in chunks {
        stopwatch.push(&chunk);
        chunk.clear();
        // A writer that is done wants none back.
        let _ = give_back.try_send(chunk);
    }
    stopwatch.finish()
}

fn figures(skein: &Skein, profile: &Profile) -> Result<Figures, Error> {
    let flow = match profile.get("dimension.flow") {
        Some((_, Value::Number(flow)))
            if profile.station("dimension").is_some_and(|station| station.active) =>
        {
            flow
        }
        _ => 1.0,
    };
    Figures::of(skein, flow, profile.clay.density.f64())
}

/// Reads a text of a form.
fn read(form: Form, text: &[u8], import: &Import, notes: &mut Notes) -> Result<Document, Error> {
    match form {
        Form::Mesh => door::mesh(text, import, notes)
            .map(|mesh| Document::Mesh(Plate { parts: vec![mesh], done: Plate::stages_of(text) })),
        Form::Slices => door::drawing(text, import, notes).map(Document::Slices),
        Form::Skein | Form::Gcode => Skein::read(text).map(Document::Skein),
    }
}

/// Reads a text between two stages and draws its layers.
///
/// # Errors
/// When it is neither the SVG of carve nor a skein.
pub fn draw_text(text: &[u8], drawing: Drawing) -> Result<String, Error> {
    let form = match Form::of(text) {
        Form::Mesh => Form::Skein,
        form => form,
    };
    draw(&read(form, text, &Import::default(), &mut Notes::default())?, drawing)
}

/// Has all work done on so many threads; to be called before anything else, and once.
///
/// # Errors
/// When work has begun already.
pub fn set_threads(threads: usize) -> Result<(), Error> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()
        .map_err(|error| Error::new(format!("the threads cannot be set: {error}")))
}
