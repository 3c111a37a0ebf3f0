//! The command as scripts and people meet it: exit codes, messages, files.

use crate::support::{
    FINE, Triangles, clay, cuboid, example, name_of, root, sliced, stl, text_of, text_stl, tube,
};
use clayforge::{Form, Profile, STAGES, Station};
use serde_json::Value as Json;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{ChildStdout, Command, Output, Stdio};
use std::sync::OnceLock;
use tempfile::TempDir;

/// The command, built once.
pub fn program() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        // This test is target/debug/deps/all-…; the command is to be target/debug/clayforge.
        let own = std::env::current_exe().expect("a test knows where it is");
        let folder = own.parent().and_then(Path::parent).expect("target/debug").to_owned();
        let target = folder.parent().expect("target");
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut build = Command::new(cargo);
        build
            .current_dir(root())
            .args(["build", "--quiet", "--locked", "-p", "cli", "--target-dir"])
            .arg(target);
        if name_of(&folder) == "release" {
            build.arg("--release");
        }
        let done = build.output().expect("cargo runs");
        assert!(done.status.success(), "cargo build -p cli: {}", String::from_utf8_lossy(&done.stderr));
        folder.join(format!("clayforge{}", std::env::consts::EXE_SUFFIX))
    })
}

/// What a run of the command came to.
pub struct Ran {
    pub code: Option<i32>,
    pub out: Vec<u8>,
    pub err: String,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            out: output.stdout,
            err: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }
}

impl Ran {
    pub fn out(&self) -> String {
        String::from_utf8_lossy(&self.out).into_owned()
    }

    #[track_caller]
    pub fn done(self) -> Self {
        assert_eq!(self.code, Some(0), "{}", self.err);
        self
    }
}

/// A folder of one's own to run the command in; no profile of the user is found.
pub struct Room(TempDir);

impl Room {
    pub fn new() -> Self {
        Self(TempDir::new().expect("a folder"))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn put(&self, name: &str, bytes: impl AsRef<[u8]>) -> &Self {
        fs::write(self.path(name), bytes).expect("a file in a new folder");
        self
    }

    pub fn command<S: AsRef<OsStr>>(&self, words: &[S]) -> Command {
        let mut command = Command::new(program());
        command
            .args(words)
            .current_dir(self.0.path())
            .env("XDG_CONFIG_HOME", self.path("config"))
            .env("NO_COLOR", "1")
            .stdin(Stdio::null());
        command
    }

    pub fn run(&self, words: &[&str]) -> Ran {
        self.command(words).output().expect("the command runs").into()
    }

    /// Runs it with bytes on its standard input.
    pub fn feed(&self, words: &[&str], input: &[u8]) -> Ran {
        let mut child = self
            .command(words)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command runs");
        let mut stdin = child.stdin.take().expect("piped");
        let input = input.to_owned();
        let writer = std::thread::spawn(move || {
            // A command that refuses need not read to the end.
            let _ = stdin.write_all(&input);
        });
        let output = child.wait_with_output().expect("the command ends");
        writer.join().expect("the writer does not panic");
        output.into()
    }

    /// Every file with its bytes.
    pub fn listing(&self) -> BTreeMap<String, Vec<u8>> {
        let entries = fs::read_dir(self.0.path()).expect("the folder is there").flatten();
        entries.map(|entry| (name_of(&entry.path()), fs::read(entry.path()).unwrap_or_default())).collect()
    }
}

/// A message has what, where, why and a hint, and no more than a screen.
#[track_caller]
fn assert_message(err: &str, parts: &[&str]) {
    let mut lines = err.lines();
    let first =
        lines.find(|line| line.starts_with("error: ")).unwrap_or_else(|| panic!("no error is said: {err}"));
    assert!(first.matches(": ").count() >= 2, "what, where or why is missing: {first}");
    assert!(err.contains("\n  hint: "), "no hint: {err}");
    assert!(err.len() < 2048, "{} bytes of message", err.len());
    for part in parts {
        assert!(err.to_lowercase().contains(&part.to_lowercase()), "`{part}` is not in: {err}");
    }
    assert!(!err.contains("panicked"), "{err}");
}

// Parts that are refused.

/// What is wrong with a part, its name, its bytes, more words for the command, and what the message must say.
type Refused = (&'static str, &'static str, Vec<u8>, &'static [&'static str], &'static [&'static str]);

