//! Every kind of command, every row of what is odd or bad in a program (`emulation.md` §6), and the modes.

use super::*;
use crate::command::{By, Centre, CommandKind, Span};
use crate::given::Given;

/// A command in short: its kind, and what of it matters.
fn short(command: &Command<'_>) -> String {
    let mut text = command.kind().name().to_owned();
    let mut add = |letter: &str, value: Given| {
        if let Some(value) = value.get() {
            text += &format!(" {letter}{value}");
        }
    };
    match *command {
        Command::Move { to, feed, rapid, .. } | Command::MachineCoordinates { to, feed, rapid, .. } => {
            add("X", to.x);
            add("Y", to.y);
            add("Z", to.z);
            add("F", feed);
            text += if rapid { " rapid" } else { "" };
        }
        Command::MoveExtrude { to, feed, deposit, by, .. } => {
            add("X", to.x);
            add("Y", to.y);
            add("Z", to.z);
            add("F", feed);
            text += &format!(" {deposit} {by:?}");
        }
        Command::MoveMill { to, feed, speed, spin, .. } => {
            add("X", to.x);
            add("Y", to.y);
            add("Z", to.z);
            add("F", feed);
            text += &format!(" {speed} {spin:?}");
        }
        Command::Arc { to, feed, around, turn }
        | Command::ArcExtrude { to, feed, around, turn, .. }
        | Command::ArcMill { to, feed, around, turn, .. } => {
            add("X", to.x);
            add("Y", to.y);
            add("Z", to.z);
            add("F", feed);
            let way = if turn.clockwise { "cw" } else { "ccw" };
            text += &format!(" {way} {around:?} {:?} {:?} +{}", turn.plane, turn.centre, turn.more);
        }
        Command::Extrude { deposit, by, feed, tool } => {
            add("F", feed);
            text += &format!(" {deposit} {by:?} T{tool}");
        }
        Command::Mill { speed, spin } => {
            add("S", speed);
            text += &format!(" {spin:?}");
        }
        Command::Dwell { time, by } => text += &format!(" {time} {by:?}"),
        Command::Purge { time, deposit, by } => text += &format!(" {time} {deposit} {by:?}"),
        Command::FeedRate { feed } => text += &format!(" {feed}"),
        Command::Config { text: words } | Command::Comment { text: words } => {
            text += &format!(" {}", String::from_utf8_lossy(words));
        }
        Command::G { tenths, words } | Command::M { tenths, words } => {
            text += &format!(" {tenths} {}", String::from_utf8_lossy(words.text));
        }
        Command::WorkCoordinates { system } => text += &format!(" {system}"),
        Command::AbsolutePosition | Command::IncrementalPosition => {}
    }
    text.trim_end().to_owned()
}

fn said(flavor: &str, text: &[u8]) -> (Vec<String>, Vec<Diagnostic>) {
    let flavor = Flavor::named(flavor).expect("built in");
    let mut parser = Parser::new(flavor);
    let mut commands = Vec::new();
    parser.read(text, |step| commands.push(short(&step.command)));
    let diagnostics = parser.into_diagnostics();
    assert_eq!(diagnostics.count(), diagnostics.list().len() as u64);
    (commands, diagnostics.list().to_vec())
}

/// What a text says, with nothing wrong in it.
#[track_caller]
fn says(flavor: &str, text: &str, commands: &[&str]) {
    let (found, diagnostics) = said(flavor, text.as_bytes());
    assert_eq!(found, commands, "{flavor}: {text}");
    assert_eq!(diagnostics, [], "{flavor}: {text}");
}

/// What a text says, and the one thing that is wrong with it, at a column of line 1.
#[track_caller]
fn doubts(flavor: &str, text: &str, commands: &[&str], column: u32, kind: Problem) {
    let (found, diagnostics) = said(flavor, text.as_bytes());
    assert_eq!(found, commands, "{flavor}: {text}");
    assert_eq!(diagnostics, [Diagnostic { line: 1, column, kind }], "{flavor}: {text}");
    let flavor = Flavor::named(flavor).expect("built in");
    let strict = Parser::new(flavor).read_strict(text.as_bytes(), |_| ());
    assert_eq!(strict, Err(diagnostics[0].clone()), "strict makes it an error");
}

