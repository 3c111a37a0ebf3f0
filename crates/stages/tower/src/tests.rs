use super::*;
use skein::{Facts, Layer, Line, Mark, Micron, Move, Nozzle, Point3, Reader, Tag};

const HEIGHT: i32 = 400;

/// The outline of a square and the wall in it, as fill writes an island.
fn island(x: i32, side: i32, z: i32) -> Vec<Line> {
    let corners = |low: i32, high: i32| [(low, low), (high, low), (high, high), (low, high)];
    let place = |(px, py): (i32, i32), z: i32| Point3 { x: x + px, y: py, z };
    let mut lines = vec![Line::Open(Tag::NestedRing), Line::Open(Tag::BoundaryPerimeter)];
    lines.extend(corners(0, side).map(|at| Line::Point(Mark::Boundary, place(at, z - HEIGHT / 2))));
    lines.extend([Line::Close(Tag::BoundaryPerimeter), Line::Open(Tag::Infill)]);
    let wall = corners(360, side - 360).map(|at| Line::Move(Move::to(place(at, z))));
    lines.extend([wall[0].clone(), Line::On]);
    lines.extend(wall[1..].iter().chain(&wall[..1]).cloned());
    lines.extend([Line::Off, Line::Close(Tag::Infill), Line::Close(Tag::NestedRing)]);
    lines
}

/// Layers with squares of 10 mm, one at each place.
fn print(count: i32, places: &[i32]) -> Skein {
    let layers = (1..=count).map(|layer| {
        let z = layer * HEIGHT;
        let mut lines = vec![Line::Layer(Micron(z - HEIGHT / 2)), Line::Open(Tag::Rotation)];
        lines.extend(places.iter().flat_map(|place| island(*place, 10_000, z)));
        lines.extend([Line::Close(Tag::Rotation), Line::Close(Tag::Layer)]);
        Layer { lines }
    });
    let head = vec![Line::Close(Tag::ExtruderInitialization)];
    let mut skein = Skein { head, layers: layers.collect(), ..Skein::default() };
    let facts =
        Facts { bead_width: Some(Micron(720)), layer_height: Some(Micron(HEIGHT)), ..Facts::default() };
    skein.state(&facts).expect("facts");
    skein
}

fn tower(height: u32) -> Tower {
    Tower { maximum_tower_height: height, ..Tower::default() }
}

fn craft(stage: &Tower, skein: &Skein) -> Skein {
    let crafted = stage.craft(skein.clone(), &mut Notes::default()).expect("tower");
    assert_eq!(crafted.verify(), Ok(()));
    assert_eq!(extruded(&crafted), extruded(skein), "a bead is gone, new or elsewhere");
    crafted
}

/// Every piece of bead with its place, sorted.
fn extruded(skein: &Skein) -> Vec<(Point3, Point3)> {
    let mut nozzle = Nozzle::default();
    let mut moves = Vec::new();
    for line in skein.lines() {
        let before = nozzle;
        nozzle.follow(line);
        if let (true, Some(step), Some(from)) = (nozzle.on, line.as_move(), before.at) {
            moves.push((from, step.to));
        }
    }
    moves.sort_by_key(|(from, to)| (from.z, from.x, from.y, to.x, to.y));
    moves
}

/// The islands in the order in which they are laid: their letter by x, and the height of the layer's middle.
fn order(skein: &Skein, pitch: i32) -> String {
    let mut words = Vec::new();
    for layer in &skein.layers {
        let mut nozzle = Nozzle::default();
        for line in &layer.lines {
            nozzle.follow(line);
            if let (Line::On, Some(at)) = (line, nozzle.at) {
                let letter = if at.x < pitch { 'A' } else { 'B' };
                words.push(format!("{letter}{:.1}", layer.z().mm()));
            }
        }
    }
    words.join(" ")
}

/// stages_tests.md TW1.
#[test]
fn tw1_towers_of_two_layers() {
    assert_eq!(
        order(&craft(&tower(2), &print(8, &[0, 70_000])), 60_000),
        "A0.2 B0.2 A0.6 A1.0 A1.4 B0.6 B1.0 B1.4 A1.8 A2.2 A2.6 B1.8 B2.2 B2.6 A3.0 B3.0"
    );
}

/// stages_tests.md TW2.
#[test]
fn tw2_towers_of_five_layers() {
    assert_eq!(
        order(&craft(&tower(5), &print(8, &[0, 70_000])), 60_000),
        "A0.2 B0.2 A0.6 A1.0 A1.4 A1.8 A2.2 A2.6 B0.6 B1.0 B1.4 B1.8 B2.2 B2.6 A3.0 B3.0"
    );
}

