//! `clayforge emulate`.

use crate::args::{Emulate, Motion};
use crate::craft::read;
use crate::output::{Output, print, put};
use crate::profile;
use crate::report::{self, Done, Stop};
use clayforge::emulate::motion::ProfileType;
use clayforge::emulate::{
    self, Action, AdditiveOperation, AdditivePart, Bead, Commands, EventOptions, EventSeries, PolyData, Table,
};
use clayforge::gcode::{Diagnostic, Flavor, preprocess};
use clayforge::{Error, Place, Profile};
use serde_json::json;
use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

/// Jerk of the S-curve, mm/s³; ten times the usual acceleration, as clay printers with such firmware have it.
const JERK: f64 = 5000.0;
/// As many problems of a file as are said on a terminal.
const SAID: usize = 20;

/// Says what a machine makes of a file.
pub fn run(emulate: &Emulate) -> Done {
    let profile = match &emulate.machine {
        Some(name) => profile::read(name)?,
        None => Profile::default(),
    };
    let text = read(&emulate.file)?;
    let name = emulate.file.display().to_string();
    clayforge::gcode::check_text(&text).map_err(|why| Error::new(format!("it is {why}")).said_by(&name))?;
    let flavor = flavor(emulate, &text)?;
    let program = preprocess(&text, &flavor).map_err(|fault| at(&fault).said_by(&name))?;
    let Commands { steps, diagnostics } = Commands::of(&program, &flavor);

    let mut machine = profile.emulator();
    machine.flavor = flavor.clone();
    if let Some(acceleration) = emulate.acceleration {
        machine.motion.max_acceleration = Some(acceleration);
    }
    if let Some(deviation) = emulate.junction_deviation {
        machine.motion.junction_deviation = deviation;
    }
    // What is said here holds, whatever the file says.
    machine.obeys_limits = emulate.acceleration.is_none() && emulate.junction_deviation.is_none();
    machine.motion.profile = match emulate.motion {
        Motion::Trapezoid => ProfileType::default(),
        Motion::Scurve => ProfileType::SCurve { jerk: JERK },
        Motion::Constant => ProfileType::ConstantVelocity,
    };
    let operation = machine.process_additive(steps).map_err(|error| ours(error, &name))?;
    let mut faults: Vec<&Diagnostic> =
        diagnostics.list().iter().chain(operation.diagnostics().list()).collect();
    faults.sort_by_key(|fault| fault.line);
    let count = diagnostics.count() + operation.diagnostics().count();
    if let (true, Some(fault)) = (emulate.strict, faults.first()) {
        return Err(at(fault).said_by(&name).into());
    }

    let density = profile.clay.density.f64();
    let bead = Bead::estimated(&operation, Bead { density, ..Bead::default() });
    let part = AdditivePart::new(&operation, bead, [0.0, 0.0, 1.0]).map_err(|error| ours(error, &name))?;
    write_files(emulate, &operation, &part)?;
    if emulate.json {
        print(&to_json(&operation, &part, &faults))
    } else {
        let mut said = String::new();
        for fault in faults.iter().take(SAID) {
            let _ = writeln!(said, "warning: {name}: {fault}");
        }
        if count > SAID as u64 {
            let _ = writeln!(said, "  and {} more", count - SAID as u64);
        }
        report::say(&said);
        print(&described(&name, &flavor, &operation, &part, emulate.machine.is_some()))
    }
}

/// The dialect that was named, or the one that the file speaks.
fn flavor(emulate: &Emulate, text: &[u8]) -> Result<Flavor, Error> {
    let Some(name) = &emulate.flavor else { return Ok(Flavor::detect(text).flavor.clone()) };
    if Flavor::named(name).is_none() && Path::new(name).exists() {
        let bytes = read(Path::new(name))?;
        return clayforge::read_flavor(&String::from_utf8_lossy(&bytes)).map_err(|error| error.said_by(name));
    }
    let known =
        || Flavor::built_in().iter().map(|flavor| flavor.name.as_ref()).collect::<Vec<_>>().join(", ");
    Flavor::named(name).cloned().ok_or_else(|| {
        Error::new(format!("there is no flavor `{name}`"))
            .hint(format!("a file, or one of {}", known()))
            .said_by("emulate")
    })
}

/// A problem of a file as an error.
fn at(fault: &Diagnostic) -> Error {
    let line = fault.line as usize;
    let place = match fault.column {
        0 => Place::Line(line),
        column => Place::Text { line, column: column as usize },
    };
    Error::new(fault.kind.to_string()).at(place)
}

fn ours(error: emulate::Error, name: &str) -> Error {
    let mut told = Error::new(error.message).said_by(name);
    told.hint = error.hint;
    match error.line {
        Some(line) => told.at(Place::Line(line as usize)),
        None => told,
    }
}

