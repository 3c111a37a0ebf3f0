//! The way of the nozzle in a file: the beads that it lays, and how it goes between them.

use super::cover::Bead;
use clayforge::emulate::{Action, Commands, Extruder, Machine, ProcessData};
use clayforge::gcode::Flavor;
use std::collections::BTreeMap;

/// Less than this is no way, in mm.
const NOTHING: f64 = 1e-6;
/// How far the chords of an arc may lie beside it, in mm.
const CHORD: f64 = 0.001;

/// What a file lays.
pub struct Path {
    /// Straight pieces with the heights of their two ends.
    pieces: Vec<Piece>,
    /// How many times the clay starts.
    pub starts: usize,
    /// Ways without clay between two threads; one after the other counts once.
    pub travels: usize,
    /// Their length in mm.
    pub travel_length: f64,
    /// The clay from the first bead to the last, in mm³.
    pub clay: f64,
}

/// A straight piece of a bead, in mm and mm³.
struct Piece {
    from: [f64; 3],
    to: [f64; 3],
    clay: f64,
}

impl Piece {
    fn length(&self) -> f64 {
        libm::hypot(self.to[0] - self.from[0], self.to[1] - self.from[1])
    }
}

/// The beads of one height.
pub struct Level {
    /// How high the nozzle stands, and how far that is above the level below, in mm.
    pub z: f64,
    pub height: f64,
    pub beads: Vec<Bead>,
}

impl Path {
    /// Reads a file of any flavor, whose E counts so many mm³.
    pub fn read(gcode: &[u8], area: f64) -> Result<Self, String> {
        let flavor = Flavor::detect(gcode).flavor;
        let machine = Machine {
            flavor: flavor.clone(),
            extruder: Extruder::Unit { mm3: area },
            obeys_limits: false,
            ..Machine::default()
        };
        let commands = Commands::read_as(gcode, flavor);
        let operation = machine.process_additive(commands.steps).map_err(|error| error.to_string())?;
        let process = operation.process_data();
        let lays =
            |index: &usize| process.action()[*index] == Action::Deposit && flat(process, *index) > NOTHING;
        let beads: Vec<usize> = (0..process.len()).filter(lays).collect();
        let (Some(first), Some(last)) = (beads.first(), beads.last()) else {
            return Err("nothing in it lays clay".to_owned());
        };
        let before = first.checked_sub(1).map_or(0.0, |index| operation.deposited_volume()[index]);
        let mut path = Self {
            pieces: Vec::with_capacity(beads.len()),
            starts: 1,
            travels: 0,
            travel_length: 0.0,
            clay: operation.deposited_volume()[*last] - before,
        };
        for pair in beads.windows(2) {
            let between = || pair[0] + 1..pair[1];
            let way: f64 = between().map(|index| flat(process, index)).sum();
            let drawn_back = between().any(|index| operation.delta_volume()[index] < 0.0);
            path.travels += usize::from(way > NOTHING);
            path.starts += usize::from(way > NOTHING || drawn_back);
            path.travel_length += way;
        }
        for index in beads {
            path.lay(process, index, operation.delta_volume()[index]);
        }
        Ok(path)
    }

    /// Adds a move with its clay; an arc as chords.
    fn lay(&mut self, process: &ProcessData, index: usize, clay: f64) {
        let chords = process.arc(index).map_or(1, |arc| arc.chords(CHORD)).max(1);
        let length = process.step_distance()[index];
        let mut from = process.start(index);
        for chord in 1..=chords {
            let to = process.point(index, length * chord as f64 / chords as f64);
            self.pieces.push(Piece { from, to, clay: clay / chords as f64 });
            from = to;
        }
    }

    /// The length of all beads, seen from above, in mm.
    pub fn length(&self) -> f64 {
        self.pieces.iter().map(Piece::length).sum()
    }

    /// Whether most of it climbs.
    pub fn is_spiral(&self) -> bool {
        let climbing =
            self.pieces.iter().filter(|piece| (piece.to[2] - piece.from[2]).abs() > NOTHING).count();
        climbing * 2 > self.pieces.len()
    }

    /// The beads by the height at which they end, to the micron, from the lowest up. Each is as wide as its clay asks for.
    pub fn levels(&self) -> Vec<Level> {
        let mut levels: BTreeMap<i64, Vec<&Piece>> = BTreeMap::new();
        for piece in &self.pieces {
            levels.entry((piece.to[2] * 1000.0).round() as i64).or_default().push(piece);
        }
        let mut below = 0.0;
        let level = |(microns, pieces): (i64, Vec<&Piece>)| {
            let z = microns as f64 / 1000.0;
            let height = z - std::mem::replace(&mut below, z);
            let bead = |piece: &&Piece| Bead {
                from: [piece.from[0], piece.from[1]],
                to: [piece.to[0], piece.to[1]],
                width: piece.clay / piece.length().max(NOTHING) / height,
            };
            Level { z, height, beads: pieces.iter().map(bead).collect() }
        };
        levels.into_iter().map(level).collect()
    }

    /// The middle of the box around all beads.
    pub fn middle(&self) -> [f64; 2] {
        [0, 1].map(|axis| {
            let ends = || self.pieces.iter().flat_map(|piece| [piece.from[axis], piece.to[axis]]);
            f64::midpoint(ends().fold(f64::MAX, f64::min), ends().fold(f64::MIN, f64::max))
        })
    }
}

/// The way of a move seen from above, in mm.
fn flat(process: &ProcessData, index: usize) -> f64 {
    if !process.action()[index].is_path() {
        return 0.0;
    }
    let rise = process.end(index)[2] - process.start(index)[2];
    let length = process.step_distance()[index];
    (length * length - rise * rise).max(0.0).sqrt()
}
