//! What later stages must know: every fact has one name, one type and one place, here.

use crate::{BedArea, Choice, EUnit, Error, Heaters};
use std::fmt;
use std::str::FromStr;
use unit::{Celsius, Feed, Micron, Ratio};

/// The model of a bead's cross-section (clay.md §5.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choice)]
pub enum Section {
    /// Width × height: what neighbouring beads fill together when they lie one width apart.
    Rectangle,
    /// A rectangle with round flanks: a free bead pressed to its height.
    Stadium,
    /// An ellipse: soft clay, layers lower than the nozzle is wide.
    Ellipse,
}

impl Section {
    /// The area in mm² of a bead of this width and height in mm.
    ///
    /// The stadium has no sense for a bead higher than wide; there its flanks would cross and the ellipse, which
    /// meets it at w = h, takes over.
    pub fn area(self, width: f64, height: f64) -> f64 {
        use std::f64::consts::FRAC_PI_4;
        match self {
            Self::Rectangle => width * height,
            Self::Stadium if width >= height => (width - height) * height + FRAC_PI_4 * height * height,
            Self::Stadium | Self::Ellipse => FRAC_PI_4 * width * height,
        }
    }

    /// The width in mm of a bead of this area in mm² and height in mm: undoes [`Section::area`].
    pub fn width(self, area: f64, height: f64) -> f64 {
        use std::f64::consts::FRAC_PI_4;
        let ellipse = area / (FRAC_PI_4 * height);
        match self {
            Self::Rectangle => area / height,
            Self::Stadium if ellipse >= height => area / height + height * (1.0 - FRAC_PI_4),
            Self::Stadium | Self::Ellipse => ellipse,
        }
    }
}

/// A bead of nominal size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bead {
    /// Its greatest width.
    pub width: Micron,
    /// Its height: the layer's.
    pub height: Micron,
    /// The form of its cross-section.
    pub section: Section,
}

impl Default for Bead {
    /// A bead of no size.
    fn default() -> Self {
        Self { width: Micron::ZERO, height: Micron::ZERO, section: Section::Rectangle }
    }
}

impl Bead {
    /// Cross-section in mm².
    pub fn area(&self) -> f64 {
        self.section.area(self.width.mm(), self.height.mm())
    }

    /// How far apart two neighbouring beads lie when they fill the room between them: area over height.
    pub fn spacing(&self) -> Micron {
        Micron::from_mm(self.area() / self.height.mm()).unwrap_or(self.width)
    }

    /// The same bead in a layer of another height.
    pub fn of_height(self, height: Micron) -> Self {
        Self { height, ..self }
    }
}

