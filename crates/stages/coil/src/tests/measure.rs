//! Measures a wound pot by its lines alone, knowing nothing of how coil thinks.

use shape::plane::cross;
use skein::{Line, Notes, Nozzle, Point, Point3, Skein};

/// A straight piece of bead.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    pub from: Point3,
    pub to: Point3,
    pub flow: f64,
    /// How many turns have been laid up to its middle.
    pub turn: f64,
    /// How much of a turn it is.
    pub share: f64,
}

impl Piece {
    pub fn length(&self) -> f64 {
        flat(self.from).distance(flat(self.to))
    }

    /// The piece in parts no longer than so much.
    pub fn cut(&self, longest: f64) -> impl Iterator<Item = Self> + '_ {
        let parts = (self.length() / longest).ceil().max(1.0);
        let place = move |part: f64| {
            let at = |from: i32, to: i32| from + (f64::from(to - from) * part / parts).round() as i32;
            Point3 {
                x: at(self.from.x, self.to.x),
                y: at(self.from.y, self.to.y),
                z: at(self.from.z, self.to.z),
            }
        };
        (0..parts as usize).map(move |part| {
            let part = part as f64;
            let turn = self.turn + self.share * ((part + 0.5) / parts - 0.5);
            Self { from: place(part), to: place(part + 1.0), turn, share: self.share / parts, ..*self }
        })
    }

    pub fn middle(&self) -> [f64; 3] {
        let mean = |a: i32, b: i32| f64::midpoint(f64::from(a), f64::from(b));
        [mean(self.from.x, self.to.x), mean(self.from.y, self.to.y), mean(self.from.z, self.to.z)]
    }

    /// Its place nearest to another, seen from above: how far away it is, and how high.
    fn nearest(&self, at: [f64; 3]) -> (f64, f64) {
        let (from, to) = (self.from, self.to);
        let along = [f64::from(to.x - from.x), f64::from(to.y - from.y)];
        let square = (along[0] * along[0] + along[1] * along[1]).max(1e-9);
        let dot = (at[0] - f64::from(from.x)) * along[0] + (at[1] - f64::from(from.y)) * along[1];
        let share = (dot / square).clamp(0.0, 1.0);
        let x = f64::from(from.x) + along[0] * share - at[0];
        let y = f64::from(from.y) + along[1] * share - at[1];
        (libm::hypot(x, y), f64::from(from.z) + f64::from(to.z - from.z) * share)
    }
}

pub fn flat(at: Point3) -> Point {
    Point::new(at.x, at.y)
}

/// The pieces of each layer; the rim turn, where there is one, stands behind the last.
pub fn turns(skein: &Skein) -> Vec<Vec<Piece>> {
    let mut nozzle = Nozzle::default();
    let mut turns: Vec<Vec<Piece>> = Vec::new();
    for layer in &skein.layers {
        turns.push(Vec::new());
        for line in &layer.lines {
            let before = nozzle;
            nozzle.follow(line);
            if let (true, Some(from), Some(step)) = (before.on, before.at, line.as_move()) {
                let piece = Piece { from, to: step.to, flow: before.flow.f64(), turn: 0.0, share: 0.0 };
                turns.last_mut().expect("a layer").push(piece);
            }
        }
    }
    let rim = turns.last_mut().expect("a layer");
    let top = rim.last().expect("a bead").to.z;
    let level = rim.iter().position(|piece| piece.from.z == top).expect("a rim");
    let rim = rim.split_off(level);
    turns.push(rim);
    for (index, turn) in turns.iter_mut().enumerate() {
        let length: f64 = turn.iter().map(Piece::length).sum();
        let mut so_far = 0.0;
        for piece in turn {
            piece.turn = index as f64 + (so_far + piece.length() / 2.0) / length;
            piece.share = piece.length() / length;
            so_far += piece.length();
        }
    }
    turns
}

/// How far the thread may drift against the one below within a turn, as a share of the turn.
const DRIFT: f64 = 0.2;

/// What lies below a piece one turn earlier: the place of the thread that is nearest, seen from above, how far away it is
/// and how high. Only that part of the thread is looked at which is one turn older, give or take a fifth: where a wall
/// of three beads has its seam, beads of several heights lie side by side.
pub fn below(thread: &[Piece], piece: &Piece) -> Option<(f64, f64)> {
    let start = thread.partition_point(|other| other.turn + other.share / 2.0 < piece.turn - 1.0 - DRIFT);
    let end = thread.partition_point(|other| other.turn - other.share / 2.0 < piece.turn - 1.0 + DRIFT);
    let pieces = &thread[start..end];
    pieces.iter().map(|other| other.nearest(piece.middle())).min_by(|one, other| one.0.total_cmp(&other.0))
}

/// The nearest place of a turn, seen from above: how far away it is, and how high.
pub fn nearest(turn: &[Piece], at: [f64; 3]) -> (f64, f64) {
    let places = turn.iter().map(|piece| piece.nearest(at));
    places.min_by(|one, other| one.0.total_cmp(&other.0)).expect("a bead")
}

/// Corners nearer to each other than 5 µm are one, so pieces that meet in a corner may pass it by twice that.
const TOUCH: f64 = 10.0;

/// Whether two pieces cross, seen from above. With a seam that moves on, the end of a turn lies on its own beginning:
/// that is a layer lower.
pub fn do_cross(one: &Piece, other: &Piece, height: f64) -> bool {
    let side = |a: Point3, b: Point3, c: Point3| cross(flat(a), flat(b), flat(c));
    let (from, to) = (side(other.from, other.to, one.from), side(other.from, other.to, one.to));
    let across = side(one.from, one.to, other.from).signum() * side(one.from, one.to, other.to).signum();
    if from.signum() * to.signum() >= 0 || across >= 0 {
        return false;
    }
    let ends = [(one, other.from), (one, other.to), (other, one.from), (other, one.to)];
    let touches =
        |(piece, at): (&Piece, Point3)| piece.nearest([f64::from(at.x), f64::from(at.y), 0.0]).0 < TOUCH;
    if ends.into_iter().any(touches) {
        return false;
    }
    let share = from as f64 / (from - to) as f64;
    let (a, b) = (one.from, one.to);
    let at = [(a.x, b.x), (a.y, b.y), (a.z, b.z)].map(|(a, b)| f64::from(a) + f64::from(b - a) * share);
    (at[2] - other.nearest(at).1).abs() < 0.9 * height
}

/// Whether the notes say that a turn hangs.
pub fn is_told(turns: &[Vec<Piece>], notes: &Notes, index: usize) -> bool {
    // The rim is laid on the last layer.
    let layer = index.min(turns.len() - 2);
    notes.iter().any(|note| note.layer == Some(layer) && note.text.contains("sag"))
}

/// One thread from the first layer to the rim, and it never goes down.
pub fn is_one_rising_thread(skein: &Skein) {
    let lines = || skein.lines();
    assert_eq!(lines().filter(|line| **line == Line::On).count(), 1);
    assert_eq!(lines().filter(|line| **line == Line::Off).count(), 1);
    let heights: Vec<i32> = lines().filter_map(Line::as_move).map(|step| step.to.z).collect();
    assert!(heights.windows(2).all(|pair| pair[0] <= pair[1]), "{heights:?}");
}
