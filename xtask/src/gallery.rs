//! The gallery of the documentation: forms that break spirals, as coil winds them.

use crate::examples::{Mesh, encode, polar, revolve};
use clayforge::{Document, Event, Profile, slice};
use skein::{Line, Nozzle, Point3, Skein};
use std::f64::consts::TAU;
use std::fmt::Write;
use std::fs;

/// A form, what is hard about it, and how many beads its wall gets.
struct Piece {
    name: &'static str,
    about: &'static str,
    walls: u32,
    mesh: Mesh,
}

/// Draws every form and writes the page.
pub fn run() -> Result<(), String> {
    let docs = crate::root().join("docs");
    fs::create_dir_all(docs.join("gallery")).map_err(|error| error.to_string())?;
    let mut page = String::from(
        "# Gallery\n\nForms that break spirals, wound by [coil](../crates/stages/coil/README.md) with the profile `vase`: \
         from the side, and the way of one layer of the base, one in the middle and the last, with the rim turn. \
         `cargo xtask gallery` draws them; `cargo xtask turns FILE.gcode` measures the clay of every turn.\n",
    );
    for piece in pieces() {
        let (skein, notes) = wound(&piece).map_err(|error| format!("{}: {error}", piece.name))?;
        let path = docs.join(format!("gallery/{}.svg", piece.name));
        fs::write(&path, drawn(&skein)).map_err(|error| format!("{}: {error}", path.display()))?;
        let threads = skein.lines().filter(|line| **line == Line::On).count();
        let layers = skein.layers.len();
        let beads = if piece.walls == 1 { "one bead".to_owned() } else { format!("{} beads", piece.walls) };
        let threads = if threads == 1 { "one thread".to_owned() } else { format!("{threads} threads") };
        // Writing to a string cannot fail.
        let _ = write!(
            page,
            "\n## {}\n\n{} {layers} layers, {beads}: {threads}.\n\n![{}](gallery/{}.svg)\n",
            piece.name, piece.about, piece.name, piece.name
        );
        for note in notes {
            let _ = write!(page, "\n> {note}\n");
        }
    }
    fs::write(docs.join("gallery.md"), page).map_err(|error| error.to_string())
}

/// The forms.
fn pieces() -> Vec<Piece> {
    let plain = |[radius, z]: [f64; 2], angle: f64| polar(radius, angle, z);
    let straight = [[0.0, 0.0], [30.0, 0.0], [30.0, 60.0], [0.0, 60.0]];
    let turned = |place: &dyn Fn([f64; 2], f64) -> [f64; 3], around: usize| {
        let mut profile = vec![[0.0, 0.0]];
        profile.extend((0..=60).map(|step| [30.0, f64::from(step)]));
        profile.push([0.0, 60.0]);
        revolve(&profile, around, place)
    };
    let waist: Vec<[f64; 2]> = std::iter::once([0.0, 0.0])
        .chain((0..=60).map(|step| [26.0 + 7.0 * libm::cos(TAU * f64::from(step) / 60.0), f64::from(step)]))
        .chain([[0.0, 60.0]])
        .collect();
    let foot = [
        [0.0, 4.5],
        [17.0, 4.5],
        [17.0, 0.0],
        [20.2, 0.0],
        [20.2, 4.5],
        [32.0, 24.0],
        [32.0, 60.0],
        [0.0, 60.0],
    ];
    let slope = libm::tan(TAU / 12.0);
    vec![
        Piece { name: "cylinder", about: "The plain one.", walls: 1, mesh: revolve(&straight, 96, plain) },
        Piece {
            name: "cone",
            about: "Flares by 30\u{b0}.",
            walls: 1,
            mesh: revolve(&[[0.0, 0.0], [20.0, 0.0], [20.0 + 45.0 * slope, 45.0], [0.0, 45.0]], 96, plain),
        },
        Piece {
            name: "lobes",
            about: "Five lobes.",
            walls: 2,
            mesh: turned(
                &|[radius, z], angle| polar(radius * (1.0 + 0.14 * libm::cos(5.0 * angle)), angle, z),
                120,
            ),
        },
        Piece {
            name: "twist",
            about: "A square with sharp corners, twisted by a quarter.",
            walls: 1,
            mesh: turned(&|[radius, z], angle| polar(radius * 1.3, angle + TAU / 4.0 * z / 60.0, z), 4),
        },
        Piece {
            name: "square",
            about: "A square with sharp corners, on a base of lines there and back.",
            walls: 1,
            mesh: revolve(&[[0.0, 0.0], [40.0, 0.0], [40.0, 60.0], [0.0, 60.0]], 4, plain),
        },
        Piece { name: "waist", about: "Narrow in the middle.", walls: 3, mesh: revolve(&waist, 96, plain) },
        Piece {
            name: "leaning",
            about: "Leans by 30\u{b0}.",
            walls: 1,
            mesh: revolve(&straight, 96, |[radius, z], angle| {
                let [x, y, z] = polar(radius, angle, z);
                [x + z * slope, y, z]
            }),
        },
        Piece {
            name: "jug",
            about: "With a handle: where it stands free, layers are rings and a handle.",
            walls: 1,
            mesh: jug(),
        },
        Piece { name: "foot", about: "A cup on a foot ring.", walls: 1, mesh: revolve(&foot, 96, plain) },
    ]
}

