//! What several tests need: the workspace, blessing, differences of texts, parts that are quickly made.

use clayforge::{Event, Notes, Profile, Sliced};
pub use fuzz::{Triangle, stl};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use unit::Angle;

/// The folder of the workspace.
pub fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().expect("tests is a folder of the workspace").to_owned()
}

/// Whether expectations are to be rewritten instead of compared: `CLAYFORGE_BLESS=1`.
pub fn blessing() -> bool {
    std::env::var_os("CLAYFORGE_BLESS").is_some_and(|value| !value.is_empty() && value != "0")
}

/// A text file of the workspace.
pub fn text_of(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The Rust files below a folder, with their texts.
pub fn sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("readable").path()) {
        if entry.is_dir() {
            found.extend(sources(&entry));
        } else if entry.extension().is_some_and(|end| end == "rs") {
            let text = text_of(&entry);
            found.push((entry, text));
        }
    }
    found
}

/// The folders in a folder, sorted.
pub fn folders(path: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut found: Vec<PathBuf> =
        entries.flatten().map(|entry| entry.path()).filter(|path| path.is_dir()).collect();
    found.sort();
    found
}

/// The name of the last part of a path.
pub fn name_of(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The lines in which two texts differ: `-` was expected, `+` was found. Equal lines far from a difference are left out,
/// and so is what nobody would read.
pub fn difference(expected: &str, found: &str) -> String {
    /// Enough to see what kind of difference it is.
    const MOST: usize = 60;
    let whole = whole_difference(expected, found);
    let lines: Vec<&str> = whole.lines().collect();
    if lines.len() <= MOST {
        return whole;
    }
    format!("{}\n  … and {} lines more\n", lines[..MOST].join("\n"), lines.len() - MOST)
}

fn whole_difference(expected: &str, found: &str) -> String {
    /// The table of common lines grows with the product of both; what is beyond is compared line by line.
    const MOST: usize = 2000;
    let (old, new): (Vec<&str>, Vec<&str>) = (expected.lines().collect(), found.lines().collect());
    let steps = if old.len() <= MOST && new.len() <= MOST {
        aligned(&old, &new)
    } else {
        first_different(&old, &new)
    };
    let near = |index: usize| {
        steps[index.saturating_sub(2)..(index + 3).min(steps.len())].iter().any(|(mark, _)| *mark != ' ')
    };
    let mut text = String::new();
    let mut gap = false;
    for (index, (mark, line)) in steps.iter().enumerate() {
        if near(index) {
            let _ = writeln!(text, "  {mark} {line}");
            gap = false;
        } else if !gap {
            text.push_str("    …\n");
            gap = true;
        }
    }
    text
}

/// The longest common subsequence of lines, told as steps.
fn aligned<'a>(old: &[&'a str], new: &[&'a str]) -> Vec<(char, &'a str)> {
    let width = new.len() + 1;
    let mut common = vec![0u32; (old.len() + 1) * width];
    for i in (0..old.len()).rev() {
        for j in (0..new.len()).rev() {
            common[i * width + j] = if old[i] == new[j] {
                common[(i + 1) * width + j + 1] + 1
            } else {
                common[(i + 1) * width + j].max(common[i * width + j + 1])
            };
        }
    }
    let (mut i, mut j, mut steps) = (0, 0, Vec::new());
    while i < old.len() || j < new.len() {
        if i < old.len() && j < new.len() && old[i] == new[j] {
            steps.push((' ', old[i]));
            (i, j) = (i + 1, j + 1);
        } else if j == new.len()
            || (i < old.len() && common[(i + 1) * width + j] >= common[i * width + j + 1])
        {
            steps.push(('-', old[i]));
            i += 1;
        } else {
            steps.push(('+', new[j]));
            j += 1;
        }
    }
    steps
}

/// The first ten lines that differ, place by place.
fn first_different<'a>(old: &[&'a str], new: &[&'a str]) -> Vec<(char, &'a str)> {
    let places = (0..old.len().max(new.len())).filter(|place| old.get(*place) != new.get(*place)).take(10);
    places
        .flat_map(|place| [old.get(place).map(|line| ('-', *line)), new.get(place).map(|line| ('+', *line))])
        .flatten()
        .collect()
}

/// Two long texts are the same; otherwise says where they part.
pub fn assert_same(expected: &[u8], found: &[u8], what: &str) {
    if expected != found {
        let (expected, found) = (String::from_utf8_lossy(expected), String::from_utf8_lossy(found));
        panic!("{what}\n{}", difference(&expected, &found));
    }
}

