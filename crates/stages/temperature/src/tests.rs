use crate::Temperature;
use skein::{Notes, Skein, Stage};

fn craft(heaters: &str) -> (String, Notes) {
    let text = format!(
        "(<extruderInitialization>)\n(<heaters> {heaters} </heaters>)\n(<edgeWidth> 0.72 </edgeWidth>)\n\
         (</extruderInitialization>)\n(<crafting>)\n(</crafting>)\n"
    );
    let skein = Skein::read(text.as_bytes()).expect("a skein");
    let mut notes = Notes::default();
    let made = Temperature::default().craft(skein, &mut notes).expect("temperature");
    (String::from_utf8(made.write()).expect("text"), notes)
}

#[test]
fn te1_the_header_has_the_rates_and_the_seven_temperatures() {
    let (text, notes) = craft("nozzle");
    assert!(notes.is_empty());
    let values: Vec<&str> = text
        .lines()
        .filter(|line| line.contains("Rate>") || line.contains("Temperature>"))
        .filter_map(|line| line.split(' ').nth(1))
        .collect();
    let wanted = ["3.0", "10.0", "200.0", "200.0", "195.0", "220.0", "230.0", "200.0", "230.0"];
    assert_eq!(values, wanted, "{text}");
    assert!(text.find("supportedLayersTemperature") < text.find("edgeWidth"));
}

#[test]
fn a_machine_that_heats_no_nozzle_is_told_nothing() {
    for heaters in ["none", "bed chamber"] {
        let (text, notes) = craft(heaters);
        assert!(!text.contains("Temperature>"), "{text}");
        assert_eq!(notes.iter().count(), 1);
    }
}