fn refused_parts() -> Vec<Refused> {
    let cube = || cuboid([0.0; 3], [20.0, 20.0, 10.0]);
    let with = |change: fn(&mut Triangles)| {
        let mut part = cube();
        change(&mut part);
        stl(&part)
    };
    let mut short = stl(&cube());
    short.truncate(434);
    let mut picture = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
    picture.resize(700, 7);
    vec![
        ("an empty file", "empty.stl", Vec::new(), &[], &["empty.stl", "empty"]),
        ("a part that ends early", "short.stl", short, &[], &["short.stl", "12 facets", "7", "434"]),
        (
            "a place that is no number",
            "nan.stl",
            with(|part| part[3][1][0] = f64::NAN),
            &[],
            &["nan.stl", "facet"],
        ),
        (
            "an infinite place",
            "inf.stl",
            with(|part| part[3][1][0] = f64::INFINITY),
            &[],
            &["inf.stl", "facet"],
        ),
        ("a picture", "picture.stl", picture, &[], &["picture.stl", "png"]),
        (
            "facets without area only",
            "needles.stl",
            with(|part| part.iter_mut().for_each(|one| one[2] = one[1])),
            &[],
            &["needles.stl", "area"],
        ),
        (
            "a place beyond a kilometre",
            "huge.stl",
            with(|part| part[3][1][0] = 1e9),
            &[],
            &["huge.stl", "facet"],
        ),
        (
            "a part larger than the bed",
            "wide.stl",
            stl(&cuboid([0.0; 3], [500.0, 20.0, 10.0])),
            &[],
            &["carve", "500", "200"],
        ),
        (
            "a part higher than the printer",
            "tall.stl",
            stl(&cuboid([0.0; 3], [20.0, 20.0, 900.0])),
            &[],
            &["carve", "900", "200"],
        ),
        (
            "a flat part",
            "flat.stl",
            stl(&cuboid([0.0; 3], [20.0, 20.0, 0.1])),
            &[],
            &["carve", "0.1", "flat"],
        ),
        ("a text without facets", "none.stl", b"solid none\nendsolid none\n".to_vec(), &[], &["none.stl"]),
        (
            "a text that is no part",
            "prose.stl",
            b"Dear potter, this is no part.\n".to_vec(),
            &[],
            &["prose.stl"],
        ),
        (
            "a part in words that ends early",
            "half.stl",
            text_stl(&cube()).into_bytes()[..400].to_vec(),
            &[],
            &["half.stl"],
        ),
        (
            "an unknown profile",
            "part.stl",
            stl(&cube()),
            &["--profile", "porcelain"],
            &["porcelain", "profile list"],
        ),
        (
            "an unknown key",
            "part.stl",
            stl(&cube()),
            &["--set", "fill.wals=2"],
            &["fill.wals", "did you mean `fill.walls`?"],
        ),
        (
            "a value out of bounds",
            "part.stl",
            stl(&cube()),
            &["--set", "fill.density=3"],
            &["fill.density", "above 1"],
        ),
        (
            "a value of another type",
            "part.stl",
            stl(&cube()),
            &["--set", "fill.walls=many"],
            &["fill.walls", "number"],
        ),
        ("a folder that is not there", "part.stl", stl(&cube()), &["-o", "nowhere/part.gcode"], &["nowhere"]),
        (
            "an unknown stage to stop at",
            "part.stl",
            stl(&cube()),
            &["--until", "glaze"],
            &["glaze", "clayforge stages"],
        ),
        (
            "heat at the start",
            "part.stl",
            stl(&cube()),
            &["--set", "alteration.start=M104 S200"],
            &["M104", "heat"],
        ),
    ]
}

