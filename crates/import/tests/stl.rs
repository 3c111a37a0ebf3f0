//! Files that are read, files that are repaired, and files that are refused.

mod support;

use import::{ErrorKind, Format, Import, Part, Place};
use proptest::prelude::*;
use support::{Triangle, assert_cube, cube, cuboid, read, refusal};

fn binary_with(head: &[u8], count: u32, triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = head.to_vec();
    bytes.resize(80, b' ');
    bytes.extend(count.to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.as_flattened().iter().flat_map(|number| number.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn binary(triangles: &[Triangle]) -> Vec<u8> {
    binary_with(b"made by a test", triangles.len() as u32, triangles)
}

fn text_named(name: &str, triangles: &[Triangle]) -> String {
    let mut text = format!("solid {name}\n");
    for triangle in triangles {
        text += "  facet normal 0 0 1\n    outer loop\n";
        for [x, y, z] in triangle.map(|corner| corner.map(f64::from)) {
            text += &format!("      vertex {x} {y} {z}\n");
        }
        text += "    endloop\n  endfacet\n";
    }
    text + &format!("endsolid {name}\n")
}

fn text(triangles: &[Triangle]) -> String {
    text_named("cube", triangles)
}

#[test]
fn i1_text_and_binary_are_the_same_cube() {
    let text = assert_cube(text(&cube()));
    let binary = assert_cube(binary_with(b"solid cube", 12, &cube()));
    assert_eq!((text.report.format, binary.report.format), (Format::TextStl, Format::BinaryStl));
    let mesh = binary.mesh;
    assert_eq!((mesh.vertices.len(), mesh.faces.len(), mesh.edges.len()), (8, 12, 18));
    assert_eq!((mesh.open_edges(), mesh.volume()), (0, 8000.0));
}

#[test]
fn i2_a_count_that_was_never_filled_in_gives_way_to_the_length() {
    for count in [0, 1 << 31, u32::MAX, 5] {
        let report = assert_cube(binary_with(b"solid of steel", count, &cube())).report;
        assert_eq!((report.facets, report.promised), (12, Some(count)));
        assert_eq!(report.notes().len(), 1);
    }
}

#[test]
fn i3_decimal_commas_are_points() {
    let report = assert_cube(text(&cube()).replace("20", "20,0")).report;
    assert_eq!(report.decimal_commas, 36 * 3 / 2);
}

#[test]
fn i4_minus_zero_is_zero() {
    let triangles = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[1.0, -0.0, -0.0], [-0.0, -0.0, 0.0], [0.0, -1.0, 0.0]],
    ];
    for mesh in [read(binary(&triangles)).mesh, read(text(&triangles)).mesh] {
        assert_eq!((mesh.vertices.len(), mesh.edges.len(), mesh.open_edges()), (4, 5, 4));
    }
}

#[test]
fn i5_a_triangle_with_two_equal_corners_is_left_out_and_counted() {
    let mut triangles = cube();
    triangles.insert(0, [[500.0; 3], [1.0; 3], [500.0; 3]]);
    triangles.push([[0.0; 3], [0.0001, 0.0, 0.0], [0.0, 20.0, 0.0]]);
    for import in [assert_cube(binary(&triangles)), assert_cube(text(&triangles))] {
        assert_eq!((import.report.facets, import.report.degenerate), (14, 2));
        assert!(import.mesh.edges.iter().all(|edge| edge.vertices[0] != edge.vertices[1]));
        assert_eq!(import.report.notes(), ["2 of 14 facets have no area and were left out"]);
    }
}

#[test]
fn i6_short_garbage_is_refused() {
    let error = refusal([0xA7; 24]);
    assert_eq!(error.kind, ErrorKind::Unknown);
    assert_eq!(refusal([0; 80]).kind, ErrorKind::Unknown);
}

/// V − E + F of a cylinder made of slices.
#[test]
fn i7_a_cylinder_obeys_euler() {
    let rim = |step: i32, z: f32| {
        let angle = (step % 48) as f32 * std::f32::consts::TAU / 48.0;
        [15.0 * angle.cos(), 15.0 * angle.sin(), z]
    };
    let cylinder: Vec<Triangle> = (0..48)
        .flat_map(|step| {
            let [a, b, c, d] = [rim(step, 0.0), rim(step + 1, 0.0), rim(step + 1, 30.0), rim(step, 30.0)];
            [[a, b, c], [a, c, d], [[0.0; 3], b, a], [[0.0, 0.0, 30.0], d, c]]
        })
        .collect();
    let mesh = read(binary(&cylinder)).mesh;
    assert_eq!(mesh.vertices.len() + mesh.faces.len() - mesh.edges.len(), 2);
    assert_eq!(mesh.open_edges(), 0);
}

#[test]
fn vertices_are_numbered_by_first_occurrence() {
    let import = read(binary(&cube()));
    let corners: Vec<u32> = import.mesh.faces.iter().flat_map(|face| face.vertices).collect();
    let mut seen = 0;
    for corner in corners {
        assert!(corner <= seen);
        seen = seen.max(corner + 1);
    }
}

// Containers.

#[test]
fn a_file_that_was_cut_is_never_a_smaller_part() {
    let whole = binary(&cube());
    for length in 84..whole.len() {
        let error = refusal(&whole[..length]);
        assert_eq!(error.kind, ErrorKind::Truncated, "{length} bytes");
    }
    assert_eq!(
        refusal(&whole[..440]).to_string(),
        "truncated: the header promises 12 facets, 7 are present (byte 434)"
    );
    assert_eq!(refusal(binary_with(b"", 12_000_000, &cube())).kind, ErrorKind::Truncated);
    assert_eq!(refusal(&binary_with(b"", 0, &cube())[..600]).kind, ErrorKind::Truncated);
}

#[test]
fn every_cut_of_a_text_is_noticed() {
    let whole = text(&cube());
    let end = whole.find("endsolid").expect("an end") + "endsolid".len();
    for length in 12..end {
        let error = refusal(&whole[..length]);
        assert!(matches!(error.kind, ErrorKind::Truncated), "{length} bytes: {error}");
    }
}

#[test]
fn what_follows_the_last_facet_is_ignored_when_it_is_little() {
    for (extra, trailing) in [(vec![7; 3], 3), (vec![0; 49], 49), (vec![0; 512], 512), (vec![0x7F; 100], 100)]
    {
        let bytes = [binary(&cube()), extra].concat();
        assert_eq!(assert_cube(bytes).report.trailing, trailing);
    }
    assert_eq!(refusal([binary(&cube()), vec![7; 75]].concat()).kind, ErrorKind::WrongCount);
}

#[test]
fn other_files_are_called_by_their_name() {
    for (bytes, name) in [
        (&b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"[..], "PNG"),
        (b"\x1f\x8b\x08\0", "gzip"),
        (b"\n <!DOCTYPE html><html><body>vertex 1 2 3</body></html>", "web page"),
        (b"\xff\xfes\0o\0l\0i\0d\0", "UTF-16"),
    ] {
        let error = refusal(bytes);
        assert_eq!(error.kind, ErrorKind::Foreign);
        assert!(error.message.contains(name), "{error}");
        assert!(!error.hint.is_empty());
    }
}

#[test]
fn nothing_in_it() {
    assert_eq!(refusal([]).kind, ErrorKind::Empty);
    assert_eq!(refusal(binary(&[])).kind, ErrorKind::NoFacets);
    assert_eq!(refusal("solid nothing\nendsolid nothing\n").kind, ErrorKind::NoFacets);
    assert_eq!(refusal(binary(&[[[1.0; 3]; 3]; 4])).kind, ErrorKind::NoArea);
    assert_eq!(refusal(text(&[[[0.0; 3], [1.0; 3], [2.0; 3]]])).kind, ErrorKind::NoArea);
}

// Encodings.

#[test]
fn a_binary_header_may_read_like_text() {
    for head in ["solid cube\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "SOLID", "COLOR=\u{1}\u{2}"] {
        assert_cube(binary_with(head.as_bytes(), 12, &cube()));
    }
}

#[test]
fn normals_are_not_believed() {
    for normal in [f32::NAN, f32::INFINITY, -1.0] {
        let mut bytes = binary(&cube());
        for record in bytes[84..].chunks_mut(50) {
            record[..4].copy_from_slice(&normal.to_le_bytes());
        }
        assert_cube(bytes);
    }
    for normal in ["nan nan nan", "-nan(ind) 0 0", "", "1 2", "0,0 0,0 1,0"] {
        assert_cube(text(&cube()).replace("normal 0 0 1", &format!("normal {normal}")));
    }
}

// Text in all its forms.

#[test]
fn the_look_of_a_text_does_not_matter() {
    let plain = text(&cube());
    assert_cube(plain.to_uppercase());
    assert_cube(plain.replace('\n', "\r\n"));
    assert_cube(plain.replace('\n', "\r"));
    assert_cube(plain.replace("  ", "\t"));
    assert_cube(plain.replace('\n', " "));
    assert_cube(format!("\u{feff}{plain}"));
    assert_cube(format!("\n\n  {plain}"));
    assert_cube(plain.replace("20", "2.0000000e+001"));
    assert_cube(plain.replace("20", "+20."));
    assert_cube(plain.trim_end());
    assert_cube(plain.replace("endsolid cube", "endsolid"));
}

#[test]
fn names_may_be_anything() {
    let long = "x".repeat(70_000);
    for name in [
        &long,
        "",
        "vertex",
        "vertex 1 2 3",
        "a facet normal map",
        "my solid pot",
        "endsolid_7",
        "Töpferei 陶芸",
    ] {
        assert_cube(text_named(name, &cube()));
    }
    assert_cube(text_named("my pot", &cube()).replace('\n', " "));
}

#[test]
fn several_solids_are_one_part() {
    let cube = cube();
    let (one, two) = cube.split_at(5);
    let both = text_named("a", one) + &text_named("b", two);
    for text in [both.replace('\n', " "), both] {
        assert_eq!(assert_cube(text).report.solids, 2);
    }
}

#[test]
fn strange_lines_between_facets_are_counted() {
    let report = assert_cube(text(&cube()).replacen("  facet", "color 0.5 0.5 0.5\n  facet", 3)).report;
    assert_eq!(report.ignored_lines, 3);
}

#[test]
fn a_quad_is_refused_with_its_line() {
    let quad = text(&cube()).replacen("    endloop", "      vertex 1 1 1\n    endloop", 1);
    let error = refusal(quad);
    assert_eq!((error.kind, error.place.clone()), (ErrorKind::NotATriangle, Place::Line(2)));
    assert_eq!(error.to_string(), "a facet has 4 vertices instead of 3 (line 2)");
}

#[test]
fn words_in_the_wrong_place_are_refused() {
    let plain = text(&cube());
    for (from, to, line) in [
        ("vertex 0 0 0", "vertex 0 0", 5),
        ("vertex 0 0 0", "vertex 0 0 0 0", 4),
        ("vertex 0 0 0", "vertex 0 0 0\0", 4),
        ("vertex 0 0 0", "vertex 0 0 1.2.3", 4),
        ("  facet", "  facat", 3),
        ("  endfacet\n", "", 8),
    ] {
        let error = refusal(plain.replacen(from, to, 1));
        assert_eq!(
            (error.kind, error.place.clone()),
            (ErrorKind::Syntax, Place::Line(line)),
            "{to}: {error}"
        );
    }
}

// Numbers.

#[test]
fn numbers_must_be_near() {
    for (bad, kind) in [
        (f32::NAN, ErrorKind::NotFinite),
        (f32::NEG_INFINITY, ErrorKind::NotFinite),
        (1e30, ErrorKind::TooFar),
        (f32::MAX, ErrorKind::TooFar),
        (-1_000_000.1, ErrorKind::TooFar),
    ] {
        let mut triangles = cube();
        triangles[3][1][2] = bad;
        let error = refusal(binary(&triangles));
        assert_eq!((error.kind, error.place.clone()), (kind, Place::Facet { number: 4, byte: 234 }));
        let error = refusal(text(&triangles));
        assert_eq!((error.kind, error.place.clone()), (kind, Place::Line(2 + 3 * 7 + 3)));
    }
}

#[test]
fn the_smallest_and_the_farthest_numbers_are_read() {
    let mut triangles = cube();
    for corner in triangles.as_flattened_mut().as_flattened_mut().iter_mut().filter(|number| **number == 0.0)
    {
        *corner = 1e-40;
    }
    assert_cube(binary(&triangles));
    let far = cuboid(-1_000_000.0, 1_000_000.0, 1_000_000.0);
    assert_eq!(read(binary(&far)).mesh.bounds().min.x, -1_000_000_000);
}

/// Enough facets that several threads share them.
#[test]
fn the_number_of_threads_does_not_matter() {
    let boxes: Vec<Triangle> = (0..5000)
        .flat_map(|index| {
            let shift = [(index * 7919 % 5000 / 70) as f32, (index % 71) as f32, 0.0];
            cuboid(1.0, 1.0, 1.0)
                .into_iter()
                .map(move |face| face.map(|corner| [0, 1, 2].map(|axis| corner[axis] + shift[axis])))
        })
        .collect();
    let bytes = binary(&boxes);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| read(&bytes))
    };
    let one = with(1);
    assert_eq!(one.mesh, read(text(&boxes)).mesh);
    assert_eq!(one, with(2));
    assert_eq!(one, with(5));
}

