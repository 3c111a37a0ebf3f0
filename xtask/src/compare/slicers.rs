//! How the slicers are asked for the same: two walls, two solid layers at the bottom and at the top, a fifth of lines
//! between, no skirt, support or retraction, a bed of 300 × 300 × 400 mm; threads as each likes.

use crate::process::said;
use std::f64::consts::FRAC_PI_4;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What is equal for all: mm.
pub struct Setting {
    /// As it stands in the table.
    pub name: &'static str,
    layer: f64,
    bead: f64,
    nozzle: f64,
    /// What E is counted in, for those who cannot count cubic millimetres.
    filament: f64,
}

/// One as potters print, one as printers of plastic do.
pub const SETTINGS: [Setting; 2] = [
    Setting { name: "clay", layer: 1.5, bead: 3.2, nozzle: 3.0, filament: 50.0 },
    Setting { name: "fine", layer: 0.2, bead: 0.45, nozzle: 0.4, filament: 1.75 },
];

/// The arguments for a setting, the part, the output and the room.
pub type Words = fn(&Setting, &Path, &Path, &Path) -> Result<Vec<String>, String>;

/// A program that slices.
pub struct Slicer {
    /// As it stands in the table.
    pub name: &'static str,
    /// Where it is.
    pub program: PathBuf,
    /// How it is asked to slice a part; what it must be told in a file goes into the room.
    pub words: Words,
    /// What a unit of its E is, in mm³.
    pub area: fn(&Setting) -> f64,
    /// How it is asked for its version.
    asked: &'static [&'static str],
}

impl Slicer {
    /// Its name with its version, as far as it tells.
    pub fn version(&self) -> String {
        let told = Command::new(&self.program).args(self.asked).stdin(Stdio::null()).output().ok();
        let text = told.map(|output| [output.stdout, output.stderr].concat()).unwrap_or_default();
        match number(&String::from_utf8_lossy(&text)) {
            Some(number) => format!("{} {number}", self.name),
            None => self.name.to_owned(),
        }
    }
}

/// The first number of a text that has two points in it, as versions have.
fn number(text: &str) -> Option<&str> {
    let numbers = text.split(|letter: char| !letter.is_ascii_digit() && letter != '.');
    numbers.map(|number| number.trim_matches('.')).find(|number| number.matches('.').count() == 2)
}

/// Ours, and those of the others that are there.
pub fn installed(ours: PathBuf) -> Vec<Slicer> {
    let mut slicers = vec![Slicer {
        name: "clayforge",
        program: ours,
        words: clayforge,
        area: |_| 1.0,
        asked: &["--version"],
    }];
    let path = std::env::var_os("PATH").unwrap_or_default();
    let others: [(_, _, Words, &'static [&'static str]); 3] = [
        ("CuraEngine", "CuraEngine", cura, &[]),
        ("PrusaSlicer", "prusa-slicer", prusa, &["--help"]),
        ("Slic3r", "slic3r", slic3r, &["--version"]),
    ];
    let area: fn(&Setting) -> f64 = |setting| FRAC_PI_4 * setting.filament * setting.filament;
    for (name, file, words, asked) in others {
        if let Some(program) =
            std::env::split_paths(&path).map(|folder| folder.join(file)).find(|path| path.is_file())
        {
            slicers.push(Slicer { name, program, words, area, asked });
        }
    }
    slicers
}

fn words(list: &[&str]) -> Vec<String> {
    list.iter().map(|word| (*word).to_owned()).collect()
}

fn path(path: &Path) -> String {
    path.display().to_string()
}

fn clayforge(setting: &Setting, part: &Path, out: &Path, _: &Path) -> Result<Vec<String>, String> {
    let Setting { layer, bead, nozzle, .. } = setting;
    let mut all = vec!["slice".to_owned(), path(part), "--quiet".to_owned(), "-o".to_owned(), path(out)];
    for set in [
        format!("carve.layer_height={layer}"),
        format!("carve.first_layer_height={layer}"),
        format!("carve.bead_width={bead}"),
        format!("machine.nozzle={nozzle}"),
        "fill.walls=2".to_owned(),
        "fill.base_layers=2".to_owned(),
        "fill.top_layers=2".to_owned(),
        "fill.density=0.2".to_owned(),
        "machine.bed=[300,300,400]".to_owned(),
        "machine.e_unit=\"mm3\"".to_owned(),
    ] {
        all.extend(["--set".to_owned(), set]);
    }
    Ok(all)
}

/// Where the definitions are that CuraEngine needs: `CURA_RESOURCES`, or where Debian's package `cura` has them.
pub fn cura_resources() -> String {
    std::env::var("CURA_RESOURCES").unwrap_or_else(|_| "/usr/share/cura/resources".to_owned())
}