#[test]
fn a_refused_part_gives_one_and_a_message_and_leaves_no_file() {
    let mut failures = Vec::new();
    for (what, name, bytes, words, says) in refused_parts() {
        let room = Room::new();
        room.put(name, bytes);
        let before = room.listing();
        let ran = room.run(&[&["slice", name], words].concat());
        let checked = std::panic::catch_unwind(|| {
            assert_eq!(ran.code, Some(1), "{}", ran.err);
            assert_message(&ran.err, says);
            assert!(ran.out.is_empty(), "something on standard output");
            assert_eq!(room.listing(), before, "the folder has changed");
        });
        if let Err(why) = checked {
            let why = why.downcast_ref::<String>().cloned().unwrap_or_default();
            failures.push(format!("{what}: {why}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Promise 4: a message names the file, so that a batch of parts can be searched for it.
#[test]
fn a_refusal_names_the_part_whoever_refuses() {
    for (what, name, bytes, words, _) in
        refused_parts().into_iter().filter(|(_, _, _, words, _)| words.is_empty())
    {
        let room = Room::new();
        room.put(name, bytes);
        let ran = room.run(&[&["slice", name], words].concat());
        assert!(ran.err.starts_with(&format!("error: {name}: ")), "{what}: {}", ran.err);
    }
}

#[test]
fn a_part_that_is_not_there_is_said() {
    let room = Room::new();
    let ran = room.run(&["slice", "missing.stl"]);
    assert_eq!(ran.code, Some(1));
    assert_message(&ran.err, &["missing.stl", "no such file"]);
    assert!(room.listing().is_empty());
}

#[test]
fn a_mistake_in_a_profile_has_its_line_and_column() {
    for (text, says) in [
        ("[fill]\nwals = 3\n", ["mine.toml:2:1", "did you mean `fill.walls`?"]),
        ("[fill]\nwalls = \"two\"\n", ["mine.toml:2:9", "number"]),
        ("[fill]\nwalls = -1\n", ["mine.toml:2:9", "below 0"]),
        ("[carve]\nlayer_height = nan\n", ["mine.toml:2:16", "carve.layer_height"]),
        ("inherits = \"porcelain\"\n", ["mine.toml:1:12", "porcelain"]),
        (
            "sequence = [\"carve\", \"preface\", \"fill\", \"inset\", \"export\"]\n",
            ["mine.toml:1:12", "inset must come first"],
        ),
    ] {
        let room = Room::new();
        room.put("mine.toml", text).put("part.stl", stl(&cuboid([0.0; 3], [20.0, 20.0, 10.0])));
        let before = room.listing();
        for words in
            [&["slice", "part.stl", "--profile", "mine.toml"][..], &["profile", "check", "mine.toml"]]
        {
            let ran = room.run(words);
            assert_eq!(ran.code, Some(1), "{text}: {}", ran.err);
            assert_message(&ran.err, &says);
        }
        assert_eq!(room.listing(), before, "{text}");
    }
}

#[test]
fn a_profile_that_is_no_toml_has_its_place_and_a_hint() {
    for (text, place) in [
        ("[fill\nwalls = 1\n", "mine.toml:1:"),
        ("[fill]\nwalls =\n", "mine.toml:2:"),
        ("a = 1\na = 2\n", "mine.toml:2:"),
    ] {
        let room = Room::new();
        room.put("mine.toml", text);
        let ran = room.run(&["profile", "check", "mine.toml"]);
        assert_eq!(ran.code, Some(1), "{text}");
        assert_message(&ran.err, &[place]);
    }
}

#[test]
fn wrong_usage_gives_two() {
    let room = Room::new();
    for words in [
        &[][..],
        &["slice"],
        &["slice", "part.stl", "--layers", "3"],
        &["slice", "part.stl", "--set", "fill.walls"],
        &["slice", "part.stl", "--threads", "many"],
        &["bake"],
        &["craft"],
        &["profile"],
        &["explain"],
        &["check"],
    ] {
        let ran = room.run(words);
        assert_eq!(ran.code, Some(2), "{words:?}: {}", ran.err);
        assert!(ran.out.is_empty() && !ran.err.is_empty(), "{words:?}");
    }
    assert!(room.listing().is_empty());
}

#[test]
fn help_is_no_mistake() {
    let room = Room::new();
    for words in [&["--help"][..], &["--version"], &["slice", "--help"], &["help", "craft"]] {
        let ran = room.run(words).done();
        assert!(ran.err.is_empty() && !ran.out.is_empty(), "{words:?}");
    }
}

// What slice writes.

#[test]
fn slice_writes_the_file_of_the_library_beside_the_part() {
    let room = Room::new();
    room.put("pair.stl", example("pair"));
    let ran = room.run(&["slice", "pair.stl"]).done();
    assert!(ran.out.is_empty(), "results go to the file");
    assert!(ran.err.contains("layers") && ran.err.contains("pair.gcode"), "no summary: {}", ran.err);
    assert_eq!(room.listing().keys().collect::<Vec<_>>(), ["pair.gcode", "pair.stl"]);
    let expected = sliced("pair", &example("pair"), &clay(&[]));
    assert!(room.listing()["pair.gcode"] == expected.gcode(), "the command and the library differ");
    let checked = room.run(&["check", "pair.gcode"]).done();
    assert!(checked.out().ends_with("ok\n"), "{}", checked.out());
    let json: Json =
        serde_json::from_slice(&room.run(&["check", "pair.gcode", "--json"]).done().out).expect("JSON");
    for key in ["letter", "machine", "notes", "ok"] {
        assert!(json.get(key).is_some(), "no {key}");
    }
    for key in [
        "first_part_comments_end",
        "last_part_comments_start",
        "max_height",
        "layers",
        "spirals",
        "horizontal_movement_without_extrusion",
        "vertical_movement_without_extrusion",
        "diagonal_movement_without_extrusion",
    ] {
        assert!(json["machine"].get(key).is_some() && json["letter"].get(key).is_some(), "no {key}");
    }
    assert_eq!(json["ok"], Json::Bool(true));
}

/// A start or an end that endangers the machine is found in the finished file, which then does not appear.
#[test]
fn slice_refuses_what_it_wrote_when_it_breaks_a_rule() {
    for (set, says) in [
        ("alteration.start=G28\nG1 Z-1 F600", "the nozzle goes to z -1"),
        ("alteration.end=M84\nG1 X50 Y50 E500 F600", "after the motors were switched off"),
        ("alteration.end=G91\nG1 Z40\nG90\nG1 X50 Y50 E500 F600", "mm above all that stands"),
    ] {
        let room = Room::new();
        room.put("cube.stl", example("cube"));
        let ran = room.run(&["slice", "cube.stl", "--set", set]);
        assert_eq!(ran.code, Some(1), "{set}: {}", ran.err);
        assert_message(&ran.err, &["check", "must not be printed", says]);
        assert_eq!(room.listing().keys().collect::<Vec<_>>(), ["cube.stl"], "{set}");
    }
}

#[test]
fn check_tells_what_must_not_be_printed_from_what_is_only_worth_knowing() {
    let room = Room::new();
    room.put(
        "mine.toml",
        "[machine]\nbed = [100, 100, 50]\n[carve]\nlayer_height = 1\nfirst_layer_height = 1\n",
    );
    let layer =
        |z: u32, x: u32| format!("G0 X{x} Y10 Z{z} F3000\nG1 X50 E1 F900\nG1 Y50 E1\nG1 X{x} Y10 E1\n");
    let sound = format!("M83\nM302 P1\nG28\n{}{}", layer(1, 10), layer(2, 10));
    let outside = format!("M104 S200\n{sound}{}", layer(3, 110));
    for (name, text, ok, rules) in [
        ("sound.gcode", &sound, true, vec!["interrupted"]),
        ("outside.gcode", &outside, false, vec!["outside_bed", "heats", "travel_outside", "interrupted"]),
    ] {
        room.put(name, text);
        let ran = room.run(&["check", name, "--profile", "mine.toml", "--json"]);
        assert_eq!(ran.code, Some(i32::from(!ok)), "{name}: {}", ran.err);
        let json: Json = serde_json::from_slice(&ran.out).expect("JSON");
        assert_eq!(json["ok"], Json::Bool(ok), "{name}");
        let found: Vec<&str> = json["verdicts"]
            .as_array()
            .expect("a list")
            .iter()
            .filter_map(|verdict| verdict["rule"].as_str())
            .collect();
        assert_eq!(found, rules, "{name}");
        let text = room.run(&["check", name, "--profile", "mine.toml"]);
        assert_eq!(text.code, ran.code, "{name}");
        assert_eq!(text.out().contains("fault: "), !ok, "{}", text.out());
        assert!(text.out().ends_with(if ok { "\nok\n" } else { "not ok\n" }), "{}", text.out());
    }
    // Without a profile nobody knows the bed, and a heater is only doubtful.
    assert!(room.run(&["check", "outside.gcode"]).done().out().contains("warning: line 1: a heater is set"));
}

#[test]
fn a_dash_is_standard_output_and_quiet_is_quiet() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    let ran = room.run(&["slice", "cube.stl", "-o", "-", "--quiet"]).done();
    assert!(ran.err.is_empty(), "{}", ran.err);
    assert!(ran.out == sliced("cube", &example("cube"), &clay(&[])).gcode(), "the file is another");
    assert_eq!(room.listing().len(), 1, "nothing is written beside it");
}

#[test]
fn the_number_of_threads_and_the_language_make_no_difference() {
    let room = Room::new();
    room.put("pair.stl", example("pair"));
    let expected = room.run(&["slice", "pair.stl", "-o", "-"]).done().out;
    for (threads, language) in [("1", "C"), ("2", "de_DE.UTF-8"), ("3", "tr_TR.UTF-8")] {
        let mut command = room.command(&["slice", "pair.stl", "-o", "-", "--threads", threads]);
        let output =
            command.env("LC_ALL", language).env("TZ", "Asia/Kathmandu").output().expect("the command runs");
        assert!(output.stdout == expected, "{threads} threads, {language}");
    }
}

/// The parts and the profiles on which a pipe is compared with `slice`: name, bytes, words of the command.
fn piped() -> Vec<(&'static str, Vec<u8>, Vec<String>)> {
    let fine =
        || FINE.iter().flat_map(|(key, value)| ["--set".to_owned(), format!("{key}={value}")]).collect();
    vec![
        ("cube.stl", example("cube"), Vec::new()),
        ("pair.stl", example("pair"), Vec::new()),
        ("vase.stl", example("vase"), Vec::new()),
        // A speed of more decimals than the header has.
        ("slow.stl", example("cube"), vec!["--set".to_owned(), "speed.feed=33.3333".to_owned()]),
        ("block.stl", stl(&cuboid([0.0; 3], [20.0, 14.0, 2.0])), fine()),
        ("tube.stl", stl(&tube(10.0, 6.0, 1.0)), fine()),
        ("words.stl", text_stl(&tube(8.0, 5.0, 1.0)).into_bytes(), fine()),
        // All stages at once: the finished file is checked, too.
        ("all.stl", example("cube"), everything()),
    ]
}

/// The stages of the chain with the numbers that a dump gives them: carve is 1.
fn numbered(profile: &Profile) -> Vec<(usize, &Station)> {
    let chain = profile.chain().expect("a chain");
    let before = chain.iter().take_while(|station| station.work.forms().1 == Form::Mesh).count();
    chain
        .into_iter()
        .enumerate()
        .map(|(index, station)| ((index + 1).saturating_sub(before), station))
        .collect()
}

/// `--set STAGE.active=true` for every stage there is, but for the spiral, which no copies can be made of.
fn everything() -> Vec<String> {
    let mut words = vec!["--set".to_owned(), "machine.bed=[600, 600, 400]".to_owned()];
    for name in STAGES.iter().map(|entry| entry.name).filter(|name| *name != "coil") {
        words.extend(["--set".to_owned(), format!("{name}.active=true")]);
    }
    words
}

#[test]
fn a_5_stage_after_stage_in_a_pipe_gives_the_bytes_of_slice() {
    for (name, part, settings) in piped() {
        let room = Room::new();
        room.put(name, &part);
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let whole = room
            .run(&[&["slice", name, "-o", "-", "--quiet", "--dump", "steps"], &*settings].concat())
            .done()
            .out;
        let mut text = part;
        for (number, entry) in numbered(&Profile::default()) {
            let stage = entry.entry.name;
            text = room.feed(&[&["craft", stage], &*settings].concat(), &text).done().out;
            let form = entry.work.forms().1;
            let dumped = room.path("steps").join(format!("{number:02}-{stage}.{}", form.extension()));
            // The part as it came is not written again.
            if form == Form::Mesh && !dumped.exists() {
                continue;
            }
            assert!(
                fs::read(&dumped).ok().as_deref() == Some(&*text),
                "{name}: {stage} differs from {}",
                dumped.display()
            );
        }
        assert!(text == whole, "{name}: the pipe and slice differ");
    }
}

/// stages_tests.md A-5: one `clayforge craft` for each stage, each reading what the one before writes while it writes it.
#[test]
fn a_5_the_chain_as_one_pipe_gives_the_bytes_of_slice() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    for settings in [Vec::new(), everything()] {
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let whole = room.run(&[&["slice", "cube.stl", "-o", "-", "--quiet"], &*settings].concat()).done().out;
        let mut last: Option<ChildStdout> = None;
        let mut running = Vec::new();
        for (_, station) in numbered(&Profile::default()) {
            let input = match last.take() {
                Some(before) => Stdio::from(before),
                None => Stdio::from(fs::File::open(room.path("cube.stl")).expect("the part")),
            };
            let mut command = room.command(&[&["craft", station.entry.name], &*settings].concat());
            let mut child = command
                .stdin(input)
                .stdout(Stdio::piped())
                .stderr(Stdio::null())
                .spawn()
                .expect("the command runs");
            last = child.stdout.take();
            running.push((station.entry.name, child));
        }
        let mut text = Vec::new();
        last.expect("a chain has stages").read_to_end(&mut text).expect("the pipe is read");
        for (stage, mut child) in running {
            assert!(child.wait().expect("the command ends").success(), "{stage}");
        }
        assert!(text == whole, "the pipe and slice differ");
    }
}

/// stages_tests.md SC2.
#[test]
fn sc2_a_part_is_scaled_once() {
    let room = Room::new();
    let scale = ["craft", "scale", "--set", "scale.active=true"];
    let once = room.feed(&scale, &example("cube")).done().out;
    assert_ne!(once, example("cube"));
    assert!(room.feed(&scale, &once).done().out == once);
}

#[test]
fn a_dump_has_the_text_and_the_drawing_of_every_stage() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    room.run(&["slice", "cube.stl", "--dump", "steps", "--set", "fill.active=false"]).done();
    let mut expected = Vec::new();
    for (number, station) in numbered(&Profile::default()) {
        if station.work.forms().1 == Form::Mesh {
            continue;
        }
        let name = format!("{number:02}-{}", station.entry.name);
        expected.push(format!("{name}.{}", station.work.forms().1.extension()));
        expected.push(format!("{name}.layers.svg"));
    }
    expected.sort();
    let entries = fs::read_dir(room.path("steps")).expect("the folder is made").flatten();
    let mut found: Vec<String> = entries.map(|entry| name_of(&entry.path())).collect();
    found.sort();
    assert_eq!(found, expected);
    for name in found {
        let text = text_of(&room.path("steps").join(&name));
        assert!(!text.is_empty(), "{name} is empty");
        assert!(!name.ends_with(".svg") || text.trim_end().ends_with("</svg>"), "{name} is no drawing");
    }
}

#[test]
fn until_stops_behind_a_stage() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    room.run(&["slice", "cube.stl", "--until", "carve", "--quiet"]).done();
    room.run(&["slice", "cube.stl", "--until", "fill", "--quiet"]).done();
    let expected = sliced("cube", &example("cube"), &clay(&[]));
    let listing = room.listing();
    assert!(listing["cube.carve.svg"] == expected.behind("carve"));
    assert!(listing["cube.fill.gcode"] == expected.behind("fill"));
}

#[test]
fn the_report_has_the_keys_that_scripts_read() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    room.run(&["slice", "cube.stl", "--report", "cube.json", "--set", "carve.bead_width=1"]).done();
    let report: Json = serde_json::from_str(&text_of(&room.path("cube.json"))).expect("JSON");
    for key in ["layers", "threads", "travels"] {
        assert!(report[key].as_u64().is_some_and(|count| count > 0), "{key}: {}", report[key]);
    }
    assert_eq!(report["spirals"], 0);
    for key in ["extruded_mm", "travel_mm", "volume_mm3", "mass_g", "time_s"] {
        assert!(report[key].as_f64().is_some_and(|number| number > 0.0), "{key}: {}", report[key]);
    }
    let stages = report["stages"].as_array().expect("a list");
    let names: Vec<&str> = stages.iter().filter_map(|stage| stage["name"].as_str()).collect();
    for station in Profile::default().chain().expect("a chain") {
        assert!(names.contains(&station.entry.name), "no {} in {names:?}", station.entry.name);
    }
    assert!(stages.iter().all(|stage| stage["ms"].as_f64().is_some_and(|time| time >= 0.0)));
    let warnings = report["warnings"].as_array().expect("a list");
    assert!(!warnings.is_empty(), "a bead of 1 mm from a nozzle of 3 mm is worth a word");
    for warning in warnings {
        assert!(
            warning["stage"].is_string() && warning["text"].is_string() && warning.get("layer").is_some()
        );
    }
    // The profile is about no layer.
    assert!(warnings.iter().any(|warning| warning["stage"] == "profile" && warning["layer"].is_null()));
}

