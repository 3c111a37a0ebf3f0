//! The words of the command line.

use clap::{Args, Parser, Subcommand};
use clayforge::emulate::View;
use std::path::PathBuf;

/// A slicer for clay printers: a mesh goes in, G-code that a paste extruder can print comes out.
#[derive(Parser)]
#[command(
    name = "clayforge",
    version,
    arg_required_else_help = true,
    after_help = "\
Examples:
  clayforge slice cup.stl                          cup.gcode, with the profile `clay`
  clayforge slice cup.stl --profile generic-ram --set fill.walls=3
  clayforge slice cup.stl --dump steps             look at every stage: steps/*.layers.svg
  clayforge profile new > mine.toml                a profile of your own
  clayforge explain fill.walls                     what a setting does
  clayforge mesh cup.stl                           size, faults, thinnest wall, overhang of a part
  clayforge check cup.gcode                        layers, spirals and gaps of a finished file
  clayforge edit cup.gcode -o small.gcode scale --factor 0.5
  clayforge emulate cup.gcode --machine mine.toml  how long it takes, corners and all

Exit codes: 0 done, 1 refused or failed, 2 wrong usage."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Subcommand)]
pub enum Command {
    /// Turn a part into G-code
    Slice(Slice),
    /// Run one stage: text in, text out
    Craft(Craft),
    /// List the stages in order, with what each is for
    Stages(Stages),
    /// Show the manual of a stage, or of one setting
    Explain(Explain),
    /// List, show, check and begin profiles
    Profile(Profile),
    /// Say what a part is, what is wrong with it, and whether it stands
    Mesh(Mesh),
    /// Say what a G-code file is made of, and whether a clay printer can print it
    Check(Check),
    /// Change finished G-code: scale, speed, nozzle, base, clean, rim, pause
    Edit(Edit),
    /// Say what a machine makes of a G-code file: time, clay, speeds, tables
    Emulate(Emulate),
}

/// Where the settings come from.
#[derive(Args, Clone, Default)]
pub struct Settings {
    /// A profile: a file, one of your config folder, or a built-in one [default: clay]
    #[arg(long, value_name = "NAME|FILE")]
    pub profile: Option<String>,
    /// Set one key, on top of the profile; may be given many times
    #[arg(long, value_name = "STAGE.KEY=VALUE", value_parser = pair)]
    pub set: Vec<(String, String)>,
}

/// `--set fill.walls=2` as a pair.
fn pair(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.to_owned())),
        _ => Err("it must be STAGE.KEY=VALUE, like fill.walls=2".to_owned()),
    }
}

/// `clayforge slice`.
#[derive(Args)]
#[command(after_help = "\
Examples:
  clayforge slice cup.stl                                    writes cup.gcode
  clayforge slice cup.stl -o - --quiet | less                to standard output
  clayforge slice cup.stl --set carve.layer_height=1 --set 'machine.bed=[300, 300, 400]'
  clayforge slice cup.stl --set 'machine.e_unit={ ram = 60 }'
  clayforge slice layers.svg                                 layers drawn elsewhere, each with its height (z:1.5)
  clayforge slice cup.stl lid.stl knob.stl -o set.gcode      side by side on one bed
  clayforge slice lying.stl --rotate 90,0,0                  stood up
  clayforge slice cup.stl --until fill --dump steps          stop behind fill and look at it
  clayforge slice cup.stl --report cup.json                  layers, clay, time, warnings for scripts")]
pub struct Slice {
    /// The part, or several that are put side by side
    #[arg(value_name = "PART", required = true)]
    pub parts: Vec<PathBuf>,
    #[command(flatten)]
    pub settings: Settings,
    #[command(flatten)]
    pub placing: Placing,
    /// Where the G-code goes; `-` is standard output [default: the first PART with .gcode]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// Write the text and the drawn layers of every stage into this folder
    #[arg(long, value_name = "DIR")]
    pub dump: Option<PathBuf>,
    /// Stop behind this stage and write its text [default output: PART.STAGE.svg or .gcode]
    #[arg(long, value_name = "STAGE")]
    pub until: Option<String>,
    /// Write layers, lengths, clay, time and warnings as JSON
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Work on so many threads; 0 is one for each core
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub threads: usize,
    /// No progress and no summary; errors are still said
    #[arg(short, long)]
    pub quiet: bool,
}

/// Where the part goes: short for settings of carve.
#[derive(Args, Clone, Default)]
pub struct Placing {
    /// Turn every part about x, then y, then z, in degrees: carve.rotate
    #[arg(long, value_name = "X,Y,Z", value_parser = turns, allow_hyphen_values = true)]
    pub rotate: Option<String>,
    /// Put it on the middle of the bed: carve.place = "bed"
    #[arg(long)]
    pub center: bool,
    /// Let it down onto the bed where its file has it: carve.place = "keep"; with --center it is put on the middle
    #[arg(long)]
    pub drop: bool,
}

impl Placing {
    /// The settings as pairs.
    pub fn settings(&self) -> Vec<(String, String)> {
        let place = match (self.center, self.drop) {
            (true, _) => Some("\"bed\""),
            (false, true) => Some("\"keep\""),
            (false, false) => None,
        };
        let pair = |key: &str, value: &str| (key.to_owned(), value.to_owned());
        let rotate = self.rotate.as_deref().map(|turns| pair("carve.rotate", turns));
        place.map(|place| pair("carve.place", place)).into_iter().chain(rotate).collect()
    }
}

/// `90,0,0` as a value of a profile.
fn turns(text: &str) -> Result<String, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|turn| turn.trim().parse::<f64>()).collect();
    match numbers.as_deref() {
        Ok([x, y, z]) if [x, y, z].iter().all(|turn| turn.is_finite()) => Ok(format!("[{x}, {y}, {z}]")),
        _ => Err("it must be X,Y,Z in degrees, like 90,0,0".to_owned()),
    }
}

/// `clayforge mesh`.
#[derive(Args)]
#[command(after_help = "\
Examples:
  clayforge mesh scan.stl
  clayforge mesh scan.stl --json
  clayforge mesh scan.stl --repair -o sound.stl              what slice would do, as a file

Exit codes: 0 the part was examined, whatever is wrong with it; 1 it could not be read; 2 wrong usage.")]
pub struct Mesh {
    /// The part
    pub part: PathBuf,
    #[command(flatten)]
    pub settings: Settings,
    /// As JSON, for scripts
    #[arg(long)]
    pub json: bool,
    /// Write the repaired part as a binary STL
    #[arg(long, requires = "output")]
    pub repair: bool,
    /// Where the repaired part goes; `-` is standard output
    #[arg(short, long, value_name = "OUT", requires = "repair")]
    pub output: Option<PathBuf>,
}

/// `clayforge craft`.
#[derive(Args)]
#[command(after_help = "\
Examples:
  clayforge craft carve cup.stl | clayforge craft preface | clayforge craft inset > cup.inset.gcode
  clayforge craft fill cup.inset.gcode -o cup.fill.gcode --set fill.density=0.5

carve reads an STL and writes an SVG; preface reads that and writes tagged G-code; the other stages read and write
tagged G-code; export writes what the machine reads. `clayforge slice` does the same in memory, to the byte.")]
pub struct Craft {
    /// The stage
    pub stage: String,
    /// The text it reads; `-` or nothing is standard input
    pub input: Option<PathBuf>,
    #[command(flatten)]
    pub settings: Settings,
    /// Where its text goes [default: standard output]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
}

/// `clayforge stages`.
#[derive(Args)]
pub struct Stages {
    /// As JSON, for scripts
    #[arg(long)]
    pub json: bool,
}

/// `clayforge explain`.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  clayforge explain fill\n  clayforge explain fill.walls\n  clayforge explain machine"
)]
pub struct Explain {
    /// A stage, a section, or a setting
    #[arg(value_name = "STAGE[.SETTING]")]
    pub topic: String,
}

/// `clayforge profile`.
#[derive(Args)]
pub struct Profile {
    /// What to do.
    #[command(subcommand)]
    pub action: ProfileAction,
}

/// What to do with profiles.
#[derive(Subcommand)]
pub enum ProfileAction {
    /// Name the profiles that are found
    List,
    /// Print everything that a profile sets, as a profile
    Show {
        /// A name or a file
        name: String,
    },
    /// Say whether a file is a sound profile
    Check {
        /// A name or a file
        file: String,
    },
    /// Print the JSON schema of profiles, for editors
    Schema,
    /// Print a commented profile to begin with
    New,
}

/// `clayforge check`.
#[derive(Args)]
pub struct Check {
    /// A G-code file of any program; `-` is standard input
    pub file: PathBuf,
    /// The printer it is for: a file, one of your config folder, or a built-in one
    #[arg(long, value_name = "NAME|FILE")]
    pub profile: Option<String>,
    /// As JSON, for scripts
    #[arg(long)]
    pub json: bool,
}

/// `clayforge edit`.
#[derive(Args)]
#[command(after_help = "\
Edits, made in the order in which they stand; `clayforge edit - scale --help` and so on say more:
  scale   --factor F | --height MM [--axes xyz|z] [--bead]
  speed   --factor F | --bottom F --top F [--travels]
  nozzle  --old MM --new MM [--section rectangle|stadium|ellipse] [--spread F] [--layer MM]
  base    OTHER.gcode [--height MM] [--e-factor F] [--lift MM]
  clean   [COMMAND,...] [--heaters] [--fans]
  rim     --turns N [--rise MM] [--flow F]
  pause   --at MM | --after-base [--lift MM] [--park X,Y] [--prime E] [--relieve E] [--wait COMMAND]

Examples:
  clayforge edit cup.gcode -o small.gcode scale --factor 0.5
  clayforge edit cup.gcode -o slow.gcode speed --bottom 1 --top 0.6 rim --turns 2
  clayforge edit vase.gcode -o both.gcode base plate.gcode clean --heaters pause --after-base --park 0,0")]
pub struct Edit {
    /// A G-code file of any program; `-` is standard input
    pub file: PathBuf,
    /// Where the result goes; `-` is standard output. It must stand before the edits
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
    /// What to do, one edit behind the other
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, required = true, value_name = "EDIT")]
    pub edits: Vec<String>,
}

/// `clayforge emulate`.
#[derive(Args)]
#[command(after_help = "\
Examples:
  clayforge emulate cup.gcode
  clayforge emulate cup.gcode --machine mine.toml --json
  clayforge emulate cup.gcode --acceleration 500 --junction-deviation 0.05 --csv cup.csv
  clayforge emulate cup.gcode --picture cup.svg --color speed_peak --view layer=3
  clayforge emulate cup.gcode --vtk cup.vtp --events cup.events.csv     for ParaView and Abaqus

--vtk writes XML to .vtp and the legacy form to all else; --events writes the keywords of Abaqus too to a file that ends in .inp.")]
pub struct Emulate {
    /// A G-code file of any program; `-` is standard input
    pub file: PathBuf,
    /// The machine: a profile by name or file; its sections [machine] and [motion] count
    #[arg(long, value_name = "NAME|FILE")]
    pub machine: Option<String>,
    /// What it accelerates with, mm/s², whatever the file says
    #[arg(long, value_name = "A", value_parser = positive)]
    pub acceleration: Option<f64>,
    /// How far it may cut corners, mm, whatever the file says
    #[arg(long, value_name = "J", value_parser = not_negative)]
    pub junction_deviation: Option<f64>,
    /// How speed changes within a move
    #[arg(long, value_enum, default_value = "trapezoid")]
    pub motion: Motion,
    /// The dialect, by name or as a TOML file [default: guessed from the file]
    #[arg(long, value_name = "NAME|FILE")]
    pub flavor: Option<String>,
    /// Write a table with a row for each command
    #[arg(long, value_name = "F")]
    pub csv: Option<PathBuf>,
    /// Write the same table as Parquet
    #[arg(long, value_name = "F")]
    pub parquet: Option<PathBuf>,
    /// Write the same table as an Arrow IPC file
    #[arg(long, value_name = "F")]
    pub arrow: Option<PathBuf>,
    /// Write an event series for Abaqus
    #[arg(long, value_name = "F")]
    pub events: Option<PathBuf>,
    /// Write the beads as lines with data, for ParaView
    #[arg(long, value_name = "F")]
    pub vtk: Option<PathBuf>,
    /// Draw the deposits as SVG
    #[arg(long, value_name = "F")]
    pub picture: Option<PathBuf>,
    /// The column of the table that gives the picture its colours
    #[arg(long, value_name = "COLUMN", default_value = "speed_peak")]
    pub color: String,
    /// From where: top, front, or layer=N, counted from 0
    #[arg(long, value_name = "VIEW", default_value = "top", value_parser = view)]
    pub view: View,
    /// As JSON, for scripts
    #[arg(long)]
    pub json: bool,
    /// Stop at the first thing that is wrong with the file
    #[arg(long)]
    pub strict: bool,
}

/// How speed changes within a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Motion {
    /// Even acceleration
    Trapezoid,
    /// Limited jerk
    Scurve,
    /// At once
    Constant,
}

fn view(text: &str) -> Result<View, String> {
    match text {
        "top" => Ok(View::Top),
        "front" => Ok(View::Front),
        _ => text
            .strip_prefix("layer=")
            .and_then(|layer| layer.parse().ok())
            .map(View::Layer)
            .ok_or_else(|| "it must be top, front or layer=N".to_owned()),
    }
}

fn number(text: &str) -> Result<f64, String> {
    text.parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(|| "it must be a number".to_owned())
}

fn positive(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value > 0.0 { Ok(value) } else { Err("it must be more than 0".to_owned()) }
}

fn not_negative(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value >= 0.0 { Ok(value) } else { Err("it must not be negative".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::{Arguments, Command, pair};
    use clap::{CommandFactory, Parser};

    #[test]
    fn the_command_line_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn settings_are_pairs_as_the_shell_leaves_them() {
        assert_eq!(pair("fill.walls=2"), Ok(("fill.walls".to_owned(), "2".to_owned())));
        assert_eq!(pair("machine.e_unit=\"mm3\"").expect("a pair").1, "\"mm3\"");
        assert_eq!(pair("alteration.start=G28 X=1").expect("only the first counts").1, "G28 X=1");
        assert!(pair("fill.walls").is_err() && pair("=2").is_err());
        let words =
            ["clayforge", "slice", "a.stl", "--set", "machine.bed=[300,300,400]", "--set", "fill.walls=2"];
        let arguments = Arguments::try_parse_from(words).unwrap_or_else(|error| panic!("{error}"));
        assert!(matches!(arguments.command, Command::Slice(slice) if slice.settings.set.len() == 2));
    }
}
