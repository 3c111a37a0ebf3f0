//! The example meshes, made from formulas: the same bytes on every machine.

use std::f64::consts::TAU;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// Vertices in millimetres and triangles, counter-clockwise seen from outside.
pub type Mesh = (Vec<[f32; 3]>, Vec<[u32; 3]>);

/// `examples [--dir DIR]` writes all examples; `examples --vase TRIANGLES --out FILE` one vase of any fineness.
pub fn run(args: &[String]) -> Result<(), String> {
    let (mut dir, mut triangles, mut out) = (PathBuf::from("examples"), None, None);
    let mut args = args.iter();
    while let Some(name) = args.next() {
        let value = args.next().ok_or_else(|| format!("`{name}` needs a value"))?;
        match name.as_str() {
            "--dir" => dir = PathBuf::from(value),
            "--out" => out = Some(PathBuf::from(value)),
            "--vase" => {
                triangles = Some(value.parse().map_err(|_| format!("`{value}` is no number of triangles"))?);
            }
            _ => return Err(format!("`{name}` is not known; there are `--dir`, `--vase` and `--out`")),
        }
    }
    match (triangles, out) {
        (Some(triangles), Some(out)) => write(&out, "vase", &vase(triangles)),
        (None, None) => {
            std::fs::create_dir_all(&dir).map_err(|error| format!("{}: {error}", dir.display()))?;
            all()
                .into_iter()
                .try_for_each(|(name, mesh)| write(&dir.join(format!("{name}.stl")), name, &mesh))
        }
        _ => Err("`--vase` and `--out` belong together".to_string()),
    }
}

/// Every example by its name.
fn all() -> Vec<(&'static str, Mesh)> {
    vec![
        ("vase", vase(3_960)),
        ("cup", cup()),
        ("bowl", bowl()),
        ("tile", tile()),
        ("pair", pair()),
        ("cube", cube(40.0)),
    ]
}

/// A solid vase of five lobes, twisted by 60° on its 100 mm of height, with a waist; about 70 mm wide.
///
/// It has the even number of triangles nearest to the wanted that makes whole rings.
pub fn vase(triangles: usize) -> Mesh {
    // Two triangles for each step around and each step up, the two ends included. Where the number allows it, the
    // steps are about as wide as high.
    let half = (triangles / 2).max(12);
    let ideal = libm::sqrt(half as f64 * 2.0) as usize;
    let around = (ideal / 2..=ideal)
        .rev()
        .find(|around| *around >= 6 && half.is_multiple_of(*around))
        .unwrap_or(ideal);
    let rings = (half / around).max(2);
    let mut profile = vec![[0.0, 0.0]];
    profile.extend((0..rings).map(|ring| {
        let up = ring as f64 / (rings - 1) as f64;
        // Wide at the belly, narrow at the waist, open at the lip.
        [26.5 + 5.0 * libm::sin(TAU * (up * 0.95 + 0.02)) + 2.0 * up, 100.0 * up]
    }));
    profile.push([0.0, 100.0]);
    revolve(&profile, around, |[radius, z], angle| {
        let lobed = radius * (1.0 + 0.09 * libm::cos(5.0 * angle));
        polar(lobed, angle + TAU / 6.0 * z / 100.0, z)
    })
}

/// A straight cup: 70 mm wide, 80 mm high, a wall of 6.4 mm, a base of 6 mm.
fn cup() -> Mesh {
    let profile = [[0.0, 0.0], [35.0, 0.0], [35.0, 80.0], [28.6, 80.0], [28.6, 6.0], [0.0, 6.0]];
    revolve(&profile, 96, |[radius, z], angle| polar(radius, angle, z))
}

/// A bowl that flares from a foot: 130 mm wide, 52 mm high, a wall of about 6.4 mm.
fn bowl() -> Mesh {
    const STEPS: usize = 12;
    // The middle of the wall is a quarter of an ellipse; the two sides lie half a wall to either side of it.
    let side = |step: usize, offset: f64| {
        let angle = TAU / 4.0 * step as f64 / STEPS as f64;
        let (cos, sin) = (libm::cos(angle), libm::sin(angle));
        let (out, up) = (sin / 62.0, -cos / 43.0);
        let length = libm::sqrt(out * out + up * up);
        [62.0 * sin + offset * out / length, 52.0 - 43.0 * cos + offset * up / length]
    };
    let mut profile = vec![[0.0, 0.0], [24.0, 0.0], [24.0, 6.0]];
    // The foot ends where the outside is wider than it.
    profile.extend((0..=STEPS).map(|step| side(step, 3.2)).filter(|[radius, z]| *radius > 26.0 && *z > 6.0));
    profile.extend((0..=STEPS).rev().map(|step| side(step, -3.2)));
    revolve(&profile, 80, |[radius, z], angle| polar(radius, angle, z))
}