// Files.

#[test]
fn an_older_file_stays_when_a_slice_fails() {
    let room = Room::new();
    let mut broken = stl(&cuboid([0.0; 3], [20.0, 20.0, 10.0]));
    broken.truncate(500);
    room.put("part.stl", broken).put("part.gcode", "G28 ; yesterday's\n");
    let before = room.listing();
    assert_eq!(room.run(&["slice", "part.stl"]).code, Some(1));
    assert_eq!(room.listing(), before);
    room.put("part.stl", example("cube"));
    let before = room.listing();
    // It fails in the last stage, when the file is begun already.
    assert_eq!(room.run(&["slice", "part.stl", "--set", "alteration.end=M109 S200"]).code, Some(1));
    assert_eq!(room.listing(), before);
    room.run(&["slice", "part.stl"]).done();
    assert_ne!(room.listing(), before);
}

#[test]
fn the_part_is_never_written_over() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    let before = room.listing();
    let ran = room.run(&["slice", "cube.stl", "-o", "cube.stl"]);
    assert_eq!(ran.code, Some(1));
    assert_message(&ran.err, &["cube.stl", "the part"]);
    assert_eq!(room.listing(), before);
}

/// A link means the file that it leads to, and a device cannot be replaced.
#[cfg(unix)]
#[test]
fn a_link_is_written_through_and_a_device_straight() {
    let room = Room::new();
    room.put("cube.stl", example("cube")).put("target.gcode", "yesterday's\n");
    std::os::unix::fs::symlink("target.gcode", room.path("link.gcode")).expect("a link");
    room.run(&["slice", "cube.stl", "-o", "link.gcode"]).done();
    assert!(fs::symlink_metadata(room.path("link.gcode")).expect("it is there").is_symlink());
    assert!(text_of(&room.path("target.gcode")).contains("G1 "));
    room.run(&["slice", "cube.stl", "-o", "/dev/null"]).done();
    assert_eq!(room.listing().len(), 3);
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let room = Room::new();
    room.put("vase.stl", example("vase"));
    for words in
        [&["slice", "vase.stl", "-o", "-", "--quiet"][..], &["profile", "schema"], &["explain", "export"]]
    {
        let mut child = room
            .command(words)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command runs");
        let mut out = child.stdout.take().expect("piped");
        let mut first = [0; 1];
        out.read_exact(&mut first).expect("it says something");
        drop(out);
        let ran: Ran = child.wait_with_output().expect("it ends").into();
        assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""), "{words:?}");
    }
}

