//! Writes the lines of a layer anew. Speed and flow hold until they are said again, so what is inserted, left out or
//! turned round must not change those of what follows.

use crate::{Feature, Layer, Line, Move, Nozzle, Span, Stretch, Thread, spans};
use shape::Point3;
use unit::{Feed, Ratio};

/// Writes lines and says speed and flow where they change.
#[derive(Debug)]
pub struct Pen {
    nozzle: Nozzle,
    /// The nozzle in front of the line that was written last.
    before: Nozzle,
    lines: Vec<Line>,
}

impl Pen {
    /// A pen for a layer that finds the nozzle like this. The speed counts as not said yet, since every layer says its
    /// own.
    pub fn new(entering: &Nozzle, lines: usize) -> Self {
        let nozzle = Nozzle { feed: None, ..*entering };
        Self { nozzle, before: nozzle, lines: Vec::with_capacity(lines) }
    }

    /// What the nozzle does behind the lines written so far.
    pub fn nozzle(&self) -> &Nozzle {
        &self.nozzle
    }

    /// Writes a line as it is.
    pub fn push(&mut self, line: Line) {
        self.before = self.nozzle;
        self.nozzle.follow(&line);
        self.lines.push(line);
    }

    /// Passes an old line on with the speed and the flow that it had; `was` is the nozzle in front of it in the old layer.
    pub fn pass(&mut self, mut line: Line, was: &Nozzle) {
        if was.on || matches!(line, Line::On) {
            self.flow(was.flow);
        }
        if let Some(step) = line.as_move_mut() {
            step.feed = match (step.feed, was.feed) {
                (None, Some(feed)) if self.nozzle.feed != Some(feed) => Some(feed),
                (said, _) => said,
            };
        }
        self.push(line);
    }

    /// Passes old lines on in order; `was` is the nozzle in front of them in the old layer, and then behind them.
    pub fn pass_all(&mut self, lines: &[Line], was: &mut Nozzle) {
        for line in lines {
            self.pass(line.clone(), was);
            was.follow(line);
        }
    }

    /// A move at a speed.
    pub fn go(&mut self, to: Point3, feed: Option<Feed>) {
        self.step(Move { feed, ..Move::to(to) });
    }

    /// A move whose speed is said when it is new.
    pub fn step(&mut self, step: Move) {
        let feed = step.feed.filter(|feed| self.nozzle.feed != Some(*feed));
        self.push(Line::Move(Move { feed, ..step }));
    }

    /// From here this share of the nominal section flows.
    pub fn flow(&mut self, flow: Ratio) {
        if self.nozzle.flow != flow {
            self.push(Line::Flow(flow));
        }
    }

    /// Clay starts, unless it flows already.
    pub fn on(&mut self) {
        if !self.nozzle.on {
            self.push(Line::On);
        }
    }

    /// Clay stops, if it flows.
    pub fn off(&mut self) {
        if self.nozzle.on {
            self.push(Line::Off);
        }
    }

    /// Lets the travel that was just written end somewhere else; if there is none, a new one leads there.
    pub fn arrive(&mut self, at: Point3) {
        match self.lines.last_mut() {
            Some(Line::Move(step)) if !self.nozzle.on => {
                step.to = at;
                self.nozzle.at = Some(at);
            }
            _ if self.nozzle.at == Some(at) => {}
            _ => self.go(at, None),
        }
    }

    /// From where the move that was written last went.
    pub fn came_from(&self) -> Option<Point3> {
        self.before.at
    }

    /// Takes back the travel that was just written, with the place from which it went; nothing when something else was
    /// written last or that place is unknown.
    pub fn take_travel(&mut self) -> Option<(Point3, Move)> {
        let from = self.before.at?;
        match self.lines.last() {
            Some(Line::Move(travel)) if !self.nozzle.on => {
                let travel = *travel;
                self.lines.pop();
                self.nozzle = self.before;
                Some((from, travel))
            }
            _ => None,
        }
    }

