//! The command `clayforge`: files, standard input and output, progress and exit codes around the library of that name.

mod args;
mod check;
mod craft;
mod dump;
mod edit;
mod emulate;
mod explain;
mod mesh;
mod output;
mod profile;
mod report;
mod slice;

use args::{Arguments, Command};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match &arguments.command {
        Command::Slice(slice) => slice::run(slice),
        Command::Craft(craft) => craft::run(craft),
        Command::Stages(stages) => explain::stages(stages),
        Command::Explain(topic) => explain::run(topic),
        Command::Profile(profile) => profile::run(profile),
        Command::Mesh(mesh) => mesh::run(mesh),
        Command::Check(check) => check::run(check),
        Command::Edit(edit) => edit::run(edit),
        Command::Emulate(emulate) => emulate::run(emulate),
    };
    report::exit(done)
}