#[test]
fn each_of_the_19_kinds_is_made_in_the_dialects_that_have_it() {
    use CommandKind as K;
    let cases: &[(CommandKind, &str, &str)] = &[
        (K::Move, "marlin", "G1 X10 Y20 F1800"),
        (K::Move, "klipper", "G0 X10"),
        (K::Move, "cincinnati", "G0 X1 Y1"),
        (K::Arc, "marlin", "G2 X10 I5"),
        (K::Arc, "siemens", "G2 X10 CR=5"),
        (K::Extrude, "marlin", "G1 E-2 F1800"),
        (K::Extrude, "cincinnati", "M3 S100"),
        (K::Extrude, "siemens", "BEAD_AREA=12.5"),
        (K::MoveExtrude, "klipper", "G1 X1 E2"),
        (K::MoveExtrude, "cincinnati", "M3 S100\nG1 X5"),
        (K::MoveExtrude, "cincinnati", "G1 X5 S100"),
        (K::MoveExtrude, "siemens", "G1 X5 BEAD_AREA=12"),
        (K::ArcExtrude, "reprapfirmware", "G3 X1 I1 E2"),
        (K::Mill, "grbl", "M3 S600"),
        (K::Mill, "rs274", "M5"),
        (K::MoveMill, "grbl", "M3 S600\nG1 X5 F100"),
        (K::ArcMill, "rs274", "M4 S600\nG2 X5 I1 F100"),
        (K::Dwell, "klipper", "G4 P500"),
        (K::Purge, "cincinnati", "M69 F300 P20"),
        (K::Purge, "cincinnati", "M3 S60\nG4 P2"),
        (K::FeedRate, "marlin", "G1 F1800"),
        (K::FeedRate, "grbl", "F100"),
        (K::Config, "klipper", "SET_VELOCITY_LIMIT ACCEL=500"),
        (K::Config, "marlin", "T1"),
        (K::G, "marlin", "G92 X0"),
        (K::M, "marlin", "M104 S200"),
        (K::AbsolutePosition, "rs274", "G90"),
        (K::IncrementalPosition, "grbl", "G91"),
        (K::WorkCoordinates, "grbl", "G54"),
        (K::MachineCoordinates, "grbl", "G53 G0 X5"),
        (K::MachineCoordinates, "siemens", "SUPA G0 X5"),
        (K::Comment, "marlin", "; a cup"),
        (K::Comment, "cincinnati", "(a cup)"),
    ];
    for kind in CommandKind::ALL {
        assert!(cases.iter().any(|case| case.0 == kind), "{}", kind.name());
    }
    for &(kind, flavor, text) in cases {
        let flavor = Flavor::named(flavor).expect("built in");
        let mut last = None;
        let mut parser = Parser::new(flavor);
        parser.read(text.as_bytes(), |step| last = Some(step.command.kind()));
        assert_eq!(last, Some(kind), "{}: {text}", flavor.name);
        assert!(parser.diagnostics().is_empty(), "{}: {text}", flavor.name);
    }
}

#[test]
fn spelling_does_not_matter() {
    for text in [
        "G1 X10 Y20",
        "G1X10Y20",
        "G1 X 10 Y 20",
        "g1 x10 y20",
        "G01 X+10 Y20.",
        "G1.0\tX10\tY20",
        "G 1 X10 Y020",
        "N7 G1 X10 Y20",
        "G1 X10 (move Y99) Y20",
        "G1 X10 Y20 ; Y99 F1",
        "/G1 X10 Y20",
        "\u{feff}G1 X10 Y20",
        "G1 X10 Y20\r\n",
        "G1 X10 Y20\r",
        "G1 X10 Y20\n\r",
        "N10 G1 X10 Y20*27",
        "  G1 X10 Y20  ",
    ] {
        says("marlin", text, &["Move X10 Y20"]);
    }
    says("marlin", "G1 X.5 Y-.5 Z-5.", &["Move X0.5 Y-0.5 Z-5"]);
    says("marlin", "G1 X0.1234567890123456789012345", &["Move X0.12345678901234568"]);
    says("marlin", "G1 X1e2 Y2.5", &["MoveExtrude X1 Y2.5 2 Amount"]);
    says("marlin", "G1 X1E2\nG1 X2", &["MoveExtrude X1 2 Amount", "Move X2"]);
    says("rs274", "G0X +0. 12 34Y 7", &["Move X0.1234 Y7 rapid"]);
    says("marlin", "G1 X1\rG1 X2\r", &["Move X1", "Move X2"]);
    says("reprapfirmware", "G1 X1 E1:2", &["MoveExtrude X1 3 Amount"]);
}