/// A tile of 100 by 100 mm: 6 mm thick, with a pattern raised by 3 mm.
fn tile() -> Mesh {
    const CELLS: usize = 40;
    heightfield(CELLS, 100.0, |x, y| {
        let wave = libm::cos(TAU * x / 50.0) * libm::cos(TAU * y / 50.0);
        // Flat hills and flat valleys with slopes between them, and a flat rim.
        let rim = x.abs().max(y.abs()) > 45.0;
        if rim { 6.0 } else { 6.0 + 3.0 * (0.5 + 1.5 * wave).clamp(0.0, 1.0) }
    })
}

/// Two pieces in one file, 25 mm apart: a round post and one of six lobes.
fn pair() -> Mesh {
    let post = |lobes: f64, at: f64| {
        let profile = [[0.0, 0.0], [15.0, 0.0], [15.0, 12.0], [12.0, 24.0], [12.0, 30.0], [0.0, 30.0]];
        revolve(&profile, 72, move |[radius, z], angle| {
            let [x, y, z] = polar(radius * (1.0 - lobes * (0.5 - 0.5 * libm::cos(6.0 * angle))), angle, z);
            [x + at, y, z]
        })
    };
    let (mut vertices, mut triangles) = post(0.0, -27.5);
    let other = post(0.15, 27.5);
    let first = vertices.len() as u32;
    vertices.extend(other.0);
    triangles.extend(other.1.iter().map(|triangle| triangle.map(|vertex| vertex + first)));
    (vertices, triangles)
}

/// A cube, for checking the machine with a ruler.
fn cube(size: f32) -> Mesh {
    let side = |bit: u32| if bit == 0 { -size / 2.0 } else { size / 2.0 };
    let vertices =
        (0..8).map(|bits| [side(bits & 1), side(bits & 2), if bits & 4 == 0 { 0.0 } else { size }]).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
    (vertices, quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect())
}

pub fn polar(radius: f64, angle: f64, z: f64) -> [f64; 3] {
    [radius * libm::cos(angle), radius * libm::sin(angle), z]
}

fn narrow(point: [f64; 3]) -> [f32; 3] {
    point.map(|value| value as f32)
}

/// Turns a profile of radius and height around the z axis. It starts and ends on the axis, and runs outwards along
/// the bottom, so that the surface is closed and its outside is out.
pub fn revolve(profile: &[[f64; 2]], around: usize, place: impl Fn([f64; 2], f64) -> [f64; 3]) -> Mesh {
    let [bottom, rings @ .., top] = profile else { return Mesh::default() };
    let around = around as u32;
    let mut vertices = vec![narrow(place(*bottom, 0.0))];
    for ring in rings {
        vertices
            .extend((0..around).map(|step| narrow(place(*ring, TAU * f64::from(step) / f64::from(around)))));
    }
    vertices.push(narrow(place(*top, 0.0)));

    let at = |ring: u32, step: u32| 1 + ring * around + step % around;
    let (last, end) = (rings.len() as u32 - 1, vertices.len() as u32 - 1);
    let mut triangles: Vec<[u32; 3]> = (0..around).map(|step| [0, at(0, step + 1), at(0, step)]).collect();
    for ring in 0..last {
        triangles.extend((0..around).flat_map(|step| {
            let [a, b, c, d] =
                [at(ring, step), at(ring, step + 1), at(ring + 1, step + 1), at(ring + 1, step)];
            [[a, b, c], [a, c, d]]
        }));
    }
    triangles.extend((0..around).map(|step| [end, at(last, step), at(last, step + 1)]));
    (vertices, triangles)
}

/// A square block, centred on the axis, with a flat bottom and a top of the given height.
fn heightfield(cells: usize, size: f64, height: impl Fn(f64, f64) -> f64) -> Mesh {
    let count = cells as u32 + 1;
    let along = |index: u32| size * (f64::from(index) / cells as f64 - 0.5);
    let mut vertices = Vec::new();
    for row in 0..count {
        vertices.extend((0..count).map(|column| {
            let (x, y) = (along(column), along(row));
            narrow([x, y, height(x, y)])
        }));
    }
    let at = |column: u32, row: u32| row * count + column;
    let mut triangles = Vec::new();
    for row in 0..count - 1 {
        triangles.extend((0..count - 1).flat_map(|column| {
            let [a, b] = [at(column, row), at(column + 1, row)];
            let [c, d] = [at(column + 1, row + 1), at(column, row + 1)];
            [[a, b, c], [a, c, d]]
        }));
    }
    // The rim counter-clockwise, its copy on the bed, and a fan below.
    let end = count - 1;
    let rim: Vec<u32> = (0..end)
        .map(|step| at(step, 0))
        .chain((0..end).map(|step| at(end, step)))
        .chain((0..end).map(|step| at(end - step, end)))
        .chain((0..end).map(|step| at(0, end - step)))
        .collect();
    let first = vertices.len() as u32;
    for vertex in &rim {
        let [x, y, _] = vertices[*vertex as usize];
        vertices.push([x, y, 0.0]);
    }
    let centre = vertices.len() as u32;
    vertices.push([0.0; 3]);
    for (step, vertex) in rim.iter().enumerate() {
        let next = (step + 1) % rim.len();
        let (low, low_next) = (first + step as u32, first + next as u32);
        triangles.extend([[low, low_next, rim[next]], [low, rim[next], *vertex], [centre, low_next, low]]);
    }
    (vertices, triangles)
}

