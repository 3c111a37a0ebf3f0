use super::*;

fn run<'a>(flavor: &str, text: &'a str) -> Result<Program<'a>, Diagnostic> {
    preprocess(text.as_bytes(), Flavor::named(flavor).expect("built in"))
}

#[track_caller]
fn gives(flavor: &str, text: &str, expected: &str) {
    let program = run(flavor, text).unwrap_or_else(|error| panic!("{flavor}: {text}: {error}"));
    let found: Vec<&str> = str::from_utf8(&program.text).expect("text").lines().map(str::trim).collect();
    assert_eq!(found, expected.lines().map(str::trim).collect::<Vec<_>>(), "{flavor}: {text}");
    assert!(program.lines.is_empty() || program.lines.len() == found.len());
}

/// The value of an expression of RS274.
fn value(flavor: &str, expression: &str) -> Result<f64, String> {
    let text = format!("X[{expression}]");
    let program = run(flavor, &text).map_err(|error| error.kind.to_string())?;
    let text = str::from_utf8(&program.text).expect("text").trim();
    Ok(text.trim_start_matches('X').parse().expect("a number"))
}

#[track_caller]
fn fails(flavor: &str, text: &str, line: u32, why: &str) {
    let error = run(flavor, text).expect_err(text);
    assert_eq!(error.line, line, "{text}: {error}");
    assert!(error.kind.to_string().contains(why), "{text}: {error}");
}

#[test]
fn what_computes_nothing_is_passed_on_as_it_is() {
    for (flavor, text) in [
        ("marlin", "G1 X[1]\n#1=2\n"),
        ("rs274", "G1 X1 ; plain\nG1 X2\n"),
        ("cincinnati", "G0 X1 Y1\n(a cup)\nM66 L0.1\n"),
        ("siemens", "; R1=5\nG1 X1\n"),
    ] {
        let program = run(flavor, text).expect(text);
        assert_eq!(program.text.as_ptr(), text.as_ptr(), "{flavor}");
        assert!(program.lines.is_empty());
    }
}

#[test]
fn operators_bind_as_in_rs274() {
    for (text, expected) in [
        ("1 + 2 * 3", 7.0),
        ("2 ** 3 ** 2", 64.0),
        ("10 - 2 - 3", 5.0),
        ("7 MOD 3 + 1", 2.0),
        ("-7 MOD 3", 2.0),
        ("1 + 1 EQ 2", 1.0),
        ("1 LT 2 AND 2 LT 1", 0.0),
        ("1 XOR 1 OR 1", 1.0),
        ("0.1 + 0.2 EQ 0.3", 1.0),
        ("-[2 + 3]", -5.0),
        ("1/4", 0.25),
        ("ABS[-3] + SQRT[16]", 7.0),
        ("ATAN[1]/[-1]", 135.0),
        ("ROUND[2.5]", 3.0),
        ("COS[60] * 2", 1.0),
        ("EXISTS[#<nobody>]", 0.0),
    ] {
        let found = value("rs274", text).expect(text);
        assert!((found - expected).abs() < 1e-12, "{text}: {found}");
    }
}

#[test]
fn fix_and_fup_round_as_the_dialect_does() {
    for (flavor, fix, fup) in [("rs274", -3.0, -2.0), ("cincinnati", -2.0, -3.0)] {
        assert_eq!(value(flavor, "FIX[-2.8]"), Ok(fix), "{flavor}");
        assert_eq!(value(flavor, "FUP[-2.8]"), Ok(fup), "{flavor}");
    }
}

#[test]
fn what_has_no_value_is_an_error_with_its_place() {
    fails("rs274", "G1 X1\nG1 X[1/0]", 2, "no number");
    fails("rs274", "G1 X[SQRT[-1]]", 1, "no number");
    fails("rs274", "G1 X[LN[0]]", 1, "no number");
    fails("rs274", "G1 X[10 ** 999]", 1, "no number");
    fails("rs274", "G1 X#<a>", 1, "`a` has no value");
    fails("rs274", "G1 X[1 + ]", 1, "a value is missing");
    fails("rs274", "G1 X[1 + 2", 1, "`]` is missing");
    fails("rs274", "#-1=5", 1, "no number");
    fails("rs274", &format!("X{}1{}", "[".repeat(100), "]".repeat(100)), 1, "too deep");
    fails("rs274", &format!("X[1{}]", "+1".repeat(300)), 1, "too long");
    fails("rs274", &format!("X{}1", "[-".repeat(100)), 1, "too");
    let error = run("rs274", "G1 X[1 + ]").expect_err("no value");
    assert_eq!(error.column, 10);
}