/// Promise 9: a disk that is full is an error, and the target is as it was.
#[cfg(unix)]
#[test]
fn a_full_disk_is_an_error_and_nothing_is_left() {
    let room = Room::new();
    room.put("vase.stl", example("vase")).put("vase.gcode", "yesterday's\n");
    let before = room.listing();
    let program = program().display();
    let output = Command::new("sh")
        .args(["-c", &format!("ulimit -f 8 && exec '{program}' slice vase.stl")])
        .current_dir(room.0.path())
        .output()
        .expect("sh runs");
    let ran: Ran = output.into();
    assert_eq!(ran.code, Some(1), "{}", ran.err);
    assert_message(&ran.err, &["vase.gcode", "no room"]);
    assert_eq!(room.listing(), before);
}

/// Promise 10: Ctrl-C leaves nothing.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing() {
    let room = Room::new();
    room.put("vase.stl", example("vase"));
    let before = room.listing();
    let fine = [
        "--set",
        "carve.layer_height=0.05",
        "--set",
        "carve.first_layer_height=0.05",
        "--set",
        "fill.density=1",
    ];
    let words: Vec<&str> =
        ["slice", "vase.stl", "--set", "carve.bead_width=0.3"].into_iter().chain(fine).collect();
    let mut child =
        room.command(&words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it runs");
    let begun = std::time::Instant::now();
    // Its unfinished file shows that it is at work.
    while room.listing().len() == before.len() && begun.elapsed().as_secs() < 20 {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert!(
        child.try_wait().expect("it can be asked").is_none(),
        "it was done before it could be interrupted"
    );
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(kill.success());
    let status = child.wait().expect("it ends");
    assert!(!status.success(), "{status}");
    assert_eq!(room.listing().keys().collect::<Vec<_>>(), before.keys().collect::<Vec<_>>());
}

// What the command says of itself.

#[test]
fn the_list_of_stages_is_the_table() {
    let room = Room::new();
    let list: Json = serde_json::from_slice(&room.run(&["stages", "--json"]).done().out).expect("JSON");
    let list = list.as_array().expect("a list");
    let names: Vec<&str> = list.iter().filter_map(|stage| stage["name"].as_str()).collect();
    assert_eq!(names, STAGES.iter().map(|entry| entry.name).collect::<Vec<_>>());
    assert!(list.iter().all(|stage| stage["about"].as_str().is_some_and(|about| about.len() > 10)));
    let text = room.run(&["stages"]).done().out();
    assert!(names.iter().all(|name| text.lines().any(|line| line.starts_with(name))), "{text}");
}

#[test]
fn a_setting_is_explained_with_its_default_and_bounds() {
    let room = Room::new();
    let text = room.run(&["explain", "fill.walls"]).done().out();
    assert!(
        text.contains("fill.walls") && text.contains("default 2") && text.contains("0 to 1000"),
        "{text}"
    );
    for entry in STAGES {
        let page = room.run(&["explain", entry.name]).done().out();
        assert!(
            page.contains(&format!("# {}", entry.name)) && page.contains("All settings"),
            "{}",
            entry.name
        );
    }
    let ran = room.run(&["explain", "fill.wals"]);
    assert_eq!(ran.code, Some(1));
    assert_message(&ran.err, &["fill.wals", "did you mean `fill.walls`?"]);
}

#[test]
fn a_profile_that_is_shown_reads_back() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    for name in ["clay", "generic-ram", "generic-auger"] {
        let shown = room.run(&["profile", "show", name]).done().out();
        room.put("shown.toml", &shown);
        room.run(&["profile", "check", "shown.toml"]).done();
        assert_eq!(room.run(&["profile", "show", "shown.toml"]).done().out(), shown, "{name}");
        let expected = room.run(&["slice", "cube.stl", "-o", "-", "--quiet", "--profile", name]).done().out;
        let found =
            room.run(&["slice", "cube.stl", "-o", "-", "--quiet", "--profile", "shown.toml"]).done().out;
        assert!(found == expected, "{name} shown and read prints differently");
    }
    let list = room.run(&["profile", "list"]).done().out();
    assert!(list.contains("clay") && list.contains("generic-ram"), "{list}");
    room.put("new.toml", room.run(&["profile", "new"]).done().out);
    room.run(&["profile", "check", "new.toml"]).done();
    let schema: Json = serde_json::from_slice(&room.run(&["profile", "schema"]).done().out).expect("JSON");
    assert!(schema["properties"]["fill"]["properties"]["walls"].is_object(), "{schema:#}");
}

