//! Reads the lines that [`Line::write`] writes, and what a person makes of them.

use crate::line::PASTED;
use crate::{Arc, Center, Error, Line, Mark, Move, Side, Tag};
use shape::Point3;
use unit::{Extrusion, Feed, Micron, Ratio};

/// Reads lines. It remembers the last place, since a move may leave out the axes that do not change.
#[derive(Clone, Debug, Default)]
pub struct Reader {
    x: Option<i32>,
    y: Option<i32>,
    z: Option<i32>,
}

impl Reader {
    /// Reads one line; a trailing CR is no part of it.
    ///
    /// # Errors
    /// When a line that must mean something cannot: a word that is no number, a place out of range.
    pub fn line(&mut self, text: &[u8]) -> Result<Line, Error> {
        let text = text.trim_ascii();
        if let Some(rest) = text.strip_prefix(b"G1 ") {
            return self.move_line(rest);
        }
        if let Some(rest) = text.strip_prefix(b"G2 ").or_else(|| text.strip_prefix(b"G3 ")) {
            return self.arc_line(rest, text[1] == b'2');
        }
        if let Some(rest) = text.strip_prefix(PASTED) {
            return match std::str::from_utf8(rest) {
                Ok(rest) => Ok(Line::Pasted(rest.into())),
                Err(_) => Err(Error::new("the line is not UTF-8 text")),
            };
        }
        if let Some(rest) = text.strip_prefix(b"(<") {
            if let Some(line) = self.tag_line(rest)? {
                return Ok(line);
            }
        } else if text == b"M101" {
            return Ok(Line::On);
        } else if text == b"M103" {
            return Ok(Line::Off);
        } else if let Some(rest) = text.strip_prefix(b"M108 S") {
            if let Some(flow) = Ratio::read(rest) {
                return Ok(Line::Flow(flow));
            }
            return Err(Error::new(format!("`{}` is no flow", lossy(rest))));
        }
        match std::str::from_utf8(text) {
            Ok(text) => Ok(Line::Verbatim(text.into())),
            Err(_) => Err(Error::new("the line is not UTF-8 text")),
        }
    }

    fn move_line(&mut self, rest: &[u8]) -> Result<Line, Error> {
        self.words(rest, |_, _| false).map(Line::Move)
    }

    fn arc_line(&mut self, rest: &[u8], clockwise: bool) -> Result<Line, Error> {
        let (mut i, mut j, mut radius) = (None, None, None);
        let step = self.words(rest, |letter, length| {
            match letter {
                b'I' => i = Some(length),
                b'J' => j = Some(length),
                b'R' => radius = Some(length),
                _ => return false,
            }
            true
        })?;
        let center = match (i, j, radius) {
            (None, None, Some(radius)) => Center::Radius(radius),
            (None, None, None) => {
                return Err(Error::new("an arc has no centre").hint("give I and J, or R"));
            }
            (i, j, None) => Center::Offset { i: i.unwrap_or_default(), j: j.unwrap_or_default() },
            _ => return Err(Error::new("an arc has two centres").hint("give I and J, or R")),
        };
        Ok(Line::Arc(Box::new(Arc { step, center, clockwise })))
    }

    /// The words of a move; lengths that are not its own are offered to `other`.
    #[inline]
    fn words(&mut self, mut rest: &[u8], mut other: impl FnMut(u8, Micron) -> bool) -> Result<Move, Error> {
        let (mut feed, mut extrusion) = (None, None);
        loop {
            rest = rest.trim_ascii_start();
            let Some((&letter, number)) = rest.split_first() else { break };
            if letter == b';' || letter == b'(' {
                break;
            }
            let word = || {
                let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
                lossy(&rest[..end])
            };
            let places = match letter {
                b'X' | b'Y' | b'Z' | b'F' | b'I' | b'J' | b'R' => 3,
                b'E' => Extrusion::PLACES,
                _ => {
                    return Err(Error::new(format!("`{}` is no word of a move", word()))
                        .hint("a move knows X, Y, Z, F and E"));
                }
            };
            let read = unit::decimal::read_prefix(number, places);
            let whole = |length: usize| number.get(length).is_none_or(u8::is_ascii_whitespace);
            let Some((value, length)) = read.filter(|(_, length)| whole(*length)) else {
                return Err(Error::new(format!("`{}` is no number", word())));
            };
            let taken = match letter {
                b'E' => {
                    extrusion = Extrusion::new(value);
                    extrusion.is_some()
                }
                b'F' => {
                    feed = Feed::from_places(value);
                    feed.is_some()
                }
                _ => {
                    let length = Micron::from_places(value);
                    let place = length.map(|length| length.0);
                    match (letter, length) {
                        (b'X', _) => self.x = place,
                        (b'Y', _) => self.y = place,
                        (b'Z', _) => self.z = place,
                        (_, Some(length)) if !other(letter, length) => {
                            return Err(Error::new(format!("`{}` is no word of a straight move", word()))
                                .hint("G1 knows X, Y, Z, F and E"));
                        }
                        _ => {}
                    }
                    place.is_some()
                }
            };
            if !taken {
                return Err(Error::new(format!("`{}` is out of range", word())));
            }
            rest = &number[length..];
        }
        match (self.x, self.y, self.z) {
            (Some(x), Some(y), Some(z)) => Ok(Move { to: Point3 { x, y, z }, feed, extrusion }),
            _ => {
                Err(Error::new("a move leaves out an axis before any move has set it")
                    .hint("give X, Y and Z"))
            }
        }
    }