#[test]
fn a_line_uses_the_values_before_it() {
    gives("rs274", "#3=15\n#3=6 G1 X#3\nG1 X#3", "G1 X15\nG1 X6");
    gives("rs274", "#1=2 #2=[#1+1]\nX#1 Y#2 Z##1", "X2 Y1 Z1");
    gives("rs274", "#<Big One>=4\nG1 X#<bigone> Y-#<bigone>", "G1 X4 Y-4");
    gives("rs274", "G1 XSIN[30]", "G1 X0.49999999999999994");
    gives("rs274", "G1 X[1+1] (X[9]) ;#1", "G1 X2 (X[9]) ;#1");
}

#[test]
fn a_variable_of_the_machine_can_be_given() {
    let flavor = Flavor::named("baam").expect("built in");
    let program =
        Preprocessor::new(flavor).with_variable(200, 3.0).run(b"G0 Z[#200 + 1.25]").expect("a program");
    assert_eq!(&*program.text, b"G0 Z4.25\n");
}

#[test]
fn o_words_branch_loop_and_call() {
    gives(
        "rs274",
        "o1 if [0]\nX1\no1 elseif [1]\nX2\no1 elseif [1]\nX3\no1 else\nX4\no1 endif\nX5",
        "X2\nX5",
    );
    gives("rs274", "o1 if [0]\nX1\no1 else\nX4\no1 endif", "X4");
    gives("rs274", "o1 repeat [3]\nX1\no1 endrepeat", "X1\nX1\nX1");
    gives("rs274", "o1 repeat [0]\nX1\no1 endrepeat\nX2", "X2");
    gives("rs274", "#1=0\no1 do\nX#1\n#1=[#1+1]\no1 while [#1 LT 3]", "X0\nX1\nX2");
    gives(
        "rs274",
        "#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\no3 if [#1 GT 3]\no1 break\no3 endif\nX#1\no1 endwhile",
        "X1\nX3",
    );
    gives(
        "rs274",
        "o<wall> sub\nX#1 Y#2\no<low> if [#1 LT 2]\no<wall> return [7]\no<low> endif\nZ9\no<wall> endsub\no<wall> call [1] [5]\no<wall> call [2]\nF#<_value>",
        "X1 Y5\nX2 Y0\nZ9\nF7",
    );
    gives("rs274", "M98 P100 L2\nM2\nO100\nX1\nM99", "X1\nX1\nM2");
}

#[test]
fn a_sawtooth_has_a_line_for_each_turn() {
    let text = "#1=0\no1 while [#1 LT 10]\nG1 X#1 Y[5 * [#1 MOD 2]] F1000\n#1=[#1 + 1]\no1 endwhile\n";
    let program = run("rs274", text).expect("a program");
    assert_eq!(program.lines, [3; 10]);
    assert!(program.text.ends_with(b"G1 X9 Y5 F1000\n"));
}

#[test]
fn fanuc_loops_jumps_and_macros() {
    gives("baam", "#100=1\nWHILE[#100 LE 3]DO1\nX#100\n#100=#100+1\nEND1\nM30\nX9", "X1\nX2\nX3\nM30");
    gives("baam", "#1=0\nN10 X#1\n#1=[#1+1]\nIF[#1 LT 3]GOTO10\nY1", "X0\nX1\nX2\nY1");
    gives("baam", "IF[1 EQ 1]THEN #5=3\nX#5\nGOTO 20\nX9\nN20 Y1", "X3\nY1");
    gives("baam", "X#1 Y2\n#1=#0\nX[#1]", "Y2\nX0");
    gives(
        "baam",
        "O1\nG65 P9 A1 B2 C3 I4 J5 K6 D7 E8 F9 H11 M13 Q17 R18 S19 T20 U21 V22 W23 X24 Y25 Z26\nM30\nO9\nX[#1+#2+#3+#4+#5+#6+#7+#8+#9] Y[#11+#13+#17+#18+#19] Z[#20+#21+#22+#23+#24+#25+#26]\nM99",
        "X45 Y78 Z161\nM30",
    );
}

