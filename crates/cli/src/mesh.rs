//! `clayforge mesh`.

use crate::args::Mesh;
use crate::craft::read;
use crate::output::{print, put};
use crate::profile;
use crate::report::{self, Done};
use clayforge::mesh::{Diagnosis, Repairs, binary_stl};
use clayforge::{Inspection, Notes, read_part, repaired};
use serde_json::{Value as Json, json};
use std::fmt::Write;

/// Says what a part is and what is wrong with it; writes it repaired if that is wanted.
pub fn run(mesh: &Mesh) -> Done {
    let profile = profile::load(&mesh.settings)?;
    let name = mesh.part.display().to_string();
    let mut notes = Notes::default();
    let part = read_part(&read(&mesh.part)?, &profile, &mut notes)
        .map_err(|error| report::about(&mesh.part, error))?;
    let before = Inspection::of(&part, &profile);
    let after = mesh.repair.then(|| {
        let (sound, done) = repaired(&part, &profile);
        let inspection = Inspection::of(&sound, &profile);
        (sound, done, inspection)
    });
    if let (Some((sound, ..)), Some(output)) = (&after, &mesh.output) {
        let title = mesh.part.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        put(output, &binary_stl(sound, &title))?;
    }
    let to_stdout = mesh.output.as_ref().is_some_and(|output| output.as_os_str() == "-");
    let text = if mesh.json {
        let mut whole = as_json(&before, &notes);
        if let (Some((_, done, after)), Json::Object(whole)) = (&after, &mut whole) {
            whole.insert("repairs".to_owned(), repairs_as_json(done));
            whole.insert("repaired".to_owned(), as_json(after, &Notes::default()));
        }
        format!("{whole:#}\n")
    } else {
        let mut text = described(&name, &before, &notes);
        if let Some((_, done, after)) = &after {
            text.push_str("repaired:\n");
            done.notes().iter().for_each(|note| _ = writeln!(text, "  {note}"));
            text.push_str(&described("the repaired part", after, &Notes::default()));
        }
        text
    };
    // The part and its description do not mix.
    if to_stdout {
        report::say(&text);
        return Ok(());
    }
    print(&text)
}

fn mm(microns: impl Into<f64>) -> f64 {
    microns.into() / 1000.0
}

/// The faults that a mesh can have: key, count, and what is said of it.
fn faults(found: &Diagnosis) -> [(&'static str, usize, &'static str); 8] {
    [
        ("open_edges", found.open_edges, "open edges"),
        ("holes", found.holes, "holes"),
        ("non_manifold_edges", found.non_manifold_edges, "edges with more than two faces"),
        ("flipped_faces", found.flipped, "flipped faces"),
        ("inside_out_shells", found.inside_out, "shells inside out"),
        ("duplicate_faces", found.duplicate, "duplicate faces"),
        ("degenerate_faces", found.degenerate, "faces without area"),
        ("self_intersections", found.crossings, "pairs of faces that run through each other"),
    ]
}