/// A file here comes before one of the config folder, and that before a built-in one; `.toml` may stand or not.
#[test]
fn a_profile_is_looked_for_here_then_in_the_config_folder_then_in_the_program() {
    let room = Room::new();
    let density = |name: &str| {
        let shown = room.run(&["profile", "show", name]).done().out();
        let (_, fill) = shown.split_once("[fill]").expect("a section");
        fill.lines().find(|line| line.starts_with("density")).unwrap_or("").to_owned()
    };
    assert_eq!(["clay", "clay.toml"].map(density), ["density = 0.2"; 2]);
    room.put("cube.stl", example("cube"));
    let slice = |name| room.run(&["slice", "cube.stl", "-o", "-", "--quiet", "--profile", name]).done().out;
    let built_in = slice("clay");
    assert!(slice("clay.toml") == built_in);
    let own = "inherits = \"clay\"\nfill.density = ";
    fs::create_dir_all(room.path("config/clayforge")).expect("a new folder");
    room.put("config/clayforge/clay.toml", format!("{own}0.5\n"));
    assert_eq!(["clay", "clay.toml"].map(density), ["density = 0.5"; 2]);
    assert!(slice("clay.toml") == slice("clay") && slice("clay.toml") != built_in);
    room.put("clay.toml", format!("{own}0.75\n"));
    assert_eq!(["clay", "clay.toml"].map(density), ["density = 0.75"; 2]);
    let ran = room.run(&["slice", "cube.stl", "--profile", "nowhere/clay.toml"]);
    assert_message(&ran.err, &["nowhere/clay.toml", "profile list"]);
}