    /// From here this block is open.
    pub fn block(&mut self, block: Option<Feature>) {
        if self.nozzle.block != block {
            if let Some((_, close)) = self.nozzle.block.map(Feature::tags) {
                self.push(close);
            }
            if let Some((open, _)) = block.map(Feature::tags) {
                self.push(open);
            }
        }
    }

    /// Clay flows from here as it does for this piece.
    pub fn start(&mut self, stretch: &Stretch) {
        self.ready(stretch);
        self.on();
    }

    /// What comes next is in the block of this piece and flows as it does.
    pub fn ready(&mut self, stretch: &Stretch) {
        self.block(stretch.block);
        self.flow(stretch.flow);
    }

    /// Lays a piece of a thread.
    pub fn lay(&mut self, stretch: &Stretch) {
        self.ready(stretch);
        self.step(stretch.step);
    }

    /// Lays a whole thread from where the nozzle stands, in place of one that `behind` knows the end of.
    pub fn thread(&mut self, thread: &Thread, behind: &Nozzle) {
        let Some(first) = thread.stretches.first() else { return };
        self.start(first);
        thread.stretches.iter().for_each(|stretch| self.lay(stretch));
        self.end(behind);
    }

    /// Ends a thread as the one whose place it takes: clay stops unless it flowed on, and the same block is open.
    pub fn end(&mut self, behind: &Nozzle) {
        if !behind.on {
            self.off();
        }
        self.block(behind.block);
    }

    /// The lines. Behind them flows what flowed behind the old ones, which `was` knows.
    pub fn finish(mut self, was: &Nozzle) -> Vec<Line> {
        if self.nozzle.flow != was.flow {
            let end = self.lines.len() - usize::from(matches!(self.lines.last(), Some(Line::Close(_))));
            self.lines.insert(end, Line::Flow(was.flow));
        }
        self.lines
    }
}

