//! The same part in every format, and what each format has of its own.

mod support;

use import::{ErrorKind, FileUnit, Format, Import, Place};
use proptest::prelude::*;
use shape::Point3;
use support::*;

#[test]
fn every_format_gives_the_same_cube() {
    for (name, bytes) in all(&cube()) {
        let part = read(bytes);
        assert_eq!(part.mesh, read(stl(&cube())).mesh, "{name}");
        assert_eq!((part.report.facets, part.notes()), (12, Vec::new()), "{name}");
    }
}

#[test]
fn every_format_is_recognised_by_its_bytes() {
    use Format::{Amf, BinaryStl, Obj, TextStl, ThreeMf};
    const PLY: Format = Format::Ply;
    let formats: Vec<Format> = all(&cube()).iter().map(|(_, bytes)| read(bytes).report.format).collect();
    assert_eq!(formats, [BinaryStl, TextStl, Obj, PLY, PLY, PLY, ThreeMf, ThreeMf, Amf, Amf]);
    assert_eq!(PLY.misnamed("ply"), None);
    assert_eq!(PLY.misnamed("part"), None);
    let note = PLY.misnamed("STL").expect("a note");
    assert_eq!(note, "the file is called .stl and holds PLY: it was read as what it is");
}

/// A cut binary file is refused; in a cut text the last number may have lost its end, and nobody can know.
#[test]
fn a_file_that_was_cut_is_never_a_smaller_part() {
    for (name, bytes) in all(&cube()).into_iter().filter(|(name, _)| *name != "obj") {
        let whole = read(&bytes).mesh;
        let blanks = bytes.iter().rev().take_while(|byte| byte.is_ascii_whitespace()).count();
        for length in 0..bytes.len() - blanks {
            if let Ok(part) = Import::default().read(&bytes[..length]) {
                // The last word may end early, as in `3 1 12`, which is `3 1 1`, and a name behind `endsolid`.
                let late = length + 8 > bytes.len();
                assert!(part.mesh == whole || (name == "text ply" && late), "{name}: {length} bytes");
            }
        }
    }
}

#[test]
fn units_of_the_file_and_of_the_user() {
    let size = |import: &Import, bytes: &[u8]| {
        import.read(bytes).unwrap_or_else(|error| panic!("{error}")).mesh.bounds().max.x
    };
    for (word, expected) in [
        ("micron", 20),
        ("centimeter", 200_000),
        ("inch", 508_000),
        ("foot", 6_096_000),
        ("meter", 20_000_000),
    ] {
        let text = model(&cube()).replace("millimeter", word);
        assert_eq!(size(&Import::default(), &package(&text)), expected, "{word}");
    }
    let amf = String::from_utf8(amf(&cube())).expect("text").replace("millimeter", "Inch");
    assert_eq!(size(&Import::default(), amf.as_bytes()), 508_000);
    for (unit, expected) in [
        (FileUnit::Um, 20),
        (FileUnit::Mm, 20_000),
        (FileUnit::Cm, 200_000),
        (FileUnit::Inch, 508_000),
        (FileUnit::Foot, 6_096_000),
        (FileUnit::M, 20_000_000),
    ] {
        for (name, bytes) in all(&cube()) {
            assert_eq!(size(&Import { unit }, &bytes), expected, "{name}");
        }
        assert_eq!(size(&Import { unit }, amf.as_bytes()), expected);
    }
    let error = refusal(package(&model(&cube()).replace("millimeter", "furlong")));
    assert_eq!(error.to_string(), "`furlong` is no unit (3D/part.model, line 2)");
}

#[test]
fn a_size_that_no_pot_has_is_asked_about() {
    let doubt = |edge: f32| read(stl(&cuboid(edge, edge / 2.0, edge))).notes().concat();
    assert_eq!(
        doubt(4.0),
        "the part is 4.0 × 2.0 × 4.0 mm; if it was drawn in inches, read it with --set import.unit=inch"
    );
    assert!(doubt(0.12).contains("metres, read it with --set import.unit=m"));
    assert!(doubt(90_000.0).contains("--set import.unit=um"));
    assert_eq!(doubt(20.0), "");
}

// OBJ.

const SQUARE_PYRAMID: &str = "v 0 0 0\nv 30 0 0\nv 30 30 0\nv 0 30 0\nv 15 15 30\n";