/// Writes a binary STL.
pub fn write(path: &Path, name: &str, mesh: &Mesh) -> Result<(), String> {
    let file = File::create(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut file = BufWriter::with_capacity(1 << 20, file);
    encode(&mut file, name, mesh)
        .and_then(|()| file.flush())
        .map_err(|error| format!("{}: {error}", path.display()))
}

pub fn encode(out: &mut impl Write, name: &str, (vertices, triangles): &Mesh) -> std::io::Result<()> {
    // Some readers take a header that starts with `solid` for text.
    write!(out, "{:<80.80}", format!("clayforge example: {name}, millimetres"))?;
    out.write_all(&(triangles.len() as u32).to_le_bytes())?;
    for triangle in triangles {
        let corners = triangle.map(|vertex| vertices[vertex as usize]);
        let mut record = [0u8; 50];
        let numbers = normal(corners).into_iter().chain(corners.into_iter().flatten());
        for (slot, number) in record.chunks_exact_mut(4).zip(numbers) {
            slot.copy_from_slice(&number.to_le_bytes());
        }
        out.write_all(&record)?;
    }
    Ok(())
}

fn normal([a, b, c]: [[f32; 3]; 3]) -> [f32; 3] {
    let from_a = |point: [f32; 3]| [0, 1, 2].map(|axis| f64::from(point[axis]) - f64::from(a[axis]));
    let (b, c) = (from_a(b), from_a(c));
    let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
    let length = libm::sqrt(cross.iter().map(|value| value * value).sum());
    cross.map(|value| (value / length) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(name: &str, mesh: &Mesh) -> Vec<u8> {
        let mut bytes = Vec::new();
        encode(&mut bytes, name, mesh).expect("memory takes everything");
        bytes
    }

    #[test]
    fn every_example_is_a_closed_body_that_stands_on_the_bed() {
        for (name, mesh) in all() {
            let bytes = bytes(name, &mesh);
            assert!(bytes.len() <= 200_000, "{name} has {} bytes", bytes.len());
            let import = import::Import::default().read(&bytes).expect(name);
            assert_eq!(import.report.notes(), Vec::<String>::new(), "{name}");
            let mesh = import.mesh;
            assert_eq!(mesh.open_edges(), 0, "{name}");
            assert!(mesh.volume() > 10_000.0, "{name} holds {} mm³", mesh.volume());
            let pieces = if name == "pair" { 2 } else { 1 };
            assert_eq!(
                (mesh.vertices.len() + mesh.faces.len()) as i64 - mesh.edges.len() as i64,
                2 * pieces,
                "{name}"
            );
            let bounds = mesh.bounds();
            assert_eq!(bounds.min.z, 0, "{name}");
            for (min, max) in [(bounds.min.x, bounds.max.x), (bounds.min.y, bounds.max.y)] {
                // Five lobes reach farther on one side of their axis than on the other.
                assert!((min + max).abs() < 4000, "{name} lies from {min} to {max}");
            }
        }
    }

    /// Opposite directions on every edge: no face is inside out.
    #[test]
    fn every_example_is_wound_one_way() {
        for (name, (_, triangles)) in all() {
            let mut sides: Vec<[u32; 2]> =
                triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]).collect();
            let count = sides.len();
            sides.sort_unstable();
            sides.dedup();
            assert_eq!(sides.len(), count, "{name}");
        }
    }

    #[test]
    fn a_vase_has_the_triangles_asked_for() {
        for triangles in [1_000, 100_000, 1_000_000] {
            assert_eq!(vase(triangles).1.len(), triangles);
        }
    }

    #[test]
    fn the_cup_has_its_size() {
        let mesh = import::Import::default().read(&bytes("cup", &cup())).expect("a cup").mesh;
        let bounds = mesh.bounds();
        assert_eq!((bounds.max.x, bounds.max.z), (35_000, 80_000));
        let exact = TAU / 2.0 * (35.0 * 35.0 * 80.0 - 28.6 * 28.6 * 74.0);
        assert!((mesh.volume() / exact - 1.0).abs() < 0.002);
    }
}
