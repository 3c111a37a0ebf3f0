//! The laws of a base.

use super::measure::{Piece, nearest, turns};
use super::pot::{CYLINDER, Pot};
use super::wound;
use crate::{Base, Coil};

/// The shapes of base that are one thread, each laid both ways.
fn bases() -> impl Iterator<Item = (Pot, Coil)> {
    let forms = [
        CYLINDER,
        Pot { lobes: (0.14, 5), ..CYLINDER },
        Pot { square: true, radius: 40_000.0, ..CYLINDER },
        Pot { square: true, radius: 40_000.0, twist: 0.01, lean_to: 0.1, ..CYLINDER },
        Pot { radius: 60_000.0, lobes: (0.2, 2), ..CYLINDER },
    ];
    let ways = [Base::InAndOut, Base::ZigZag].map(|base| Coil { base, ..Coil::default() });
    let bases = forms.into_iter().flat_map(|pot| (1..=3).map(move |base| Pot { base, ..pot }));
    bases.flat_map(move |pot| ways.clone().map(|coil| (pot, coil)))
}

#[test]
fn a_base_holds_as_much_clay_as_it_has_room_for_and_goes_on_as_the_wall() {
    for (pot, coil) in bases() {
        let (skein, _) = wound(&pot, &coil);
        super::measure::is_one_rising_thread(&skein);
        let turns = turns(&skein);
        super::crosses_nothing(&turns, &pot, 0);
        for (layer, pieces) in turns[..pot.base].iter().enumerate() {
            let area = pot.outline(layer).area() * 1e6;
            let clay: f64 = pieces.iter().map(|piece| piece.length() * piece.flow * pot.width).sum();
            assert!((clay / area - 1.0).abs() < 0.01, "{clay} on {area} of layer {layer}: {pot:?} {coil:?}");
        }
        let end = turns[pot.base - 1].last().map(|piece| piece.to);
        assert_eq!(end, turns[pot.base].first().map(|piece| piece.from), "{pot:?} {coil:?}");
    }
}

#[test]
fn no_place_of_a_base_is_further_than_a_bead_from_its_thread() {
    for (pot, coil) in bases() {
        let (skein, _) = wound(&pot, &coil);
        let pieces: &Vec<Piece> = &turns(&skein)[0];
        let outline = pot.outline(0);
        for x in (-60_000..60_000).step_by(1_700) {
            for y in (-60_000..60_000).step_by(1_700) {
                if outline.contains(skein::Point::new(x, y)) {
                    let far = nearest(pieces, [f64::from(x), f64::from(y), 0.0]).0;
                    assert!(far < 0.95 * pot.width, "{far} from {x} {y}: {pot:?} {coil:?}");
                }
            }
        }
    }
}

/// A base of two layers on a disc of 15 mm rose by a layer on 0.02 mm of way and left 7.4 mm³ there.
#[test]
fn a_base_climbs_from_layer_to_layer_on_one_line_of_a_bead() {
    let small = Pot { radius: 15_000.0, width: 3_200.0, ..CYLINDER };
    let tiny = Pot { radius: 5_000.0, ..CYLINDER };
    let more = [small, tiny, Pot { square: true, ..tiny }].into_iter().flat_map(|pot| {
        let coils = [Base::InAndOut, Base::ZigZag].map(|base| Coil { base, ..Coil::default() });
        (2..=4).flat_map(move |base| coils.clone().map(|coil| (Pot { base, ..pot }, coil)))
    });
    for (pot, coil) in bases().chain(more) {
        let (skein, notes) = wound(&pot, &coil);
        if pot.radius < 10_000.0 && pot.square {
            assert!(notes.iter().any(|note| note.text.contains("too small")), "{pot:?}");
            continue;
        }
        let turns = turns(&skein);
        let pieces = turns[..pot.base].concat();
        let rises = |piece: &&Piece| piece.to.z > piece.from.z;
        assert_eq!(pieces.iter().filter(rises).count(), pot.base - 1, "{pot:?} {coil:?}");
        for piece in pieces.iter().filter(rises) {
            let rise = f64::from(piece.to.z - piece.from.z);
            let most = f64::from(pot.height) * piece.length() / (pot.width / 2.0);
            assert!(rise <= most, "{piece:?} of {pot:?} {coil:?}");
        }
        let whole: f64 = pieces.iter().map(|piece| piece.length() * piece.flow * pot.width).sum();
        let room: f64 = (0..pot.base).map(|layer| pot.outline(layer).area() * 1e6).sum();
        if pot.radius > 10_000.0 {
            assert!((whole / room - 1.0).abs() < 0.01, "{whole} in {room}: {pot:?} {coil:?}");
        }
    }
}
