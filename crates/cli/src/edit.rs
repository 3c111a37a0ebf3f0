//! `clayforge edit`.

use crate::args::Edit as Words;
use crate::craft::read;
use crate::output::put;
use crate::report::{Done, Stop, about, say};
use ::edit::{
    At, Axes, Base, Clean, Edit, FANS, HEATERS, Nozzle, Pause, Rim, Scale, Section, Size, Speed, apply_all,
};
use clap::{ArgGroup, Args, Parser, ValueEnum};
use clayforge::Error;
use std::path::PathBuf;

/// Changes a file.
pub fn run(words: &Words) -> Done {
    let edits: Vec<Edit> = groups(&words.edits)
        .into_iter()
        .map(|group| One::try_parse_from(group).unwrap_or_else(|error| error.exit()).edit())
        .collect::<Result<_, Error>>()?;
    let text = read(&words.file)?;
    let edited = apply_all(&text, &edits).map_err(|error| named(words, error))?;
    put(&words.output, &edited.text)?;
    for sentence in &edited.said {
        say(&format!("{sentence}\n"));
    }
    Ok(())
}

/// An error with the file in front of the edit that refuses it.
fn named(words: &Words, mut error: Error) -> Stop {
    error.what = format!("{}: {}", words.file.display(), error.what);
    about(&words.file, error).into()
}

/// The edits by name.
const NAMES: [&str; 7] = ["scale", "speed", "nozzle", "base", "clean", "rim", "pause"];

/// Cuts the words where a new edit begins.
fn groups(words: &[String]) -> Vec<&[String]> {
    let mut starts: Vec<usize> =
        (1..words.len()).filter(|&index| NAMES.contains(&words[index].as_str())).collect();
    starts.insert(0, 0);
    starts.push(words.len());
    starts.windows(2).map(|ends| &words[ends[0]..ends[1]]).collect()
}

/// One edit with its options.
#[derive(Parser)]
#[command(name = "clayforge edit FILE -o OUT", no_binary_name = true, disable_help_subcommand = true)]
enum One {
    /// Make the part larger or smaller, about its middle and the bed
    Scale(ScaleWords),
    /// Make beads faster or slower
    Speed(SpeedWords),
    /// Give the beads the section of another nozzle
    Nozzle(NozzleWords),
    /// Put the base of another file under a spiral
    Base(BaseWords),
    /// Take commands out
    Clean(CleanWords),
    /// Repeat the last turn
    Rim(RimWords),
    /// Stop on the way: lift, park, wait, press clay, go on
    Pause(PauseWords),
}