/// Nothing is said twice at the start. A line with E at the end holds for absolute E, too: it counts anew.
#[test]
fn the_profiles_of_the_program_say_every_command_of_the_start_once_and_never_go_down() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    for name in ["clay", "generic-ram", "generic-auger"] {
        let text = room.run(&["slice", "cube.stl", "-o", "-", "--quiet", "--profile", name]).done().out();
        let commands: Vec<&str> = text.lines().filter(|line| !line.starts_with(';')).collect();
        let start: Vec<&str> = commands.iter().copied().take_while(|line| !line.starts_with("G1")).collect();
        assert_eq!(start, ["G90", "G21", "M302 P1", "G28", "M83", "G92 E0"], "{name}");
        let end =
            commands.iter().rposition(|line| line.contains(" X") || line.contains(" Y")).expect("moves");
        let relief: &[&str] = match name {
            "generic-ram" => &["G92 E0", "G1 E-0.2 F6"],
            "generic-auger" => &["G92 E0", "G1 E-5 F300"],
            _ => &[],
        };
        assert_eq!(commands[end + 1..], [relief, &["G91", "G1 Z10 F600", "G90", "M84"]].concat(), "{name}");
    }
}

#[test]
fn a_stage_refuses_a_text_of_another_kind() {
    let room = Room::new();
    for (stage, input) in
        [("fill", &b"no skein\n"[..]), ("preface", b"<svg/>"), ("carve", b""), ("export", b"G1 X1\n")]
    {
        let ran = room.feed(&["craft", stage], input);
        assert_eq!(ran.code, Some(1), "{stage}: {}", ran.err);
        assert!(ran.err.starts_with("error: ") && ran.out.is_empty(), "{stage}: {}", ran.err);
    }
    let ran = room.run(&["craft", "glaze"]);
    assert_eq!(ran.code, Some(1));
    assert_message(&ran.err, &["glaze", "clayforge stages"]);
}

