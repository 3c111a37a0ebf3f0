//! Chores.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::process::ExitCode;

mod examples;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let result = match args.split_first() {
        Some((name, args)) if name == "examples" => examples::run(args),
        _ => {
            Err("usage: cargo xtask examples [--dir DIR] | examples --vase TRIANGLES --out FILE".to_string())
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