#[test]
fn siemens_computes_in_words() {
    gives("siemens", "R1=5 R2=R1*2\nG1 X=R1 Y=-R1 F=R1+1000", "G1 X=5 Y=-5 F=1005");
    gives("siemens", "R1=5\nR[R1]=2\nG1 X=R5 BEAD_AREA=12.50", "G1 X=2 BEAD_AREA=12.50");
    gives("siemens", "DEF REAL A1X, B2X=2.5\nG1 X=A1X Y=B2X*SIN(90)\nB2X=1\nZ=B2X", "G1 X=0 Y=2.5\nZ=1");
    gives("siemens", "R1=1\nIF R1 == 1\nX=R1\nELSE\nX9\nENDIF", "X=1");
    gives("siemens", "FOR R1 = 1 TO 3\nX=R1\nENDFOR\nY=R1", "X=1\nX=2\nX=3\nY=4");
    gives("siemens", "R1=0\nWHILE R1 < 2\nR1=R1+1\nX=R1\nENDWHILE", "X=1\nX=2");
    gives("siemens", "R1=0\nREPEAT\nR1=R1+1\nX=R1\nUNTIL R1 >= 2", "X=1\nX=2");
    gives("siemens", "R1=0\nLOOP\nR1=R1+1\nX=R1\nIF R1 > 1 GOTOF OUT\nENDLOOP\nOUT: Y1", "X=1\nX=2\nY1");
    gives("siemens", "R1=0\nAGAIN: R1=R1+1\nX=R1\nIF R1 <> 2 GOTOB AGAIN\nM17\nX9", "X=1\nX=2");
    gives("siemens", "WALL: X1\nY1\nREPEAT WALL P=2\nZ1", "X1\nY1\nX1\nY1\nX1\nY1\nZ1");
    gives(
        "siemens",
        "MSG(\"R1=5; x\")\n$AC_TIMER[1]=0\nG1 X=POT(3)",
        "MSG(\"R1=5; x\")\n$AC_TIMER[1]=0\nG1 X=9",
    );
    fails("siemens", "G1 X=HEIGHT", 1, "`HEIGHT` has no value");
    fails("siemens", "CASE R1 OF 1 GOTOF A1 ENDCASE", 1, "`CASE` is not run");
}

#[test]
fn what_would_never_end_is_an_error() {
    let text = "o1 while [1]\no1 endwhile\n";
    fails("rs274", text, 1, "never ends");
    fails("rs274", "o1 sub\no1 call\no1 endsub\no1 call", 2, "too deep");
    let flavor = Flavor::named("rs274").expect("built in");
    let limits = Limits { lines: 10, turns: 20, steps: 300, variables: 5, ..Limits::default() };
    let why = |text: &str| {
        let error = Preprocessor::new(flavor).with_limits(limits).run(text.as_bytes()).expect_err(text);
        error.kind.to_string()
    };
    assert_eq!(why("o1 repeat [11]\nX1\no1 endrepeat"), "the program emits too much");
    assert_eq!(why("#1=1\no1 while [1]\n#1=[#1+1]\no1 endwhile"), "this loop has too many turns");
    assert_eq!(why("N1 #1=[#1+1]\nGOTO 1"), "too many jumps backwards");
    assert_eq!(why("#1=1\n#2=1\n#3=1\n#4=1\n#5=1\n#6=1"), "too many variables");
    let nested = "o1 repeat [19]\no2 repeat [19]\n#1=[#1+1]\no2 endrepeat\no1 endrepeat";
    assert_eq!(why(nested), "the program runs too long");
}

#[test]
fn blocks_that_do_not_match_are_errors() {
    fails("rs274", "o1 if [1]\nX1", 1, "nothing ends");
    fails("rs274", "X1\no1 endif", 2, "nothing is open");
    fails("rs274", "o1 while [1]\no2 endwhile\no1 endwhile", 2, "nothing is open");
    fails("rs274", "o1 break", 1, "no loop to leave");
    fails("rs274", "o1 call", 1, "no program `1`");
    fails("rs274", "o1 sub\no1 endsub\no1 sub\no1 endsub", 3, "two subroutines");
    fails("baam", "GOTO 7", 1, "no label `7`");
    fails("baam", "G66 P1 X[1]", 1, "not run");
    fails("rs274", "X1 #2", 1, "where a word should");
}

#[test]
fn the_language_of_reprapfirmware_is_told_and_not_run() {
    let program = run("reprapfirmware", "G1 X1\n  while iterations < 5\n  G1 X2\n").expect("passed on");
    let found = program.diagnostics.list();
    assert_eq!((found.len(), found[0].line, found[0].column), (1, 2, 3));
}

#[test]
fn a_parser_of_a_program_names_the_lines_of_the_file() {
    let flavor = Flavor::named("rs274").expect("built in");
    let program = preprocess(b"\n#1=0\no1 repeat [2]\nG1 X1 F1 Q2\no1 endrepeat", flavor).expect("a program");
    let mut lines = Vec::new();
    let mut parser = program.parser(flavor);
    parser.read(&program.text, |step| lines.push(step.line));
    assert_eq!(lines, [4, 4]);
    assert_eq!(parser.diagnostics().list().iter().map(|found| found.line).collect::<Vec<_>>(), [4, 4]);
}
