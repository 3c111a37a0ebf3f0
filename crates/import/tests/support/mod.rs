//! A part in every format, written as the programs that draw parts write it.
#![allow(dead_code)]

use import::{Import, ImportError, Part};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{Cursor, Write as _};

pub type Triangle = [[f32; 3]; 3];

/// A box with a corner at the origin, two triangles a side.
pub fn cuboid(x: f32, y: f32, z: f32) -> Vec<Triangle> {
    let corner = |bits: u8| {
        [
            if bits & 1 > 0 { x } else { 0.0 },
            if bits & 2 > 0 { y } else { 0.0 },
            if bits & 4 > 0 { z } else { 0.0 },
        ]
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
    quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|face| face.map(corner)).collect()
}

pub fn cube() -> Vec<Triangle> {
    cuboid(20.0, 20.0, 20.0)
}

/// Every corner once, and the triangles by the numbers of their corners.
pub fn indexed(triangles: &[Triangle]) -> (Vec<[f32; 3]>, Vec<[usize; 3]>) {
    let mut places = BTreeMap::new();
    let mut vertices = Vec::new();
    let faces = triangles
        .iter()
        .map(|triangle| {
            triangle.map(|corner| {
                *places.entry(corner.map(f32::to_bits)).or_insert_with(|| {
                    vertices.push(corner);
                    vertices.len() - 1
                })
            })
        })
        .collect();
    (vertices, faces)
}

