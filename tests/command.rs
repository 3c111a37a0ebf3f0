//! The command itself: built once, run in a folder of its own.

use crate::support::{name_of, root};
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::OnceLock;
use tempfile::TempDir;

/// The command, built once.
pub fn program() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        // This test is target/debug/deps/all-…; the command is to be target/debug/clayforge.
        let own = std::env::current_exe().expect("a test knows where it is");
        let folder = own.parent().and_then(Path::parent).expect("target/debug").to_owned();
        let target = folder.parent().expect("target");
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut build = Command::new(cargo);
        build
            .current_dir(root())
            .args(["build", "--quiet", "--locked", "-p", "cli", "--target-dir"])
            .arg(target);
        if name_of(&folder) == "release" {
            build.arg("--release");
        }
        let done = build.output().expect("cargo runs");
        assert!(done.status.success(), "cargo build -p cli: {}", String::from_utf8_lossy(&done.stderr));
        folder.join(format!("clayforge{}", std::env::consts::EXE_SUFFIX))
    })
}

/// What a run of the command came to.
pub struct Ran {
    pub code: Option<i32>,
    pub out: Vec<u8>,
    pub err: String,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            out: output.stdout,
            err: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }
}

impl Ran {
    pub fn out(&self) -> String {
        String::from_utf8_lossy(&self.out).into_owned()
    }

    #[track_caller]
    pub fn done(self) -> Self {
        assert_eq!(self.code, Some(0), "{}", self.err);
        self
    }
}

/// A folder of one's own to run the command in; no profile of the user is found.
pub struct Room(TempDir);

impl Room {
    pub fn new() -> Self {
        Self(TempDir::new().expect("a folder"))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn put(&self, name: &str, bytes: impl AsRef<[u8]>) -> &Self {
        fs::write(self.path(name), bytes).expect("a file in a new folder");
        self
    }

    pub fn command<S: AsRef<OsStr>>(&self, words: &[S]) -> Command {
        let mut command = Command::new(program());
        command
            .args(words)
            .current_dir(self.0.path())
            .env("XDG_CONFIG_HOME", self.path("config"))
            .env("NO_COLOR", "1")
            .stdin(Stdio::null());
        command
    }

    pub fn run(&self, words: &[&str]) -> Ran {
        self.command(words).output().expect("the command runs").into()
    }

    /// Runs it with bytes on its standard input.
    pub fn feed(&self, words: &[&str], input: &[u8]) -> Ran {
        let mut child = self
            .command(words)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command runs");
        let mut stdin = child.stdin.take().expect("piped");
        let input = input.to_owned();
        let writer = std::thread::spawn(move || {
            // A command that refuses need not read to the end.
            let _ = stdin.write_all(&input);
        });
        let output = child.wait_with_output().expect("the command ends");
        writer.join().expect("the writer does not panic");
        output.into()
    }

    /// Every file with its bytes.
    pub fn listing(&self) -> BTreeMap<String, Vec<u8>> {
        let entries = fs::read_dir(self.0.path()).expect("the folder is there").flatten();
        entries.map(|entry| (name_of(&entry.path()), fs::read(entry.path()).unwrap_or_default())).collect()
    }
}

/// A message has what, where, why and a hint, and no more than a screen.
#[track_caller]
pub fn assert_message(err: &str, parts: &[&str]) {
    let mut lines = err.lines();
    let first =
        lines.find(|line| line.starts_with("error: ")).unwrap_or_else(|| panic!("no error is said: {err}"));
    assert!(first.matches(": ").count() >= 2, "what, where or why is missing: {first}");
    assert!(err.contains("\n  hint: "), "no hint: {err}");
    assert!(err.len() < 2048, "{} bytes of message", err.len());
    for part in parts {
        assert!(err.to_lowercase().contains(&part.to_lowercase()), "`{part}` is not in: {err}");
    }
    assert!(!err.contains("panicked"), "{err}");
}
