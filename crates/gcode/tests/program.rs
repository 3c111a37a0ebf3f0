//! Laws of the parser, the preprocessor and the exporter.

use gcode::{
    Command, Exporter, Flavor, GcodeExporter, Limits, Parameters, Parser, Preprocessor, Step, whole_lines,
};
use proptest::prelude::*;

/// Bytes that mostly look like G-code of some dialect.
fn text() -> impl Strategy<Value = Vec<u8>> {
    let piece = prop_oneof![
        6 => "[GMNXYZEIJKRFPSTABWOox]-?[0-9]{0,3}[.]?[0-9]{0,2} ?",
        2 => "(\n|\r\n|\r)",
        1 => "(G0|G1|G2 I1|G3|G4|G53|G54|G90|G91|G92|G93|G94|M3|M4|M5|M69|M117|M66|G20|G21|%|/) ",
        1 => "(o1 (sub|endsub|call|if|else|endif|while|endwhile|do|repeat|endrepeat|break)|#[0-9]=|#[0-9]|\\[|\\]|WHILE|DO1|END1|GOTO1|N1|IF)",
        1 => "(R[0-9]=|=R1|X=|CR=|BEAD_AREA=|ENDIF|ENDFOR|FOR |LOOP|ENDLOOP|A1:|GOTOB A1|DEF REAL |REPEAT A1|UNTIL)",
        1 => "[;()*,\"\\[\\]{}#:=+.-]{1,3}",
        1 => "[A-Za-z_]{1,6}[ =]?",
    ];
    let any_bytes = prop::collection::vec(any::<u8>(), 0..4);
    let piece = prop_oneof![12 => piece.prop_map(String::into_bytes), 1 => any_bytes];
    prop::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

fn flavor() -> impl Strategy<Value = &'static Flavor> {
    prop::sample::select(Flavor::built_in().iter().collect::<Vec<_>>())
}

/// Every number in a command, whatever it is.
fn is_sound(command: &Command<'_>) -> bool {
    !format!("{command:?}").contains("inf")
        || matches!(command, Command::Config { .. } | Command::Comment { .. })
}

fn same_words(left: Option<Parameters<'_>>, right: Option<Parameters<'_>>) -> bool {
    match (left, right) {
        (Some(left), Some(right)) => left.iter().eq(right.iter()) && left.unit == right.unit,
        (left, right) => left.is_none() && right.is_none(),
    }
}

/// Whether two commands say the same; words may be spelled another way.
fn same(left: &Command<'_>, right: &Command<'_>) -> bool {
    match (left, right) {
        (Command::G { tenths: a, words: left }, Command::G { tenths: b, words: right })
        | (Command::M { tenths: a, words: left }, Command::M { tenths: b, words: right }) => {
            a == b && same_words(Some(*left), Some(*right))
        }
        _ => without_also(*left) == without_also(*right) && same_words(left.also(), right.also()),
    }
}

