//! Chores that a potter never meets: the example parts, the pictures of the pages, the files of a new stage, figures
//! against other slicers and over the size of a part, what comes out of a slicer, and the clay of every turn of a spiral.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::path::{Path, PathBuf};
use std::process::ExitCode;

mod compare;
mod examples;
mod gallery;
mod growth;
mod new_stage;
mod page;
mod pictures;
mod process;
mod quality;
mod solid;
mod turns;

/// The folder of the workspace.
fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}

const USAGE: &str = "\
usage: cargo xtask examples [--dir DIR]                    the parts in examples/
       cargo xtask examples --vase TRIANGLES --out FILE    one vase of any fineness
       cargo xtask pictures                                docs/vase.svg and the pictures of the stage pages
       cargo xtask gallery                                 docs/gallery.md and its pictures
       cargo xtask turns FILE.gcode [--layer H] [--width W] [--area A]
                                                           the clay of every turn of a spiral against its gap
       cargo xtask quality PART.stl FILE.gcode [--area A] [--layers N]
                                                           what comes out: travels, what is bare, what lies over it
       cargo xtask new-stage NAME --after OTHER            the files of a stage, and the lines that register it
       cargo xtask growth [--clayforge BINARY] [--runs N]  time and memory over triangles and over layers, as curves and
                                                           tables in docs/performance.md
       cargo xtask compare [--clayforge BINARY] [--runs N] [--out FILE | --page] [PART.stl]...
                                                           time, memory and what comes out against the slicers that are
                                                           installed; `--page` puts it into docs/performance.md";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let result = match args.split_first() {
        Some((name, args)) if name == "examples" => examples::run(args),
        Some((name, args)) if name == "pictures" => pictures::run(args),
        Some((name, args)) if name == "turns" => turns::run(args),
        Some((name, args)) if name == "quality" => quality::run(args),
        Some((name, _)) if name == "gallery" => gallery::run(),
        Some((name, args)) if name == "new-stage" => new_stage::run(args),
        Some((name, args)) if name == "growth" => growth::run(args),
        Some((name, args)) if name == "compare" => compare::run(args),
        _ => Err(USAGE.to_string()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
