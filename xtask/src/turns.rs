//! Measures a spiral in finished G-code of any slicer: the clay of every turn against the gap that it fills. It reads
//! the moves and nothing else, and knows nothing of how a spiral is made.
//!
//! The gap below a place is how high the nozzle stands over the nearest place of the thread, seen from above, one turn
//! earlier: give or take a fifth of a turn, for at the seam of a wall of several beads other heights lie beside it.

use std::fmt::Write;
use std::fs;

/// A straight piece of bead in millimetres.
#[derive(Clone, Copy, Debug)]
struct Piece {
    from: [f64; 3],
    to: [f64; 3],
    /// What it pushes, in units of E.
    clay: f64,
    /// The turns laid before it and behind it.
    turns: [f64; 2],
}

/// What a turn has and should have.
pub struct Turn {
    /// How high the nozzle stands where it begins, in mm.
    pub height: f64,
    /// How long it is, in mm.
    pub length: f64,
    /// What was pushed, in mm³.
    pub clay: f64,
    /// Gap × length × width, in mm³.
    pub room: f64,
}

/// How a file is to be read.
pub struct Measure {
    /// The height of a layer in mm.
    pub layer: f64,
    /// How wide the room for a bead is, in mm.
    pub width: f64,
    /// What a unit of E is, in mm³.
    pub area: f64,
}

/// `turns FILE.gcode [--layer H] [--width W] [--area A]`.
pub fn run(args: &[String]) -> Result<(), String> {
    let Some((file, options)) = args.split_first() else { return Err("`turns` measures a file".to_string()) };
    let mut measure = Measure { layer: 1.5, width: 3.2, area: 1.0 };
    for option in options.chunks(2) {
        let [name, value] = option else { return Err(format!("`{}` needs a value", option[0])) };
        let value: f64 = value.parse().map_err(|_| format!("`{value}` is no number"))?;
        match name.as_str() {
            "--layer" => measure.layer = value,
            "--width" => measure.width = value,
            "--area" => measure.area = value,
            _ => return Err(format!("`{name}` is not known; there are `--layer`, `--width` and `--area`")),
        }
    }
    let text = fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
    print!("{}", table(&measure.turns(&text)?));
    Ok(())
}

fn table(turns: &[Turn]) -> String {
    let mut text =
        String::from("turn  from z mm   length mm    clay mm³  gap × length × width   clay / room\n");
    for (index, turn) in turns.iter().enumerate() {
        let share = turn.clay / turn.room;
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{index:4} {:10.3} {:11.1} {:11.1} {:21.1} {share:13.4}",
            turn.height, turn.length, turn.clay, turn.room
        );
    }
    let _ = writeln!(text, "worst: {:.2} % off", 100.0 * worst(turns));
    text
}

/// How far the turn that is furthest off is off its room, as a share.
pub fn worst(turns: &[Turn]) -> f64 {
    turns.iter().map(|turn| (turn.clay / turn.room - 1.0).abs()).fold(0.0, f64::max)
}

impl Measure {
    /// The turns of the last spiral of a file; the level rim counts as one.
    pub fn turns(&self, text: &str) -> Result<Vec<Turn>, String> {
        let thread = self.spiral(&pieces(text))?;
        let bottom = thread[0].from[2];
        let count = thread.last().map_or(0.0, |piece| piece.turns[1].ceil()) as usize;
        let mut turns: Vec<Turn> = (0..count)
            .map(|turn| Turn { height: bottom + self.layer * turn as f64, length: 0.0, clay: 0.0, room: 0.0 })
            .collect();
        for piece in thread.iter().flat_map(|piece| piece.cut(self.width / 2.0)) {
            let at = piece.middle();
            let turn = f64::midpoint(piece.turns[0], piece.turns[1]);
            let below = if turn < 1.0 { bottom } else { below(&thread, turn, at)? };
            let length = flat(piece.from, piece.to);
            let Some(sum) = turns.get_mut(turn as usize) else { continue };
            sum.length += length;
            sum.clay += piece.clay * self.area;
            sum.room += length * self.width * (at[2] - below);
        }
        Ok(turns)
    }

    /// The pieces of the last spiral with its rim, and how many turns are laid at each: by height, on the rim by length.
    fn spiral(&self, pieces: &[Piece]) -> Result<Vec<Piece>, String> {
        let rises = |piece: &Piece| piece.to[2] > piece.from[2];
        let joined = |index: usize| index > 0 && flat(pieces[index - 1].to, pieces[index].from) < 1e-6;
        let last = pieces.iter().rposition(rises).ok_or("nothing in it rises while clay flows")?;
        let mut first = last;
        while joined(first) && rises(&pieces[first - 1]) {
            first -= 1;
        }
        let end = (last + 1..pieces.len()).find(|index| !joined(*index)).unwrap_or(pieces.len());
        let bottom = pieces[first].from[2];
        let turns = ((pieces[last].to[2] - bottom) / self.layer).round();
        let around: f64 = pieces[last + 1..end].iter().map(|piece| flat(piece.from, piece.to)).sum();
        let mut so_far = 0.0;
        let counted = pieces[first..end].iter().enumerate().map(|(index, piece)| {
            let turns = if first + index <= last {
                [piece.from[2], piece.to[2]].map(|z| (z - bottom) / self.layer)
            } else {
                let before = so_far;
                so_far += flat(piece.from, piece.to);
                [before, so_far].map(|length| turns + length / around)
            };
            Piece { turns, ..*piece }
        });
        Ok(counted.collect())
    }
}

