//! Says the verdicts: what, where, why it matters.

use super::ending::End;
use super::findings::{Finding, Findings};
use super::limits::{Firmware, Limits};
use super::rule::{Place, Rule, Severity, Verdict};
use crate::report::{Interruptions, Model};

/// What the sentences tell beside the findings.
pub(crate) struct Facts<'a> {
    pub(crate) limits: &'a Limits,
    pub(crate) overrun: Option<End>,
    pub(crate) breaks: &'a Interruptions,
    /// The usual step from layer to layer.
    pub(crate) usual: Option<f64>,
}

/// Turns findings into verdicts.
pub(crate) fn verdicts(findings: &Findings, facts: &Facts<'_>, machine: &Model) -> Vec<Verdict> {
    let starts = starts(machine);
    let mut verdicts: Vec<Verdict> = findings
        .iter()
        .map(|(rule, finding)| {
            let layer = starts.partition_point(|start| *start <= finding.first).checked_sub(1);
            let place = Place { index: finding.first, layer, height: finding.height };
            let severity = match rule {
                // Whether a machine can heat only somebody who knows it can say.
                Rule::Heats if facts.limits.heated.is_none() => Severity::Warns,
                rule => rule.severity(),
            };
            let place = (rule != Rule::NothingPrinted).then_some(place);
            let (what, why) = sentence(rule, finding, facts);
            let wherever = place.map_or_else(String::new, |place| said(&place, finding.count));
            let count = if rule == Rule::Interrupted { facts.breaks.count } else { finding.count };
            Verdict { rule, severity, place, count, text: format!("{wherever}{what}; {why}") }
        })
        .collect();
    verdicts.sort_by_key(|verdict| verdict.severity);
    verdicts
}

/// The first lines of layers and spirals in the order of the file.
fn starts(machine: &Model) -> Vec<usize> {
    let runs = machine.layers.iter().chain(&machine.spirals);
    let mut starts: Vec<usize> = runs.map(|run| run.start_index).collect();
    starts.sort_unstable();
    starts
}

/// `line 12 (layer 3, z 4.5) and 2 more: `, layers and lines counted from 1.
fn said(place: &Place, count: usize) -> String {
    let mut inside = Vec::new();
    inside.extend(place.layer.map(|layer| format!("layer {}", layer + 1)));
    inside.extend(place.height.map(|height| format!("z {}", mm(height))));
    let inside = if inside.is_empty() { String::new() } else { format!(" ({})", inside.join(", ")) };
    let more = if count > 1 { format!(" and {} more", count - 1) } else { String::new() };
    format!("line {}{inside}{more}: ", place.index + 1)
}

