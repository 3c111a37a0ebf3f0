//! What a file is, by its bytes; its name is not believed.

use crate::error::{ErrorKind, ImportError, Place};
use crate::{Format, obj, package, stl};

/// Finds out what the bytes are; of an archive, only that it is one: it is taken for a 3MF until it is opened.
///
/// # Errors
/// With the name of the form, when it is known and not read.
pub(crate) fn format(bytes: &[u8]) -> Result<Format, ImportError> {
    if bytes.is_empty() {
        return Err(ImportError::empty());
    }
    // The length of a binary STL is just what its count asks for; nothing else is like that by chance.
    if stl::has_exact_length(bytes) {
        return Ok(Format::BinaryStl);
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    if starts_a_ply(text) {
        return Ok(Format::Ply);
    }
    if package::is_archive(bytes) {
        return Ok(Format::ThreeMf);
    }
    if text.starts_with(b"<") {
        return xml(text);
    }
    if let Some((_, name, hint)) = STARTS.iter().find(|(start, ..)| starts(bytes, text, start)) {
        return Err(foreign(name, hint));
    }
    if stl::looks_like_text(bytes) {
        return Ok(Format::TextStl);
    }
    if let Some((name, hint)) = drawing(text) {
        return Err(foreign(name, hint));
    }
    Ok(if obj::looks_like_obj(text) { Format::Obj } else { Format::BinaryStl })
}

/// Whether the bytes are an SVG: layers, which need not be cut.
pub fn is_drawing(bytes: &[u8]) -> bool {
    format(bytes) == Ok(Format::Svg)
}

/// What is said to who wants a surface and has a drawing.
pub(crate) fn no_mesh() -> ImportError {
    foreign(
        "a drawing of layers, which have no surface",
        "slice it as it is, or give the mesh it was made from",
    )
}

fn foreign(name: &str, hint: &str) -> ImportError {
    let message = format!("this is {name}, not a part that can be read");
    ImportError::new(ErrorKind::Foreign, Place::Byte(0), message, hint)
}

fn starts_a_ply(text: &[u8]) -> bool {
    text.get(..3).is_some_and(|start| start.eq_ignore_ascii_case(b"ply"))
        && text.get(3).is_some_and(|byte| byte.is_ascii_whitespace())
}

/// Words of text match in any case and after blanks, other bytes as they are.
fn starts(bytes: &[u8], text: &[u8], start: &[u8]) -> bool {
    if start.is_ascii() {
        text.get(..start.len()).is_some_and(|text| text.eq_ignore_ascii_case(start))
    } else {
        bytes.starts_with(start)
    }
}

const MESH: &str = "export the model as STL, 3MF, OBJ or PLY";
const SOLID: &str = "it holds exact surfaces, which must be made into triangles: open it in a CAD program and \
                     export it as STL or 3MF";
const PICTURE: &str = "a part is needed, as STL, 3MF, OBJ, PLY or AMF";
const UNPACK: &str = "unpack it and give the file inside";
const SLICED: &str = "slice the model it was made from; clayforge check says what is in it";
const PLAIN: &str = "save it as plain text (UTF-8), or in a binary format";

/// How files begin that are known by name and not read.
const STARTS: &[(&[u8], &str, &str)] = &[
    (b"\x89PNG", "a PNG picture", PICTURE),
    (b"\xff\xd8\xff", "a JPEG picture", PICTURE),
    (b"GIF8", "a GIF picture", PICTURE),
    (b"%PDF", "a PDF document", PICTURE),
    (b"\x1f\x8b", "a gzip archive", UNPACK),
    (b"7z\xbc\xaf", "a 7z archive", UNPACK),
    (b"Rar!\x1a", "a RAR archive", UNPACK),
    (b"glTF", "a glTF model", MESH),
    (b"BLENDER", "a Blender file", MESH),
    (b"\x28\xb5\x2f\xfd", "a compressed file, perhaps of Blender", MESH),
    (b"3D Geometry File Format", "a 3DM model of Rhino", MESH),
    (b"Kaydara FBX", "an FBX model", MESH),
    (b"#VRML", "a VRML model", MESH),
    (b"AC1.", "a DWG drawing", SOLID),
    (b"AC10", "a DWG drawing", SOLID),
    (b"AutoCAD Binary DXF", "a DXF drawing", SOLID),
    (b"ISO-10303-21", "a STEP model", SOLID),
    (b"HEADER;", "a STEP model", SOLID),
    (b"DBRep_DrawableShape", "a BREP model", SOLID),
    (b"CASCADE Topology", "a BREP model", SOLID),
    (b"**ABCDEFGHIJKLM", "a Parasolid model", SOLID),
    (b"\xd0\xcf\x11\xe0", "a document of SolidWorks, Inventor or an office program", MESH),
    (b"\xff\xfe\xff\x0e", "a SketchUp model", MESH),
    (b"\xff\xfe", "text in UTF-16", PLAIN),
    (b"\xfe\xff", "text in UTF-16", PLAIN),
    (b"\x7fELF", "a program", PICTURE),
    (b"MZ\x90", "a program", PICTURE),
    (b"{", "JSON, perhaps a glTF model", MESH),
    (b"COFF", "an OFF model", MESH),
    (b"OFF\n", "an OFF model", MESH),
    (b"OFF\r", "an OFF model", MESH),
    (b"(<", "a skein", "clayforge craft works on skeins"),
];

/// Files of text without a mark at the start.
fn drawing(text: &[u8]) -> Option<(&'static str, &'static str)> {
    let mut lines = text.split(|byte| matches!(byte, b'\n' | b'\r')).filter(|line| !line.is_empty());
    let first = lines.next()?;
    // IGES numbers its cards in columns 73 to 80, those of the start section with an S.
    if first.get(72..80).is_some_and(|card| card.first() == Some(&b'S') && card.ends_with(b"1")) {
        return Some(("an IGES model", SOLID));
    }
    let second = lines.next().unwrap_or_default();
    if first.trim_ascii() == b"0" && second.trim_ascii() == b"SECTION" {
        return Some(("a DXF drawing", SOLID));
    }
    let is_command = |line: &[u8]| {
        let line = line.trim_ascii_start();
        let command = matches!(line, [b'G' | b'M' | b'g' | b'm' | b'T', digit, ..] if digit.is_ascii_digit());
        command && !line.contains(&0)
    };
    let is_remark = |line: &&[u8]| line.trim_ascii_start().starts_with(b";") || line.trim_ascii().is_empty();
    let all = [first, second].into_iter().chain(lines);
    all.take(500).find(|line| !is_remark(line)).filter(|line| is_command(line)).map(|_| ("G-code", SLICED))
}

/// What an XML document is, by its outermost element.
fn xml(text: &[u8]) -> Result<Format, ImportError> {
    const PAGE: &str = "download the file itself, not the page that shows it";
    let name = root_name(text);
    Ok(match name.to_ascii_lowercase().as_slice() {
        b"amf" => Format::Amf,
        b"model" => Format::ThreeMf,
        b"svg" => Format::Svg,
        b"html" | b"!doctype" | b"head" | b"body" => return Err(foreign("a web page", PAGE)),
        b"collada" => return Err(foreign("a COLLADA model", MESH)),
        b"x3d" => return Err(foreign("an X3D model", MESH)),
        _ => return Err(foreign("an XML file of an unknown kind", MESH)),
    })
}

/// The name of the first element, without its prefix; for a page, `!doctype`.
fn root_name(text: &[u8]) -> &[u8] {
    let mut rest = text;
    // Comments, declarations and instructions come before it.
    while let Some(start) = rest.iter().position(|byte| *byte == b'<') {
        let tag = rest.get(start + 1..).unwrap_or_default();
        let (skip, end): (bool, &[u8]) = match tag {
            [b'!', b'-', b'-', ..] => (true, b"-->"),
            [b'?', ..] => (true, b"?>"),
            [b'!', ..] => {
                let words = tag.split(|byte| byte.is_ascii_whitespace() || *byte == b'>');
                let mut words = words.filter(|word| !word.is_empty());
                let doctype = words.next().unwrap_or_default();
                let is_page = words.next().is_some_and(|word| word.eq_ignore_ascii_case(b"html"));
                if is_page && doctype.eq_ignore_ascii_case(b"!doctype") {
                    return b"!doctype";
                }
                (true, b">")
            }
            _ => (false, b""),
        };
        if !skip {
            let name = tag.split(|byte| byte.is_ascii_whitespace() || matches!(byte, b'>' | b'/'));
            let name = name.into_iter().next().unwrap_or_default();
            return name.rsplit(|byte| *byte == b':').next().unwrap_or_default();
        }
        let Some(at) = tag.windows(end.len()).position(|window| window == end) else { return b"" };
        rest = tag.get(at + end.len()..).unwrap_or_default();
    }
    b""
}

impl Format {
    /// How files of the format are called.
    pub fn extension(self) -> &'static str {
        match self {
            Self::TextStl | Self::BinaryStl => "stl",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::ThreeMf => "3mf",
            Self::Amf => "amf",
            Self::Svg => "svg",
        }
    }

    /// What to say about a file whose name promises another of the formats that are read.
    pub fn misnamed(self, extension: &str) -> Option<String> {
        const READ: &[&str] = &["stl", "obj", "ply", "3mf", "amf", "svg"];
        let called = READ.iter().find(|known| known.eq_ignore_ascii_case(extension))?;
        (*called != self.extension()).then(|| {
            format!(
                "the file is called .{called} and holds {}: it was read as what it is",
                self.extension().to_ascii_uppercase()
            )
        })
    }
}