fn cura(setting: &Setting, part: &Path, out: &Path, _: &Path) -> Result<Vec<String>, String> {
    let Setting { layer, bead, nozzle, filament, .. } = setting;
    let resources = cura_resources();
    let mut all = words(&["slice", "-j"]);
    all.push(format!("{resources}/definitions/fdmprinter.def.json"));
    let mut set = |key: &str, value: String| all.extend(["-s".to_owned(), format!("{key}={value}")]);
    for key in ["layer_height", "layer_height_0"] {
        set(key, layer.to_string());
    }
    for key in [
        "line_width",
        "wall_line_width",
        "wall_line_width_0",
        "wall_line_width_x",
        "infill_line_width",
        "skin_line_width",
    ] {
        set(key, bead.to_string());
    }
    set("infill_line_distance", (5.0 * bead).to_string());
    set("machine_nozzle_size", nozzle.to_string());
    for (key, value) in [
        ("machine_width", "300"),
        ("machine_depth", "300"),
        ("machine_height", "400"),
        ("wall_line_count", "2"),
        ("retraction_enable", "false"),
        ("infill_sparse_density", "20"),
        ("infill_pattern", "lines"),
        ("top_layers", "2"),
        ("bottom_layers", "2"),
        ("roofing_layer_count", "0"),
        ("adhesion_type", "none"),
        ("center_object", "true"),
    ] {
        set(key, value.to_owned());
    }
    set("material_diameter", filament.to_string());
    all.extend(words(&["-e0", "-s"]));
    all.push(format!("material_diameter={filament}"));
    all.extend(["-l".to_owned(), path(part), "-o".to_owned(), path(out)]);
    Ok(all)
}

fn prusa(setting: &Setting, part: &Path, out: &Path, room: &Path) -> Result<Vec<String>, String> {
    let Setting { name, layer, bead, nozzle, filament } = setting;
    let mut text = String::new();
    for key in
        ["", "first_layer_", "perimeter_", "external_perimeter_", "infill_", "solid_infill_", "top_infill_"]
    {
        let _ = writeln!(text, "{key}extrusion_width = {bead}");
    }
    let _ = writeln!(
        text,
        "nozzle_diameter = {nozzle}\nlayer_height = {layer}\nfirst_layer_height = {layer}\nmax_layer_height = {nozzle}\n\
         min_layer_height = 0.05\nfilament_diameter = {filament}\nperimeters = 2\nfill_density = 20%\n\
         fill_pattern = rectilinear\ntop_solid_layers = 2\nbottom_solid_layers = 2\nretract_length = 0\nskirts = 0\n\
         max_print_height = 400\nbed_shape = 0x0,300x0,300x300,0x300\nuse_relative_e_distances = 0"
    );
    let settings = room.join(format!("{name}.ini"));
    fs::write(&settings, text).map_err(|error| said(&settings, &error))?;
    Ok(vec![
        "--export-gcode".to_owned(),
        "--load".to_owned(),
        path(&settings),
        "-o".to_owned(),
        path(out),
        path(part),
    ])
}

fn slic3r(setting: &Setting, part: &Path, out: &Path, _: &Path) -> Result<Vec<String>, String> {
    let Setting { layer, bead, nozzle, filament, .. } = setting;
    let mut all = Vec::new();
    for (key, value) in [
        ("nozzle-diameter", nozzle.to_string()),
        ("layer-height", layer.to_string()),
        ("first-layer-height", layer.to_string()),
        ("extrusion-width", bead.to_string()),
        ("filament-diameter", filament.to_string()),
        ("perimeters", "2".to_owned()),
        ("fill-density", "20%".to_owned()),
        ("fill-pattern", "rectilinear".to_owned()),
        ("top-solid-layers", "2".to_owned()),
        ("bottom-solid-layers", "2".to_owned()),
        ("retract-length", "0".to_owned()),
        ("skirts", "0".to_owned()),
    ] {
        all.extend([format!("--{key}"), value]);
    }
    all.extend(["-o".to_owned(), path(out), path(part)]);
    Ok(all)
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_version_is_found_in_what_a_program_says() {
        for (text, version) in [
            ("[2026-11-22 22:40:12.116983] trace\nPrusaSlicer-2.5.0+UNKNOWN based on", Some("2.5.0")),
            ("\nCura_SteamEngine version 4.13.0\nCopyright (C) 2021.", Some("4.13.0")),
            ("1.3.0\n", Some("1.3.0")),
            ("usage: slicer 1.5 FILE", None),
        ] {
            assert_eq!(super::number(text), version);
        }
    }
}