pub fn stl(triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.as_flattened().iter().flat_map(|number| number.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

/// A float as the shortest decimal that is the same number, as good exporters write it.
fn decimal(number: f32) -> String {
    f64::from(number).to_string()
}

pub fn text_stl(triangles: &[Triangle]) -> Vec<u8> {
    let mut text = "solid part\n".to_owned();
    for triangle in triangles {
        text += " facet normal 0 0 1\n  outer loop\n";
        for corner in triangle {
            let [x, y, z] = corner.map(decimal);
            let _ = writeln!(text, "   vertex {x} {y} {z}");
        }
        text += "  endloop\n endfacet\n";
    }
    (text + "endsolid part\n").into_bytes()
}

pub fn obj(triangles: &[Triangle]) -> Vec<u8> {
    let (vertices, faces) = indexed(triangles);
    let mut text = "# a part\nmtllib part.mtl\no part\n".to_owned();
    for corner in vertices {
        let [x, y, z] = corner.map(decimal);
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    text += "vn 0 0 1\ns off\n";
    for [a, b, c] in faces {
        let _ = writeln!(text, "f {}//1 {}//1 {}//1", a + 1, b + 1, c + 1);
    }
    text.into_bytes()
}

pub fn ply_header(encoding: &str, vertices: usize, faces: usize) -> String {
    format!(
        "ply\nformat {encoding} 1.0\ncomment made by a test\nelement vertex {vertices}\nproperty float x\n\
         property float y\nproperty float z\nproperty uchar red\nelement face {faces}\n\
         property list uchar int vertex_indices\nend_header\n"
    )
}

pub fn text_ply(triangles: &[Triangle]) -> Vec<u8> {
    let (vertices, faces) = indexed(triangles);
    let mut text = ply_header("ascii", vertices.len(), faces.len());
    for corner in vertices {
        let [x, y, z] = corner.map(decimal);
        let _ = writeln!(text, "{x} {y} {z} 200");
    }
    for [a, b, c] in faces {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text.into_bytes()
}

pub fn binary_ply(triangles: &[Triangle], big: bool) -> Vec<u8> {
    let (vertices, faces) = indexed(triangles);
    let encoding = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = ply_header(encoding, vertices.len(), faces.len()).into_bytes();
    let order = |number: [u8; 4]| {
        let mut number = number;
        if big {
            number.reverse();
        }
        number
    };
    for corner in vertices {
        bytes.extend(corner.iter().flat_map(|number| order(number.to_le_bytes())));
        bytes.push(200);
    }
    for face in faces {
        bytes.push(3);
        bytes.extend(face.iter().flat_map(|corner| order((*corner as i32).to_le_bytes())));
    }
    bytes
}

/// The model of a 3MF file with one object.
pub fn model(triangles: &[Triangle]) -> String {
    let (vertices, faces) = indexed(triangles);
    let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" \
        xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n\
        <metadata name=\"Title\">a &lt;part&gt;</metadata>\n<resources><object id=\"1\" type=\"model\"><mesh><vertices>\n"
        .to_owned();
    for corner in vertices {
        let [x, y, z] = corner.map(decimal);
        let _ = writeln!(text, "<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>");
    }
    text += "</vertices><triangles>\n";
    for [a, b, c] in faces {
        let _ = writeln!(text, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\" />");
    }
    text + "</triangles></mesh></object></resources>\n<build><item objectid=\"1\"/></build></model>"
}

pub const RELATIONS: &str = "<?xml version=\"1.0\"?><Relationships \
    xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Target=\"/3D/part.model\" \
    Id=\"rel0\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

pub fn archive(files: &[(&str, &str)]) -> Vec<u8> {
    let mut writer = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in files {
        let options = zip::write::SimpleFileOptions::default();
        writer.start_file(*name, options).expect("a file");
        writer.write_all(text.as_bytes()).expect("its text");
    }
    writer.finish().expect("an archive").into_inner()
}

pub fn threemf(triangles: &[Triangle]) -> Vec<u8> {
    package(&model(triangles))
}

/// A 3MF file with a model.
pub fn package(model: &str) -> Vec<u8> {
    archive(&[("[Content_Types].xml", "<Types/>"), ("_rels/.rels", RELATIONS), ("3D/part.model", model)])
}

pub fn amf(triangles: &[Triangle]) -> Vec<u8> {
    let (vertices, faces) = indexed(triangles);
    let mut text =
        "<?xml version=\"1.0\"?>\n<amf unit=\"millimeter\"><object id=\"0\"><mesh><vertices>\n".to_owned();
    for corner in vertices {
        let [x, y, z] = corner.map(decimal);
        let _ =
            writeln!(text, "<vertex><coordinates><x>{x}</x><y>{y}</y>\n<z>{z}</z></coordinates></vertex>");
    }
    text += "</vertices><volume>\n";
    for [a, b, c] in faces {
        let _ = writeln!(text, "<triangle><v1>{a}</v1><v2>{b}</v2><v3> {c} </v3></triangle>");
    }
    (text + "</volume></mesh></object></amf>\n").into_bytes()
}

pub fn packed_amf(triangles: &[Triangle]) -> Vec<u8> {
    archive(&[("part.amf", &String::from_utf8(amf(triangles)).expect("text"))])
}

/// Every format with its name.
pub fn all(triangles: &[Triangle]) -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("stl", stl(triangles)),
        ("text stl", text_stl(triangles)),
        ("obj", obj(triangles)),
        ("text ply", text_ply(triangles)),
        ("little-endian ply", binary_ply(triangles, false)),
        ("big-endian ply", binary_ply(triangles, true)),
        ("model", model(triangles).into_bytes()),
        ("3mf", threemf(triangles)),
        ("amf", amf(triangles)),
        ("packed amf", packed_amf(triangles)),
    ]
}

#[track_caller]
pub fn read(bytes: impl AsRef<[u8]>) -> Part {
    Import::default().read(bytes.as_ref()).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
pub fn refusal(bytes: impl AsRef<[u8]>) -> ImportError {
    let error = Import::default().read(bytes.as_ref()).expect_err("this should be refused");
    assert!(error.to_string().len() < 260, "a sentence has an end: {error}");
    assert!(!error.hint.is_empty());
    error
}

/// Reads what is the cube in another dress.
#[track_caller]
pub fn assert_cube(bytes: impl AsRef<[u8]>) -> Part {
    let part = read(bytes);
    assert_eq!(part.mesh, read(stl(&cube())).mesh);
    part
}