/// A pot and a bow that reaches into it, as two closed bodies.
fn jug() -> Mesh {
    const STEPS: u32 = 24;
    const AROUND: u32 = 12;
    let (mut vertices, mut triangles) =
        revolve(&[[0.0, 0.0], [28.0, 0.0], [28.0, 70.0], [0.0, 70.0]], 96, |[radius, z], angle| {
            polar(radius, angle, z)
        });
    let first = vertices.len() as u32;
    for step in 0..=STEPS {
        // Half an ellipse from the wall above to the wall below.
        let bow = TAU / 2.0 * f64::from(step) / f64::from(STEPS);
        let (along, up) = (24.0 + 24.0 * libm::sin(bow), 35.0 + 20.0 * libm::cos(bow));
        for corner in 0..AROUND {
            let [out, side, _] = polar(5.0, TAU * f64::from(corner) / f64::from(AROUND), 0.0);
            let place = [along + out * libm::sin(bow), side, up + out * libm::cos(bow)];
            vertices.push(place.map(|value| value as f32));
        }
    }
    let at = |step: u32, corner: u32| first + step * AROUND + corner % AROUND;
    for step in 0..STEPS {
        for corner in 0..AROUND {
            let [a, b, c, d] =
                [at(step, corner), at(step, corner + 1), at(step + 1, corner + 1), at(step + 1, corner)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    for corner in 1..AROUND - 1 {
        triangles.push([at(0, 0), at(0, corner + 1), at(0, corner)]);
        triangles.push([at(STEPS, 0), at(STEPS, corner), at(STEPS, corner + 1)]);
    }
    (vertices, triangles)
}

impl Piece {
    fn profile(&self) -> Result<Profile, String> {
        let vase = Profile::built_in("vase").ok_or("there is no profile `vase`")?;
        let mut profile = vase.map_err(|error| error.to_string())?;
        let base = if self.name == "square" { "zig-zag" } else { "in-and-out" };
        for (key, value) in [("fill.walls", self.walls.to_string().as_str()), ("coil.base", base)] {
            profile.set(key, value).map_err(|error| error.to_string())?;
        }
        Ok(profile)
    }
}

/// The finished G-code of the forms that are one spiral, with layers of one height.
#[cfg(test)]
pub fn spirals() -> Vec<(&'static str, String)> {
    let spirals = pieces().into_iter().filter(|piece| !["jug", "foot"].contains(&piece.name));
    let sliced = spirals.map(|piece| {
        let mut part = Vec::new();
        encode(&mut part, piece.name, &piece.mesh).expect("memory");
        let mut profile = piece.profile().expect("a profile");
        profile.set("carve.first_layer_height", "1.5").expect("a setting");
        let mut gcode = Vec::new();
        let mut sink = |bytes: &[u8]| {
            gcode.extend_from_slice(bytes);
            Ok(())
        };
        slice(part, &profile, None, &mut |_| Ok(()), &mut sink).expect("a pot");
        (piece.name, String::from_utf8(gcode).expect("text"))
    });
    sliced.collect()
}

/// The skein behind coil, and what coil had to say.
fn wound(piece: &Piece) -> Result<(Skein, Vec<String>), String> {
    let mut part = Vec::new();
    encode(&mut part, piece.name, &piece.mesh).map_err(|error| error.to_string())?;
    let profile = piece.profile()?;
    let mut skein = None;
    let mut watch = |event: Event<'_>| {
        if let Event::Done { name: "coil", document: Document::Skein(wound), .. } = event {
            skein = Some(wound.clone());
        }
        Ok(())
    };
    let sliced =
        slice(part, &profile, None, &mut watch, &mut |_| Ok(())).map_err(|error| error.to_string())?;
    let notes = sliced.notes.summary().into_iter().filter(|note| note.starts_with("coil")).collect();
    Ok((skein.ok_or("the chain has no coil")?, notes))
}

/// From the side, and three layers from above.
fn drawn(skein: &Skein) -> String {
    const ROOM: f64 = 90.0;
    let beads: Vec<Vec<Vec<Point3>>> = beads(skein);
    let all: Vec<Point3> = beads.iter().flatten().flatten().copied().collect();
    let middle = |of: fn(&Point3) -> i32| {
        let (low, high) = (all.iter().map(of).min().unwrap_or(0), all.iter().map(of).max().unwrap_or(0));
        f64::midpoint(f64::from(low), f64::from(high)) / 1000.0
    };
    let (x, y) = (middle(|at| at.x), middle(|at| at.y));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {ROOM}\" width=\"1000\" fill=\"none\" \
         stroke-linejoin=\"round\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fffdf8\"/>\n",
        ROOM * 4.0
    );
    // A drawing of the side needs no more places than the eye can tell apart.
    let step = all.len().div_ceil(2_000).max(1);
    let side = beads.iter().flatten().map(|bead| {
        let ends = bead.iter().step_by(step).chain(bead.last());
        ends.map(|at| (f64::from(at.x) / 1000.0 - x + ROOM / 2.0, ROOM - 8.0 - f64::from(at.z) / 1000.0))
            .collect()
    });
    path(&mut svg, side, "stroke=\"#8a4b20\" stroke-width=\"0.5\"");
    let last = beads.len().saturating_sub(1);
    for (place, layer) in [0, last / 2, last].into_iter().enumerate() {
        let from_above = || {
            beads[layer].iter().map(|bead| {
                let left = ROOM * (place as f64 + 1.5) - x;
                let at = |at: &Point3| {
                    (f64::from(at.x) / 1000.0 + left, ROOM / 2.0 + y - f64::from(at.y) / 1000.0)
                };
                bead.iter().map(at).collect()
            })
        };
        path(&mut svg, from_above(), "stroke=\"#d9a47a\" stroke-width=\"3.1\" stroke-linecap=\"square\"");
        path(&mut svg, from_above(), "stroke=\"#5b2d10\" stroke-width=\"0.4\"");
    }
    svg.push_str("</svg>\n");
    svg
}

fn path(svg: &mut String, lines: impl Iterator<Item = Vec<(f64, f64)>>, style: &str) {
    let _ = write!(svg, "<path {style} d=\"");
    for line in lines {
        for (index, (x, y)) in line.iter().enumerate() {
            let _ = write!(svg, "{}{x:.1} {y:.1}", if index == 0 { 'M' } else { 'L' });
        }
    }
    svg.push_str("\"/>\n");
}

/// The beads of each layer.
fn beads(skein: &Skein) -> Vec<Vec<Vec<Point3>>> {
    let mut nozzle = Nozzle::default();
    skein
        .layers
        .iter()
        .map(|layer| {
            let mut beads: Vec<Vec<Point3>> = Vec::new();
            let mut laying = false;
            for line in &layer.lines {
                if let (Some(step), Some(from), true) = (line.as_move(), nozzle.at, nozzle.on) {
                    if !laying {
                        beads.push(vec![from]);
                    }
                    if let Some(bead) = beads.last_mut() {
                        bead.push(step.to);
                    }
                }
                laying = nozzle.on && (laying || line.as_move().is_some());
                nozzle.follow(line);
            }
            beads
        })
        .collect()
}
