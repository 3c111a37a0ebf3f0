use super::*;

/// stages_tests.md Y1 to Y3, in µm/min.
#[test]
fn y1_to_y3_a_move_is_faster_by_the_pause_that_it_waits() {
    let stage = Unpause::default();
    for (length, feed, wanted) in [
        (20.0, 960_000, 981_997),
        (50.0, 1_200_000, 1_213_592),
        (20.0, 1_200_000, 1_234_568),
        (1.0, 1_200_000, 1_560_000),
        (0.5, 960_000, 1_248_000),
        (0.0, 960_000, 960_000),
    ] {
        let faster = stage.faster(Feed::new(feed).expect("a feed"), length).expect("a speed");
        assert_eq!(faster.get(), wanted, "{length} mm");
    }
}
