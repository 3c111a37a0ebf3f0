//! How long the machine takes for the finished file, and what slows it down.

use crate::Profile;
use emulate::{Machine, Stream, Totals};
use gcode::Parser;
use skein::{Error, Notes};

/// Emulates a file that comes in pieces.
pub(crate) struct Stopwatch<'m> {
    parser: Parser<'m>,
    stream: Stream<'m>,
    /// The beginning of a line whose end has not come yet.
    begun: Vec<u8>,
}

impl<'m> Stopwatch<'m> {
    pub(crate) fn new(machine: &'m Machine) -> Result<Self, Error> {
        let stream = machine.stream().map_err(ours)?;
        Ok(Self { parser: Parser::new(&machine.flavor), stream, begun: Vec::new() })
    }

    /// Takes the next piece, which may end anywhere.
    pub(crate) fn push(&mut self, piece: &[u8]) {
        let mut rest = piece;
        if !self.begun.is_empty() {
            let Some(end) = gcode::find_byte(b'\n', rest) else {
                self.begun.extend_from_slice(rest);
                return;
            };
            let (end_of_line, behind) = rest.split_at(end + 1);
            self.begun.extend_from_slice(end_of_line);
            let line = std::mem::take(&mut self.begun);
            self.lines(&line);
            rest = behind;
        }
        let whole = rest.iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1);
        let (lines, begun) = rest.split_at(whole);
        self.lines(lines);
        self.begun.extend_from_slice(begun);
    }

    pub(crate) fn finish(mut self) -> Result<Totals, Error> {
        let line = std::mem::take(&mut self.begun);
        self.lines(&line);
        self.stream.finish().map_err(ours)
    }

    fn lines(&mut self, text: &[u8]) {
        let Self { parser, stream, .. } = self;
        parser.read(text, |step| stream.step(&step));
    }
}

fn ours(error: emulate::Error) -> Error {
    Error::new(error.to_string()).said_by("motion")
}

/// Says so when much of the clay is laid much slower than it was meant to be.
pub(crate) fn warn(totals: &Totals, profile: &Profile, notes: &mut Notes) {
    /// What is slow for less than this share of the way does not show.
    const WORTH_SAYING: f64 = 0.1;
    let share = totals.slow_length / totals.deposition_length;
    let Some(line) = totals.first_slow.filter(|_| share > WORTH_SAYING) else { return };
    let motion = &profile.motion;
    notes.say(format!(
        "{:.0} % of the clay is laid at less than half the speed that is set, first in line {line} of the file: the \
         machine accelerates with {} mm/s² and cuts corners by {} mm, and short moves, corners and the limits of \
         [motion] leave it no more. beads get thicker where the pump does not follow; set a lower speed, smooth the \
         part, or correct [motion]",
        100.0 * share,
        motion.acceleration,
        motion.junction_deviation.mm()
    ));
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &[u8] = b"G1 X0 Y0 Z0 F6000\nM83\nG1 X100 E5\r\nG1 Y50 E5 ; up\n\nG4 P500\nG1 X0 Y0 F3000";

    #[test]
    fn pieces_that_end_anywhere_take_as_long_as_the_whole() {
        let mut profile = Profile::default();
        profile.set("motion.acceleration", "700").expect("in its bounds");
        let machine = profile.emulator();
        let time = |length: usize| {
            let mut stopwatch = Stopwatch::new(&machine).expect("sound");
            FILE.chunks(length).for_each(|piece| stopwatch.push(piece));
            stopwatch.finish().expect("sound")
        };
        let whole = time(FILE.len());
        assert!(whole.total_time > 0.5 && whole.deposition_length > 0.0, "{whole:?}");
        for length in 1..FILE.len() {
            assert_eq!(time(length), whole, "in pieces of {length}");
        }
    }

    #[test]
    fn what_crawls_is_said() {
        let mut profile = Profile::default();
        profile.set("motion.acceleration", "100").expect("in its bounds");
        let zigzag: String = (0..50).map(|step| format!("G1 X{} Y{} E1\n", step, step % 2)).collect();
        for (file, slow) in
            [(format!("M83\nG1 F6000\n{zigzag}"), true), ("M83\nG1 X1\nG1 X900 E5 F600\n".to_owned(), false)]
        {
            let machine = profile.emulator();
            let mut stopwatch = Stopwatch::new(&machine).expect("sound");
            stopwatch.push(file.as_bytes());
            let totals = stopwatch.finish().expect("sound");
            let mut notes = Notes::default();
            warn(&totals, &profile, &mut notes);
            assert_eq!(notes.iter().count() == 1, slow, "{totals:?}");
        }
    }
}
