use crate::Choice;
use crate::settings::{Kind, ReadValue, Setting, Value};
use shape::Point;
use std::fmt;
use std::str::FromStr;
use unit::{Micron, Ratio};

/// The printer: how large it is, what it pushes through, and what its E word counts.
#[derive(Clone, Debug, PartialEq, crate::Settings)]
pub struct Machine {
    /// The room in which the nozzle may move: length along x, length along y, height.
    #[setting(default = Bed::cube(200), min = 1.0, max = 100000.0, unit = "mm")]
    pub bed: Bed,
    /// Where x = 0, y = 0 lies on the bed.
    #[setting(default = Origin::Corner)]
    pub origin: Origin,
    /// The outline of the bed.
    #[setting(default = BedShape::Rectangle)]
    pub shape: BedShape,
    /// The inner diameter of the nozzle.
    #[setting(default = 3.0, min = 0.1, max = 100.0, unit = "mm")]
    pub nozzle: Micron,
    /// The program in the printer. It decides which commands `check` warns of: Marlin and RepRapFirmware refuse E while
    /// it is cold, Marlin and Klipper refuse long ways of E.
    #[setting(default = Firmware::Unknown)]
    pub firmware: Firmware,
    /// How fast E can go, in its unit per second; 0 if nobody knows. Faster moves are slowed down by the firmware.
    #[setting(default = 0.0, min = 0.0, max = 1000.0)]
    pub max_e_speed: Ratio,
    /// How much clay the pump can give; 0 if nobody knows. More makes thinner beads.
    #[setting(default = 0, min = 0, max = 1000000, unit = "mm³/s")]
    pub max_flow: u32,
    /// The longest way of E that the firmware takes in one move, in the unit of E; 0 for what the firmware comes with.
    #[setting(default = 0, min = 0, max = 1000000000)]
    pub longest_e: u32,
    /// What one unit of E is: "mm3" of clay; { ram = diameter } for millimetres of a piston of this diameter;
    /// { filament = diameter } for millimetres of a filament that only the firmware believes in;
    /// { per_mm = value } for this much E on every millimetre of a bead of nominal size.
    #[setting(default = EUnit::Mm3, min = 0.000001, max = 100000.0)]
    pub e_unit: EUnit,
    /// How long the clay goes on after the pump has stopped, and stays away after it has started: print a line, stop, and
    /// divide the length of its tail by the speed. A bare auger takes 0.05 to 0.2 s, a ram at the nozzle 0.2 to 1 s, a
    /// hose or a tank of air 1 to 5 s. What makes up for it (oozebane, splodge, dwindle) takes its measure from it.
    #[setting(default = 0.2, min = 0.0, max = 60.0, unit = "s")]
    pub lag: Ratio,
    /// What the printer can heat: any of "nozzle", "bed", "chamber". Clay wants none; a chamber may be drying air.
    #[setting(default = Heaters::default())]
    pub heaters: Heaters,
}

impl Machine {
    /// The least x and y of the bed, in microns.
    pub fn least(&self) -> (i32, i32) {
        match self.origin {
            Origin::Corner => (0, 0),
            Origin::Center => (-(self.bed.x.0 / 2), -(self.bed.y.0 / 2)),
        }
    }

    /// What the bed covers of the plane.
    pub fn area(&self) -> BedArea {
        let (x, y) = self.least();
        let high = Point::new(x + self.bed.x.0, y + self.bed.y.0);
        BedArea { low: Point::new(x, y), high, shape: self.shape }
    }
}

/// What the bed covers of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BedArea {
    /// Its least x and y.
    pub low: Point,
    /// Its greatest x and y.
    pub high: Point,
    /// Its outline.
    pub shape: BedShape,
}

impl BedArea {
    /// Whether a point lies on the bed, at least so many microns from its edge.
    pub fn holds(&self, point: Point, margin: f64) -> bool {
        // From the middle of the bed, as a share of the way to its side.
        let share = |low: i32, high: i32, at: i32| {
            let half = (f64::from(high) - f64::from(low)) / 2.0;
            (f64::from(at) - f64::from(low) - half).abs() / (half - margin).max(f64::MIN_POSITIVE)
        };
        let (x, y) = (share(self.low.x, self.high.x, point.x), share(self.low.y, self.high.y, point.y));
        match self.shape {
            BedShape::Rectangle => x <= 1.0 && y <= 1.0,
            BedShape::Ellipse => x * x + y * y <= 1.0,
        }
    }
}