/// stages_tests.md TW3: the nozzle stands 0.2 above the middle of a layer.
#[test]
fn tw3_down_to_the_lower_tower_from_above_it() {
    let skein = craft(&tower(2), &print(8, &[0, 70_000]));
    let steps: Vec<Point3> = skein.lines().filter_map(Line::as_move).map(|step| step.to).collect();
    let first = steps.windows(2).position(|pair| pair[0].z > pair[1].z).expect("a way down");
    let corner = Point3 { x: 70_360, y: 360, z: 800 };
    assert_eq!(
        steps[first - 1..=first + 1],
        [Point3 { x: 360, y: 360, z: 1600 }, Point3 { z: 1600, ..corner }, corner]
    );
    // Whatever goes from tower to tower goes above everything that stands.
    let mut highest = 0;
    let mut nozzle = Nozzle::default();
    for line in skein.lines() {
        let before = nozzle;
        nozzle.follow(line);
        if let (Some(from), Some(step)) = (before.at, line.as_move()) {
            if (from.x < 60_000) != (step.to.x < 60_000) {
                assert!(from.z.max(step.to.z) >= highest && from.z.min(step.to.z) >= highest - HEIGHT / 10);
            }
            highest = if nozzle.on { highest.max(step.to.z) } else { highest };
        }
    }
}

/// stages_tests.md TW4.
#[test]
fn tw4_the_cone_limits_the_tower() {
    assert_eq!(
        order(&craft(&tower(9), &print(5, &[0, 12_000])), 11_000),
        "A0.2 B0.2 A0.6 A1.0 A1.4 B0.6 B1.0 B1.4 B1.8 A1.8"
    );
}

/// stages_tests.md TW5.
#[test]
fn tw5_skirt_raft_and_support_stay_first() {
    let mut skein = print(8, &[0, 70_000]);
    let mut reader = Reader::default();
    let text = "(<skirt>)\nG1 X-5 Y-5 Z0.8\nM101\nG1 X90 Y-5 Z0.8\nM103\n(</skirt>)";
    let skirt = text.lines().map(|line| reader.line(line.as_bytes()).expect("a line"));
    skein.layers[1].lines.splice(1..1, skirt);
    let crafted = craft(&tower(2), &skein);
    assert_eq!(crafted.layers[..2], skein.layers[..2]);
    assert!(order(&crafted, 60_000).ends_with("A1.0 A1.4 A1.8 B1.0 B1.4 B1.8 A2.2 A2.6 A3.0 B2.2 B2.6 B3.0"));
}

/// stages_tests.md TW6; `craft` compares the beads in every other test, too.
#[test]
fn tw6_every_bead_is_laid_once_and_where_it_was() {
    for height in 1..10 {
        for places in [&[0, 70_000][..], &[0, 12_000, 70_000], &[0]] {
            let skein = print(9, places);
            assert_eq!(extruded(&skein).len(), 9 * 4 * places.len());
            craft(&tower(height), &skein);
        }
    }
}

#[test]
fn whole_copies_when_the_cone_permits() {
    let stage = Tower { tower_start_layer: 0, ..tower(1_000_000) };
    let order = order(&craft(&stage, &print(8, &[0, 70_000])), 60_000);
    assert_eq!(order.find('B'), order.rfind('A').map(|last| last + 5), "{order}");
}

#[test]
fn one_island_and_islands_too_near_stay_as_they_are() {
    for skein in [print(8, &[0]), print(8, &[0, 10_500]), print(1, &[0, 70_000]), print(0, &[])] {
        assert_eq!(craft(&tower(5), &skein), skein);
    }
}

#[test]
fn what_is_not_carried_waits_for_its_layer() {
    // The third layer of A is another island, further than an overhang from what A has been.
    let mut skein = print(4, &[0, 70_000]);
    let layer = &mut skein.layers[2].lines;
    let mut moved = vec![layer[0].clone(), layer[1].clone()];
    moved.extend(island(30_000, 10_000, 1200).into_iter().chain(island(70_000, 10_000, 1200)));
    moved.extend([Line::Close(Tag::Rotation), Line::Close(Tag::Layer)]);
    *layer = moved;
    assert_eq!(order(&craft(&tower(5), &skein), 60_000), "A0.2 B0.2 A0.6 B0.6 B1.0 B1.4 A1.0 A1.4");
}

#[test]
fn lines_of_a_layer_are_written_once() {
    let mut skein = print(4, &[0, 70_000]);
    for layer in &mut skein.layers {
        let end = layer.lines.len() - 1;
        layer.lines.insert(end, Line::Verbatim("M118 done".into()));
        layer.lines.insert(1, Line::Verbatim("M117 begin".into()));
        layer.lines.insert(1, Line::Thickness(Micron(HEIGHT)));
    }
    let crafted = craft(&tower(2), &skein);
    assert_eq!(crafted.layers.len(), 7);
    for text in ["M117 begin", "M118 done"] {
        let line = Line::Verbatim(text.into());
        assert_eq!(crafted.lines().filter(|other| **other == line).count(), 4, "{text}");
    }
    assert!(crafted.layers.iter().all(|layer| layer.lines[1] == Line::Thickness(Micron(HEIGHT))));
}
