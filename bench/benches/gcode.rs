//! What reading G-code costs, on what our own slicer writes. `cargo bench -p bench --bench gcode`.

use bench::vase;
use clayforge::Profile;
use divan::counter::{BytesCount, ItemsCount};
use divan::{Bencher, black_box};
use gcode::{Command, Exporter, Flavor, GcodeExporter, Line, Parser, find_byte};

/// About as much as a print of a week.
const BYTES: usize = 50_000_000;

fn main() {
    divan::main();
}

/// The G-code of a vase, again and again.
fn program() -> Vec<u8> {
    let profile = Profile::built_in("clay").expect("it is built in").expect("it is sound");
    let mut print = Vec::new();
    let mut sink = |piece: &[u8]| {
        print.extend_from_slice(piece);
        Ok(())
    };
    clayforge::slice(vase(100_000), &profile, None, &mut |_| Ok(()), &mut sink).expect("a part that fits");
    print.repeat(BYTES / print.len() + 1)
}

fn lines(text: &[u8]) -> ItemsCount {
    ItemsCount::new(text.iter().filter(|&&byte| byte == b'\n').count())
}

/// Bytes to words; items are lines.
#[divan::bench(sample_count = 10, sample_size = 1)]
fn tokenize(bencher: Bencher) {
    let text = program();
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
    let text = program();
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
    let text = program();
    let flavor = Flavor::detect(&text).flavor;
    bencher.counter(lines(&text)).bench(|| {
        let mut out = Vec::with_capacity(text.len());
        let mut exporter = GcodeExporter::new(flavor);
        Parser::new(flavor).read(black_box(&text), |step| exporter.line(&step, &mut out));
        out
    });
}
