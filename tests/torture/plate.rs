//! `clayforge mesh`, and parts that are turned and put side by side.

use super::shapes::{flipped, moved};
use super::{cube, read_slices};
use crate::command::Room;
use crate::support::{cuboid, stl};
use serde_json::Value as Json;
use std::fs;

/// What `mesh --json` says.
fn inspected(room: &Room, words: &[&str]) -> Json {
    let words: Vec<&str> = ["mesh"].iter().chain(words).chain(&["--json"]).copied().collect();
    let ran = room.run(&words).done();
    serde_json::from_slice(&ran.out).expect("JSON")
}

#[test]
fn a_mesh_is_described_and_repaired_into_a_file_that_is_sound() {
    let room = Room::new();
    let mut part = [cube(), flipped(&cuboid([40.0, 0.0, 0.0], [50.0, 10.0, 10.0]))].concat();
    part.remove(0);
    room.put("cup.stl", stl(&part));
    let found = inspected(&room, &["cup.stl"]);
    assert_eq!(found["size"], serde_json::json!([50.0, 20.0, 12.0]));
    assert_eq!(
        (&found["open_edges"], &found["holes"], &found["inside_out_shells"]),
        (&3.into(), &1.into(), &1.into())
    );
    assert_eq!((&found["sound"], &found["shells"]), (&false.into(), &2.into()));
    let found = inspected(&room, &["cup.stl", "--repair", "-o", "sound.stl"]);
    assert_eq!((&found["repairs"]["holes_closed"], &found["repaired"]["sound"]), (&1.into(), &true.into()));
    let again = inspected(&room, &["sound.stl"]);
    assert_eq!((&again["sound"], &again["volume_mm3"]), (&true.into(), &5800.0.into()));
    assert_eq!((&again["stands"], &again["overhang"]), (&true.into(), &Json::Null));
    // With one piece inside out the centre of mass is nowhere near; described is what the file has.
    let text = String::from_utf8(room.run(&["mesh", "cup.stl"]).done().out).expect("text");
    for line in ["not sound", "size      50.0 × 20.0 × 12.0 mm", "3 open edges", "thinnest", "stands    no"]
    {
        assert!(text.contains(line), "`{line}` is not in: {text}");
    }
}

#[test]
fn a_repair_needs_a_place_to_go_and_a_file_that_is_no_part_is_refused() {
    let room = Room::new();
    room.put("noise.stl", "nothing");
    assert_eq!(room.run(&["mesh", "noise.stl", "--repair"]).code, Some(2));
    let ran = room.run(&["mesh", "noise.stl"]);
    assert!(ran.code == Some(1) && ran.err.contains("noise.stl"), "{}", ran.err);
}

/// The least and greatest x and y of the first layer, in millimetres, for each of its loops.
fn boxes(room: &Room) -> Vec<[f64; 4]> {
    let slices = read_slices(&room.path("steps").join("01-carve.svg")).expect("slices");
    let mm = |micron: i32| f64::from(micron) / 1000.0;
    let of = |ring: &shape::Ring| {
        let (low, high) = ring.bounds().expect("points");
        [mm(low.x), mm(high.x), mm(low.y), mm(high.y)]
    };
    slices.layers[0].loops.iter().map(of).collect()
}

#[test]
fn several_parts_stand_side_by_side_in_the_middle_of_the_bed() {
    let room = Room::new();
    room.put("a.stl", stl(&cube()))
        .put("b.stl", stl(&moved(&cuboid([0.0; 3], [30.0, 10.0, 12.0]), [5.0, 5.0, 70.0])));
    room.run(&["slice", "a.stl", "b.stl", "a.stl", "-o", "all.gcode", "--dump", "steps"]).done();
    let placed = boxes(&room);
    assert_eq!(placed.len(), 3);
    for (index, one) in placed.iter().enumerate() {
        for other in &placed[..index] {
            let gap =
                (one[0] - other[1]).max(other[0] - one[1]).max(one[2] - other[3]).max(other[2] - one[3]);
            assert!((gap - 10.0).abs() < 1e-9 || gap > 10.0, "{gap} mm between {one:?} and {other:?}");
        }
    }
    let least = placed.iter().map(|at| at[0]).fold(f64::INFINITY, f64::min);
    let greatest = placed.iter().map(|at| at[1]).fold(0.0, f64::max);
    assert!((least + greatest - 200.0).abs() < 0.01, "{least} … {greatest} is not the middle");
    let first = fs::read(room.path("all.gcode")).expect("a file");
    room.run(&["slice", "a.stl", "b.stl", "a.stl", "-o", "all.gcode", "--threads", "1"]).done();
    assert_eq!(first, fs::read(room.path("all.gcode")).expect("a file"));
    let many = ["a.stl"; 50];
    let words: Vec<&str> = ["slice"].iter().chain(&many).chain(&["-o", "all.gcode"]).copied().collect();
    let ran = room.run(&words);
    assert!(ran.code == Some(1) && ran.err.contains("finds no room"), "{}", ran.err);
}

#[test]
fn a_part_is_turned_and_let_down() {
    let room = Room::new();
    room.put("lying.stl", stl(&moved(&cuboid([0.0; 3], [12.0, 20.0, 30.0]), [70.0, 60.0, 33.0])));
    room.run(&["slice", "lying.stl", "--rotate", "-90,0,0", "--drop", "-o", "a.gcode", "--dump", "steps"])
        .done();
    // Turned about its middle: x stays, what was deep is high.
    assert_eq!(boxes(&room), [[70.0, 82.0, 55.0, 85.0]]);
    room.run(&["slice", "lying.stl", "--center", "-o", "a.gcode", "--dump", "steps"]).done();
    assert_eq!(boxes(&room), [[94.0, 106.0, 90.0, 110.0]]);
    assert_eq!(room.run(&["slice", "lying.stl", "--rotate", "90,0"]).code, Some(2));
}