/// What is so, and why it matters.
fn sentence(rule: Rule, finding: &Finding, facts: &Facts<'_>) -> (String, &'static str) {
    let worst = mm(finding.worst);
    let at_most = |what: &str| format!("{what}, at worst {worst} mm in line {}", finding.worst_at + 1);
    match rule {
        Rule::NothingPrinted => {
            ("no line moves the nozzle while clay comes out".into(), "nothing is printed in this file")
        }
        Rule::UnknownHeight => (
            "clay is laid at a height that the file never sets".into(),
            "the nozzle may be in the bed or in the air; set Z behind the homing",
        ),
        Rule::BelowBed => (
            format!("the nozzle goes to z {}", mm(-finding.worst)),
            "clay needs room above the bed, and below it the nozzle is driven into the bed",
        ),
        Rule::OutsideBed => (at_most("clay is laid beside the bed"), "the machine runs into its end stops"),
        Rule::AboveMachine => {
            (at_most("clay is laid above what the machine reaches"), "the top of the pot will be missing")
        }
        Rule::IntoClay => {
            (at_most("the nozzle goes lower than clay that stands there"), "it ploughs through the pot")
        }
        Rule::AfterEnd => (
            format!("clay is laid {}", facts.overrun.map_or("after the end", End::said)),
            "something was put behind the end, and nobody knows where the nozzle goes",
        ),
        Rule::LiftedOff => (
            format!("clay is laid {worst} mm above all that stands"),
            "it falls on the pot; layers are missing, or the nozzle was lifted for the end already",
        ),
        Rule::Heats => (
            format!("a heater is set to {worst} °C"),
            "a clay printer has none: firmware for plastic waits forever or dries the clay in the nozzle",
        ),
        Rule::TravelOutside => {
            (at_most("the nozzle leaves the bed without printing"), "the machine may run into its end stops")
        }
        Rule::Descends => (
            at_most("the printing goes down again"),
            "that is right for parts one after the other, and wrong in one pot",
        ),
        Rule::FirstLayer => {
            let meant = facts.limits.layers.map_or(0.0, |layers| layers.first);
            (
                format!("the first layer is at {worst} mm, and the profile says {} mm", mm(meant)),
                "too high it does not stick, too low it is torn",
            )
        }
        Rule::LayerHeight => {
            let meant = facts.limits.layers.map_or(0.0, |layers| layers.rest);
            (
                format!("a layer is {worst} mm high, and the profile says {} mm", mm(meant)),
                "the bead is wider or thinner than it is meant to be",
            )
        }
        Rule::LayerGap => (
            format!("a step of {worst} mm follows where {} mm are usual", mm(facts.usual.unwrap_or(0.0))),
            "a layer is missing, and the next one falls instead of being pressed on",
        ),
        Rule::RepeatedLayer => (
            format!("{worst} mm are laid a second time on the same way at the same height"),
            "there is no room for the clay: it is pushed aside",
        ),
        Rule::SpiralPitch => match facts.limits.layers {
            Some(layers) => (
                format!(
                    "the spiral rises by up to {worst} mm a turn, and the profile says {}",
                    mm(layers.rest)
                ),
                "turns that lie too far apart do not bond, too near they bulge",
            ),
            None => (
                format!("the spiral rises by up to {worst} mm a turn, much more than in other turns"),
                "turns that lie too far apart do not bond",
            ),
        },
        Rule::InAir => (
            format!("a bead hangs over nothing for up to {worst} mm"),
            "soft clay bridges no more than a bead's width or two: it sags or falls",
        ),
        Rule::Interrupted => (
            format!(
                "the printing is interrupted {}, {} mm in all; the longest break has {worst} mm",
                times(facts.breaks.count),
                mm(facts.breaks.length)
            ),
            "clay does not stop at once: every break leaves a drip or a hole",
        ),
        Rule::OpenAir => (
            at_most("a break in the printing crosses open air"),
            "the clay that follows the nozzle falls where it does not belong",
        ),
        Rule::ESpeed => (
            format!(
                "E is to go at {worst} units/s, and the machine does {}",
                mm(facts.limits.max_e_speed.unwrap_or(0.0))
            ),
            "the firmware slows the whole move down, and the print takes longer than planned",
        ),
        Rule::Flow => (
            format!(
                "{worst} mm³/s are asked for, and the pump gives {}",
                mm(facts.limits.max_flow.unwrap_or(0.0))
            ),
            "the bead gets thinner than it is meant to be",
        ),
        Rule::ColdExtrusion => (
            "E moves, and no `M302 P1` before it allows that without heat".into(),
            "Marlin and RepRapFirmware ignore E then, unless they were built for clay; a bare `M302` only asks",
        ),
        Rule::LongPrime => (
            format!("{worst} of E in one move"),
            match facts.limits.firmware {
                Some(Firmware::Klipper) => {
                    "Klipper stops the print, unless max_extrude_only_distance allows it"
                }
                _ => {
                    "Marlin ignores E in so long a move, unless EXTRUDE_MAXLENGTH allows it; cut it into several"
                }
            },
        ),
        Rule::LostRelativeE => (
            "`G90` stands between `M83` and this E".into(),
            "Marlin counts E from the start behind a `G90`, so hardly any clay comes; say `M83` behind it",
        ),
        Rule::NoSpeed => (
            "clay is laid before any F was said".into(),
            "the machine goes as fast as it went last, whatever that was",
        ),
    }
}

fn times(count: usize) -> String {
    if count == 1 { "once".into() } else { format!("{count} times") }
}

/// A number of a sentence: as many decimals as help, up to three.
fn mm(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}
