use crate::{Counting, Dimension};
use skein::{Line, Notes, Ratio, Skein, Stage};

/// A skein with a bead of this width and section on layers of this height.
pub(crate) fn skein(width: &str, height: &str, section: &str, e_unit: &str, body: &str) -> Skein {
    let text = format!(
        "(<extruderInitialization>)\nG90\n(<layerHeight> {height} </layerHeight>)\n(<eUnit> {e_unit} </eUnit>)\n\
         (<beadSection> {section} </beadSection>)\n(<edgeWidth> {width} </edgeWidth>)\n(</extruderInitialization>)\n\
         (<crafting>)\n{body}(</crafting>)\nM103\n"
    );
    Skein::read(text.as_bytes()).expect("a skein")
}

pub(crate) fn craft(dimension: &Dimension, skein: Skein) -> Skein {
    let skein = dimension.craft(skein, &mut Notes::default()).expect("dimension");
    skein.verify().expect("lawful skein");
    assert_eq!(Skein::read(&skein.write()).as_ref(), Ok(&skein), "reading undoes writing");
    skein
}

pub(crate) fn words(skein: &Skein) -> Vec<f64> {
    skein.lines().filter_map(|line| line.as_move()?.extrusion.map(|word| word.f64())).collect()
}

/// A bead from x = 0 to `x` mm.
fn bead(x: &str) -> String {
    format!("(<layer> 0.75 )\nG1 X0.0 Y0.0 Z1.5\nM101\nG1 X{x} Y0.0 Z1.5\nM103\n(</layer>)\n")
}

#[test]
fn dm1_a_stadium_in_make_believe_filament() {
    let e = |flow| {
        let dimension = Dimension { flow: Ratio::from_f64(flow).expect("a share"), ..Dimension::default() };
        words(&craft(&dimension, skein("0.72", "0.4", "stadium", "filament 2.8", &bead("10.0"))))
    };
    assert_eq!(e(1.0), [0.41196]);
    assert_eq!(e(0.5), [0.20598]);
}

/// stages_tests.md DM2: an infill of its own section is a share of the bead's.
#[test]
fn dm2_infill_of_its_own_section() {
    let share = 0.4 * 0.6 * 0.82 / ((0.72 - 0.4) * 0.4 + std::f64::consts::FRAC_PI_4 * 0.4 * 0.4);
    let body = bead("10.0").replace("M101", &format!("M108 S{share:.6}\nM101"));
    let words = words(&craft(&Dimension::default(), skein("0.72", "0.4", "stadium", "filament 2.8", &body)));
    assert!((words[0] - 0.3196).abs() < 5e-5, "{words:?}");
}

#[test]
fn dm6_half_the_flow_is_half_the_clay_and_holds_on_the_next_layer() {
    let body = "(<layer> 0.75 )\nG1 X0.0 Y0.0 Z1.5\nM101\nG1 X10.0 Y0.0 Z1.5\nM108 S0.5\nG1 X20.0 Y0.0 Z1.5\nM103\n\
                (</layer>)\n";
    let twice = format!("{body}{body}");
    let words = words(&craft(&Dimension::default(), skein("2.0", "1.0", "rectangle", "mm3", &twice)));
    assert_eq!(words, [20.0, 10.0, 10.0, 10.0]);
}

#[test]
fn dm8_clay_in_a_tube_and_by_volume() {
    let e = |unit| words(&craft(&Dimension::default(), skein("3.3", "1.5", "stadium", unit, &bead("100.0"))));
    assert_eq!(e("ram 60.0"), [0.15799]);
    assert_eq!(e("mm3"), [446.715]);
    // On every millimetre of nominal bead, whatever its section.
    assert_eq!(e("per_mm 1.25"), [125.0]);
}

#[test]
fn a_layer_of_its_own_height_takes_clay_for_its_own_height() {
    let low = bead("100.0").replace("0.75 )", "0.5 )\n(<thickness> 1.0 </thickness>)");
    let e = |unit| words(&craft(&Dimension::default(), skein("3.0", "1.5", "rectangle", unit, &low)));
    assert_eq!(e("mm3"), [300.0]);
    assert_eq!(e("per_mm 1.5"), [100.0]);
}

#[test]
fn a_spiral_is_measured_along_its_slope() {
    let body = "(<layer> 0.75 )\nG1 X0.0 Y0.0 Z0.0\nM101\nG1 X3.0 Y0.0 Z4.0\nM103\n(</layer>)\n";
    let words = words(&craft(&Dimension::default(), skein("2.0", "1.0", "rectangle", "mm3", body)));
    assert_eq!(words, [10.0]);
}