#[test]
fn obj_polygons_and_indices_from_either_end() {
    let faces = ["f 4 3 2 1", "f 1 2 5", "f 2 3 5", "f 3 4 5", "f 4 1 5"].join("\n");
    let plain = read(format!("{SQUARE_PYRAMID}{faces}"));
    assert_eq!((plain.mesh.faces.len(), plain.mesh.open_edges(), plain.mesh.volume()), (6, 0, 9000.0));
    for faces in [
        "f -2 -3 -4 -5\nf -5 -4 -1\nf -4 -3 -1\nf -3 -2 -1\nf -2 -5 -1".to_owned(),
        faces.replace(' ', "\t").replace('\n', "\r\n"),
        faces.replace('\n', "\ng side\nusemtl clay\n"),
        faces.replace("f 4 3 2 1", "f 4/1/1 3/2/1 2//1 \\\n 1/4"),
        faces.replace("4 1 5", "4 1 5 # the last"),
    ] {
        assert_eq!(read(format!("{SQUARE_PYRAMID}{faces}")).mesh, plain.mesh, "{faces}");
    }
    // Faces before their vertices, as few programs write them.
    assert_eq!(read(format!("{faces}\n{SQUARE_PYRAMID}")).mesh.volume(), 9000.0);
}

#[test]
fn obj_concave_polygons_keep_their_form() {
    let outline = [[0, 0], [30, 0], [30, 30], [15, 5], [0, 30]];
    let mut text = String::new();
    for z in [0, 10] {
        for [x, y] in outline {
            text += &format!("v {x} {y} {z}\n");
        }
    }
    text += "f 5 4 3 2 1\nf 6 7 8 9 10\n";
    for side in 1..=5 {
        let next = side % 5 + 1;
        text += &format!("f {side} {next} {} {}\n", next + 5, side + 5);
    }
    let part = read(&text);
    assert_eq!((part.mesh.open_edges(), part.mesh.volume(), part.report.crossed), (0, 5250.0, 0));
    // Twice the area of the five corners, top and bottom, and the sides: no triangle is turned over.
    let around: f64 = 3.0 * 30.0 + 2.0 * (15.0f64 * 15.0 + 25.0 * 25.0).sqrt();
    assert!((part.mesh.area() - (2.0 * 525.0 + 10.0 * around)).abs() < 0.01, "{}", part.mesh.area());
}

#[test]
fn obj_errors_have_a_line() {
    let faces = "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    for (face, kind, line) in [
        ("f 1 2 6", ErrorKind::Missing, 10),
        ("f 1 2 -6", ErrorKind::Missing, 10),
        ("f 0 1 2", ErrorKind::Missing, 10),
        ("f 1 2\n", ErrorKind::Syntax, 10),
        ("f 1 x 2\n", ErrorKind::Syntax, 10),
        ("v 1 2\n", ErrorKind::Syntax, 10),
        ("v 1 2 three\n", ErrorKind::Syntax, 10),
        ("v 1 nan 2\n", ErrorKind::NotFinite, 10),
        ("v 1 1e9 2\n", ErrorKind::TooFar, 10),
    ] {
        let error = refusal(format!("{SQUARE_PYRAMID}{faces}{face}"));
        assert_eq!((error.kind, &error.place), (kind, &Place::Line(line)), "{face}: {error}");
    }
    assert_eq!(refusal("v 0 0 0\nv 1 0 0\n").kind, ErrorKind::NoFacets);
    let curves = refusal("v 0 0 0\ncstype bspline\nsurf 0 1 0 1 1 2\n");
    assert!(curves.message.contains("free-form"), "{curves}");
    let report = read(format!("{SQUARE_PYRAMID}{faces}f 4 3 2 1\nwhat is this\ncurv 0 1 1 2")).report;
    assert_eq!(report.notes().len(), 2);
}

// PLY.

