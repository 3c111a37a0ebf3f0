use super::*;

fn read(text: &str) -> Result<Profile, Error> {
    Profile::read(Source { name: "mine.toml".to_owned(), text: text.to_owned() }, &only_built_in)
}

fn refused(text: &str) -> (String, String) {
    let error = read(text).expect_err(text);
    (error.to_string(), error.hint.unwrap_or_default())
}

#[test]
fn an_unknown_key_has_its_place_and_a_suggestion() {
    let (message, hint) = refused("[fill]\nwals = 3\n");
    assert_eq!(message, "mine.toml:2:1: there is no setting `fill.wals`");
    assert_eq!(hint, "did you mean `fill.walls`?");
    let (message, hint) = refused("[carve]\nwalls = 3\n");
    assert_eq!(message, "mine.toml:2:1: there is no setting `carve.walls`");
    assert_eq!(hint, "did you mean `fill.walls`?");
    let (message, hint) = refused("\n[fil]\n");
    assert_eq!(message, "mine.toml:2:2: there is no section `fil`");
    assert_eq!(hint, "did you mean `fill`?");
    assert_eq!(refused("walls = 2\n").1, "did you mean `fill.walls`?");
}

#[test]
fn a_value_out_of_bounds_has_its_place() {
    let (message, hint) = refused("# my clay\n[fill]\nwalls   = -1\n");
    assert_eq!(message, "mine.toml:3:11: fill.walls = -1 is below 0");
    assert_eq!(hint, "clayforge explain fill.walls");
    let (message, _) = refused("fill.density = 1.5");
    assert_eq!(message, "mine.toml:1:16: fill.density = 1.5 is above 1");
    for text in [
        "fill.density = nan",
        "fill.density = inf",
        "fill.density = \"much\"",
        "fill.walls = 1.5",
        "fill.walls = 2020-01-01",
        "fill.active = 1",
        "fill = 3",
        "[[fill]]\nwalls = 1",
        "machine.bed = [1, 2]",
        "machine.bed = { x = 1 }",
        "machine.e_unit = \"litres\"",
        "machine.e_unit = { ram = -1 }",
        "chain = \"long\"",
        "inherits = 3",
        "inherits = \"nothing\"",
        "fill.walls = 1\nfill.walls = 2",
        "fill.walls.more = 2",
        "fill.walls =",
    ] {
        assert!(refused(text).0.starts_with("mine.toml:"), "{text}: {}", refused(text).0);
    }
}

#[test]
fn profiles_do_not_inherit_in_a_circle() {
    let lookup = |wanted: &str, _: &str| {
        let next = if wanted == "a" { "b" } else { "a" };
        Ok(Source { name: wanted.to_owned(), text: format!("inherits = \"{next}\"") })
    };
    let start = Source { name: "mine.toml".to_owned(), text: "inherits = \"a\"".to_owned() };
    let error = Profile::read(start, &lookup).expect_err("a circle");
    assert_eq!(error.to_string(), "b:1:12: profiles inherit in a circle: mine.toml → a → b → a");

    let deeper = |wanted: &str, _: &str| {
        Ok(Source { name: wanted.to_owned(), text: format!("inherits = \"{wanted}x\"") })
    };
    let start = Source { name: "x".to_owned(), text: "inherits = \"xx\"".to_owned() };
    assert!(Profile::read(start, &deeper).expect_err("no bottom").message.contains("deep"));
}

#[test]
fn what_is_shown_reads_back() {
    let own = "sequence = [\"carve\", \"preface\", \"inset\", \"fill\", \"speed\", \"dimension\", \"export\"]\n\
               [fill]\nactive = false\ndensity = 0.35\nseam = [3.25, -4]\n\
               [machine]\ne_unit = { per_mm = 0.05 }\n\
               [preface]\nmeta = \"a \\\"red\\\" clay\\twith # grog\"\n";
    let mut profiles = vec![Profile::default(), read(own).expect("own")];
    for (name, _) in BUILT_IN {
        profiles.push(Profile::built_in(name).expect("known").unwrap_or_else(|error| panic!("{error}")));
    }
    for profile in profiles {
        let shown = profile.show();
        let again = read(&shown).unwrap_or_else(|error| panic!("{error}\n{shown}"));
        assert_eq!(again, profile);
        assert_eq!(again.check(&mut skein::Notes::default()), Ok(()));
    }
}

