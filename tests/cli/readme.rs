//! The README: every command in it works.

use crate::command::{Room, program};
use crate::support::{root, text_of};
use std::fs;
use std::process::Command;

/// The commands of the README, each in a line of a `sh` fence.
fn readme_commands() -> Vec<String> {
    let text = text_of(&root().join("README.md"));
    let mut commands = Vec::new();
    let mut inside = false;
    let mut joined = String::new();
    for line in text.lines() {
        if line.starts_with("```") {
            inside = !inside && line.trim() == "```sh";
        } else if inside {
            let line = line.split(" #").next().unwrap_or("").trim();
            joined.push_str(line.trim_end_matches('\\'));
            if !line.ends_with('\\') {
                commands.push(std::mem::take(&mut joined));
            }
        }
    }
    commands
}

/// The README's commands work in a copy of what a reader has: the examples and the profiles.
#[cfg(unix)]
#[test]
fn the_commands_of_the_readme_work() {
    assert!(root().join("README.md").exists(), "there is no README.md yet");
    let room = Room::new();
    for folder in ["examples", "profiles"] {
        fs::create_dir(room.path(folder)).expect("a new folder");
        for entry in fs::read_dir(root().join(folder)).expect("the folder is there").flatten() {
            fs::copy(entry.path(), room.path(folder).join(entry.file_name())).expect("a copy");
        }
    }
    let bin = room.path("bin");
    fs::create_dir(&bin).expect("a new folder");
    std::os::unix::fs::symlink(program(), bin.join("clayforge")).expect("a link");
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap_or_default());
    let mut count = 0;
    for command in readme_commands() {
        // What cargo would build is built already.
        let cargo =
            ["cargo run --release --", "cargo run --"].iter().find_map(|start| command.strip_prefix(start));
        let command = match cargo {
            Some(words) => format!("clayforge{words}"),
            None if command.starts_with("clayforge ") => command,
            None => continue,
        };
        count += 1;
        let output = Command::new("sh")
            .args(["-c", &command])
            .current_dir(room.path(""))
            .env("PATH", &path)
            .env("XDG_CONFIG_HOME", room.path("config"))
            .output()
            .expect("sh runs");
        assert!(output.status.success(), "{command}\n{}", String::from_utf8_lossy(&output.stderr));
    }
    assert!(count > 0, "README.md has no command to try");
}