#[test]
fn ply_has_any_properties_and_elements() {
    let text = "ply\r\nformat ascii 1.0\r\nobj_info by hand\r\nelement camera 1\r\nproperty list uchar float view\r\n\
        element vertex 5\r\nproperty double confidence\r\nproperty double z\r\nproperty list int short marks\r\n\
        property float64 x\r\nproperty float32 y\r\nelement nothing 9000000000\r\nelement face 5\r\n\
        property uchar flags\r\nproperty list uint8 uint32 vertex_index\r\nproperty list uchar float texcoord\r\n\
        end_header\r\n3 1 2 3\r\n.5 0 0 0 0\r\n.5 0 1 7 30 0\r\n.5 0 0 30 30\r\n.5 0 0 0 30\r\n.5 30 2 8 9 15 15\r\n\
        0 4 3 2 1 0 0\r\n1 3 0 1 4 2 .1 .2\r\n1 3 1 2 4 0\r\n1 3 2 3 4 0\r\n1 3 3 0 4 0\r\n";
    let part = read(text);
    assert_eq!((part.mesh.faces.len(), part.mesh.open_edges(), part.mesh.volume()), (6, 0, 9000.0));
    assert_eq!(read(text.replace("\r\n", "\n")).mesh, part.mesh);
    assert_eq!(part.notes(), Vec::<String>::new());
}