#[test]
fn the_starter_reads_with_and_without_its_marks() {
    let starter = starter();
    assert_eq!(read(&starter).expect("starter"), Profile::built_in("clay").expect("clay").expect("reads"));
    let bare: Vec<&str> = starter
        .lines()
        .map(|line| match line.strip_prefix("# ") {
            // An assignment or a line of a text in three quotes, not a sentence.
            Some(rest) if rest.split_once(" = ").is_some_and(|(key, _)| !key.contains(' ')) => rest,
            Some(rest) if rest.ends_with("\"\"\"") || is_command(rest) => rest,
            _ => line,
        })
        .collect();
    let bare = bare.join("\n");
    read(&bare).unwrap_or_else(|error| panic!("{error}\n{bare}"));
}

/// `G1 Z10`, and no sentence that begins with a G.
fn is_command(line: &str) -> bool {
    line.starts_with(['G', 'M']) && line.as_bytes().get(1).is_some_and(u8::is_ascii_digit)
}

#[test]
fn the_command_line_sets_single_keys() {
    let mut profile = Profile::default();
    for (key, value) in [
        ("fill.walls", "3"),
        ("machine.bed", "[300,300,400]"),
        ("machine.e_unit", "\"mm3\""),
        ("machine.e_unit", "mm3"),
        ("machine.e_unit", "{ ram = 60 }"),
        ("fill.start", "seam"),
        ("fill.start", "\"seam\""),
        ("preface.meta", "42"),
        ("preface.meta", "white stoneware, 22 % water"),
        ("fill.active", "false"),
        ("chain", "seed"),
    ] {
        profile.set(key, value).unwrap_or_else(|error| panic!("{key}={value}: {error}"));
    }
    assert_eq!(profile.get("fill.walls").expect("known").1, Value::from(3));
    assert_eq!(profile.machine.bed.z, skein::Micron(400_000));
    assert_eq!(profile.chain, Chain::Seed);
    let error = profile.set("fill.walls", "-1").expect_err("below");
    assert_eq!(error.to_string(), "--set fill.walls=-1: fill.walls = -1 is below 0");
    for (key, value) in [
        ("fill.wals", "2"),
        ("fill", "2"),
        ("fill.walls", "two"),
        ("fill.walls", "[2"),
        ("", ""),
        ("inherits", "clay"),
    ] {
        assert!(profile.set(key, value).is_err(), "{key}={value}");
    }
}

#[test]
fn a_sequence_that_breaks_a_dependency_is_refused_with_the_pair() {
    let profile = read("\nsequence = [\"carve\", \"preface\", \"fill\", \"inset\", \"export\"]\n")
        .expect("names are known");
    let error = profile.check(&mut skein::Notes::default()).expect_err("fill before inset");
    assert_eq!(
        error.to_string(),
        "mine.toml:2:12: sequence has `fill` before `inset`: inset must come first"
    );
    assert_eq!(refused("sequence = [\"crave\"]").1, "did you mean `carve`?");
}

#[test]
fn settings_are_checked_against_each_other() {
    let check = |text: &str| {
        let mut notes = skein::Notes::default();
        read(text).expect(text).check(&mut notes).map(|()| notes.summary())
    };
    assert_eq!(check(""), Ok(Vec::new()));
    assert!(check("[carve]\nbead_width = 1.2\nbead_section = \"stadium\"").is_err());
    assert!(check("carve.active = false").is_err());
    assert_eq!(check("machine.nozzle = 1.0").expect("only noted").len(), 2);
    assert_eq!(check("carve.layer_height = 0.2").expect("only noted").len(), 1);
    assert_eq!(check("alteration.start = \"G28\\nM104 S200\"").expect("only noted").len(), 1);
}

#[test]
fn the_schema_is_json_and_knows_every_key() {
    let schema: serde_json::Value = serde_json::from_str(&schema()).expect("JSON");
    assert_eq!(schema["properties"]["fill"]["properties"]["walls"]["type"], "integer");
    assert_eq!(schema["properties"]["machine"]["properties"]["nozzle"]["minimum"], 0.1);
}