#[test]
fn what_is_odd_is_told_with_its_place_and_the_rest_is_read() {
    use Problem::*;
    let preprocess = || Preprocess(Cow::Borrowed("an expression that nobody has computed"));
    doubts("marlin", "G1 X1 12 Y7", &["Move X1 Y7"], 7, NoLetter);
    doubts("marlin", "N10 G1 X10 Y20*71", &["Move X10 Y20"], 15, WrongChecksum { given: 71, computed: 27 });
    doubts("marlin", "G1 X5 *", &["Move X5"], 7, NoChecksum);
    doubts("marlin", "G1 X10 (a (b) Y5", &["Move X10 Y5"], 11, NestedRemark);
    doubts("marlin", "G1 X10 (a Y99", &["Move X10"], 8, OpenRemark);
    doubts("marlin", "G1 Xnan Y5", &["Move Y5"], 4, NoNumber(b'X'));
    doubts("marlin", "G1 X. Y5", &["Move Y5"], 4, NoNumber(b'X'));
    doubts("marlin", "G1 X--5 Y5", &["Move Y5"], 4, NoNumber(b'X'));
    doubts("marlin", "G1 X1.2.3 Y5", &["Move Y5"], 4, NoNumber(b'X'));
    doubts("marlin", "G1 X1,5 Y5", &["Move Y5"], 4, Comma(b'X'));
    doubts("marlin", "G1 X99999999999999999999 Y5", &["Move Y5"], 4, OutOfRange(b'X'));
    doubts("marlin", "G1 X1 X2", &["Move X2"], 7, Repeated(b'X'));
    doubts("grbl", "G1 X1 X2", &["Config G1 X1 X2"], 7, Repeated(b'X'));
    doubts("marlin", "X2", &["Config X2"], 1, NoMotion);
    doubts("marlin", "G1 X1 \u{b0} Y2", &["Move X1 Y2"], 7, Unreadable);
    doubts("marlin", "G1 X1\0Y2", &["Move X1 Y2"], 6, NulByte);
    doubts("marlin", "G1 F0", &["G 10"], 4, NoFeed);
    doubts("marlin", "G1 X5 F-100", &["Move X5"], 7, NoFeed);
    doubts("marlin", "G1 X5 P3", &["Move X5"], 7, Unused(b'P'));
    doubts("grbl", "G1 X5 E3", &["Move X5"], 7, Unused(b'E'));
    doubts("marlin", "G1 X[1+2] Y5", &["Move Y5"], 5, preprocess());
    doubts("marlin", "G1 X#100 Y5", &["Move Y5"], 5, preprocess());
    doubts(
        "marlin",
        "#100=5",
        &["Config #100=5"],
        1,
        Preprocess(Cow::Borrowed("a line that nobody has computed")),
    );
    doubts("marlin", "G0 G1 X5", &["Move X5"], 1, Conflict { used: 10, dropped: 0 });
    doubts("marlin", "G92 X0 G1 Y5", &["Move X0 Y5"], 1, Conflict { used: 10, dropped: 920 });
    doubts("klipper", "G20", &["G 200"], 1, not_in_flavor("lengths in inches"));
    doubts(
        "klipper",
        "G2 X5 R3",
        &["Arc X5 cw [3.0, 0.0] Xy Radius +0"],
        7,
        not_in_flavor("an arc by its radius"),
    );
    doubts("klipper", "G4", &["Dwell 0 Seconds"], 1, NoDuration);
    doubts("marlin", "G2 X5", &["Move X5"], 1, NoCentre);
    doubts(
        "siemens",
        "G4 P2",
        &["Dwell 2 Seconds"],
        4,
        not_in_flavor("this word of a dwell; it is read as seconds"),
    );
}