fn triangles() -> impl Strategy<Value = Vec<Triangle>> {
    let number = prop_oneof![(-8i8..8).prop_map(f32::from), -500.0f32..500.0, Just(-0.0f32)];
    prop::collection::vec(prop::array::uniform3(prop::array::uniform3(number)), 1..40)
}

proptest! {
    #[test]
    fn no_bytes_bring_it_down(bytes in prop::collection::vec(any::<u8>(), 0..600)) {
        let _ = Import::default().read(&bytes);
    }

    #[test]
    fn no_words_bring_it_down(words in prop::collection::vec(prop::sample::select(vec![
        "solid", "endsolid", "facet", "normal", "outer", "loop", "vertex", "endloop", "endfacet", "0", "1,5", "nan", "\n", "x", "é", "\0",
    ]), 0..80)) {
        let _ = Import::default().read(words.join(" ").as_bytes());
        let _ = Import::default().read(format!("solid\n{}", words.join("\n")).as_bytes());
    }

    #[test]
    fn no_damage_brings_it_down(place in 0usize..684, byte in any::<u8>(), length in 0usize..684) {
        let mut bytes = binary(&cube());
        bytes[place] = byte;
        let _ = Import::default().read(&bytes);
        let _ = Import::default().read(&bytes[..length]);
        let mut bytes = text(&cube()).into_bytes();
        bytes[place] = byte;
        let _ = Import::default().read(&bytes);
    }

    #[test]
    fn text_and_binary_agree(triangles in triangles()) {
        match (Import::default().read(&binary(&triangles)), Import::default().read(text(&triangles).as_bytes())) {
            (Ok(binary), Ok(text)) => {
                prop_assert_eq!(binary.mesh, text.mesh);
                prop_assert_eq!(binary.report.degenerate, text.report.degenerate);
            }
            (Err(binary), Err(text)) => prop_assert_eq!(binary, text),
            (binary, text) => prop_assert!(false, "{binary:?} but {text:?}"),
        }
    }

    #[test]
    fn turning_the_corners_keeps_the_vertices(triangles in triangles(), turns in prop::collection::vec(0usize..3, 40)) {
        let mut turned = triangles.clone();
        for (triangle, turn) in turned.iter_mut().zip(turns) {
            triangle.rotate_left(turn);
        }
        if let (Ok(one), Ok(two)) = (Import::default().read(&binary(&triangles)), Import::default().read(&binary(&turned))) {
            let sorted = |import: &Part| {
                let mut vertices = import.mesh.vertices.clone();
                vertices.sort_unstable();
                vertices
            };
            prop_assert_eq!(sorted(&one), sorted(&two));
            prop_assert_eq!(one.mesh.edges.len(), two.mesh.edges.len());
            prop_assert_eq!(one.mesh.volume(), two.mesh.volume());
        }
    }
}
