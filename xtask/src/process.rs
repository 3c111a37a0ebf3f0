//! Programs that are run for their figures.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// What a run came to.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// From its start to its end.
    pub time: Duration,
    /// What its threads worked, together.
    pub worked: Duration,
    /// The most memory that was in use, kB.
    pub memory: u64,
}

/// A program under GNU time, which knows the most memory that it used, in a folder for what it writes.
pub struct Bench {
    /// The folder; gone when the bench is.
    pub room: PathBuf,
}

impl Bench {
    /// A folder of its own.
    pub fn new(name: &str) -> Result<Self, String> {
        let room = std::env::temp_dir().join(format!("clayforge-{name}-{}", std::process::id()));
        fs::create_dir_all(&room).map_err(|error| said(&room, &error))?;
        Ok(Self { room })
    }

    /// Runs a program; nothing when it fails.
    pub fn run(
        &self,
        program: &Path,
        words: &[String],
        env: &[(&str, String)],
    ) -> Result<Option<Run>, String> {
        const TIME: &str = "/usr/bin/time";
        let report = self.room.join("report");
        let begun = Instant::now();
        let status = Command::new(TIME)
            .args(["-q", "-f", "%M %U %S", "-o"])
            .args([&report, program])
            .args(words)
            .envs(env.iter().map(|(name, value)| (name, value)))
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .map_err(|error| format!("{TIME}: {error}; it comes with: apt-get install time"))?;
        let time = begun.elapsed();
        let text = fs::read_to_string(&report).map_err(|error| said(&report, &error))?;
        Ok(reported(&text, time).filter(|_| status.success()))
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        // A folder that cannot be removed is no reason to lose the figures.
        let _ = fs::remove_dir_all(&self.room);
    }
}

/// What GNU time says: kB, and the seconds of the program and of the system for it.
fn reported(text: &str, time: Duration) -> Option<Run> {
    let numbers: Option<Vec<f64>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
    match numbers?[..] {
        [memory, own, system] => {
            Some(Run { time, worked: Duration::from_secs_f64(own + system), memory: memory as u64 })
        }
        _ => None,
    }
}

/// Ours, built for release.
pub fn clayforge() -> Result<PathBuf, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let words = ["build", "--release", "--locked", "-p", "cli"];
    let build = Command::new(cargo).current_dir(crate::root()).args(words).status();
    if !build.is_ok_and(|status| status.success()) {
        return Err("clayforge could not be built".to_owned());
    }
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| crate::root().join("target"), PathBuf::from);
    Ok(target.join(format!("release/clayforge{}", std::env::consts::EXE_SUFFIX)))
}

/// What a file said no to.
pub fn said(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}

/// The middle one of some figures.
pub fn median(mut figures: Vec<f64>) -> f64 {
    figures.sort_by(f64::total_cmp);
    let middle = figures.len() / 2;
    match figures.len() {
        0 => f64::NAN,
        count if count.is_multiple_of(2) => f64::midpoint(figures[middle - 1], figures[middle]),
        _ => figures[middle],
    }
}

/// The processor of the machine, how many of them there are, and how many programs want them: beside others no time is right.
pub fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let cpu = fs::read_to_string("/proc/cpuinfo").ok();
    let named = cpu.as_deref().and_then(|text| text.lines().find_map(|line| line.strip_prefix("model name")));
    let name = named.map_or(std::env::consts::ARCH, |name| name.trim_start_matches(['\t', ' ', ':']));
    let load = fs::read_to_string("/proc/loadavg").ok();
    let load = load.as_deref().and_then(|text| text.split_whitespace().next());
    let load = load.map_or_else(String::new, |load| format!(", load {load} at the start"));
    format!("{cores} × {name}, {}{load}", std::env::consts::OS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_median_of_an_even_number_lies_between() {
        assert_eq!((median(vec![4.0, 1.0]), median(vec![9.0, 1.0, 2.0])), (2.5, 2.0));
    }

    #[test]
    fn what_time_says_is_read() {
        let run = reported("5120 1.25 0.50\n", Duration::from_secs(3)).expect("three figures");
        assert_eq!((run.memory, run.worked, run.time.as_secs()), (5120, Duration::from_millis(1750), 3));
        assert!(reported("Command exited with non-zero status 1\n", Duration::ZERO).is_none());
    }
}