#[test]
fn ply_binary_of_any_types() {
    let header = |count: &str, index: &str| {
        format!(
            "ply\nformat binary_big_endian 1.0\nelement face 4\nproperty list {count} {index} vertex_indices\n\
             property float quality\nelement vertex 4\nproperty list uchar uchar marks\nproperty double x\n\
             property double y\nproperty short z\nend_header\n"
        )
    };
    let faces = [[0u8, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let points = [[0.0f64, 0.0, 0.0], [30.0, 0.0, 0.0], [0.0, 30.0, 0.0], [0.0, 0.0, 30.0]];
    let mut seen = Vec::new();
    for (index, width) in [("uchar", 1), ("short", 2), ("uint", 4)] {
        let mut bytes = header("int", index).into_bytes();
        for face in faces {
            bytes.extend(3i32.to_be_bytes());
            for corner in face {
                bytes.extend(&u32::from(corner).to_be_bytes()[4 - width..]);
            }
            bytes.extend(1.0f32.to_be_bytes());
        }
        for [x, y, z] in points {
            bytes.extend([2, 8, 9]);
            bytes.extend([x.to_be_bytes(), y.to_be_bytes()].concat());
            bytes.extend((z as i16).to_be_bytes());
        }
        let part = read(&bytes);
        assert_eq!((part.mesh.open_edges(), part.mesh.volume()), (0, 4500.0));
        bytes.extend([1, 2, 3]);
        assert_eq!(read(&bytes).report.trailing, 3);
        seen.push(part.mesh);
    }
    assert!(seen.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn ply_strips_of_triangles() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
        0 0 0\n30 0 0\n0 30 0\n0 0 30\n10 0 2 1 3 -1 1 3 0 2 -1\n";
    let mesh = read(text).mesh;
    assert_eq!((mesh.faces.len(), mesh.open_edges(), mesh.volume()), (4, 0, 4500.0));
}

#[test]
fn ply_errors_say_what_and_where() {
    let cube = String::from_utf8(text_ply(&cube())).expect("text");
    for (from, to, kind, place) in [
        ("element face 12", "element face 13", ErrorKind::Truncated, Place::Line(32)),
        ("3 0 1 2", "3 0 1 8", ErrorKind::Missing, Place::Line(20)),
        ("3 0 1 2", "3 0 1 -1", ErrorKind::Missing, Place::Line(20)),
        ("3 0 1 2", "3 0 1 x", ErrorKind::Syntax, Place::Line(20)),
        ("3 0 1 2", "-3 0 1 2", ErrorKind::Syntax, Place::Line(20)),
        ("property float z\n", "", ErrorKind::Syntax, Place::File),
        ("property float z", "property float128 z", ErrorKind::Syntax, Place::Line(7)),
        ("20 20 0 200", "20 inf 0 200", ErrorKind::NotFinite, Place::Line(14)),
        ("20 20 0 200", "20 1e7 0 200", ErrorKind::TooFar, Place::Line(14)),
        ("ascii", "utf8", ErrorKind::Syntax, Place::Line(2)),
        ("end_header", "end", ErrorKind::Syntax, Place::Line(11)),
        ("element vertex", "element vertices", ErrorKind::Syntax, Place::File),
    ] {
        assert!(cube.contains(from), "{from}");
        let error = refusal(cube.replacen(from, to, 1));
        assert_eq!((error.kind, &error.place), (kind, &place), "{to}: {error}");
    }
    let cloud = cube.replace("element face 12\nproperty list uchar int vertex_indices\n", "");
    assert!(refusal(cloud).message.contains("cloud of points"));
    let mut bytes = binary_ply(&support::cube(), false);
    let at = bytes.len() - 12 * 13 - 8 * 13;
    bytes[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    let error = refusal(&bytes);
    assert_eq!((error.kind, &error.place), (ErrorKind::NotFinite, &Place::Facet { number: 1, byte: at }));
}

/// A header may promise anything.
#[test]
fn ply_counts_are_not_believed() {
    for count in ["18446744073709551615", "4294967295", "999999999999999999", "200000000"] {
        for bytes in [text_ply(&cube()), binary_ply(&cube(), true)] {
            let text: Vec<u8> = [b"element face ", count.as_bytes()].concat();
            let at = bytes.windows(15).position(|window| window == b"element face 12").expect("there");
            let lying = [&bytes[..at], &text, &bytes[at + 15..]].concat();
            let kind = refusal(lying).kind;
            assert!(matches!(kind, ErrorKind::Truncated | ErrorKind::Syntax), "{count}: {kind:?}");
        }
    }
}

// 3MF.

/// A model of a cube as object 1, with other resources and another build.
fn with(resources: &str, build: &str) -> Vec<u8> {
    let text = model(&cube()).replace("</resources>", &format!("{resources}</resources>"));
    package(&text.replace("<item objectid=\"1\"/>", build))
}

fn bounds(bytes: impl AsRef<[u8]>) -> [[i32; 3]; 2] {
    let bounds = read(bytes).mesh.bounds();
    [bounds.min, bounds.max].map(|Point3 { x, y, z }| [x, y, z].map(|length| length / 1000))
}

#[test]
fn threemf_items_and_components_are_placed() {
    let turned = "transform=\"0 1 0 -1 0 0 0 0 1 100 0 5.5\"";
    let one = with("", &format!("<item objectid=\"1\" {turned}/>"));
    assert_eq!(bounds(&one), [[80, 0, 5], [100, 20, 25]]);
    assert_eq!(read(&one).mesh.volume(), 8000.0);
    // Scaled by two in the component, then moved by the item; and the cube as it is.
    let two = with(
        "<object id=\"2\"><components><component objectid=\"1\" transform=\"2 0 0 0 2 0 0 0 2 10 0 0\"/>\
         <component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 -50 0 0\"/></components></object>",
        &format!("<item objectid=\"2\" {turned}/>"),
    );
    assert_eq!(bounds(&two), [[60, -50, 5], [100, 50, 45]]);
    assert_eq!(read(&two).mesh.volume(), 9.0 * 8000.0);
}

#[test]
fn threemf_mirrors_keep_the_inside_inside() {
    let mirrored = with("", "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>");
    assert_eq!((bounds(&mirrored), read(&mirrored).mesh.volume()), ([[-20, 0, 0], [0, 20, 20]], 8000.0));
}

#[test]
fn threemf_what_is_scaled_up_keeps_its_form() {
    let small = cuboid(0.0123, 0.0456, 0.0789);
    let text = model(&small)
        .replace("objectid=\"1\"/>", "objectid=\"1\" transform=\"1000 0 0 0 1000 0 0 0 1000 0 0 0\"/>");
    let size = read(package(&text)).mesh.bounds().max;
    assert_eq!(size, Point3 { x: 12_300, y: 45_600, z: 78_900 });
}

#[test]
fn threemf_what_is_not_to_be_printed() {
    let helper = "<object id=\"2\" type=\"support\"><mesh><vertices/><triangles/></mesh></object>";
    let build = "<item objectid=\"1\"/><item objectid=\"2\"/><item objectid=\"1\" printable=\"0\" \
                 transform=\"1 0 0 0 1 0 0 0 1 90 0 0\"/>";
    let part = assert_cube(with(helper, build));
    assert_eq!(part.report.notes().len(), 2);
    let part = assert_cube(with("", ""));
    assert_eq!(part.notes(), ["the file does not say what to build: all its objects are taken"]);
}

/// The production extension, as newer slicers write it.
#[test]
fn threemf_objects_in_other_files() {
    let root = "<model unit=\"millimeter\" xmlns:p=\"x\"><resources><object id=\"8\"><components>\
        <component p:path=\"/3D/Objects/a.model\" objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0 7\"/></components>\
        </object></resources><build><item objectid=\"8\"/></build></model>";
    let bytes = archive(&[
        ("3D/part.model", root),
        ("_rels/.rels", RELATIONS),
        ("3D/Objects/a.model", &model(&cube())),
    ]);
    assert_eq!(bounds(bytes), [[0, 0, 7], [20, 20, 27]]);
    let error = refusal(archive(&[("3D/part.model", root), ("_rels/.rels", RELATIONS)]));
    assert_eq!(error.message, "the archive has no `3D/Objects/a.model`");
}

#[test]
fn threemf_extensions_are_passed_over() {
    let text = model(&cube())
        .replace("<build>", "<s:slicestack id=\"9\"><s:slice><s:vertices><s:vertex x=\"x\"/></s:vertices></s:slice></s:slicestack><build>");
    assert_cube(package(&text));
}

#[test]
fn threemf_errors_say_what_and_where() {
    for (from, to, words) in [
        (
            "v1=\"0\"",
            "v1=\"8\"",
            "a face has the vertex `8`, and there are 8 vertices (3D/part.model, line 14)",
        ),
        ("v1=\"0\"", "v1=\"-1\"", "`-1`"),
        ("v1=\"0\"", "", "a triangle has not all of v1, v2, v3"),
        ("x=\"0\"", "x=\"null\"", "`null`"),
        ("x=\"0\"", "x=\"1e300\"", "more than 1000000 mm"),
        ("x=\"0\"", "x=\"one\"", "`one` is no number"),
        ("<item objectid=\"1\"/>", "<item objectid=\"7\"/>", "`3D/part.model#7` is to be placed"),
        ("<item objectid=\"1\"/>", "<item/>", "has no `objectid`"),
        ("<item objectid=\"1\"/>", "<item objectid=\"1\" transform=\"1 0 0\"/>", "twelve numbers"),
        ("</vertices>", "</vertexes>", "no sound XML"),
        ("</model>", "", "truncated"),
    ] {
        let text = model(&cube());
        assert!(text.contains(from), "{from}");
        let error = refusal(package(&text.replacen(from, to, 1)));
        assert!(error.to_string().contains(words), "{to}: {error}");
    }
}

// Bombs.

#[test]
fn objects_in_themselves_and_copies_of_copies_are_refused() {
    let circle = "<object id=\"2\"><components><component objectid=\"3\"/></components></object>\
        <object id=\"3\"><components><component objectid=\"2\"/></components></object>";
    assert!(refusal(with(circle, "<item objectid=\"2\"/>")).message.contains("stands in itself"));
    let mut doubled = String::new();
    for id in 2..40 {
        let below = format!("<component objectid=\"{}\"/>", id - 1);
        doubled += &format!("<object id=\"{id}\"><components>{below}{below}</components></object>");
    }
    let error = refusal(with(&doubled, "<item objectid=\"39\"/>"));
    assert_eq!(error.kind, ErrorKind::TooLarge);
}

#[test]
fn archives_that_unpack_to_too_much_are_refused() {
    let blanks = |count: usize| " ".repeat(count);
    let with = |inside: String| package(&model(&cube()).replace("</model>", &format!("{inside}</model>")));
    assert_cube(with(format!("<a>{}</a>", blanks(8 << 20))));
    let error = refusal(with(format!("<a>{}</a>", blanks(20 << 20))));
    assert_eq!(
        (error.kind, error.message.contains("one tag or text")),
        (ErrorKind::TooLarge, true),
        "{error}"
    );
    let error = refusal(with(format!("<a>{}</a>", blanks(8 << 20)).repeat(30)));
    assert_eq!(
        (error.kind, error.message.contains("a hundred times")),
        (ErrorKind::TooLarge, true),
        "{error}"
    );
}

#[test]
fn entities_are_not_unfolded() {
    let laughs: String = (1..60)
        .map(|level| format!("<!ENTITY l{level} \"{}\">", format!("&l{};", level - 1).repeat(10)))
        .collect();
    let text = model(&cube())
        .replacen("<model", &format!("<!DOCTYPE m [<!ENTITY l0 \"ha\">{laughs}]><model"), 1)
        .replace("a &lt;part&gt;", "&l59;");
    assert_cube(package(&text));
}

// AMF.

#[test]
fn amf_constellations_place_objects() {
    let text = String::from_utf8(amf(&cube())).expect("text");
    let place = |inside: &str| {
        let constellation = format!(
            "<constellation id=\"9\"><instance objectid=\"0\">{inside}</instance></constellation></amf>"
        );
        text.replace("</amf>", &constellation)
    };
    assert_eq!(bounds(place("<deltax>5</deltax><deltaz>-1</deltaz>")), [[5, 0, -1], [25, 20, 19]]);
    // x becomes y, then the whole moves.
    assert_eq!(bounds(place("<rz>90</rz><deltax>50</deltax>")), [[30, 0, 0], [50, 20, 20]]);
    assert_eq!(bounds(place("<rx>-90</rx>")), [[0, 0, -20], [20, 20, 0]]);
    assert_eq!(bounds(place("<ry>45</ry>"))[1], [28, 20, 14]);
    assert_eq!(bounds(place("<scale>2</scale><scalez>0.5</scalez>"))[1], [40, 40, 10]);
    assert!(
        refusal(
            text.replace(
                "</amf>",
                "<constellation id=\"9\"><instance objectid=\"4\"/></constellation></amf>"
            )
        )
        .message
        .contains("`4` is to be placed")
    );
    let curved = text.replace("</coordinates>", "</coordinates><normal><nx>0</nx></normal>");
    assert_eq!(read(curved).notes().len(), 1);
}

#[test]
fn amf_volumes_and_objects_are_one_part() {
    let text = String::from_utf8(amf(&cube())).expect("text");
    let (before, after) = text.split_at(text.find("<triangle><v1>4").expect("a triangle"));
    assert_eq!(assert_cube(format!("{before}</volume><volume>{after}")).report.solids, 2);
    let object = &text[text.find("<object").expect("it")..text.find("</amf>").expect("it")];
    let moved = object.replace("id=\"0\"", "id=\"1\"").replace("20", "90");
    assert_eq!(bounds(text.replace("</amf>", &format!("{moved}</amf>"))), [[0; 3], [90; 3]]);
    let error = refusal(text.replace("</amf>", &format!("{object}</amf>")));
    assert!(error.message.contains("two objects have the name `0`"), "{error}");
}

// What is no part.

#[test]
fn other_files_are_called_by_their_name() {
    let iges = format!("{:72}S      1\n", "a pot");
    for (bytes, name) in [
        (&b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"[..], "PNG"),
        (b"\x1f\x8b\x08\0", "gzip"),
        (b"\n <!DOCTYPE html><html><body>vertex 1 2 3</body></html>", "web page"),
        (b"<?xml version='1.0'?><!-- x --><COLLADA xmlns='x'/>", "COLLADA"),
        (b"<?xml version='1.0'?><unknown/>", "unknown kind"),
        (b"ISO-10303-21;\nHEADER;\n", "STEP"),
        (iges.as_bytes(), "IGES"),
        (b"3D Geometry File Format        4", "Rhino"),
        (b"BLENDER-v300", "Blender"),
        (b"glTF\x02\0\0\0", "glTF"),
        (b"  0\nSECTION\n  2\nHEADER\n", "DXF"),
        (b"; a remark\n\nG28\nG1 X1 Y2\n", "G-code"),
        (b"(<alteration>)\n", "skein"),
        (b"\xff\xfes\0o\0l\0i\0d\0", "UTF-16"),
        (b"solid", "truncated"),
        (b"nothing that anybody knows", "no mesh"),
    ] {
        let error = refusal(bytes);
        assert!(error.message.contains(name), "{name}: {error}");
    }
    for (files, words) in [
        (&[("cup.stl", "solid")][..], "a ZIP archive with `cup.stl` in it"),
        (&[("Document.xml", ""), ("GuiDocument.xml", "")], "FreeCAD"),
        (&[("[Content_Types].xml", ""), ("word/document.xml", "")], "office"),
        (&[], "damaged"),
    ] {
        let error = refusal(if files.is_empty() { b"PK\x03\x04what".to_vec() } else { archive(files) });
        assert!(error.message.contains(words), "{words}: {error}");
    }
}

fn triangles() -> impl Strategy<Value = Vec<Triangle>> {
    let number = prop_oneof![(-8i8..8).prop_map(f32::from), -500.0f32..500.0, Just(-0.0f32)];
    prop::collection::vec(prop::array::uniform3(prop::array::uniform3(number)), 1..20)
}

proptest! {
    #[test]
    fn all_formats_agree(triangles in triangles()) {
        let expected = Import::default().read(&stl(&triangles));
        for (name, bytes) in all(&triangles) {
            let found = Import::default().read(&bytes);
            match (&expected, found) {
                (Ok(expected), Ok(found)) => {
                    prop_assert_eq!(&expected.mesh, &found.mesh, "{}", name);
                    prop_assert_eq!(expected.report.degenerate, found.report.degenerate);
                }
                (Err(expected), Err(found)) => prop_assert_eq!(expected, &found, "{}", name),
                (expected, found) => prop_assert!(false, "{expected:?} but {name}: {found:?}"),
            }
        }
    }

    #[test]
    fn no_bytes_bring_it_down(
        start in prop::sample::select(vec![&b""[..], b"ply\n", b"PK\x03\x04", b"<amf>", b"<model", b"v 1 2 3\nf ", b"<svg "]),
        bytes in prop::collection::vec(any::<u8>(), 0..400),
    ) {
        let bytes = [start, &bytes].concat();
        let _ = Import::default().read(&bytes);
        for format in [Format::TextStl, Format::BinaryStl, Format::Obj, Format::Ply, Format::ThreeMf, Format::Amf] {
            let _ = Import::default().read_as(format, &bytes);
        }
    }

    #[test]
    fn no_damage_brings_it_down(
        which in 0usize..10, places in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in any::<prop::sample::Index>(), insert in "[0-9a-z<>/= \n.\"-]{0,6}",
    ) {
        let (_, mut bytes) = all(&cube()).swap_remove(which);
        for (place, byte) in places {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        let _ = Import::default().read(&bytes);
        let cut = cut.index(bytes.len());
        let _ = Import::default().read(&bytes[..cut]);
        bytes.splice(cut..cut, insert.bytes());
        let _ = Import::default().read(&bytes);
    }

    #[test]
    fn no_words_bring_it_down(words in prop::collection::vec(prop::sample::select(vec![
        "v", "f", "1", "-1", "2/3/4", "\\\n", "\n", "#", "o", "0.5", "surf", "1e9", "nan", "\r\n", "é", "\0", "v 1 2 3\n", "f 1 2 3\n",
    ]), 0..80)) {
        let _ = Import::default().read(words.join(" ").as_bytes());
        let _ = Import::default().read(format!("v 0 0 0\nv 9 0 0\nv 0 9 0\nv 9 9 9\n{}", words.join(" ")).as_bytes());
    }

    #[test]
    fn no_header_brings_it_down(words in prop::collection::vec(prop::sample::select(vec![
        "element vertex 3", "element face 1", "element vertex 99999999999", "property list uchar int vertex_indices",
        "property float x", "property float y", "property double z", "property list int uchar marks", "end_header",
        "comment", "format ascii 1.0", "3 0 1 2", "0 0 0", "9 0 0", "0 9 0", "\0\0\0\0\0\0",
    ]), 0..30), binary in any::<bool>()) {
        let format = if binary { "binary_little_endian" } else { "ascii" };
        let _ = Import::default().read(format!("ply\nformat {format} 1.0\n{}", words.join("\n")).as_bytes());
    }

    #[test]
    fn no_tags_bring_it_down(words in prop::collection::vec(prop::sample::select(vec![
        "<object id='1'>", "</object>", "<mesh>", "</mesh>", "<vertex x='1' y='2' z='3'/>", "<triangle v1='0' v2='1' v3='2'/>",
        "<item objectid='1'/>", "<component objectid='1' transform='1 0 0 0 1 0 0 0 1 0 0 0'/>", "<coordinates>", "</coordinates>",
        "<x>1</x>", "<y>2</y>", "<z>3</z>", "<volume>", "</volume>", "<triangle>", "</triangle>", "<v1>0</v1>", "<v2>1</v2>", "<v3>2</v3>",
        "<instance objectid='1'>", "</instance>", "<rx>9</rx>", "<a:b>", "</a:b>", "<![CDATA[x]]>", "&amp;", "<!--x-->", "<", ">",
    ]), 0..60)) {
        for root in ["amf", "model", "x:amf"] {
            let _ = Import::default().read(format!("<{root}>{}</{root}>", words.concat()).as_bytes());
        }
    }
}
