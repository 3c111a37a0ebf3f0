//! Pots that were found by chance to break a law.

use super::pot::{CYLINDER, Pot};
use super::{keeps_the_laws, tells_what_hangs};

/// The last corner of the last turn was left out, for its height had been reached a little before it: the rim began and
/// ended beside each other.
#[test]
fn a_turn_reaches_its_end_before_the_rim_begins() {
    keeps_the_laws(&Pot {
        radius: 67855.22331453385,
        lobes: (0.12909405576843294, 0),
        flare: -57.862856232608934,
        waist: 1322.0919236263771,
        lean: 13.672971655497493,
        lean_to: 0.5882193302075647,
        base: 2,
        width: 5322.195573868646,
        height: 800,
        ..CYLINDER
    });
    keeps_the_laws(&Pot {
        radius: 85923.97121350346,
        twist: -0.0001159009424813003,
        flare: -34.91263333546612,
        waist: -29.4343146647454,
        lean: -13.892690711293463,
        lean_to: 0.4574904061181637,
        square: true,
        layers: 9,
        width: 7559.215921645524,
        height: 1350,
        ..CYLINDER
    });
}

/// More corners than a turn has microns to rise: the corner of the seam was one of those that were left out.
#[test]
fn a_turn_of_many_corners_keeps_those_of_its_seam() {
    keeps_the_laws(&Pot {
        radius: 97505.96765159749,
        lobes: (0.07879748908403937, 7),
        twist: -1.175416256741011e-5,
        flare: -0.6277220250786798,
        waist: 166.0895798378649,
        lean: -125.14717495808604,
        lean_to: 0.40739291865666594,
        layers: 9,
        base: 0,
        walls: 3,
        width: 2503.9680878016793,
        height: 800,
        ..CYLINDER
    });
}

/// The seam moved on as far as the wall leaned there, too: its links came to lie over other beads than their own, where
/// the gap is another.
#[test]
fn the_links_of_a_seam_lie_over_those_below() {
    keeps_the_laws(&Pot {
        radius: 22990.673455424003,
        lobes: (0.059789363893449896, 8),
        twist: -0.002989480374926124,
        flare: -519.9637976842673,
        waist: -639.8540340014988,
        lean: 693.5903049103998,
        lean_to: 0.40407664390730613,
        layers: 9,
        base: 1,
        walls: 3,
        width: 4325.092841896931,
        height: 3000,
        ..CYLINDER
    });
}

/// A seam in the tip of a lobe, where the inner beads lie deeper than a bead below the outer one.
#[test]
fn a_seam_has_room_for_its_links() {
    tells_what_hangs(&Pot {
        radius: 56685.64893879969,
        lobes: (0.14253174109954422, 8),
        twist: 0.0023434680354620023,
        flare: -1015.1893351020848,
        waist: -1057.2089159840277,
        lean: -983.4361335187757,
        lean_to: 0.6393112901890159,
        layers: 11,
        base: 0,
        walls: 3,
        width: 6823.990216985984,
        height: 3000,
        ..CYLINDER
    });
}

/// A seam that leapt around a corner: the turn ran into its own beginning.
#[test]
fn a_seam_does_not_leap() {
    tells_what_hangs(&Pot {
        radius: 51487.2638137725,
        twist: -0.0028673389248641294,
        flare: 922.3715659090767,
        waist: -2360.2419356742894,
        lean: 635.3337323293841,
        lean_to: 0.9785858067803573,
        square: true,
        layers: 7,
        base: 0,
        walls: 3,
        width: 3053.864386394738,
        height: 2080,
        ..CYLINDER
    });
}

/// The last corner lay on the end of the turn, so the end was left out and the rim began a micron too low.
#[test]
fn the_end_of_a_turn_is_as_high_as_its_layer() {
    keeps_the_laws(&Pot {
        radius: 63339.35265413567,
        lobes: (0.06995677942041255, 6),
        twist: -0.004196181157687606,
        flare: -344.83699506850996,
        waist: 288.4275696877253,
        lean: -482.793984746829,
        lean_to: 0.20442064687298206,
        width: 4534.5380406259255,
        height: 3000,
        ..CYLINDER
    });
}

/// How far a turn reached over was taken from the outlines; the thread below does not lie on them.
#[test]
fn what_hangs_over_the_thread_below_is_told() {
    let square = Pot { square: true, ..CYLINDER };
    tells_what_hangs(&Pot {
        radius: 53700.179333373846,
        twist: -0.005487990644737605,
        flare: 667.273454726326,
        waist: -2180.821920161889,
        lean: -1483.1652102449073,
        lean_to: 0.4504323494192552,
        layers: 5,
        base: 0,
        walls: 2,
        width: 5336.256843070644,
        height: 3000,
        ..square
    });
    tells_what_hangs(&Pot {
        radius: 48150.94621095246,
        twist: -0.0012422676544881117,
        flare: 0.016345324481345423,
        waist: -1032.0589177969835,
        lean: 842.892621231596,
        lean_to: 0.8858567082883079,
        layers: 8,
        base: 1,
        walls: 3,
        width: 2348.8053004385415,
        height: 800,
        ..square
    });
    tells_what_hangs(&Pot {
        radius: 90010.44939469827,
        twist: -0.0033121565008154743,
        flare: -1365.063805866593,
        waist: -1554.5012890686376,
        lean: 1460.1511472304305,
        lean_to: 0.9115806180564279,
        layers: 9,
        width: 4073.2876676689375,
        height: 2600,
        ..square
    });
}

/// The first turn began on its own outline, while the flat one below it ended on another.
#[test]
fn the_first_turn_comes_from_the_end_of_the_flat_one() {
    tells_what_hangs(&Pot {
        radius: 25759.24206054348,
        lobes: (0.13205243723172755, 6),
        twist: -0.01157843642562234,
        flare: 1141.1015131485071,
        waist: 2848.081706929198,
        lean: 877.6826267162133,
        lean_to: 0.16103930464934432,
        layers: 7,
        base: 0,
        walls: 3,
        width: 4042.7881649382703,
        height: 2660,
        ..CYLINDER
    });
}
