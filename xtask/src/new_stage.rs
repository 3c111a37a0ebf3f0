//! The files of a new stage, and the lines that register it: what it then lacks is the work itself.

use std::fs;
use std::path::Path;

/// `new-stage NAME --after OTHER`.
pub fn run(args: &[String]) -> Result<(), String> {
    let [name, after, other] = args else {
        return Err("usage: cargo xtask new-stage NAME --after OTHER".to_owned());
    };
    if after != "--after" {
        return Err(format!("`{after}` is not known; say `--after` and the stage before it"));
    }
    if name.is_empty() || !name.bytes().all(|byte| byte.is_ascii_lowercase()) {
        return Err(format!("`{name}` is no craft word: one word of small letters a to z"));
    }
    if clayforge::stage(other).is_none() {
        return Err(format!("there is no stage `{other}`"));
    }
    let root = crate::root();
    let folder = root.join("crates/stages").join(name);
    if folder.exists() {
        return Err(format!("{} exists already", folder.display()));
    }
    // What registers a stage, each behind the line of the other: file, how that line begins, the new line.
    let registrations = [
        ("Cargo.toml", format!("    \"crates/stages/{other}\""), format!("    \"crates/stages/{name}\",")),
        (
            "Cargo.toml",
            format!("{other} = {{ path"),
            format!("{name} = {{ path = \"crates/stages/{name}\" }}"),
        ),
        ("crates/clayforge/Cargo.toml", format!("{other}.workspace"), format!("{name}.workspace = true")),
        (
            "crates/clayforge/src/stages.rs",
            format!("{other}::"),
            format!("    off skein {name}::{}: \"Says what it is for.\";", type_of(name)),
        ),
    ];
    for (file, start, line) in &registrations {
        insert(&root.join(file), start, line)?;
    }
    for (file, text) in [
        ("Cargo.toml", CARGO.replace("NAME", name)),
        ("README.md", README.replace("NAME", name)),
        ("src/lib.rs", LIB.replace("WORD", name).replace("TYPE", &type_of(name))),
    ] {
        let path = folder.join(file);
        let write = || {
            path.parent().map_or(Ok(()), fs::create_dir_all)?;
            fs::write(&path, text)
        };
        write().map_err(|error| format!("{}: {error}", path.display()))?;
        println!("{}", path.display());
    }
    println!(
        "next: the page and the work; it is `off` in crates/clayforge/src/stages.rs until a profile wants it"
    );
    println!("next: its place among the ORDERS there, if something must come before or after it");
    Ok(())
}

/// Puts a line behind the first that holds a text in its code.
fn insert(path: &Path, start: &str, line: &str) -> Result<(), String> {
    let refuse = |error: std::io::Error| format!("{}: {error}", path.display());
    let text = fs::read_to_string(path).map_err(refuse)?;
    let mut lines: Vec<&str> = text.lines().collect();
    let place = lines
        .iter()
        .position(|old| old.starts_with(start) || old.split_whitespace().any(|word| word.starts_with(start)))
        .ok_or_else(|| format!("{}: there is no `{start}` to put it behind", path.display()))?;
    lines.insert(place + 1, line);
    fs::write(path, lines.join("\n") + "\n").map_err(refuse)
}

/// `hop` → `Hop`.
fn type_of(name: &str) -> String {
    name[..1].to_uppercase() + &name[1..]
}

const CARGO: &str = "\
[package]
name = \"NAME\"
description = \"The craft stage NAME.\"
version.workspace = true
edition.workspace = true
rust-version.workspace = true
license.workspace = true
publish.workspace = true

[lints]
workspace = true

[dependencies]
skein.workspace = true
";

const README: &str = "\
# NAME

Why a potter wants it.

## What it does, as a sentence that is true

```skein before
(<layer> 0.75 )
G1 X0.0 Y0.0 Z1.5
M101
G1 X20.0 Y0.0 Z1.5
M103
(</layer>)
```

```skein after
(<layer> 0.75 )
G1 X0.0 Y0.0 Z1.5
M101
G1 X20.0 Y0.0 Z1.5
M103
(</layer>)
```

## Works with

Which stages come before and after it, and why.

## Not for

What it leaves to others.
";

const LIB: &str = "\
#![doc = include_str!(\"../README.md\")]

use skein::{Error, Notes, Ratio, Settings, Skein, Stage};

/// Says what it is for.
#[derive(Clone, Debug, Settings)]
pub struct TYPE {
    /// What gets better and what gets worse when it grows.
    #[setting(default = 1.0, min = 0.0, max = 2.0)]
    pub amount: Ratio,
}

impl Stage for TYPE {
    const NAME: &'static str = \"WORD\";

    fn craft(&self, skein: Skein, notes: &mut Notes) -> Result<Skein, Error> {
        skein.rewrite(notes, |_index, layer, _notes| Ok(layer.lines))
    }
}
";
