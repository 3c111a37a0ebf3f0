//! Words that are overwritten before they mean anything.

use skein::Line;
use skein::command::command;

/// Of several temperatures of a kind, or several flows, with no move between them only the last counts; it takes the
/// place of the first (stages.md §7.9).
pub(crate) fn remove(lines: &mut Vec<Line>) {
    // The place of the first of each kind since the last move.
    let mut first: [Option<usize>; KINDS] = [None; KINDS];
    let mut kept: Vec<Line> = Vec::new();
    if !lines.iter().any(|line| kind(line).is_some()) {
        return;
    }
    for line in lines.drain(..) {
        match kind(&line) {
            Some(kind) => match first[kind] {
                Some(place) => kept[place] = line,
                None => {
                    first[kind] = Some(kept.len());
                    kept.push(line);
                }
            },
            None => {
                if is_work(&line) {
                    first = [None; KINDS];
                }
                kept.push(line);
            }
        }
    }
    *lines = kept;
}

const KINDS: usize = 3;

/// Which of the values that are overwritten a line sets.
fn kind(line: &Line) -> Option<usize> {
    match line {
        Line::Flow(_) => Some(0),
        Line::Verbatim(text) | Line::Pasted(text) => match command(text) {
            Some((b'M', 104, _)) => Some(1),
            Some((b'M', 140, _)) => Some(2),
            _ => None,
        },
        _ => None,
    }
}

/// Whether something happens at a line, so that what was set before it has meant something.
fn is_work(line: &Line) -> bool {
    match line {
        Line::Move(_) | Line::Arc(_) | Line::On | Line::Off => true,
        Line::Verbatim(text) | Line::Pasted(text) => command(text).is_some(),
        _ => false,
    }
}