macro_rules! facts {
    ($($(#[doc = $doc:literal])+ $field:ident: $type:ty = $tag:literal, $writer:literal, $parse:expr, $show:expr;)*) => {
        /// What the stages tell each other, typed. In the text of either document each is a tag with a value.
        #[derive(Clone, Debug, Default, PartialEq, Eq)]
        pub struct Facts {
            $($(#[doc = $doc])+ pub $field: Option<$type>,)*
        }

        impl Facts {
            /// Takes a tag and its value; `Ok(false)` when the tag is no fact.
            pub fn take(&mut self, tag: &str, value: &str) -> Result<bool, Error> {
                match tag {
                    $($tag => {
                        let parse: fn(&str) -> Option<$type> = $parse;
                        self.$field = Some(parse(value).ok_or_else(|| {
                            Error::new(format!("`{value}` is no value for `{}`", $tag))
                        })?);
                        Ok(true)
                    })*
                    _ => Ok(false),
                }
            }

            /// Every fact that is known, as tag and value, in the order of the table.
            pub fn tags(&self) -> Vec<(&'static str, String)> {
                let mut tags = Vec::new();
                $(if let Some(value) = &self.$field {
                    let show: fn(&$type) -> String = $show;
                    tags.push(($tag, show(value)));
                })*
                tags
            }

            $(
                $(#[doc = $doc])+
                ///
                /// # Errors
                /// When no stage has said it yet.
                pub fn $field(&self) -> Result<$type, Error> {
                    self.$field.ok_or_else(|| Error::new(format!("the header has no `{}`", $tag))
                        .hint(format!("the stage {} writes it and must come before", $writer)))
                }
            )*
        }
    };
}

fn word_of<T: Choice>(value: &T) -> String {
    T::ALL.iter().position(|known| known == value).map_or("", |index| T::WORDS[index].0).to_owned()
}

fn choice_of<T: Choice>(word: &str) -> Option<T> {
    T::WORDS.iter().position(|(known, _)| *known == word).and_then(|index| T::ALL.get(index).copied())
}

fn read<T: FromStr>(text: &str) -> Option<T> {
    text.parse().ok()
}

fn positive(text: &str) -> Option<Micron> {
    read::<Micron>(text).filter(|length| length.0 > 0)
}

fn show<T: fmt::Display>(value: &T) -> String {
    value.to_string()
}

/// A feed in the header is in mm/s with three decimals, as the seed writes it.
fn feed_of(text: &str) -> Option<Feed> {
    unit::decimal::read(text.as_bytes(), 3)
        .and_then(|value| u32::try_from(value.checked_mul(60)?).ok())
        .and_then(Feed::new)
}

fn show_feed(feed: &Feed) -> String {
    let mut text = Vec::new();
    unit::decimal::write(&mut text, (i64::from(feed.get()) + 30) / 60, 3);
    String::from_utf8(text).unwrap_or_default()
}

facts! {
    /// Digits behind the point of every coordinate; always three, since coordinates are whole microns.
    decimals: u32 = "decimalPlacesCarried", "carve", |text| read(text).filter(|places| *places == 3), show;
    /// The nominal height of a layer.
    layer_height: Micron = "layerHeight", "carve", positive, show;
    /// The height of the first layer.
    first_layer_height: Micron = "firstLayerHeight", "carve", positive, show;
    /// The inner diameter of the nozzle.
    nozzle: Micron = "nozzleDiameter", "carve", positive, show;
    /// What one unit of E is.
    e_unit: EUnit = "eUnit", "carve", read, show;
    /// What the machine can heat.
    heaters: Heaters = "heaters", "carve", read, show;
    /// How many seconds the clay comes too late after a start, less what stages have made up for.
    start_lag: Ratio = "startLag", "carve", read, show;
    /// How many seconds it goes on after a stop, less what stages have made up for.
    stop_lag: Ratio = "stopLag", "carve", read, show;
    /// What the bed covers of the plane.
    bed: BedArea = "bed", "carve", read, show;
    /// The form of a bead's cross-section.
    bead_section: Section = "beadSection", "carve", choice_of, word_of;
    /// The speed at which beads are laid.
    operating_feed: Feed = "operatingFeedRatePerSecond", "speed", feed_of, show_feed;
    /// The speed of travels.
    travel_feed: Feed = "travelFeedRatePerSecond", "speed", feed_of, show_feed;
    /// The speed of going around while something is waited for.
    orbital_feed: Feed = "orbitalFeedRatePerSecond", "speed", feed_of, show_feed;
    /// The fastest that the machine goes up or down.
    z_feed: Feed = "maximumZFeedRatePerSecond", "speed", feed_of, show_feed;
    /// How many degrees a second the nozzle cools.
    cooling_rate: Celsius = "coolingRate", "temperature", read, show;
    /// How many degrees a second the nozzle warms up.
    heating_rate: Celsius = "heatingRate", "temperature", read, show;
    /// How hot the nozzle lays the base of a raft.
    base_temperature: Celsius = "baseTemperature", "temperature", read, show;
    /// How hot it lays the rest of the raft.
    interface_temperature: Celsius = "interfaceTemperature", "temperature", read, show;
    /// How hot it lays the infill of the part's first layer.
    first_layer_infill_temperature: Celsius =
        "objectFirstLayerInfillTemperature", "temperature", read, show;
    /// How hot it lays the walls of the part's first layer.
    first_layer_perimeter_temperature: Celsius =
        "objectFirstLayerPerimeterTemperature", "temperature", read, show;
    /// How hot it lays the other layers.
    next_layers_temperature: Celsius = "objectNextLayersTemperature", "temperature", read, show;
    /// How hot it lays support.
    support_temperature: Celsius = "supportLayersTemperature", "temperature", read, show;
    /// How hot it lays the part on layers with support.
    supported_temperature: Celsius = "supportedLayersTemperature", "temperature", read, show;
    /// The distance between neighbouring beads.
    infill_width: Micron = "infillWidth", "carve", positive, show;
    /// The width of a bead.
    bead_width: Micron = "edgeWidth", "carve", positive, show;
}

impl Facts {
    /// A bead of nominal width and height.
    pub fn bead(&self) -> Result<Bead, Error> {
        Ok(Bead { width: self.bead_width()?, height: self.layer_height()?, section: self.bead_section()? })
    }
}