/// A command without the words of other axes.
fn without_also(mut command: Command<'_>) -> Command<'_> {
    if let Command::Move { also, .. }
    | Command::MoveExtrude { also, .. }
    | Command::MoveMill { also, .. }
    | Command::MachineCoordinates { also, .. } = &mut command
    {
        *also = b"";
    }
    command
}

/// Lines that a flavor can say, with at most four decimals.
fn sayable(flavor: &Flavor) -> impl Strategy<Value = String> + use<> {
    let number = "-?[0-9]{1,4}([.][0-9]{1,4})?";
    let name = flavor.name.to_string();
    let work: &[&str] = match name.as_str() {
        "marlin" => &[
            "M3 S600",
            "M4 S30",
            "M5",
            "G4 P250",
            "G4 S2",
            "T1",
            "M117 a b",
            "G92 X5",
            "G28 X Y",
            "M204 P500",
        ],
        "reprapfirmware" => &["M3 S600", "M5", "G4 S2", "T0", "G92 X5 E0", "M566 X600"],
        "klipper" => &["G4 P250", "SET_VELOCITY_LIMIT ACCEL=500", "T1", "G92 E0"],
        "cincinnati" => {
            &["M3 S120", "M4 S60", "M5", "G4 P2", "M69 F300 P20", "G20", "G21", "M66 L0.1", "G54"]
        }
        "siemens" => {
            &["BEAD_AREA=12.5", "WHEN TRUE DO EXTR_END=2.0", "G4 F2", "G4 S3", "G70", "G71", "G500", "M3 S60"]
        }
        _ => &[
            "M3 S600",
            "M4",
            "M5",
            "S120",
            "G4 P0.5",
            "G93",
            "G94",
            "G20",
            "G21",
            "G54",
            "G59.3",
            "F120",
            "G10 L2 P1 X5",
        ],
    };
    let work: Vec<String> = work.iter().map(|&line| line.to_owned()).collect();
    let deposits = if matches!(name.as_str(), "marlin" | "reprapfirmware" | "klipper") { " E" } else { " Z" };
    let radius = if name == "siemens" { " CR=" } else { " R" };
    let has_radius = !matches!(name.as_str(), "klipper" | "cincinnati");
    let (x, y, e, f) = (number, number, number, "[1-9][0-9]{1,3}([.][0-9]{1,3})?");
    prop_oneof![
        4 => (x, y, e, f).prop_map(move |(x, y, e, f)| format!("G1 X{x} Y{y}{deposits}{e} F{f}")),
        2 => (x, y).prop_map(|(x, y)| format!("G0 X{x} W{y}")),
        1 => (x, y).prop_map(|(x, y)| format!("G53 G0 X{x} Z{y}")),
        2 => (x, y, e).prop_map(|(x, i, j)| format!("G2 X{x} I{i} J{j}")),
        1 => (x, y).prop_map(move |(x, r)| {
            if has_radius { format!("G3 X{x}{radius}{r}") } else { format!("G3 X{x} I{r}") }
        }),
        2 => prop::sample::select(work),
        1 => Just("G18 G2 X1 K2\nG17".to_owned()),
        1 => Just("G90 G1 X5\nG91\nG1 X1.5".to_owned()),
        1 => Just(if name == "cincinnati" { "(a cup)".to_owned() } else { "; a cup".to_owned() }),
    ]
}

fn program() -> impl Strategy<Value = (&'static Flavor, String)> {
    flavor().prop_flat_map(|flavor| {
        let flavor: &'static Flavor = flavor;
        let lines = prop::collection::vec(sayable(flavor), 1..20);
        lines.prop_map(move |lines| (flavor, lines.join("\n")))
    })
}

fn read<'a>(flavor: &Flavor, text: &'a [u8]) -> Vec<Step<'a>> {
    let mut steps = Vec::new();
    Parser::new(flavor).read(text, |step| steps.push(step));
    steps
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn any_bytes_can_be_parsed(text in text(), flavor in flavor()) {
        let mut parser = Parser::new(flavor);
        let mut sound = true;
        parser.read(&text, |step| sound &= is_sound(&step.command));
        prop_assert!(sound);
        let lines = 1 + text.iter().filter(|byte| matches!(byte, b'\n' | b'\r')).count();
        for found in parser.diagnostics().list() {
            prop_assert!((1..=lines).contains(&(found.line as usize)), "{found}");
            prop_assert!(found.column as usize <= text.len() + 1, "{found}");
        }
        let _ = Flavor::detect(&text);
        let strict = Parser::new(flavor).read_strict(&text, |_| ());
        prop_assert_eq!(strict.err(), parser.diagnostics().list().first().cloned());
    }

    #[test]
    fn any_program_ends(text in text(), flavor in flavor()) {
        let limits = Limits { lines: 2000, steps: 5000, turns: 1000, idle: 100, ..Limits::default() };
        if let Ok(program) = Preprocessor::new(flavor).with_limits(limits).run(&text) {
            let mut parser = program.parser(flavor);
            let mut sound = true;
            parser.read(&program.text, |step| sound &= is_sound(&step.command));
            prop_assert!(sound);
        }
    }

    #[test]
    fn anything_can_be_exported_to_anything(text in text(), from in flavor(), to in flavor()) {
        let mut exporter = GcodeExporter::new(to).from_flavor(from);
        let mut out = Vec::new();
        let mut count = 0;
        Parser::new(from).read(&text, |step| {
            exporter.line(&step, &mut out);
            count += 1;
        });
        let lines = out.iter().filter(|&&byte| byte == b'\n').count();
        prop_assert!(lines >= count, "no command is lost");
    }

    #[test]
    fn what_is_exported_reads_back_as_it_was((flavor, text) in program()) {
        let before = read(flavor, text.as_bytes());
        let mut exporter = GcodeExporter::new(flavor);
        let mut out = Vec::new();
        before.iter().for_each(|step| exporter.line(step, &mut out));
        prop_assert!(exporter.diagnostics().is_empty(), "{:?}", exporter.diagnostics());
        let after = read(flavor, &out);
        let written = String::from_utf8_lossy(&out);
        prop_assert_eq!(before.len(), after.len(), "{}\n---\n{}", text, written);
        for (left, right) in before.iter().zip(&after) {
            prop_assert!(same(&left.command, &right.command), "{left:?}\n{right:?}\n{written}");
        }
    }

    #[test]
    fn a_program_in_blocks_is_the_program(text in text(), flavor in flavor(), size in 1_usize..50) {
        let whole = read(flavor, &text);
        let mut parser = Parser::new(flavor);
        let mut found = Vec::new();
        let (mut start, mut end) = (0, 0);
        while start < text.len() {
            end = (end + size).min(text.len());
            let block = &text[start..end];
            let length = if end == text.len() { block.len() } else { whole_lines(block) };
            parser.read(&block[..length], |step| found.push(step));
            start += length;
        }
        // A CR that stands alone behind an LF may end a line more, when a block ends between them.
        prop_assume!(!text.windows(2).any(|pair| pair == b"\n\r"));
        prop_assert_eq!(format!("{found:?}"), format!("{whole:?}"));
    }
}