/// Length, depth and height of the printing room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bed {
    /// Along x.
    pub x: Micron,
    /// Along y.
    pub y: Micron,
    /// Upwards.
    pub z: Micron,
}

impl Bed {
    /// A room with three equal sides, in millimetres.
    const fn cube(mm: i32) -> Self {
        Self { x: Micron(mm * 1000), y: Micron(mm * 1000), z: Micron(mm * 1000) }
    }
}

impl Setting for Bed {
    const KIND: Kind = Kind::Form("[x, y, z]");
    fn read(value: &Value) -> Result<Self, String> {
        match value {
            Value::List(values) if values.len() == 3 => Ok(Self {
                x: Micron::read_value(&values[0])?,
                y: Micron::read_value(&values[1])?,
                z: Micron::read_value(&values[2])?,
            }),
            _ => Err("is not of the form [x, y, z]".to_owned()),
        }
    }
    fn show(&self) -> Value {
        Value::List(vec![self.x.show(), self.y.show(), self.z.show()])
    }
}

/// Where the machine counts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Origin {
    /// The front left corner of the bed.
    Corner,
    /// The middle of the bed, as on delta machines.
    Center,
}

/// The outline of the bed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum BedShape {
    /// A rectangle.
    Rectangle,
    /// An ellipse that touches the rectangle's sides; a circle when they are equal.
    Ellipse,
}

/// The program in a printer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Firmware {
    /// Nobody knows; `check` warns as for Marlin, which most clay printers run.
    Unknown,
    /// Marlin.
    Marlin,
    /// RepRapFirmware, on Duet boards.
    Reprapfirmware,
    /// Klipper.
    Klipper,
    /// One that does as it is told.
    Plain,
}

/// What one unit of E is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EUnit {
    /// A cubic millimetre of clay.
    Mm3,
    /// A millimetre of a ram of this diameter.
    Ram(Micron),
    /// A millimetre of a make-believe filament of this diameter.
    Filament(Micron),
    /// So much E, in millionths, on each millimetre of a bead of nominal section.
    PerMm(i32),
}

impl EUnit {
    /// E units per cubic millimetre, when a nominal bead has a section of `section` mm².
    ///
    /// A cylinder of diameter d holds π/4·d² mm³ per mm (clay.md §5.2).
    pub fn per_mm3(self, section: f64) -> f64 {
        match self {
            Self::Mm3 => 1.0,
            Self::Ram(diameter) | Self::Filament(diameter) => {
                1.0 / (std::f64::consts::FRAC_PI_4 * diameter.mm() * diameter.mm())
            }
            Self::PerMm(millionths) => f64::from(millionths) / 1e6 / section,
        }
    }
}

impl Setting for EUnit {
    const KIND: Kind =
        Kind::Form("\"mm3\", { ram = diameter }, { filament = diameter } or { per_mm = value }");
    fn read(value: &Value) -> Result<Self, String> {
        let named = match value {
            Value::Text(word) if word == "mm3" => return Ok(Self::Mm3),
            Value::Table(entries) if entries.len() == 1 => Some((entries[0].0.as_str(), &entries[0].1)),
            _ => None,
        };
        match named {
            Some(("ram", diameter)) => Micron::read_value(diameter).map(Self::Ram),
            Some(("filament", diameter)) => Micron::read_value(diameter).map(Self::Filament),
            Some(("per_mm", number)) => Ratio::read_value(number).map(|ratio| Self::PerMm(ratio.0)),
            _ => Err("is not \"mm3\", { ram = diameter }, { filament = diameter } or { per_mm = value }"
                .to_owned()),
        }
    }
    fn show(&self) -> Value {
        let named = |name: &str, number: f64| Value::Table(vec![(name.to_owned(), Value::Number(number))]);
        match *self {
            Self::Mm3 => Value::Text("mm3".to_owned()),
            Self::Ram(diameter) => named("ram", diameter.mm()),
            Self::Filament(diameter) => named("filament", diameter.mm()),
            Self::PerMm(millionths) => named("per_mm", f64::from(millionths) / 1e6),
        }
    }
}

