//! How late the clay answers, and what makes up for it.
//!
//! Hose, clay and trapped air are a spring: when the pump stops, what is pent up in it still comes out, and when it starts,
//! the spring takes its share first. To the first order the flow q follows the pump's with a delay τ, so that τ·q is
//! pent up while a bead is laid (clay.md §5.3). The profile says τ once, as `machine.lag`; each stage that makes up for
//! it, or for a part of it, leaves the rest in the header for those behind it. So two of them never do it twice.

use crate::settings::{Kind, ReadValue, Setting, Value};
use crate::{Error, Facts};
use unit::{Feed, Micron, Ratio};

/// A measure that a profile gives, or that follows from the lag of the clay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OrLag<T> {
    /// What makes up for the lag that is left.
    Lag,
    /// This much.
    Is(T),
}

impl<T: Setting> Setting for OrLag<T> {
    const KIND: Kind = Kind::Form("a number, or \"lag\" for what follows from machine.lag");

    fn read(value: &Value) -> Result<Self, String> {
        match value {
            Value::Text(word) if word == "lag" => Ok(Self::Lag),
            Value::Text(_) => Err("is neither a number nor \"lag\"".to_owned()),
            value => T::read_value(value).map(Self::Is),
        }
    }

    fn show(&self) -> Value {
        match self {
            Self::Lag => Value::Text("lag".to_owned()),
            Self::Is(value) => value.show(),
        }
    }
}

/// One end of a bead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Where the clay comes too late.
    Start,
    /// Where it goes on too long.
    Stop,
}

impl End {
    fn left(self, facts: &mut Facts) -> &mut Option<Ratio> {
        match self {
            Self::Start => &mut facts.start_lag,
            Self::Stop => &mut facts.stop_lag,
        }
    }
}

impl OrLag<Micron> {
    /// The way in microns that a nozzle at this speed makes until the clay has followed; or the way that is set.
    ///
    /// # Errors
    /// When the header does not say how long the clay lags behind, or how fast the nozzle is.
    pub fn way(self, facts: &Facts, end: End, feed: Result<Feed, Error>) -> Result<f64, Error> {
        match self {
            Self::Is(way) => Ok(way.um()),
            Self::Lag => Ok(facts.lag(end)?.f64() * feed?.mm_per_s() * 1000.0),
        }
    }
}

impl Facts {
    /// How many seconds the clay is late at an end of a bead, less what stages have made up for.
    ///
    /// # Errors
    /// When no stage has said it.
    pub fn lag(&self, end: End) -> Result<Ratio, Error> {
        match end {
            End::Start => self.start_lag(),
            End::Stop => self.stop_lag(),
        }
    }

    /// Takes from the lag what a stage has made up for: a way in microns at the speed at which beads are laid.
    pub fn made_up(&mut self, end: End, way: f64) {
        let Some(feed) = self.operating_feed else { return };
        let left = end.left(self);
        *left = left.and_then(|lag| Ratio::from_f64((lag.f64() - way / (feed.mm_per_s() * 1000.0)).max(0.0)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facts() -> Facts {
        Facts {
            start_lag: Ratio::from_f64(0.2),
            stop_lag: Ratio::from_f64(0.5),
            operating_feed: Feed::from_mm_per_s(30.0),
            ..Facts::default()
        }
    }

    #[test]
    fn a_setting_is_a_number_or_the_word() {
        type Length = OrLag<Micron>;
        for (said, read) in
            [(Value::Text("lag".into()), Length::Lag), (Value::Number(6.0), Length::Is(Micron(6000)))]
        {
            assert_eq!(Length::read(&said), Ok(read));
            assert_eq!(read.show(), said);
        }
        assert_eq!(Length::read(&Value::Text("lags".into())), Err("is neither a number nor \"lag\"".into()));
        assert_eq!(Length::read(&Value::Bool(true)), Err("is true or false, not a number".into()));
    }

    #[test]
    fn what_one_stage_makes_up_for_is_not_left_for_the_next() {
        let mut facts = facts();
        let feed = facts.operating_feed();
        let way = |facts: &Facts, end| OrLag::Lag.way(facts, end, feed.clone());
        assert_eq!(way(&facts, End::Start), Ok(6000.0));
        assert_eq!(way(&facts, End::Stop), Ok(15_000.0));
        facts.made_up(End::Stop, 9000.0);
        assert_eq!(way(&facts, End::Stop), Ok(6000.0));
        facts.made_up(End::Stop, 9000.0);
        assert_eq!(way(&facts, End::Stop), Ok(0.0), "never less than nothing");
        assert_eq!(way(&facts, End::Start), Ok(6000.0), "the ends know nothing of each other");
        assert!(OrLag::Lag.way(&Facts::default(), End::Stop, feed.clone()).is_err());
        assert_eq!(OrLag::Is(Micron(70)).way(&Facts::default(), End::Stop, feed.clone()), Ok(70.0));
    }
}