#[derive(Args)]
#[command(group = ArgGroup::new("size").required(true).args(["factor", "height"]))]
struct ScaleWords {
    /// So many times as large
    #[arg(long, value_name = "F", allow_negative_numbers = true)]
    factor: Option<f64>,
    /// So high
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    height: Option<f64>,
    /// What is scaled
    #[arg(long, value_enum, default_value = "xyz")]
    axes: AxesWord,
    /// The nozzle is scaled too, so beads become wider
    #[arg(long)]
    bead: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum AxesWord {
    /// All
    Xyz,
    /// The height alone
    Z,
}

#[derive(Args)]
#[command(group = ArgGroup::new("how").required(true).multiple(true).args(["factor", "bottom", "top"]))]
struct SpeedWords {
    /// Times the speed that it has
    #[arg(long, value_name = "F", allow_negative_numbers = true, conflicts_with_all = ["bottom", "top"])]
    factor: Option<f64>,
    /// The factor at the lowest bead
    #[arg(long, value_name = "F", allow_negative_numbers = true, requires = "top")]
    bottom: Option<f64>,
    /// The factor at the highest bead
    #[arg(long, value_name = "F", allow_negative_numbers = true, requires = "bottom")]
    top: Option<f64>,
    /// Travels too
    #[arg(long)]
    travels: bool,
}

#[derive(Args)]
struct NozzleWords {
    /// The nozzle for which the file was made
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    old: f64,
    /// The nozzle that prints it
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    new: f64,
    /// The form of a bead cut across
    #[arg(long, value_enum, default_value = "rectangle")]
    section: SectionWord,
    /// The width of a bead in nozzles, for `stadium`
    #[arg(long, value_name = "F", default_value_t = 1.2)]
    spread: f64,
    /// The height of a layer, for `stadium` [default: measured]
    #[arg(long, value_name = "MM")]
    layer: Option<f64>,
}

#[derive(Clone, Copy, ValueEnum)]
enum SectionWord {
    /// Width times height
    Rectangle,
    /// A rectangle with round ends
    Stadium,
    /// An ellipse
    Ellipse,
}

#[derive(Args)]
struct BaseWords {
    /// The file whose base is taken
    other: PathBuf,
    /// Up to where it is a base [default: up to its spiral, or all of it]
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    height: Option<f64>,
    /// What its E is multiplied by, when it is of another unit
    #[arg(long, value_name = "F")]
    e_factor: Option<f64>,
    /// How high the nozzle goes over the base on its way to the spiral
    #[arg(long, value_name = "MM", default_value_t = 5.0)]
    lift: f64,
}

#[derive(Args)]
#[command(group = ArgGroup::new("what").required(true).multiple(true).args(["commands", "heaters", "fans"]))]
struct CleanWords {
    /// Commands such as M104
    #[arg(value_name = "COMMAND", value_delimiter = ',')]
    commands: Vec<String>,
    /// Everything that heats
    #[arg(long)]
    heaters: bool,
    /// Everything that blows
    #[arg(long)]
    fans: bool,
}

#[derive(Args)]
struct RimWords {
    /// How often the last turn is repeated
    #[arg(long, value_name = "N")]
    turns: u32,
    /// How much higher each turn lies than the one before
    #[arg(long, value_name = "MM", default_value_t = 0.0)]
    rise: f64,
    /// The clay of a turn against that of the last; 0 smooths without clay
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    flow: f64,
}

#[derive(Args)]
#[command(group = ArgGroup::new("when").required(true).args(["at", "after_base"]))]
struct PauseWords {
    /// Before the first bead above this height
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    at: Option<f64>,
    /// Before the spiral
    #[arg(long)]
    after_base: bool,
    /// How far the nozzle rises
    #[arg(long, value_name = "MM", default_value_t = 20.0)]
    lift: f64,
    /// Where it waits [default: above the part]
    #[arg(long, value_name = "X,Y", value_parser = place, allow_hyphen_values = true)]
    park: Option<[f64; 2]>,
    /// E that is pressed before it comes back
    #[arg(long, value_name = "E", default_value_t = 0.0)]
    prime: f64,
    /// E that is drawn back before it rises
    #[arg(long, value_name = "E", default_value_t = 0.0)]
    relieve: f64,
    /// The command that waits
    #[arg(long, value_name = "COMMAND", default_value = "M0")]
    wait: String,
}

/// `10,-5` as a place.
fn place(text: &str) -> Result<[f64; 2], String> {
    let number = |part: &str| part.trim().parse().map_err(|_| "it must be X,Y, like 0,200".to_owned());
    match text.split_once(',') {
        Some((x, y)) => Ok([number(x)?, number(y)?]),
        None => Err("it must be X,Y, like 0,200".to_owned()),
    }
}

impl One {
    /// The edit that the words mean; reads the file that it names.
    fn edit(self) -> Result<Edit, Error> {
        Ok(match self {
            Self::Scale(words) => Edit::Scale(Scale {
                size: match words.height {
                    Some(height) => Size::Height(height),
                    None => Size::Factor(words.factor.unwrap_or(1.0)),
                },
                axes: match words.axes {
                    AxesWord::Xyz => Axes::Xyz,
                    AxesWord::Z => Axes::Z,
                },
                bead: words.bead,
            }),
            Self::Speed(words) => {
                let constant = words.factor.unwrap_or(1.0);
                Edit::Speed(Speed {
                    bottom: words.bottom.unwrap_or(constant),
                    top: words.top.unwrap_or(constant),
                    travels: words.travels,
                })
            }
            Self::Nozzle(words) => Edit::Nozzle(Nozzle {
                old: words.old,
                new: words.new,
                section: match words.section {
                    SectionWord::Rectangle => Section::Rectangle,
                    SectionWord::Stadium => Section::Stadium,
                    SectionWord::Ellipse => Section::Ellipse,
                },
                spread: words.spread,
                layer: words.layer,
            }),
            Self::Base(words) => Edit::Base(Base {
                other: read(&words.other)?,
                height: words.height,
                e_factor: words.e_factor,
                lift: words.lift,
            }),
            Self::Clean(words) => {
                let mut commands = words.commands;
                commands.extend(HEATERS.iter().filter(|_| words.heaters).map(|&name| name.to_owned()));
                commands.extend(FANS.iter().filter(|_| words.fans).map(|&name| name.to_owned()));
                Edit::Clean(Clean { commands })
            }
            Self::Rim(words) => Edit::Rim(Rim { turns: words.turns, rise: words.rise, flow: words.flow }),
            Self::Pause(words) => Edit::Pause(Pause {
                at: words.at.map_or(At::Base, At::Height),
                lift: words.lift,
                park: words.park,
                prime: words.prime,
                relieve: words.relieve,
                wait: words.wait,
            }),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{NAMES, One, groups, place};
    use clap::{CommandFactory, Parser};

    fn words(text: &str) -> Vec<String> {
        text.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn the_edits_are_sound() {
        One::command().debug_assert();
        let commands = One::command();
        let names: Vec<&str> = commands.get_subcommands().map(clap::Command::get_name).collect();
        assert_eq!(names, NAMES);
    }

    #[test]
    fn a_name_begins_a_new_edit() {
        let all = words("scale --factor 0.5 base scale.gcode clean --fans scale --height 3");
        let lengths: Vec<usize> = groups(&all).iter().map(|group| group.len()).collect();
        assert_eq!(lengths, [3, 2, 2, 3]);
        for group in groups(&all) {
            assert!(One::try_parse_from(group).is_ok(), "{group:?}");
        }
    }

    #[test]
    fn half_of_a_ramp_is_refused() {
        for text in
            ["speed", "speed --top 1", "speed --factor 1 --top 1 --bottom 2", "scale", "pause", "clean"]
        {
            assert!(One::try_parse_from(words(text)).is_err(), "{text}");
        }
        assert!(One::try_parse_from(words("speed --top 0.5 --bottom 1")).is_ok());
    }

    #[test]
    fn a_place_is_two_numbers() {
        assert_eq!(place("0, -5.5"), Ok([0.0, -5.5]));
        assert!(place("5").is_err() && place("a,b").is_err());
    }
}
