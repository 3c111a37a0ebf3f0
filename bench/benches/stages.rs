//! The costly steps of a slice one by one, and the whole. `cargo bench -p bench` runs all, `cargo bench -p bench fill`
//! some, `cargo bench -p bench -- --test` each of them once.

use bench::{print, vase};
use carve::Carve;
use clayforge::Profile;
use clayforge::clay_processor::{Options, Processor};
use divan::counter::{BytesCount, ItemsCount};
use divan::{Bencher, black_box};
use fill::Fill;
use import::Import;
use inset::Inset;
use preface::Preface;
use shape::TriangleMesh;
use shape::plane::offset;
use skein::{Machine, Notes, Ring, Skein, Slices, Stage};

/// Triangles of the parts.
const SIZES: [usize; 3] = [10_000, 100_000, 1_000_000];

fn main() {
    divan::main();
}

fn mesh(triangles: usize) -> TriangleMesh {
    Import::default().read(&vase(triangles)).expect("a sound file").mesh
}

fn slices(triangles: usize) -> Slices {
    Carve::default()
        .carve(&mesh(triangles), &Machine::default(), &mut Notes::default())
        .expect("a part that fits")
}

fn walled(triangles: usize) -> Skein {
    let skein = Preface::default().craft(&slices(triangles)).expect("a skein");
    Inset::default().craft(skein, &mut Notes::default()).expect("walls")
}

fn filled(triangles: usize) -> Skein {
    Fill::default().craft(walled(triangles), &mut Notes::default()).expect("infill")
}

/// Bytes of an STL to a mesh that knows its neighbours.
#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn import(bencher: Bencher, triangles: usize) {
    let bytes = vase(triangles);
    bencher.counter(BytesCount::of_slice(&bytes)).bench(|| Import::default().read(black_box(&bytes)));
}

/// A mesh to the loops of 67 layers.
#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn carve(bencher: Bencher, triangles: usize) {
    let (mesh, machine) = (mesh(triangles), Machine::default());
    bencher
        .counter(ItemsCount::new(mesh.faces.len()))
        .bench(|| Carve::default().carve(black_box(&mesh), &machine, &mut Notes::default()));
}

/// Every layer shrunk by half a bead and twice by a whole one, on one thread; items are corners that go in.
#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn offset_three_times(bencher: Bencher, triangles: usize) {
    let layers: Vec<Vec<Ring>> = slices(triangles).layers.into_iter().map(|layer| layer.loops).collect();
    let corners: usize = layers.iter().flatten().map(|ring| ring.0.len()).sum();
    bencher.counter(ItemsCount::new(corners)).bench(|| {
        for layer in black_box(&layers) {
            let first = offset(layer, -1600.0);
            let second = offset(&first, -3200.0);
            black_box(offset(&second, -3200.0));
        }
    });
}

/// Inner walls, infill and order.
#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn fill(bencher: Bencher, triangles: usize) {
    let skein = walled(triangles);
    bencher
        .with_inputs(|| skein.clone())
        .bench_values(|skein| Fill::default().craft(skein, &mut Notes::default()));
}

/// A skein to its text.
#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn skein_write(bencher: Bencher, triangles: usize) {
    let skein = filled(triangles);
    bencher.counter(BytesCount::new(skein.write().len())).bench(|| black_box(&skein).write());
}

/// The text of a skein to the skein.
#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn skein_read(bencher: Bencher, triangles: usize) {
    let text = filled(triangles).write();
    bencher.counter(BytesCount::of_slice(&text)).bench(|| Skein::read(black_box(&text)));
}

/// The bytes of an STL to the bytes of the G-code, with the profile `clay`.
#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn whole_slice(bencher: Bencher, triangles: usize) {
    let bytes = vase(triangles);
    let profile = Profile::built_in("clay").expect("it is built in").expect("it is sound");
    bencher.counter(ItemsCount::new(triangles)).bench(|| {
        let mut length = 0;
        let mut sink = |piece: &[u8]| {
            length += piece.len();
            Ok(())
        };
        clayforge::slice(black_box(&bytes), &profile, None, &mut |_| Ok(()), &mut sink)
            .expect("a part that fits");
        length
    });
}

/// A finished file to its verdicts, held against a printer: two million lines, planar and as a spiral; items are lines.
#[divan::bench(args = [false, true], sample_count = 10, sample_size = 1)]
fn check(bencher: Bencher, spiral: bool) {
    let text = print(2_000_000, spiral);
    let limits = Profile::default().limits();
    bencher.counter(ItemsCount::new(2_000_000_usize)).bench(|| {
        let mut processor = Processor::new(Options { limits, ..Options::default() });
        for piece in black_box(&text).chunks(256 * 1024) {
            processor.push(piece);
        }
        processor.finish().verdicts
    });
}