#[test]
fn text_stays_text() {
    says("marlin", "M117 G1 X5 Printing", &["M 1170 G1 X5 Printing"]);
    says("marlin", "M117 hello ; Y5", &["M 1170 hello"]);
    says("reprapfirmware", "M587 S\"A;B\" P\"x\"", &["M 5870 S\"A;B\" P\"x\""]);
    says("klipper", "SET_VELOCITY_LIMIT ACCEL=500 ; G1", &["Config SET_VELOCITY_LIMIT ACCEL=500"]);
    says("marlin", "@pause now", &["Config @pause now"]);
    says("grbl", "$120=500", &["Config $120=500"]);
    says("marlin", "T0\nTx\nT?", &["Config T0", "Config Tx", "Config T?"]);
    says("siemens", "MSG(\"G1 X5; no\")", &["Config MSG(\"G1 X5; no\")"]);
}

#[test]
fn bytes_that_are_no_text_are_kept_in_remarks() {
    let (commands, diagnostics) = said("marlin", b"G1 X1 ; \xb5m \xff\n; \xff\n");
    assert_eq!(commands, ["Move X1", "Comment  \u{fffd}"]);
    assert_eq!(diagnostics, []);
}

#[test]
fn what_is_behind_the_tape_is_no_program() {
    says(
        "rs274",
        "%\nG1 X1 F1\n%\nG1 X2\nnonsense\n",
        &["Config %", "Move X1 F0.016666666666666666", "Config %"],
    );
}

#[test]
fn a_line_may_hold_several_commands_in_the_order_of_rs274() {
    says("marlin", "G90 G1 X5", &["AbsolutePosition", "Move X5"]);
    says("grbl", "G1 X5 M3 S600", &["Mill S10 Clockwise", "MoveMill X5 10 Clockwise"]);
    says(
        "rs274",
        "M2 G1 X1 G91 G20 T1 M6 F60",
        &["Config T1", "M 60", "G 200", "IncrementalPosition", "Move X25.4 F25.4", "M 20"],
    );
    says("grbl", "G21 F120", &["FeedRate 2", "G 210"]);
}

#[test]
fn a_motion_goes_on_where_the_dialect_says_so() {
    says("grbl", "G1 X1 F600\nX2\nY3", &["Move X1 F10", "Move X2", "Move Y3"]);
    says("grbl", "G0\nX2", &["G 0", "Move X2 rapid"]);
    let (_, diagnostics) = said("grbl", b"X2");
    assert_eq!(diagnostics[0].kind, Problem::NoMotion);
}

#[test]
fn units_are_of_the_line_and_those_after_it() {
    says("marlin", "G20\nG1 X1 F60\nG21\nG1 X1", &["G 200", "Move X25.4 F25.4", "G 210", "Move X1"]);
    says("cincinnati", "G0 X1\nG2 X1 I1", &["Move X25.4 rapid", "Arc X25.4 cw [25.4, 0.0] Xy Offset +0"]);
    says("siemens", "G70 G1 X1\nG71 G1 X1", &["G 700", "Move X25.4", "G 710", "Move X1"]);
    says("grbl", "G93 G1 X5 F30\nG94\nG1 X6 F60", &["G 930", "Move X5 F0.5", "G 940", "Move X6 F1"]);
}

#[test]
fn arcs_say_where_their_centre_is() {
    says("marlin", "G3 I-10", &["Arc ccw [-10.0, 0.0] Xy Offset +0"]);
    says("marlin", "G2 X5 Y5 R-7 P2", &["Arc X5 Y5 cw [-7.0, 0.0] Xy Radius +2"]);
    says("rs274", "G18 G2 X5 K1 I2 P2 F60", &["G 180", "Arc X5 F1 cw [1.0, 2.0] Zx Offset +1"]);
    says("rs274", "G90.1\nG19 G3 Y5 J1 K2", &["G 901", "G 190", "Arc Y5 ccw [1.0, 2.0] Yz Absolute +0"]);
    says("siemens", "G2 X10 Y=5 CR=6.5", &["Arc X10 Y5 cw [6.5, 0.0] Xy Radius +0"]);
    let Centre::Offset = Centre::default() else { panic!("G91.1 is the default everywhere") };
}

