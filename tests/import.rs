//! Parts of every format through the command: the same cup gives the same print.

use crate::command::{Ran, Room};
use crate::support::{Triangles, cuboid, stl};
use std::fmt::Write;

/// The part with its vertices numbered, as all formats but STL have it.
fn indexed(triangles: &Triangles) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let faces = triangles.iter().map(|triangle| {
        triangle.map(|corner| {
            vertices.iter().position(|known| *known == corner).unwrap_or_else(|| {
                vertices.push(corner);
                vertices.len() - 1
            })
        })
    });
    let faces = faces.collect();
    (vertices, faces)
}

fn obj(triangles: &Triangles) -> String {
    let (vertices, faces) = indexed(triangles);
    let mut text = String::new();
    vertices.iter().for_each(|[x, y, z]| _ = writeln!(text, "v {x} {y} {z}"));
    faces.iter().for_each(|[a, b, c]| _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1));
    text
}

fn ply(triangles: &Triangles) -> String {
    let (vertices, faces) = indexed(triangles);
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        vertices.len(),
        faces.len()
    );
    vertices.iter().for_each(|[x, y, z]| _ = writeln!(text, "{x} {y} {z}"));
    faces.iter().for_each(|[a, b, c]| _ = writeln!(text, "3 {a} {b} {c}"));
    text
}

fn model(triangles: &Triangles, unit: &str) -> String {
    let (vertices, faces) = indexed(triangles);
    let mut text = format!("<model unit=\"{unit}\"><resources><object id=\"1\"><mesh><vertices>");
    vertices.iter().for_each(|[x, y, z]| _ = write!(text, "<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>"));
    text += "</vertices><triangles>";
    faces.iter().for_each(|[a, b, c]| _ = write!(text, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>"));
    text + "</triangles></mesh></object></resources><build><item objectid=\"1\"/></build></model>"
}

fn amf(triangles: &Triangles) -> String {
    let (vertices, faces) = indexed(triangles);
    let mut text = "<?xml version=\"1.0\"?><amf><object id=\"1\"><mesh><vertices>".to_owned();
    for [x, y, z] in vertices {
        _ = write!(text, "<vertex><coordinates><x>{x}</x><y>{y}</y><z>{z}</z></coordinates></vertex>");
    }
    text += "</vertices><volume>";
    faces.iter().for_each(|[a, b, c]| {
        _ = write!(text, "<triangle><v1>{a}</v1><v2>{b}</v2><v3>{c}</v3></triangle>");
    });
    text + "</volume></mesh></object></amf>"
}

fn part() -> Triangles {
    cuboid([0.0; 3], [40.0, 30.0, 12.0])
}

/// What lies in the file for the machine when a part is sliced.
fn gcode(room: &Room, name: &str, bytes: &[u8], words: &[&str]) -> (String, Ran) {
    room.put(name, bytes);
    let ran = room.run(&[&["slice", name, "-o", "-"], words].concat()).done();
    (ran.out(), ran)
}

#[test]
fn every_format_gives_the_same_print() {
    let room = Room::new();
    let (expected, _) = gcode(&room, "part.stl", &stl(&part()), &[]);
    for (name, text) in [
        ("part.obj", obj(&part())),
        ("part.ply", ply(&part())),
        ("part.model", model(&part(), "millimeter")),
        ("part.amf", amf(&part())),
    ] {
        let (found, ran) = gcode(&room, name, text.as_bytes(), &[]);
        assert_eq!(found, expected, "{name}");
        assert!(!ran.err.contains("import:"), "{name}: {}", ran.err);
    }
    // The layers of one are sliced as they are.
    room.run(&["slice", "part.stl", "--until", "carve", "-o", "layers.svg"]).done();
    assert_eq!(room.run(&["slice", "layers.svg", "-o", "-"]).done().out(), expected);
}

#[test]
fn a_file_is_what_its_bytes_say() {
    let room = Room::new();
    let (expected, _) = gcode(&room, "part.stl", &stl(&part()), &[]);
    let (found, ran) = gcode(&room, "wrong.stl", obj(&part()).as_bytes(), &[]);
    assert_eq!(found, expected);
    assert!(ran.err.contains("called .stl and holds OBJ"), "{}", ran.err);
    // One stage by itself reads what `slice` reads.
    room.run(&["slice", "part.stl", "--until", "carve", "-o", "layers.svg"]).done();
    let carved = room.run(&["craft", "carve", "wrong.stl"]).done().out();
    assert_eq!(carved, crate::support::text_of(&room.path("layers.svg")));
    room.put("part.amf", amf(&part()).as_bytes());
    assert_eq!(room.run(&["craft", "carve", "part.amf"]).done().out(), carved);
}

#[test]
fn units_are_those_of_the_file_unless_the_user_says_otherwise() {
    let room = Room::new();
    let (expected, _) = gcode(&room, "part.stl", &stl(&part()), &[]);
    let small: Triangles = part()
        .into_iter()
        .map(|triangle| triangle.map(|corner| corner.map(|length| length / 10.0)))
        .collect();
    let (found, _) = gcode(&room, "part.model", model(&small, "centimeter").as_bytes(), &[]);
    assert_eq!(found, expected);
    let (found, _) = gcode(&room, "small.obj", obj(&small).as_bytes(), &["--set", "import.unit=cm"]);
    assert_eq!(found, expected);
    let ran = room.run(&[
        "slice",
        "small.obj",
        "-o",
        "-",
        "--set",
        "carve.layer_height=0.5",
        "--set",
        "carve.first_layer_height=0.5",
    ]);
    assert!(ran.err.contains("--set import.unit=inch"), "{}", ran.err);
    let ran = room.run(&["slice", "small.obj", "--set", "import.unit=cubit"]);
    assert!(ran.code == Some(1) && ran.err.contains("is none of \"file\""), "{}", ran.err);
    assert!(room.run(&["explain", "import.unit"]).done().out().contains("metres or inches"));
}

#[test]
fn what_is_no_part_is_named() {
    let room = Room::new();
    for (name, bytes, words) in [
        ("page.stl", &b"<!DOCTYPE html><html>Not found</html>"[..], "a web page"),
        ("part.step", b"ISO-10303-21;\nHEADER;", "a STEP model"),
        ("part.3mf", b"PK\x03\x04 and no more", "damaged or cut short"),
        ("part.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "line 4: a face has the vertex 9"),
        ("old.gcode", b"; made yesterday\nG28\nG1 X1\n", "G-code"),
        ("part.svg", b"<svg xmlns='http://www.w3.org/2000/svg'><circle r='5'/></svg>", "svg"),
    ] {
        room.put(name, bytes);
        let ran = room.run(&["slice", name, "-o", "out.gcode"]);
        assert_eq!(ran.code, Some(1), "{name}");
        assert!(
            ran.err.contains(name) && ran.err.contains(words) && ran.err.contains("hint:"),
            "{}",
            ran.err
        );
        assert!(!room.path("out.gcode").exists(), "{name}");
    }
}
