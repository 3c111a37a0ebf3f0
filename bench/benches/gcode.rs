//! What reading and emulating G-code costs, on what our own slicer writes. `cargo bench -p bench --bench gcode`; items
//! are lines.

use bench::vase;
use clayforge::Profile;
use divan::counter::{BytesCount, ItemsCount};
use divan::{Bencher, black_box};
use emulate::{Commands, Machine, Table};
use gcode::{Command, Exporter, Flavor, GcodeExporter, Line, Parser, find_byte};
use std::fs;
use std::path::Path;

/// The triangles of the part ...
const TRIANGLES: usize = 1_000_000;
/// ... and how finely it is printed: about 50 MB, as much as a print of a week, in which nothing comes twice.
const FINE: [(&str, &str); 4] = [
    ("carve.layer_height", "0.05"),
    ("carve.first_layer_height", "0.05"),
    ("carve.bead_width", "0.4"),
    ("fill.walls", "3"),
];

fn main() {
    divan::main();
}

/// The G-code of a vase, and the profile it is for. It is made once and kept where cargo keeps what it builds; without
/// the file it is made anew.
fn program() -> (Vec<u8>, Profile) {
    let mut profile = Profile::built_in("clay").expect("it is built in").expect("it is sound");
    for (key, value) in FINE {
        profile.set(key, value).expect("a setting");
    }
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("vase.gcode");
    if let Ok(print) = fs::read(&path) {
        return (print, profile);
    }
    let mut print = Vec::new();
    let mut sink = |piece: &[u8]| {
        print.extend_from_slice(piece);
        Ok(())
    };
    clayforge::slice(vase(TRIANGLES), &profile, None, &mut |_| Ok(()), &mut sink).expect("a part that fits");
    fs::write(&path, &print).expect("the folder of cargo can be written to");
    (print, profile)
}

/// The machine of the profile, and the dialect of the text.
fn machine(text: &[u8], profile: &Profile) -> Machine {
    Machine { flavor: Flavor::detect(text).flavor.clone(), ..profile.emulator() }
}

fn lines(text: &[u8]) -> ItemsCount {
    ItemsCount::new(text.iter().filter(|&&byte| byte == b'\n').count())
}

/// Bytes to words.
#[divan::bench(sample_count = 10, sample_size = 1)]
fn tokenize(bencher: Bencher) {
    let (text, _) = program();
    bencher.counter(lines(&text)).counter(BytesCount::of_slice(&text)).bench(|| {
        let mut line = Line::default();
        let mut rest = black_box(&text[..]);
        let mut sum = 0.0;
        while !rest.is_empty() {
            let length = line.read_plain(rest).unwrap_or_else(|| {
                let end = find_byte(b'\n', rest).unwrap_or(rest.len());
                line.read(&rest[..end]);
                (end + 1).min(rest.len())
            });
            rest = &rest[length..];
            sum += line.words.get(b'X').unwrap_or(0.0);
        }
        sum
    });
}

/// Bytes to commands.
#[divan::bench(sample_count = 10, sample_size = 1)]
fn parse(bencher: Bencher) {
    let (text, _) = program();
    let flavor = Flavor::detect(&text).flavor;
    bencher.counter(lines(&text)).counter(BytesCount::of_slice(&text)).bench(|| {
        let mut sum = 0.0;
        Parser::new(flavor).read(black_box(&text), |step| {
            if let Command::Move { to, .. } | Command::MoveExtrude { to, .. } = step.command {
                sum += to.x.or(0.0);
            }
        });
        sum
    });
}

/// Bytes to commands and back.
#[divan::bench(sample_count = 10, sample_size = 1)]
fn parse_and_export(bencher: Bencher) {
    let (text, _) = program();
    let flavor = Flavor::detect(&text).flavor;
    bencher.counter(lines(&text)).bench(|| {
        let mut out = Vec::with_capacity(text.len());
        let mut exporter = GcodeExporter::new(flavor);
        Parser::new(flavor).read(black_box(&text), |step| exporter.line(&step, &mut out));
        out
    });
}

/// Bytes to every column of an additive operation: the whole emulation.
#[divan::bench(sample_count = 10, sample_size = 1)]
fn columns(bencher: Bencher) {
    let (text, profile) = program();
    let machine = machine(&text, &profile);
    bencher.counter(lines(&text)).counter(BytesCount::of_slice(&text)).bench(|| {
        let commands = Commands::read_as(black_box(&text), &machine.flavor);
        machine.process_additive(commands.steps).expect("a sound machine")
    });
}

/// Bytes to time and mass, with nothing kept.
#[divan::bench(sample_count = 10, sample_size = 1)]
fn stream(bencher: Bencher) {
    let (text, profile) = program();
    let machine = machine(&text, &profile);
    bencher.counter(lines(&text)).counter(BytesCount::of_slice(&text)).bench(|| {
        let mut stream = machine.stream().expect("a sound machine");
        Parser::new(&machine.flavor).read(black_box(&text), |step| stream.step(&step));
        stream.finish().expect("a sound machine").total_time
    });
}

/// Columns to CSV.
#[divan::bench(sample_count = 3, sample_size = 1)]
fn csv(bencher: Bencher) {
    let (text, profile) = program();
    let machine = machine(&text, &profile);
    let commands = Commands::read_as(&text, &machine.flavor);
    let operation = machine.process_additive(commands.steps).expect("a sound machine");
    bencher.counter(lines(&text)).bench(|| {
        let mut out = Vec::new();
        Table::of_additive(&operation).write_csv(&mut out).expect("memory takes all");
        out
    });
}