// Profiles.

/// The built-in profile `clay`, with more keys set.
pub fn clay(keys: &[(&str, &str)]) -> Profile {
    let mut profile =
        Profile::built_in("clay").expect("clay is built in").unwrap_or_else(|error| panic!("clay: {error}"));
    for (key, value) in keys {
        profile.set(key, value).unwrap_or_else(|error| panic!("{error}"));
    }
    profile
}

/// The keys of a fine print: 0.2 mm layers of 0.45 mm beads.
pub const FINE: &[(&str, &str)] = &[
    ("machine.nozzle", "0.4"),
    ("carve.layer_height", "0.2"),
    ("carve.first_layer_height", "0.2"),
    ("carve.bead_width", "0.45"),
];

// Running the facade.

/// A slicing with the texts that it made on the way.
pub struct Run {
    /// The text behind each stage, by the name of the stage; the last is the file.
    pub texts: Vec<(&'static str, Vec<u8>)>,
    /// What the facade says of it.
    pub sliced: Sliced,
}

impl Run {
    /// The file.
    pub fn gcode(&self) -> &[u8] {
        &self.texts.last().expect("a chain has stages").1
    }

    /// The text behind a stage.
    pub fn behind(&self, stage: &str) -> &[u8] {
        let found = self.texts.iter().find(|(name, _)| *name == stage);
        &found.unwrap_or_else(|| panic!("no text behind {stage}")).1
    }
}

/// Slices in memory.
pub fn slice(stl: &[u8], profile: &Profile) -> Result<Run, clayforge::Error> {
    let mut texts: Vec<(&'static str, Vec<u8>)> = Vec::new();
    let mut gcode = Vec::new();
    let mut watch = |event: Event<'_>| {
        if let Event::Done { name, number: 1.., document, .. } = event {
            texts.push((name, document.text().unwrap_or_default()));
        }
        Ok(())
    };
    let mut sink = |piece: &[u8]| {
        gcode.extend_from_slice(piece);
        Ok(())
    };
    let sliced = clayforge::slice(stl, profile, None, &mut watch, &mut sink)?;
    texts.last_mut().expect("a chain has stages").1 = gcode;
    Ok(Run { texts, sliced })
}

/// Slices in memory what must be sliceable.
pub fn sliced(part: &str, stl: &[u8], profile: &Profile) -> Run {
    slice(stl, profile).unwrap_or_else(|error| panic!("{part}: {error}"))
}

/// Runs one stage from text to text.
pub fn craft(
    stage: &str,
    text: &[u8],
    profile: &Profile,
    notes: &mut Notes,
) -> Result<Vec<u8>, clayforge::Error> {
    let mut out = Vec::new();
    clayforge::craft(stage, text, profile, notes, &mut |piece| {
        out.extend_from_slice(piece);
        Ok(())
    })?;
    Ok(out)
}

// Parts. Lengths are millimetres.

/// Triangles, counter-clockwise seen from outside.
pub type Triangles = Vec<Triangle>;

/// A part that is an example of the project.
pub fn example(name: &str) -> Vec<u8> {
    let path = root().join("examples").join(format!("{name}.stl"));
    fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The triangles as a text STL.
pub fn text_stl(triangles: &Triangles) -> String {
    let mut text = "solid part\n".to_owned();
    for triangle in triangles {
        text.push_str(" facet normal 0 0 0\n  outer loop\n");
        for [x, y, z] in triangle {
            let _ = writeln!(text, "   vertex {x} {y} {z}");
        }
        text.push_str("  endloop\n endfacet\n");
    }
    text.push_str("endsolid part\n");
    text
}

/// A box between two corners.
pub fn cuboid(low: [f64; 3], high: [f64; 3]) -> Triangles {
    let outline = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
    prism(&outline, low[2], high[2])
}

/// An upright prism over a convex outline that turns counter-clockwise.
pub fn prism(outline: &[[f64; 2]], low: f64, high: f64) -> Triangles {
    let mut triangles = Vec::new();
    let at = |[x, y]: [f64; 2], z: f64| [x, y, z];
    for (index, &from) in outline.iter().enumerate() {
        let to = outline[(index + 1) % outline.len()];
        triangles.push([at(from, low), at(to, low), at(to, high)]);
        triangles.push([at(from, low), at(to, high), at(from, high)]);
    }
    for pair in outline[1..].windows(2) {
        triangles.push([at(outline[0], low), at(pair[1], low), at(pair[0], low)]);
        triangles.push([at(outline[0], high), at(pair[0], high), at(pair[1], high)]);
    }
    triangles
}

/// A regular polygon around the origin, counter-clockwise; the same bits on every platform, which `f64::sin` is not.
pub fn polygon(corners: usize, radius: f64) -> Vec<[f64; 2]> {
    let at = |index: usize| {
        let angle = Angle::from_degrees(360.0 * index as f64 / corners as f64).expect("an angle");
        let direction = angle.direction();
        [direction.x, direction.y].map(|share| radius * f64::from(share) / 1e6)
    };
    (0..corners).map(at).collect()
}

/// A tube of 48 corners.
pub fn tube(outer: f64, inner: f64, height: f64) -> Triangles {
    let (outside, inside) = (polygon(48, outer), polygon(48, inner));
    let at = |[x, y]: [f64; 2], z: f64| [x, y, z];
    let mut triangles = Vec::new();
    for index in 0..48 {
        let next = (index + 1) % 48;
        let (a, b, c, d) = (outside[index], outside[next], inside[next], inside[index]);
        let mut quad = |one, two, three, four| triangles.extend([[one, two, three], [one, three, four]]);
        quad(at(a, 0.0), at(b, 0.0), at(b, height), at(a, height));
        quad(at(d, height), at(c, height), at(c, 0.0), at(d, 0.0));
        quad(at(a, height), at(b, height), at(c, height), at(d, height));
        quad(at(d, 0.0), at(c, 0.0), at(b, 0.0), at(a, 0.0));
    }
    triangles
}

/// The test meshes of the specification, at three times their size where a clay bead would not fit.
pub fn meshes() -> Vec<(&'static str, Triangles)> {
    let two = [cuboid([0.0; 3], [10.0, 10.0, 10.0]), cuboid([30.0, 0.0, 0.0], [40.0, 10.0, 10.0])].concat();
    vec![
        ("cube", cuboid([0.0; 3], [20.0, 20.0, 10.0])),
        ("two", two),
        ("cyl", prism(&polygon(48, 15.0), 0.0, 12.0)),
        ("ring", tube(15.0, 8.0, 10.0)),
        ("bridge", bridge()),
        ("mushroom", mushroom()),
        ("cone", cone()),
    ]
}

/// A table of two legs: profile in x and z, 10 deep.
pub fn bridge() -> Triangles {
    let (near, far) = (0.0, 10.0);
    let outline = [
        [0.0, 0.0],
        [5.0, 0.0],
        [5.0, 4.0],
        [25.0, 4.0],
        [25.0, 0.0],
        [30.0, 0.0],
        [30.0, 6.0],
        [25.0, 6.0],
        [5.0, 6.0],
        [0.0, 6.0],
    ];
    let faces = [[0, 1, 2], [0, 2, 8], [0, 8, 9], [2, 3, 7], [2, 7, 8], [3, 4, 5], [3, 5, 6], [3, 6, 7]];
    let at = |index: usize, y: f64| [outline[index][0], y, outline[index][1]];
    let mut triangles = Vec::new();
    for [a, b, c] in faces {
        // Seen from the front, x goes right and z up, so that this order faces the viewer.
        triangles.push([at(a, near), at(b, near), at(c, near)]);
        triangles.push([at(a, far), at(c, far), at(b, far)]);
    }
    for index in 0..outline.len() {
        let next = (index + 1) % outline.len();
        triangles.push([at(index, near), at(index, far), at(next, far)]);
        triangles.push([at(index, near), at(next, far), at(next, near)]);
    }
    triangles
}

/// A cap on a column.
fn mushroom() -> Triangles {
    [cuboid([-5.0, -5.0, 0.0], [5.0, 5.0, 6.0]), cuboid([-12.0, -12.0, 6.0], [12.0, 12.0, 10.0])].concat()
}

/// A cone of 64 corners.
fn cone() -> Triangles {
    let base = polygon(64, 15.0);
    let mut triangles = Vec::new();
    for index in 0..base.len() {
        let ([x, y], [u, v]) = (base[index], base[(index + 1) % base.len()]);
        triangles.push([[x, y, 0.0], [u, v, 0.0], [0.0, 0.0, 15.0]]);
        triangles.push([[0.0, 0.0, 0.0], [u, v, 0.0], [x, y, 0.0]]);
    }
    triangles
}