/// Many short beads around a circle, over several layers; every seventh layer is lower.
fn pot() -> Skein {
    let mut body = String::new();
    for layer in 0..40 {
        body.push_str(&format!("(<layer> {layer}.5 )\n"));
        if layer % 7 == 0 {
            body.push_str("(<thickness> 0.7 </thickness>)\n");
        }
        for step in 0..200 {
            let (sin, cos) = (f64::from(step) * 0.0314159).sin_cos();
            body.push_str(&format!("G1 X{:.3} Y{:.3} Z{layer}.0\n", 9.0 * cos, 9.0 * sin));
            if step == 0 {
                body.push_str("M101\n");
            }
        }
        body.push_str("M103\n(</layer>)\n");
    }
    skein("2.31", "1.1", "stadium", "ram 60.0", &body)
}

/// Σ length × bead section in mm³, by other means than the stage's.
fn volume(skein: &Skein) -> f64 {
    let facts = skein.facts().expect("facts");
    let bead = facts.bead().expect("bead");
    let mut volume = 0.0;
    for layer in &skein.layers {
        let section = bead.of_height(layer.height(&facts).expect("height")).area();
        let ends: Vec<_> = layer.lines.iter().filter_map(Line::as_move).map(|step| step.to).collect();
        for pair in ends.windows(2) {
            let flat = (f64::from(pair[1].x - pair[0].x)).hypot(f64::from(pair[1].y - pair[0].y));
            volume += flat / 1000.0 * section;
        }
    }
    volume
}

#[test]
fn dm9_the_e_words_add_up_to_the_clay_of_the_beads() {
    let pot = pot();
    let clay = volume(&pot);
    let ram = std::f64::consts::FRAC_PI_4 * 60.0 * 60.0;
    let relative = words(&craft(&Dimension::default(), pot.clone()));
    let absolute = words(&craft(&Dimension { counting: Counting::Absolute, ..Dimension::default() }, pot));
    let total: f64 = relative.iter().sum();
    // No drift: half a step over the whole pot, where 8000 roundings could have lost forty steps.
    assert!((total - clay / ram).abs() < 0.6e-5, "{total} against {}", clay / ram);
    let mut sum = 0.0;
    for (step, total) in relative.iter().zip(&absolute) {
        sum += step;
        assert!((sum - total).abs() < 1e-7);
    }
    assert_eq!(relative.len(), absolute.len());
}

#[test]
fn the_number_of_cores_changes_nothing() {
    let on = |cores| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(cores).build().expect("a pool");
        pool.install(|| craft(&Dimension::default(), pot()))
    };
    assert_eq!(on(1), on(5));
}

#[test]
fn the_file_says_how_e_counts_behind_g90() {
    let head = |counting| {
        let dimension = Dimension { counting, ..Dimension::default() };
        craft(&dimension, skein("2.0", "1.0", "rectangle", "mm3", &bead("1.0"))).head
    };
    for (counting, mode) in [(Counting::Relative, "M83"), (Counting::Absolute, "M82")] {
        let head = head(counting);
        let [Line::Verbatim(said), Line::Verbatim(zero)] = &head[head.len() - 2..] else {
            panic!("{head:?}")
        };
        assert_eq!((&**said, &**zero), (mode, "G92 E0"));
    }
}

#[test]
fn an_amount_that_another_stage_has_set_stays_and_counts() {
    let body = "(<layer> 0.75 )\nG1 X0.0 Y0.0 Z1.5\nG1 X0.0 Y0.0 Z1.5 E5.0\nM101\nG1 X10.0 Y0.0 Z1.5\nM103\n(</layer>)\n";
    let e = |counting| {
        let dimension = Dimension { counting, ..Dimension::default() };
        words(&craft(&dimension, skein("2.0", "1.0", "rectangle", "mm3", body)))
    };
    assert_eq!(e(Counting::Relative), [5.0, 20.0]);
    assert_eq!(e(Counting::Absolute), [5.0, 25.0]);
}

#[test]
fn a_bead_without_a_start_is_refused() {
    let body = "(<layer> 0.75 )\nM101\nG1 X10.0 Y0.0 Z1.5\nM103\n(</layer>)\n";
    let refused =
        Dimension::default().craft(skein("2.0", "1.0", "rectangle", "mm3", body), &mut Notes::default());
    assert_eq!(
        refused.expect_err("no start").to_string(),
        "layer 0: clay flows before the nozzle has a place"
    );
}
