//! Runs the targets with what only a process has: a limit of time and of memory, and files for what is found.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use cap::Cap;
use fuzz::{Finding, Session, TARGETS, Target, attempt, corpus, minimised, seeds, target};
use std::alloc::System;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};
use std::{fs, panic, process, thread};

#[global_allocator]
static MEMORY: Cap<System> = Cap::new(System, usize::MAX);

/// What an input may take: 64 MiB and sixteen times its size (promise 12), and as much again for what it is compared
/// with.
const MEMORY_MOST: usize = 128 << 20;
/// How long the processor may work on an input, in a build without optimisation.
const TIME_MOST: Duration = Duration::from_secs(20);

/// What the processor had done when the input at hand was begun, and in which file that is.
static BEGUN: Mutex<Option<(Duration, PathBuf)>> = Mutex::new(None);
/// Where the last panic was.
static PLACE: Mutex<String> = Mutex::new(String::new());

const USAGE: &str = "\
usage: cargo run --release -p fuzz -- TARGET|all [--inputs N | --seconds N] [--seed N] [--out DIR]
       cargo run --release -p fuzz -- replay TARGET FILE...
       cargo run --release -p fuzz -- list
Findings go to DIR (fuzz-findings), made small; the input at hand is always in DIR/TARGET.current.";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["list"] => {
            TARGETS.iter().for_each(|target| println!("{:9} {}", target.name, target.law));
            Ok(0)
        }
        ["replay", name, files @ ..] => known(name).and_then(|target| replay(target, files)),
        [name, options @ ..] => Plan::read(options).and_then(|plan| {
            guard();
            match *name {
                "all" => TARGETS.iter().map(|target| plan.run(target)).sum(),
                name => plan.run(known(name)?),
            }
        }),
        [] => Err(USAGE.to_owned()),
    };
    match done {
        Ok(0) => ExitCode::SUCCESS,
        Ok(count) => {
            eprintln!("{count} findings");
            ExitCode::FAILURE
        }
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn known(name: &str) -> Result<&'static Target, String> {
    let names = || TARGETS.iter().map(|target| target.name).collect::<Vec<_>>().join(", ");
    target(name).ok_or_else(|| format!("there is no target `{name}`; there are {}\n{USAGE}", names()))
}

/// Runs files as they are, with the panic said in full.
fn replay(target: &Target, files: &[&str]) -> Result<usize, String> {
    let mut count = 0;
    for file in files {
        let bytes = fs::read(file).map_err(|error| format!("{file}: {error}"))?;
        let begun = Instant::now();
        match attempt(target, &bytes) {
            Ok(said) => println!("{file}: {said} ({} ms)", begun.elapsed().as_millis()),
            Err(message) => {
                println!("{file}: {message}");
                count += 1;
            }
        }
    }
    Ok(count)
}

/// How long to look, and where to put what is found.
struct Plan {
    inputs: u64,
    time: Duration,
    seed: u64,
    out: PathBuf,
}

impl Plan {
    fn read(options: &[&str]) -> Result<Self, String> {
        let mut plan = Self { inputs: u64::MAX, time: Duration::MAX, seed: 1, out: "fuzz-findings".into() };
        for pair in options.chunks(2) {
            let [option, value] = pair else { return Err(USAGE.to_owned()) };
            let number =
                || value.parse().map_err(|_| format!("{option} {value}: this is no number\n{USAGE}"));
            match *option {
                "--inputs" => plan.inputs = number()?,
                "--seconds" => plan.time = Duration::from_secs(number()?),
                "--seed" => plan.seed = number()?,
                "--out" => plan.out = value.into(),
                _ => return Err(USAGE.to_owned()),
            }
        }
        if plan.inputs == u64::MAX && plan.time == Duration::MAX {
            plan.time = Duration::from_secs(60);
        }
        Ok(plan)
    }

