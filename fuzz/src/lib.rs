//! Mutated input for every reader and every chain: nothing may panic, hang or take memory without bound, and what is
//! accepted must keep the laws.
//!
//! * [`TARGETS`] is the table of what is fuzzed. A target is a function of bytes that panics when a law is broken and
//!   otherwise says in a few words what the bytes came to.
//! * [`Session`] mutates the corpus of a target. What a target says is its compass: an input that came to something
//!   new is kept and mutated on, so that no instrumented build is needed.
//! * [`minimised`] makes a finding small.
//!
//! Everything follows from the seed. The binary of this crate adds what a process can: a time limit, a limit of
//! memory, and files for what was found.

mod minimise;
mod mutate;
mod random;
mod session;
mod stl;
pub mod targets;

pub use minimise::minimised;
pub use mutate::Mutator;
pub use random::Random;
pub use session::{Finding, Session, attempt};
pub use stl::{Triangle, stl};
pub use targets::{TARGETS, Target, target};

use std::path::{Path, PathBuf};
use std::{fs, io};

/// The folder of the seeds of all targets, and of the findings that are not fixed yet.
pub fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus")
}

/// The files of a folder with their bytes, in the order of their names.
///
/// # Errors
/// When the folder or a file cannot be read.
pub fn seeds(folder: &Path) -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut seeds = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_file() {
            seeds.push((entry.file_name().to_string_lossy().into_owned(), fs::read(entry.path())?));
        }
    }
    seeds.sort();
    Ok(seeds)
}