    fn tag_line(&mut self, rest: &[u8]) -> Result<Option<Line>, Error> {
        if let Some(name) = rest.strip_prefix(b"/").and_then(|rest| rest.strip_suffix(b">)")) {
            return Ok(Tag::from_name(name).map(Line::Close));
        }
        let Some(end) = rest.iter().position(|byte| *byte == b'>') else { return Ok(None) };
        let (name, after) = (&rest[..end], &rest[end + 1..]);
        if after == b")" {
            return Ok(Tag::from_name(name).map(Line::Open));
        }
        let Some(body) = after.strip_suffix(b")") else { return Ok(None) };
        let opening = body.last() == Some(&b' ') || !body.ends_with(b">");
        if opening {
            return open_with_value(name, body.trim_ascii());
        }
        let value = body
            .strip_suffix(b">")
            .and_then(|body| body.strip_suffix(name))
            .and_then(|body| body.strip_suffix(b"</"));
        let Some(value) = value.map(<[u8]>::trim_ascii) else { return Ok(None) };
        let bad = || Error::new(format!("`{}` is no value for `{}`", lossy(value), lossy(name)));
        match name {
            b"boundaryPoint" | b"infillPoint" => {
                let mark = if name == b"boundaryPoint" { Mark::Boundary } else { Mark::Infill };
                let mut words = [None; 3];
                for word in value.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()) {
                    let axis =
                        word.first().and_then(|letter| letter.checked_sub(b'X')).filter(|axis| *axis < 3);
                    let axis = axis.ok_or_else(bad)?;
                    words[axis as usize] = Some(Micron::read(&word[1..]).ok_or_else(bad)?.0);
                }
                match words {
                    [Some(x), Some(y), Some(z)] => Ok(Some(Line::Point(mark, Point3 { x, y, z }))),
                    _ => Err(bad()),
                }
            }
            b"thickness" => {
                let height = Micron::read(value).filter(|height| height.0 > 0).ok_or_else(bad)?;
                Ok(Some(Line::Thickness(height)))
            }
            _ => match (std::str::from_utf8(name), std::str::from_utf8(value)) {
                (Ok(name), Ok(value)) => Ok(Line::value(name, value).ok()),
                _ => Ok(None),
            },
        }
    }
}

/// `(<name> value )`
fn open_with_value(name: &[u8], value: &[u8]) -> Result<Option<Line>, Error> {
    let bad = || Error::new(format!("`{}` is no value for `{}`", lossy(value), lossy(name)));
    Ok(Some(match Tag::from_name(name) {
        Some(Tag::Layer) => Line::Layer(Micron::read(value).ok_or_else(bad)?),
        Some(tag @ (Tag::Edge | Tag::Loop)) => Line::Wall(
            tag,
            match value {
                b"outer" => Side::Outer,
                b"inner" => Side::Inner,
                _ => return Err(bad()),
            },
        ),
        Some(tag @ (Tag::Rotation | Tag::BridgeRotation)) => {
            let text = std::str::from_utf8(value).map_err(|_| bad())?;
            Line::Rotation(tag, text.parse().map_err(|_| bad())?)
        }
        _ => return Ok(None),
    }))
}

fn lossy(text: &[u8]) -> std::borrow::Cow<'_, str> {
    String::from_utf8_lossy(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_move_may_leave_out_what_does_not_change() {
        let mut reader = Reader::default();
        assert!(reader.line(b"G1 X5").is_err());
        reader.line(b"G1 X1.0 Y2.0 Z0.2 F960").expect("whole move");
        let line = reader.line(b"G1 X5.0 (note) ;x").expect("partial move");
        let mut text = Vec::new();
        line.write(&mut text);
        assert_eq!(text, b"G1 X5.0 Y2.0 Z0.2");
    }

    #[test]
    fn an_arc_has_an_absolute_end_and_a_centre_from_its_start() {
        let mut reader = Reader::default();
        reader.line(b"G1 X10.0 Y0.0 Z1.0").expect("whole move");
        for (text, canonical) in [
            ("G3 X0 Y10 I-10 J0 F600", "G3 X0.0 Y10.0 Z1.0 I-10.0 J0.0 F600.0"),
            ("G2 X10.0 Y0.0 Z1.0 R-10 E2.5", "G2 X10.0 Y0.0 Z1.0 R-10.0 E2.5"),
        ] {
            let mut written = Vec::new();
            reader.line(text.as_bytes()).expect("an arc").write(&mut written);
            assert_eq!(written, canonical.as_bytes());
        }
        assert!(reader.line(b"G2 X0 Y0").is_err());
        assert!(reader.line(b"G2 X0 Y0 I1 R1").is_err());
    }

    #[test]
    fn a_pasted_line_is_no_move() {
        let text = b"(<alterationDeleteThisPrefix/>)G1 X5 ; mine";
        let line = Reader::default().line(text).expect("any line");
        assert_eq!(line, Line::Pasted("G1 X5 ; mine".into()));
        let mut written = Vec::new();
        line.write(&mut written);
        assert_eq!(written, text);
    }

    #[test]
    fn a_word_that_is_no_number_is_an_error() {
        let mut reader = Reader::default();
        for text in [
            "G1 X1,5 Y0 Z0",
            "G1 XY0 Z0",
            "G1 X0 Y0 Z0 F0",
            "G1 X0 Y0 Z99999999",
            "M108 Sfull",
            "(<layer> high )",
            "G1 X0 Y0 Z0 I1",
        ] {
            assert!(reader.line(text.as_bytes()).is_err(), "{text}");
        }
    }
}