fn described(name: &str, inspection: &Inspection, notes: &Notes) -> String {
    let found = &inspection.diagnosis;
    let (min, max) = (found.bounds.min, found.bounds.max);
    let size = [(min.x, max.x), (min.y, max.y), (min.z, max.z)].map(|(low, high)| mm(high) - mm(low));
    let verdict = if found.is_sound() { "sound" } else { "not sound" };
    let mut text = format!("{name}: {} faces, {} vertices, {verdict}\n", found.faces, found.vertices);
    // Writing to a string cannot fail.
    let _ = writeln!(text, "  size      {:.1} × {:.1} × {:.1} mm", size[0], size[1], size[2]);
    let _ = writeln!(text, "  from      x {:.1} y {:.1} z {:.1} mm", mm(min.x), mm(min.y), mm(min.z));
    let _ = writeln!(text, "  volume    {:.2} ml", found.volume / 1000.0);
    let _ = writeln!(text, "  surface   {:.1} cm²", found.area / 100.0);
    let _ = writeln!(text, "  shells    {}", found.shells);
    for (_, count, what) in faults(found).into_iter().filter(|(_, count, _)| *count > 0) {
        let most = if count >= Diagnosis::MOST_CROSSINGS { " and more" } else { "" };
        let _ = writeln!(text, "  fault     {count}{most} {what}");
    }
    if found.one_sided {
        text.push_str("  fault     a surface with one side only\n");
    }
    if let (Some((thick, at)), Some(beads)) = (found.thinnest_wall, inspection.thinnest_in_beads()) {
        let _ = writeln!(
            text,
            "  thinnest  {:.2} mm, {beads:.1} beads, at x {:.1} y {:.1} z {:.1}",
            mm(thick),
            mm(at.x),
            mm(at.y),
            mm(at.z)
        );
    }
    match found.overhang {
        Some(lowest) => {
            let at = lowest.at;
            let _ = writeln!(
                text,
                "  overhang  {:.0}° from the level, {:.1} cm² like it, at x {:.1} y {:.1} z {:.1}",
                lowest.angle,
                lowest.area / 100.0,
                mm(at.x),
                mm(at.y),
                mm(at.z)
            );
        }
        None => text.push_str("  overhang  none\n"),
    }
    let _ = match found.stand.margin {
        Some(margin) if margin > 0.0 => {
            writeln!(text, "  stands    yes, its weight {:.1} mm inside the footprint", mm(margin))
        }
        Some(margin) => {
            writeln!(text, "  stands    no, its weight {:.1} mm outside the footprint", mm(-margin))
        }
        None => writeln!(text, "  stands    not known: it encloses nothing"),
    };
    for line in notes.summary() {
        let _ = writeln!(text, "  note      {line}");
    }
    text
}

fn as_json(inspection: &Inspection, notes: &Notes) -> Json {
    let found = &inspection.diagnosis;
    let (min, max) = (found.bounds.min, found.bounds.max);
    let place = |at: [i32; 3]| at.map(mm);
    let mut whole = json!({
        "faces": found.faces,
        "vertices": found.vertices,
        "sound": found.is_sound(),
        "min": place([min.x, min.y, min.z]),
        "max": place([max.x, max.y, max.z]),
        "size": [mm(max.x) - mm(min.x), mm(max.y) - mm(min.y), mm(max.z) - mm(min.z)],
        "volume_mm3": found.volume,
        "surface_mm2": found.area,
        "shells": found.shells,
        "one_sided": found.one_sided,
        "thinnest_wall": found.thinnest_wall.map(|(thick, at)| json!({
            "mm": mm(thick),
            "beads": inspection.thinnest_in_beads(),
            "at": place([at.x, at.y, at.z]),
        })),
        "overhang": found.overhang.map(|lowest| json!({
            "angle": lowest.angle,
            "area_mm2": lowest.area,
            "at": place([lowest.at.x, lowest.at.y, lowest.at.z]),
        })),
        "stands": found.stand.margin.map(|_| found.stand.stands()),
        "stand_margin_mm": found.stand.margin.map(mm),
        "centre_of_mass": found.stand.centre.map(|centre| centre.map(mm)),
        "notes": notes.summary(),
    });
    if let Json::Object(whole) = &mut whole {
        whole.extend(faults(found).map(|(key, count, _)| (key.to_owned(), json!(count))));
    }
    whole
}

fn repairs_as_json(done: &Repairs) -> Json {
    json!({
        "welded_vertices": done.welded,
        "degenerate_faces": done.degenerate,
        "duplicate_faces": done.doubled,
        "split_sides": done.split,
        "turned_faces": done.turned,
        "turned_shells": done.shells_turned,
        "holes_closed": done.holes,
        "holes_left": done.holes_left,
        "widest_hole_mm": mm(done.widest_hole as f64),
        "open_edges_before": done.open_before,
        "open_edges_after": done.open_after,
        "one_sided": done.one_sided,
    })
}
