//! The moves of a run as arrays, one entry a move.

/// Below this a length is rounding, mm; Klipper uses the same.
pub const SHORTEST: f64 = 1e-9;

/// One programmed move: what the planner must know of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Where it begins, mm.
    pub from: [f64; 3],
    /// Where it ends, mm.
    pub to: [f64; 3],
    /// Unit tangent at its start. Zero when only the extruder moves.
    pub tangent_in: [f64; 3],
    /// Unit tangent at its end. Zero when only the extruder moves.
    pub tangent_out: [f64; 3],
    /// Length of the path, mm; of the extruder's way when only that moves.
    pub length: f64,
    /// Millimetres (or units) of the extruder for each of the path, signed.
    pub extruder: f64,
    /// Millimetres of the table (the W axis) for each of the path, signed.
    pub table: f64,
    /// The speed it is told to have, mm/s.
    pub target: f64,
    /// What it may accelerate with, mm/s²; infinite when speed changes at once.
    pub acceleration: f64,
    /// The acceleration with which its highest speed is found, mm/s²: the same, or lower where the machine smooths
    /// ([`Smoothing`](super::Smoothing)).
    pub smooth_acceleration: f64,
    /// How far corners may be cut, mm.
    pub junction_deviation: f64,
}

impl Move {
    /// A straight move between two points, unlimited in acceleration.
    pub fn line(from: [f64; 3], to: [f64; 3], target: f64) -> Self {
        let by = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let length = (by[0] * by[0] + by[1] * by[1] + by[2] * by[2]).sqrt();
        let tangent = if length > 0.0 { by.map(|side| side / length) } else { [0.0; 3] };
        Self {
            from,
            to,
            tangent_in: tangent,
            tangent_out: tangent,
            length,
            extruder: 0.0,
            table: 0.0,
            target,
            acceleration: f64::INFINITY,
            smooth_acceleration: f64::INFINITY,
            junction_deviation: 0.0,
        }
    }

    /// The same move with these limits.
    #[must_use]
    pub fn limited(mut self, acceleration: f64, junction_deviation: f64) -> Self {
        (self.acceleration, self.smooth_acceleration) = (acceleration, acceleration);
        self.junction_deviation = junction_deviation;
        self
    }

    /// Whether the nozzle moves, and not the extruder alone.
    #[inline]
    pub fn is_path(&self) -> bool {
        self.tangent_in != [0.0; 3]
    }
}

/// Moves in order, as a structure of arrays.
#[derive(Clone, Debug, Default)]
pub struct Moves {
    /// Where each begins, mm.
    pub from: Vec<[f64; 3]>,
    /// Where each ends, mm.
    pub to: Vec<[f64; 3]>,
    /// Unit tangents at the starts; zero when only the extruder moves.
    pub tangent_in: Vec<[f64; 3]>,
    /// Unit tangents at the ends.
    pub tangent_out: Vec<[f64; 3]>,
    /// Lengths, mm.
    pub length: Vec<f64>,
    /// Way of the extruder for each millimetre of path.
    pub extruder: Vec<f64>,
    /// Way of the table for each millimetre of path.
    pub table: Vec<f64>,
    /// Speeds that were asked for, after the caps of the machine, mm/s.
    pub target: Vec<f64>,
    /// Accelerations, mm/s².
    pub acceleration: Vec<f64>,
    /// Accelerations with which the highest speeds are found, mm/s².
    pub smooth_acceleration: Vec<f64>,
    /// Junction deviations, mm.
    pub junction_deviation: Vec<f64>,
}

impl Moves {
    /// How many there are.
    #[inline]
    pub fn len(&self) -> usize {
        self.length.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.length.is_empty()
    }

    /// One more at the end.
    pub fn push(&mut self, step: &Move) {
        self.from.push(step.from);
        self.to.push(step.to);
        self.tangent_in.push(step.tangent_in);
        self.tangent_out.push(step.tangent_out);
        self.length.push(step.length);
        self.extruder.push(step.extruder);
        self.table.push(step.table);
        self.target.push(step.target);
        self.acceleration.push(step.acceleration);
        self.smooth_acceleration.push(step.smooth_acceleration);
        self.junction_deviation.push(step.junction_deviation);
    }

    /// The move with this index.
    pub fn get(&self, index: usize) -> Move {
        Move {
            from: self.from[index],
            to: self.to[index],
            tangent_in: self.tangent_in[index],
            tangent_out: self.tangent_out[index],
            length: self.length[index],
            extruder: self.extruder[index],
            table: self.table[index],
            target: self.target[index],
            acceleration: self.acceleration[index],
            smooth_acceleration: self.smooth_acceleration[index],
            junction_deviation: self.junction_deviation[index],
        }
    }

    /// Forgets all, and keeps the room.
    pub(crate) fn clear(&mut self) {
        for points in [&mut self.from, &mut self.to, &mut self.tangent_in, &mut self.tangent_out] {
            points.clear();
        }
        for numbers in [
            &mut self.length,
            &mut self.extruder,
            &mut self.table,
            &mut self.target,
            &mut self.acceleration,
            &mut self.smooth_acceleration,
            &mut self.junction_deviation,
        ] {
            numbers.clear();
        }
    }

    /// The moves from `start` on.
    pub(crate) fn tail(&self, start: usize) -> Self {
        (start..self.len()).map(|index| self.get(index)).collect()
    }

    /// Whether move `index` moves the nozzle, and not the extruder alone.
    #[inline]
    pub fn is_path(&self, index: usize) -> bool {
        self.tangent_in[index] != [0.0; 3]
    }
}

impl FromIterator<Move> for Moves {
    fn from_iter<I: IntoIterator<Item = Move>>(moves: I) -> Self {
        let mut all = Self::default();
        moves.into_iter().for_each(|step| all.push(&step));
        all
    }
}

#[inline]
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