/// How high the thread is one turn earlier where it is nearest to a place.
fn below(thread: &[Piece], turn: f64, at: [f64; 3]) -> Result<f64, String> {
    const DRIFT: f64 = 0.2;
    let start = thread.partition_point(|piece| piece.turns[1] < turn - 1.0 - DRIFT);
    let end = thread.partition_point(|piece| piece.turns[0] < turn - 1.0 + DRIFT);
    let places = thread[start..end].iter().map(|piece| piece.nearest(at));
    let nearest = places.min_by(|one, other| flat(*one, at).total_cmp(&flat(*other, at)));
    nearest.map(|place| place[2]).ok_or_else(|| format!("there is nothing a turn below z {:.3}", at[2]))
}

impl Piece {
    fn place(&self, share: f64) -> [f64; 3] {
        std::array::from_fn(|axis| self.from[axis] + (self.to[axis] - self.from[axis]) * share)
    }

    fn middle(&self) -> [f64; 3] {
        self.place(0.5)
    }

    fn nearest(&self, at: [f64; 3]) -> [f64; 3] {
        let along = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let square = (along[0] * along[0] + along[1] * along[1]).max(1e-12);
        let dot = (at[0] - self.from[0]) * along[0] + (at[1] - self.from[1]) * along[1];
        self.place((dot / square).clamp(0.0, 1.0))
    }

    /// In equal parts that are no longer than so much.
    fn cut(&self, longest: f64) -> impl Iterator<Item = Self> + '_ {
        let parts = (flat(self.from, self.to) / longest).ceil().max(1.0);
        (0..parts as usize).map(move |part| {
            let [start, end] = [part as f64 / parts, (part as f64 + 1.0) / parts];
            let turn = |share: f64| self.turns[0] + (self.turns[1] - self.turns[0]) * share;
            Self {
                from: self.place(start),
                to: self.place(end),
                clay: self.clay / parts,
                turns: [turn(start), turn(end)],
            }
        })
    }
}

fn flat(a: [f64; 3], b: [f64; 3]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// The moves with clay of a file: G0 and G1 in millimetres, G90 and G91, M82 and M83, G92.
fn pieces(text: &str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let (mut at, mut pushed) = ([0.0; 3], 0.0);
    let (mut absolute, mut absolute_clay) = (true, true);
    for line in text.lines() {
        let line = line.split([';', '(']).next().unwrap_or_default();
        let words: Vec<(char, f64)> = line
            .split_ascii_whitespace()
            .filter_map(|word| {
                let letter = word.chars().next()?;
                Some((letter.to_ascii_uppercase(), word[letter.len_utf8()..].parse().ok()?))
            })
            .collect();
        let said = |letter: char| words[1..].iter().find(|word| word.0 == letter).map(|word| word.1);
        match words.first() {
            Some(('G', 90.0)) => (absolute, absolute_clay) = (true, true),
            Some(('G', 91.0)) => (absolute, absolute_clay) = (false, false),
            Some(('M', 82.0)) => absolute_clay = true,
            Some(('M', 83.0)) => absolute_clay = false,
            Some(('G', 92.0)) => pushed = said('E').unwrap_or(pushed),
            Some(('G', 0.0 | 1.0)) => {
                let from = at;
                for (axis, letter) in ['X', 'Y', 'Z'].into_iter().enumerate() {
                    at[axis] = said(letter).map_or(at[axis], |to| if absolute { to } else { at[axis] + to });
                }
                let clay = said('E').map_or(0.0, |to| if absolute_clay { to - pushed } else { to });
                pushed += clay;
                if clay > 0.0 && flat(from, at) > 0.0 {
                    pieces.push(Piece { from, to: at, clay, turns: [0.0; 2] });
                }
            }
            _ => {}
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two turns and a rim around a square of 40 mm, with so much clay for what fills a gap of 1.5 mm.
    fn square(clay: f64) -> String {
        let mut text = String::from("M83\nG1 X0 Y0 Z1.5\nG1 X40 Y0 E0.1\nG1 X0 Y0 E0.1\n");
        let corners = [[40.0, 0.0], [40.0, 40.0], [0.0, 40.0], [0.0, 0.0]];
        for turn in 0..3 {
            for step in 0..64 {
                let share = (f64::from(step) + 1.0) / 64.0;
                let side = step as usize / 16;
                let (from, to) = (corners[(side + 3) % 4], corners[side]);
                let part = f64::from(step % 16 + 1) / 16.0;
                let [x, y] = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * part);
                let z = 1.5 + 1.5 * (f64::from(turn) + share).min(2.0);
                let middle = share - 1.0 / 128.0;
                let gap = [middle, 1.0, 1.0 - middle][turn as usize] * 1.5;
                let _ = writeln!(text, "G1 X{x} Y{y} Z{z} E{}", 2.5 * 3.2 * gap * clay);
            }
        }
        text
    }

    #[test]
    fn a_spiral_that_fills_its_gaps_has_the_clay_it_needs() {
        let measure = Measure { layer: 1.5, width: 3.2, area: 1.0 };
        let turns = measure.turns(&square(1.0)).expect("a spiral");
        assert_eq!(turns.len(), 3);
        assert!(worst(&turns) < 0.001, "{}", table(&turns));
        let turns = measure.turns(&square(0.95)).expect("a spiral");
        assert!((worst(&turns) - 0.05).abs() < 0.001, "{}", table(&turns));
    }

    /// The forms of the gallery that are one spiral, through the whole chain to finished G-code.
    #[test]
    fn every_turn_of_the_gallery_has_the_clay_that_its_gap_holds() {
        for (name, gcode) in crate::gallery::spirals() {
            let turns = Measure { layer: 1.5, width: 3.2, area: 1.0 }.turns(&gcode).expect(name);
            assert!(turns.len() > 20 && worst(&turns) < 0.02, "{name}:\n{}", table(&turns));
        }
    }
}
