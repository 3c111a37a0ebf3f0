//! Where the part is cut.

use skein::{Error, Micron};

/// A layer before it has loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slab {
    /// The height of its middle, where the part is cut; an odd height's middle is rounded down.
    pub middle: Micron,
    /// How high it is.
    pub height: Micron,
}

/// More layers than anyone waits for: 100 m of 0.1 mm.
const MOST: i64 = 1_000_000;

/// The layers of a part that stands on the bed and is `top` high.
///
/// The last layer is made when its middle lies more than a quarter layer below the top, so a last slab of less than
/// three quarters is left out (stages.md §5.1).
///
/// # Errors
/// When not a single layer fits, or more than a million.
pub fn slabs(top: Micron, first: Micron, height: Micron) -> Result<Vec<Slab>, Error> {
    let count = (i64::from(top.0) - i64::from(first.0)) / i64::from(height.0) + 2;
    if count > MOST {
        return Err(Error::new(format!("layers of {height} mm on a part {top} mm high would be {count}"))
            .hint("set carve.layer_height higher"));
    }
    let mut slabs = Vec::with_capacity(count.max(0) as usize);
    let (mut bottom, mut high) = (0i64, first);
    // Twice and four times the heights keep halves and quarters whole.
    while 4 * bottom + 2 * i64::from(high.0) < 4 * i64::from(top.0) - i64::from(high.0) {
        slabs.push(Slab { middle: Micron((bottom + i64::from(high.0) / 2) as i32), height: high });
        bottom += i64::from(high.0);
        high = height;
    }
    if slabs.is_empty() {
        return Err(Error::new(format!(
            "the part is {top} mm high, too flat for a first layer of {first} mm"
        ))
        .hint("set carve.first_layer_height lower, or check the unit of the file"));
    }
    Ok(slabs)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn middles(top: f64, height: f64) -> Vec<f64> {
        let mm = |value| Micron::from_mm(value).expect("a length");
        slabs(mm(top), mm(height), mm(height)).expect("layers").iter().map(|slab| slab.middle.mm()).collect()
    }

    /// C1, C2 of stages_tests.md.
    #[test]
    fn a_last_slab_thicker_than_three_quarters_gets_a_layer() {
        let layers = middles(10.0, 0.4);
        assert_eq!((layers.len(), layers[0], layers[1], layers[24]), (25, 0.2, 0.6, 9.8));
        assert_eq!(middles(10.1, 0.4).len(), 25);
        assert_eq!(middles(10.35, 0.4).len(), 26);
    }

    /// C13.
    #[test]
    fn a_part_flatter_than_a_layer_is_refused() {
        assert!(slabs(Micron(50), Micron(400), Micron(400)).is_err());
    }

    #[test]
    fn a_million_layers_are_refused() {
        let error = slabs(Micron(5_000_000), Micron(1), Micron(1)).expect_err("too many");
        assert!(error.message.contains("5000001"), "{error}");
    }

    #[test]
    fn the_first_layer_has_its_own_height() {
        let layers = slabs(Micron(9_000), Micron(1_200), Micron(1_500)).expect("layers");
        assert_eq!(layers[0], Slab { middle: Micron(600), height: Micron(1_200) });
        assert_eq!(layers[1], Slab { middle: Micron(1_950), height: Micron(1_500) });
    }
}
