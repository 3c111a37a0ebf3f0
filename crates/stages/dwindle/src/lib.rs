#![doc = include_str!("../README.md")]

use skein::{
    Bead, End, Error, Facts, Feed, Layer, Line, Move, Notes, Nozzle, OrLag, Ratio, Settings, Skein, Stage,
    Stretch, Thread,
};

#[cfg(test)]
mod tests;

/// Lets the pressure go at the end of a bead.
#[derive(Clone, Debug, Settings)]
pub struct Dwindle {
    /// How much clay still comes out after the clay is stopped: what the hose, the clay and the air in it give back.
    /// Found by printing a line into the air, stopping, and weighing what follows. With "lag" it is what flows while the
    /// clay lags behind, less what oozebane has made up for.
    #[setting(default = OrLag::Lag, min = 0.0, max = 1000.0, unit = "mm³")]
    pub pent_up_volume: OrLag<Ratio>,
    /// How much clay the end of the bead takes on which the pressure goes. Five to ten times what is pent up; with "lag"
    /// seven times.
    #[setting(default = OrLag::Lag, min = 0.001, max = 1000.0, unit = "mm³")]
    pub slowdown_volume: OrLag<Ratio>,
    /// What still flows at the very end, as a share.
    #[setting(default = 0.5, min = 0.0, max = 1.0)]
    pub end_rate: Ratio,
    /// In how many steps it becomes less.
    #[setting(default = 5, min = 1, max = 100)]
    pub slowdown_steps: u32,
    /// Whether the nozzle becomes slower instead, and the bead keeps its width but for what is pent up. For machines that
    /// push evenly whatever they are told, like an air tank with a valve.
    #[setting(default = false)]
    pub slow_feed: bool,
}

impl Stage for Dwindle {
    const NAME: &'static str = "dwindle";

    fn craft(&self, mut skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        let mut facts = skein.facts()?;
        let bead = facts.bead()?;
        let relief = self.relief(&facts, bead)?;
        if relief.slowdown <= 0.0 {
            notes.say("nothing is pent up any more: the lag is 0 s, or oozebane has made up for it");
            return Ok(skein);
        }
        facts.made_up(End::Stop, relief.pent_up / bead.area() * 1000.0);
        skein.state(&facts)?;
        let nozzles = skein.nozzles();
        skein.rewrite(notes, |index, layer, _| {
            let bead = bead.of_height(layer.height(&facts)?);
            Ok(relief.layer(layer, &nozzles[index], bead))
        })
    }
}

/// How many times what is pent up the end of a bead takes (stages.md §9.3: five to ten).
const SLOWDOWN: f64 = 7.0;

impl Dwindle {
    fn relief(&self, facts: &Facts, bead: Bead) -> Result<Relief<'_>, Error> {
        let pent_up = match self.pent_up_volume {
            OrLag::Is(volume) => volume.f64(),
            OrLag::Lag => facts.stop_lag()?.f64() * facts.operating_feed()?.mm_per_s() * bead.area(),
        };
        let slowdown = match self.slowdown_volume {
            OrLag::Is(volume) => volume.f64(),
            OrLag::Lag => SLOWDOWN * pent_up,
        };
        if pent_up > slowdown {
            return Err(Error::new(format!("{pent_up} mm³ cannot be let go within {slowdown} mm³ of bead"))
                .hint("slowdown_volume is five to ten times pent_up_volume"));
        }
        Ok(Relief { dwindle: self, pent_up, slowdown })
    }
}

/// The stage at work, in mm³.
struct Relief<'a> {
    dwindle: &'a Dwindle,
    pent_up: f64,
    slowdown: f64,
}

impl Relief<'_> {
    fn layer(&self, layer: Layer, entering: &Nozzle, bead: Bead) -> Vec<Line> {
        layer
            .rethread(entering, |thread, _, behind| (!behind.on).then(|| self.dwindled(thread.clone(), bead)))
    }

    /// The thread with its end cut into steps that become less (stages.md §7.7).
    fn dwindled(&self, thread: Thread, bead: Bead) -> Thread {
        // Clay in mm³ per micron of bead.
        let area = bead.area() / 1000.0;
        let volume: f64 =
            thread.pieces().map(|(from, piece)| piece.step.length(from) * piece.flow.f64() * area).sum();
        let slow = self.slowdown.min(volume);
        let steps = f64::from(self.dwindle.slowdown_steps);
        let (mut done, mut rest) = cut(thread, volume - slow, area);
        for step in 0..self.dwindle.slowdown_steps {
            let last = step + 1 == self.dwindle.slowdown_steps;
            let (part, after) = if last {
                let end = Thread { start: rest.end(), stretches: Vec::new() };
                (rest, end)
            } else {
                cut(rest, slow / steps, area)
            };
            rest = after;
            // What is left of the slowdown in the middle of this step.
            let left = slow / self.slowdown * (1.0 - (f64::from(step) + 0.5) / steps);
            done = done.join(self.at_rate(part, left + self.dwindle.end_rate.f64() * (1.0 - left)));
        }
        done
    }

    /// A part of a thread at a rate: less clay on the same way, or the same way more slowly.
    fn at_rate(&self, mut part: Thread, rate: f64) -> Thread {
        let kept = 1.0 - self.pent_up / self.slowdown;
        let share = if self.dwindle.slow_feed { kept } else { kept * rate };
        for Stretch { step, flow, .. } in &mut part.stretches {
            *flow = Ratio::from_f64(flow.f64() * share).unwrap_or(*flow);
            if self.dwindle.slow_feed {
                let slower = step.feed.and_then(|feed| Feed::from_mm_per_s(feed.mm_per_s() * rate));
                *step = Move { feed: slower.or(step.feed), ..*step };
            }
        }
        part
    }
}

/// Cuts a thread where so much clay has been laid; `area` is mm³ per micron of bead.
fn cut(thread: Thread, volume: f64, area: f64) -> (Thread, Thread) {
    let (mut left, mut at) = (volume, 0.0);
    for (from, piece) in thread.pieces() {
        let length = piece.step.length(from);
        let takes = length * piece.flow.f64() * area;
        if left < takes {
            at += length * left / takes;
            break;
        }
        left -= takes;
        at += length;
    }
    thread.split(at)
}
