use crate::tests::{craft, skein, words};
use crate::{Counting, Dimension};
use skein::{Micron, Ratio, Skein};

/// What a millimetre of 2.8 mm filament holds.
const MM: f64 = std::f64::consts::FRAC_PI_4 * 2.8 * 2.8;

fn volume(mm: f64) -> Ratio {
    Ratio::from_f64(mm * MM).expect("a volume")
}

/// The settings of a row, in millimetres of filament.
fn row(retraction: f64, extra: f64, prime: f64, least: i32) -> Dimension {
    Dimension {
        retraction_volume: volume(retraction),
        restart_extra_volume: volume(extra),
        prime_volume: volume(prime),
        minimum_travel: Micron(least),
        ..Dimension::default()
    }
}

/// Threads of 10 mm with gaps of these lengths in mm between them, all in one layer.
fn threads(gaps: &[f64]) -> String {
    let mut text = String::from("(<layer> 0.2 )\n");
    let mut x = 0.0;
    for gap in std::iter::once(&0.0).chain(gaps) {
        x += gap;
        text += &format!("G1 X{x} Y0 Z0.2 F1200\nM101\nG1 X{} Y0 Z0.2 F960\nM103\n", x + 10.0);
        x += 10.0;
    }
    text + "(</layer>)\n"
}

fn print(body: &str) -> Skein {
    skein("0.72", "0.4", "stadium", "filament 2.8", body)
}

/// The E words, to four decimals as the rows have them.
fn e(dimension: &Dimension, body: &str) -> Vec<f64> {
    words(&craft(dimension, print(body))).iter().map(|e| (e * 1e4).round() / 1e4).collect()
}

/// stages_tests.md DM3. What the original pushes at the very first start is our prime.
#[test]
fn dm3_absolute_with_retraction() {
    let dimension = Dimension { counting: Counting::Absolute, ..row(1.0, 0.1, 1.1, 4000) };
    assert_eq!(
        e(&dimension, &threads(&[10.0, 10.0])),
        [1.1, 1.512, 0.512, 1.612, 2.0239, 1.0239, 2.1239, 2.5359, 1.5359]
    );
}

/// stages_tests.md DM4.
#[test]
fn dm4_relative_with_retraction() {
    let words = e(&row(2.0, 0.5, 2.5, 1000), &threads(&[10.0]));
    assert_eq!(words, [2.5, 0.412, -2.0, 2.5, 0.412, -2.0]);
}

/// stages_tests.md DM5, in both of its forms.
#[test]
fn dm5_short_travels_have_less_or_none() {
    let drawn = |least, gap| {
        let words = e(&row(2.0, 0.0, 0.0, least), &threads(&[gap]));
        if words.len() == 5 { words[1] } else { 0.0 }
    };
    assert_eq!((drawn(4000, 6.0), drawn(4000, 3.0)), (-1.0, 0.0));
    assert_eq!((drawn(1000, 3.0), drawn(1000, 0.8)), (-2.0, 0.0));
}

/// stages_tests.md DM7.
#[test]
fn dm7_without_retraction_no_line_has_e_alone() {
    let off = Dimension { retract_within_island: true, minimum_travel: Micron(0), ..Dimension::default() };
    let body = threads(&[10.0, 30.0]);
    assert_eq!(craft(&off, print(&body)), craft(&Dimension::default(), print(&body)));
    assert_eq!(e(&off, &body), [0.412; 3]);
}

/// A square outline from (0, -1) to (x, 1).
fn outline(from: f64, to: f64) -> String {
    let corner = |x: f64, y: f64| format!("(<boundaryPoint> X{x} Y{y} Z0.2 </boundaryPoint>)\n");
    let corners = [corner(from, -1.0), corner(to, -1.0), corner(to, 1.0), corner(from, 1.0)].concat();
    format!("(<boundaryPerimeter>)\n{corners}(</boundaryPerimeter>)\n")
}

fn on_islands(islands: &[(f64, f64)], gap: f64) -> String {
    let outlines: String = islands.iter().map(|(from, to)| outline(*from, *to)).collect();
    threads(&[gap]).replacen("(<layer> 0.2 )\n", &format!("(<layer> 0.2 )\n{outlines}"), 1)
}

#[test]
fn a_travel_over_the_clay_of_one_island_needs_none_and_one_that_leaves_it_all() {
    let drawn = |dimension: &Dimension, body: &str| e(dimension, body).iter().filter(|e| **e == -2.0).count();
    let row = row(2.0, 0.0, 0.0, 4000);
    let one = on_islands(&[(-1.0, 41.0)], 20.0);
    // The one behind the last bead is always there.
    assert_eq!(drawn(&row, &one), 1);
    assert_eq!(drawn(&Dimension { retract_within_island: true, ..row.clone() }, &one), 2);
    // However short it is.
    let two = on_islands(&[(-1.0, 11.0), (11.5, 30.0)], 2.0);
    assert_eq!(drawn(&row, &two), 2);
}

#[test]
fn a_travel_through_empty_layers_is_one_and_its_feeds_stay() {
    let body = "(<layer> 0.2 )\nG1 X0 Y0 Z0.2 F1200\nM101\nG1 X10 Y0 Z0.2 F960\nM103\n(</layer>)\n\
                (<layer> 0.6 )\nG1 X13 Y0 Z0.2\n(</layer>)\n\
                (<layer> 1.0 )\nG1 X16 Y0 Z0.2\nM101\nG1 X26 Y0 Z0.2\n(</layer>)\n\
                (<layer> 1.4 )\nG1 X36 Y0 Z0.2\nM103\nG1 X40 Y0 Z0.2\n(</layer>)\n";
    let row = row(2.0, 0.0, 0.0, 4000);
    assert_eq!(e(&row, body), [0.412, -1.0, 1.0, 0.412, 0.412, -2.0]);
    let done = craft(&row, print(body));
    let text = String::from_utf8(done.write()).expect("text");
    // 200 mm³/s of 6.15752 mm³ a millimetre are 1948.836 mm a minute.
    assert!(text.contains("G1 X10.0 Y0.0 Z0.2 F1948.836 E-1.0\nM103\n"), "{text}");
    assert!(text.contains("G1 X26.0 Y0.0 Z0.2 F960.0 E0.41"), "{text}");
    assert!(text.contains("M103\nG1 X40.0 Y0.0 Z0.2 F960.0\n"), "{text}");
}

#[test]
fn an_absolute_e_is_set_back_at_a_layer() {
    let body = threads(&[10.0]).repeat(6);
    let plain = Dimension { counting: Counting::Absolute, ..Dimension::default() };
    let short = Dimension { maximum_e_before_reset: 2, ..plain.clone() };
    let relative = words(&craft(&Dimension::default(), print(&body)));
    let done = craft(&short, print(&body));
    let (mut at, mut steps) = (0.0, Vec::new());
    let mut resets = 0;
    for line in done.layers.iter().flat_map(|layer| &layer.lines) {
        if let Some(e) = line.as_move().and_then(|step| step.extrusion) {
            steps.push(e.f64() - at);
            at = e.f64();
        } else if *line == skein::Line::Verbatim("G92 E0".into()) {
            assert!(at > 2.0);
            at = 0.0;
            resets += 1;
        }
    }
    assert_eq!(resets, 1);
    assert!(steps.iter().zip(&relative).all(|(one, other)| (one - other).abs() < 1e-9));
    assert_eq!(steps.len(), relative.len());
}