// The README.

/// The commands of the README, each in a line of a `sh` fence.
fn readme_commands() -> Vec<String> {
    let text = text_of(&root().join("README.md"));
    let mut commands = Vec::new();
    let mut inside = false;
    let mut joined = String::new();
    for line in text.lines() {
        if line.starts_with("```") {
            inside = !inside && line.trim() == "```sh";
        } else if inside {
            let line = line.split(" #").next().unwrap_or("").trim();
            joined.push_str(line.trim_end_matches('\\'));
            if !line.ends_with('\\') {
                commands.push(std::mem::take(&mut joined));
            }
        }
    }
    commands
}

/// The README's commands work in a copy of what a reader has: the examples and the profiles.
#[cfg(unix)]
#[test]
fn the_commands_of_the_readme_work() {
    assert!(root().join("README.md").exists(), "there is no README.md yet");
    let room = Room::new();
    for folder in ["examples", "profiles"] {
        fs::create_dir(room.path(folder)).expect("a new folder");
        for entry in fs::read_dir(root().join(folder)).expect("the folder is there").flatten() {
            fs::copy(entry.path(), room.path(folder).join(entry.file_name())).expect("a copy");
        }
    }
    let bin = room.path("bin");
    fs::create_dir(&bin).expect("a new folder");
    std::os::unix::fs::symlink(program(), bin.join("clayforge")).expect("a link");
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap_or_default());
    let mut count = 0;
    for command in readme_commands() {
        // What cargo would build is built already.
        let cargo =
            ["cargo run --release --", "cargo run --"].iter().find_map(|start| command.strip_prefix(start));
        let command = match cargo {
            Some(words) => format!("clayforge{words}"),
            None if command.starts_with("clayforge ") => command,
            None => continue,
        };
        count += 1;
        let output = Command::new("sh")
            .args(["-c", &command])
            .current_dir(room.0.path())
            .env("PATH", &path)
            .env("XDG_CONFIG_HOME", room.path("config"))
            .output()
            .expect("sh runs");
        assert!(output.status.success(), "{command}\n{}", String::from_utf8_lossy(&output.stderr));
    }
    assert!(count > 0, "README.md has no command to try");
}
