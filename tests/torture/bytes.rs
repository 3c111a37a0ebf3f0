//! Files that are spoiled as files: the classes container, encoding, ascii and numbers.

use super::{Case, Expect, Layers, cube};
use crate::support::{stl, text_stl};

/// The box as it should be.
fn whole() -> Layers {
    Layers::Are(Box::new(|_| (400.0, 1)), 1e-9)
}

fn right(name: &'static str, file: impl Into<Vec<u8>>) -> Case {
    Case { name, file: file.into(), settings: &[], expect: Expect::Right(whole()) }
}

fn warned(name: &'static str, file: impl Into<Vec<u8>>, word: &'static str) -> Case {
    Case { name, file: file.into(), settings: &[], expect: Expect::Warned(whole(), word) }
}

fn refused(name: &'static str, file: impl Into<Vec<u8>>, word: &'static str) -> Case {
    Case { name, file: file.into(), settings: &[], expect: Expect::Refused(word) }
}

/// The box as a binary file with another count.
fn counted(count: u32) -> Vec<u8> {
    let mut file = stl(&cube());
    file[80..84].copy_from_slice(&count.to_le_bytes());
    file
}

/// The box as a binary file with another beginning.
fn headed(head: &[u8]) -> Vec<u8> {
    let mut file = stl(&cube());
    file[..80].fill(b' ');
    file[..head.len()].copy_from_slice(head);
    file
}

/// The box with some bytes of every record replaced.
fn recorded(at: std::ops::Range<usize>, bytes: &[u8]) -> Vec<u8> {
    let mut file = stl(&cube());
    for record in file[84..].chunks_mut(50) {
        let length = at.len();
        record[at.clone()]
            .iter_mut()
            .zip(bytes.iter().cycle().take(length))
            .for_each(|(to, from)| *to = *from);
    }
    file
}

/// The box with one coordinate of the first facet replaced.
fn numbered(number: f32) -> Vec<u8> {
    let mut file = stl(&cube());
    file[96..100].copy_from_slice(&number.to_le_bytes());
    file
}

fn text() -> String {
    text_stl(&cube())
}

pub fn cases() -> Vec<Case> {
    let binary = stl(&cube());
    let mut cases = container(&binary);
    cases.extend(encoding());
    cases.extend(ascii());
    cases.extend(numbers());
    cases
}

fn container(binary: &[u8]) -> Vec<Case> {
    let trailing = |bytes: &[u8]| [binary, bytes].concat();
    let noise: Vec<u8> = (0u32..5000).map(|index| (index.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    vec![
        refused("empty", [], "empty"),
        refused("only a head", [b' '; 80], "too few"),
        refused("no facets", counted(0)[..84].to_vec(), "no facets"),
        refused("cut inside a facet", &binary[..binary.len() - 20], "truncated"),
        refused("cut between facets", &binary[..binary.len() - 100], "truncated"),
        refused("count too large", counted(13), "truncated"),
        warned("count too small", counted(11), "promises 11"),
        warned("count 0", counted(0), "promises 0"),
        warned("count 2^31", counted(1 << 31), "promises"),
        warned("count 2^32 - 1", counted(u32::MAX), "promises"),
        warned("three bytes behind", trailing(b"end"), "3 bytes"),
        warned("zeros behind", trailing(&[0; 77]), "77 bytes"),
        refused("picture", [b"\x89PNG\r\n\x1a\n".as_slice(), &noise].concat(), "PNG"),
        refused("archive", [b"PK\x03\x04".as_slice(), &noise].concat(), "archive"),
        refused("page", "<!DOCTYPE html><html><body>404 not found</body></html>", "web page"),
        refused("noise", noise, ""),
    ]
}

fn encoding() -> Vec<Case> {
    vec![
        right("head says solid", headed(b"solid part")),
        right("head reads as text", headed(b"solid x\n facet normal 0 0 1\n outer loop\n vertex 1 2 3\n")),
        right("colours", recorded(48..50, &[0x1f, 0x7c])),
        right("normals zero", recorded(0..12, &[0])),
        right("normals wrong", recorded(0..12, &(-1.0f32).to_le_bytes())),
        right("normals NaN", recorded(0..12, &f32::NAN.to_le_bytes())),
    ]
}

fn ascii() -> Vec<Case> {
    let part = text();
    let lines: Vec<&str> = part.lines().collect();
    let two = part.replacen(" endfacet\n", " endfacet\nendsolid one\nsolid two\n", 6);
    vec![
        right("text", part.clone()),
        right("text in capitals", part.to_uppercase()),
        right("text in mixed case", part.replace("facet", "Facet").replace("vertex", "VerTex")),
        right("text with CRLF", part.replace('\n', "\r\n")),
        right("text with CR", part.replace('\n', "\r")),
        right("text with tabs", part.replace(' ', "\t")),
        right("text on one line", part.replace('\n', " ")),
        right("text with BOM", [b"\xef\xbb\xbf".as_slice(), part.as_bytes()].concat()),
        right("text with exponents", part.replace(" 20", " 2.0E+01").replace(" 12", " +1.2e1")),
        warned("text with commas", part.replace(" 20", " 20,0").replace(" 12", " 12,00"), "comma"),
        refused("text cut short", part[..part.len() / 2].to_owned(), ""),
        right("text with a long name", part.replace("solid part", &format!("solid {}", "x".repeat(70_000)))),
        right("text without a name", part.replace("solid part", "solid")),
        right("text of several solids", two),
        right("text with blank lines", lines.join("\n\n\n")),
        refused("text with a quad", part.replacen("  endloop", "   vertex 1 1 1\n  endloop", 1), ""),
        refused("text with NaN", part.replacen(" 20", " nan", 1), "nan"),
        refused("text with words for numbers", part.replacen("vertex 0", "vertex zero", 1), "zero"),
        refused("text without facets", "solid nothing\nendsolid nothing\n", "no facets"),
    ]
}

fn numbers() -> Vec<Case> {
    let far = |by: f64| stl(&super::shapes::moved(&cube(), [by, by, 0.0]));
    let small = |by: f32| {
        let mut file = stl(&cube());
        for number in file[84..].chunks_mut(50).flat_map(|record| record[12..48].chunks_exact_mut(4)) {
            if *number == [0; 4] {
                number.copy_from_slice(&by.to_le_bytes());
            }
        }
        file
    };
    vec![
        refused("NaN", numbered(f32::NAN), "NaN"),
        refused("infinite", numbered(f32::INFINITY), "inf"),
        refused("1e30", numbered(1e30), "1e30"),
        refused("the largest float", numbered(f32::MAX), "e38"),
        right("denormals", small(1e-40)),
        right("minus zero", small(-0.0)),
        right("100 m away", far(100_000.0)),
        refused("1000 km away", far(1e9), "1000000 mm"),
    ]
}