/// What a machine can heat.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Heaters {
    /// The nozzle.
    pub nozzle: bool,
    /// The bed.
    pub bed: bool,
    /// The air around the part.
    pub chamber: bool,
}

impl Heaters {
    const WORDS: [&str; 3] = ["nozzle", "bed", "chamber"];

    fn of(self) -> [bool; 3] {
        [self.nozzle, self.bed, self.chamber]
    }

    fn words(self) -> impl Iterator<Item = &'static str> {
        Self::WORDS.into_iter().zip(self.of()).filter_map(|(word, has)| has.then_some(word))
    }

    fn from_words<'a>(words: impl Iterator<Item = &'a str>) -> Option<Self> {
        let mut heaters = Self::default();
        for word in words {
            match word {
                "nozzle" => heaters.nozzle = true,
                "bed" => heaters.bed = true,
                "chamber" => heaters.chamber = true,
                _ => return None,
            }
        }
        Some(heaters)
    }
}

impl Setting for Heaters {
    const KIND: Kind = Kind::Form("[\"nozzle\", \"bed\", \"chamber\"] or fewer");
    fn read(value: &Value) -> Result<Self, String> {
        let refuse = || "is not a list of \"nozzle\", \"bed\", \"chamber\"".to_owned();
        let Value::List(values) = value else { return Err(refuse()) };
        let words = values.iter().map(|value| match value {
            Value::Text(word) => word.as_str(),
            _ => "",
        });
        Self::from_words(words).ok_or_else(refuse)
    }
    fn show(&self) -> Value {
        Value::List(self.words().map(|word| Value::Text(word.to_owned())).collect())
    }
}

impl fmt::Display for Heaters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<&str> = self.words().collect();
        f.write_str(if words.is_empty() { "none".to_owned() } else { words.join(" ") }.as_str())
    }
}

impl FromStr for Heaters {
    type Err = ();
    fn from_str(text: &str) -> Result<Self, ()> {
        Self::from_words(text.split(' ').filter(|word| *word != "none")).ok_or(())
    }
}

// The header forms: plain words, since a header tag holds no quotes.

impl fmt::Display for BedArea {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let index = BedShape::ALL.iter().position(|shape| *shape == self.shape).unwrap_or(0);
        let [left, front, right, back] = [self.low.x, self.low.y, self.high.x, self.high.y].map(Micron);
        write!(f, "{} {left} {front} {right} {back}", BedShape::WORDS[index].0)
    }
}

impl FromStr for BedArea {
    type Err = ();
    fn from_str(text: &str) -> Result<Self, ()> {
        let mut words = text.split(' ');
        let word = words.next().unwrap_or("");
        let index = BedShape::WORDS.iter().position(|(known, _)| *known == word).ok_or(())?;
        let mut length = || words.next().and_then(|word| word.parse::<Micron>().ok()).ok_or(());
        let [left, front, right, back] = [length()?, length()?, length()?, length()?].map(|length| length.0);
        let (low, high) = (Point::new(left, front), Point::new(right, back));
        let sound = low.x < high.x && low.y < high.y && words.next().is_none();
        if sound { Ok(Self { low, high, shape: BedShape::ALL[index] }) } else { Err(()) }
    }
}

impl fmt::Display for EUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mm3 => f.write_str("mm3"),
            Self::Ram(diameter) => write!(f, "ram {diameter}"),
            Self::Filament(diameter) => write!(f, "filament {diameter}"),
            Self::PerMm(millionths) => write!(f, "per_mm {}", Ratio(*millionths)),
        }
    }
}

impl FromStr for EUnit {
    type Err = ();
    fn from_str(text: &str) -> Result<Self, ()> {
        let (word, number) = text.split_once(' ').unwrap_or((text, ""));
        let length = || number.parse::<Micron>().ok().filter(|length| length.0 > 0).ok_or(());
        match word {
            "mm3" if number.is_empty() => Ok(Self::Mm3),
            "ram" => length().map(Self::Ram),
            "filament" => length().map(Self::Filament),
            "per_mm" => number
                .parse::<Ratio>()
                .ok()
                .filter(|ratio| ratio.0 > 0)
                .map(|ratio| Self::PerMm(ratio.0))
                .ok_or(()),
            _ => Err(()),
        }
    }
}
