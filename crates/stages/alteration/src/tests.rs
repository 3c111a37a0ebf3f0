use super::*;

fn skein(body: &str) -> Skein {
    let text = format!(
        "(<extruderInitialization>)\nG90\n(<layerHeight> 0.4 </layerHeight>)\n(<edgeWidth> 3.0 </edgeWidth>)\n(<settings>)\n\
         (<setting> carve layer_height 0.4 </setting>)\n(<setting> preface meta \"vase\" </setting>)\n(</settings>)\n\
         (</extruderInitialization>)\n(<crafting>)\nM83\n{body}(</crafting>)\n"
    );
    Skein::read(text.as_bytes()).expect("a skein")
}

const LAYER: &str = "(<layer> 0.2 )\nG1 X0 Y0 Z2.7\n(</layer>)\n";

fn altered(stage: &Alteration, body: &str) -> Result<(String, Notes), Error> {
    let mut notes = Notes::default();
    let skein = stage.craft(skein(body), &mut notes)?;
    Ok((String::from_utf8(skein.write()).expect("text"), notes))
}

fn start(text: &str) -> Alteration {
    Alteration { start: text.to_owned(), end: String::new(), ..Alteration::default() }
}

/// stages_tests.md AL1.
#[test]
fn al1_a_token_becomes_the_value_of_the_setting() {
    for token in
        ["<setting.carve.LayerHeight>", "<setting.carve.layer_height>", "<Setting.Carve.Layer Height (mm)>"]
    {
        let (text, _) =
            altered(&start(&format!("M117 S{token} <setting.preface.meta>")), LAYER).expect("known");
        assert!(text.contains(")M117 S0.4 vase\n"), "{token}: {text}");
    }
    let (text, _) = altered(&start("M117 2 < 3 and 4 > 1, <3>"), LAYER).expect("no token");
    assert!(text.contains("M117 2 < 3 and 4 > 1, <3>\n"), "{text}");
}

/// stages_tests.md AL2.
#[test]
fn al2_only_the_last_of_several_temperatures_stays() {
    let body = "(<layer> 0.2 )\nM104 S190\n(<edge> outer )\nM104 S200\nM108 S0.5\nM108 S0.8\nG1 X0 Y0 Z0.2\nM104 S210\n\
                (</edge>)\n(</layer>)\n";
    let (text, _) = altered(&start(""), body).expect("fine");
    assert!(
        text.contains(
            "(<layer> 0.2 )\nM104 S200\n(<edge> outer )\nM108 S0.8\nG1 X0.0 Y0.0 Z0.2\nM104 S210\n"
        ),
        "{text}"
    );
    let keep = Alteration { remove_redundant: false, ..start("") };
    assert!(altered(&keep, body).expect("fine").0.contains("M104 S190"));
}

/// stages_tests.md AL3.
#[test]
fn al3_coordinates_are_absolute_behind_the_start() {
    let (text, _) = altered(&start("G91\nG1 Z5"), LAYER).expect("fine");
    let lines: Vec<&str> =
        text.lines().filter_map(|line| line.strip_prefix("(<alterationDeleteThisPrefix/>)")).collect();
    assert_eq!(lines, ["G91", "G1 Z5", "G90"]);
}

#[test]
fn heat_is_refused_with_its_line() {
    for (line, heats) in [
        ("M104 S200", true),
        ("m109s60", true),
        ("N5 M140 S40 ; bed", true),
        ("M190 R50", true),
        ("M104 S0", false),
        ("M42 S200", false),
        ("; M104 S200", false),
        ("M1040 S200", false),
        ("G28", false),
    ] {
        let refused = altered(&start(&format!("G28\n{line}")), LAYER).err().map(|error| error.to_string());
        assert_eq!(refused, heats.then(|| format!("`start`, line 2: `{line}` heats")), "{line}");
    }
    let end = Alteration { end: "M104 S1".to_owned(), ..Alteration::default() };
    assert_eq!(altered(&end, LAYER).expect_err("heat").to_string(), "`end`, line 1: `M104 S1` heats");
}

#[test]
fn an_end_that_goes_down_is_doubted() {
    for (end, lowers) in [
        ("G1 Z0", true),
        ("G91\nG1 Z-1", true),
        ("G0 X0 Z2.7", false),
        ("G91\nG1 Z1", false),
        ("G91\nG90\nG1 Z1", true),
    ] {
        let stage = Alteration { end: end.to_owned(), ..Alteration::default() };
        let (_, notes) = altered(&stage, LAYER).expect("only doubted");
        assert_eq!(notes.iter().count(), usize::from(lowers), "{end}");
    }
}

/// Found by the fuzz target `stages`: the end of a print that was cut off stood in its last layer, or in the header.
#[test]
fn a_print_that_was_cut_off_gets_no_end_and_a_note() {
    for body in ["", LAYER] {
        let mut cut = skein(body);
        cut.tail.clear();
        let mut notes = Notes::default();
        let done =
            Alteration { start: String::new(), ..Alteration::default() }.craft(cut.clone(), &mut notes);
        assert_eq!(done, Ok(cut), "{body}");
        assert!(notes.iter().any(|note| note.text.contains("no end")), "{body}: {notes:?}");
    }
}