fn write_files(emulate: &Emulate, operation: &AdditiveOperation<'_>, part: &AdditivePart<'_, '_>) -> Done {
    if let Some(path) = &emulate.csv {
        write(path, |out| Table::of_part(part).write_csv(out))?;
    }
    if let Some(path) = &emulate.parquet {
        write(path, |out| columns::write_parquet(&Table::of_part(part), out))?;
    }
    if let Some(path) = &emulate.arrow {
        write(path, |out| columns::write_arrow(&Table::of_part(part), out))?;
    }
    if let Some(path) = &emulate.picture {
        let svg = emulate::picture(part, &emulate.color, emulate.view)
            .map_err(|error| ours(error, &path.display().to_string()))?;
        put(path, svg.as_bytes())?;
    }
    if let Some(path) = &emulate.events {
        let series = EventSeries::new(operation, &EventOptions::default());
        let is_input = path.extension().is_some_and(|end| end == "inp");
        let text = if is_input { series.to_inp() } else { series.to_rows() };
        write(path, |mut out| Ok(out.write_all(text.as_bytes())?))?;
    }
    if let Some(path) = &emulate.vtk {
        let mesh = PolyData::of(part, &[]).map_err(|error| ours(error, &path.display().to_string()))?;
        let is_xml = path.extension().is_some_and(|end| end == "vtp");
        write(path, |out| if is_xml { mesh.write_vtp(out) } else { mesh.write_vtk(out) })?;
    }
    Ok(())
}

/// A file, complete or absent, as something that can be written to.
fn write(
    path: &Path,
    fill: impl FnOnce(Box<dyn Write + Send + '_>) -> Result<(), emulate::Error>,
) -> Result<(), Stop> {
    let mut output = Output::open(path)?;
    let mut failed = None;
    let done = fill(Box::new(Pipe { output: &mut output, failed: &mut failed }));
    if let Some(error) = failed {
        return Err(output.stop(error));
    }
    done.map_err(|error| ours(error, &path.display().to_string()))?;
    output.finish()
}

/// Hands bytes to an output and keeps its error.
struct Pipe<'o> {
    output: &'o mut Output,
    failed: &'o mut Option<Error>,
}

impl Write for Pipe<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.output.write(bytes).map(|()| bytes.len()).map_err(|error| {
            let told = io::Error::other(error.to_string());
            *self.failed = Some(error);
            told
        })
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn to_json(operation: &AdditiveOperation<'_>, part: &AdditivePart<'_, '_>, faults: &[&Diagnostic]) -> String {
    let statistics = operation.statistics().unwrap_or_default();
    let faults: Vec<_> = faults
        .iter()
        .map(|fault| json!({ "line": fault.line, "column": fault.column, "text": fault.kind.to_string() }))
        .collect();
    let report = json!({
        "total_time": statistics.total_time,
        "moving_time": statistics.moving_time,
        "dwell_time": statistics.dwell_time,
        "path_length": statistics.path_length,
        "deposition_length": statistics.deposition_length,
        "travel_length": statistics.travel_length,
        "volume": part.extruded_volume(),
        "mass": part.bead().mass(part.extruded_volume()),
        "n_layers": part.n_layers(),
        "bounds": operation.bounds().map(|bounds| json!({ "min": bounds.min, "max": bounds.max })),
        "commands": operation.commands().len(),
        "diagnostics": faults,
    });
    format!("{report:#}\n")
}

fn described(
    name: &str,
    flavor: &Flavor,
    operation: &AdditiveOperation<'_>,
    part: &AdditivePart<'_, '_>,
    knows_unit: bool,
) -> String {
    let all = operation.statistics().unwrap_or_default();
    let volume = part.extruded_volume();
    let mut text = format!("{name}: {} commands, read as {}\n", operation.commands().len(), flavor.name);
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  time      {} ({:.1} s; {:.1} s of it dwells, {:.1} s lost to acceleration)",
        report::time(all.total_time),
        all.total_time,
        all.dwell_time,
        all.time_lost
    );
    if operation.process_data().action().contains(&Action::Home) {
        text.push_str("            homing takes a while that nobody knows; it is not in it\n");
    }
    let _ = writeln!(
        text,
        "  way       {:.2} m: {:.2} m with clay, {:.2} m without",
        all.path_length / 1000.0,
        all.deposition_length / 1000.0,
        all.travel_length / 1000.0
    );
    let _ = writeln!(
        text,
        "  speed     {:.1} mm/s in the mean, {:.1} mm/s at most",
        all.mean_speed, all.max_speed
    );
    let mass = part.bead().mass(volume);
    let unit = if knows_unit { "" } else { "; E is taken for mm³, --machine says what it is" };
    let _ = writeln!(
        text,
        "  clay      {:.1} ml, {mass:.0} g, in {} layers{unit}",
        volume / 1000.0,
        part.n_layers()
    );
    if let Some(bounds) = operation.bounds() {
        let side = |axis: usize| format!("{:.2} to {:.2}", bounds.min[axis], bounds.max[axis]);
        let _ = writeln!(text, "  room      x {}, y {}, z {} mm", side(0), side(1), side(2));
    }
    text
}