    fn run(&self, target: &'static Target) -> Result<usize, String> {
        let say = |path: &Path, error| format!("{}: {error}", path.display());
        fs::create_dir_all(&self.out).map_err(|error| say(&self.out, error))?;
        let folder = corpus().join(target.name);
        let seeds = seeds(&folder).map_err(|error| say(&folder, error))?;
        let current = self.out.join(format!("{}.current", target.name));
        let begin = |input: &[u8]| {
            // A signal leaves no time to write it.
            if let Err(error) = fs::write(&current, input) {
                eprintln!("{}: {error}", current.display());
            }
            *BEGUN.lock().unwrap_or_else(PoisonError::into_inner) = Some((spent(), current.clone()));
            let room = MEMORY.allocated().saturating_add(MEMORY_MOST + 32 * input.len());
            // The limit cannot lie below what is in use, and it does not.
            let _ = MEMORY.set_limit(room);
        };
        let mut session =
            Session::new(target, seeds.into_iter().map(|(_, bytes)| bytes).collect(), self.seed);
        let mut findings = session.replay(begin);
        let (started, mut count) = (Instant::now(), 0);
        while count < self.inputs && started.elapsed() < self.time {
            findings.extend(session.step(begin));
            count += 1;
            for finding in findings.drain(..) {
                self.keep(target, &finding)?;
            }
        }
        end();
        let (pool, kinds) = session.size();
        println!(
            "{:9} {count:9} inputs in {:5} s, {pool} kept, {kinds} kinds",
            target.name,
            started.elapsed().as_secs()
        );
        let found = fs::read_dir(&self.out).map_err(|error| say(&self.out, error))?.flatten();
        let prefix = format!("{}-", target.name);
        Ok(found.filter(|entry| entry.file_name().to_string_lossy().starts_with(&prefix)).count())
    }

    /// Makes a finding small and writes it down.
    fn keep(&self, target: &Target, finding: &Finding) -> Result<(), String> {
        end();
        let place = PLACE.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let small = minimised(&finding.input, |input| {
            // The same words from the same line of the same file: another panic is another finding.
            attempt(target, input).is_err_and(|message| words(&message) == words(&finding.message))
                && *PLACE.lock().unwrap_or_else(PoisonError::into_inner) == place
        });
        let hash = small.iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3)
        });
        let path = self.out.join(format!("{}-{hash:016x}", target.name));
        fs::write(&path, &small).map_err(|error| format!("{}: {error}", path.display()))?;
        println!("{}: {place}: {}", path.display(), finding.message);
        Ok(())
    }
}

/// What a panic says, without what it says of the input at hand: no digits, and no more than its first line.
fn words(message: &str) -> String {
    message.lines().next().unwrap_or("").chars().filter(|letter| !letter.is_ascii_digit()).collect()
}

/// No input is at hand.
fn end() {
    *BEGUN.lock().unwrap_or_else(PoisonError::into_inner) = None;
    let _ = MEMORY.set_limit(usize::MAX);
}

/// How long the processor has worked for this process: other work on the machine makes no input slow. Where the system
/// does not say it, how long the process has run.
fn spent() -> Duration {
    static START: OnceLock<Instant> = OnceLock::new();
    let start = START.get_or_init(Instant::now);
    // The name of the program, in brackets, may hold anything; behind it come numbers. The 12th and the 13th are the
    // time of the program and that of the system for it, in hundredths of a second.
    let said = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let numbers = said.rsplit(") ").next().unwrap_or_default().split(' ').skip(11).take(2);
    let ticks: Option<Vec<u64>> = numbers.map(|number| number.parse().ok()).collect();
    match ticks.as_deref() {
        Some([own, system]) => Duration::from_millis(10 * (own + system)),
        _ => start.elapsed(),
    }
}

/// Ends the process when an input takes too long, and keeps panics quiet.
fn guard() {
    panic::set_hook(Box::new(|info| {
        let place = info.location().map(ToString::to_string).unwrap_or_default();
        *PLACE.lock().unwrap_or_else(PoisonError::into_inner) = place;
    }));
    thread::spawn(move || {
        loop {
            thread::sleep(Duration::from_millis(500));
            let begun = BEGUN.lock().unwrap_or_else(PoisonError::into_inner).clone();
            if let Some((_, file)) = begun.filter(|(begun, _)| spent() > *begun + TIME_MOST) {
                eprintln!("{} takes more than {} s", file.display(), TIME_MOST.as_secs());
                process::exit(70);
            }
        }
    });
}