impl Layer {
    /// Its lines with other threads: `anew` says what takes the place of each, or nothing when it stays. It is shown the
    /// thread and the nozzle in front of it and behind it.
    pub fn rethread(
        self,
        entering: &Nozzle,
        mut anew: impl FnMut(&Thread, &Nozzle, &Nozzle) -> Option<Thread>,
    ) -> Vec<Line> {
        let mut was = *entering;
        let mut pen = Pen::new(entering, self.lines.len() * 3 / 2);
        for span in spans(&self.lines, entering.on) {
            let mut behind = was;
            span.lines().iter().for_each(|line| behind.follow(line));
            let thread = match span {
                Span::Thread(lines) => Thread::read(lines, &was),
                _ => None,
            };
            match thread.and_then(|thread| Some((anew(&thread, &was, &behind)?, thread))) {
                Some((anew, thread)) => {
                    if anew.start != thread.start {
                        pen.arrive(anew.start);
                    }
                    pen.thread(&anew, &behind);
                    was = behind;
                }
                None => pen.pass_all(span.lines(), &mut was),
            }
        }
        pen.finish(&was)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Reader;

    fn lines(text: &str) -> Vec<Line> {
        let mut reader = Reader::default();
        text.lines().map(|line| reader.line(line.as_bytes()).expect("a line")).collect()
    }

    fn text(lines: &[Line]) -> String {
        let mut text = Vec::new();
        for line in lines {
            line.write(&mut text);
            text.push(b'\n');
        }
        String::from_utf8(text).expect("text")
    }

    const LOOP: &str = "\
G1 X0.0 Y0.0 Z1.0 F3600.0
M108 S1.0
M101
G1 X10.0 Y0.0 Z1.0 F1800.0
M108 S0.5
G1 X10.0 Y10.0 Z1.0
G1 X0.0 Y0.0 Z1.0 F900.0
M103
";

    fn thread() -> (Nozzle, Thread) {
        let lines = lines(LOOP);
        let mut nozzle = Nozzle::default();
        lines[..2].iter().for_each(|line| nozzle.follow(line));
        (nozzle, Thread::read(&lines[2..], &nozzle).expect("a thread"))
    }

    #[test]
    fn what_is_passed_on_unchanged_is_the_same() {
        let mut pen = Pen::new(&Nozzle::default(), 0);
        let mut was = Nozzle::default();
        for line in lines(LOOP) {
            pen.pass(line.clone(), &was);
            was.follow(&line);
        }
        assert_eq!(text(&pen.finish(&was)), LOOP);
    }

    #[test]
    fn a_turned_thread_keeps_the_speed_and_flow_of_every_piece() {
        let (nozzle, thread) = thread();
        assert!(thread.is_closed());
        let (before, after) = thread.split(15_000.0);
        let mut pen = Pen::new(&nozzle, 0);
        pen.go(after.start, None);
        pen.thread(&after.join(before), &Nozzle::default());
        let mut end = nozzle;
        end.flow = Ratio(500_000);
        assert_eq!(
            text(&pen.finish(&end)),
            "G1 X10.0 Y5.0 Z1.0\nM108 S0.5\nM101\nG1 X10.0 Y10.0 Z1.0 F1800.0\nG1 X0.0 Y0.0 Z1.0 F900.0\nM108 S1.0\n\
             G1 X10.0 Y0.0 Z1.0 F1800.0\nM108 S0.5\nG1 X10.0 Y5.0 Z1.0\nM103\n"
        );
    }

    const JOINED: &str = "\
(<loop> outer )
G1 X0.0 Y0.0 Z1.0
M101
G1 X10.0 Y0.0 Z1.0
(</loop>)
(<infill>)
M108 S0.5
G1 X10.0 Y10.0 Z1.0
M103
(</infill>)
";

    #[test]
    fn a_thread_goes_on_through_the_blocks_that_it_joins() {
        let lines = lines(JOINED);
        let spans: Vec<Span<'_>> = spans(&lines, false).collect();
        assert!(
            matches!(spans[..], [Span::Other(_), Span::Travel(_), Span::Thread(thread), Span::Other(_)] if thread.len() == 7)
        );
        let layer = Layer { lines: lines.clone() };
        let turned = layer.rethread(&Nozzle::default(), |thread, _, _| Some(thread.clone().reversed()));
        assert_eq!(
            text(&turned),
            "(<loop> outer )\nG1 X10.0 Y10.0 Z1.0\n(</loop>)\n(<infill>)\nM108 S0.5\nM101\nG1 X10.0 Y0.0 Z1.0\n\
             (</infill>)\n(<loop> outer )\nM108 S1.0\nG1 X0.0 Y0.0 Z1.0\nM103\n(</loop>)\n(<infill>)\nM108 S0.5\n\
             (</infill>)\n"
        );
    }

    #[test]
    fn clay_that_flows_in_or_out_of_a_layer_is_not_stopped_there() {
        let text_in = "(<loop> outer )\nG1 X10.0 Y0.0 Z1.0\n(</loop>)\n(</nestedRing>)\n";
        let entering = Nozzle { at: Some(Point3::default()), on: true, ..Nozzle::default() };
        let layer = Layer { lines: lines(text_in) };
        let mut seen = Vec::new();
        let same = layer.rethread(&entering, |thread, before, behind| {
            seen.push((thread.stretches.len(), before.on, behind.on));
            Some(thread.clone())
        });
        assert_eq!((text(&same).as_str(), seen), (text_in, vec![(1, true, true)]));
    }

    #[test]
    fn reversed_twice_is_the_same_and_a_cut_beyond_an_end_cuts_nothing() {
        let (_, thread) = thread();
        assert_eq!(thread.clone().reversed().reversed(), thread);
        let length = thread.length();
        assert_eq!(thread.clone().split(length + 1.0).0, thread);
        assert_eq!(thread.clone().split(0.0).1, thread);
    }
}
