use super::*;
use skein::RotatedLoopLayer;

/// A part from 5 to 15 mm above the bed in layers of 0.4 mm.
fn slices() -> Slices {
    let layers = (0..25).map(|layer| RotatedLoopLayer {
        z: Micron(5200 + 400 * layer),
        thickness: None,
        rotation: None,
        loops: Vec::new(),
    });
    let mut slices = Slices { layers: layers.collect(), ..Slices::default() };
    slices.facts.layer_height = Some(Micron(400));
    (slices.bounds.min.z, slices.bounds.max.z) = (5000, 15_000);
    slices
}

fn heights(stage: &Bottom) -> Vec<i32> {
    let slices = stage.craft(slices(), &mut Notes::default()).expect("bottom");
    assert_eq!(slices.bounds.max.z - slices.bounds.min.z, 10_000);
    assert_eq!(slices.layers[0].z.0 - slices.bounds.min.z, 200, "the part and its layers go together");
    slices.layers.iter().map(|layer| layer.z.0).collect()
}

/// stages_tests.md BO1.
#[test]
fn bo1_the_lowest_layer_lies_on_the_bed() {
    assert_eq!(heights(&Bottom::default()), (0..25).map(|layer| 200 + 400 * layer).collect::<Vec<i32>>());
}

/// stages_tests.md BO2.
#[test]
fn bo2_and_on_a_bat_as_much_higher() {
    let stage = Bottom { altitude: Micron(2000), ..Bottom::default() };
    assert_eq!(heights(&stage), (0..25).map(|layer| 2200 + 400 * layer).collect::<Vec<i32>>());
}
