use crate::Chamber;
use skein::{Celsius, Line, Micron, Notes, Ratio, Skein, Stage};

fn skein(heaters: &str, layers: &[&str]) -> Skein {
    let layers: String = layers.iter().map(|z| format!("(<layer> {z} )\n(</layer>)\n")).collect();
    let text = format!(
        "(<extruderInitialization>)\n(<heaters> {heaters} </heaters>)\n(</extruderInitialization>)\n(<crafting>)\n\
         {layers}(</crafting>)\nM103\n"
    );
    Skein::read(text.as_bytes()).expect("a skein")
}

fn craft(chamber: &Chamber, skein: Skein) -> (Skein, Notes) {
    let mut notes = Notes::default();
    let made = chamber.craft(skein, &mut notes).expect("chamber");
    made.verify().expect("lawful");
    assert_eq!(Skein::read(&made.write()).as_ref(), Ok(&made), "reading undoes writing");
    (made, notes)
}

fn texts<'a>(lines: impl IntoIterator<Item = &'a Line>) -> Vec<String> {
    let text = |line: &Line| {
        let mut out = Vec::new();
        line.write(&mut out);
        String::from_utf8(out).expect("text")
    };
    lines.into_iter().map(text).collect()
}

fn ramp(begin: i32, end: i32) -> Chamber {
    Chamber {
        bed_temperature_begin_change_height: Micron(begin),
        bed_temperature_end_change_height: Micron(end),
        ..Chamber::default()
    }
}

#[test]
fn h1_bed_and_chamber_are_said_once_behind_the_crafting_tag() {
    let (made, notes) = craft(&Chamber::default(), skein("nozzle bed chamber", &["0.2"]));
    assert!(notes.is_empty());
    assert_eq!(texts(&made.head)[3..], ["(<crafting>)", "M140 S60.0", "M141 S30.0"]);
    assert_eq!(made.lines().filter(|line| format!("{line:?}") == "Open(Crafting)").count(), 1);
}

#[test]
fn h2_the_bed_follows_the_height_and_is_said_when_it_changes() {
    let (made, _) = craft(&ramp(0, 10_000), skein("bed", &["0.2", "5.0", "5.0", "15.0", "20.0"]));
    let said: Vec<Vec<String>> =
        made.layers.iter().map(|layer| texts(&layer.lines[1..layer.lines.len() - 1])).collect();
    assert_eq!(said, [vec!["M140 S59.2"], vec!["M140 S40.0"], vec![], vec!["M140 S20.0"], vec![]]);
}

#[test]
fn h3_a_height_below_nothing_is_no_ramp() {
    let (made, _) = craft(&ramp(-1, 10_000), skein("bed", &["0.2", "5.0"]));
    assert!(made.layers.iter().all(|layer| layer.lines.len() == 2));
}

#[test]
fn h4_the_last_word_to_the_bed_is_off() {
    let (made, _) = craft(&ramp(0, 10_000), skein("bed", &["5.0"]));
    let all = texts(made.lines());
    let last = all.iter().rev().find(|line| line.starts_with("M140")).expect("a word to the bed");
    assert_eq!(last, "M140 S0.0");
    let stays = Chamber { turn_off_at_end: false, ..ramp(0, 10_000) };
    let (made, _) = craft(&stays, skein("bed", &["5.0"]));
    assert!(!texts(made.lines()).contains(&"M140 S0.0".to_owned()));
}

#[test]
fn a_machine_that_heats_nothing_hears_no_heater_word_and_the_potter_is_told() {
    let plain = skein("none", &["0.2", "5.0"]);
    let (made, notes) = craft(&ramp(0, 10_000), plain.clone());
    assert_eq!(made, plain);
    assert_eq!(notes.iter().count(), 2);
    let (made, notes) = craft(&Chamber::default(), skein("chamber", &["0.2"]));
    let said = texts(made.lines());
    assert!(said.contains(&"M141 S30.0".to_owned()) && !said.iter().any(|line| line.contains("M140")));
    assert_eq!(notes.iter().count(), 1);
}

#[test]
fn waiting_is_a_word_of_its_own() {
    let (made, _) = craft(&Chamber { wait: true, ..Chamber::default() }, skein("bed chamber", &[]));
    assert_eq!(texts(&made.head)[4..], ["M190 S60.0", "M191 S30.0"]);
    assert_eq!(texts(&made.tail)[2..], ["M140 S0.0", "M141 S0.0"]);
}

#[test]
fn pressure_needs_no_heater_and_goes_at_the_end() {
    let chamber = Chamber {
        bed_temperature: Celsius(0),
        chamber_temperature: Celsius(0),
        pressure: Ratio(3_500_000),
        pressure_line: "M106 P1 S{pressure}\nG4 P500".to_owned(),
        ..Chamber::default()
    };
    let (made, notes) = craft(&chamber, skein("none", &["0.2"]));
    assert!(notes.is_empty());
    let pasted = |lines: &[Line]| -> Vec<String> {
        lines
            .iter()
            .filter_map(|line| match line {
                Line::Pasted(text) => Some(text.to_string()),
                _ => None,
            })
            .collect()
    };
    assert_eq!(pasted(&made.head), ["M106 P1 S3.5", "G4 P500"]);
    assert_eq!(pasted(&made.tail), ["M106 P1 S0.0", "G4 P500"]);
}

#[test]
fn a_ramp_that_ends_before_it_begins_is_refused() {
    let refused = ramp(10_000, 5_000).craft(skein("bed", &["0.2"]), &mut Notes::default());
    assert!(refused.expect_err("refused").message.contains("begin to change at 10.0 mm"));
    // Both at one height: a step.
    let (made, _) = craft(&ramp(5_000, 5_000), skein("bed", &["4.9", "5.0"]));
    assert_eq!(texts(&made.layers[1].lines)[1], "M140 S20.0");
    assert_eq!(made.layers[0].lines.len(), 2);
}

#[test]
fn a_part_without_layers_passes() {
    craft(&ramp(0, 1), skein("bed chamber", &[]));
}