#[test]
fn a_dwell_is_in_the_unit_of_the_dialect() {
    says("marlin", "G4 P500", &["Dwell 0.5 Seconds"]);
    says("marlin", "G4 P500 S2", &["Dwell 2 Seconds"]);
    says("klipper", "G4 P500", &["Dwell 0.5 Seconds"]);
    says("grbl", "G4 P0.5", &["Dwell 0.5 Seconds"]);
    says("siemens", "G4 F2", &["Dwell 2 Seconds"]);
    says("siemens", "G4 S3", &["Dwell 3 Revolutions"]);
    assert_eq!(Span::default(), Span::Seconds);
}

#[test]
fn an_extruder_that_runs_deposits_on_every_move_but_the_rapid() {
    says(
        "cincinnati",
        "M3 S120\nG1 X1\nG0 X2\nM5\nG1 X3",
        &[
            "Extrude 2 Speed T0",
            "MoveExtrude X25.4 2 Speed",
            "Move X50.8 rapid",
            "Extrude 0 Speed T0",
            "Move X76.19999999999999",
        ],
    );
    says(
        "siemens",
        "BEAD_AREA=12\nG1 X1\nWHEN TRUE DO EXTR_END=2.0\nG1 X2",
        &["Extrude 12 Area T0", "MoveExtrude X1 12 Area", "Extrude 0 Area T0", "Move X2"],
    );
    assert_eq!(By::default(), By::Amount);
}

#[test]
fn other_axes_are_words_of_their_move() {
    let flavor = Flavor::named("cincinnati").expect("built in");
    let mut found = Vec::new();
    Parser::new(flavor).read(b"G1 X1 W-2 A30", |step| {
        let also = step.command.also().expect("it moves W");
        found.push((also.length(b'W'), also.get(b'A')));
    });
    assert_eq!(found, [(Some(-50.8), Some(30.0))]);
}

#[test]
fn remarks_are_kept_as_far_as_is_asked() {
    let flavor = Flavor::default();
    let kinds = |comments| {
        let mut kinds = Vec::new();
        let options = ReadOptions { comments, ..ReadOptions::default() };
        Parser::new(&flavor).with_options(options).read(b"; a\nG1 X1 ; b\nM117 c ; d", |step| {
            kinds.push(short(&step.command));
        });
        kinds
    };
    assert_eq!(kinds(Comments::None), ["Move X1", "M 1170 c"]);
    assert_eq!(kinds(Comments::Lines), ["Comment  a", "Move X1", "M 1170 c"]);
    assert_eq!(kinds(Comments::All), ["Comment  a", "Comment  b", "Move X1", "Comment  d", "M 1170 c"]);
}

#[test]
fn lines_beyond_the_limit_are_skipped_and_deleted_ones_if_asked() {
    let flavor = Flavor::default();
    let options = ReadOptions { skip_deleted: true, longest_line: 20, ..ReadOptions::default() };
    let mut parser = Parser::new(&flavor).with_options(options);
    let mut lines = Vec::new();
    parser.read(b"/G1 X1\n;23456789012345678901\nG1 X2\n", |step| lines.push(step.line));
    assert_eq!(lines, [3]);
    assert_eq!(
        parser.diagnostics().list(),
        [Diagnostic { line: 2, column: 1, kind: Problem::LineTooLong(20) }]
    );
}

#[test]
fn blocks_of_whole_lines_are_one_program() {
    let text = b"G91\nG20\nG1 X1 E1\r\nG1 X2\nM3 S5\nG2 X1 I4\n; end";
    let flavor = Flavor::default();
    let mut whole = Vec::new();
    Parser::new(&flavor).read(text, |step| whole.push(step));
    for size in 10..text.len() {
        let mut parser = Parser::new(&flavor);
        let mut found = Vec::new();
        let (mut start, mut end) = (0, 0);
        while start < text.len() {
            end = (end + size).min(text.len());
            let block = &text[start..end];
            let length = if end == text.len() { block.len() } else { whole_lines(block) };
            parser.read(&block[..length], |step| found.push(step));
            start += length;
        }
        assert_eq!(found, whole, "{size}");
    }
}

#[test]
fn lines_may_come_from_elsewhere() {
    let flavor = Flavor::default();
    let mut lines = Vec::new();
    Parser::new(&flavor).with_lines(&[4, 4, 9]).read(b"G1 X1\nG28\nG1 X2\n", |step| lines.push(step.line));
    assert_eq!(lines, [4, 4, 9]);
}
